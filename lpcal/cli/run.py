"""``lpcal run``: every stage that is out of date, in order, then the objects and the report."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.cli.engine_words import add_cores, jobs_of
from lpcal.cli.rig_option import add_rig_option, open_workspace
from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("rigs", nargs="*", type=Path, metavar="RIG", help="rig folders, or folders of such: each is run (default: the rig)")
    add_cores(parser, "images, spheres and pixels")
    add_rig_option(parser)


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Run what is out of date."""
    from lpcal.pipeline.run import rigs_in, run_all, run_rigs
    from lpcal.view.parallel import cores

    with cores(jobs_of(options.jobs)):
        if not options.rigs:
            return run_all(open_workspace(options), progress)
        return run_rigs(rigs_in(options.rigs), lambda rig: run_all(open_workspace(options, rig), progress))
