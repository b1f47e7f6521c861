"""Pictures of a ball beside another object, drawn pixel by pixel under distant lights: Lambert's law, a mirror's spots, blur and noise."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.ndimage import gaussian_filter

from lpcal.records.observations import Radiance

WIDTH, HEIGHT, FINER = 360, 240, 3
LIGHTS = [(-0.5, -0.3, -0.8), (0.5, -0.3, -0.8), (0.0, 0.55, -0.8), (-0.55, 0.3, -0.75), (0.6, 0.25, -0.75), (0.05, -0.6, -0.8)]
NOISE, ROOM, ALBEDO, WALL = 0.004, 0.02, 0.6, 0.12

type Field = np.ndarray
type Painter = Callable[[Field, Field, Field, Field], None]
"""Paints normals (H, W, 3), NaN where a thing is no matter, and albedo (H, W) at columns and rows (H, W)."""


def disc(x: float, y: float, r: float) -> Painter:
    """A flat round picture on the wall, of two greys."""

    def paint(normal: Field, albedo: Field, column: Field, row: Field) -> None:
        inside = np.hypot(column - x, row - y) < r
        normal[inside], albedo[inside] = (0, 0, -1), np.where(column + row < x + y, 0.75, 0.5)[inside]

    return paint


def framed(x: float, y: float, half: float) -> Painter:
    """A picture frame, with a round picture in it."""

    def paint(normal: Field, albedo: Field, column: Field, row: Field) -> None:
        inside = (np.abs(column - x) < half) & (np.abs(row - y) < half)
        normal[inside], albedo[inside] = (0, 0, -1), 0.25
        disc(x, y, 0.8 * half)(normal, albedo, column, row)

    return paint


def box(x: float, y: float, half: float) -> Painter:
    """A box seen over an edge: two faces."""

    def paint(normal: Field, albedo: Field, column: Field, row: Field) -> None:
        for side in (-1, 1):
            face = (side * (column - x) > 0) & (np.abs(column - x) < half) & (np.abs(row - y) + 0.3 * np.abs(column - x) < 1.2 * half)
            normal[face], albedo[face] = (0.7 * side, 0, -0.714), 0.7

    return paint


def turned(x: float, y: float, r: float, width: Callable[[Field], Field]) -> Painter:
    """A thing turned on a lathe, its axis upright: half width by height from -1 to 1, in units of r."""

    def paint(normal: Field, albedo: Field, column: Field, row: Field) -> None:
        half = r * width(np.clip((row - y) / r, -1, 1))
        inside = (np.abs(column - x) < half) & (np.abs(row - y) < r)
        across = np.where(inside, (column - x) / np.maximum(half, 1e-6), 0)
        turn = np.stack([across, np.zeros_like(across), -np.sqrt(np.maximum(1 - across**2, 0))], axis=-1)
        normal[inside], albedo[inside] = turn[inside], 0.7

    return paint


def vase(x: float, y: float, r: float) -> Painter:
    """Belly, neck and lip."""
    return turned(x, y, r, lambda h: 0.55 + 0.4 * np.cos(2.6 * (h - 0.35)))


def mug(x: float, y: float, r: float) -> Painter:
    """A mug seen from above: its wall, its rim a round, dark opening."""

    def paint(normal: Field, albedo: Field, column: Field, row: Field) -> None:
        turned(x, y + 0.4 * r, r, np.ones_like)(normal, albedo, column, row)
        rim = np.hypot(column - x, (row - y + 0.6 * r) / 0.8) < r
        normal[rim], albedo[rim] = (0, -0.3, -0.95), 0.7
        opening = np.hypot(column - x, (row - y + 0.6 * r) / 0.8) < 0.9 * r
        albedo[opening] = 0.03

    return paint


def matte(x: float, y: float, r: float) -> Painter:
    """A matte ball."""

    def paint(normal: Field, albedo: Field, column: Field, row: Field) -> None:
        inside = np.hypot(column - x, row - y) < r
        u, v = (column - x) / r, (row - y) / r
        turn = np.stack([u, v, -np.sqrt(np.maximum(1 - u**2 - v**2, 0))], axis=-1)
        normal[inside], albedo[inside] = turn[inside], ALBEDO

    return paint


def before(x0: float, x1: float, y0: float, y1: float) -> Painter:
    """A bar in front of everything."""

    def paint(normal: Field, albedo: Field, column: Field, row: Field) -> None:
        inside = (column > x0) & (column < x1) & (row > y0) & (row < y1)
        normal[inside], albedo[inside] = (0, 0, -1), 0.4

    return paint


def picture(things: Sequence[Painter], chrome: tuple[float, float, float] | None = None, name: str = "ball", seed: int = 1) -> Radiance:
    """What a camera sees of things, the last in front, and of a chrome ball (x, y, r), under each of six lights."""
    rng = np.random.default_rng(seed)
    row, column = ((np.indices((HEIGHT * FINER, WIDTH * FINER)) + 0.5) / FINER - 0.5).astype(float)
    normal, albedo = np.broadcast_to([0.0, 0.0, -1.0], (*row.shape, 3)).copy(), np.full(row.shape, WALL)
    for paint in things:
        paint(normal, albedo, column, row)
    if chrome is not None:
        x, y, r = chrome
        rim = np.hypot(column - x, row - y) / r
        albedo = np.where(rim < 1, 0.04 + 0.25 * WALL * rim**4, albedo)
        normal[rim < 1] = (0, 0, -1)
    images = []
    for light in LIGHTS:
        d = np.array(light) / np.linalg.norm(light)
        fine = albedo * np.maximum(normal @ d, 0)
        image = gaussian_filter(fine.reshape(HEIGHT, FINER, WIDTH, FINER).mean(axis=(1, 3)), 0.6)
        if chrome is not None:
            half = (d - [0, 0, 1]) / np.linalg.norm(d - [0, 0, 1])
            rows, columns = np.indices(image.shape)
            image = image + 1.2 * np.exp(-((columns - x - r * half[0]) ** 2 + (rows - y - r * half[1]) ** 2) / (2 * 0.9**2))
        images.append(image + NOISE * rng.normal(size=image.shape))
    room = ROOM * gaussian_filter(albedo.reshape(HEIGHT, FINER, WIDTH, FINER).mean(axis=(1, 3)), 0.6)
    signal = np.array(images, np.float32)
    return Radiance(
        name=name,
        lights=tuple(f"L{k}" for k in range(len(LIGHTS))),
        signal=signal,
        sigma=np.full(signal.shape, NOISE, np.float32),
        saturated=signal > 1.0,
        ambient=room.astype(np.float32),
    )
