r"""What a motion-capture system makes of a moving body.

Symbols: H_OP the true pose, xi a twist of coloured and white noise, m_P the markers on the body::

    reported H_OP = H_OP exp(xi(t))        xi: a first-order Markov process plus white noise
    swapped       = H_OP H_flip            H_flip fits the body's markers to themselves in another order

The fit of the swapped markers leaves a residual, which is the mean marker error that such systems report. Source: the least-squares fit of
two point sets, Kabsch (1976).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice, permutations

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.simulate.built import Built
from lpcal.simulate.motion import Session
from lpcal.simulate.recipe import Recipe, Tracking

FLIP_RAD = np.radians(10)
MOST_ORDERS = 5040


@dataclass(frozen=True)
class Recording:
    """The stream as a mocap system exports it; lost samples are NaN."""

    t_s: Array
    H_OP: Array
    error_m: Array
    markers_O: dict[str, Array]
    bad_stations: tuple[tuple[int, str], ...]
    """Index and reason of stations whose pose is wrong or missing."""


def record(built: Built, session: Session, recipe: Recipe) -> Recording:
    """The stream of a session: noisy, with gaps, and with the markers swapped for some of the time."""
    rng = np.random.default_rng([recipe.seed, 3])
    tracking, t_s = recipe.tracking, session.t_s
    lost, flipped, bad = _failures(session, tracking, rng)
    marker_P = np.array(list(built.markers_P.values()))
    H_flip, flip_error_m = swapped_fit(marker_P)
    H_OP = session.H_OP.copy()
    H_OP[flipped] = H_OP[flipped] @ H_flip
    H_OP = H_OP @ se3.exp(_noise(len(t_s), tracking, rng))
    error_m = np.where(flipped, flip_error_m, 0.0001) * rng.uniform(0.85, 1.15, len(t_s))
    markers_O = se3.apply(H_OP, marker_P) + tracking.marker_m * rng.standard_normal((len(t_s), len(marker_P), 3))
    H_OP[lost], error_m[lost], markers_O[lost] = np.nan, np.nan, np.nan
    named = {name: markers_O[:, k] for k, name in enumerate(built.markers_P)}
    return Recording(t_s, H_OP, error_m, named, bad)


def swapped_fit(marker_P: Array) -> tuple[Array, float]:
    """H_flip (4, 4) of a body whose markers are taken for each other, and its mean marker error.

    Of all orders of the markers the one that fits best and yet turns the body by more than 10 degrees: what a tracker falls for.
    """
    best: tuple[float, Array] = (np.inf, np.eye(4))
    for order in islice(permutations(range(len(marker_P))), MOST_ORDERS):
        taken = marker_P[list(order)]
        a, b = marker_P - marker_P.mean(axis=0), taken - taken.mean(axis=0)
        R = se3.nearest_rotation(b.T @ a)
        H = se3.transform(R, taken.mean(axis=0) - R @ marker_P.mean(axis=0))
        error = float(np.mean(np.linalg.norm(se3.apply(H, marker_P) - taken, axis=1)))
        if error < best[0] and float(se3.angle_rad(R)) > FLIP_RAD:
            best = error, H
    return best[1], best[0] if np.isfinite(best[0]) else 0.0


def _failures(session: Session, tracking: Tracking, rng: np.random.Generator) -> tuple[Mask, Mask, tuple[tuple[int, str], ...]]:
    """Samples that are lost, samples that are flipped, and what that does to the stations."""
    t_s, count = session.t_s, len(session.dwells_s)
    lost, flipped = np.zeros(len(t_s), bool), np.zeros(len(t_s), bool)
    picked = rng.choice(count, min(count // 4, tracking.flipped_stations + tracking.lost_stations), replace=False)
    bad = []
    for order, station in enumerate(picked):
        begin, end = session.dwells_s[station] + [-0.05, 0.05]
        inside = (t_s >= begin) & (t_s <= end)
        if order < tracking.flipped_stations:
            flipped |= inside
            bad.append((int(station), "flipped: markers swapped"))
        else:
            lost |= inside
            bad.append((int(station), "missing: the body was lost"))
    for _ in range(3):  # brief failures while the panel moves from one station to the next
        leg = int(rng.integers(count - 1)) if count > 1 else 0
        middle = session.dwells_s[leg, 1] + 0.18
        lost |= np.abs(t_s - middle) < rng.uniform(0.02, 0.08)
    if len(session.sweep_s) > 8:
        moments = rng.choice(session.sweep_s, 2, replace=False)
        lost |= np.abs(t_s - moments[0]) < 0.06
        flipped |= np.abs(t_s - moments[1]) < 0.06
    return lost, flipped & ~lost, tuple(sorted(bad))


def _noise(count: int, tracking: Tracking, rng: np.random.Generator) -> Array:
    """Twists (count, 6) of coloured and white noise: ``c[k] - keep c[k-1] = sqrt(1 - keep^2) w[k]``, w white."""
    from scipy.linalg import solve_banded

    keep = np.exp(-1 / (tracking.rate_hz * tracking.correlation_s))
    white = np.sqrt(1 - keep**2) * rng.standard_normal((count + 2000, 6))
    coloured = solve_banded((1, 0), np.stack([np.ones(len(white)), np.full(len(white), -keep)]), white)[2000:]
    coloured *= [tracking.coloured_rad] * 3 + [tracking.coloured_m] * 3
    return np.asarray(coloured + rng.standard_normal((count, 6)) * ([tracking.white_rad] * 3 + [tracking.white_m] * 3))
