"""Patches of the planes around the object (wall, support), which reflect light onto it.

The pixels of a plane show its radiance under every light, shadows included, so its reflectance need not be known there. Parts of a plane
that the object hides, or that lie outside the image, are given the plane's median albedo and the lights that the object does not occlude:
a table reflects most of its light from parts that the camera does not see, under the object and in front of the image's lower edge.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.calibration import Light
from lpcal.segmentation import mask, planes
from lpcal.surface.relief import Relief
from lpcal.view.constants import RIM_PX, SHADOW_STEPS
from lpcal.view.pixel_list import Indices, PixelList, SignalMaps, light_vectors, list_pixels

BEYOND = 0.6
"""Margin around the image into which planes are extended, as a share of the image's longer side."""
PATCHES = 600
"""Largest number of patches of the visible planes: each patch of the object receives light from all of them."""
SIDE = 4
"""Rays along each side of a patch outside the image: its centroid and area are then accurate to one per cent."""
FURTHEST = 2.0
"""Limits of a plane's extension: its median visible depth times this factor, and divided by it."""
SLAB = 0.05
"""Largest relative depth range of a patch: a table seen at a grazing angle covers a long range within a few pixels."""


@dataclass(frozen=True)
class Patches:
    """Flat patches that emit reflected light: Q of them."""

    x_C: Array
    """(Q, 3)."""
    n: Array
    """(Q, 3)."""
    area: Array
    """(Q,) m^2."""
    signal: Array
    """(L, Q) signal that the camera sees of them, or would see."""

    @staticmethod
    def together(some: Sequence[Patches]) -> Patches:
        """The patches of several sets as one."""
        return Patches(
            np.concatenate([one.x_C for one in some]),
            np.concatenate([one.n for one in some]),
            np.concatenate([one.area for one in some]),
            np.concatenate([one.signal for one in some], axis=1),
        )


@dataclass(frozen=True)
class Around:
    """The patches of the planes: those that the camera sees, and those that it does not see, with the signals of unoccluded light."""

    seen: Patches
    unseen: Patches | None
    front: Relief
    """The planes as occluders: lights below a table's top do not reach an object that stands on it."""

    def beyond(self, relief: Relief, lights: Sequence[Light]) -> Patches | None:
        """The unseen patches with the object's shadows."""
        if self.unseen is None:
            return None
        signal = self.unseen.signal.copy()
        for k, light in enumerate(lights):
            if light.source_C is not None:
                signal[k, relief.hidden_from(self.unseen.x_C, light.source_C, SHADOW_STEPS)] = 0.0
        return replace(self.unseen, signal=signal)


@dataclass(frozen=True)
class Whole:
    """The whole image in coarse pixels, including what lies behind the object."""

    seen: PixelList
    hidden: Mask
    """(H, W) where the object covers it."""
    factor: int
    """Side of a coarse pixel, pixels."""


