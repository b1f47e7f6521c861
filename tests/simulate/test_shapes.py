"""Signed distances of the simulated objects, and rays against them, compared with what takes longer."""

from __future__ import annotations

import numpy as np
import pytest

from lpcal.geometry.arrays import Array
from lpcal.simulate import rays, shapes, tour


def to_the_line(x: Array) -> Array:
    """Distance of points (N, 3) from the trefoil's line of 96 segments, all of them measured."""
    t = np.linspace(0, 2 * np.pi, 97)
    line = 0.26 * np.column_stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)])
    a, along = line[:-1], np.diff(line, axis=0)
    share = np.clip(np.einsum("nkc,kc->nk", x[:, None] - a, along) / (along**2).sum(axis=1), 0, 1)
    return np.linalg.norm(x[:, None] - a - along * share[..., None], axis=2).min(axis=1)


@pytest.mark.parametrize("half_m", [0.03, 0.12, 0.6])
def test_the_rope_is_measured_from_its_nearest_segment(half_m: float) -> None:
    """Inside the rope, about it, and where the grid of near segments has ended."""
    x_S = np.random.default_rng(3).uniform(-half_m, half_m, (20011, 3))
    knot = shapes.knot(0.05)
    assert np.abs(knot.distance(x_S) - 0.05 * (to_the_line(x_S / 0.05) - 0.19)).max() < 1e-15
    assert knot.distance(x_S[:0]).shape == (0,)


@pytest.mark.parametrize("name", sorted({**tour.SHAPES, **shapes.SHAPES}))
def test_a_ray_ends_where_small_steps_find_the_surface(name: str) -> None:
    """It meets the object no later than the first of many small steps that is inside, and nothing stands in its way before."""
    shape = {**tour.SHAPES, **shapes.SHAPES}[name](0.05)
    rng = np.random.default_rng(4)
    o_S = rng.standard_normal((60, 3))
    o_S *= 4 * shape.bound_m / np.linalg.norm(o_S, axis=1, keepdims=True)
    d_S = rng.uniform(-0.6, 0.6, (60, 3)) * shape.bound_m - o_S
    d_S /= np.linalg.norm(d_S, axis=1, keepdims=True)
    along = np.linspace(3, 5, 4001) * shape.bound_m
    inside = shape.distance((o_S[:, None] + along[:, None] * d_S[:, None]).reshape(-1, 3)).reshape(60, -1) < 0
    first = np.where(inside.any(axis=1), along[inside.argmax(axis=1)], np.inf)
    hit, step = rays.cast(shape, o_S, d_S), along[1] - along[0]
    met = np.isfinite(first)
    assert np.count_nonzero(met) > 10
    assert np.all(hit[met] <= first[met] + 1e-9)
    assert np.percentile(first[met] - hit[met], 90) < 1.5 * step
    far_S = o_S + 8 * shape.bound_m * d_S
    assert np.all(rays.blocked(shape, o_S, far_S)[met])
    assert not np.any(rays.blocked(shape, o_S, o_S + (np.where(met, hit, 4 * shape.bound_m) - 0.02 * shape.bound_m)[:, None] * d_S)[met])
