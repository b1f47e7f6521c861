r"""Whether what is inside a round outline is a ball: shaded as one, or with a mirror image of each light.

Symbols: data s_k (N,) of light k at the pixels of the outline, mean m over the lights, normals n from the outline's circle::

    matte    d_k = s_k - c_k m    what the lights change, c_k by least squares; e_k the same of max(g_k . n, 0), g_k fitted to s_k
             likeness = 1 - sum |d_k - e_k|^2 / sum |d_k|^2, both less what noise adds
    chrome   the share of the lights that show one compact spot, no two of them at one place

A picture on the wall, a plate or a mug's rim is as round as a ball, but the lights change nothing in a flat thing but its brightness, and
one turned on a lathe shows them on one axis only. Source: Lambert's law; the images of a convex Lambertian body span three dimensions
(Shashua 1992), those of a flat one a single one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from lpcal.detect.sphere_highlights import Highlight
from lpcal.detect.sphere_outline import Outline
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.observations import Radiance

DISC, LIT = 0.88, 0.12
"""Shading is compared inside this share of the radius, and fitted where a normal's cosine with the light is over the second figure."""
CHANGE = 1e-3
"""Least share of the energy that must change between the lights, else it is flat: two lights 5 degrees apart do so in a ball."""
FEWEST_PIXELS, FIT_ROUNDS = 60, 4
COMPACT, RING_PX = 0.5, (5.0, 9.0)
"""A spot's height over the ring about it, in pixels from its middle, as a share of its height over the whole; an edge has less."""
APART_PX = 1.5
"""Two lights' images in a mirror are further apart than this."""


def matte_likeness(radiance: Radiance, lights: Sequence[str], outline: Outline) -> float:
    """How much of what the lights change inside an outline a ball's shading explains: 1 all, 0 nothing; NaN where nothing tells."""
    box, n, inside = _normals(outline, radiance.saturated.shape[1:])
    index = [radiance.lights.index(light) for light in lights]
    full = np.asarray(radiance.saturated[:, *box][index].any(axis=0) if index else inside, dtype=bool)
    use = inside & ~full
    if len(index) < 2 or use.sum() < FEWEST_PIXELS:
        return float("nan")
    data = np.stack([_grey(radiance.signal[k][box])[use] for k in index]).astype(float)
    noise = float(sum(np.sum(_grey(radiance.sigma[k][box])[use].astype(float) ** 2) for k in index))
    model = np.stack([_shaded(n[use], own) for own in data])
    changed, explained = _changes(data), _changes(model)
    energy, left = float(np.sum(changed**2)) - noise, float(np.sum((changed - explained) ** 2)) - noise
    whole = float(np.sum(data**2)) - noise
    if whole < noise:
        return float("nan")
    if energy < CHANGE * whole:
        return 0.0
    return float(np.clip(1 - max(left, 0.0) / energy, 0.0, 1.0))


def chrome_likeness(spots: Mapping[str, Sequence[Highlight]], images: Mapping[str, Image], outline: Outline) -> float:
    """The share of the lights with one compact spot at a place of its own; NaN where there is no spot at all."""
    if not any(spots.values()):
        return float("nan")
    places: list[Array] = []
    for light, found in spots.items():
        if len(found) == 1 and (found[0].saturated or _compact(images[light], found[0].centre_px, outline)):
            place = found[0].centre_px
            if all(np.linalg.norm(place - other) > APART_PX for other in places):
                places.append(place)
    return len(places) / len(spots)


def _normals(outline: Outline, shape: tuple[int, ...]) -> tuple[tuple[slice, slice], Array, Mask]:
    """The box of an outline, unit normals (h, w, 3) towards the camera in it, and which of its pixels are well inside."""
    (x, y), r = outline.centre_px, outline.radius_px
    box = (slice(max(int(y - r), 0), min(int(y + r) + 2, shape[0])), slice(max(int(x - r), 0), min(int(x + r) + 2, shape[1])))
    rows, columns = np.mgrid[box]
    u, v = (columns - x) / r, (rows - y) / r
    inside = np.hypot(u, v) < DISC
    return box, np.stack([u, v, -np.sqrt(np.maximum(1 - u**2 - v**2, 0.0))], axis=-1), inside


def _shaded(n: Array, data: Array) -> Array:
    """The shading (N,) of a ball that fits data best."""
    lit, model = data > np.quantile(data, 0.3), np.zeros(len(data))
    for _ in range(FIT_ROUNDS):
        if lit.sum() < FEWEST_PIXELS // 2:
            break
        g = np.linalg.lstsq(n[lit], data[lit], rcond=None)[0]
        model = np.maximum(n @ g, 0.0)
        lit = n @ g > LIT * float(np.linalg.norm(g))
    return model


def _changes(values: Array) -> Array:
    """Rows (K, N) less their mean times what of it is in each."""
    mean = values.mean(axis=0)
    return np.asarray(values - np.outer(values @ mean / max(float(mean @ mean), 1e-30), mean))


def _compact(image: Image, place: Array, outline: Outline) -> bool:
    """Whether a spot stands over the ring about it about as far as over the whole inside of the outline."""
    box, _, inside = _normals(outline, image.shape)
    rows, columns = np.mgrid[box]
    away, scale = np.hypot(columns - place[0], rows - place[1]), max(1.0, outline.radius_px / 150.0)
    part = _grey(image)[box]
    ring, middle = inside & (away > RING_PX[0] * scale) & (away < RING_PX[1] * scale), away < 2.0 * scale
    if ring.sum() < 8 or not middle.any():
        return False
    peak, background = float(np.percentile(part[middle], 90)), float(np.median(part[inside]))
    return peak - float(np.percentile(part[ring], 75)) > COMPACT * (peak - background) > 0


def _grey(image: Image) -> Image:
    return np.asarray(image.mean(axis=2) if image.ndim == 3 else image)
