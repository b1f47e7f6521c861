"""How the light at a point changes as it moves away from the camera, beside differences of the light itself."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lit_scene import calibration
from lpcal.geometry import led_cluster
from lpcal.records.calibration import Light
from lpcal.records.lobes import LedCluster, Lobe
from lpcal.view.pixel_list import light_slopes


def lamp(kind: str) -> Light:
    one = calibration().lights[0]
    if kind == "distant":
        return replace(one, source_C=None, axis_C=None, H_CL=None)
    if kind == "lobe":
        return replace(one, lobe=Lobe())
    axes = led_cluster.led_axes(7)
    H_CL = np.eye(4)
    H_CL[:3, 3] = [0.1, 0.02, -0.03]
    turn = np.radians(-20)
    H_CL[:3, :3] = [[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]]
    leds = LedCluster(0.01 * axes, axes, np.linspace(0.8, 1.2, 7), 40.0)
    return replace(one, H_CL=H_CL, lobe=Lobe(leds=leds), source_C=H_CL[:3, 3], axis_C=H_CL[:3, 2], intensity=np.array([0.9, 1.0, 1.3]))


@pytest.mark.parametrize("kind", ["leds", "lobe", "distant"])
def test_the_light_changes_with_distance_as_its_slope_says(kind: str) -> None:
    lights = [lamp(kind)]
    x_C = np.random.default_rng(2).uniform([-0.1, -0.1, 0.2], [0.1, 0.1, 0.5], (200, 3))

    def B(log_scale: float) -> np.ndarray:
        d, E = lights[0].unit_field(x_C * np.exp(log_scale))  # in double precision, as differences need
        return d * E[..., None]

    step = 1e-4
    differences = (8 * (B(step) - B(-step)) - (B(2 * step) - B(-2 * step))) / (12 * step)
    np.testing.assert_allclose(light_slopes(lights, x_C)[0], differences, rtol=0, atol=1e-5 * max(np.abs(differences).max(), 1e-9))
    assert kind == "distant" or np.abs(differences).max() > 0.5 * np.abs(B(0.0)).max()
