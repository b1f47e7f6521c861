"""``lpcal distance``: the panel's distance sensor, of its readings on the board."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.cli.rig_option import add_rig_option, open_workspace
from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("panel", nargs="?", type=Path, help="panel.yaml or its folder, the same as --rig")
    add_rig_option(parser)


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Write distance.yaml."""
    from lpcal.pipeline import distance
    from lpcal.pipeline.run import run_stage

    return run_stage(open_workspace(options, options.panel), distance.STAGE, progress)
