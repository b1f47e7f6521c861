"""Rays against a shape: where they hit it, and whether it stands between two points. Sphere tracing; all arrays in S."""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array, Index, Mask
from lpcal.simulate.shapes import Shape

STEPS = 160
TOUCH = 2e-5
"""A ray has hit when it is this near, in bounding radii, where an image needs it."""
LEAVE = 1e-3
"""A shadow ray starts this far off the surface, in bounding radii."""


def cast(shape: Shape, o_S: Array, d_S: Array, touch: float = TOUCH) -> Array:
    """Distances (N,) along unit rays d_S (N, 3) from o_S (3,) or (N, 3) to the shape, inf where they miss.

    A ray has hit when it is `touch` bounding radii near.
    """
    o_S = np.broadcast_to(o_S, d_S.shape)
    near, far = bounding(o_S, d_S, shape.bound_m)
    hit = np.full(len(d_S), np.inf)
    active = np.flatnonzero(near < far)
    o, d, t, far = _columns(o_S, active), _columns(d_S, active), np.maximum(near[active], 0), far[active]
    for _ in range(STEPS):
        if not len(active):
            break
        gap = shape.distance_at(o + t * d)
        touched = gap < touch * shape.bound_m
        hit[active[touched]] = t[touched]
        t = t + gap
        on = np.flatnonzero(~touched & (t < far))
        active, t, far = active[on], t[on], far[on]
        o, d = o.take(on, axis=1), d.take(on, axis=1)
    return hit


def blocked(shape: Shape, x_S: Array, target_S: Array) -> Mask:
    """Whether the shape stands between points x_S (N, 3) and targets (N, 3)."""
    to = target_S - x_S
    length = np.linalg.norm(to, axis=1)
    d_S = to / length[:, None]
    near, far = bounding(x_S, d_S, shape.bound_m)
    found = np.zeros(len(x_S), bool)
    active = np.flatnonzero((near < far) & (far > 0))
    x, d, end = _columns(x_S, active), _columns(d_S, active), np.minimum(far, length)[active]
    t = np.maximum(near[active], LEAVE * shape.bound_m)
    for _ in range(STEPS):
        if not len(active):
            break
        gap = shape.distance_at(x + t * d)
        touched = gap < TOUCH * shape.bound_m
        found[active[touched]] = True
        t = t + np.maximum(gap, 2e-4 * shape.bound_m)
        on = np.flatnonzero(~touched & (t < end))
        active, t, end = active[on], t[on], end[on]
        x, d = x.take(on, axis=1), d.take(on, axis=1)
    return found


def _columns(x: Array, which: Index) -> Array:
    """Coordinates (3, n) of some of the points (N, 3): sums along a row are faster."""
    return np.ascontiguousarray(x[which].T)


def bounding(o_S: Array, d_S: Array, radius_m: float) -> tuple[Array, Array]:
    """Where unit rays enter and leave the bounding sphere; (inf, -inf) where they miss."""
    along = -np.sum(o_S * d_S, axis=-1)
    across2 = np.sum(o_S * o_S, axis=-1) - along**2
    inside2 = radius_m**2 - across2
    half = np.sqrt(np.maximum(inside2, 0))
    return np.where(inside2 > 0, along - half, np.inf), np.where(inside2 > 0, along + half, -np.inf)
