"""A wall that is seen through a hole in an object, and an object that faces as the wall does."""

from __future__ import annotations

import numpy as np
import pytest

import lpcal.segmentation.outline
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.calibration import Light
from lpcal.segmentation.outline import openings
from lpcal.segmentation.planes import Plane
from lpcal.view.sight import Grey, light_vectors

HEIGHT, WIDTH, FOCAL = 120, 160, 220.0
WALL_M = 0.60
WALL = Plane(np.array([0.0, 0.0, 1 / WALL_M]), 1.0)
LIGHTS = [
    Light(f"L{k}", source_C / np.linalg.norm(source_C), np.ones(1), None, source_C, -source_C)
    for k, source_C in enumerate(np.array([0.2 * np.cos(a), 0.2 * np.sin(a), 0.02]) for a in np.arange(6) * np.pi / 3)
]


def rays() -> Array:
    row, column = np.indices((HEIGHT, WIDTH))
    return np.stack([(column - 79.5) / FOCAL, (row - 59.5) / FOCAL, np.ones(row.shape)], axis=-1)


HOLE: Mask = np.hypot(*np.moveaxis(rays()[..., :2] - [0.07, 0.0], -1, 0)) < 0.04


def lit(x_C: Array, n: Array, albedo: float) -> Array:
    d, E = light_vectors(LIGHTS, x_C)
    return albedo * E * np.maximum(np.einsum("kpi,pi->kp", d, n), 0.0)


def pictures(centre_m: float, radius_m: float, hole: Mask | None = None) -> tuple[Grey, Mask]:
    """A ball before or in a wall of its albedo, the wall in a hole in three lights' shadow: what is seen, and the disc."""
    r = rays().reshape(-1, 3)
    centre = np.array([0.0, 0.0, centre_m])
    a, b = np.sum(r**2, axis=1), r @ centre
    root = b**2 - a * (centre @ centre - radius_m**2)
    depth = (b - np.sqrt(np.maximum(root, 0.0))) / a
    disc = (root > 0) & (depth < WALL_M)
    signal = lit(WALL_M * r, np.tile([0.0, 0.0, -1.0], (len(r), 1)), 0.5)
    on_ball = disc if hole is None else disc & ~hole.ravel()
    if hole is not None:
        signal[:3, hole.ravel()] = 0.0
    x_C = depth[:, None] * r
    signal = np.where(on_ball, lit(x_C, (x_C - centre) / radius_m, 0.5), signal)
    signal = signal + 1e-3 * signal.max() * np.random.default_rng(1).standard_normal(signal.shape)
    maps = (signal.reshape(6, HEIGHT, WIDTH).astype(np.float32), np.full((6, HEIGHT, WIDTH), 1e-3 * signal.max(), np.float32))
    return Grey(*maps, np.ones((6, HEIGHT, WIDTH), bool)), disc.reshape(HEIGHT, WIDTH)


def test_a_wall_that_is_seen_through_a_hole_is_no_object() -> None:
    maps, disc = pictures(0.45, 0.08, HOLE)
    found = openings(maps, rays(), LIGHTS, disc, [WALL])
    assert (found & HOLE).sum() > 0.85 * HOLE.sum()
    assert (found & ~HOLE).sum() < 0.1 * HOLE.sum()


def test_what_no_lamp_reaches_is_an_opening_where_the_same_is_seen_around_the_object() -> None:
    maps, disc = pictures(0.45, 0.08, HOLE)
    dim = np.where(disc & ~HOLE, 1.0, 0.02).astype(np.float32)
    found = openings(Grey(maps.signal * dim, maps.sigma, maps.usable), rays(), LIGHTS, disc, [])
    assert (found & HOLE).sum() > 0.85 * HOLE.sum()
    assert (found & ~HOLE).sum() < 0.1 * HOLE.sum()
    inside = np.where(HOLE, 0.02, 1.0).astype(np.float32)  # the same, but all around it is lit: a part of the object in shadow
    assert not openings(Grey(maps.signal * inside, maps.sigma, maps.usable), rays(), LIGHTS, disc, []).any()


def test_a_dome_that_rises_out_of_the_wall_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its middle lies and faces as the wall does, but nothing steps at the middle's rim."""
    maps, disc = pictures(WALL_M + 0.395, 0.40)
    assert not openings(maps, rays(), LIGHTS, disc, [WALL]).any()
    monkeypatch.setattr(lpcal.segmentation.outline, "STEP", -1.0)
    assert openings(maps, rays(), LIGHTS, disc, [WALL]).any()


def test_pictures_that_do_not_divide_into_coarse_pixels() -> None:
    maps, disc = pictures(0.45, 0.08, HOLE)
    large = Grey(*(np.kron(one, np.ones((1, 5, 5), one.dtype))[:, 3:, 2:] for one in (maps.signal, maps.sigma, maps.usable)))
    r = np.stack([np.kron(rays()[..., k], np.ones((5, 5)))[3:, 2:] for k in range(3)], axis=-1)
    disc, hole = (np.kron(one, np.ones((5, 5), bool))[3:, 2:] for one in (disc, HOLE))
    found = openings(large, r, LIGHTS, disc, [WALL])
    assert found.shape == disc.shape
    assert (found & hole).sum() > 0.8 * hole.sum()


@pytest.mark.filterwarnings("error")
def test_a_mask_too_thin_for_coarse_pixels_has_no_openings_and_no_warning() -> None:
    maps, _ = pictures(0.5, 0.08)
    large = Grey(*(np.kron(one, np.ones((1, 4, 4), one.dtype)) for one in (maps.signal, maps.sigma, maps.usable)))
    thin = np.zeros(large.signal.shape[1:], bool)
    thin[:, 10] = True
    rays_C = np.kron(rays(), np.ones((4, 4, 1)))
    assert not openings(large, rays_C, LIGHTS, thin, [WALL]).any()
