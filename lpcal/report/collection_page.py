"""surfaces.html: many surfaces on one page, worst first; one file that opens offline beside the surfaces' folders."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from lpcal.report.templates import environment

MARK = '<meta name="lpcal-page" content="surfaces">'
"""What tells the page from one of anybody else's."""
FAIR = 0.2
"""Odds of being wrong from which a surface is marked: one in five is looked at."""


@dataclass(frozen=True)
class Row:
    """One capture: its cells by column, and a small picture as a data: URI, where there is a surface."""

    cells: dict[str, Any]
    picture: str | None = None

    @property
    def name(self) -> str:
        """The capture's name."""
        return str(self.cells["name"])

    @property
    def doubt(self) -> float:
        """Odds (0..1) that it is wrong; 1 where there is no surface."""
        return float(self.cells["doubt"])

    @property
    def tone(self) -> str:
        """How it is marked."""
        return "poor" if self.picture is None and self.cells["error"] else "fair" if self.doubt >= FAIR else "good"


def render(name: str, rows: Sequence[Row]) -> str:
    """The page."""
    counts = {state: sum(row.cells["state"] == state for row in rows) for state in ("done", "up to date", "failed", "lost")}
    said = ", ".join(f"{count} {state}" for state, count in counts.items() if count)
    doubtful = sum(row.tone == "fair" for row in rows)
    return environment().get_template("collection.html").render(mark=MARK, name=name, rows=rows, said=said, doubtful=doubtful)
