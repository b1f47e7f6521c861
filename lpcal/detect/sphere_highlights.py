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
LARGE_RADIUS_PX = 150.0
"""All lengths but the sigmas grow with the outline's radius from here: a light's image is a share of the sphere's."""
RIVAL = 0.5
"""A second spot of this share of the first is its rival; one of this share of the lights is a lamp of the room."""
VALLEY = 0.7
"""Between two spots it is darker than this share of the fainter one, or they are one."""


@dataclass(frozen=True)
class Highlight:
    """Centroid (2,) in pixels, its standard deviation, the light in it, and whether it was saturated."""

    centre_px: Array
    sigma_px: float
    flux: float
    saturated: bool


def find_highlight(image: Image, noise: float, saturated: Mask, centre_px: Array, radius_px: float) -> list[Highlight]:
    """The brightest spot inside a circle of a linear image (H, W) and its rivals, the brightest first; none where nothing stands out.

    Parameters
    ----------
    noise : one standard deviation of a dark pixel
    saturated : (H, W)
    centre_px, radius_px : the outline's circle
    """
    from scipy.ndimage import gaussian_filter

    rows, columns = np.ogrid[: image.shape[0], : image.shape[1]]
    inside = (columns - centre_px[0]) ** 2 + (rows - centre_px[1]) ** 2 < (INSIDE * radius_px) ** 2
    box = _box(inside)
    part, inside, full = image[box].astype(float), inside[box], saturated[box]
    corner, scale = np.array([box[1].start, box[0].start]), max(1.0, radius_px / LARGE_RADIUS_PX)
    patches = _patches(full & inside, scale)
    if patches:
        return [_saturated_centroid(part, patch, corner) for patch in patches]
    blurred = gaussian_filter(part, scale)
    background = float(np.median(part[inside]))
    found: list[Highlight] = []
    for peak in _peaks(np.where(inside, blurred, -np.inf), background, 2 * WINDOW_PX * scale):
        height = blurred[peak] - background
        if height < SIGNIFICANT * noise / (3.5 * scale):  # a blur of 1 px lowers white noise 3.5 times
            break
        centre, flux = _centroid(part, np.array([peak[1], peak[0]], dtype=float), scale)
        if flux > 0:
            found.append(Highlight(centre + corner, float(np.hypot(SIGMA_PX, noise / max(height, 1e-9))), flux, saturated=False))
    return found


def without_lamps(spots: dict[str, list[Highlight]], radius_px: float) -> dict[str, list[Highlight]]:
    """The spots of each light without those that stand at the same place under most of the lights: lamps of the room."""
    reach = 2 * max(1.0, radius_px / LARGE_RADIUS_PX)

    def is_lamp(spot: Highlight) -> bool:
        alike = [any(np.linalg.norm(spot.centre_px - other.centre_px) < reach for other in others) for others in spots.values()]
        return sum(alike) > max(2.0, RIVAL * len(spots))

    return {light: [spot for spot in own if not is_lamp(spot)] for light, own in spots.items()}


def _peaks(blurred: Image, background: float, apart_px: float) -> list[tuple[int, int]]:
    """Places (row, column) of the highest peak and of those that rival it, apart from each other with a valley between."""
    left, found = blurred.copy(), list[tuple[int, int]]()
    rows, columns = np.indices(blurred.shape)
    while len(found) < 3:
        row, column = (int(index) for index in np.unravel_index(np.argmax(left), left.shape))
        height = float(left[row, column]) - background
        if not np.isfinite(height) or (found and height < RIVAL * (blurred[found[0]] - background)):
            break
        if all(_valley(blurred, (row, column), other) - background < VALLEY * height for other in found):
            found.append((row, column))
        left[np.hypot(rows - row, columns - column) < apart_px] = -np.inf
    return found


def _valley(blurred: Image, a: tuple[int, int], b: tuple[int, int]) -> float:
    """The darkest place on the line between two pixels."""
    steps = np.linspace(0, 1, 2 + int(np.hypot(a[0] - b[0], a[1] - b[1])))
    rows, columns = (np.rint(a[axis] + steps * (b[axis] - a[axis])).astype(int) for axis in (0, 1))
    return float(blurred[rows, columns].min())


def _centroid(part: Array, centre: Array, scale: float) -> tuple[Array, float]:
    """Centroid (x, y) and flux of a spot over its local background, from near its peak."""
    rows, columns = np.indices(part.shape)
    flux = 0.0
    for _ in range(ROUNDS):
        distance = np.hypot(columns - centre[0], rows - centre[1])
        ring = part[(distance > RING_PX[0] * scale) & (distance < RING_PX[1] * scale)]
        background = float(np.median(ring)) if ring.size else 0.0
        weight = np.clip(WINDOW_PX * scale + 0.5 - distance, 0.0, 1.0) * (part - background)
        flux = float(weight.sum())
        if flux <= 0:
            return centre, 0.0
        new = np.array([np.sum(weight * columns), np.sum(weight * rows)]) / flux
        new = centre + np.clip(new - centre, -2, 2)
        if np.linalg.norm(new - centre) < 1e-4:
            break
        centre = new
    return centre, flux


def _patches(full: Mask, scale: float) -> list[Mask]:
    """The largest saturated patch and those that rival it; what is near to each other is one."""
    from scipy.ndimage import binary_dilation, label

    if not full.any():
        return []
    labels, _ = label(binary_dilation(full, np.ones((3, 3), dtype=bool), iterations=round(2 * scale)))
    sizes = np.bincount(labels[full])
    order = np.argsort(sizes)[::-1]
    return [np.asarray(full & (labels == k)) for k in order if k > 0 and sizes[k] > RIVAL * sizes.max()]


def _saturated_centroid(part: Array, patch: Mask, corner: Array) -> Highlight:
    from scipy.ndimage import binary_dilation

    rows, columns = np.indices(part.shape)
    around = binary_dilation(patch, iterations=2)
    ring = binary_dilation(patch, iterations=5) & ~binary_dilation(patch, iterations=3)
    background = float(np.median(part[ring])) if ring.any() else 0.0
    weight = np.where(around, np.maximum(part - background, 0.0), 0.0)
    flux = float(weight.sum())
    centre = np.array([np.sum(weight * columns), np.sum(weight * rows)]) / flux
    sigma = SIGMA_SATURATED_PX * max(1.0, np.sqrt(patch.sum() / np.pi) / 4)
    return Highlight(centre + corner, float(sigma), flux, saturated=True)


def _box(mask: Mask) -> tuple[slice, slice]:
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
