"""About where a sphere's outline is: from a hint, from a mask, or by OpenCV's gradient Hough transform, verified on the image."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry.arrays import Array, Image, Mask

RADIUS_SHARE = (0.03, 0.55)
"""Radii looked for, as shares of the image's shorter side, where nothing is known."""
CANDIDATES = 12
SEEN_SHARE, SEEN_SHARE_BEYOND = 0.6, 0.35
"""Share of a circle that must lie in the image."""


def from_mask(mask: Mask) -> Array:
    """Circle (x, y, radius) of the largest piece of a mask (H, W).

    Raises
    ------
    DegenerateError
        The mask is empty.
    """
    rows, columns = np.nonzero(mask)
    if rows.size < 20:
        raise DegenerateError("the mask of the sphere is empty", needed="its pixels not zero")
    return np.array([columns.mean(), rows.mean(), np.sqrt(rows.size / np.pi)])


def search(image: Image, radius_px: tuple[float, float] | None = None) -> list[Array]:
    """Circles (x, y, radius) that may be a sphere's outline in a linear image (H, W), the most likely first; none at all: empty."""
    return _search(_levelled(image), _range(image, radius_px), SEEN_SHARE)


def search_beyond(image: Image, radius_px: tuple[float, float] | None = None) -> list[Array]:
    """Circles (x, y, radius) that may also lie partly outside the image (H, W), the most likely first."""
    low, high = _range(image, radius_px)
    pad = int(np.ceil(high))
    levelled = _levelled(image)
    found = _search(np.pad(levelled, pad, mode="edge"), (low, high), SEEN_SHARE)
    inside = [circle - [pad, pad, 0] for circle in found]
    return sorted(inside, key=lambda circle: -_support(levelled, circle, SEEN_SHARE_BEYOND))


def supports(image: Image, circles: Sequence[Array]) -> list[float]:
    """How much each circle (x, y, radius) is an edge all round, in units of its own."""
    levelled = _levelled(image)
    return [_support(levelled, circle, SEEN_SHARE) for circle in circles]


def _range(image: Image, radius_px: tuple[float, float] | None) -> tuple[float, float]:
    """Radii looked for: those that are known where any of them fits into the image, else all that do."""
    side = min(image.shape)
    low, high = RADIUS_SHARE[0] * side, RADIUS_SHARE[1] * side
    if radius_px is not None and radius_px[0] < high and radius_px[1] > 5.0:
        low, high = radius_px[0], min(radius_px[1], high)
    return max(low, 5.0), high


def _search(levelled: Image, radius_px: tuple[float, float], seen_share: float) -> list[Array]:
    import cv2

    (low, high), side = radius_px, min(levelled.shape)
    shrink = min(1.0, 480 / side)
    small = cv2.resize(levelled, None, fx=shrink, fy=shrink, interpolation=cv2.INTER_AREA) if shrink < 1 else levelled
    byte = cv2.GaussianBlur(np.clip(255 * small, 0, 255).astype(np.uint8), (0, 0), 1.2)
    found: list[Array] = []
    for threshold, perfectness in ((150, 0.9), (100, 0.8), (60, 0.7), (30, 0.5)):
        circles = cv2.HoughCircles(
            byte, cv2.HOUGH_GRADIENT_ALT, 1.5, max(8.0, low * shrink / 2), param1=threshold, param2=perfectness,
            minRadius=int(low * shrink), maxRadius=int(np.ceil(high * shrink)),
        )  # fmt: skip
        if circles is not None:
            found += [np.asarray(circle[:3], dtype=float) / shrink for circle in circles.reshape(-1, circles.shape[-1])[:CANDIDATES]]
    scores = [_support(levelled, circle, seen_share) for circle in found]
    order = np.argsort(scores)[::-1]
    return _distinct([found[k] for k in order])


def _levelled(image: Image) -> Image:
    """Brightness on a scale on which dark edges count as bright ones do: the logarithm over the noise floor, from 0 to 1."""
    floor = max(float(np.percentile(image, 20)), 0.003 * float(np.percentile(image, 99.5)), 1e-6)
    level = np.log(np.maximum(image, 0.0) / floor + 1.0)
    return np.asarray(level / max(float(np.percentile(level, 99.8)), 1e-6), dtype=np.float32)


def _support(levelled: Image, circle: Array, seen_share: float) -> float:
    """How much of a circle is an edge across it: the lower quartile over its rays of the step over 3 px, less what wavers inside."""
    x, y, r = circle
    around = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    direction = np.stack([np.cos(around), np.sin(around)], axis=1)

    def ring(offset: float) -> Array:
        at = np.array([x, y]) + (r + offset) * direction
        columns, rows = np.rint(at).astype(int).T
        inside = (columns >= 0) & (rows >= 0) & (columns < levelled.shape[1]) & (rows < levelled.shape[0])
        values = np.full(len(at), np.nan)
        values[inside] = levelled[rows[inside], columns[inside]]
        return values

    reach = max(2.0, 0.03 * r)
    steps = np.stack([ring(shift - reach) - ring(shift + reach) for shift in (-0.02 * r, 0.0, 0.02 * r)])
    seen = np.isfinite(steps).all(axis=0)
    if seen.mean() < seen_share:
        return 0.0
    signed = steps[:, seen]
    step = np.take_along_axis(signed, np.argmax(np.abs(signed), axis=0)[None], axis=0)[0]
    same_sign = max(np.mean(step > 0), np.mean(step < 0))
    return float(np.quantile(np.abs(step), 0.3) * same_sign * seen.mean() * np.sqrt(r))


def _distinct(circles: list[Array]) -> list[Array]:
    kept: list[Array] = []
    for circle in circles:
        if all(np.linalg.norm(circle[:2] - other[:2]) > 0.2 * other[2] or abs(circle[2] - other[2]) > 0.1 * other[2] for other in kept):
            kept.append(circle)
    return kept
