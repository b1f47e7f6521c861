"""The scene of the LightPanel paper's two studies: a unit sphere before an orthographic camera, distant lights on a ring.

Symbols: phase angle g between a light and the view axis, ambient level A (fraction of full scale on the sphere), peak p: what the brightest
sample would be stored at without ambient light. Each pixel is the mean of OVERSAMPLING squared rays; then noise, then the bits.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Light
from lpcal.records.observations import RawCapture

OVERSAMPLING = 3


@dataclass(frozen=True)
class Conditions:
    """Of one trial."""

    phase_deg: float = 30.0
    lights: int = 6
    bits: int = 8
    noise: float = 0.0
    """One standard deviation, fraction of full scale."""
    ambient: float = 0.0
    peak: float = 0.98
    pixels: int = 64
    """Across the sphere."""
    rim: float = 0.95
    """Radius (of the sphere) within which pixels count: beyond it the normal turns by more than 6 degrees within one."""
    toe: float = 0.0
    """Fraction of full scale that the sensor needs before it shows anything."""


def ring(conditions: Conditions) -> tuple[Light, ...]:
    """Distant lights round the view axis, at the phase angle from it."""
    g = np.radians(conditions.phase_deg)
    turn = 2 * np.pi * np.arange(conditions.lights) / conditions.lights
    d = np.stack([np.sin(g) * np.cos(turn), np.sin(g) * np.sin(turn), np.full(len(turn), -np.cos(g))], axis=1)
    return tuple(Light(f"L{k}", one, np.ones(1)) for k, one in enumerate(d))


def capture(conditions: Conditions, seed: int) -> tuple[RawCapture, Array, Mask]:
    """Images of the sphere with an ambient image, its normals (H, W, 3) at the pixels' centres, and its mask."""
    rng = np.random.default_rng(seed)
    offsets = (np.arange(OVERSAMPLING) + 0.5) / OVERSAMPLING - 0.5
    lights = ring(conditions)
    room = np.zeros((conditions.pixels, conditions.pixels))
    lit, full = np.zeros((len(lights), *room.shape)), 2**conditions.bits - 1
    for dx in offsets:
        for dy in offsets:
            n, on = _normals(conditions.pixels, dx, dy)
            lit += np.stack([np.maximum(n @ light.direction_C, 0) * on for light in lights]) / OVERSAMPLING**2
            room += on / OVERSAMPLING**2

    def stored(linear: Array) -> Image:
        noisy = linear - conditions.toe + conditions.noise * rng.standard_normal(linear.shape)
        return (np.clip(np.rint(full * noisy), 0, full) / full).astype(np.float32)

    dark = conditions.ambient * room
    images = stored(conditions.peak * lit / lit.max() + dark)
    n, on = _normals(conditions.pixels, 0.0, 0.0)
    mask = on & (np.hypot(n[..., 0], n[..., 1]) < conditions.rim * (1 - 1.5 / conditions.pixels))
    names = tuple(light.name for light in lights)
    ones = np.ones(len(lights))
    return RawCapture("sphere", names, images, ones, stored(dark)[None], np.ones(1), mask=mask, step=1 / full), n, mask


def _normals(pixels: int, dx: float, dy: float) -> tuple[Array, Mask]:
    row, column = np.indices((pixels, pixels), dtype=float)
    x, y = ((axis - (pixels - 1) / 2) / (pixels / 2) for axis in (column + dx, row + dy))
    square = x**2 + y**2
    return np.stack([x, y, -np.sqrt(np.maximum(1 - square, 0))], axis=-1), np.asarray(square < 1)
