r"""What a plane with an albedo of its own kind says of pixels: the wall behind an object, the front of its support.

Symbols: plane q foretells the signal ``m_k`` of white (see surface.planes); a pixel of it has ``I_k = rho m_k s_k``, s 1 in the light, 0 in
shadow, between in the penumbra. Its albedo is a smooth trend over the image times the plane's own pattern, a histogram w over bins j::

    p(I | plane) = sum_j w_j prod_k p(r_jk)        r_jk = I_k / (rho_j m_k)
    p(r) = LIT N(r; 1, s) + SHADE N(r; 0, t) + HALF [0 < r < 1] + ODD p(r | other)
    p(r | other) = DIM N(r; 0, t) + (1 - DIM) lognormal(r; 0, BROAD)

So what has the plane's ratios but not its albedo is not the plane, nor what has its albedo but not its ratios; and what is dark in every
light may be either. Models of this form: C. M. Bishop, Pattern Recognition and Machine Learning (2006), 9.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.surface import planes
from lpcal.surface.sight import Sight

LIT, SHADE, HALF, ODD = 0.7, 0.25, 0.04, 0.01
DIM = 0.25
BROAD = 1.0
"""Standard deviation of the logarithm of a signal of anything else by what the plane would send."""
GLOW = 0.04
"""Of the plane's signal: what shadows hold of other light."""
BINS = 16
BIN = 0.08
"""Least width of a bin of log albedo."""
SPAN = 1.6
"""Log albedos about the trend that the histogram covers."""
RARE = 0.01
SPEAK = 4.0
"""So many samples' word a pixel has at most: their errors are alike."""
CERTAIN = 4.0
"""Log likelihood ratio that is full evidence."""
ROUNDS = 8
FEWEST = 60


@dataclass(frozen=True)
class Backdrop:
    """A plane and the albedo of what lies in it."""

    plane: planes.Plane
    trend: Array
    """(6,) of log albedo, see `_powers`."""
    pattern: Array
    """(J,) log albedos about the trend."""
    weight: Array
    """(J,)."""
    std: float
    """Relative, of a sample about the model."""


def backdrop(seen: Sight, m: Array, plane: planes.Plane, claimed: Mask, sure: Mask) -> Backdrop | None:
    """The backdrop whose pixels are `claimed` (P,), `sure` (P,) among them; None where these are too few.

    m (L, P): what the plane foretells at the pixels seen.
    """
    albedo, lit = planes.albedo(seen, m)
    claimed, sure = claimed & lit, sure & lit
    if sure.sum() < FEWEST:
        return None
    level = np.log(np.where(lit, albedo, 1.0))
    powers = _powers(seen.rays_C)
    trend = np.array([np.median(level[sure]), 0, 0, 0, 0, 0])
    for step in range(ROUNDS):
        off = level - powers @ trend
        size = 1.5 * np.median(np.abs(off[sure if step == 0 else claimed])) + 0.02
        root = np.where(claimed, 1 / np.sqrt(1 + (off / (2 * size)) ** 2), 0.0)
        ridge = 1e-3 * np.sqrt(claimed.sum()) * np.diag([0, 0, 0, 1, 1, 1])
        trend = np.linalg.lstsq(np.vstack([root[:, None] * powers, ridge]), np.append(root * level, np.zeros(6)), rcond=None)[0]
    off = (level - powers @ trend)[sure]
    wide = max(BIN, float(np.diff(np.percentile(off, [5, 95]))[0]) / BINS)
    edges = wide * (np.arange(2 * int(SPAN / wide) + 2) - int(SPAN / wide) - 0.5)
    count = np.histogram(off, edges)[0].astype(float)
    weight = count / max(count.sum(), 1.0)
    kept = weight > RARE
    middle = (edges[1:] + edges[:-1])[kept] / 2
    std = float(np.hypot(planes.MODEL * max(1.0, plane.misfit), wide / np.sqrt(12)))
    return Backdrop(plane, trend, middle, weight[kept] / weight[kept].sum(), std)


def evidence(seen: Sight, m: Array, backdrop: Backdrop) -> Array:
    """From -1 (the backdrop explains the pixel) to 1 (it does not) of pixels (P,); 0 where nothing tells."""
    strong, white = planes.strong(seen, m)
    base = np.exp(_powers(seen.rays_C) @ backdrop.trend)
    share = np.minimum(1.0, SPEAK / np.maximum(strong.sum(axis=0), 1))
    log = np.full(seen.pixels, -np.inf)
    for off, weight in zip(backdrop.pattern, backdrop.weight, strict=True):
        full = base * np.exp(off) * white
        told = np.where(strong, _told(seen.signal / full, seen.sigma / full, backdrop.std), 0.0).sum(axis=0)
        log = np.logaddexp(log, np.log(weight) + share * told)
    return np.asarray(np.where(strong.any(axis=0), np.clip(-log / CERTAIN, -1, 1), 0.0))


def _told(r: Array, noise: Array, std: float) -> Array:
    """log p(r | plane) / p(r | other)."""
    dark = _normal(r, 0.0, np.hypot(noise, GLOW))
    positive = np.maximum(r, 1e-3)
    spread = np.hypot(BROAD, noise / positive)
    other = DIM * dark + (1 - DIM) * _normal(np.log(positive), 0.0, spread) / positive * (r > 0)
    half = HALF * ((r > 0) & (r < 1))
    plane = LIT * _normal(r, 1.0, np.hypot(noise, std)) + SHADE * dark + half + ODD * other
    return np.asarray(np.log((plane + 1e-12) / (other + 1e-12)))


def _normal(x: Array, mean: float, std: Array) -> Array:
    return np.asarray(np.exp(-0.5 * ((x - mean) / std) ** 2) / (2.5066 * std))


def _powers(rays_C: Array) -> Array:
    """1, x, y, x^2, xy, y^2 of rays (P, 3): (P, 6)."""
    x, y = rays_C[:, 0], rays_C[:, 1]
    return np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=1)
