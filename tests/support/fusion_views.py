"""Placed surfaces of a stone, cast by rays: no reconstruction, but the errors that reconstructions have."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from scipy.ndimage import gaussian_filter

from lpcal.geometry import se3
from lpcal.records.placement import Placement
from lpcal.records.surface import Component, Surface
from lpcal.simulate import shapes
from lpcal.simulate.rays import cast

SIZE = (128, 100)
FOCAL_PX = 190.0
DISTANCE_M = 0.35
SCALE_STD = 0.004
BEND_STD = 0.0012
H_PC_STD = np.array([np.radians(0.04)] * 3 + [0.0004] * 3)


@dataclass(frozen=True)
class Scene:
    """Surfaces with errors, the object, and where it stands."""

    surfaces: tuple[Surface, ...]
    shape: shapes.Shape
    H_OS: np.ndarray
    true_H_OC: np.ndarray

    def off_m(self, x_O: np.ndarray) -> np.ndarray:
        """How far points are outside the true surface."""
        x_S = se3.apply(se3.inv(self.H_OS), x_O)
        step = 1e-5 * self.shape.normal(x_S)
        rise = (self.shape.distance(x_S + step) - self.shape.distance(x_S - step)) / 2e-5
        return self.shape.distance(x_S) / rise

    def normals(self, x_O: np.ndarray) -> np.ndarray:
        """True normals near points."""
        return se3.rotate(self.H_OS, self.shape.normal(se3.apply(se3.inv(self.H_OS), x_O)))


@cache
def scene(kind: str = "stone", count: int = 10, seed: int = 3) -> Scene:
    """Views all round an object."""
    shape = {**shapes.ROUND, **shapes.SHAPES}[kind](0.045)
    rng = np.random.default_rng(seed)
    H_OS = se3.transform(se3.rotation(np.array([np.pi, 0.3, 0.0])), np.array([1.0, 1.2, 0.4]))
    H_PC = se3.exp(np.array([0.02, 0.03, -0.01, 0.004, -0.003, 0.01]))
    off = H_PC_STD * rng.standard_normal(6)
    surfaces, true_H_OC = [], []
    for k in range(count):
        azimuth, elevation = 2 * np.pi * k / (count - 2), [0.15, -0.2][k % 2]
        if k >= count - 2:
            azimuth, elevation = 1.0, [1.2, -1.2][k % 2]
        z = np.array([np.sin(azimuth) * np.cos(elevation), np.sin(elevation), np.cos(azimuth) * np.cos(elevation)])
        x = np.cross([0, 1, 0], z) / np.linalg.norm(np.cross([0, 1, 0], z))
        H_CS = se3.transform(np.stack([x, np.cross(z, x), z]), np.array([0, 0, DISTANCE_M]))
        H_OC = H_OS @ se3.inv(H_CS)
        surfaces.append(
            replace(_seen(shape, H_CS, np.random.default_rng([seed, k])), name=f"stop_{k:02d}", placement=_placed(H_OC, H_PC, off, rng))
        )
        true_H_OC.append(H_OC)
    return Scene(tuple(surfaces), shape, H_OS, np.array(true_H_OC))


def _placed(H_OC: np.ndarray, H_PC: np.ndarray, off: np.ndarray, rng: np.random.Generator) -> Placement:
    T = np.linalg.inv(se3.turn_and_origin_jacobian(H_OC))
    noise = T @ np.diag([np.radians(0.05) ** 2] * 3 + [0.0002**2] * 3) @ T.T
    by = se3.adjoint(H_OC @ se3.inv(H_PC))
    xi = np.linalg.cholesky(noise) @ rng.standard_normal(6) + by @ off
    return Placement(se3.exp(-xi) @ H_OC, noise + by @ np.diag(H_PC_STD**2) @ by.T, noise_covariance=noise, by_handeye=by)


def _seen(shape: shapes.Shape, H_CS: np.ndarray, rng: np.random.Generator) -> Surface:
    width, height = SIZE
    row, column = np.mgrid[0:height, 0:width].astype(float)
    x, y = (column - (width - 1) / 2) / FOCAL_PX, (row - (height - 1) / 2) / FOCAL_PX
    bent = 1 + 0.2 * (x * x + y * y)
    rays = np.stack([x * bent, y * bent, np.ones_like(x)], axis=-1)
    d_C = rays.reshape(-1, 3) / np.linalg.norm(rays.reshape(-1, 3), axis=1, keepdims=True)
    H_SC = se3.inv(H_CS)
    t = cast(shape, H_SC[:3, 3], se3.rotate(H_SC, d_C))
    on = np.isfinite(t)
    x_S = H_SC[:3, 3] + t[on, None] * se3.rotate(H_SC, d_C[on])
    depth, normals, albedo = np.full(len(t), np.nan), np.full((len(t), 3), np.nan), np.full(len(t), np.nan)
    depth[on], normals[on] = t[on] * d_C[on, 2], se3.rotate(H_CS, shape.normal(x_S))
    albedo[on] = 0.6 + 0.2 * np.sin(x_S[:, 0] / 0.004)
    mask, depth_map = on.reshape(height, width), depth.reshape(height, width)
    grown = np.exp(rng.normal(0, SCALE_STD) + BEND_STD * _smooth(rng, 18) + 1e-4 * rng.standard_normal(mask.shape))
    tilt = np.stack([np.radians(0.8) * _smooth(rng, 4) for _ in range(3)], axis=-1)
    normals = normals.reshape(height, width, 3) + tilt
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    breaks = np.ones((2, height, width), bool)
    breaks[0, :, :-1] = ~(np.abs(np.diff(depth_map, axis=1)) < 0.006)
    breaks[1, :-1] = ~(np.abs(np.diff(depth_map, axis=0)) < 0.006)
    single = np.float32
    return Surface(
        name="view",
        normals=normals.astype(single),
        depth=(depth_map * grown).astype(single),
        albedo=(albedo.reshape(height, width) * np.exp(rng.normal(0, 0.05))).astype(single),
        mask=mask,
        normal_std_deg=np.where(mask, single(1.0), single(np.nan)),
        depth_std=np.where(mask, single(BEND_STD * DISTANCE_M), single(np.nan)),
        lights_used=np.where(mask, 6, 0).astype(np.uint8),
        component=mask.astype(np.uint8),
        rays_C=rays,
        components=(Component(1, int(mask.sum()), float(np.nanmedian(depth_map)), SCALE_STD),),
        breaks=breaks,
    )


def _smooth(rng: np.random.Generator, length_px: float) -> np.ndarray:
    found = gaussian_filter(rng.standard_normal(SIZE[::-1]), length_px, mode="wrap")
    return found / found.std()
