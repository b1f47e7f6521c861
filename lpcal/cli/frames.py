"""``lpcal frames``: a video's frames as images, with the table of their times that ``mocap.images`` reads."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.errors import UsageError
from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("video", type=Path, metavar="VIDEO", help="a video, such as boards.mp4")
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="where to (default: a folder of the video's name beside it)")
    parser.add_argument("--every", default="0s", metavar="TIME", help="at least so long between two frames, such as 500ms (default: all)")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Write the frames."""
    from lpcal.pipeline.frames import write_frames
    from lpcal.records.quantities import parse

    try:
        every_s = parse(options.every, "time")
    except ValueError as error:
        raise UsageError(str(error), where="--every", needed="a time with its unit, such as 500ms") from error
    if every_s < 0:
        raise UsageError(f"--every {options.every}", needed="a time of 0 or more")
    return write_frames(options.video, options.output or options.video.with_suffix(""), every_s, progress)
