"""The two experiments of the LightPanel paper, by lpcal's own radiometry and normals.

The error of a normal is relative: the length of ``n_found - n`` for unit normals, per cent. Every pixel of the sphere counts; those that
fewer than three lights tell are filled from their neighbours, as a reconstruction does.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.errors import DegenerateError
from lpcal.formats.documents import whole, write_text
from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array
from lpcal.records.outcome import Outcome, Progress
from lpcal.report.study_plot import Curve, plot_png
from lpcal.simulate.study_sphere import Conditions, capture, ring
from lpcal.surface import normals, pieces, sight
from lpcal.surface.integrate import Grid

PAPER = Conditions()
PLAIN = "plain least squares"
"""How the names of trials without lpcal's own way begin: shadows are taken for shading."""
VARIANTS = {
    "6 lights, 8 bit, no noise": PAPER,
    PLAIN: PAPER,
    f"{PLAIN}, noise 1 %": replace(PAPER, noise=0.01),
    "noise 1 %": replace(PAPER, noise=0.01),
    "noise 3 %": replace(PAPER, noise=0.03),
    "12 bit": replace(PAPER, bits=12),
    "4 lights": replace(PAPER, lights=4),
    "12 lights": replace(PAPER, lights=12),
}
ANGLES = np.array([3, 5, 8, 11, 14, 17, 20, 23, 26, 30, 34, 38, 43, 48, 54, 60, 67, 74, 81, 88], float)
AMBIENT_PEAK = 0.6
"""Where the brightest sample lies without ambient light, so that there is room for it."""
AMBIENTS = {
    "6 lights, 8 bit, no noise": replace(PAPER, peak=AMBIENT_PEAK),
    PLAIN: replace(PAPER, peak=AMBIENT_PEAK),
    "noise 1 %": replace(PAPER, peak=AMBIENT_PEAK, noise=0.01),
}
LEVELS = np.linspace(0, 1, 21)
FLAT = 1.1
"""Angles or levels whose error is within this factor of the least are as good."""


@dataclass(frozen=True)
class Trial:
    """Errors of one trial, per cent; NaN where nothing could be found."""

    mean: float
    median: float


def trial(conditions: Conditions, seed: int = 0, *, plain: bool = False) -> Trial:
    """One capture, its normals, their errors; `plain`: by least squares on all samples, as papers do."""
    try:
        raw, truth, mask = capture(conditions, seed)
        radiance = to_radiance(raw, Sensor())
    except DegenerateError:
        return Trial(float("nan"), float("nan"))
    lights = ring(conditions)
    seen = sight.look_at(sight.grey(radiance, lights), sight.ray_map(mask.shape, None), mask, central=False)
    d, E = sight.light_vectors(lights, seen.rays_C, np.array([0.0, 0.0, 1.0]))
    B = d * E[..., None]
    b = (
        lambert.weighted(B, seen.signal, np.ones(seen.signal.shape))[0]
        if plain
        else normals.estimate(seen, B, normals.candidates(seen, E), normals.variances(seen)).b
    )
    known = np.isfinite(b[:, 0])
    if not known.any():
        return Trial(float("nan"), float("nan"))
    n = lambert.unit(pieces.fill(Grid.of(mask), lambert.unit(b)[0], known))[0]
    error = 100 * np.linalg.norm(n - truth[mask], axis=1)
    return Trial(float(error.mean()), float(np.median(error)))


def study(which: str, folder: Path, progress: Progress) -> Outcome:
    """``phase-angle`` or ``ambient``: table, plot and a sentence, into a folder."""
    swept = which == "phase-angle"
    variants, places = (VARIANTS, ANGLES) if swept else (AMBIENTS, LEVELS)
    curves, rows = [], []
    for number, (name, conditions) in enumerate(variants.items()):
        at = [replace(conditions, phase_deg=float(x)) if swept else replace(conditions, ambient=float(x)) for x in places]
        trials = [trial(one, plain=name.startswith(PLAIN)) for one in at]
        mean = np.array([one.mean for one in trials])
        median = np.array([one.median for one in trials])
        curves.append(Curve(name, places if swept else 255 * places, mean))
        rows.append(_row(name, places if swept else 100 * places, mean, median))
        progress(f"study {which}", number + 1, len(variants))
    lines = [f"{'x':>8} " + "".join(f"{curve.name[:24]:>26}" for curve in curves)]
    lines += [f"{curves[0].x[k]:8.1f} " + "".join(f"{curve.y[k]:26.3f}" for curve in curves) for k in range(len(places))]
    across = "phase angle, degrees" if swept else "ambient light on the sphere, of 255"
    table = folder / f"study_{which}.csv"
    write_text(table, "\n".join(",".join(row) for row in _csv(across, curves)) + "\n")
    plot = folder / f"study_{which}.png"
    with whole(plot) as draft:
        draft.write_bytes(plot_png(curves, across))
    said = _phase_said(rows) if swept else _ambient_said(rows)
    return Outcome([*lines, said, f"written {table}, {plot}"], {"study": which, "rows": rows, "says": said})


def _row(name: str, x: Array, mean: Array, median: Array) -> dict[str, Any]:
    k = int(np.nanargmin(mean))
    good = np.flatnonzero(mean <= FLAT * mean[k])
    return {
        "name": name,
        "best": float(x[k]),
        "as_good": [float(x[good[0]]), float(x[good[-1]])],
        "mean_percent": float(mean[k]),
        "best_by_median": float(x[int(np.nanargmin(median))]),
        "first_percent": float(mean[0]),
        "curve_percent": [float(value) for value in mean],
    }


def _csv(across: str, curves: list[Curve]) -> list[list[str]]:
    head = [across.replace(",", ""), *(curve.name.replace(",", "") for curve in curves)]
    return [head, *([f"{curves[0].x[k]:g}", *(f"{curve.y[k]:.4f}" for curve in curves)] for k in range(len(curves[0].x)))]


def _phase_said(rows: list[dict[str, Any]]) -> str:
    own, plain, *others = rows
    low, high = own["as_good"]
    return (
        f"lpcal's normals are best at {own['best']:.0f} degrees ({own['mean_percent']:.2f} %), within a tenth of that from {low:.0f} to "
        f"{high:.0f}; plain least squares, which takes shadows for shading, at {plain['best']:.0f} ({plain['mean_percent']:.2f} %): "
        "shadows left out, lights may stand wider. It moves to: " + ", ".join(f"{row['name']} {row['best']:.0f}" for row in others)
    )


def _ambient_said(rows: list[dict[str, Any]]) -> str:
    parts = [
        f"{row['name']}: {row['first_percent']:.2f} % in the dark, "
        + ("as good" if row["first_percent"] <= FLAT * row["mean_percent"] else f"{row['mean_percent']:.2f} %")
        + f" at {row['best']:.0f} % ambient"
        + _failure(np.array(row["curve_percent"]), row["first_percent"])
        for row in rows
    ]
    return (
        "; ".join(parts) + f". The lights alone reach {100 * AMBIENT_PEAK:.0f} % of full scale: over {100 - 100 * AMBIENT_PEAK:.0f} % of "
        "ambient light pixels saturate; lpcal leaves those out, which helps until three lights are no longer left"
    )


def _failure(curve: Array, dark: float) -> str:
    failed = np.flatnonzero(~(curve < 2 * dark))
    return f", twice that of the dark from {100 * LEVELS[failed[0]]:.0f} %" if len(failed) else ""
