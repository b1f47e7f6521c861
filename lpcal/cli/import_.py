"""``lpcal import``: a calibration from other systems' files."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument(
        "source",
        type=Path,
        metavar="FILE_OR_FOLDER",
        help="lights, a camera or its place from a file of another system's; lpcal export --list names those that are read",
    )
    parser.add_argument("--images", type=Path, metavar="FOLDER", help="name the lights after these images, in their order")
    parser.add_argument(
        "--vectors", choices=("directions", "positions"), help="what the vectors of an .lp or a table are, where their lengths do not tell"
    )
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="calibration.yaml", help="the calibration to write")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Do it."""
    from lpcal.api.files import read_calibration
    from lpcal.formats.calibration_yaml import KIND, write_calibration
    from lpcal.formats.documents import document_kind, sha256
    from lpcal.formats.outputs import refuse_place
    from lpcal.records.calibration import NAMES
    from lpcal.records.provenance import Provenance

    refuse_place(options.output, document_kind(KIND), [options.source])
    progress("reading", 0, 1)
    found = read_calibration(options.source, vectors=options.vectors, images=options.images)
    files = sorted(options.source.glob("*.txt")) + sorted(options.source.glob("*.mat")) if options.source.is_dir() else [options.source]
    write_calibration(options.output, found, Provenance({path.name: sha256(path) for path in files}, {"format": found.origin}))
    progress("reading", 1, 1)
    near = sum(light.source_C is not None for light in found.lights)
    held = [f"{len(found.lights)} {'near' if near else 'distant'} lights"] if found.lights else ["no lights"]
    held += ["a camera" if found.camera else "no camera: parallel rays"] if found.lights or found.camera else []
    held += [f"{NAMES[found.carries][0]}"] * (found.H_PC is not None)
    return Outcome(
        [f"{found.origin or KIND}: {', '.join(held)} -> {options.output}"],
        {
            "format": found.origin,
            "lights": len(found.lights),
            "near": near,
            "camera": found.camera is not None,
            "hand-eye": found.H_PC is not None,
            "file": options.output,
            "notes": list(found.warnings),
        },
        list(found.warnings),
        next_command=f"lpcal reconstruct CAPTURE -c {options.output}" if found.lights else f"lpcal export {options.output} --format all",
    )
