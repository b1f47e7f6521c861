"""surfaces.html beside the folders of many surfaces: one line a capture, worst first.

It has a module of its own, which asks for next to nothing: whoever reconstructs imports it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from lpcal.report.templates import environment
from lpcal.report.wording import grouped

COLLECTION_MARK = '<meta name="lpcal-page" content="surfaces">'
"""What marks the page as lpcal's."""
FAIR = 0.2
"""Odds of being wrong from which a surface is marked: one in five is looked at."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """One capture: what stands in the table, by column, and a small picture; None where a figure does not apply."""

    name: str
    state: str
    """done | up to date | failed | lost."""
    doubt: float
    """Odds (0..1) that it is wrong; 1 where there is no surface."""
    pixels: int | None = None
    pieces: int | None = None
    distance_mm: float | None = None
    distance_std_mm: float | None = None
    other_distance_odds: float | None = None
    mask_doubt: float | None = None
    normal_std_deg: float | None = None
    residual_sigmas: float | None = None
    solving_s: float | None = None
    peak_memory_mb: float | None = None
    folder: str = ""
    notes: str = ""
    error: str = ""
    picture: str | None = None
    """As a data: URI, where there is a surface; not in the table."""

    @property
    def tone(self) -> str:
        """How it is marked."""
        return "poor" if self.picture is None and self.error else "fair" if self.doubt >= FAIR else "good"


def collection_html(name: str, rows: Sequence[Row]) -> str:
    """The page."""
    counts = {state: sum(row.state == state for row in rows) for state in ("done", "up to date", "failed", "lost")}
    said = ", ".join(f"{count} {state}" for state, count in counts.items() if count)
    doubtful = sum(row.tone == "fair" for row in rows)
    return (
        environment()
        .get_template("collection.html")
        .render(mark=COLLECTION_MARK, name=name, rows=rows, said=said, doubtful=doubtful, grouped=grouped)
    )
