"""Normals of a depth: the cross product of its slopes along rows and columns, taken where the surface does not break."""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.surface.integrate import Grid


def normals_of(grid: Grid, points_C: Array, whole: Mask) -> Array:
    """Normals (P, 3) of points (P, 3) of a grid's pixels, turned towards the camera; NaN where no slope is known both ways."""
    count = len(points_C)
    slopes = []
    for edges in (grid.horizontal & whole, ~grid.horizontal & whole):
        a, b = grid.a[edges], grid.b[edges]
        chord = points_C[b] - points_C[a]
        number = np.bincount(a, minlength=count) + np.bincount(b, minlength=count)
        total = np.stack([np.bincount(a, column, count) + np.bincount(b, column, count) for column in chord.T], axis=1)
        slopes.append(np.where(number[:, None] > 0, total / np.maximum(number, 1)[:, None], np.nan))
    normal = -np.cross(slopes[0], slopes[1])
    return np.asarray(normal / np.linalg.norm(normal, axis=1, keepdims=True))
