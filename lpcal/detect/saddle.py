r"""A chessboard corner to a few thousandths of a pixel: two blurred edges fitted to the pixels about it.

Symbols: window of pixels p about a corner p0; edge k at the angle theta_k, blur s, light I::

    d_k = (-sin theta_k, cos theta_k) . (p - p0)
    P(p) = erf(d_1 / (sqrt(2) s)) erf(d_2 / (sqrt(2) s))
    I(p) = (1 + g . p) [a + c P + q (1 - P^2)]

All ten numbers (p0, theta_1, theta_2, log s, a, c, g, q) are sought by Levenberg-Marquardt from the grid's own directions. Light that
slopes over the window is the model's own, where the saddle of the grey values (Forstner & Gulch) is drawn aside by it: on rendered boards
the fit is five times nearer, on real ones its residual is a quarter less. q is what a sensor that is not linear, or white that spreads
over black, does to an edge: it moves edges of opposite sense apart (by half a pixel on some real sets), and without it the corner found
depends on the window's size. Sources: the chain rule; the image of an edge under a round blur; erf by Abramowitz & Stegun 1964, 7.1.26.

Places in an image where two edges cross, as at a chessboard's inner corners, whatever the board.

Symbols: light I smoothed by s; its Hessian H with curvatures l1 > 0 > l2 along e1, e2, place p moved to where the gradient g is 0::

    saddle: -det H is greatest        p = p0 - H^-1 g        edges: cos(f) e1 +- sin(f) e2,  tan f = sqrt(l1 / -l2)

About an inner corner light is the same at opposite points of a ring and another a quarter turn on: with the ring's samples I_n of N, their
mean m and d_n = I_n - m, ::

    likeness = sum d_n d_(n + N/2) / sum d_n^2                1 at a corner, 0 in noise, negative on an edge or a square's outer corner

Sources: the edges as asymptotic directions of H, from the product of two blurred edges (see `saddle`); the ring: Bennett & Lasenby 2014.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from lpcal.geometry.arrays import Array, Image, Index, Labels, Mask
from lpcal.kernels.library import kernel

SMOOTH_PX, RING_PX, RING = 1.3, 3.5, 24
"""Smoothing before the Hessian and radius of the ring, in px of the image searched, and samples on the ring: squares of 5 px and more
hold them; larger or blurred ones are found in a smaller image."""
LIKE = 0.75
"""Likeness of a corner: 0.9 and more on boards in focus, under 0.5 in nearly all noise."""
QUARTERS = 4
"""Times that light crosses its mean on the ring about a corner."""
LEAST_STRENGTH = 1.0
"""Least value of -det H times 16, in (steps of light per px^2)^2: a corner of 10 steps of contrast in focus has 20."""
MOST_STEP_PX = 1.5
"""A saddle lies no further than this, in px along an axis, from the pixel at which -det H is greatest."""
MOST = 4000
"""Saddles kept, the strongest: a board of 60x40 has 2400, and more only cost time."""
LEAST_STEP = 4.0
"""Light of 255 that the ring must range over: below, rounding to whole numbers makes saddles."""
SHARPEST_TAN = 0.35
"""Tangent of the half angle between the edges, at least (20 degrees): a flatter crossing cannot be distinguished from an edge."""


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
    at, strength = _greatest(light)
    if len(at) > (most := 4 * MOST):
        at = at[strength[at] >= np.partition(strength[at], len(at) - most)[len(at) - most]]
    places, H = _moved(light, at)
    like, span = likeness(light, places, np.full(len(places), RING_PX))
    likely = np.flatnonzero((like > LIKE) & (span > LEAST_STEP))
    likely = likely[np.argsort(-strength[at[likely]], kind="stable")]
    H = H[likely][:, [0, 1, 1, 2]].reshape(-1, 2, 2)
    places = places[likely]
    curvature, axes = np.linalg.eigh(H)
    tangent = np.sqrt(np.maximum(curvature[:, 1], 0) / np.maximum(-curvature[:, 0], 1e-9))
    kept = (tangent > SHARPEST_TAN) & (tangent < 1 / SHARPEST_TAN)
    rows = np.flatnonzero(kept)[:MOST]
    bright, dark, tangent = axes[rows, :, 1], axes[rows, :, 0], tangent[rows, None]
    edges = np.stack([bright + tangent * dark, bright - tangent * dark], axis=1)
    return SaddlePoints(places[rows], edges / np.linalg.norm(edges, axis=-1, keepdims=True), bright)


def _greatest(light: Array) -> tuple[Index, Image]:
    """Pixels, counted row by row, at which -det H is greatest about, and 16 times that of every pixel, of smoothed light (H, W)."""
    rim = int(np.ceil(RING_PX)) + 1
    if run := kernel("curved"):
        strength, at, found = np.empty(light.shape, np.float32), np.empty(light.size, np.int64), np.zeros(1, np.int64)
        run(*light.shape, light, LEAST_STRENGTH, rim, strength, at, found)
        return at[: found[0]].copy(), strength.ravel()
    import cv2

    xx, yy, xy = (cv2.Sobel(light, cv2.CV_32F, *order, ksize=3) for order in ((2, 0), (0, 2), (1, 1)))
    strength = xy * xy - xx * yy
    greatest = (strength >= cv2.dilate(strength, np.ones((5, 5), np.uint8))) & (strength > LEAST_STRENGTH)
    greatest[:rim], greatest[-rim:], greatest[:, :rim], greatest[:, -rim:] = False, False, False, False
    return np.flatnonzero(greatest), strength.ravel()


def _moved(light: Array, at: Index) -> tuple[Array, Array]:
    """Places (N, 2) where the gradient of light (H, W) is 0 about pixels, and its Hessian (N, 3) at them: xx, xy, yy."""
    down = light.shape[1]
    if run := kernel("moved"):
        places, H = np.empty((len(at), 2)), np.empty((len(at), 3))
        run(len(at), down, light, at, MOST_STEP_PX, places, H)
        return places, H
    # Sobel's derivatives of second order are four times the curvature
    around = {(x, y): light.ravel()[at + y * down + x].astype(float) / 4 for x in (-1, 0, 1) for y in (-1, 0, 1)}
    column = {x: around[x, -1] + 2 * around[x, 0] + around[x, 1] for x in (-1, 0, 1)}
    row = {y: around[-1, y] + 2 * around[0, y] + around[1, y] for y in (-1, 0, 1)}
    xx, yy = column[-1] - 2 * column[0] + column[1], row[-1] - 2 * row[0] + row[1]
    xy = around[1, 1] - around[-1, 1] - around[1, -1] + around[-1, -1]
    beside, below = 2 * (around[1, 0] - around[-1, 0]), 2 * (around[0, 1] - around[0, -1])
    step = np.stack([xy * below - yy * beside, xy * beside - xx * below], axis=-1) / (xx * yy - xy * xy)[:, None]
    places = np.stack([at % down, at // down], axis=-1) + np.clip(step, -MOST_STEP_PX, MOST_STEP_PX)
    return places, np.stack([xx, xy, yy], axis=-1)


def likeness(light: Array, places: Array, radius_px: Array) -> tuple[Array, Array]:
    """How much the light about places (N, 2) is a corner's on rings of radii (N,), and the range of light there; -1 outside the image."""
    angle = 2 * np.pi * np.arange(RING) / RING
    compass = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    if run := kernel("ring"):
        like, span = np.empty(len(places)), np.empty(len(places))
        given = (np.ascontiguousarray(one, float) for one in (compass, places, radius_px))
        run(len(places), *light.shape, np.ascontiguousarray(light, np.float32), *given, QUARTERS, like, span)
        return like, span
    last = np.array(light.shape[1::-1]) - 1
    inside = np.all((places - radius_px[:, None] >= 0) & (places + radius_px[:, None] <= last), axis=1)
    x, y = np.moveaxis(np.where(inside[:, None], places, 0)[:, None] + np.where(inside, radius_px, 0)[:, None, None] * compass, -1, 0)
    column, row = np.minimum(x.astype(int), last[0] - 1), np.minimum(y.astype(int), last[1] - 1)
    u, v = x - column, y - row
    above = (1 - u) * light[row, column] + u * light[row, column + 1]
    samples = (1 - v) * above + v * ((1 - u) * light[row + 1, column] + u * light[row + 1, column + 1])
    about = samples - samples.mean(axis=1, keepdims=True)
    like = np.sum(about * np.roll(about, RING // 2, axis=1), axis=1) / np.maximum(np.sum(about**2, axis=1), 1e-9)
    sides = np.sum((about > 0) != (np.roll(about, 1, axis=1) > 0), axis=1)
    return np.where(inside & (sides == QUARTERS), like, -1.0), np.where(inside, np.ptp(samples, axis=1), 0.0)


STEPS = 12
PRECISION = np.array([1e-3, 1e-3, 1e-2, 1e-2, 2e-2])
"""Steps of place (px), angles (rad) and log blur that end the search."""
MOST_DAMPING = 1e4
TINY = 1e-9
CHUNK = 128
ERF = tuple(np.float32(number) for number in (1.061405429, -1.453152027, 1.421413741, -0.284496736, 0.254829592))
LEAST_HALF_PX, MOST_HALF_PX = 3, 10
"""Half side of the window: below, there is too little to fit; above, there is nothing to gain."""
BLUR_PX = (0.3, 6.0)
"""A pixel's own square is a blur of 0.29."""
STEP_LIMIT = 0.3
STRAY = 0.3
"""A fit that leads further than this from the start, in half windows, is not believed, nor one of edges that nearly coincide."""
LEAST_ANGLE_SIN = 0.25
NUMBERS = 10
RIM_PX = 2
"""Corners closer to the image's edge than this are left as they are."""


@dataclass(frozen=True)
class Saddles:
    """What the fits found."""

    corners_px: Array
    """(ny, nx, 2)."""
    sigma_px: Array
    """(ny, nx) one standard deviation of a coordinate, by the scatter of the fit; NaN: left as it was."""
    blur_px: float
    """Median blur of the edges, one sigma; NaN where none was fitted."""


def fit_saddles(image: Image, grid: Array, half_px: int, every: int = 1) -> Saddles:
    """Corners of a grid (ny, nx, 2) nearer to where the edges cross; one in `every` of them where a sample will do.

    Corners that are NaN, on the image's rim, or not believed stay as they are, sigma NaN.
    """
    found, sigma_px = grid.copy(), np.full(grid.shape[:2], np.nan)
    half = min(int(half_px), MOST_HALF_PX)
    usable = _inside(grid, image.shape)
    angles = _angles(grid)
    usable &= np.isfinite(angles).all(axis=-1)
    usable.flat[np.arange(usable.size) % every != 0] = False
    if half < LEAST_HALF_PX or not usable.any():
        return Saddles(found, sigma_px, float("nan"))
    blur_px = []
    for row in range(0, int(usable.sum()), CHUNK):
        rows = np.flatnonzero(usable)[row : row + CHUNK]
        places, sigma, blur = _fit(image, grid.reshape(-1, 2)[rows], angles.reshape(-1, 2)[rows], half)
        found.reshape(-1, 2)[rows], sigma_px.reshape(-1)[rows] = places, sigma
        blur_px.append(blur[np.isfinite(sigma)])
    blurs = np.concatenate(blur_px)
    return Saddles(found, sigma_px, float(np.median(blurs)) if blurs.size else float("nan"))


def _fit(image: Image, corners: Array, angles: Array, half: int) -> tuple[Array, Array, Array]:
    """Corners (n, 2) and their sigmas (n,) where the fit is believed; else as they were, NaN; and the edges' blur (n,)."""
    offsets, light, weight, middle = _windows(image, corners, half)
    numbers, variance = _levenberg_marquardt(np.concatenate([corners - middle, angles], axis=1), offsets, light, weight)
    places = middle + numbers[:, :2]
    believed = np.linalg.norm(places - corners, axis=1) < STRAY * half
    believed &= np.abs(np.sin(numbers[:, 2] - numbers[:, 3])) > LEAST_ANGLE_SIN
    believed &= variance > 0
    sigma_px = np.sqrt(np.maximum(variance, 0.0))
    return np.where(believed[:, None], places, corners), np.where(believed, sigma_px, np.nan), np.exp(numbers[:, 4])


def _inside(grid: Array, shape: tuple[int, ...]) -> Mask:
    places = np.nan_to_num(grid, nan=-1.0)
    return np.asarray(np.all((places > RIM_PX) & (places < np.array(shape[1::-1]) - 1 - RIM_PX), axis=-1))


def _angles(grid: Array) -> Array:
    """Angles (ny, nx, 2) of the grid's lines at each corner, along x and along y; NaN where no neighbour was seen."""
    angles = []
    for axis in (1, 0):
        lines = np.moveaxis(grid, axis, 0)
        steps = np.diff(lines, axis=0)
        ahead = np.concatenate([steps, np.full((1, *steps.shape[1:]), np.nan)])
        behind = np.concatenate([np.full((1, *steps.shape[1:]), np.nan), steps])
        both = np.nan_to_num(ahead) + np.nan_to_num(behind)
        both[np.isnan(ahead).any(axis=-1) & np.isnan(behind).any(axis=-1)] = np.nan
        both = np.moveaxis(both, 0, axis)
        angles.append(np.arctan2(both[..., 1], both[..., 0]))
    return np.stack(angles, axis=-1)


def _windows(image: Image, corners: Array, half: int) -> tuple[Any, ...]:
    """Offsets (P, 2) of a round window, its light (n, P), whether it is in the image (n, P), and the pixels (n, 2) that it is about."""
    y, x = (axis.ravel() for axis in np.mgrid[-half : half + 1, -half : half + 1])
    offsets = np.stack([x, y], axis=1)[x * x + y * y <= (half + 0.5) ** 2]
    middle = np.rint(corners).astype(int)
    places = middle[:, None] + offsets
    last = np.array(image.shape[1::-1]) - 1
    weight = np.all((places >= 0) & (places <= last), axis=-1).astype(np.float32)
    places = np.clip(places, 0, last)
    light = np.asarray(image[places[..., 1], places[..., 0]], dtype=np.float32)
    scale = np.maximum(np.ptp(light, axis=1, keepdims=True), np.float32(1e-12))
    return offsets.astype(np.float32), light / scale, weight, middle


def _levenberg_marquardt(start: Array, offsets: Array, light: Array, weight: Array) -> tuple[Array, Array]:
    """Numbers (n, 10) from places and angles (n, 4), and the place's variance (n,) by the scatter; each corner has its own damping."""
    numbers = np.concatenate([start, np.zeros((len(start), NUMBERS - 4))], axis=1)
    if run := kernel("saddles"):
        limits, variance = np.array([*PRECISION, STEP_LIMIT, *np.log(BLUR_PX), MOST_DAMPING, TINY]), np.empty(len(start))
        run(*weight.shape, STEPS, limits, *(np.ascontiguousarray(one, np.float32) for one in (offsets, light, weight)), numbers, variance)
        return numbers, variance
    numbers[:, 5:7] = _first_light(numbers, offsets, light, weight)
    damping, moving = np.full(len(start), 1e-3), np.ones(len(start), dtype=bool)
    J, residual = _linearised(numbers, offsets, light, weight)
    cost = np.sum(residual**2, axis=1)
    for _ in range(STEPS):
        rows = np.flatnonzero(moving)
        if not rows.size:
            break
        turned = np.swapaxes(J[rows], 1, 2)
        N, right = (turned @ J[rows]).astype(float), (turned @ residual[rows][..., None]).astype(float)
        N += (damping[rows, None] * np.einsum("nii->ni", N) + TINY)[:, :, None] * np.eye(NUMBERS)
        step = np.clip(np.linalg.solve(N, right)[..., 0], -STEP_LIMIT, STEP_LIMIT)
        trial = numbers[rows] + step
        trial[:, 4] = np.clip(trial[:, 4], *np.log(BLUR_PX))
        J_trial, residual_trial = _linearised(trial, offsets, light[rows], weight[rows])
        cost_trial = np.sum(residual_trial**2, axis=1)
        better = cost_trial < cost[rows]
        taken = rows[better]
        numbers[taken], J[taken], residual[taken], cost[taken] = trial[better], J_trial[better], residual_trial[better], cost_trial[better]
        damping[rows] *= np.where(better, 0.2, 10.0)
        moving[rows] = (np.abs(step[:, :5]) > PRECISION).any(axis=1) & (damping[rows] < MOST_DAMPING)
    N = (np.swapaxes(J, 1, 2) @ J).astype(float) + TINY * np.eye(NUMBERS)
    free = np.maximum(weight.sum(axis=1) - NUMBERS, 1)
    return numbers, np.trace(np.linalg.inv(N)[:, :2, :2], axis1=1, axis2=2) / 2 * cost / free


def _edges(numbers: Array, offsets: Array) -> tuple[Any, ...]:
    """Cosines and sines (2, n, 1) of the edges' angles, distances from them, places along them, profiles and slopes (2, n, P)."""
    numbers = numbers.astype(np.float32)
    x = offsets[:, 0] - numbers[:, 0, None]
    y = offsets[:, 1] - numbers[:, 1, None]
    cos, sin = np.cos(numbers[:, 2:4].T)[..., None], np.sin(numbers[:, 2:4].T)[..., None]
    inverse = np.exp(-numbers[:, 4])[:, None]
    across = cos * y - sin * x
    scaled = across * (inverse * np.float32(np.sqrt(0.5)))
    bell = np.exp(-scaled * scaled)
    slope = bell * (inverse * np.float32(np.sqrt(2 / np.pi)))
    return cos, sin, across, cos * x + sin * y, _erf(scaled, bell), slope


def _erf(x: Array, bell: Array) -> Array:
    """Erf of x to 2e-7, exp(-x^2) known."""
    t = 1 / (1 + np.float32(0.3275911) * np.abs(x))
    tail = np.full_like(t, ERF[0])
    for number in ERF[1:]:
        tail = tail * t + number
    return np.copysign(1 - tail * t * bell, x)


def _first_light(numbers: Array, offsets: Array, light: Array, weight: Array) -> Array:
    """Mean light and contrast (n, 2) that fit best at the start, without a slope."""
    profile = _edges(numbers, offsets)[4]
    pattern = profile[0] * profile[1]
    mean = [np.sum(weight * one, axis=1) / weight.sum(axis=1) for one in (light, pattern)]
    about = pattern - mean[1][:, None]
    contrast = np.sum(weight * about * light, axis=1) / np.maximum(np.sum(weight * about**2, axis=1), TINY)
    return np.stack([mean[0] - contrast * mean[1], contrast], axis=1)


def _linearised(numbers: Array, offsets: Array, light: Array, weight: Array) -> tuple[Array, Array]:
    """Derivative (n, P, 10) of the model by its numbers, and the residuals (n, P), each times its weight."""
    cos, sin, across, along, profile, slope = _edges(numbers, offsets)
    lit = numbers[:, 5:].astype(np.float32)
    shade = (1 + lit[:, 2:4] @ offsets.T) * weight
    pattern = profile[0] * profile[1]
    spread = 1 - pattern**2
    board = lit[:, :1] + lit[:, 1:2] * pattern + lit[:, 4:] * spread
    contrast = (lit[:, 1:2] - 2 * lit[:, 4:] * pattern) * shade
    first, second = contrast * slope[0] * profile[1], contrast * slope[1] * profile[0]
    J = np.empty((*pattern.shape, NUMBERS), np.float32)
    J[..., 0] = first * sin[0] + second * sin[1]
    J[..., 1] = -first * cos[0] - second * cos[1]
    J[..., 2], J[..., 3] = -first * along[0], -second * along[1]
    J[..., 4] = -first * across[0] - second * across[1]
    J[..., 5], J[..., 6] = shade, shade * pattern
    J[..., 7:9] = (board * weight)[..., None] * offsets
    J[..., 9] = shade * spread
    return J, weight * light - board * shade
