"""What stands round the object and throws light on it: the wall behind it and the support under it, as patches on the planes found there.

A plane's pixels show its radiance under every light, shadows and all, so nothing of the planes' own reflectance has to be known. What the
object hides of a plane, and what lies outside the image, throws nothing here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.records.calibration import Light
from lpcal.surface import mask, planes
from lpcal.surface.sight import Grey, Indices, Sight, look_at

PATCHES = 600
MARGIN = 2
"""Coarse pixels about the object that count as neither."""


@dataclass(frozen=True)
class Patches:
    """Flat pieces that throw light: Q of them."""

    x_C: Array
    """(Q, 3)."""
    n: Array
    """(Q, 3)."""
    area: Array
    """(Q,) m^2."""
    signal: Array
    """(L, Q) what they show the camera, a unit of light."""


@dataclass(frozen=True)
class Whole:
    """The whole image in coarse pixels, for what stands behind the object."""

    seen: Sight
    hidden: Mask
    """(H, W) where the object hides it."""
    factor: int
    """Pixels a coarse pixel."""


def whole(maps: Grey, rays_C: Array, object_mask: Mask) -> Whole:
    """The whole image, `object_mask` (H, W) being the object."""
    coarse, coarse_rays, factor = mask.binned(maps, rays_C)
    seen = look_at(coarse, coarse_rays, np.ones(coarse.signal.shape[1:], bool), central=True)
    height, width = (side * factor for side in seen.mask.shape)
    hidden = object_mask[:height, :width].reshape(height // factor, factor, width // factor, factor).any(axis=(1, 3))
    return Whole(seen, hidden, factor)


def patches(image: Whole, found: Sequence[planes.Plane], lights: Sequence[Light]) -> Patches | None:
    """Patches of the planes `found`; None where nothing is seen of them."""
    from scipy import ndimage

    seen, free = image.seen, ~ndimage.binary_dilation(image.hidden, iterations=MARGIN).ravel()
    least, of_plane = np.full(seen.pixels, planes.TRUSTED**2), np.full(seen.pixels, -1)
    for k, plane in enumerate(found):
        square, count = planes.misfit(seen, planes.foretold(plane.q, seen.rays_C, lights))
        better = free & (count >= 2) & (square < least)
        of_plane[better], least[better] = k, square[better]
    height, width = seen.mask.shape
    size = max(1, int(np.ceil(np.sqrt(height * width / PATCHES))))
    row, column = np.indices((height, width)).reshape(2, -1)
    block = row // size * (width // size + 1) + column // size
    step = float(np.linalg.norm(np.diff(seen.rays_C[:2], axis=0)))
    parts = [_of_plane(seen, plane.q, np.flatnonzero(of_plane == k), block, step) for k, plane in enumerate(found) if np.any(of_plane == k)]
    if not parts:
        return None
    return Patches(
        np.concatenate([part.x_C for part in parts]),
        np.concatenate([part.n for part in parts]),
        np.concatenate([part.area for part in parts]),
        np.concatenate([part.signal for part in parts], axis=1),
    )


def _of_plane(seen: Sight, q: Array, inside: Indices, block: Indices, step: float) -> Patches:
    """The pixels `inside` of a plane q (3,), joined by their `block` (P,); neighbouring rays lie `step` apart at depth 1."""
    unit, rays = q / np.linalg.norm(q), seen.rays_C[inside]
    depth = 1 / (rays @ q)
    area = (depth * step) ** 2 / (rays @ unit)
    _, of_block = np.unique(block[inside], return_inverse=True)
    total = np.bincount(of_block, area)

    def joined(values: Array) -> Array:
        """Means (C, Q) by area of values (C, N)."""
        return np.stack([np.bincount(of_block, area * one) for one in values]) / total

    x_C = joined((depth[:, None] * rays).T).T
    return Patches(x_C, np.broadcast_to(-unit, x_C.shape), total, joined(np.maximum(seen.signal[:, inside], 0)))
