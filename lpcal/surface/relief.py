r"""A depth map as a body that stands in the way: whether a straight line between two points passes behind the surface.

A point y of the line is hidden where the surface, seen along y's own ray, is nearer than y by more than a tolerance: what lies behind the
front that the camera sees is taken for solid, to a certain thickness. Source: shadow maps, Williams 1978, Computer Graphics 12(3).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Mask
from lpcal.kernels.library import kernel
from lpcal.surface.sight import Indices, Sight, powers

TOLERANCE = 0.003
"""Share of the depth by which a point must lie behind the surface to be hidden."""
THICKNESS = 0.2
"""Share of the depth that a body is taken to reach behind its front."""
FIT_PIXELS = 2000


@dataclass(frozen=True)
class Relief:
    """The front of a surface: its depth a pixel, and where a ray meets the image."""

    front: Array
    """(H, W) depth of the furthest of 3x3 pixels, so that steep slopes do not hide themselves; inf outside."""
    pixel_of_ray: Array
    """(6, 2) coefficients of columns and rows by the powers of a ray's x and y."""

    @staticmethod
    def of(seen: Sight, depth: Array, *, to_rim: bool = False) -> Relief:
        """From depths (P,) at the pixels of a camera; `to_rim` says whether pixels on the rim count, which on round bodies turn away."""
        outside = -np.inf if to_rim else np.inf
        front = np.full(seen.mask.shape, outside)
        front[seen.mask] = depth
        some = slice(None, None, max(1, seen.pixels // FIT_PIXELS))
        places = np.stack(np.nonzero(seen.mask)[::-1], axis=1)
        first = places.min(axis=0)
        pixel_of_ray = np.linalg.lstsq(powers(seen.rays_C[some, :2]), (places[some] - first).astype(float), rcond=None)[0]
        pixel_of_ray[0] += first
        front = raster.highest(front, 1, outside)
        return Relief(np.where(seen.mask, front, np.inf) if to_rim else front, pixel_of_ray)

    def hidden(self, start_C: Array, end_C: Array, steps: int) -> Mask:
        """Whether the surface stands between points (N, 3) and (N, 3), tried at `steps` places."""
        found = np.zeros(len(start_C), bool)
        if run := kernel("hidden"):
            ends = (np.ascontiguousarray(end, float) for end in (start_C, end_C))
            run(len(found), *ends, steps, *self.front.shape, self.front, self.pixel_of_ray, TOLERANCE, THICKNESS, found)
            return found
        for k in range(steps):
            found |= self.holds(start_C + (k + 0.5) / steps * (end_C - start_C))
        return found

    def holds(self, y_C: Array) -> Mask:
        """Whether points (N, 3) lie in the body."""
        behind = self.behind(y_C)
        return np.asarray((behind > TOLERANCE) & (behind < THICKNESS))

    def behind(self, y_C: Array) -> Array:
        """How far (N,) points (N, 3) lie behind the surface, by its depth; -1 where there is none."""
        if run := kernel("behind"):
            found = np.empty(len(y_C))
            run(len(found), np.ascontiguousarray(y_C, float), *self.front.shape, self.front, self.pixel_of_ray, found)
            return found
        column, row, inside = self.pixels(y_C)
        return np.asarray(np.where(inside, y_C[:, 2] / self.front[row, column] - 1, -1.0))

    def pixels(self, y_C: Array) -> tuple[Indices, Indices, Mask]:
        """Columns and rows (N,) of points (N, 3), and whether these are in the image."""
        height, width = self.front.shape
        pixel = np.rint(powers(y_C[:, :2] / y_C[:, 2:]) @ self.pixel_of_ray)
        inside = (pixel >= 0).all(axis=1) & (pixel[:, 0] < width) & (pixel[:, 1] < height)
        column, row = np.where(inside[:, None], pixel, 0).astype(np.int64).T
        return column, row, inside

    def hidden_from(self, x_C: Array, source_C: Array, steps: int) -> Mask:
        """Whether the surface stands between points x_C (N, 3) of it and a source (3,): only the way up to its nearest part counts."""
        nearest = float(np.min(self.front))
        fall = np.maximum(x_C[:, 2] - source_C[2], 1e-9)
        share = np.clip((x_C[:, 2] - nearest) / fall, 0, 1)
        return self.hidden(x_C, x_C + share[:, None] * (source_C - x_C), steps)
