"""``lpcal report``: the page of a rig, or of a calibration alone."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from lpcal.cli.rig_option import add_rig_option, open_workspace
from lpcal.errors import UsageError

if TYPE_CHECKING:
    from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's own words."""
    parser.add_argument("surfaces", nargs="*", type=Path, metavar="SURFACE", help="with -c: folders that lpcal reconstruct wrote")
    parser.add_argument("-c", "--calibration", type=Path, help="the page of this calibration alone (default: of the rig, all its stages)")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="with -c: the page (default: beside it, NAME_report.html)")
    add_rig_option(parser)


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Write calib/report.html from what is there, or the page of one calibration.

    Raises
    ------
    UsageError
        Surfaces or a place for the page are named without a calibration.
    """
    from lpcal.pipeline.report import report_calibration, write_report

    if options.calibration is not None:
        return report_calibration(options.calibration, options.surfaces, options.output, progress)
    for word, given in (("SURFACE", options.surfaces), ("-o", options.output)):
        if given:
            todo = "leave it out: a rig's report holds all its surfaces and is calib/report.html; or name a calibration with -c"
            raise UsageError(f"{word} without -c", needed="-c calibration.yaml", todo=todo)
    return write_report(open_workspace(options), progress)
