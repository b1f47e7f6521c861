"""What stands round the object and reflects light onto it: the wall behind, the support below, as patches on the planes found there.

A plane's pixels show its radiance under every light, shadows and all, so nothing of the planes' own reflectance has to be known. What the
object hides of a plane, and what of it lies outside the image, is taken for the plane's common matter, lit by the lights that the object
leaves to it: a table reflects most of its light from where the camera does not see it, under the object and before the picture's lower
edge.
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
"""How far beyond the image a plane is taken to go on, as a share of the image's longer side."""
PATCHES = 600
"""Patches of the seen planes, at most: each of the object's patches asks all of them for light."""
SIDE = 4
"""Rays along a side of a patch that nobody sees: by them its place and area are right to a hundredth."""
FURTHEST = 2.0
"""Times the median depth of what is seen of a plane that it goes on, and towards the camera as a divisor of it."""
SLAB = 0.05
"""Depth of a patch along the line of sight at most, as a share: a table at a grazing angle goes far back within a few pixels."""


@dataclass(frozen=True)
class Patches:
    """Flat pieces that throw light: Q of them."""

    x_C: Array
    """(Q, 3)."""
    n: Array
    """(Q, 3)."""
    area: Array
    """(Q,) m^2."""
    signal: Array
    """(L, Q) what they show the camera, a unit of light."""

    @staticmethod
    def together(some: Sequence[Patches]) -> Patches:
        """All patches of several."""
        return Patches(
            np.concatenate([one.x_C for one in some]),
            np.concatenate([one.n for one in some]),
            np.concatenate([one.area for one in some]),
            np.concatenate([one.signal for one in some], axis=1),
        )


@dataclass(frozen=True)
class Around:
    """The planes' patches: those that the camera sees, and those of which it sees nothing, with the signals of full light."""

    seen: Patches
    unseen: Patches | None
    front: Relief
    """What of them stands before a light: lights below a table's top do not reach what stands on it."""

    def beyond(self, relief: Relief, lights: Sequence[Light]) -> Patches | None:
        """The unseen ones in the shadow of the object."""
        if self.unseen is None:
            return None
        signal = self.unseen.signal.copy()
        for k, light in enumerate(lights):
            if light.source_C is not None:
                signal[k, relief.hidden_from(self.unseen.x_C, light.source_C, SHADOW_STEPS)] = 0.0
        return replace(self.unseen, signal=signal)


@dataclass(frozen=True)
class Whole:
    """The whole image in coarse pixels, for what stands behind the object."""

    seen: PixelList
    hidden: Mask
    """(H, W) where the object hides it."""
    factor: int
    """Pixels a coarse pixel."""


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
    """The plane (P,) that each pixel shows by the layers of coarser ones, -1 where it shows none; None where there are no layers."""
    if found.of_plane is None:
        return None
    sides = zip(image.seen.mask.shape, found.of_plane.shape, strict=True)
    row, column = (np.minimum(np.arange(side) * image.factor // found.factor, most - 1) for side, most in sides)
    return np.asarray(found.of_plane[np.ix_(row, column)].ravel())


def patches(image: Whole, found: Sequence[planes.Plane], lights: Sequence[Light], labelled: Indices | None = None) -> Around | None:
    """Patches of the planes `found`; None where nothing is seen of them.

    `labelled` (P,) is the plane that each pixel belongs to by its layer, -1 where it has none; others belong to the plane that their
    samples fit. Where light from elsewhere or shadows keep the samples from the plane's prediction, or they are saturated, a plane's light
    is there all the same.
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
    """Signals (L, P) of pixels of a plane, by its m of albedo 1: saturated ones as the pixel's others, or the common albedo, say.

    A support in full light is often brighter than the object that the exposure was set for.
    """
    signal, m, usable = seen.signal, np.maximum(m, 0.0), seen.usable
    lit = usable & (m > planes.WEAK * m.max(axis=0))
    with np.errstate(all="ignore"):
        own = np.where(lit.any(axis=0), np.sum(np.where(lit, signal * m, 0.0), axis=0) / np.sum(np.where(lit, m**2, 0.0), axis=0), albedo)
    return np.where(usable, signal, np.maximum(signal, own * m))


def _beside(image: Whole, signal: Array, of_plane: Indices, free: Mask) -> Array:
    """The signals (L, P), in the margin about the object those of the nearest pixel of a plane; `of_plane` (P,) gains them.

    What stands nearest to the object reflects most onto it.
    """
    pixel = raster.nearest((of_plane >= 0).reshape(image.seen.mask.shape)).ravel()
    margin = ~free & ~image.hidden.ravel() & np.any(of_plane >= 0)
    of_plane[margin] = of_plane[pixel[margin]]
    signal = signal.copy()
    signal[:, margin] = signal[:, pixel[margin]]
    return signal


def _goes_on(image: Whole, of_plane: Indices, pad: int) -> Indices:
    """The plane (H, W) that goes on at each pixel of the image with a margin of `pad`, the nearest of those seen; -1 where it is shown."""
    here = np.pad(of_plane.reshape(image.seen.mask.shape), pad, constant_values=-1)
    plane = np.where(here < 0, here.ravel()[raster.nearest(here >= 0)], -1)
    plane[np.pad(~image.hidden, pad)] = -1
    return np.asarray(plane)


def _leave_out_of_reach(of_plane: Indices, found: Sequence[planes.Plane], rays_C: Array) -> None:
    """Set the plane (P,) of those pixels to -1 whose rays (P, 3) miss it, or meet it far from what is seen of it."""
    for k, plane in enumerate(found):
        mine = of_plane == k
        of_plane[mine & ~_within_reach(rays_C @ plane.q, rays_C[mine] @ plane.q)] = -1


def _within_reach(slope: Array, seen: Array) -> Mask:
    """Where (N,) rays meet a plane at depths about those seen of it, by q . r of all rays and of those that show the plane."""
    if not seen.size:
        return np.zeros(len(slope), bool)
    depth, middle = 1 / np.maximum(slope, planes.BEHIND), np.median(1 / np.maximum(seen, planes.BEHIND))
    return np.asarray((slope >= planes.BEHIND) & (depth >= middle / FURTHEST) & (depth <= FURTHEST * middle))


def _albedo(signal: Array, m: Array) -> float:
    """The common albedo of pixels of a plane, in the signals' units: the median over those of each pixel's most lit sample."""
    return float(np.median(np.max(np.where(m > planes.WEAK * m.max(axis=0), signal / np.maximum(m, 1e-12), 0.0), axis=0)))


def _blocks(shape: tuple[int, ...], size: int) -> Indices:
    """The number (N,) of the block of `size` x `size` pixels that each pixel lies in."""
    row, column = np.indices(shape).reshape(2, -1)
    return np.asarray(row // size * (shape[1] // size + 1) + column // size)


def _rays_beyond(seen: PixelList, pad: int, every: int) -> Array:
    """Rays (N, 3) of the image with a margin of `pad` pixels, one of `every` so many along its sides.

    They are those of a camera without distortion that is like it on the whole.
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
