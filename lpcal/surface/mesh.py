"""A mesh of a surface's pixels, cut where it breaks.

A corner of each 2x2 pixels makes a triangle when its two legs do not break; the square takes the diagonal whose depths differ less.
Winding is such that a face looks at the camera.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.shown import Shown
from lpcal.records.surface import Surface

DISPLAY_GAMMA = 2.2
"""Exponent between display numbers and light: sRGB's curve within two of 255 steps, but for the darkest."""


@dataclass(frozen=True, repr=False)
class Mesh(Shown):
    """Vertices in C; metres, or pixels without a camera."""

    vertices_C: Image
    """(V, 3)."""
    normals_C: Image
    """(V, 3) the measured ones."""
    colours: npt.NDArray[np.uint8]
    """(V, 3) albedo, display-encoded."""
    faces: npt.NDArray[np.int64]
    """(F, 3)."""
    pixels: npt.NDArray[np.int32] = field(default_factory=lambda: np.zeros((0, 2), np.int32))
    """(V, 2) column and row of each vertex."""


def build(surface: Surface) -> Mesh:
    """The mesh of a surface."""
    mask = surface.mask & np.isfinite(surface.depth)
    number = np.full(mask.shape, -1, np.int64)
    number[mask] = np.arange(mask.sum())
    faces = _faces(number, surface.depth, surface.breaks)
    used = np.unique(faces)
    renumber = np.full(int(mask.sum()), -1, np.int64)
    renumber[used] = np.arange(len(used))
    points = points_C(surface)[mask]
    return Mesh(
        points[used].astype(np.float32),
        surface.normals[mask][used].astype(np.float32),
        colours(surface)[mask][used],
        renumber[faces],
        np.argwhere(mask)[used][:, ::-1].astype(np.int32),
    )


def points_C(surface: Surface) -> Array:
    """Points (H, W, 3); without a camera x and y are pixels from the middle of the image."""
    rays = surface.rays_C.astype(float)
    if not np.any(rays[..., :2]):
        row, column = np.indices(surface.mask.shape, dtype=float)
        middle = (np.array(surface.mask.shape) - 1) / 2
        return np.stack([column - middle[1], row - middle[0], surface.depth.astype(float)], axis=-1)
    return rays * surface.depth[..., None].astype(float)


def colours(surface: Surface) -> npt.NDArray[np.uint8]:
    """Albedo (H, W, 3) as 8 bit display numbers (sRGB's gamma), its 99th percentile at nine tenths."""
    albedo = surface.albedo if surface.albedo.ndim == 3 else np.repeat(surface.albedo[..., None], 3, axis=2)
    inside = albedo[surface.mask & np.isfinite(albedo).all(axis=-1)]
    top = float(np.percentile(inside, 99)) if inside.size else 1.0
    linear = np.clip(np.nan_to_num(albedo) / max(top, 1e-12) * 0.9, 0, 1)
    return np.asarray(np.rint(255 * linear ** (1 / DISPLAY_GAMMA)), np.uint8)


def _faces(number: npt.NDArray[np.int64], depth: Image, breaks: Mask) -> npt.NDArray[np.int64]:
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, :-1], number[1:, 1:]  # a b over c d
    top, bottom = ~breaks[0, :-1, :-1], ~breaks[0, 1:, :-1]
    left, right = ~breaks[1, :-1, :-1], ~breaks[1, :-1, 1:]
    z = np.nan_to_num(depth)
    falling = np.abs(z[:-1, :-1] - z[1:, 1:]) <= np.abs(z[:-1, 1:] - z[1:, :-1])  # whether the diagonal a d is the flatter one
    lone = top.astype(int) + bottom + left + right == 2
    found = []
    for kept, corners in (
        (left & bottom & (lone | falling), (a, c, d)),
        (top & right & (lone | falling), (a, d, b)),
        (top & left & (lone | ~falling), (a, c, b)),
        (right & bottom & (lone | ~falling), (b, c, d)),
    ):
        triangle = np.stack([corner[kept] for corner in corners], axis=1)
        found.append(triangle[(triangle >= 0).all(axis=1)])
    return np.concatenate(found)
