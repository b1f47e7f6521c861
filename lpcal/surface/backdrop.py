r"""What a plane with an albedo of its own kind says of pixels: the wall behind an object, the front of its support.

Symbols: plane q foretells the signal ``m_k`` of white (see surface.planes); a pixel of it has ``I_k = rho m_k s_k``, s 1 in the light, 0 in
shadow, between in the penumbra. Its albedo rho is a smooth trend over the image times what the plane shows of a pattern of its own, h::

    r_k = I_k / (rho m_k)
    p(r) = LIT N(r; 1, s) + SHADE N(r; 0, t) + HALF [0 < r < 1] + ODD p(r | other)
    p(r | other) = DIM N(r; 0, t) + (1 - DIM) lognormal(r; 0, BROAD)
    evidence for the plane = max over rho of  sum_k log p(r_k) / p(r_k | other)  +  log h(rho) / even

So what has the plane's ratios but not its albedo is not the plane, nor what has its albedo but not its ratios; and what is dark in every
light may be either. Models of this form: C. M. Bishop, Pattern Recognition and Machine Learning (2006), 9.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.surface import planes
from lpcal.surface.sight import Sight, powers

LIT, SHADE, HALF, ODD = 0.73, 0.25, 0.015, 0.005
DIM = 0.25
BROAD = 1.0
"""Standard deviation of the logarithm of a signal of anything else by what the plane would send."""
GLOW = 0.04
"""Of the plane's signal: what shadows hold of other light."""
MATCH = 0.7
"""Log likelihood ratio of a sample that fits, at most: what faces like the plane fits by chance, and then in several lights."""
SPEAK = 4.0
"""So many samples' word a pixel has at most: their errors are alike."""
CANDIDATES = 6
"""Albedos tried of a pixel, by its samples' own ratios."""
BIN, SPAN = 0.02, 3.0
"""Width of a bin of log albedo, and how far from the trend the histogram goes."""
TAILS, WIDER = 0.05, 3.0
"""Share of a plane's albedos that spread so many times as wide as those seen."""
SAME, OTHER = 1.5, 6.0
"""Log likelihood ratio of an albedo at most, for the plane and against it."""
DARK = 0.13
"""A pixel of less than this share of the plane's albedo may be in shadow by every light."""
CERTAIN = 3.0
"""Log likelihood ratio that is full evidence."""
ROUNDS = 8
FEWEST = 60


@dataclass(frozen=True)
class Backdrop:
    """A plane and the albedo of what lies in it."""

    plane: planes.Plane
    trend: Array
    """(6,) of log albedo, see `sight.powers`."""
    pattern: Array
    """(J,) log likelihood ratio of log albedos from -SPAN to SPAN about the trend, BIN apart."""
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
    terms = powers(seen.rays_C[:, :2])
    trend = np.array([np.median(level[sure]), 0, 0, 0, 0, 0])
    for step in range(ROUNDS):
        off = level - terms @ trend
        size = 1.5 * np.median(np.abs(off[sure if step == 0 else claimed])) + 0.02
        root = np.where(claimed, 1 / np.sqrt(1 + (off / (2 * size)) ** 2), 0.0)
        ridge = 1e-3 * np.sqrt(claimed.sum()) * np.diag([0, 0, 0, 1, 1, 1])
        trend = np.linalg.lstsq(np.vstack([root[:, None] * terms, ridge]), np.append(root * level, np.zeros(6)), rcond=None)[0]
    return Backdrop(plane, trend, _pattern((level - terms @ trend)[sure]), planes.MODEL * max(1.0, plane.misfit))


def _pattern(off: Array) -> Array:
    """Log likelihood ratio (J,) of albedos, that of anything else evenly spread."""
    from scipy import ndimage

    edges = BIN * (np.arange(2 * round(SPAN / BIN) + 2) - round(SPAN / BIN) - 0.5)
    count = np.histogram(off, edges)[0].astype(float)
    spread = 0.741 * float(np.diff(np.percentile(off, [25, 75]))[0]) + BIN
    seen = ndimage.gaussian_filter1d(count, 0.5 * spread / BIN)
    tails = ndimage.gaussian_filter1d(count, WIDER * spread / BIN)
    share = ((1 - TAILS) * seen + TAILS * tails) / max(count.sum(), 1.0)
    return np.asarray(np.clip(np.log(share * len(count) + 1e-9), -OTHER, SAME))


def evidence(seen: Sight, m: Array, backdrop: Backdrop) -> Array:
    """From -1 (the backdrop explains the pixel) to 1 (it does not) of pixels (P,); 0 where nothing tells."""
    strong, white = planes.strong(seen, m)
    ratio, noise = np.where(strong, seen.signal / white, 0.0), np.maximum(seen.sigma / white, 1e-9)
    ranked = np.sort(ratio, axis=0)[::-1]
    fits, albedo = np.full(seen.pixels, -np.inf), np.ones(seen.pixels)
    for rank in np.unique(np.linspace(0, 0.7 * (len(m) - 1), CANDIDATES).astype(int)):
        rho = np.maximum(ranked[rank], 1e-9)
        told = np.where(strong, _told(ratio / rho, noise / rho, backdrop.std), 0.0)
        weight = (told > 0) & (ratio > 0.5 * rho)
        better = told.sum(axis=0) > fits
        mean = np.sum(weight * ratio / noise**2, axis=0) / np.maximum(np.sum(weight / noise**2, axis=0), 1e-30)
        fits = np.where(better, told.sum(axis=0), fits)
        albedo = np.where(better & weight.any(axis=0), mean, np.where(better, rho, albedo))
    share = np.minimum(1.0, SPEAK / np.maximum(strong.sum(axis=0), 1))
    off = np.log(np.maximum(albedo, 1e-9)) - powers(seen.rays_C[:, :2]) @ backdrop.trend
    place = np.clip(np.rint(off / BIN) + len(backdrop.pattern) // 2, 0, len(backdrop.pattern) - 1).astype(int)
    log = np.where(off < np.log(DARK), 0.0, share * (fits - MATCH) + backdrop.pattern[place])
    return np.asarray(np.where(strong.any(axis=0), np.clip(-log / CERTAIN, -1, 1), 0.0))


def _told(r: Array, noise: Array, std: float) -> Array:
    """log p(r | plane) / p(r | other)."""
    dark = _normal(r, 0.0, np.hypot(noise, GLOW))
    positive = np.maximum(r, 1e-3)
    spread = np.hypot(BROAD, noise / positive)
    other = DIM * dark + (1 - DIM) * _normal(np.log(positive), 0.0, spread) / positive * (r > 0)
    half = HALF * ((r > 0) & (r < 1))
    plane = LIT * _normal(r, 1.0, np.hypot(noise, std)) + SHADE * dark + half + ODD * other
    return np.asarray(np.minimum(np.log((plane + 1e-12) / (other + 1e-12)), MATCH))


def _normal(x: Array, mean: float, std: Array) -> Array:
    return np.asarray(np.exp(-0.5 * ((x - mean) / std) ** 2) / (2.5066 * std))
