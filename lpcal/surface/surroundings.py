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
from lpcal.surface import planes
from lpcal.surface.sight import Sight

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


def patches(seen: Sight, found: Sequence[planes.Plane], lights: Sequence[Light], object_mask: Mask) -> Patches | None:
    """Patches of the planes `found` in the whole (coarse) image that is `seen`, `object_mask` (H, W) left out; None where none is seen."""
    from scipy import ndimage

    free = ~ndimage.binary_dilation(object_mask, iterations=MARGIN).ravel()
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
    parts = []
    for k, plane in enumerate(found):
        inside = np.flatnonzero(of_plane == k)
        if not inside.size:
            continue
        unit = plane.q / np.linalg.norm(plane.q)
        rays = seen.rays_C[inside]
        depth = 1 / (rays @ plane.q)
        area = (depth * step) ** 2 / (rays @ unit)
        _, of_block = np.unique(block[inside], return_inverse=True)
        total = np.bincount(of_block, area)

        def joined(values: Array, of_block: Array = of_block, area: Array = area, total: Array = total) -> Array:
            return np.stack([np.bincount(of_block, area * one) for one in values]) / total

        x_C = joined((depth[:, None] * rays).T).T
        parts.append(Patches(x_C, np.broadcast_to(-unit, x_C.shape), total, joined(np.maximum(seen.signal[:, inside], 0))))
    if not parts:
        return None
    return Patches(
        np.concatenate([part.x_C for part in parts]),
        np.concatenate([part.n for part in parts]),
        np.concatenate([part.area for part in parts]),
        np.concatenate([part.signal for part in parts], axis=1),
    )
