"""Near lights whose axes do not meet: the light itself says how far away the object is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lit_scene import Scene, calibration, draw, truth
from lpcal.records.calibration import Lobe
from lpcal.records.observations import Radiance
from lpcal.surface import reconstruct
from lpcal.view import pixel_list


@pytest.mark.parametrize("kind", ["aimed", "parallel", "isotropic"])
def test_the_sweep_finds_the_distance(kind: str) -> None:
    given = calibration()
    change = {"aimed": {}, "parallel": {"axis_C": np.array([0.0, 0, 1])}, "isotropic": {"lobe": Lobe()}}[kind]
    given = replace(given, d_object_m=None, focus_C=None, lights=tuple(replace(light, **change) for light in given.lights))
    raw = draw(Scene(), given)
    mask, depth, _ = truth(Scene())
    signal = np.asarray(raw.images - raw.ambient.mean(axis=0), np.float32)
    radiance = Radiance("scene", raw.lights, signal, np.full(signal.shape, 0.003, np.float32), np.zeros(signal.shape, bool), None, ())
    maps, rays = pixel_list.grey(radiance, given.lights), pixel_list.ray_map(mask.shape, given.camera)
    assert reconstruct.distance_m(maps, rays, given.lights, mask) == pytest.approx(np.nanmedian(depth[mask]), rel=0.2)
    assert reconstruct.distance_m(maps, rays, given.lights, None) == pytest.approx(np.nanmedian(depth[mask]), rel=0.4)
