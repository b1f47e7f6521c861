"""The page of ``lpcal watch``: what was judged, what comes next; it asks for the state once a second."""

from __future__ import annotations

from typing import Any

from lpcal.report.page import script_json
from lpcal.report.templates import environment


def render(state: dict[str, Any]) -> str:
    """The page."""
    return environment().get_template("watch.html").render(state=script_json(state))
