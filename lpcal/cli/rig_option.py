"""``--rig``: how every command finds its panel.yaml."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lpcal.pipeline.workspace import Workspace


def add_rig_option(parser: argparse.ArgumentParser) -> None:
    """Declare ``--rig``."""
    parser.add_argument("--rig", type=Path, default=Path(), metavar="PANEL", help="panel.yaml or its folder (default: here or above)")


def open_workspace(options: argparse.Namespace, panel: Path | None = None) -> Workspace:
    """The rig that the command is about; `panel` is the command's own word for it."""
    from lpcal.formats.panel_yaml import find, read_rig
    from lpcal.pipeline.workspace import Workspace

    return Workspace(read_rig(find(panel or options.rig)))
