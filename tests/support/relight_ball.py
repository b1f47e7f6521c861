"""A ball as a surface, and three lights about the camera: what the tests of the relighting page draw."""

from __future__ import annotations

from typing import Any

import numpy as np

from lpcal.geometry import camera as central
from lpcal.records.calibration import Calibration, Light, Lobe
from lpcal.records.surface import Surface

SIZE = (150, 200)
K = np.array([[260.0, 0, 101], [0, 261.0, 73], [0, 0, 1]])
DISTORTION = np.array([-0.25, 0.08, 1e-3, -5e-4])
CENTRE, RADIUS = np.array([0.01, -0.005, 0.4]), 0.09


def ball(*, perspective: bool, colour: bool = False) -> Surface:
    """A ball as a camera sees it, or an orthographic one in pixels."""
    h, w = SIZE
    x, y = np.meshgrid(np.arange(w, dtype=float), np.arange(h, dtype=float))
    if perspective:
        rays = central.unproject(np.stack([x, y], axis=-1), K, DISTORTION)
        along = rays @ CENTRE
        inside = along**2 - CENTRE @ CENTRE + RADIUS**2
        mask = inside > (0.2 * RADIUS) ** 2
        points = (along - np.sqrt(np.where(mask, inside, 0)))[..., None] * rays
        normals, depth, rays = (points - CENTRE) / RADIUS, points[..., 2], rays / rays[..., 2:]
    else:
        normals = np.stack([(x - 95) / 60, (y - 70) / 60, np.zeros_like(x)], axis=-1)
        mask = (normals**2).sum(axis=-1) < 0.95
        normals[..., 2] = -np.sqrt(np.where(mask, 1 - (normals**2).sum(axis=-1), 1))
        depth, rays = 60 * normals[..., 2], np.broadcast_to([0.0, 0.0, 1.0], (h, w, 3))
    albedo = 0.6 + 0.3 * np.sin(x / 7) * np.cos(y / 9)
    albedo = np.stack([albedo, 0.8 * albedo, 0.5 * albedo], axis=-1) if colour else albedo
    sigma = 1 + x / w

    def outside_nan(value: Any) -> Any:
        return np.where(mask.reshape(mask.shape + (1,) * (value.ndim - 2)), value, np.nan).astype(np.float32)

    return Surface(
        name="ball",
        normals=outside_nan(normals),
        depth=outside_nan(depth),
        albedo=outside_nan(albedo),
        mask=mask,
        normal_std_deg=outside_nan(sigma),
        depth_std=outside_nan(2e-5 * sigma),
        lights_used=np.where(mask, 6, 0).astype(np.uint8),
        component=mask.astype(np.uint8),
        rays_C=np.asarray(rays),
    )


def lights(*, near: bool) -> Calibration:
    """Three lights about the camera, all near or all distant."""
    found = []
    for k in range(3):
        source = np.array([0.2 * np.cos(2.1 * k), 0.2 * np.sin(2.1 * k), 0.02])
        axis = (CENTRE - source) / np.linalg.norm(CENTRE - source)
        place = {"source_C": source, "axis_C": axis, "lobe": Lobe("cosine", exponent=3.0)} if near else {}
        found.append(Light(name=f"L{k}", direction_C=-axis, intensity=np.array([1.0 + 0.1 * k]), **place))
    return Calibration("three", tuple(found))
