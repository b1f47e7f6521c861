"""``lpcal field``: the calibrated light field at given points."""

from __future__ import annotations

import argparse
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
    from lpcal.api.lights import light_field
    from lpcal.formats.calibration_yaml import read_calibration
    from lpcal.formats.field_csv import FIELD, read_points, write_field
    from lpcal.formats.outputs import refuse_place

    refuse_place(options.output, FIELD, (options.calibration, options.points))
    calibration = read_calibration(options.calibration).with_lights()
    x_C = read_points(options.points)
    progress("lights", 0, 1)
    found = light_field(calibration, x_C)
    progress("lights", 1, 1)
    write_field(options.output, x_C, dict(zip(found.names, zip(found.direction_C, found.irradiance, strict=True), strict=True)))
    summary = [f"{options.output}: {len(calibration.lights)} lights at {len(x_C)} points"]
    sensor = calibration.distance_sensor
    if sensor is not None and len(x_C):
        beside = sensor.beside_m(x_C)
        near, in_words = int(beside.argmin()), ", ".join(f"{1e3 * value:.1f}" for value in x_C[int(beside.argmin())])
        summary.append(
            f"distance sensor: its beam passes {1e3 * beside[near]:.1f} mm beside the nearest of them, [{in_words}] mm; "
            f"a surface there reads {1e3 * sensor.reads_m(float(x_C[near, 2])):.1f} mm"
        )
    return Outcome(summary, {"file": str(options.output)}, warnings=list(found.warnings))
