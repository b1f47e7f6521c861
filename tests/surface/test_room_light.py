"""Without an ambient image the room's light is estimated: how near it comes, what it does to the surface, and when it is left alone."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lit_scene import Scene, calibration, draw, room_light, truth
from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.geometry.arrays import Array, Image
from lpcal.records.calibration import Light
from lpcal.records.observations import RawCapture
from lpcal.segmentation import ambient_sample_costs, planes
from lpcal.segmentation import mask as mask_of
from lpcal.segmentation import room_light as whole
from lpcal.segmentation.mask import Found
from lpcal.segmentation.room_light import RoomLight
from lpcal.surface import without_ambient
from lpcal.surface import without_ambient as room
from lpcal.surface.reconstruct import Options, reconstruct
from lpcal.view import pixel_list
from lpcal.view.coarse import RoomPrior
from lpcal.view.pixel_list import SignalMaps

LIT = Scene(centre=(0.004, -0.003, 0.36), room=0.25)


def untold(scene: Scene, seed: int = 0) -> RawCapture:
    return replace(draw(scene, calibration(), seed=seed), ambient=None)


@pytest.fixture(scope="module")
def maps() -> tuple[SignalMaps, Array, tuple[Light, ...]]:
    radiance = to_radiance(untold(LIT), Sensor())
    lights = pixel_list.lights_of(calibration(), radiance)
    return pixel_list.grey(radiance, lights), pixel_list.ray_map(radiance.signal.shape[1:3], calibration().camera), lights


@pytest.fixture(scope="module")
def seen_whole(maps: tuple[SignalMaps, Array, tuple[Light, ...]]) -> tuple[RoomLight, Found]:
    grey, rays_C, lights = maps
    light = whole.found(grey, rays_C, lights, 0.35)
    return light, mask_of.automatic(whole.taken_away(grey, light), rays_C, lights, 0.35)


def test_all_that_is_seen_tells_the_rooms_light_and_what_the_object_is(seen_whole: tuple[RoomLight, Found]) -> None:
    light, found = seen_whole
    true = truth(LIT)[0]
    assert np.sum(found.mask & true) / np.sum(found.mask | true) > 0.97
    for on, within in ((true, 0.25), (~true, 0.1)):
        assert np.median(light.A[on] / room_light(LIT)[on]) == pytest.approx(1.0, abs=within)


def test_the_wall_tells_its_place_and_its_room_light(
    maps: tuple[SignalMaps, Array, tuple[Light, ...]], seen_whole: tuple[RoomLight, Found]
) -> None:
    light, found = seen_whole
    wall = room.wall_of(*maps, found, ~found.mask, light)
    assert 1 / wall.q[2] == pytest.approx(LIT.wall_z, rel=0.01)
    grey, rays_C, lights = maps
    on = ~truth(LIT)[0]
    m = planes.predicted(wall.q, rays_C[on], lights) + wall.ratio / room.intensities(lights)
    A = wall.ratio * np.median(grey.signal[:, on] / m, axis=0)
    assert np.median(A / room_light(LIT)[on]) == pytest.approx(1.0, abs=0.05)


def test_a_background_that_the_lamps_do_not_reach_is_no_wall() -> None:
    scene = replace(LIT, wall_z=6.0)
    radiance = to_radiance(untold(scene), Sensor())
    lights = pixel_list.lights_of(calibration(), radiance)
    grey, rays_C = pixel_list.grey(radiance, lights), pixel_list.ray_map(radiance.signal.shape[1:3], calibration().camera)
    light = whole.found(grey, rays_C, lights, 0.35)
    found = mask_of.automatic(whole.taken_away(grey, light), rays_C, lights, 0.35)
    assert room.wall_of(grey, rays_C, lights, found, ~found.mask, light) is None
    true = truth(scene)[0]
    assert np.sum(found.mask & true) / np.sum(found.mask | true) > 0.97


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1])
def test_an_objects_room_light_comes_out_within_its_sigma(maps: tuple[SignalMaps, Array, tuple[Light, ...]], seed: int) -> None:
    _, rays_C, lights = maps
    mask, depth, _ = truth(LIT)
    grey = pixel_list.grey(to_radiance(untold(LIT, seed), Sensor()), lights)
    light = whole.found(grey, rays_C, lights, 0.35)
    found_by = mask_of.automatic(whole.taken_away(grey, light), rays_C, lights, 0.35)
    wall = room.wall_of(grey, rays_C, lights, found_by, ~mask, light)
    seen = pixel_list.list_pixels(grey, rays_C, mask, central=True)
    true = room_light(LIT)[mask]
    for told in (wall, None):
        law, A = room.on_object(seen, lights, depth[mask], told, None, light)
        assert abs(A.mean() / true.mean() - 1) < 2 * law.std
    law, A = room.on_object(seen, lights, depth[mask], wall, None)
    assert A.mean() == pytest.approx(true.mean(), rel=0.1)


@pytest.mark.slow
def test_the_surface_is_as_good_as_with_an_ambient_image_and_far_better_than_without() -> None:
    mask, depth, _ = truth(LIT)
    radiance = to_radiance(untold(LIT), Sensor())
    told = reconstruct(to_radiance(draw(LIT, calibration()), Sensor()), calibration(), Options(mask=mask))
    found = reconstruct(radiance, calibration(), Options(mask=mask, ambient_known=False))
    ignored = reconstruct(radiance, calibration(), Options(mask=mask))
    off_told, off_found, off_ignored = (abs(float(np.median((one.depth - depth)[mask]))) for one in (told, found, ignored))
    assert off_found < off_told + 0.003
    assert off_ignored > 0.004 + off_found
    assert found.figures.ambient.estimated is True
    (piece,) = found.components
    assert off_found < 2.5 * piece.scale_std * piece.mean_depth_m
    assert np.nanmedian(found.normal_std_deg) > np.nanmedian(told.normal_std_deg)
    more = without_ambient.doubted(found, replace(found, depth=1.024 * found.depth), room.Room(np.ones(4), room.PATCHY / 2), 0.1)
    assert more.components[0].scale_std == pytest.approx(np.hypot(piece.scale_std, np.log(1.024) / 2), rel=1e-3)


@pytest.mark.slow
def test_a_dark_room_is_left_dark(maps: tuple[SignalMaps, Array, tuple[Light, ...]]) -> None:
    _, rays_C, lights = maps
    scene = Scene()
    dark = draw(scene, calibration())
    grey = pixel_list.grey(to_radiance(dark, Sensor()), lights)
    mask, depth, _ = truth(scene)
    seen = pixel_list.list_pixels(grey, rays_C, mask, central=True)
    found = room.on_object(seen, lights, depth[mask], None, None)
    assert found is None or found[1].mean() < 0.01 * seen.signal.mean()


def test_colours_share_the_rooms_light(maps: tuple[SignalMaps, Array, tuple[Light, ...]]) -> None:
    scene = replace(LIT, albedo=(0.8, 0.5, 0.2))
    _, rays_C, lights = maps
    radiance = to_radiance(untold(scene), Sensor())
    grey = pixel_list.grey(radiance, lights)
    mask, depth, _ = truth(scene)
    room_map = np.zeros(mask.shape, np.float32)
    room_map[mask] = room.on_object(pixel_list.list_pixels(grey, rays_C, mask, central=True), lights, depth[mask], None, None)[1]
    ratio = without_ambient.without(radiance, room_map, lights).ambient[mask] / room_light(scene)[mask]
    assert np.median(ratio, axis=0) / np.median(ratio) == pytest.approx([1, 1, 1], abs=0.05)


@pytest.mark.parametrize("shadowed", [0, 1])
def test_samples_tell_their_room_light(shadowed: int) -> None:
    rng = np.random.default_rng(3)
    ways = rng.normal(size=(8, 3)) * [1, 1, 0.2] + [0, 0, -1.5]
    B = np.repeat((ways / np.linalg.norm(ways, axis=1, keepdims=True))[:, None], 200, axis=1)
    n = rng.normal(size=(200, 3)) * [0.3, 0.3, 0] + [0, 0, -1]
    b = rng.uniform(0.3, 1, (200, 1)) * n / np.linalg.norm(n, axis=1, keepdims=True)
    known = RoomPrior(rng.uniform(0.8, 1.25, 8), 0.3)
    A = 0.3 * np.linalg.norm(b, axis=1) * rng.uniform(0.8, 1.2, 200)
    m = np.maximum(np.einsum("lpi,pi->lp", B, b), 0)
    m[:shadowed] = 0
    signal, none = m + known.share[:, None] * A, np.zeros((8, 200))
    sigma, usable = np.full((8, 200), 1e-3), np.ones((8, 200), bool)
    found = ambient_sample_costs.free(signal, sigma, usable, B, none, known)
    assert np.median(np.abs(found.A / A - 1)) < 0.04
    assert np.median(found.information) > 0.6
    assert np.median(np.linalg.norm(found.b - b, axis=1) / np.linalg.norm(b, axis=1)) < 0.02
    assert np.median(found.cost) < 8 + 5 * shadowed
    white = m / np.linalg.norm(b, axis=1)
    white[:shadowed] = 0.5
    _, albedo, lit, told = ambient_sample_costs.planar(signal, sigma, usable, white, none, known)
    assert np.median(np.abs(told / A - 1)) < 0.02
    assert np.median(np.abs(albedo / np.linalg.norm(b, axis=1) - 1)) < 0.02
    assert not lit[:shadowed].any()
    assert np.median(ambient_sample_costs.nothing(known.share[:, None] * A, sigma, usable, none, known)[0]) < 1e-9


def test_a_level_is_as_sure_as_the_parts_of_the_picture_agree() -> None:
    """Blocks that each cost least at levels of their own: the mean of these within its standard error, and that as stated."""
    x, rng = np.linspace(-5, 0, 8), np.random.default_rng(3)
    of_block = rng.normal(-2.0, 0.6, (5, 5))
    everywhere = np.kron(of_block, np.ones((8, 8)))
    level, std = whole._by_blocks(x, 100 * (x[:, None, None] - everywhere) ** 2)
    assert level == pytest.approx(of_block.mean(), abs=std)
    assert std == pytest.approx(0.6 / 5, rel=0.3)
    assert whole._by_blocks(x, 100 * (x[:, None, None] - np.full_like(everywhere, -2.0)) ** 2)[1] < 0.03


def test_a_picture_that_says_nothing_leaves_what_is_known_of_rooms() -> None:
    level, std = whole._by_blocks(np.linspace(-5, 0, 8), np.full((8, 40, 40), 7.0))
    assert level == pytest.approx(np.log(whole.USUAL))
    assert std == pytest.approx(whole.USUAL_STD)


def test_a_place_that_no_lamp_reaches_tells_the_level_where_nothing_else_does() -> None:
    """Of a picture whose costs are the same at all levels; a place as dark as cloth says less than a bright one."""

    def level(far: float) -> tuple[float, float]:
        flat = np.zeros(1600)
        half = np.arange(1600) < 800
        return whole._level(lambda _: whole.Explained(flat, np.where(half, far, 0.0), half, ~half, flat + 1.0), (40, 40), 1.0)

    alone, std = whole._level(
        lambda _: whole.Explained(np.zeros(1600), np.zeros(1600), *np.zeros((2, 1600), bool), np.ones(1600)), (40, 40), 1.0
    )
    bright, bright_std = level(0.6)
    dark, dark_std = level(0.003)
    assert bright > 2 * alone
    assert bright_std < std
    assert dark > 0.01
    assert dark_std > bright_std


def test_an_estimate_of_the_rooms_light_is_no_picture_for_the_mask(monkeypatch: pytest.MonkeyPatch) -> None:
    given: list[Image | None] = []
    plain = mask_of.automatic

    def heard(*first: Any, **more: Any) -> Found:
        given.append(more["room"] if "room" in more else first[5] if len(first) > 5 else None)
        return plain(*first, **more)

    monkeypatch.setattr(mask_of, "automatic", heard)
    reconstruct(to_radiance(untold(LIT), Sensor()), calibration(), Options(ambient_known=False))
    assert len(given) > 2
    assert all(one is None for one in given)
