r"""Places in an image where two edges cross, as at a chessboard's inner corners, whatever the board.

Symbols: light I smoothed by s; its Hessian H with curvatures l1 > 0 > l2 along e1, e2, place p moved to where the gradient g is 0::

    saddle: -det H is greatest        p = p0 - H^-1 g        edges: cos(f) e1 +- sin(f) e2,  tan f = sqrt(l1 / -l2)

About an inner corner light is the same at opposite points of a ring and another a quarter turn on: with the ring's samples I_n of N, their
mean m and d_n = I_n - m, ::

    likeness = sum d_n d_(n + N/2) / sum d_n^2                1 at a corner, 0 in noise, negative on an edge or a square's outer corner

Sources: the edges as asymptotic directions of H, from the product of two blurred edges (see `saddle`); the ring: Bennett & Lasenby 2014.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Labels

SMOOTH_PX, RING_PX, RING = 1.3, 3.5, 24
"""Smoothing before the Hessian and radius of the ring, in px of the image searched, and samples on the ring: squares of 5 px and more
hold them; larger or blurred ones are found in a smaller image."""
LIKE = 0.75
"""Likeness of a corner: 0.9 and more on boards in focus, under 0.5 in nearly all noise."""
QUARTERS = 4
"""Times that light crosses its mean on the ring about a corner."""
LEAST_STRENGTH = 1.0
"""Of -det H times 16, in (steps of light per px^2)^2: a corner of 10 steps of contrast in focus has 20."""
MOST = 4000
"""Saddles kept, the strongest: a board of 60x40 has 2400, and more only cost time."""
LEAST_STEP = 4.0
"""Light of 255 that the ring must range over: below, rounding to whole numbers makes saddles."""
SHARPEST_TAN = 0.35
"""Tangent of the half angle between the edges, at least (20 degrees): a flatter crossing cannot be told from an edge."""


@dataclass(frozen=True)
class SaddlePoints:
    """Saddles of an image: places (N, 2) in px, directions (N, 2, 2) of the two edges, and direction (N, 2) of the bright quarters."""

    places_px: Array
    edges: Array
    bright: Array


def saddle_points(grey: Labels) -> SaddlePoints:
    """The saddles of an image (H, W) of 8 bit."""
    import cv2

    light = cv2.GaussianBlur(grey, (0, 0), SMOOTH_PX).astype(np.float32)
    xx, yy, xy = (cv2.Sobel(light, cv2.CV_32F, *order, ksize=3) for order in ((2, 0), (0, 2), (1, 1)))
    strength = xy * xy - xx * yy
    greatest = (strength >= cv2.dilate(strength, np.ones((5, 5), np.uint8))) & (strength > LEAST_STRENGTH)
    rim = int(np.ceil(RING_PX)) + 1
    greatest[:rim], greatest[-rim:], greatest[:, :rim], greatest[:, -rim:] = False, False, False, False
    row, column = np.nonzero(greatest)
    order = np.argsort(-strength[row, column])[: 4 * MOST]
    row, column = row[order], column[order]
    # Sobel's derivatives of second order are four times the curvature
    H = np.stack([xx[row, column], xy[row, column], xy[row, column], yy[row, column]], axis=-1).reshape(-1, 2, 2).astype(float) / 4
    slope = [(light[row, column + 1] - light[row, column - 1]) / 2, (light[row + 1, column] - light[row - 1, column]) / 2]
    step = -np.linalg.solve(H, np.stack(slope, axis=-1)[..., None])[..., 0]
    places = np.stack([column, row], axis=-1) + np.clip(step, -1.5, 1.5)
    like, span = likeness(light, places, np.full(len(places), RING_PX))
    likely = np.flatnonzero((like > LIKE) & (span > LEAST_STEP))
    places = places[likely]
    curvature, axes = np.linalg.eigh(H[likely])
    tangent = np.sqrt(np.maximum(curvature[:, 1], 0) / np.maximum(-curvature[:, 0], 1e-9))
    kept = (tangent > SHARPEST_TAN) & (tangent < 1 / SHARPEST_TAN)
    rows = np.flatnonzero(kept)[:MOST]
    bright, dark, tangent = axes[rows, :, 1], axes[rows, :, 0], tangent[rows, None]
    edges = np.stack([bright + tangent * dark, bright - tangent * dark], axis=1)
    return SaddlePoints(places[rows], edges / np.linalg.norm(edges, axis=-1, keepdims=True), bright)


def likeness(light: Array, places: Array, radius_px: Array) -> tuple[Array, Array]:
    """How much the light about places (N, 2) is a corner's on rings of radii (N,), and the range of light there; -1 outside the image."""
    import cv2

    if not len(places):
        return np.zeros(0), np.zeros(0)
    angle = 2 * np.pi * np.arange(RING) / RING
    ring = places[:, None] + radius_px[:, None, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    inside = np.all((ring >= 0) & (ring <= np.array(light.shape[1::-1]) - 1), axis=(1, 2))
    at = np.nan_to_num(ring, nan=-1.0).astype(np.float32)
    samples = np.concatenate(
        [cv2.remap(light, at[k : k + 30000, :, 0], at[k : k + 30000, :, 1], cv2.INTER_LINEAR) for k in range(0, len(at), 30000)]
    ).astype(float)
    about = samples - samples.mean(axis=1, keepdims=True)
    like = np.sum(about * np.roll(about, RING // 2, axis=1), axis=1) / np.maximum(np.sum(about**2, axis=1), 1e-9)
    sides = np.sum((about > 0) != (np.roll(about, 1, axis=1) > 0), axis=1)
    return np.where(inside & (sides == QUARTERS), like, -1.0), np.where(inside, np.ptp(samples, axis=1), 0.0)
