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
    """Write the calibration."""
    from lpcal.pipeline.exchange import import_file

    return import_file(options.source, options.output, progress, vectors=options.vectors, images=options.images)
