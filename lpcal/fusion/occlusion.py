r"""Free-space violations: points of other views in front of a view's surface, counted against both.

Symbols: p a point of view j in the C of view i, z_p its depth there, z_i the depth that i shows at its pixel::

    z_p < z_i - gate        i sees through p: one of the two is wrong, and neither view alone says which

`correspondences` counts this against p. Here it is counted against what i shows as well: a part that is too far occludes nothing, so what
others see through it tells nothing of it. Points near an outline are not counted, where a pixel is of one surface or the other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from lpcal.fusion.correspondences import Placed, faces
from lpcal.fusion.pair_selection import Partners
from lpcal.fusion.views import may_see
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Index

POINTS = 8000
"""Points of a view that are looked up, about: a few pixels to one in other views."""
CLOSED = 2
"""Gaps between points that are closed, in their distances to each side: seen at a slant they lie sparser."""
INSIDE_PX = 2
"""How far inside the outline of what stands before a pixel must lie, in pixels: views may be off by as many."""


def points_of(one: Placed) -> tuple[Array, Array, int]:
    """Points and normals (N, 3) of a placed view in A, and how many pixels lie from one to the next."""
    step = max(int(np.sqrt(one.view.witness.sum() / POINTS)), 1)
    row, column = np.nonzero(one.view.witness[step // 2 :: step, step // 2 :: step])
    x_A, n_A, _ = replace(one, row=row * step + step // 2, column=column * step + step // 2).points()
    return x_A, n_A, step


def before(one: Placed, points: tuple[Array, Array, int]) -> Array | None:
    """Depths (H, W) in C of what another view shows at each pixel of a view; infinite where it shows nothing, None: nowhere anything."""
    from scipy.ndimage import maximum_filter, minimum_filter

    x_A, n_A, step = points
    if not may_see(one.view, one.H_AC, x_A):
        return None
    facing = faces(x_A, n_A, one)
    x_C = se3.apply(se3.inv(one.H_AC), x_A[facing])
    x_C = x_C[x_C[:, 2] > 1e-6]
    plane = x_C[:, :2] / x_C[:, 2:]
    near = (np.abs(plane - one.view.to_pixels.middle) < one.view.to_pixels.span * 1.6).all(axis=1)
    height, width = one.view.depth.shape
    column, row = np.rint(one.view.to_pixels(plane[near])).astype(int).T
    z = x_C[near, 2]
    kept = (row >= 0) & (column >= 0) & (row < height) & (column < width)
    if not kept.any():
        return None
    found = np.full((height, width), np.inf)
    np.minimum.at(found, (row[kept], column[kept]), z[kept])
    wide = 2 * CLOSED * step + 1
    return np.asarray(maximum_filter(minimum_filter(found, wide), wide + 2 * INSIDE_PX))


@dataclass(frozen=True)
class Fronts:
    """Placed views, and what each shows that may stand before others."""

    state: Sequence[Placed]
    partners: Partners
    """Which are compared with which."""

    @cached_property
    def points(self) -> list[tuple[Array, Array, int]]:
        """The points of every view."""
        return [points_of(one) for one in self.state]

    def deny(self, place: int, row: Index, column: Index, depth: Array, gate_m: float) -> Index:
        """How many of its partners show something before points at pixels (N,) and depths (..., N) of a view."""
        count = np.zeros(np.shape(depth), np.intp)
        for k in self.partners[place]:
            found = before(self.state[place], self.points[k])
            if found is not None:
                count += found[row, column] < depth - gate_m
        return count
