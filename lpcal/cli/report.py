"""``lpcal report``."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from lpcal.cli.rig_option import add_rig_option, open_workspace

if TYPE_CHECKING:
    from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's own words."""
    add_rig_option(parser)


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Write calib/report.html from what is there."""
    from lpcal.pipeline.report import write_report

    return write_report(open_workspace(options), progress)
