r"""Which side of an outline a pixel is like.

Likeness is the log likelihood ratio of a picture's value (a logarithm l of brightness) among those about it on either side, by their mean m
and variance v in a Gaussian window::

    c_side = (l - m)^2 / (v + TEXTURE^2) + log(v + TEXTURE^2)        likeness = (c_outside - c_inside) / 2

Where a side has hardly a share of the window, it is that of the nearest place which has.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.view import bands

TEXTURE = 0.1
"""Standard deviation of the logarithm of brightness on one material, besides what its neighbourhood shows: paint, folds, shadows."""
KNOWN = 0.02
"""Share of a window that must lie on a side for its mean to stand for the side there; else that of the nearest place does."""
MOST = 10.0
"""Log likelihood ratio at most: a single pixel does not decide."""


def likeness(pictures: Sequence[Image], inside: Mask, outside: Mask, by: float, asked: Mask) -> list[Array]:
    """The log likelihood ratio (N,) of the pixels `asked` (H, W), of each picture (H, W): like what lies inside, or outside.

    `by` is the standard deviation of the window in pixels. Zero where one of the sides is empty.
    """
    if not (asked.any() and inside.any() and outside.any()):
        return [np.zeros(int(asked.sum())) for _ in pictures]
    rows, columns = (np.flatnonzero(asked.any(axis=axis)) for axis in (1, 0))
    margin = int(np.ceil(2 * raster.REACH * by))
    box = tuple(slice(max(int(some[0]) - margin, 0), int(some[-1]) + margin + 1) for some in (rows, columns))
    if not (inside[box].any() and outside[box].any()):
        box = (slice(None), slice(None))
    here = asked[box]
    parts = [picture[box].astype(np.float32) for picture in pictures]
    out, within = bands.shared(lambda side: _costs(parts, side[box], by, here), (outside, inside))
    return [np.clip((a - b) / 2, -MOST, MOST) for a, b in zip(out, within, strict=True)]


def _costs(pictures: Sequence[Image], side: Mask, by: float, here: Mask) -> list[Array]:
    """Twice the negative log likelihood (N,) of the pixels `here` (H, W) among those of a side (H, W), by each picture (H, W)."""
    share = raster.blurred(side.astype(np.float32), by)
    nearest = raster.nearest(share > KNOWN)[here]
    weight = np.maximum(share.ravel()[nearest], 1e-9)
    costs = []
    for picture in pictures:
        mean, square = (raster.blurred(np.where(side, one, np.float32(0)), by).ravel()[nearest] / weight for one in (picture, picture**2))
        variance = np.maximum(square - mean**2, 0.0) + TEXTURE**2
        costs.append((picture[here] - mean) ** 2 / variance + np.log(variance))
    return costs


def level(picture: Image, dimmest: float) -> Image:
    """The logarithm of a picture (H, W), no darker than `dimmest`."""
    return np.asarray(np.log(np.maximum(picture, max(dimmest, 1e-12))), np.float32)
