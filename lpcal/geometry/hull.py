"""Test of whether points of a plane lie inside the convex hull of others."""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array, Mask


def inside_hull(places: Array, about: Array) -> Mask:
    """Mask (N,) of points (N, 2) inside the convex hull of others (M, 2); all False if those span no area."""
    import cv2

    hull = cv2.convexHull(about.astype(np.float32).reshape(-1, 1, 2))[:, 0].astype(float) if len(about) > 2 else np.zeros((0, 2))
    if len(hull) < 3:
        return np.zeros(len(places), dtype=bool)
    edges = np.roll(hull, -1, axis=0) - hull
    offsets = places[:, None] - hull
    turns = edges[:, 0] * offsets[..., 1] - edges[:, 1] * offsets[..., 0]
    return np.asarray(np.all(turns >= 0, axis=1) | np.all(turns <= 0, axis=1))
