"""``lpcal demo``: the whole chain on the bundled rig."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("folder", nargs="?", type=Path, default=Path("lpcal_demo"), metavar="DIR", help="a new folder (default lpcal_demo)")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Calibrate, reconstruct, compare with the truth."""
    from lpcal.pipeline.run import demo

    return demo(options.folder, progress)
