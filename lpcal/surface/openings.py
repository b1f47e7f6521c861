"""Background that is seen through an object, which the labels of coarse pixels lose where it is small and half in shadow, or dim.

A pixel of the mask may show a plane of the background where its samples fit the plane, with an albedo like that of the plane elsewhere.
So may a pixel of the object that happens to face as the plane does; but the object goes on smoothly beside it, while at the rim of an
opening the pictures step. Connected components of such pixels are openings where the pictures step along nearly all of their rim.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Light
from lpcal.surface import planes
from lpcal.surface.coarse import coarse_of, factor_of
from lpcal.surface.sight import Grey, look_at, second, strength

PIXELS = 200_000
"""Pixels of the image in which openings are looked for, at most: finer ones show no more of them."""
LEAST = 200
"""Pixels of a plane outside the mask from which its albedo is known."""
APART = 4
"""Pixels from the mask from which a plane shows itself alone."""
ALIKE = 0.5
"""Difference of the logarithms of albedos under which a pixel may show the plane."""
DIM, DIM_AROUND = 0.1, 0.2
"""Share of the object's median strength under which a pixel is dim, and share of the picture around it that must be so."""
SMALLEST = 0.004
"""Share of the mask under which an opening is left as it is."""
INSIDE, OUTSIDE = (2.0, 4.0), (3.0, 5.0)
"""Distances from a rim, in pixels, between which the pictures on its two sides are compared: the rim itself is blurred."""
STEP, RIM = 0.5, 0.2
"""Difference of the signals across a rim, as a share of their mean, that is a step, and the share of the rim that may lack it: on 36
simulated scenes all openings have .46 and more, all pieces of objects .35 and less."""


def openings(maps: Grey, rays_C: Array, lights: Sequence[Light], mask: Mask, found: Sequence[planes.Plane]) -> Mask:
    """Openings (H, W) in a mask (H, W), which show one of the planes `found` of the background."""
    factor = factor_of(maps, PIXELS)
    image = coarse_of(maps, rays_C, factor)
    rows, columns = image.shape
    inside = mask[: rows * factor, : columns * factor].reshape(rows, factor, columns, factor).mean(axis=(1, 3)) > 0.5
    shown = np.zeros(inside.shape, bool)
    if not inside.any() or inside.all():
        return np.zeros(mask.shape, bool)
    like = [_like(image.maps, image.image(image.rays_C), lights, inside, plane) for plane in found]
    for candidates in (*like, _dim(strength(image.maps), inside)):
        label, count = raster.labelled(candidates)
        for one in range(1, count + 1):
            region = label == one
            if region.sum() >= SMALLEST * inside.sum() and _step(image.image(image.signal.T), region, inside) > STEP:
                shown |= region
    return np.asarray(mask & np.kron(np.pad(shown, ((0, 1), (0, 1))), np.ones((factor, factor), bool))[: mask.shape[0], : mask.shape[1]])


def _like(maps: Grey, rays_C: Array, lights: Sequence[Light], inside: Mask, plane: planes.Plane) -> Mask:
    """Pixels (H, W) of the mask that may show a plane, without crumbs."""
    found = np.zeros(inside.shape, bool)
    beside = look_at(maps, rays_C, ~raster.grown(inside, APART), central=True)
    m = planes.predicted(plane.q, beside.rays_C, lights)
    square, count = planes.misfit(beside, m)
    own = (count >= 2) & (square < planes.TRUSTED**2)
    if own.sum() < LEAST:
        return found
    common = np.median(_albedo(beside.signal[:, own], m[:, own]))
    seen = look_at(maps, rays_C, inside, central=True)
    m = planes.predicted(plane.q, seen.rays_C, lights)
    square, count = planes.misfit(seen, m)
    ratio = np.log(np.maximum(_albedo(seen.signal, m), 1e-12) / max(common, 1e-12))
    found[inside] = (count >= 2) & (square < planes.TRUSTED**2) & (np.abs(ratio) < ALIKE)
    return raster.opened(raster.closed(found) & inside, 2)


def _dim(level: Image, inside: Mask) -> Mask:
    """Pixels (H, W) of the mask that are as dim as what no lamp reaches around it; none where all is lit."""
    dim = level < DIM * np.median(level[inside])
    if np.mean(dim[~inside]) < DIM_AROUND:
        return np.zeros(inside.shape, bool)
    return raster.opened(raster.closed(dim & inside) & inside, 2)


def _albedo(signal: Array, m: Array) -> Array:
    """The second highest ratio (P,) of signals to a plane's m (L, P): shadows are lower, and the highest may be a highlight."""
    return second(np.where(m > planes.WEAK * m.max(axis=0), signal / np.maximum(m, 1e-12), -np.inf))


def _step(signal: Array, region: Mask, inside: Mask) -> float:
    """The step of the signals (H, W, L) across a region's rim that most of the rim exceeds; 0 where the region fills the mask."""
    deep, far = raster.away(~region), raster.away(region)
    within, around = (deep >= INSIDE[0]) & (deep < INSIDE[1]), (far >= OUTSIDE[0]) & (far < OUTSIDE[1]) & inside
    if not within.any() or not around.any():
        return 0.0
    here, there = signal[around], signal.reshape(-1, signal.shape[2])[raster.nearest(within)[around]]
    steps = np.abs(here - there).mean(axis=1) / np.maximum((here + there).mean(axis=1) / 2, 1e-12)
    return float(np.quantile(steps, RIM))
