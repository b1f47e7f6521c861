"""Whether normals look inwards all along an outline: of things seen whole they never do."""

from __future__ import annotations

import numpy as np
import pytest

from lpcal.integration.convention import curl, exchanged, hollow


def ball(radius: float, at: tuple[float, float] = (60.0, 50.0)) -> tuple[np.ndarray, np.ndarray]:
    """Normals (H, W, 3) and mask of a ball."""
    y, x = np.mgrid[:100, :120].astype(float)
    x, y = (x - at[0]) / radius, (y - at[1]) / radius
    mask = x**2 + y**2 < 1
    return np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0))], axis=-1).astype(np.float32), mask


@pytest.mark.parametrize("radius", [12.0, 30.0, 45.0])
def test_a_ball_is_not_hollow_and_turned_inside_out_it_is(radius: float) -> None:
    n, mask = ball(radius)
    assert not hollow(n, mask)
    assert hollow(n * np.array([-1, -1, 1], np.float32), mask)


def test_noise_and_holes_in_the_normals_do_not_matter() -> None:
    n, mask = ball(30.0)
    n += np.random.default_rng(0).normal(0, 0.3, n.shape).astype(np.float32)
    n[::3, ::4] = np.nan
    assert not hollow(n, mask)


def test_reliefs_parts_in_the_picture_and_specks_say_nothing() -> None:
    flat = np.zeros((100, 120, 3), np.float32) + np.array([0.1, 0.1, -1], np.float32)
    everywhere = np.ones((100, 120), bool)
    assert not hollow(flat, everywhere)
    n, mask = ball(30.0)
    inside_out = n * np.array([-1, -1, 1], np.float32)
    assert not hollow(inside_out[40:60, 50:70], mask[40:60, 50:70])  # no outline in sight
    assert not hollow(inside_out, ball(3.0)[1])
    assert not hollow(flat, np.zeros_like(everywhere))


SWAPPED = np.array([[0, 1], [1, 0]], np.float32)
QUARTER = np.array([[0, -1], [1, 0]], np.float32)


@pytest.mark.parametrize(
    ("turn", "said"),
    [(SWAPPED, "exchanged"), (-SWAPPED, "exchanged"), (QUARTER, "90 degrees"), (QUARTER.T, "90 degrees")],
)
def test_exchanged_or_turned_axes_are_named(turn: np.ndarray, said: str) -> None:
    n, mask = ball(30.0)
    rays = np.zeros((*mask.shape, 3)) + np.array([0.0, 0.0, 1.0])
    n += np.random.default_rng(0).normal(0, 0.05, n.shape).astype(np.float32)
    assert exchanged(n, mask, rays) is None
    n[..., :2] = n[..., :2] @ turn.T
    assert curl(n, mask, rays).likeness > 0.3 or "90" in said  # the curl alone takes a saddle for a surface, too
    assert (exchanged(n, mask, rays) or "").endswith(said)
