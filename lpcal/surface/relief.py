r"""Occlusion by a depth map taken as a solid of limited thickness, and interreflection from its sides hidden from the camera.

Occlusion of a segment between two points: a point y of the segment is inside the solid where the surface along y's own ray is nearer than y
by more than a tolerance, and by less than a thickness. Source: shadow maps, Williams 1978, Computer Graphics 12(3).

Light from hidden sides, such as the underside of a part that projects towards the camera: from a patch at p with normal n,
cosine-distributed directions w_i are traced until they enter the solid at y. If y lies well behind the front there, the ray entered by a
hidden side. That side is modelled with the albedo of the front beside it, perpendicular to the camera's ray, and lit by the lights that
reach it::

    J_k(p) = 1/N sum_i  w_i / (w_i . n)  albedo E_k(y) max(m . d_k, 0)        m: the side's normal

This is approximate, but of the right sign and size; a second result states how much of the light depends on it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array, Mask
from lpcal.kernels.library import kernel
from lpcal.records.calibration import Light
from lpcal.view import parallel
from lpcal.view.constants import LEAST_COSINE, MANY_PIXELS, SHADOW_STEPS
from lpcal.view.pixel_list import Indices, PixelList, light_vectors, powers

TOLERANCE = 0.003
"""Relative depth by which a point must lie behind the surface to be occluded."""
THICKNESS = 0.2
"""Assumed thickness of the solid behind its visible front, as a share of the depth."""
DIRECTIONS = 64
"""Number of directions traced from a patch."""
REACHES = np.geomspace(0.01, 0.35, 12)
"""Distances along a ray at which occlusion is tested, as shares of the depth."""
HALVINGS = 4
"""Bisections that locate where a ray enters the solid."""
UNSEEN = 0.008
"""Relative depth behind the visible front beyond which a ray counts as having entered through a hidden side."""


@dataclass(frozen=True)
class Relief:
    """A surface's visible front as an occluder: its depth map, and the projection of rays to pixels."""

    front: Array
    """(H, W) depth of the furthest of 3x3 pixels, so that steep slopes do not hide themselves; inf outside."""
    pixel_of_ray: Array
    """(6, 2) coefficients of columns and rows by the powers of a ray's x and y."""

    @staticmethod
    def of(seen: PixelList, depth: Array, *, to_rim: bool = False) -> Relief:
        """From depths (P,) at the pixels of a camera; `to_rim` says whether pixels on the rim count, which on round bodies turn away."""
        outside = -np.inf if to_rim else np.inf
        front = np.full(seen.mask.shape, outside)
        front[seen.mask] = depth
        some = slice(None, None, max(1, seen.pixels // MANY_PIXELS))
        places = np.stack(np.nonzero(seen.mask)[::-1], axis=1)
        first = places.min(axis=0)
        pixel_of_ray = np.linalg.lstsq(powers(seen.rays_C[some, :2]), (places[some] - first).astype(float), rcond=None)[0]
        pixel_of_ray[0] += first
        front = raster.max_filtered(front, 1, outside)
        return Relief(np.where(seen.mask, front, np.inf) if to_rim else front, pixel_of_ray)

    def hidden(self, start_C: Array, end_C: Array, steps: int) -> Mask:
        """Mask (N,): whether the surface occludes the segments between points (N, 3), tested at `steps` points each."""
        found = np.zeros(len(start_C), bool)
        if run := kernel("hidden"):
            ends = (np.ascontiguousarray(end, float) for end in (start_C, end_C))
            run(len(found), *ends, steps, *self.front.shape, self.front, self.pixel_of_ray, TOLERANCE, THICKNESS, found)
            return found
        for k in range(steps):
            found |= self.holds(start_C + (k + 0.5) / steps * (end_C - start_C))
        return found

    def holds(self, y_C: Array) -> Mask:
        """Mask (N,) of points (N, 3) inside the solid."""
        behind = self.behind(y_C)
        return np.asarray((behind > TOLERANCE) & (behind < THICKNESS))

    def behind(self, y_C: Array) -> Array:
        """Depth (N,) of points (N, 3) behind the surface, relative to the surface's depth; -1 where there is no surface."""
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
        """Mask (N,): whether the surface occludes its points x_C (N, 3) from a source (3,); segments end at its nearest depth."""
        nearest = float(np.min(self.front))
        fall = np.maximum(x_C[:, 2] - source_C[2], 1e-9)
        share = np.clip((x_C[:, 2] - nearest) / fall, 0, 1)
        return self.hidden(x_C, x_C + share[:, None] * (source_C - x_C), steps)


def interreflected_by_sides(x_C: Array, n: Array, relief: Relief, albedo: Array, lights: Sequence[Light]) -> tuple[Array, Array]:
    """J (L, Q, 3) from hidden sides at patches x_C (Q, 3) with normals n (Q, 3), and their share (Q,) of the patches' surroundings.

    `albedo` (H, W) is in the units of the signals.
    """
    ways, count = _directions(n), len(x_C)
    of, y_C = _entries(np.tile(x_C, (DIRECTIONS, 1)), ways.reshape(-1, 3), relief)
    at, way = of % count, ways.reshape(-1, 3)[of]
    column, row, _ = relief.pixels(y_C)
    shown = albedo[row, column] * _shading(y_C, way, relief, lights)
    weight = way / np.maximum(lambert.dot(way, n[at]), LEAST_COSINE)[:, None]
    J = np.stack([np.stack([np.bincount(at, of_light * axis, count) for axis in weight.T], axis=-1) for of_light in shown])
    return J / DIRECTIONS, np.bincount(at, minlength=count) / DIRECTIONS


def _directions(n: Array) -> Array:
    """Cosine-distributed directions (DIRECTIONS, Q, 3) about normals n (Q, 3)."""
    k = np.arange(DIRECTIONS) + 0.5
    radius, turn = np.sqrt(k / DIRECTIONS), np.pi * (1 + np.sqrt(5)) * k
    e1 = lambert.unit(lambert.cross(n, np.where(np.abs(n[:, :1]) < 0.9, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])))[0]
    e2 = lambert.cross(n, e1)
    local = np.stack([radius * np.cos(turn), radius * np.sin(turn), np.sqrt(1 - radius**2)])
    return np.einsum("jk,jqi->kqi", local, np.stack([e1, e2, n]))


def _entries(x_C: Array, way: Array, relief: Relief) -> tuple[Indices, Array]:
    """Indices of the rays, from points in directions (Q, 3), that enter the solid through a hidden side, and the entry points (N, 3)."""
    if run := kernel("entries"):
        found, far = np.empty(len(x_C), bool), np.empty(len(x_C))
        body = (*relief.front.shape, relief.front, relief.pixel_of_ray, TOLERANCE, THICKNESS)

        def of(some: slice) -> None:
            given = (np.ascontiguousarray(one[some], float) for one in (x_C, way))
            run(some.stop - some.start, *given, len(REACHES), REACHES, HALVINGS, *body, found[some], far[some])

        parallel.run_bands(len(x_C), len(REACHES), of)
        at = np.flatnonzero(found)
        return _unseen(at, x_C[at] + far[at, None] * way[at], relief)
    low, high = np.zeros(len(x_C)), np.zeros(len(x_C))
    met: Mask = np.zeros(len(x_C), bool)
    for reach in REACHES:
        free = np.flatnonzero(~met)
        r = reach * x_C[free, 2]
        here = relief.holds(x_C[free] + r[:, None] * way[free])
        high[free[here]], met[free[here]] = r[here], True
        low[free[~here]] = r[~here]
    at = np.flatnonzero(met)
    low, high = low[at], high[at]
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        inside = relief.holds(x_C[at] + middle[:, None] * way[at])
        low, high = np.where(inside, low, middle), np.where(inside, middle, high)
    return _unseen(at, x_C[at] + high[:, None] * way[at], relief)


def _unseen(at: Indices, y_C: Array, relief: Relief) -> tuple[Indices, Array]:
    """The entries (N,) at points (N, 3) that are hidden from the camera."""
    unseen = relief.behind(y_C) > UNSEEN
    return at[unseen], y_C[unseen]


def _shading(y_C: Array, way: Array, relief: Relief, lights: Sequence[Light]) -> Array:
    """Shading (L, N) by the lights of the hidden sides at y_C (N, 3) that rays of direction `way` (N, 3) meet."""
    ray = y_C / lambert.length(y_C)[..., None]
    m = -way
    m = lambert.unit(m - lambert.dot(m, ray)[:, None] * ray)[0]
    before_C = y_C - TOLERANCE * y_C[:, 2:] * way
    shading = np.empty((len(lights), len(y_C)))
    for k, light in enumerate(lights):
        d, E = light_vectors([light], y_C)
        shading[k] = E[0] * np.maximum(lambert.dot(d[0], m), 0.0)
        lit = np.flatnonzero(shading[k] > 0)
        if light.source_C is not None and lit.size:
            shading[k, lit] *= ~relief.hidden_from(before_C[lit], light.source_C, SHADOW_STEPS)
    return shading
