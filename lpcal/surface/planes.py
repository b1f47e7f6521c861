r"""Planes, placed by near light.

Symbols: a plane is q (3,) with ``q . x = 1`` for its points x, so a ray r meets it at depth ``z = 1 / (q . r)``; its normal is -q / abs(q).
Light k would give a white plane the signal ``m_k = E_k(x) (n . d_k)``; a pixel of albedo rho on it has ``I_k = rho m_k`` unless it lies in
shadow. Near light alone places the plane: E and d change with x. Robust least squares over q, the albedo free at every pixel.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.records.calibration import Light
from lpcal.surface.sight import Sight, light_vectors

MODEL = 0.03
"""Share of a signal that a plane's model may lack: light from elsewhere, ripples of the lobe."""
SHADE = 0.5
"""A signal under this share of what the second highest predicts is in shadow."""
WEAK = 0.1
"""A light that brings less than this share of what the strongest brings to a pixel is left out there: its lobe's tail."""
FIT_PIXELS = 700
SPAN = (0.55, 3.5)
"""Nearest and furthest planes that are tried, as shares of the working distance."""
TRIED = 3
SHADE_PRICE = 3.0
"""Sigmas that a sample costs which a plane takes for shadow: else one that fits nothing is as good as one that fits all."""
BEHIND = 1e-3
TRUSTED = 4.0
"""Misfit of a pixel under which the plane is believed there."""


@dataclass(frozen=True)
class Plane:
    """A plane and how well it fits the pixels that it was fitted to."""

    q: Array
    misfit: float
    """Root of the median of the pixels' mean square residuals."""


def predicted(q: Array, rays_C: Array, lights: Sequence[Light]) -> Array:
    """Signals m (L, P) of a white plane along rays (P, 3); NaN where a ray misses it."""
    slope = rays_C @ q
    depth = np.where(slope > BEHIND, 1 / np.maximum(slope, BEHIND), np.nan)
    d, E = light_vectors(lights, np.nan_to_num(depth, nan=1.0)[:, None] * rays_C)
    shading = E * np.maximum(d @ (-q / np.linalg.norm(q)), 0.0)
    return np.where(np.isfinite(depth), shading, np.nan)


def residuals(seen: Sight, m: Array, *, shaded: bool) -> tuple[Array, Array]:
    """Residuals (L, P) in sigmas, 0 for samples in shadow or saturated, and the number (P,) of samples that count; pixels that miss: inf.

    `shaded`: shadow may lie on most of the samples of a pixel, else on fewer than half.
    """
    hit, albedo, counted, white = _fitted(seen, m, shaded=shaded)
    spread = np.sqrt(seen.sigma**2 + (MODEL * seen.signal) ** 2)
    r = np.where(counted, (seen.signal - albedo * white) / spread, 0.0)
    return np.where(hit, r, np.inf), np.asarray(counted.sum(axis=0), float)


def strong(seen: Sight, m: Array) -> tuple[Mask, Array]:
    """The samples (L, P) by which a plane is judged, and m with 1 where a ray misses the plane."""
    hit = _hit(m)
    white = np.where(hit, m, 1.0)
    return seen.usable & hit & (white > WEAK * white.max(axis=0)), white


def _hit(m: Array) -> Mask:
    """Where (P,) rays meet the plane and some light."""
    return np.asarray(np.isfinite(m).all(axis=0) & (m > 0).any(axis=0))


def _fitted(seen: Sight, m: Array, *, shaded: bool) -> tuple[Mask, Array, Mask, Array]:
    """Where rays hit the plane (P,), albedo (P,), the samples (L, P) that it rests on, and m (L, P)."""
    sound, white = strong(seen, m)
    ratio = np.where(sound, seen.signal / np.maximum(white, 1e-9), -np.inf)
    ranked = np.sort(ratio, axis=0)
    middle = len(m) - 1 - np.maximum(sound.sum(axis=0) - 1, 0) // 2
    high = ranked[-2] if shaded else np.take_along_axis(ranked, middle[None], axis=0)[0]
    counted = sound & (ratio > SHADE * high)
    weight = counted / (seen.sigma**2 + (MODEL * seen.signal) ** 2)
    found = np.sum(weight * white * seen.signal, axis=0) / np.maximum(np.sum(weight * white**2, axis=0), 1e-30)
    return _hit(m), found, counted, white


def misfit(seen: Sight, m: Array, *, shaded: bool = True) -> tuple[Array, Array]:
    """Mean square residual a degree of freedom (P,) of pixels against a plane's m, inf where fewer than two samples count; their number."""
    r, count = residuals(seen, m, shaded=shaded)
    return np.where(count >= 2, np.sum(r**2, axis=0) / np.maximum(count - 1, 1), np.inf), count


def fit(seen: Sight, lights: Sequence[Light], distance_m: float) -> Plane | None:
    """The plane that most of the pixels lie in; None where they are too few."""
    from scipy import optimize

    if seen.pixels < 30:
        return None
    some = thinned(seen)
    fewer = some.at(np.arange(0, some.pixels, 3))

    def cost(q: Array) -> Array:
        r, _ = residuals(some, predicted(q, some.rays_C, lights), shaded=False)
        return np.nan_to_num(r, posinf=1e2).ravel()

    def robust(q: Array) -> float:
        m = predicted(q, fewer.rays_C, lights)
        r, _ = residuals(fewer, m, shaded=False)
        shade = (r == 0) & strong(fewer, m)[0]
        return float(np.sum(np.log1p(np.where(shade, SHADE_PRICE, np.nan_to_num(r, posinf=1e2)) ** 2)))

    nearest, furthest = SPAN
    starts = [np.array([0.0, 0.0, 1 / (distance_m * share)]) for share in np.geomspace(nearest, furthest, 14)]
    best = sorted(starts, key=robust)[:TRIED]
    q = min((np.asarray(optimize.least_squares(cost, q, loss="cauchy", max_nfev=6).x) for q in best), key=robust)
    q = np.asarray(optimize.least_squares(cost, q, loss="cauchy", max_nfev=25).x)
    return Plane(q, float(np.sqrt(np.median(misfit(some, predicted(q, some.rays_C, lights), shaded=False)[0]))))


def thinned(seen: Sight) -> Sight:
    """Every so many pixels, FIT_PIXELS at most."""
    return seen.at(np.arange(0, seen.pixels, max(1, seen.pixels // FIT_PIXELS)))
