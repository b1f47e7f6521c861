"""``lpcal import``: a calibration from other systems' files."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument(
        "source", type=Path, metavar="FILE_OR_FOLDER", help=".lp, DiLiGenT folder, LUCES led_params, near_ps light.mat, directions"
    )
    parser.add_argument("--images", type=Path, metavar="FOLDER", help="name the lights after these images, in their order")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="calibration.yaml", help="the calibration to write")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Do it."""
    from lpcal.formats.calibration_yaml import KIND, write_calibration
    from lpcal.formats.documents import Provenance, document_kind, sha256
    from lpcal.formats.import_lights import named_after, read_lights
    from lpcal.formats.outputs import refuse_place

    refuse_place(options.output, document_kind(KIND), [options.source])
    progress("reading", 0, 1)
    name, calibration = read_lights(options.source)
    calibration = named_after(calibration, options.images) if options.images else calibration
    files = sorted(options.source.glob("*.txt")) + sorted(options.source.glob("*.mat")) if options.source.is_dir() else [options.source]
    write_calibration(options.output, calibration, Provenance({path.name: sha256(path) for path in files}, {"format": name}))
    progress("reading", 1, 1)
    near = sum(light.source_C is not None for light in calibration.lights)
    camera = "a camera" if calibration.camera else "no camera: parallel rays"
    kind = "near" if near else "distant"
    return Outcome(
        [f"{name}: {len(calibration.lights)} {kind} lights, {camera} -> {options.output}"],
        {"format": name, "lights": len(calibration.lights), "near": near, "camera": calibration.camera is not None, "file": options.output},
        next_command=f"lpcal reconstruct CAPTURE -c {options.output}",
    )
