"""``lpcal field``: the calibrated light field at given points."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("calibration", type=Path, help="calibration.yaml")
    parser.add_argument("points", type=Path, metavar="POINTS.csv", help="columns x_m, y_m, z_m: points in C")
    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="FIELD.csv", help="light, x_m, y_m, z_m, dx, dy, dz, irradiance"
    )


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Write the field of every light at every point."""
    from lpcal.formats.calibration_yaml import read_calibration
    from lpcal.formats.field_csv import FIELD, read_points, write_field
    from lpcal.formats.outputs import refuse_place

    refuse_place(options.output, FIELD, (options.calibration, options.points))
    calibration = read_calibration(options.calibration)
    x_C = read_points(options.points)
    fields, warnings = {}, []
    for done, light in enumerate(calibration.lights, start=1):
        fields[light.name] = light.field(x_C)
        if (beyond := int(light.extrapolated(x_C).sum())) > 0:
            seen_deg = math.degrees(light.lobe.seen_rad)
            warnings.append(
                f"{light.name}: extrapolated at {beyond} points, more than {seen_deg:.1f} deg from its axis: no sphere was there"
            )
        progress("lights", done, len(calibration.lights))
    write_field(options.output, x_C, fields)
    summary = [f"{options.output}: {len(calibration.lights)} lights at {len(x_C)} points"]
    return Outcome(summary, {"file": str(options.output)}, warnings=warnings)
