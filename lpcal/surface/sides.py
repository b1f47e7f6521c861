r"""Light from the sides of an object that the camera does not see: the underside of what stands before its other parts.

Symbols: from a patch at p with normal n, directions w_i are spread by the cosine; each is followed until it enters the body (see
surface.relief) at y. If y lies well behind the front that the camera sees there, it came in by an unseen side. Nothing shows that side, so
it is taken for one of the front's albedo beside it, at right angles to the camera's ray, and lit by those lights that reach it::

    J_k(p) = 1/N sum_i  w_i / (w_i . n)  albedo E_k(y) max(m . d_k, 0)        m: the side's normal

Approximate, but of the right sign and size; the second result states how much of the light depends on it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.kernels.library import kernel
from lpcal.records.calibration import Light
from lpcal.surface.relief import THICKNESS, TOLERANCE, Relief
from lpcal.surface.sight import Indices, light_vectors

DIRECTIONS = 64
REACHES = np.geomspace(0.01, 0.35, 12)
"""Distances along a ray at which occlusion by the body is tested, as shares of the depth."""
HALVINGS = 4
UNSEEN = 0.008
"""Share of the depth: a ray that enters the body this far behind the visible front came through a side that is not seen."""
GRAZING = 0.1
OFF = 0.004
"""Share of the depth by which shadow rays start in front of the side."""
SHADOW_STEPS = 24


def thrown(x_C: Array, n: Array, relief: Relief, albedo: Array, lights: Sequence[Light]) -> tuple[Array, Array]:
    """J (L, Q, 3) at patches x_C (Q, 3) with normals n (Q, 3), and the share (Q,) of unseen sides in what stands round them.

    `albedo` (H, W) is in the units of the signals.
    """
    ways, count = _directions(n), len(x_C)
    of, y_C = _entries(np.tile(x_C, (DIRECTIONS, 1)), ways.reshape(-1, 3), relief)
    at, way = of % count, ways.reshape(-1, 3)[of]
    column, row, _ = relief.pixels(y_C)
    shown = albedo[row, column] * _shading(y_C, way, relief, lights)
    weight = way / np.maximum(lambert.dot(way, n[at]), GRAZING)[:, None]
    J = np.stack([np.stack([np.bincount(at, of_light * axis, count) for axis in weight.T], axis=-1) for of_light in shown])
    return J / DIRECTIONS, np.bincount(at, minlength=count) / DIRECTIONS


def _directions(n: Array) -> Array:
    """Directions (DIRECTIONS, Q, 3) about normals n (Q, 3), as many to a solid angle as its cosine says."""
    k = np.arange(DIRECTIONS) + 0.5
    radius, turn = np.sqrt(k / DIRECTIONS), np.pi * (1 + np.sqrt(5)) * k
    e1 = lambert.unit(lambert.cross(n, np.where(np.abs(n[:, :1]) < 0.9, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])))[0]
    e2 = lambert.cross(n, e1)
    local = np.stack([radius * np.cos(turn), radius * np.sin(turn), np.sqrt(1 - radius**2)])
    return np.einsum("jk,jqi->kqi", local, np.stack([e1, e2, n]))


def _entries(x_C: Array, way: Array, relief: Relief) -> tuple[Indices, Array]:
    """Which of places and directions (Q, 3) enter the body by an unseen side, and where (N, 3)."""
    if run := kernel("entries"):
        found, far = np.empty(len(x_C), bool), np.empty(len(x_C))
        body = (*relief.front.shape, relief.front, relief.pixel_of_ray, TOLERANCE, THICKNESS)
        run(len(x_C), *(np.ascontiguousarray(one, float) for one in (x_C, way)), len(REACHES), REACHES, HALVINGS, *body, found, far)
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
    """Those of entries (N,) at places (N, 3) that the camera does not see."""
    unseen = relief.behind(y_C) > UNSEEN
    return at[unseen], y_C[unseen]


def _shading(y_C: Array, way: Array, relief: Relief, lights: Sequence[Light]) -> Array:
    """What the lights give to the unseen sides (L, N) at y_C (N, 3) that `way` (N, 3) meets."""
    ray = y_C / np.linalg.norm(y_C, axis=1, keepdims=True)
    m = -way
    m = lambert.unit(m - lambert.dot(m, ray)[:, None] * ray)[0]
    before_C = y_C - OFF * y_C[:, 2:] * way
    shading = np.empty((len(lights), len(y_C)))
    for k, light in enumerate(lights):
        d, E = light_vectors([light], y_C)
        shading[k] = E[0] * np.maximum(lambert.dot(d[0], m), 0.0)
        lit = np.flatnonzero(shading[k] > 0)
        if light.source_C is not None and lit.size:
            shading[k, lit] *= ~relief.hidden_from(before_C[lit], light.source_C, SHADOW_STEPS)
    return shading
