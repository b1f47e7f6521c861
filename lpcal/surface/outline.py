"""The outline of a mask that was found in coarse pixels, drawn anew at every finer scale, in a band about it.

What speaks for a pixel's being the object, at each scale: the layers near it on either side (surface.layers), and, where there is an image
without lights, that image beside what it shows just inside and just outside: shadows, which the lights' images are full of at an outline,
are not in it. Both are twice a difference of log likelihoods; surface.cut draws the outline by their sum.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.surface import cut, layers
from lpcal.surface.coarse import Coarse, LightTable, coarse_of, joined
from lpcal.surface.sight import Grey, strength

BAND = 2
"""Pixels of a scale on either side of an outline that the next finer scale asks anew."""
DIM = 4
"""Coarse pixels on either side of an outline within which what no light reaches is asked anew where there is an image without lights."""
EVIDENCE = 10.0
"""Difference of costs that is full evidence for or against a pixel in the outline."""
BY_ROOM = 2.0
"""Weight of the image without lights beside the lights': the layers' costs are less sure at an outline, for shadows lie there."""
STIFFNESS = 0.6
"""Evidence that a unit of outline must be worth where the picture shows no edge."""
TEXTURE = 0.1
"""Standard deviation of the logarithm of the room's light on one material, beside what its neighbourhood shows: paint, folds, shadows."""
DIMMEST = 0.02
"""Share of its median at which the image without lights is taken for dark."""
KNOWN = 0.02
"""Share of a neighbourhood that must lie on a side for its mean to stand for the side there; else that of the nearest place does."""


@dataclass(frozen=True)
class Apart:
    """A coarse picture that has been taken apart into layers, and which of it is the object."""

    mask: Mask
    """(rows, columns)."""
    labels: Labels
    """(rows, columns)."""
    found: layers.Layers
    image: Coarse
    table: LightTable
    u_free: float
    """Natural logarithm of the object's distance in metres."""


def drawn(apart: Apart, maps: Grey, rays_C: Array, room: Image | None) -> Mask:
    """The mask (H, W) in full size; `room` (H, W) is the image without lights, None where there is none."""
    coarse, mask, factor = apart.image.factor, apart.mask, apart.image.factor
    rows, columns = mask.shape
    every = range(len(apart.found.planes) + 3)
    of_object, of_rest = (
        np.stack([_grown(_opened(apart.labels == k) & side, BAND) for k in every]).reshape(len(every), -1) for side in (mask, ~mask)
    )
    of_object[0], of_rest[0] = True, False
    dim = np.zeros(mask.shape, bool) if room is None else _dim(apart)
    while True:
        finer = max(1, factor // 2)
        here = coarse_of(maps, rays_C, finer)
        mask = enlarged(mask, factor / finer, here.shape)
        by = int(np.ceil(BAND * factor / finer))
        asked = enlarged(dim, coarse / finer, here.shape)
        inside = cut.shrunk(mask, by)
        band = (asked | (_grown(mask, by) & ~inside)).ravel()
        row, column = np.indices(here.shape).reshape(2, -1)[:, band]
        parent = np.minimum(row * finer // coarse, rows - 1) * columns + np.minimum(column * finer // coarse, columns - 1)
        at = layers.Pixels(here.signal[:, band], here.sigma[:, band], here.usable[:, band], here.rays_C[band], parent)
        cost = layers.costs(apart.found, at, apart.table, np.full(len(parent), apart.u_free))
        own, rest = (np.where(near[:, parent], cost, np.inf).min(axis=0) for near in (of_object, of_rest))
        evidence = np.clip((rest - own) / EVIDENCE, -1, 1)
        if room is not None:
            evidence += BY_ROOM * np.clip(_by_room(joined(room, finer), mask, asked, by).ravel()[band] / EVIDENCE, -1, 1)
        said = np.where(inside, 2.0, -2.0).astype(np.float32).ravel()
        said[band] = np.clip(evidence, -1, 1)
        mask = cut.total_variation(said.reshape(here.shape), _log(strength(here.maps)), STIFFNESS)
        if finer == 1:
            return cut.halfway(mask, maps.signal, maps.sigma)
        factor = finer


def _dim(apart: Apart) -> Mask:
    """Coarse pixels (rows, columns) near the outline that no light reaches or that lie in no plane: what they are, shadows leave open."""
    near = _grown(apart.mask, DIM) & ~cut.shrunk(apart.mask, DIM)
    return np.asarray(near & (apart.labels > len(apart.found.planes)))


def enlarged(mask: Mask, by: float, shape: tuple[int, ...]) -> Mask:
    """A mask of pixels `by` times as large, at a shape."""
    import cv2

    grid = np.array([[1 / by, 0, 0.5 / by - 0.5], [0, 1 / by, 0.5 / by - 0.5]])
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    large = cv2.warpAffine(mask.astype(np.float32), grid, shape[::-1], flags=flags, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(large > 0.5)


def _by_room(room: Image, mask: Mask, asked: Mask, by: int) -> Array:
    """Twice the log likelihood ratio (H, W) of the room's light (H, W): as the mask shows it `by` pixels about, or as what lies outside."""
    dark = DIMMEST * float(np.median(room))
    level = np.log(np.maximum(room, max(dark, 1e-12)))
    edge = max(1, by // 2)
    sides = cut.shrunk(mask, edge) & ~asked, ~(_grown(mask, edge) | asked)
    if not all(side.any() for side in sides):
        return np.zeros(mask.shape)
    cost = []
    for side in sides:
        mean, variance = _about(level, side, by)
        variance = variance + TEXTURE**2
        cost.append((level - mean) ** 2 / variance + np.log(variance))
    return np.asarray(cost[1] - cost[0])


def _about(picture: Array, side: Mask, by: int) -> tuple[Array, Array]:
    """Mean and variance (H, W) of a picture on one side, `by` pixels about each place; far from the side those of its nearest place."""
    from scipy import ndimage

    share = ndimage.gaussian_filter(side.astype(float), by)
    mean, square = (ndimage.gaussian_filter(np.where(side, one, 0.0), by) / np.maximum(share, 1e-9) for one in (picture, picture**2))
    nearest = tuple(ndimage.distance_transform_edt(share <= KNOWN, return_distances=False, return_indices=True))
    return mean[nearest], np.maximum(square - mean**2, 0.0)[nearest]


def _grown(mask: Mask, by: int) -> Mask:
    from scipy import ndimage

    return np.asarray(ndimage.binary_dilation(mask, iterations=by))


def _opened(mask: Mask) -> Mask:
    from scipy import ndimage

    return np.asarray(ndimage.binary_opening(mask))


def _log(bright: Image) -> Image:
    return np.log(np.maximum(bright, 0.01 * np.percentile(bright, 99))).astype(np.float32)
