"""Captures of a surface under distant lights, drawn with what the solver's model lacks: gloss, cast shadows, quantised and curved numbers.

A height z (towards the camera) over a square of pixels, parallel rays, albedo with a texture; shading n.s, a lobe of gloss about the half
vector (Blinn 1977), shadows by marching towards each light.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.tone_curve import Gamma, encode
from lpcal.records.calibration import Calibration, Light
from lpcal.records.observations import RawCapture


@dataclass(frozen=True)
class Recipe:
    """What is drawn."""

    lights: int = 20
    spread: float = 0.0
    """One sigma of the logarithm of the lights' powers."""
    gamma: Gamma = 1.0
    gloss: float = 0.0
    """Of the brightest albedo."""
    shine: float = 30.0
    bumps: int = 0
    """Hills and dents beside the ball."""
    room: float = 0.0
    """Light from all sides, of full scale, in the images and in the ambient one."""
    bits: int = 8
    noise: float = 0.002
    most_slant_deg: float = 60.0
    size: int = 80
    """Side of the picture in pixels."""


@dataclass(frozen=True)
class Drawn:
    """A capture with its truth, in C (x right, y down, z forward)."""

    raw: RawCapture
    calibration: Calibration
    """The lights as an .lp has them: directions, equal powers."""
    normals: np.ndarray
    """(H, W, 3)."""
    mask: np.ndarray
    intensity: np.ndarray
    """(L,) true."""


def draw(recipe: Recipe, seed: int) -> Drawn:
    """One capture."""
    rng = np.random.default_rng(seed)
    z, mask = heights(recipe, rng)
    dy, dx = np.gradient(z)
    n = np.stack([dx, dy, -np.ones_like(z)], axis=-1) * [-1, -1, 1]  # C: z forward, the height grows towards the camera
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    S = directions(recipe, rng)
    power = np.exp(recipe.spread * rng.standard_normal(len(S)))
    power /= power.mean()
    row, column = np.indices(z.shape)
    albedo = rng.uniform(0.5, 0.9) * (1 + 0.2 * np.sin(0.3 * row + rng.uniform(0, 6)) * np.sin(0.23 * column))
    half = S + np.array([0, 0, -1])
    half /= np.linalg.norm(half, axis=1, keepdims=True)
    images = []
    for s, h, one in zip(S, half, power, strict=True):
        facing = np.maximum(n @ s, 0)
        shine = recipe.gloss * np.maximum(n @ h, 0) ** recipe.shine * (facing > 0)
        images.append(one * (albedo * facing + shine) * ~shadowed(z, s))
    stack = np.stack(images) * mask
    stack *= (0.95 - recipe.room) / np.quantile(stack[:, mask], 0.9995)
    room = recipe.room * albedo * mask
    full = 2**recipe.bits - 1

    def stored(linear: np.ndarray) -> np.ndarray:
        noisy = linear + np.sqrt(recipe.noise**2 + 1e-5 * linear) * rng.standard_normal(linear.shape)
        return (np.clip(np.rint(full * encode(np.clip(noisy, 0, 1), recipe.gamma)), 0, full) / full).astype(np.float32)

    names = tuple(f"L{k}" for k in range(len(S)))
    raw = RawCapture("drawn", names, stored(stack + room), np.ones(len(S)), stored(room)[None], np.ones(1), mask=mask, step=1 / full)
    calibration = Calibration("drawn", tuple(Light(name, s, np.ones(1)) for name, s in zip(names, S, strict=True)))
    return Drawn(raw, calibration, n, mask, power)


def heights(recipe: Recipe, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Heights (H, W) in pixels and the mask of the object."""
    size, middle = recipe.size, (recipe.size - 1) / 2
    row, column = np.indices((size, size))
    r2 = (row - middle) ** 2 + (column - middle) ** 2
    radius = 0.47 * size
    ball = np.sqrt(np.maximum(radius**2 - r2, 4.0))
    z = ball if recipe.bumps == 0 else 0.45 * ball
    for _ in range(recipe.bumps):
        y, x = rng.uniform(0.2, 0.8, 2) * size
        width = rng.uniform(0.05, 0.14) * size
        z = z + rng.choice([-1, 1]) * rng.uniform(0.5, 1.1) * width * np.exp(-((row - y) ** 2 + (column - x) ** 2) / (2 * width**2))
    return z, r2 < (0.97 * radius) ** 2


def directions(recipe: Recipe, rng: np.random.Generator) -> np.ndarray:
    """Unit vectors (L, 3) towards the lights, spread over a cap round the camera (Fibonacci's spiral, turned and shaken)."""
    k = np.arange(recipe.lights) + 0.5
    low = np.cos(np.radians(recipe.most_slant_deg)) if recipe.lights > 8 else np.cos(np.radians(0.75 * recipe.most_slant_deg))
    top = 0.98 if recipe.lights > 8 else 0.85
    away = top - (top - low) * k / recipe.lights
    turn = 2.39996 * k + rng.uniform(0, 6)
    flat = np.sqrt(1 - away**2)
    S = np.stack([flat * np.cos(turn), flat * np.sin(turn), -away], axis=1) + 0.03 * rng.standard_normal((recipe.lights, 3))
    return S / np.linalg.norm(S, axis=1, keepdims=True)


def shadowed(z: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Pixels (H, W) that heights z hide from the light in direction s (3,) of C."""
    import cv2

    across = np.hypot(s[0], s[1])
    if across < 1e-6:
        return np.zeros(z.shape, bool)
    row, column = np.indices(z.shape).astype(np.float32)
    rise, hidden = -s[2] / across, np.zeros(z.shape, bool)
    for step in np.arange(1.0, 0.7 * len(z), 1.0):
        at = cv2.remap(
            z.astype(np.float32),
            column + np.float32(step * s[0] / across),
            row + np.float32(step * s[1] / across),
            cv2.INTER_LINEAR,
            borderMode=cv2.BORDER_CONSTANT,
            borderValue=-1e3,
        )
        hidden |= at > z + step * rise + 0.05
    return hidden