def whole(maps: SignalMaps, rays_C: Array, object_mask: Mask) -> Whole:
    """The whole image, `object_mask` (H, W) being the object."""
    coarse, coarse_rays, factor = mask.binned(maps, rays_C)
    seen = list_pixels(coarse, coarse_rays, np.ones(coarse.signal.shape[1:], bool), central=True)
    height, width = (side * factor for side in seen.mask.shape)
    hidden = object_mask[:height, :width].reshape(height // factor, factor, width // factor, factor).any(axis=(1, 3))
    return Whole(seen, hidden, factor)


def found_beside(maps: SignalMaps, rays_C: Array, object_mask: Mask, found: mask.Found | None, lights: Sequence[Light]) -> Around | None:
    """The patches of the planes found in the image; None where there are none."""
    if found is None or not found.planes:
        return None
    image = whole(maps, rays_C, object_mask)
    return patches(image, found.planes, lights, shown_by(found, image))


def shown_by(found: mask.Found, image: Whole) -> Indices | None:
    """Index of the plane (P,) that each pixel shows according to the coarse layers, -1 where none; None without layers."""
    if found.of_plane is None:
        return None
    sides = zip(image.seen.mask.shape, found.of_plane.shape, strict=True)
    row, column = (np.minimum(np.arange(side) * image.factor // found.factor, most - 1) for side, most in sides)
    return np.asarray(found.of_plane[np.ix_(row, column)].ravel())


def patches(image: Whole, found: Sequence[planes.Plane], lights: Sequence[Light], labelled: Indices | None = None) -> Around | None:
    """Patches of the planes `found`; None where none of them is visible.

    `labelled` (P,) is the plane of each pixel according to its layer, -1 where it has none; such pixels are assigned to the plane that
    their samples fit. By their layer, pixels count also where shadows, other light or saturation contradict the plane's prediction.
    """
    seen, free = image.seen, ~raster.dilated(image.hidden, RIM_PX).ravel()
    least, of_plane = np.full(seen.pixels, planes.TRUSTED**2), np.full(seen.pixels, -1)
    albedo: list[float] = []
    signal = seen.signal.copy()
    for k, plane in enumerate(found):
        m = planes.predicted(plane.q, seen.rays_C, lights)
        square, count = planes.misfit(seen, m)
        fits = (count >= 2) & (square < least)
        better = free & (fits if labelled is None else np.where(labelled >= 0, labelled == k, fits))
        of_plane[better], least[better] = k, square[better]
        albedo.append(_albedo(seen.signal[:, better], m[:, better]) if better.any() else 0.0)
        clipped = np.flatnonzero(better & ~seen.usable.all(axis=0))
        signal[:, clipped] = _unclipped(seen.at(clipped), m[:, clipped], albedo[k])
    _leave_out_of_reach(of_plane, found, seen.rays_C)
    signal = _beside(image, signal, of_plane, free)
    _leave_out_of_reach(of_plane, found, seen.rays_C)  # beside an object that stands before a table's horizon, rays miss the table
    size = max(1, int(np.ceil(np.sqrt(seen.pixels / PATCHES))))
    block = _blocks(seen.mask.shape, size)
    shown = [_of_plane(seen.rays_C, signal, plane.q, of_plane == k, block) for k, plane in enumerate(found) if np.any(of_plane == k)]
    if not shown:
        return None
    pad = int(np.ceil(BEYOND * max(seen.mask.shape) / size)) * size
    every = max(1, size // SIDE)
    rays_C, beyond = _rays_beyond(seen, pad, every), _goes_on(image, of_plane, pad)[::every, ::every]
    block, beyond = _blocks(beyond.shape, -(-size // every)), beyond.ravel()
    blank = np.zeros((0, len(rays_C)))
    unseen = []
    for k, plane in enumerate(found):
        inside = (beyond == k) & _within_reach(rays_C @ plane.q, seen.rays_C[of_plane == k] @ plane.q)
        if inside.any():
            part = _of_plane(rays_C, blank, plane.q, inside, block)
            d, E = light_vectors(lights, part.x_C)
            unseen.append(replace(part, signal=albedo[k] * (E * np.maximum(lambert.dot(d, part.n), 0.0))))
    slopes = np.stack([seen.rays_C @ plane.q for plane in found])
    depth = 1 / np.maximum(slopes[of_plane, np.arange(seen.pixels)], planes.BEHIND)
    body = replace(seen, mask=(of_plane >= 0).reshape(seen.mask.shape), rays_C=seen.rays_C[of_plane >= 0])
    return Around(Patches.together(shown), Patches.together(unseen) if unseen else None, Relief.of(body, depth[of_plane >= 0], to_rim=True))


def _unclipped(seen: PixelList, m: Array, albedo: float) -> Array:
    """Signals (L, P) of pixels of a plane; saturated ones are predicted from the pixel's other samples, or from the median albedo.

    `m` is the prediction for albedo 1. A fully lit support is often brighter than the object that the exposure was set for.
    """
    signal, m, usable = seen.signal, np.maximum(m, 0.0), seen.usable
    lit = usable & (m > planes.WEAK * m.max(axis=0))
    with np.errstate(all="ignore"):
        own = np.where(lit.any(axis=0), np.sum(np.where(lit, signal * m, 0.0), axis=0) / np.sum(np.where(lit, m**2, 0.0), axis=0), albedo)
    return np.where(usable, signal, np.maximum(signal, own * m))


def _beside(image: Whole, signal: Array, of_plane: Indices, free: Mask) -> Array:
    """The signals (L, P), in the margin around the object replaced by those of the nearest pixel of a plane; `of_plane` (P,) is updated.

    Patches nearest to the object reflect the most light onto it.
    """
    pixel = raster.nearest((of_plane >= 0).reshape(image.seen.mask.shape)).ravel()
    margin = ~free & ~image.hidden.ravel() & np.any(of_plane >= 0)
    of_plane[margin] = of_plane[pixel[margin]]
    signal = signal.copy()
    signal[:, margin] = signal[:, pixel[margin]]
    return signal


def _goes_on(image: Whole, of_plane: Indices, pad: int) -> Indices:
    """Index (H, W) of the plane that is extended to each pixel of the image with a margin `pad`; -1 where a plane is visible."""
    here = np.pad(of_plane.reshape(image.seen.mask.shape), pad, constant_values=-1)
    plane = np.where(here < 0, here.ravel()[raster.nearest(here >= 0)], -1)
    plane[np.pad(~image.hidden, pad)] = -1
    return np.asarray(plane)


def _leave_out_of_reach(of_plane: Indices, found: Sequence[planes.Plane], rays_C: Array) -> None:
    """Set the plane (P,) to -1 at pixels whose rays (P, 3) miss it, or meet it far from its visible part."""
    for k, plane in enumerate(found):
        mine = of_plane == k
        of_plane[mine & ~_within_reach(rays_C @ plane.q, rays_C[mine] @ plane.q)] = -1


def _within_reach(slope: Array, seen: Array) -> Mask:
    """Mask (N,) of rays that meet a plane within FURTHEST of its visible depths, from q . r of all rays and of the visible ones."""
    if not seen.size:
        return np.zeros(len(slope), bool)
    depth, middle = 1 / np.maximum(slope, planes.BEHIND), np.median(1 / np.maximum(seen, planes.BEHIND))
    return np.asarray((slope >= planes.BEHIND) & (depth >= middle / FURTHEST) & (depth <= FURTHEST * middle))


def _albedo(signal: Array, m: Array) -> float:
    """Median albedo of the pixels of a plane, in the signals' units, from the brightest-lit sample of each pixel."""
    return float(np.median(np.max(np.where(m > planes.WEAK * m.max(axis=0), signal / np.maximum(m, 1e-12), 0.0), axis=0)))


def _blocks(shape: tuple[int, ...], size: int) -> Indices:
    """Index (N,) of the block of `size` x `size` pixels that each pixel lies in."""
    row, column = np.indices(shape).reshape(2, -1)
    return np.asarray(row // size * (shape[1] // size + 1) + column // size)


def _rays_beyond(seen: PixelList, pad: int, every: int) -> Array:
    """Rays (N, 3) of the image with a margin of `pad` pixels, every `every`-th along both sides.

    They are those of the pinhole camera that fits the rays of the image best.
    """
    height, width = seen.mask.shape
    row, column = np.indices((height, width)).reshape(2, -1)
    waves = np.column_stack([column, row, np.ones(len(row))])
    slope = np.linalg.lstsq(waves, seen.rays_C[:, :2], rcond=None)[0]
    row, column = (one.ravel() for one in np.mgrid[-pad : height + pad : every, -pad : width + pad : every])
    return np.column_stack([np.column_stack([column, row, np.ones(len(row))]) @ slope, np.ones(len(row))])


def _of_plane(rays_C: Array, signal: Array, q: Array, inside: Mask, block: Indices) -> Patches:
    """The pixels `inside` (P,) of a plane q (3,), joined by their `block` (P,)."""
    middle = len(rays_C) // 2
    step = float(np.linalg.norm(rays_C[middle + 1] - rays_C[middle]))  # of neighbouring rays at depth 1
    unit, rays = q / np.linalg.norm(q), rays_C[inside]
    depth = 1 / (rays @ q)
    area = (depth * step) ** 2 / (rays @ unit)
    slab = np.floor(np.log(depth) / SLAB).astype(int)
    slab -= slab.min()
    key = block[inside] * (slab.max() + 1) + slab
    of_block = (np.cumsum(np.bincount(key) > 0) - 1)[key]
    total = np.bincount(of_block, area)

    def joined(values: Array) -> Array:
        """Means (C, Q) by area of values (C, N)."""
        return np.array([np.bincount(of_block, area * one) for one in values]).reshape(-1, len(total)) / total

    x_C = joined((depth[:, None] * rays).T).T
    return Patches(x_C, np.broadcast_to(-unit, x_C.shape), total, joined(np.maximum(signal[:, inside], 0)))
