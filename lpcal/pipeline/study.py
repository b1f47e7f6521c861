"""The two experiments of the LightPanel paper, by lpcal's own radiometry and normals.

The error of a normal is relative: the length of ``n_found - n`` for unit normals, per cent. Every pixel of the sphere but for its rim
counts; those that fewer than three lights tell are filled from their neighbours, as a reconstruction does.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.detect.radiometry import to_radiance
from lpcal.errors import DegenerateError
from lpcal.formats.outputs import marked, refuse_place, whole, write_text
from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.sensor import Sensor
from lpcal.report.study_plot import SOFTWARE, Curve, plot_png
from lpcal.simulate.study_sphere import Conditions, capture, ring
from lpcal.surface import normals, pieces, sight
from lpcal.surface.integrate import Grid

PAPER = Conditions()
PLAIN = "plain least squares"
"""How the names of trials without lpcal's own way begin: shadows are taken for shading, as in the paper."""
OWN = "lpcal"
BARE = {"": PAPER, ", noise 1 %": replace(PAPER, noise=0.01), ", to the very rim": replace(PAPER, rim=0.995)}
VARIANTS = {
    **{PLAIN + name: conditions for name, conditions in BARE.items()},
    **{OWN + name: conditions for name, conditions in BARE.items()},
    f"{OWN}, noise 3 %": replace(PAPER, noise=0.03),
    f"{OWN}, 12 bit": replace(PAPER, bits=12),
    f"{OWN}, 4 lights": replace(PAPER, lights=4),
    f"{OWN}, 12 lights": replace(PAPER, lights=12),
}
"""Six lights, 8 bit and no noise where nothing else is said."""
ANGLES = np.array([3, 5, 8, 11, 14, 16, 18, 20, 22, 24, 26, 28, 30, 32, 34, 36, 38, 40, 43, 48, 54, 60, 67, 74, 81, 88], float)
AMBIENT_PEAK = 0.8
"""Where the brightest sample lies without ambient light: room for a fifth of full scale."""
AMBIENT = replace(PAPER, peak=AMBIENT_PEAK, phase_deg=26.0)
TOE = 0.05
AMBIENTS = {
    PLAIN: AMBIENT,
    f"{PLAIN}, nothing shown under {100 * TOE:.0f} %": replace(AMBIENT, toe=TOE),
    f"{PLAIN}, noise 1 %": replace(AMBIENT, noise=0.01),
    OWN: AMBIENT,
    f"{OWN}, nothing shown under {100 * TOE:.0f} %": replace(AMBIENT, toe=TOE),
    f"{OWN}, noise 1 %": replace(AMBIENT, noise=0.01),
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


ACROSS = {"phase-angle": "phase angle, degrees", "ambient": "ambient light on the sphere, of 255"}
"""What is varied, by study: the plot's axis and the first column of the table."""
TABLE = marked("a study's table", *(across.replace(",", "") for across in ACROSS.values()))
PLOT = marked("a study's plot", SOFTWARE)


def study(which: str, folder: Path, progress: Progress) -> Outcome:
    """``phase-angle`` or ``ambient``: table, plot and a sentence, into a folder."""
    table, plot = folder / f"study_{which}.csv", folder / f"study_{which}.png"
    refuse_place(table, TABLE)
    refuse_place(plot, PLOT)
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
    across = ACROSS[which]
    write_text(table, "\n".join(",".join(row) for row in _csv(across, curves)) + "\n", TABLE)
    with whole(plot, PLOT) as draft:
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
    at = {row["name"]: row for row in rows}
    plain, own = at[PLAIN], at[OWN]
    noisy, rim = at[f"{PLAIN}, noise 1 %"], at[f"{PLAIN}, to the very rim"]
    others = ", ".join(f"{row['name'].removeprefix(f'{OWN}, ')} {_range(row)}" for row in rows if row["name"].startswith(f"{OWN}, "))
    return (
        f"Plain least squares, as in the paper, is best with lights {_range(plain)} degrees from the axis "
        f"({plain['mean_percent']:.2f} % mean error; {_range(noisy)} with 1 % of noise; {_range(rim)} where the rim counts too): nearer, "
        "the steps of 8 bits weigh more; wider, shadows reach into the sphere (from 90 degrees less the angle) and are taken for "
        f"shading. By the median, which shadows do not reach, it is {plain['best_by_median']:.0f}. lpcal leaves shadows out, and its "
        f"best is {_range(own)} ({own['mean_percent']:.2f} %); it moves to: {others}"
    )


def _range(row: dict[str, Any]) -> str:
    low, high = row["as_good"]
    return f"{row['best']:.0f} ({low:.0f} to {high:.0f})"


def _ambient_said(rows: list[dict[str, Any]]) -> str:
    parts = []
    for row in rows:
        low, high = row["as_good"]
        told = f"{row['name']}: {row['first_percent']:.2f} % in the dark, as good as any from {low:.0f} to {high:.0f} % ambient"
        parts.append(told + _failure(np.array(row["curve_percent"]), row["mean_percent"]))
    return (
        "; ".join(parts)
        + f". The lights alone reach {100 * AMBIENT_PEAK:.0f} % of full scale, so over {100 - 100 * AMBIENT_PEAK:.0f} % of "
        "ambient light pixels saturate: plain least squares fails there, lpcal leaves them out until three lights are no longer left. "
        "Ambient light that is subtracted adds nothing by itself; a best level such as the paper's 20 % is found with a sensor that shows "
        "nothing of faint light, which ambient light lifts over that"
    )


def _failure(curve: Array, best: float) -> str:
    failed = np.flatnonzero(~(curve < 2 * best))
    failed = failed[failed > np.nanargmin(curve)]
    return f", twice that from {100 * LEVELS[failed[0]]:.0f} %" if len(failed) else ""
