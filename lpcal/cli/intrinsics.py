"""``lpcal intrinsics [IMAGES...]``."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.cli.rig_option import add_rig_option, open_workspace
from lpcal.errors import InputError
from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Images in place of ``camera.images``."""
    parser.add_argument(
        "images", nargs="*", type=Path, metavar="IMAGE", help="images of the board, in place of camera.images of panel.yaml"
    )
    add_rig_option(parser)


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Solve the camera."""
    from lpcal.pipeline import intrinsics

    absent = [image for image in options.images if not image.is_file()]
    if absent:
        raise InputError("no such image", where=str(absent[0]), needed="image files", todo="correct the name or the pattern")
    return intrinsics.run(open_workspace(options), progress, list(dict.fromkeys(options.images)) or None)
