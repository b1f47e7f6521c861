"""Which pixels are the object: not the wall behind it, not the support under it, not the dark.

Near light places the plane behind the object from the border of the image; a pixel that this plane explains, by the ratios of its lights
and by its albedo, shadows counted, is wall. What is left and touches the border is tried as further planes (support, shelf), and dark
matter that hangs on those or on the border is support too. Without near light, or where no plane is lit, the strength of the signal
decides.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Light
from lpcal.surface import cut, planes
from lpcal.surface.backdrop import Backdrop, backdrop, evidence
from lpcal.surface.sight import Grey, Sight, look_at

COARSE_PIXELS = 110_000
BORDER_SHARE = 0.06
LIT_SIGMAS = 6.0
WALL_SIGMAS = 2.5
FIT_SIGMAS = 3.0
FURTHER_PLANES = 3
MANY = 3
"""Samples beyond the first that make a plane's claim on a pixel a full one."""
STIFFNESS = 0.6
SMALLEST_SHARE = 0.02
"""Pieces under this share of the largest are dropped."""
HOLE_SHARE = 0.004
DARK_SHARE = 0.2
"""Matter whose brightest light is darker than this share of the object's own is dark."""
OF_SUPPORT, LEAST_DARK, MOST_DARK = 1.7, 0.05, 0.3
"""Where a support was found: what is darker than so many times the support, between these shares of the object's own."""
ALBEDO_PIXELS = 15_000
"""From which a plane's albedo is made out."""
NEAR = 3
"""Coarse pixels: how far beyond its part a plane is asked about the outline."""
FIXED = 2.0
"""Evidence of pixels that are not asked."""
LEAST_OF_IMAGE = 0.003
CLEAR, FAINT = 0.6, 0.3
"""Mean evidence against the wall of a piece that is none of it, and of one that may well be."""

type Word = Callable[[Sight], Array]
"""Evidence (P,) of pixels, from -1 (something that is not the object explains them) to 1 (it does not)."""


@dataclass(frozen=True)
class Found:
    """A mask and how it was found, in words."""

    mask: Mask
    how: str
    planes: tuple[planes.Plane, ...] = ()
    """The first is the one behind the object."""


def automatic(maps: Grey, rays_C: Array, lights: Sequence[Light], distance_m: float | None) -> Found:
    """The object; `distance_m` is the working distance where lights are near, None where the mask must do without planes."""
    if distance_m is not None:
        found = _by_planes(maps, rays_C, lights, distance_m)
        if found is not None:
            return found
    return Found(_by_strength(maps), "by the strength of the signal")


def strength(maps: Grey) -> Image:
    """Brightness (H, W) of the second brightest light: highlights and single lights do not rule it."""
    return np.asarray(np.sort(maps.signal, axis=0)[-2], np.float32)


def _by_strength(maps: Grey) -> Mask:
    """Otsu 1979 on the logarithm of the strength, then the seam."""
    lit = strength(maps)
    noise = np.median(maps.sigma, axis=0)
    level = np.log(np.maximum(lit, noise))
    mask = level > _otsu(level)
    mask &= lit > LIT_SIGMAS * noise
    return _tidy(cut.along_the_seam(_tidy(mask), _picture(maps)))


def _by_planes(maps: Grey, rays_C: Array, lights: Sequence[Light], distance_m: float) -> Found | None:
    coarse, coarse_rays, _ = binned(maps, rays_C)
    shape = coarse.signal.shape[1:]
    everywhere = look_at(coarse, coarse_rays, np.ones(shape, bool), central=True)
    edges = _log(strength(coarse))
    lit = np.sum(coarse.signal > LIT_SIGMAS * coarse.sigma, axis=0) >= 3
    border = border_band(shape)
    wall = planes.fit(look_at(coarse, coarse_rays, border & lit, central=True), lights, distance_m)
    if wall is None or wall.misfit > FIT_SIGMAS or np.mean(lit[border]) < 0.2:
        return None
    word, against = _word_of(wall, everywhere, lights, border & lit, edges)
    left = cut.total_variation(against, edges, STIFFNESS)
    found, claims = [wall], [(word, np.ones(shape, bool))]
    support = np.zeros(shape, bool)
    for _ in range(FURTHER_PLANES):
        touching = _hangs_on(left & ~support, border)
        at_border = touching & border & lit
        if at_border.sum() < 0.01 * border.sum():
            break
        plane = planes.fit(look_at(coarse, coarse_rays, at_border, central=True), lights, distance_m, tilted=True)
        if plane is None or plane.misfit > FIT_SIGMAS:
            break
        found.append(plane)
        word, said = _word_of(plane, everywhere, lights, at_border, edges)
        grown = _hangs_on(touching & ~cut.total_variation(said, edges, STIFFNESS), at_border)
        if grown.sum() <= at_border.sum() // 2:
            break
        support |= grown
        claims.append((word, grown))
    object_, dark, word = _without_dark(left & ~support, support, border, everywhere, edges)
    claims.append((word, dark))
    mask = _without_faint(object_, against)
    if mask.sum() < LEAST_OF_IMAGE * mask.size:
        return Found(_enlarged(lit, maps), "all that is lit lies in one plane: that is the object", tuple(found))
    fine = _by_pixel(_enlarged(mask, maps), maps, rays_C, [(word, _enlarged(_grown(part, NEAR), maps)) for word, part in claims])
    return Found(fine, f"against {len(found)} plane{'s' * (len(found) > 1)}", tuple(found))


