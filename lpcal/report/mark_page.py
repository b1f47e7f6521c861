"""The page of `lpcal mark`: one file that talks to the command that serves it, and to nothing else."""

from __future__ import annotations

from typing import Any

from lpcal import __version__
from lpcal.report.page import script_json
from lpcal.report.templates import environment


def mark_html(document: dict[str, Any], token: str) -> str:
    """The page of a capture, as `document` tells of it."""
    template = environment().get_template("mark.html")
    return template.render(document=script_json({**document, "token": token}), about=document, version=__version__)
