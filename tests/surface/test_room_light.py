"""Without an ambient image the room's light is estimated: how near it comes, what it does to the surface, and when it is left alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lit_scene import Scene, calibration, draw, room_light, truth
from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.surface import sight, without_ambient
from lpcal.surface import without_ambient as room
from lpcal.surface.reconstruct import Options, reconstruct

LIT = Scene(centre=(0.004, -0.003, 0.36), room=0.25)


def untold(scene: Scene, seed: int = 0):
    return replace(draw(scene, calibration(), seed=seed), ambient=None)


@pytest.fixture(scope="module")
def maps():
    radiance = to_radiance(untold(LIT), Sensor())
    lights = sight.lights_of(calibration(), radiance)
    return sight.grey(radiance, lights), sight.ray_map(radiance.signal.shape[1:3], calibration().camera), lights


def test_the_wall_tells_its_place_and_its_room_light(maps):
    grey, rays_C, lights = maps
    wall = room.wall_of(grey, rays_C, lights, 0.35)
    assert 1 / wall.q[2] == pytest.approx(LIT.wall_z, rel=0.01)
    on = ~truth(LIT)[0]
    found = room.on_wall(wall, grey, rays_C, lights)
    assert np.median(found[on] / room_light(LIT)[on]) == pytest.approx(1.0, abs=0.05)


def test_a_background_that_the_lamps_do_not_reach_tells_nothing():
    radiance = to_radiance(untold(replace(LIT, wall_z=6.0)), Sensor())
    lights = sight.lights_of(calibration(), radiance)
    rays_C = sight.ray_map(radiance.signal.shape[1:3], calibration().camera)
    assert room.wall_of(sight.grey(radiance, lights), rays_C, lights, 0.35) is None


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1])
def test_an_objects_room_light_comes_out_within_its_sigma(maps, seed):
    _, rays_C, lights = maps
    mask, depth, _ = truth(LIT)
    grey = sight.grey(to_radiance(untold(LIT, seed), Sensor()), lights)
    wall = room.wall_of(grey, rays_C, lights, 0.35)
    seen = sight.look_at(grey, rays_C, mask, central=True)
    true = room_light(LIT)[mask]
    for told in (wall, None):
        law, A = room.on_object(seen, lights, depth[mask], told, None)
        assert abs(A.mean() / true.mean() - 1) < 2 * law.std
    law, A = room.on_object(seen, lights, depth[mask], wall, None)
    assert A.mean() == pytest.approx(true.mean(), rel=0.1)


@pytest.mark.slow
def test_the_surface_is_as_good_as_with_an_ambient_image_and_far_better_than_without():
    mask, depth, _ = truth(LIT)
    radiance = to_radiance(untold(LIT), Sensor())
    told = reconstruct(to_radiance(draw(LIT, calibration()), Sensor()), calibration(), Options(mask=mask))
    found = reconstruct(radiance, calibration(), Options(mask=mask, ambient_known=False))
    ignored = reconstruct(radiance, calibration(), Options(mask=mask))
    off_told, off_found, off_ignored = (abs(float(np.median((one.depth - depth)[mask]))) for one in (told, found, ignored))
    assert off_found < off_told + 0.002
    assert off_ignored > 0.004 + off_found
    assert found.figures.ambient.estimated is True
    (piece,) = found.components
    assert off_found < 2.5 * piece.scale_std * piece.mean_depth_m
    assert np.nanmedian(found.normal_std_deg) > np.nanmedian(told.normal_std_deg)
    by_light = replace(found, figures=replace(found.figures, shadow_anchors={}))  # a shadow's place has no intensities in it
    more = without_ambient.doubted(by_light, replace(found, depth=1.024 * found.depth), room.Room(np.ones(4), room.PATCHY / 2), 0.1)
    assert more.components[0].scale_std == pytest.approx(np.hypot(piece.scale_std, np.log(1.024) / 2), rel=1e-3)


@pytest.mark.slow
def test_a_dark_room_is_left_dark(maps):
    _, rays_C, lights = maps
    scene = Scene()
    dark = draw(scene, calibration())
    grey = sight.grey(to_radiance(dark, Sensor()), lights)
    mask, depth, _ = truth(scene)
    seen = sight.look_at(grey, rays_C, mask, central=True)
    found = room.on_object(seen, lights, depth[mask], None, None)
    assert found is None or found[1].mean() < 0.01 * seen.signal.mean()


def test_colours_share_the_rooms_light(maps):
    scene = replace(LIT, albedo=(0.8, 0.5, 0.2))
    _, rays_C, lights = maps
    radiance = to_radiance(untold(scene), Sensor())
    grey = sight.grey(radiance, lights)
    mask, depth, _ = truth(scene)
    room_map = np.zeros(mask.shape, np.float32)
    room_map[mask] = room.on_object(sight.look_at(grey, rays_C, mask, central=True), lights, depth[mask], None, None)[1]
    ratio = without_ambient.without(radiance, room_map, lights).ambient[mask] / room_light(scene)[mask]
    assert np.median(ratio, axis=0) / np.median(ratio) == pytest.approx([1, 1, 1], abs=0.05)
