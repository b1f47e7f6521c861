"""Pictures of a chessboard by casting rays: averaged over pixels, blurred, shaded, noisy, of a board that may be bowed and twisted.

Nothing of lpcal's camera is used: rays come from OpenCV's inverse, and corners are where the pattern's edges cross.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass, field

import cv2
import numpy as np

K = np.array([[560.0, 0, 323.7], [0, 561.5, 236.4], [0, 0, 1]])
LENS = np.array([-0.28, 0.1, 0.0006, -0.0004, 0.0])
SIZE = (640, 480)
SUPER = 1
"""Rays along a side of a pixel; the pattern itself is averaged, so that one is nearly as good as six."""


@dataclass(frozen=True)
class Pattern:
    corners: tuple[int, int] = (9, 6)
    square_m: tuple[float, float] = (0.025, 0.025)
    bow_m: tuple[float, float] = (0.0, 0.0)
    twist_m: float = 0.0
    first_black: bool = True

    def height(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Surface z over x, y; zero mean over the corners is not asked for."""
        u = x / ((self.corners[0] - 1) * self.square_m[0])
        v = y / ((self.corners[1] - 1) * self.square_m[1])
        return 4 * self.bow_m[0] * u * (1 - u) + 4 * self.bow_m[1] * v * (1 - v) + self.twist_m * (2 * u - 1) * (2 * v - 1)

    def points(self) -> np.ndarray:
        x, y = np.meshgrid(np.arange(self.corners[0]) * self.square_m[0], np.arange(self.corners[1]) * self.square_m[1])
        return np.stack([x, y, self.height(x, y)], axis=-1).reshape(-1, 3)

    def light(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Reflectance at points (H, W): squares averaged over a pixel, a white margin of 0.7 squares, grey beyond."""
        i, j = x / self.square_m[0], y / self.square_m[1]
        nx, ny = self.corners
        squares = (i >= -1) & (i < nx) & (j >= -1) & (j < ny)
        paper = (i >= -1.7) & (i < nx + 0.7) & (j >= -1.7) & (j < ny + 0.7)
        wave = _wave(i) * _wave(j) * (-1 if self.first_black else 1)
        return np.where(squares, 0.455 + 0.395 * wave, np.where(paper, 0.85, 0.35))


def _wave(i: np.ndarray) -> np.ndarray:
    """Square wave, 1 from 0 to 1 and -1 from 1 to 2, averaged over each pixel of i (H, W)."""
    width = np.maximum(np.hypot(*np.gradient(i)), 1e-9)

    def integral(at: np.ndarray) -> np.ndarray:
        return 1 - np.abs(np.mod(at, 2) - 1)

    return (integral(i + width / 2) - integral(i - width / 2)) / width


@dataclass(frozen=True)
class Studio:
    K: np.ndarray = field(default_factory=lambda: K)
    lens: np.ndarray = field(default_factory=lambda: LENS)
    size: tuple[int, int] = SIZE

    def rays(self) -> np.ndarray:
        """(SUPER * h, SUPER * w, 3) with z = 1."""
        return _rays(self.K.tobytes(), self.lens.tobytes(), self.size)

    def project(self, H_CB: np.ndarray, points: np.ndarray) -> np.ndarray:
        phi = cv2.Rodrigues(np.ascontiguousarray(H_CB[:3, :3]))[0]
        return cv2.projectPoints(points.reshape(-1, 1, 3), phi, H_CB[:3, 3], self.K, self.lens)[0].reshape(-1, 2)

    def picture(self, H_CB: np.ndarray, pattern: Pattern, *, blur: float = 0.7, rays: np.ndarray | None = None) -> np.ndarray:
        """Noise-free light (h, w), about 0 to 1, shaded by a fifth from side to side."""
        rays = self.rays() if rays is None else rays
        R, t = H_CB[:3, :3], H_CB[:3, 3]
        d_B, o_B = rays @ R, -R.T @ t
        z = np.zeros(rays.shape[:2])
        for _ in range(4 if any(pattern.bow_m) or pattern.twist_m else 1):
            s = (z - o_B[2]) / d_B[..., 2]
            x, y = o_B[0] + s * d_B[..., 0], o_B[1] + s * d_B[..., 1]
            z = pattern.height(np.clip(x, -0.1, 0.5), np.clip(y, -0.1, 0.5))
        fine = np.where(s > 0, pattern.light(x, y), 0.35)
        h, w = self.size[1], self.size[0]
        coarse = fine.reshape(h, SUPER, w, SUPER).mean(axis=(1, 3))
        shade = np.linspace(0.9, 1.1, w)[None, :] * np.linspace(1.05, 0.95, h)[:, None]
        return cv2.GaussianBlur(coarse * shade, (0, 0), blur) if blur > 0 else coarse * shade


@functools.lru_cache(4)
def _rays(K: bytes, lens: bytes, size: tuple[int, int]) -> np.ndarray:
    """The rays of a camera, drawn once for all of its pictures."""
    w, h = size
    steps = (np.arange(SUPER) + 0.5) / SUPER - 0.5
    u = (np.arange(w)[:, None] + steps).ravel()
    v = (np.arange(h)[:, None] + steps).ravel()
    pixels = np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 1, 2)
    criteria = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 60, 1e-12)
    matrix, coefficients = np.frombuffer(K).reshape(3, 3), np.frombuffer(lens)
    plane = cv2.undistortPoints(pixels, matrix, coefficients, criteria=criteria).reshape(len(v), len(u), 2)
    found = np.concatenate([plane, np.ones((*plane.shape[:2], 1))], axis=-1)
    found.flags.writeable = False
    return found


def exposed(light: np.ndarray, seed: int, *, noise: float = 2.0, bits: int = 8) -> np.ndarray:
    """Stored numbers: noise is in steps of 8 bit; 16 stores 12 bits in the low end of 16."""
    rng = np.random.default_rng(seed)
    grey = 235 * light + noise * rng.standard_normal(light.shape)
    if bits == 8:
        return np.clip(np.rint(grey), 0, 255).astype(np.uint8)
    return np.clip(np.rint(grey * 16), 0, 4095).astype(np.uint16)


def poses(count: int, seed: int, pattern: Pattern = Pattern(), studio: Studio = Studio()) -> np.ndarray:
    """H_CB (count, 4, 4) with the whole board in the picture, tilted up to 40 degrees, rolled by any angle under 60."""
    rng = np.random.default_rng(seed)
    points = pattern.points()
    found: list[np.ndarray] = []
    middle = points.mean(axis=0)
    while len(found) < count:
        tilt = rng.uniform(8, 40) * np.pi / 180
        way = rng.uniform(0, 2 * np.pi)
        R = cv2.Rodrigues(tilt * np.array([np.cos(way), np.sin(way), 0]))[0] @ cv2.Rodrigues(np.array([0, 0, rng.uniform(-1, 1)]))[0]
        distance = rng.uniform(0.3, 0.55)
        spot = np.array([*rng.uniform([-0.25, -0.18], [0.25, 0.18]), 1.0]) * distance
        H_CB = np.eye(4)
        H_CB[:3, :3], H_CB[:3, 3] = R, spot - R @ middle
        rim = pattern.square_m[0]
        outer = np.array([[-rim, -rim, 0], [points[-1, 0] + rim, -rim, 0], [-rim, points[-1, 1] + rim, 0], points[-1] + [rim, rim, 0]])
        pixels = studio.project(H_CB, np.concatenate([points, outer]))
        if np.all(pixels > 8) and np.all(pixels < np.array(studio.size) - 9):
            found.append(H_CB)
    return np.array(found)
