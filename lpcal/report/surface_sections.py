"""The surfaces' section: pictures, each piece's distances, and the figures of the solve."""

from __future__ import annotations

import math
from dataclasses import dataclass

from lpcal.records.figures import SurfaceFigures
from lpcal.records.pictures import data_uri
from lpcal.records.surface import Component, SurfaceSummary
from lpcal.report.rig_report import SurfaceReport
from lpcal.report.wording import NOTHING, fixed, grouped, number, with_sigma

TRACE = 1e-3
"""Least share, of 1, that the page states: below it stands "under 0.1 %", nearer to 1 "over 99.9 %", as odds are not known more finely."""


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
    return SurfaceSection(
        name=surface.name,
        relight=surface.relight,
        pictures=[(what, data_uri(content)) for what, content in surface.pictures.items()],
        pieces=[row for piece in summary.components for row in _piece(piece, metric=summary.metric)],
        notes=summary.notes,
        figures=[row for row in _figures(summary.figures) + _costs(summary) if not row[1].startswith(NOTHING)],
    )


def _piece(piece: Component, *, metric: bool) -> list[tuple[str, str]]:
    """A piece's distance, and each other one that the images allow."""
    label = f"piece {piece.label}, {grouped(piece.pixels)} pixels"
    if not metric:
        return [(label, "relative depth")]
    others = [
        (f"piece {piece.label}, odds of {100 * other.odds:.0f} %", _distance(other.mean_depth_m, other.scale_std))
        for other in piece.alternatives
    ]
    return [(label, _distance(piece.mean_depth_m, piece.scale_std)), *others]


def _distance(depth_m: float, scale_std: float) -> str:
    return with_sigma(1000 * depth_m, 1000 * depth_m * scale_std, "mm")


def _figures(found: SurfaceFigures) -> list[tuple[str, str]]:
    """What the solve says of the surface, in words; a dash where a figure does not apply."""
    lit, gloss = found.pixels_with_three_lights, found.gloss
    return [
        ("odds that the mask is wrong", _share(found.mask_doubt)),
        ("pixels that three lights reach", _share(None if lit is None or not found.pixels else lit / found.pixels)),
        ("lights used, the median pixel", NOTHING if found.median_lights_used is None else f"{found.median_lights_used:g}"),
        ("residual of the images, in sigmas", number(found.residual_sigmas_rms, 2)),
        ("reflectance, the median pixel", fixed(found.reflectance, 2)),
        ("gloss", NOTHING if gloss is None else f"strength {number(gloss.ks, 2)}, roughness {number(gloss.roughness, 2)}"),
        ("normals that look away", _share(found.normals_away_from_the_camera)),
        ("room's light, of the signal", _share(None if found.ambient is None else found.ambient.share_of_signal)),
    ]


def _costs(summary: SurfaceSummary) -> list[tuple[str, str]]:
    """How long it took, and what memory."""
    spent = ", ".join(f"{number(seconds, 2, 's')} {part}" for part, seconds in summary.times_s.items())
    return [("time", spent or NOTHING), ("memory", f"{fixed(summary.peak_memory_mb, 0, 'MB')} at most")]


def _share(share: float | None) -> str:
    """A share in per cent, or how near to nothing or all it is; a dash for none."""
    if share is None or not math.isfinite(share):
        return NOTHING
    if 0 < share < TRACE or 1 - TRACE < share < 1:
        return f"{'under' if share < TRACE else 'over'} {100 * (TRACE if share < TRACE else 1 - TRACE):g} %"
    return number(100 * share, 2, "%")
