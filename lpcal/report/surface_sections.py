"""The surfaces' section: pictures, each piece's distances, and the figures of the solve."""

from __future__ import annotations

from dataclasses import dataclass, fields

from lpcal.records.pictures import data_uri
from lpcal.records.surface import Component
from lpcal.report.rig_report import SurfaceReport
from lpcal.report.wording import with_sigma

FIGURES_SHOWN = 16
"""Figures of a surface that the page shows: a table of one screen."""


@dataclass(frozen=True)
class SurfaceSection:
    """A surface: its pictures as data: URIs, its pieces' distances, its figures and notes on it."""

    name: str
    relight: str | None
    pictures: list[tuple[str, str]]
    pieces: list[tuple[str, str]]
    notes: tuple[str, ...]
    figures: list[tuple[str, str]]


def surface_section(surface: SurfaceReport) -> SurfaceSection:
    """What the page shows of a surface."""
    summary = surface.summary
    figures = [
        *((field.name, getattr(summary.figures, field.name)) for field in fields(summary.figures)),
        *((f"{part}, s", seconds) for part, seconds in summary.times_s.items()),
        ("peak memory, MB", summary.peak_memory_mb),
    ]
    return SurfaceSection(
        name=surface.name,
        relight=surface.relight,
        pictures=[(what, data_uri(content)) for what, content in surface.pictures.items()],
        pieces=[row for piece in summary.components for row in _piece(piece, metric=summary.metric)],
        notes=summary.notes,
        figures=[(label.replace("_", " "), _figure(value)) for label, value in figures if _is_figure(value)][:FIGURES_SHOWN],
    )


def _piece(piece: Component, *, metric: bool) -> list[tuple[str, str]]:
    """A piece's distance, and each other one that the images allow."""
    label = f"piece {piece.label}, {piece.pixels} pixels"
    if not metric:
        return [(label, "relative depth")]
    others = [
        (f"piece {piece.label}, odds of {100 * other.odds:.0f} %", _distance(other.mean_depth_m, other.scale_std))
        for other in piece.alternatives
    ]
    return [(label, _distance(piece.mean_depth_m, piece.scale_std)), *others]


def _distance(depth_m: float, scale_std: float) -> str:
    return with_sigma(1000 * depth_m, 1000 * depth_m * scale_std, "mm")


def _is_figure(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _figure(value: float) -> str:
    return str(int(value)) if float(value).is_integer() else f"{value:.4g}"
