"""A drawn scene of spheres under a panel of wings, built within their tolerance, for the tests of the lights' geometry."""

from __future__ import annotations

import numpy as np

from lpcal.chain.h_pl_wings import design_lights
from lpcal.geometry import led_cluster, se3, sphere
from lpcal.geometry.wing import wing_transform
from lpcal.records.calibration import Camera, Wing, Wings
from lpcal.records.observations import SphereView

CAMERA = Camera((752, 480), "opencv5", np.array([[712.0, 0, 385], [0, 713, 231], [0, 0, 1]]), np.array([-0.3, 0.12, 0.0007, -0.0005, 0.0]))
SETTING_SIGMA = np.array([np.radians(0.5), np.radians(1.0), 0.0005, 0.0005])
DISC_SIGMA = np.array([np.radians(0.06)] * 3 + [0.0003] * 3)
DRAWN = [Wing(f"L{k}", np.radians(60.0 * k), np.radians(30.0), 0.103923, 0.085, 19) for k in range(6)]
RADIUS_M = 0.025


class Scene:
    """Chrome spheres under blobs of 19 scattered LEDs: outlines with a rim's bias, highlights at the centroid of the LEDs' images."""

    def __init__(self, seed: int, spheres: int = 4, clicked: dict[int, int] | None = None) -> None:
        rng = np.random.default_rng(seed)
        H_CD_true = se3.exp(np.array([0.006, -0.006, 0.004, -0.001, 0.001, 0.0035]))
        settings = np.array([[w.azimuth_rad, w.joint_angle_rad, w.d1_m, w.d2_m] for w in DRAWN])
        for row, clicks in (clicked or {}).items():
            settings[row, 1] += clicks * np.radians(10)
        self.H_CL = H_CD_true @ wing_transform(settings + rng.normal(size=settings.shape) * SETTING_SIGMA)
        H_CD_drawn = se3.exp(rng.normal(size=6) * DISC_SIGMA) @ H_CD_true
        self.wings: Wings = design_lights(DRAWN, H_CD_drawn, np.diag(DISC_SIGMA**2), SETTING_SIGMA, "test")
        self.leds_C = []
        offset, dome = rng.normal(-0.025, 0.002), rng.uniform(0.024, 0.029)
        for H_CL in self.H_CL:
            tilt = se3.rotation(rng.normal(size=(19, 3)) * np.radians(0.5))
            axes = (tilt @ led_cluster.led_axes(19)[..., None])[..., 0]
            place = se3.apply(H_CL, np.array([0, 0, offset]) + dome * axes)
            self.leds_C.append((place, se3.rotate(H_CL, axes), np.exp(rng.normal(size=19) * 0.04)))
        self.source_C = np.array([H[:3, 3] + offset * H[:3, 2] for H in self.H_CL])
        places = rng.uniform([-0.04, -0.035, 0.31], [0.045, 0.035, 0.38], (spheres, 3))
        bias_px = rng.normal(-0.25, 0.05)
        self.views = [self._view(k, centre, bias_px, rng) for k, centre in enumerate(places)]

    def _view(self, k: int, centre_C: np.ndarray, bias_px: float, rng: np.random.Generator) -> SphereView:
        pixels = CAMERA.project(sphere.outline(centre_C, RADIUS_M, np.linspace(0, 2 * np.pi, 360, endpoint=False)))
        middle = pixels.mean(axis=0)
        outward = (pixels - middle) / np.linalg.norm(pixels - middle, axis=1, keepdims=True)
        own = bias_px + rng.normal() * 0.01
        pixels = pixels + (own + rng.normal(size=(360, 1)) * 0.1) * outward + rng.normal(size=2) * 0.03
        seen = {}
        for light, (place, axis, power) in enumerate(self.leds_C):
            P = sphere.mirror_point(centre_C, RADIUS_M, place)
            ray = P - place
            r = np.linalg.norm(ray, axis=1)
            weight = power * np.maximum(np.sum(ray * axis, axis=1) / r, 0.0) ** 80.7 / r**2
            seen[f"L{light}"] = np.average(CAMERA.project(P), axis=0, weights=weight) + rng.normal(size=2) * 0.01
        return SphereView(f"chrome_{k}", "chrome", RADIUS_M, pixels, 0.1, seen, dict.fromkeys(seen, 0.015))
