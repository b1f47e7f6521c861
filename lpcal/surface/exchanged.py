r"""Which light each image is of, by the surface that most of the images agree on: two cables, files or lines of a list exchanged.

Symbols: signal I_i of image i, light vectors B_j of light j, the surface's b. What image i misses by, taken for light j, is::

    m_ij = median over the pixels of |I_i - B_j b / h|, over that of I_i        h = median of B_j b / I_i

with h for a lamp's power, which is not of its place; the images' lights are the assignment of least ``sum log m``, the likeliest where
each image has noise of its own size. The robust solve leaves the samples of two exchanged lights of a dozen out, so that b is right and
nothing else shows it.
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.surface.sight import Lit, vectors

LIGHTS_NEEDED = 6
"""Lights from which two that are exchanged leave four that agree on a surface."""
MOST_PIXELS = 3000
"""Pixels that are looked at, spread over the object."""
FEW_PIXELS, MOST_PAIRS = 800, 3_000_000
"""Pixels that are looked at where the lights are many, and how many pairs of lights at pixels: each image is held against every light."""
FEWEST_PIXELS = 50
"""Pixels of a half of the object from which its median is one."""
NEEDED = 2.0
"""By what factor the misses of images that change places must fall at least, in the geometric mean and in every half of the object: what
the model lacks of a light's own image (gloss, shadows, interreflection) makes another light fit it as well, never twice as well."""


def exchanged(signal: Array, light: Lit | Array, b: Array, usable: Mask) -> dict[int, int]:
    """The light that each image fits, of those that fit another one than their own; empty where all fit their own, or it is not clear.

    Parameters
    ----------
    signal : (L, P), the gloss taken off
    light : the light, or its vectors (L, P, 3)
    b : (P, 3), NaN where it is not known
    usable : (L, P) where the signal is not saturated
    """
    if len(signal) < LIGHTS_NEEDED:
        return {}
    known = np.flatnonzero(np.isfinite(b[:, 0]))
    if len(known) < 2 * FEWEST_PIXELS:
        return {}
    most = min(MOST_PIXELS, max(FEW_PIXELS, MOST_PAIRS // len(signal) ** 2), len(known))
    some = known[np.unique(np.linspace(0, len(known) - 1, most).astype(int))]
    side = b[some] / np.maximum(np.linalg.norm(b[some], axis=1, keepdims=True), 1e-300)
    halves = [above for axis in range(2) for above in (side[:, axis] > np.median(side[:, axis]), side[:, axis] <= np.median(side[:, axis]))]
    if any(half.sum() < FEWEST_PIXELS for half in halves):
        return {}
    B = vectors(light, some)
    miss = np.stack([_misses(signal[:, some], B, b[some], usable[:, some], half) for half in halves])
    total = miss.sum(axis=0)
    if np.array_equal(np.argmin(total, axis=1), np.arange(len(total))):
        return {}  # each fits its own best
    from scipy.optimize import linear_sum_assignment

    _, best = linear_sum_assignment(total)
    moved = np.flatnonzero(best != np.arange(len(best)))
    if not moved.size:
        return {}
    gain = np.mean(miss[:, moved, moved] - miss[:, moved, best[moved]], axis=1)
    return {int(image): int(best[image]) for image in moved} if np.all(gain > np.log(NEEDED)) else {}


def _misses(signal: Array, B: Array, b: Array, usable: Mask, half: Mask) -> Array:
    """(L, L) log m_ij over half of the pixels."""
    predicted = np.maximum(np.einsum("lpi,pi->lp", B[:, half], b[half]), 0.0)
    found = np.ones((len(signal), len(signal)))
    for k, (own, ok) in enumerate(zip(signal[:, half], usable[:, half] & (signal[:, half] > 0), strict=True)):
        if ok.sum() >= FEWEST_PIXELS:
            ratio = predicted[:, ok] / own[ok]
            h = np.maximum(np.median(ratio, axis=1), 1e-9)[:, None]
            found[k] = np.median(np.abs(own[ok] - predicted[:, ok] / h), axis=1) / np.median(own[ok])
    return np.log(np.maximum(found, 1e-9))
