"""``lpcal diff``: has my rig moved between two calibrations."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("before", type=Path, metavar="BEFORE", help="a calibration.yaml, or a rig's folder")
    parser.add_argument("after", type=Path, metavar="AFTER", help="another of the same rig")
    parser.add_argument("-o", "--output", type=Path, default=Path("diff.html"), metavar="PAGE", help="the page (default: diff.html here)")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:  # noqa: ARG001 - it is done at once
    """Compare them."""
    from lpcal.pipeline.diff import diff

    return diff(options.before, options.after, options.output)
