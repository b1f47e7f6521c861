"""``lpcal mark``: a sphere, a mask, a board's corners or the lights' images set by mouse, where they are not found automatically."""

from __future__ import annotations

import argparse
import webbrowser
from pathlib import Path

from lpcal.cli.console import complain
from lpcal.errors import InputError
from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("capture", type=Path, metavar="CAPTURE", help="the folder of a capture, or of a sphere's images")
    parser.add_argument("--rig", type=Path, metavar="PANEL", help="panel.yaml or its folder (default: CAPTURE or above it)")
    parser.add_argument("--port", type=int, default=0, metavar="N", help="of the page on this machine (default: any)")
    parser.add_argument("--no-browser", action="store_true", help="print the page's address and open no browser")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:  # noqa: ARG001 - it has no end to progress to
    """Mark."""
    from lpcal.formats.panel_yaml import find, read_rig
    from lpcal.pipeline.mark import mark

    try:
        rig = read_rig(find(options.rig or options.capture))
    except InputError:
        if (
            options.rig is not None
            or not options.capture.is_dir()
            or any((up / "panel.yaml").is_file() for up in options.capture.resolve().parents)
        ):
            raise
        rig = None
    return mark(options.capture, rig, complain, port=options.port, browse=None if options.no_browser else webbrowser.open)
