"""``--rig``: how every command finds its panel.yaml."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from lpcal.cli.console import complain
from lpcal.errors import UsageError

if TYPE_CHECKING:
    from lpcal.pipeline.workspace import Workspace


def add_rig_option(parser: argparse.ArgumentParser) -> None:
    """Declare ``--rig``."""
    parser.add_argument("--rig", type=Path, default=Path(), metavar="PANEL", help="panel.yaml or its folder (default: here or above)")


def open_workspace(options: argparse.Namespace, panel: Path | None = None) -> Workspace:
    """The rig that the command is about, for it alone until it is done; `panel` is the command's own word for it."""
    from lpcal.formats.outputs import alone_in, recover
    from lpcal.formats.panel_yaml import find, read_rig
    from lpcal.pipeline.workspace import Workspace

    def waiting() -> None:
        complain(f"another lpcal command is at work in {workspace.folder}; waiting for its end")

    workspace = Workspace(read_rig(find(panel or options.rig)))
    options.until_done.enter_context(alone_in(workspace.folder, waiting))
    for folder in (workspace.folder, workspace.folder / "calib", workspace.folder / "calib" / ".cache", workspace.folder / "surfaces"):
        recover(folder)
    return workspace


def length(text: str | None, option: str = "--distance") -> float | None:
    """Metres of an option's word such as 352mm, over zero; None where there is none.

    Raises
    ------
    UsageError
        It is no length, or not over zero.
    """
    from lpcal.records.quantities import parse

    if text is None:
        return None
    try:
        found = parse(text, "length")
    except ValueError as error:
        raise UsageError(str(error), where=option, needed="a length such as 352mm") from error
    if found <= 0:
        raise UsageError(f"{text} is not over zero", where=option, needed="a length such as 352mm")
    return found