def _word_of(plane: planes.Plane, seen: Sight, lights: Sequence[Light], sure: Mask, edges: Image) -> tuple[Word, Image]:
    """What a plane says of pixels, and of those seen (H, W): by its ratios alone at first, then by its albedo, as `sure` shows it."""
    m = planes.foretold(plane.q, seen.rays_C, lights)
    said, back = _by_ratios(seen, m, plane.misfit), None
    few = np.arange(0, seen.pixels, max(1, seen.pixels // ALBEDO_PIXELS))
    for _ in range(2):
        claimed = ~cut.total_variation(_image(said, seen), edges, STIFFNESS)
        back = backdrop(seen.at(few), m[:, few], plane, claimed.ravel()[few], (claimed & sure).ravel()[few])
        if back is None:
            break
        said = evidence(seen, m, back)
    return partial(_of_plane, plane, back, lights), _image(said, seen)


def _of_plane(plane: planes.Plane, back: Backdrop | None, lights: Sequence[Light], seen: Sight) -> Array:
    m = planes.foretold(plane.q, seen.rays_C, lights)
    return _by_ratios(seen, m, plane.misfit) if back is None else evidence(seen, m, back)


def _image(values: Array, seen: Sight) -> Image:
    return np.asarray(values.reshape(seen.mask.shape), np.float32)


def _by_ratios(seen: Sight, m: Array, misfit: float) -> Array:
    """From -1 (a plane explains the pixel well, and by many lights) to 1 (it does not) of pixels (P,); 0 where nothing is seen."""
    square, count = planes.misfit(seen, m)
    limit = WALL_SIGMAS * max(1.0, misfit)
    score = np.sqrt(np.nan_to_num(square, posinf=limit**2))
    found = np.clip(np.log(np.clip(score, 0.1, 1e3) / limit), -1, 1)
    return np.where(found < 0, found * np.minimum(1, (count - 1) / MANY), found)


def _without_dark(left: Mask, support: Mask, border: Mask, seen: Sight, edges: Image) -> tuple[Mask, Mask, Word]:
    """What is left without the dark matter that hangs on the support or on the border; that matter; and what darkness says of pixels.

    Brightest lights are compared: an object's far side is dark in most lights, its support in all.
    """
    brightest = _image(seen.signal.max(axis=0), seen)
    if not left.any():
        return left, left, partial(_by_brightness, 1e-9)
    free = left & ~_hangs_on(left, border | support)
    typical = float(np.median(brightest[free] if free.sum() > 0.2 * left.sum() else brightest[left]))
    limit = DARK_SHARE * typical
    if support.any():
        limit = float(np.clip(OF_SUPPORT * np.median(brightest[support]), LEAST_DARK * typical, MOST_DARK * typical))
    word = partial(_by_brightness, limit)
    dim = ~cut.total_variation(_image(word(seen), seen), edges, STIFFNESS)
    dark = _hangs_on(left & dim, border | _grown(support, 2))
    return _tidy(left & ~dark), dark, word


def _by_brightness(limit: float, seen: Sight) -> Array:
    return np.clip(np.log2(np.maximum(seen.signal.max(axis=0), 1e-9 * limit) / limit), -1, 1)


def _without_faint(mask: Mask, against: Image) -> Mask:
    """Without pieces that hardly differ from the wall where another clearly does: the wall, lit by the untold tails of lobes."""
    from scipy import ndimage

    label, count = ndimage.label(mask)
    if count < 2:
        return mask
    mean = np.asarray(ndimage.mean(against, label, np.arange(1, count + 1)))
    if mean.max() < CLEAR:
        return mask
    return np.asarray(mask & np.isin(label, 1 + np.flatnonzero(mean >= FAINT)))


def border_band(shape: tuple[int, ...]) -> Mask:
    """The image's rim (H, W), where the background is looked for."""
    width = max(2, round(BORDER_SHARE * min(shape)))
    border = np.ones(shape, bool)
    border[width:-width, width:-width] = False
    return border


def _hangs_on(mask: Mask, seeds: Mask) -> Mask:
    """The pieces of a mask that touch seeds."""
    from scipy import ndimage

    label, _ = ndimage.label(mask)
    touched = np.unique(label[mask & seeds])
    return np.asarray(np.isin(label, touched[touched > 0]))


def _grown(mask: Mask, by: int) -> Mask:
    from scipy import ndimage

    return np.asarray(ndimage.binary_dilation(mask, iterations=by))


def _tidy(mask: Mask) -> Mask:
    """Without crumbs and small holes."""
    from scipy import ndimage

    label, count = ndimage.label(ndimage.binary_opening(mask))
    if not count:
        return np.asarray(mask & False)
    size = np.bincount(label.ravel())
    size[0] = 0
    kept = np.isin(label, np.flatnonzero(size >= SMALLEST_SHARE * size.max()))
    holes, _ = ndimage.label(~kept)
    area = np.bincount(holes.ravel())
    small = np.flatnonzero(area < HOLE_SHARE * kept.sum())
    return np.asarray(kept | np.isin(holes, small[small > 0]))


def _by_pixel(mask: Mask, maps: Grey, rays_C: Array, claims: Sequence[tuple[Word, Mask]]) -> Mask:
    """A mask whose outline is drawn anew by what is said of each pixel, each word heard in its part of the image."""
    by = max(cut.SEAM_PX, factor(maps) + 1)
    inside, near = cut.shrunk(mask, by), _grown(mask, by)
    rows, columns = np.nonzero(_grown(near, 2 * by))
    box = slice(rows.min(), rows.max() + 1), slice(columns.min(), columns.max() + 1)
    band = near & ~inside
    seen = look_at(maps, rays_C, band, central=True)
    least = np.ones(seen.pixels)
    for word, part in claims:
        here = np.flatnonzero(part[band])
        least[here] = np.minimum(least[here], word(seen.at(here)))
    said = np.where(inside, FIXED, -FIXED).astype(np.float32)
    said[band] = least
    found = np.zeros_like(mask)
    found[box] = cut.total_variation(said[box], _log(strength(maps))[box], STIFFNESS)
    found[box] = cut.halfway(found[box], maps.signal[:, *box], maps.sigma[:, *box])
    return _tidy(found)


def _picture(maps: Grey) -> Image:
    """Three pictures (H, W, 3) of the lights, 0..1: the brightest, the mean and the least."""
    ordered = np.sort(maps.signal, axis=0)
    three = np.stack([ordered[-2], ordered.mean(axis=0), ordered[len(ordered) // 3]], axis=-1)
    top = np.percentile(three, 99.5, axis=(0, 1))
    return np.asarray(np.sqrt(np.clip(three / np.maximum(top, 1e-12), 0, 1)), np.float32)


def _log(bright: Image) -> Image:
    return np.log(np.maximum(bright, 0.01 * np.percentile(bright, 99))).astype(np.float32)


def factor(maps: Grey) -> int:
    """How many pixels are joined along a side, so that COARSE_PIXELS are left at most."""
    return int(np.ceil(np.sqrt(np.prod(maps.signal.shape[1:]) / COARSE_PIXELS)))


def binned(maps: Grey, rays_C: Array) -> tuple[Grey, Array, int]:
    """The maps and rays with blocks of f x f pixels joined, so that COARSE_PIXELS are left at most, and f."""
    f = factor(maps)
    rows, columns = maps.signal.shape[1] // f, maps.signal.shape[2] // f

    def blocks(values: Array) -> Array:
        return values[..., : rows * f, : columns * f].reshape(*values.shape[:-2], rows, f, columns, f)

    signal = blocks(maps.signal.astype(float)).mean(axis=(-3, -1))
    sigma = np.sqrt((blocks(maps.sigma.astype(float)) ** 2).sum(axis=(-3, -1))) / f**2
    usable = blocks(maps.usable.astype(float)).min(axis=(-3, -1)) > 0
    rays = np.moveaxis(blocks(np.moveaxis(rays_C, -1, 0)).mean(axis=(-3, -1)), 0, -1)
    return Grey(signal.astype(np.float32), sigma.astype(np.float32), usable), rays, f


def _enlarged(mask: Mask, maps: Grey) -> Mask:
    """A coarse mask at the maps' own size."""
    import cv2

    height, width = maps.signal.shape[1:]
    f = factor(maps)
    large = cv2.resize(mask.astype(np.float32), (mask.shape[1] * f, mask.shape[0] * f), interpolation=cv2.INTER_LINEAR) > 0.5
    found = np.zeros((height, width), bool)
    found[: large.shape[0], : large.shape[1]] = large
    return found


def _otsu(values: Image) -> float:
    """The threshold that parts values into the two classes furthest apart."""
    count, edges = np.histogram(values, 256)
    middle = (edges[1:] + edges[:-1]) / 2
    below = np.cumsum(count)
    total = below[-1]
    mean = np.cumsum(count * middle)
    parted = np.clip(below * (total - below), 1, None).astype(float)
    between = (mean[-1] * below - mean * total) ** 2 / parted
    return float(middle[np.argmax(between)])
