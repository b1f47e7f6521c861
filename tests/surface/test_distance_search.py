"""From which distance a reconstruction begins, and which other distances the images allow."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lit_scene import Scene, calibration, draw, truth
from lpcal.geometry.arrays import Array
from lpcal.integration.integrate import Grid
from lpcal.records.observations import Radiance
from lpcal.surface import distance_search
from lpcal.surface.distance_search import DistanceMinima, DistanceMinimum, odds_of, search
from lpcal.view import pixel_list


@pytest.mark.parametrize("about", [*(pytest.param(one, marks=pytest.mark.slow) for one in (0.6, 1.0)), 1.9])
def test_the_object_is_found_from_afar(about: float) -> None:
    """The sphere's distance within 3 per cent, though the working distance is stated up to twice as large."""
    given = calibration()
    raw = draw(Scene(), given, seed=int(10 * about))
    mask, depth, _ = truth(Scene())
    signal = np.asarray(raw.images - raw.ambient.mean(axis=0), np.float32)
    radiance = Radiance("scene", raw.lights, signal, np.full(signal.shape, 0.003, np.float32), np.zeros(signal.shape, bool), None, ())
    found = search(pixel_list.grey(radiance, given.lights), pixel_list.ray_map(mask.shape, given.camera), mask, given.lights, about * 0.35)
    assert found is not None
    assert abs(np.median(found.start(mask) - np.log(depth[mask]))) < 0.03
    odds = odds_of(found.ends, found.lights, found.about_m)
    assert list(odds) == sorted(odds, reverse=True)


def ends(*costs: float) -> DistanceMinima:
    flat = np.zeros(4)
    return DistanceMinima(tuple(DistanceMinimum(flat + 0.2 * k, cost) for k, cost in enumerate(costs)), np.ones((2, 2), bool), 1, 6, 1.0)


def test_a_basin_of_like_cost_is_stated_with_its_odds_and_a_dear_one_is_not() -> None:
    (ratio, odds), *rest = ends(2.0, 2.1, 9.0).others()
    assert ratio == pytest.approx(np.exp(0.2))
    assert 0.3 < odds < 0.5
    assert not rest
    assert not ends(2.0, 5.0).others()


def test_of_distances_that_the_light_allows_alike_the_working_distance_is_the_likeliest_and_no_more_than_that() -> None:
    flat = np.zeros(4)
    at = {ratio: DistanceMinimum(flat + np.log(ratio * 0.4), 2.0) for ratio in (0.4, 1.0, 2.5)}
    odds = odds_of(list(at.values()), 6, 0.4)
    assert odds[1] > 0.6
    assert min(odds) > 0.05, "a broad prior"
    assert odds.sum() == pytest.approx(1)
    dear = odds_of([at[0.4], replace(at[1.0], cost=6.0)], 6, 0.4)
    assert dear[0] > 0.95, "the light decides where it tells them apart"


def test_what_the_model_lacks_makes_basins_more_alike() -> None:
    """The same difference of costs says less where even the best explains little."""
    well, ill = (replace_all(ends(1.0, 1.1), by) for by in (0.0, 29.0))
    assert ill.others()[0][1] > well.others()[0][1]


def replace_all(given: DistanceMinima, by: float) -> DistanceMinima:
    return replace(given, ends=tuple(replace(one, cost=one.cost + by) for one in given.ends))


def two_ends(cost: float, break_cost: float = 1.0) -> tuple[distance_search._Minimum, distance_search._Minimum, Array]:
    """One end is right on the left, the other, half a unit of log depth further away, on the right; elsewhere a pixel costs `cost`."""
    grid = Grid.of(np.ones((20, 30), bool))
    left = grid.columns < 12
    every = np.ones(len(grid.a))
    edges = distance_search._Edges(grid, 0 * every, 0.01 * every, break_cost * every)
    near = distance_search._Minimum(np.zeros(len(left)), np.where(left, 1.0, 1 + cost), edges)
    far = distance_search._Minimum(np.full(len(left), 0.5), np.where(left, 1 + cost, 1.0), edges)
    return near, far, np.where(left, 0.0, 0.5)


def test_parts_that_are_right_from_different_starts_are_put_together() -> None:
    near, far, right = two_ends(20.0)
    fused = distance_search._fused([near, far])
    assert fused is not None
    assert np.array_equal(fused, right)
    whole = near.fused_with(far)
    assert whole.minimum.cost < min(near.minimum.cost, far.minimum.cost)


def test_parts_are_put_together_only_along_contrast_of_the_images() -> None:
    """The same gain is worth a break where the images have an edge, and is not worth one where they show nothing."""
    along_an_edge, within_a_face = (distance_search._fused([*two_ends(0.8, break_cost)[:2]]) for break_cost in (1.0, 26.0))
    assert along_an_edge is not None
    assert within_a_face is None


def test_an_end_that_costs_hardly_more_anywhere_stays_whole() -> None:
    near, far, _ = two_ends(0.2)  # the break along twenty edges costs more than the pixels gain
    assert distance_search._fused([near, far]) is None
