"""How far a nearly flat surface strays from a plane: what a flat card shows of a wrong light model.

Plane by total least squares on the points of the largest piece, its outermost pixels left out; deviations w along its normal. Bowl: what
the best paraboloid ``w = a + k (x^2 + y^2)`` sags over the extent, ``k (extent / 2)^2``.
"""

from __future__ import annotations

import numpy as np

from lpcal.records.figures import Flatness
from lpcal.records.surface import Surface

NEARLY = 0.2
"""Share of its extent: a piece whose points stray more from a plane is not meant to be flat."""
RIM_PX = 3
FEWEST = 100
MOST = 2_000_000
"""Pixels of a piece at most that take part, spread over it."""


def flatness(surface: Surface) -> Flatness | None:
    """Deviation of the largest piece from a plane, mm, its bowl and extent; None where it is not nearly flat, or depth is in pixels."""
    from scipy import ndimage

    inside = ndimage.binary_erosion(surface.component == 1, iterations=RIM_PX)
    if not surface.rays_C[..., :2].any() or inside.sum() < FEWEST:
        return None
    places = np.flatnonzero(inside)
    places = places[:: max(1, len(places) // MOST)]
    points = (surface.rays_C.reshape(-1, 3)[places] * surface.depth.ravel()[places, None]).astype(float)
    centred = points - points.mean(axis=0)
    along = np.linalg.svd(centred.T @ centred)[0]
    deviation = centred @ along[:, 2]
    extent = float(np.ptp(centred @ along[:, 0]))
    low, high = np.percentile(deviation, [0.5, 99.5])
    if high - low > NEARLY * extent:
        return None
    round_C = np.sum((centred @ along[:, :2]) ** 2, axis=1)
    k = np.linalg.lstsq(np.stack([np.ones_like(round_C), round_C], axis=1), deviation, rcond=None)[0][1]
    return Flatness(
        bowl_mm=float(1e3 * abs(k) * (extent / 2) ** 2),
        plane_rms_mm=float(1e3 * deviation.std()),
        plane_peak_to_valley_mm=float(1e3 * (high - low)),
        extent_mm=1e3 * extent,
    )
