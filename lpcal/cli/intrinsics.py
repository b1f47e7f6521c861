"""``lpcal intrinsics [IMAGES...]``."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.cli.rig_option import add_rig_option, open_workspace
from lpcal.errors import InputError, UsageError
from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Images in place of ``camera.images``."""
    parser.add_argument(
        "images", nargs="*", type=Path, metavar="IMAGE", help="images of the board, in place of camera.images of panel.yaml"
    )
    parser.add_argument(
        "--compare",
        type=Path,
        metavar="OTHER",
        help="how far another calibration (mrcal, OpenCV, ROS, Kalibr, COLMAP, lpcal) projects from this rig's camera.yaml; solves nothing",
    )
    parser.add_argument(
        "--corners-cache",
        type=Path,
        metavar="FILE.vnl",
        help="corners as mrcal's tools keep them: read where the file is there, else found and written to it",
    )
    add_rig_option(parser)


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Solve the camera, or compare it."""
    if options.compare is not None:
        if options.images:
            raise UsageError("--compare takes no images", todo="run lpcal intrinsics IMAGES first, then --compare OTHER")
        from lpcal.pipeline.diff import compare

        return compare(open_workspace(options), options.compare)
    from lpcal.pipeline import intrinsics

    absent = [image for image in options.images if not image.is_file()]
    if absent:
        raise InputError("no such image", where=str(absent[0]), needed="image files", todo="correct the name or the pattern")
    return intrinsics.run(open_workspace(options), progress, list(dict.fromkeys(options.images)) or None, options.corners_cache)
