"""``lpcal intrinsics [IMAGES...]``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from lpcal.cli.engine_words import add_cores, jobs_of
from lpcal.cli.rig_option import add_rig_option, open_workspace
from lpcal.errors import InputError, UsageError
from lpcal.records.outcome import Outcome, Progress

if TYPE_CHECKING:
    from lpcal.pipeline.workspace import Workspace


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
    parser.add_argument(
        "--corners", metavar="NxM", help="inner corners of a chessboard along x and y: with --square, no panel.yaml is needed"
    )
    parser.add_argument("--square", metavar="LENGTH", help="side of its squares with the unit, such as 25mm")
    add_cores(parser, "the images")
    add_rig_option(parser)


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Solve the camera, or compare it."""
    if options.compare is not None:
        if options.images:
            raise UsageError("--compare takes no images", todo="run lpcal intrinsics IMAGES first, then --compare OTHER")
        from lpcal.pipeline.diff import compare

        return compare(open_workspace(options), options.compare)
    from lpcal.pipeline import intrinsics
    from lpcal.view.parallel import cores

    absent = [image for image in options.images if not image.is_file()]
    if absent:
        from lpcal.formats.named_files import did_you_mean

        todo = did_you_mean(absent[0], "correct the name or the pattern")
        raise InputError("no such image", where=str(absent[0]), needed="image files", todo=todo)
    images = list(dict.fromkeys(options.images))
    workspace = _of_words(options) if options.corners or options.square else open_workspace(options)
    with cores(jobs_of(options.jobs)):
        return intrinsics.run(workspace, progress, images or None, options.corners_cache)


def _of_words(options: argparse.Namespace) -> Workspace:
    """A rig of a camera and the board that the command's words say, in the current folder.

    Raises
    ------
    UsageError
        Half of the words, or no images.
    """
    from lpcal.cli.board_words import corners_of, square_of
    from lpcal.formats.panel_yaml import FILE_NAME
    from lpcal.pipeline.workspace import Workspace
    from lpcal.records.rig import BoardSection, CameraSection, Rig, RigFile

    if not (options.corners and options.square and options.images):
        raise UsageError(
            "half of what stands for a panel.yaml",
            needed="IMAGES, --corners and --square",
            todo="lpcal intrinsics b/*.png --corners 9x6 --square 25mm",
        )
    board = BoardSection.model_construct(kind="chessboard", corners=corners_of(options.corners), square=square_of(options.square))
    camera = CameraSection.model_construct(images=[path.as_posix() for path in options.images])
    rig = Rig.model_construct(lpcal=1, name="camera", camera=camera, board=board)
    return Workspace(RigFile(rig, Path.cwd() / FILE_NAME))
