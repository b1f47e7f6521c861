"""What a reading of the distance sensor does to a surface: joined with the light's word, weighed where it may be of the wall."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import lpcal
from lit_scene import SIZE, K, Scene, calibration, draw, truth
from lpcal.records.calibration import Camera
from lpcal.records.distance import DistanceSensor
from lpcal.records.observations import RawCapture
from lpcal.surface.distance_search import DistanceMinima, DistanceMinimum
from lpcal.surface.sensor_reading import DepthMap, Reading, fused, weighed

CAMERA = Camera(SIZE, "opencv4", K, np.zeros(4))
U = np.array([-0.08, 0.0, 1.0]) / np.linalg.norm([-0.08, 0.0, 1.0])
COVARIANCE = np.diag([1e-3**2] * 3 + [2e-3**2] * 3 + [1e-3**2, 0.0])
SENSOR = DistanceSensor(np.array([0.03, 0.0, 0.0]), U, bias_m=0.004, scale=1.01, noise_m=0.005, covariance=COVARIANCE)
FRONT = DepthMap(np.full(SIZE[::-1], 0.36), CAMERA)


def reading_of(depth_m: float) -> Reading:
    """What the sensor reads of a front at a depth."""
    return Reading(SENSOR, 0.004 + 1.01 * depth_m / U[2])


def test_a_reading_and_the_light_are_joined_by_their_variances() -> None:
    light_std = 0.02
    found = fused(reading_of(0.37), FRONT, light_std)
    sensor_std = np.hypot(SENSOR.std_m(0.37), 0.5 * SENSOR.across_std_m(0.37)) / 0.36
    share = light_std**2 / (light_std**2 + sensor_std**2)
    assert found.log_scale == pytest.approx(share * np.log(0.37 / 0.36), rel=0.06)
    assert found.std == pytest.approx(light_std * np.sqrt(1 - share), rel=0.06)
    assert found.hit > 0.95
    assert found.expected_m == pytest.approx(0.36 / U[2], abs=1e-3)


def test_a_reading_of_the_wall_moves_nothing() -> None:
    found = fused(reading_of(0.62), FRONT, 0.02)
    assert (found.log_scale, found.std) == (0.0, 0.02)
    assert found.hit < 0.01


def test_a_beam_beside_the_object_says_nothing_of_it() -> None:
    depth = FRONT.depth.copy()
    depth[:, : SIZE[0] // 2 + 20] = np.nan  # the beam comes from the right and crosses to the left
    found = fused(reading_of(0.36), DepthMap(np.where(np.arange(SIZE[0]) < 20, 0.36, np.nan) + 0 * depth, CAMERA), 0.02)
    assert found.hit < 0.5


def test_two_distances_that_the_light_allows_are_told_apart() -> None:
    """Two ends of nearly one cost, 0.30 and 0.41 m: the reading decides, and one of the wall leaves the order as it is."""
    mask = np.ones((SIZE[1] // 4, SIZE[0] // 4), bool)
    ends = tuple(DistanceMinimum(np.full(mask.sum(), np.log(z)), cost) for z, cost in ((0.30, 6.0), (0.41, 6.1)))
    both = DistanceMinima(ends, mask, 4, 6, 0.35)
    assert both.others()
    first = [float(np.exp(weighed(both, read, CAMERA).ends[0].u[0])) for read in (reading_of(0.305), reading_of(0.405), reading_of(0.8))]
    assert np.allclose(first, [0.30, 0.41, 0.30])
    assert weighed(both, reading_of(0.405), CAMERA).others() == []
    assert weighed(both, None, CAMERA) is both


@pytest.fixture(scope="module")
def capture() -> RawCapture:
    return draw(Scene(), calibration())


def test_a_capture_with_a_reading_is_put_where_it_says_and_says_so(capture: RawCapture) -> None:
    mask, depth, _ = truth(Scene())
    sensor = replace(SENSOR, noise_m=0.0005, covariance=np.zeros((8, 8)))
    t = np.arange(0.2, 0.5, 1e-4)
    x = sensor.position_C + t[:, None] * U
    pixel = np.rint(CAMERA.project(x)).astype(int)
    over = mask[pixel[:, 1], pixel[:, 0]] & (x[:, 2] >= depth[pixel[:, 1], pixel[:, 0]])
    t_hit = t[np.argmax(over)]
    rig = replace(calibration(), distance_sensor=sensor)
    raw = replace(capture, distance_m=float(0.004 + 1.01 * t_hit))
    surface = lpcal.reconstruct(raw, rig, mask=mask)
    found = surface.figures.distance_reading
    assert found.hit > 0.9
    inside = surface.mask & mask
    assert abs(np.median(surface.depth[inside] - depth[inside])) < 0.0012
    assert surface.components[0].scale_std < 0.004
    assert not any("distance sensor" in note for note in surface.warnings)


@pytest.mark.slow
@pytest.mark.parametrize("noise", [0.002, 0.004])
def test_a_capture_whose_light_allows_several_distances_is_settled_by_a_reading(noise: float) -> None:
    """Three lights: rounds from seven distances end at seven, four of them within the odds; a reading of 5 mm noise picks the right one."""
    lights = calibration(lights=3)
    raw = draw(Scene(), lights, noise=noise)
    mask, depth, _ = truth(Scene())
    try:
        assert lpcal.reconstruct(raw, lights, mask=mask).components[0].alternatives
    except lpcal.errors.DegenerateError as error:
        if "outside the working volume" not in str(error):
            raise
    t = np.arange(0.2, 0.5, 1e-4)
    x = SENSOR.position_C + t[:, None] * U
    pixel = np.rint(CAMERA.project(x)).astype(int)
    t_hit = t[np.argmax(mask[pixel[:, 1], pixel[:, 0]] & (x[:, 2] >= depth[pixel[:, 1], pixel[:, 0]]))]
    read = float(0.004 + 1.01 * t_hit + 0.005 * np.random.default_rng(1).standard_normal())
    settled = lpcal.reconstruct(replace(raw, distance_m=read), replace(lights, distance_sensor=SENSOR), mask=mask)
    piece = settled.components[0]
    assert float(np.median(np.abs(settled.depth - depth)[settled.mask & mask])) < 2.5 * piece.scale_std * piece.mean_depth_m < 0.015
    assert piece.alternatives == ()
