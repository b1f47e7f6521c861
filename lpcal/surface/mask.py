"""Which pixels are the object."""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Mask
from lpcal.surface.sight import Grey


def automatic(maps: Grey) -> Mask:
    """The object by the strength of its signal alone (Otsu 1979 on the logarithm)."""
    from scipy import ndimage

    strength = np.sort(maps.signal / np.maximum(maps.sigma, 1e-12), axis=0)[-2]
    level = np.log10(np.clip(strength, 1.0, None))
    threshold = _otsu(level.ravel())
    lit = ndimage.binary_opening(level > threshold, iterations=2)
    return np.asarray(ndimage.binary_fill_holes(lit))


def _otsu(values: np.ndarray) -> float:
    count, edges = np.histogram(values, 256)
    middle = (edges[1:] + edges[:-1]) / 2
    below = np.cumsum(count)
    total = below[-1]
    mean = np.cumsum(count * middle)
    share = np.clip(below * (total - below), 1, None)
    between = (mean[-1] * below / total - mean) ** 2 / share
    return float(middle[np.argmax(between)])
