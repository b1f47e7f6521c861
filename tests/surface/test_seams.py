"""Seams between pieces: those that only the pieces' distances ask for are closed, real ones stay."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lit_scene import Scene, calibration, draw, truth
from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.integration.integrate import Grid
from lpcal.integration.pieces import pieces
from lpcal.surface import rounds, seams
from lpcal.surface.rounds import State
from lpcal.view import sight
from lpcal.view.agreed import NEXT_TO_NOTHING

GIVEN = calibration()
BALL = Scene(radius=0.05)


def of_maps(maps: sight.Grey, mask: np.ndarray, depth: np.ndarray) -> tuple[rounds.Scene, State]:
    """A round from the true depths."""
    seen = sight.look_at(maps, sight.ray_map(mask.shape, GIVEN.camera), mask, central=True)
    scene = rounds.Scene("drawn", seen, Grid.of(mask), GIVEN.lights, None)
    return scene, rounds.once(scene, np.log(depth[mask]), None, 0)


def ball() -> tuple[rounds.Scene, State]:
    mask, depth, _ = truth(BALL)
    return of_maps(sight.grey(to_radiance(draw(BALL, GIVEN), Sensor()), GIVEN.lights), mask, depth)


def cut(scene: rounds.Scene, state: State, inside: np.ndarray, by: np.ndarray | float) -> tuple[State, np.ndarray]:
    """The state with what is `inside` (P,) moved by so much log depth and cut off, and the labels."""
    grid = scene.grid
    weight = np.where(inside[grid.a] != inside[grid.b], NEXT_TO_NOTHING, 1.0)
    off = replace(state, u=state.u + by * inside, weight=weight)
    return off, pieces(grid, weight, scene.seen.mask)


def closed(scene: rounds.Scene, state: State, label: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return seams.closed(scene.seen, scene.grid, scene.lights, state, label)


@pytest.mark.parametrize("by", [-0.02, 0.02])
def test_a_part_of_a_ball_that_was_cut_off_and_moved_comes_back(by: float) -> None:
    scene, state = ball()
    off, label = cut(scene, state, scene.grid.columns < np.median(scene.grid.columns) - 8, by)
    assert label.max() == 2
    u, weight, joined = closed(scene, off, label)
    assert np.abs(u - state.u).max() < 1e-3
    assert joined.max() == 1
    assert pieces(scene.grid, weight, scene.seen.mask).max() == 1


def test_what_holds_along_most_of_its_seam_stays_as_it_is() -> None:
    """Pieces are told apart beside breaks, too: there is nothing to close, and the breaks are real."""
    scene, state = ball()
    grid = scene.grid
    left = grid.columns < np.median(grid.columns) - 8
    corner = left & (grid.rows < np.median(grid.rows) - 5)
    off, _ = cut(scene, state, corner, 0.05)
    u, weight, label = closed(scene, off, np.where(left, 2, 1).astype(np.uint8))
    assert np.array_equal(weight, off.weight)
    assert np.array_equal(u, off.u)
    assert label.max() == 2


def test_a_step_whose_height_differs_along_it_is_no_seam_to_close() -> None:
    scene, state = ball()
    left = scene.grid.columns < np.median(scene.grid.columns) - 8
    slanted = 0.02 + 0.1 * (scene.grid.rows - np.median(scene.grid.rows)) / np.ptp(scene.grid.rows)
    off, label = cut(scene, state, left, slanted)
    u, _, joined = closed(scene, off, label)
    assert np.array_equal(u, off.u)
    assert joined.max() == 2


def test_where_the_nearer_side_turns_away_the_step_is_real() -> None:
    scene, state = ball()
    cosine = -np.einsum("pi,pi->p", state.normals, scene.seen.rays_C) / np.linalg.norm(scene.seen.rays_C, axis=1)
    rim = (cosine < 0.3) & (scene.grid.columns > np.median(scene.grid.columns))
    behind, _ = cut(scene, state, rim, 0.01)
    assert closed(scene, behind, np.where(rim, 2, 1).astype(np.uint8))[2].max() == 2
    within = (cosine < 0.75) & (scene.grid.columns > np.median(scene.grid.columns))
    behind, _ = cut(scene, state, within, 0.01)
    assert closed(scene, behind, np.where(within, 2, 1).astype(np.uint8))[2].max() == 1


def test_the_light_says_that_two_walls_stand_apart() -> None:
    near, far = (Scene(centre=None, wall_z=z) for z in (0.34, 0.48))
    left = np.arange(160) < 72
    maps = [sight.grey(to_radiance(draw(one, GIVEN), Sensor()), GIVEN.lights) for one in (near, far)]
    scaled = maps[1].signal * (0.48 / 0.34) ** 2  # about as bright, as both exposures are set by the brightest pixel
    both = replace(maps[0], signal=np.where(left, maps[0].signal, scaled))
    mask, depth = np.zeros((112, 160), bool), np.where(left, 0.34, 0.48) * np.ones((112, 160))
    mask[20:-20, 30:-30] = True
    scene, state = of_maps(both, mask, depth)
    label = pieces(scene.grid, state.weight, mask)
    assert label.max() == 2
    kept = closed(scene, state, label)
    assert kept[2].max() == 2
    together = closed(scene, *cut(scene, of_maps(maps[0], mask, 0.34 * np.ones_like(depth))[1], label == 2, 0.02))
    assert together[2].max() == 1, "one wall is one piece"
