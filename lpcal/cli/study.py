"""``lpcal study``: the two experiments of the LightPanel paper, table and plot."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("which", choices=("phase-angle", "ambient"), help="what is varied: the lights' angle, or the ambient light")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="DIR", help="where table and plot go (default: here)")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Do it."""
    from lpcal.pipeline.study import write_study

    return write_study(options.which, options.output, progress)
