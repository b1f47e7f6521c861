"""The mirror images of lights in a chrome sphere.

A highlight is the brightest compact spot inside the outline: blur of 1 px, peak, then the centroid of what stands over the local
background within a few pixels, iterated until it stays. Where the sensor saturates, the centroid of the saturated patch and its flanks
is taken; it is several times less certain. Source: intensity-weighted centroids with background, standard in star trackers (Liebe 2002).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Image, Mask

WINDOW_PX = 5.0
RING_PX = (7.0, 10.0)
SIGNIFICANT = 8.0
INSIDE = 0.97
SIGMA_PX = 0.015
SIGMA_SATURATED_PX = 0.10
ROUNDS = 20


@dataclass(frozen=True)
class Highlight:
    """Centroid (2,) in pixels, its standard deviation, the light in it, and whether it was saturated."""

    centre_px: Array
    sigma_px: float
    flux: float
    saturated: bool


def find_highlight(image: Image, noise: float, saturated: Mask, centre_px: Array, radius_px: float) -> Highlight | None:
    """The brightest spot inside a circle of a linear image (H, W), or None where nothing stands out.

    Parameters
    ----------
    noise : one standard deviation of a dark pixel
    saturated : (H, W)
    centre_px, radius_px : the outline's circle
    """
    from scipy.ndimage import gaussian_filter

    rows, columns = np.indices(image.shape)
    inside = np.hypot(columns - centre_px[0], rows - centre_px[1]) < INSIDE * radius_px
    box = _box(inside)
    part, inside, full = image[box].astype(float), inside[box], saturated[box]
    blurred = np.where(inside, gaussian_filter(part, 1.0), -np.inf)
    patch = _largest_patch(full & inside)
    if patch is not None:
        return _saturated_centroid(part, patch, box)
    peak = np.unravel_index(np.argmax(blurred), blurred.shape)
    background = float(np.median(part[inside]))
    if blurred[peak] - background < SIGNIFICANT * noise / 3.5:  # a blur of 1 px lowers white noise 3.5 times
        return None
    centre, flux = _centroid(part, np.array([peak[1], peak[0]], dtype=float))
    if flux <= 0:
        return None
    return Highlight(
        np.add(centre, [box[1].start, box[0].start]),
        float(np.hypot(SIGMA_PX, noise / max(blurred[peak] - background, 1e-9))),
        flux,
        saturated=False,
    )


def _centroid(part: Array, centre: Array) -> tuple[Array, float]:
    """Centroid (x, y) and flux of a spot over its local background, from near its peak."""
    rows, columns = np.indices(part.shape)
    flux = 0.0
    for _ in range(ROUNDS):
        distance = np.hypot(columns - centre[0], rows - centre[1])
        ring = part[(distance > RING_PX[0]) & (distance < RING_PX[1])]
        background = float(np.median(ring)) if ring.size else 0.0
        weight = np.clip(WINDOW_PX + 0.5 - distance, 0.0, 1.0) * (part - background)
        flux = float(weight.sum())
        if flux <= 0:
            return centre, 0.0
        new = np.array([np.sum(weight * columns), np.sum(weight * rows)]) / flux
        new = centre + np.clip(new - centre, -2, 2)
        if np.linalg.norm(new - centre) < 1e-4:
            break
        centre = new
    return centre, flux


def _largest_patch(full: Mask) -> Mask | None:
    from scipy.ndimage import label

    if not full.any():
        return None
    labels, count = label(full, structure=np.ones((3, 3)))
    sizes = np.bincount(labels.ravel())[1:]
    return np.asarray(labels == 1 + int(np.argmax(sizes))) if count else None


def _saturated_centroid(part: Array, patch: Mask, box: tuple[slice, slice]) -> Highlight:
    from scipy.ndimage import binary_dilation

    rows, columns = np.indices(part.shape)
    around = binary_dilation(patch, iterations=2)
    ring = binary_dilation(patch, iterations=5) & ~binary_dilation(patch, iterations=3)
    background = float(np.median(part[ring])) if ring.any() else 0.0
    weight = np.where(around, np.maximum(part - background, 0.0), 0.0)
    flux = float(weight.sum())
    centre = np.array([np.sum(weight * columns), np.sum(weight * rows)]) / flux
    sigma = SIGMA_SATURATED_PX * max(1.0, np.sqrt(patch.sum() / np.pi) / 4)
    return Highlight(np.add(centre, [box[1].start, box[0].start]), float(sigma), flux, saturated=True)


def _box(mask: Mask) -> tuple[slice, slice]:
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
