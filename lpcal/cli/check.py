"""``lpcal check [mocap.csv]``."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.cli.rig_option import add_rig_option, open_workspace
from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """A recording in place of ``mocap.file``."""
    parser.add_argument(
        "recording", nargs="?", type=Path, metavar="MOCAP", help="the motion-capture recording, in place of mocap.file of panel.yaml"
    )
    add_rig_option(parser)


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Look before any solve."""
    from lpcal.pipeline import check

    return check.run(open_workspace(options), progress, options.recording)
