"""``lpcal refine``: the lights refined from images of spheres."""

from __future__ import annotations

import argparse

from lpcal.cli.engine_words import add_cores, jobs_of
from lpcal.cli.rig_option import add_rig_option, open_workspace
from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    add_cores(parser, "the spheres")
    add_rig_option(parser)


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Write lights.yaml."""
    from lpcal.pipeline import refine
    from lpcal.pipeline.run import run_stage
    from lpcal.view.parallel import cores

    with cores(jobs_of(options.jobs)):
        return run_stage(open_workspace(options), refine.STAGE, progress)
