"""``lpcal fuse``: one model of surfaces whose captures are placed."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from lpcal.cli.engine_words import add_engine_words, engine_of_words, jobs_of
from lpcal.cli.rig_option import add_rig_option, length, open_workspace
from lpcal.errors import InputError
from lpcal.records.outcome import Outcome, Progress

if TYPE_CHECKING:
    from lpcal.pipeline.workspace import Workspace


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument(
        "captures",
        nargs="*",
        type=Path,
        metavar="CAPTURE",
        help="surfaces, or captures that were reconstructed (default: all of the rig that are placed)",
    )
    parser.add_argument("-o", "--output", type=Path, default=Path("model"), metavar="DIR", help="where to (default: model)")
    parser.add_argument("--step", metavar="LENGTH", help="length of the model's edges, such as 0.5mm (default: 1.4 pixels on the object)")
    parser.add_argument("--no-pages", action="store_true", help="no model.html")
    parser.add_argument(
        "--refine", action="store_true", help="write beside the model the rig's calibration as corrected by the views, calibration.yaml"
    )
    parser.add_argument(
        "--once", action="store_true", help="fuse the surfaces as they are; do not solve the captures again with what all of them show"
    )
    add_engine_words(parser, "tiles of the model's space")
    add_rig_option(parser)


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Fuse them."""
    from lpcal.pipeline.fuse import fuse_folders

    try:
        rig: Workspace | None = open_workspace(options)
    except InputError:
        if not options.captures or options.rig != Path():
            raise
        rig = _rig_above(options)
    engine = engine_of_words(options.on, jobs_of(options.jobs), options.output)
    page, again = not options.no_pages, not options.once
    return fuse_folders(
        options.captures,
        options.output,
        rig,
        length(options.step, "--step"),
        progress,
        page=page,
        refine=options.refine,
        again=again,
        engine=engine,
    )


def _rig_above(options: argparse.Namespace) -> Workspace | None:
    """The rig that the first capture lies in, where the command was started outside of it."""
    try:
        return open_workspace(options, options.captures[0])
    except InputError:
        return None
