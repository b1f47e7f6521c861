"""``lpcal run``: every stage that is out of date, in order, then the objects and the report."""

from __future__ import annotations

import argparse

from lpcal.cli.rig_option import add_rig_option, open_workspace
from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    add_rig_option(parser)


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Run what is out of date."""
    from lpcal.pipeline.run import run_all

    return run_all(open_workspace(options), progress)
