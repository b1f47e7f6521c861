"""The distances that the light of a piece by itself supports, its shape kept."""

from __future__ import annotations

import numpy as np
import pytest

from lit_scene import Scene, calibration, draw, truth
from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.surface import distance_search
from lpcal.view import pixel_list

GIVEN = calibration()
SCENE = Scene(centre=(0.03, 0.02, 0.36), radius=0.03)


def piece(seed: int) -> tuple[pixel_list.PixelList, np.ndarray]:
    """A drawn sphere's pixels, and their log depths."""
    mask, depth, _ = truth(SCENE)
    maps = pixel_list.grey(to_radiance(draw(SCENE, GIVEN, seed), Sensor()), GIVEN.lights)
    return pixel_list.list_pixels(maps, pixel_list.ray_map(mask.shape, GIVEN.camera), mask, central=True), np.log(depth[mask])


@pytest.mark.parametrize("off", [-0.6, -0.2, 0.0, 0.3])
def test_a_piece_is_found_by_its_light_however_far_off_it_stands(off: float) -> None:
    for seed in range(3):
        seen, u = piece(seed)
        ends = distance_search.of_piece(seen, GIVEN.lights, u + off, None, np.ones(len(u), bool), main=float(np.median(u)) + 0.1)
        assert ends.shift[0] == pytest.approx(-off, abs=0.04)
        assert abs(ends.shift[0] + off) < 3 * ends.std
        assert ends.std < 0.15
        assert ends.odds.sum() == pytest.approx(1)
        assert (np.diff(ends.odds) <= 0).all()


def test_of_two_distances_that_the_light_allows_that_nearer_the_main_piece_is_likelier() -> None:
    seen, u = piece(0)
    three = pixel_list.PixelList(
        seen.mask, seen.rays_C, seen.signal[:3], seen.sigma[:3], seen.usable[:3], seen.central
    )  # three lights say nothing
    everything = np.ones(len(u), bool)
    near, far = (distance_search.of_piece(three, GIVEN.lights[:3], u, None, everything, float(np.median(u)) + main) for main in (-0.4, 0.5))
    assert near.shift[0] < far.shift[0]
    assert near.std > 0.15, "and it is said that the light hardly knows"


def test_the_fewer_lights_know_the_distance_the_wider_is_its_sigma_and_three_say_next_to_nothing() -> None:
    seen, u = piece(0)
    everything = np.ones(len(u), bool)

    def std(some: list[int]) -> float:
        part = pixel_list.PixelList(seen.mask, seen.rays_C, seen.signal[some], seen.sigma[some], seen.usable[some], seen.central)
        return distance_search.std_of(part, [GIVEN.lights[k] for k in some], u, everything)

    six, four, three = std([0, 1, 2, 3, 4, 5]), std([0, 1, 3, 4]), std([0, 2, 4])
    assert six < four < three
    assert three == pytest.approx(distance_search.WORKING, rel=0.5), "no more than is known beforehand"
    assert six < 0.03
