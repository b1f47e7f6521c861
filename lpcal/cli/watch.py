"""``lpcal watch``: each new image is judged while one captures, and the next thing said."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.cli.console import complain
from lpcal.errors import InputError, UsageError
from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="the folder that the camera writes to")
    parser.add_argument("--rig", type=Path, metavar="PANEL", help="panel.yaml or its folder (default: FOLDER or above it)")
    parser.add_argument("--port", type=int, default=0, metavar="N", help="of the page on this machine (default: any; -1: no page)")
    parser.add_argument("--idle", type=float, metavar="SECONDS", help="end once nothing has come for so long (default: at Ctrl-C)")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:  # noqa: ARG001 - it has no end to progress to
    """Watch."""
    from lpcal.formats.panel_yaml import find, read_rig
    from lpcal.pipeline.watch import watch

    if options.idle is not None and not options.idle > 0:
        raise UsageError(f"--idle {options.idle}", needed="seconds above 0")
    home = None
    try:
        panel = find(options.rig or options.folder)
        rig, home = read_rig(panel).rig, panel.parent
    except InputError:
        if options.rig is not None or not options.folder.is_dir():
            raise
        rig = None
    return watch(options.folder, rig, complain, home=home, port=None if options.port < 0 else options.port, idle_s=options.idle)
