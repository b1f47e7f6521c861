"""What a grid of corners says of its squares: which are black, which end is the first.

Symbols: grid g (ny, nx, 2) of corners in pixels; cell (i, j) lies between corners i, i + 1 and j, j + 1; cells one beyond the grid are
the board's outer squares, cells two beyond are its margin. Places beyond the grid continue its last three corners by a parabola.
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array, Labels


def spacing_px(grid: Array) -> float:
    """Smallest distance of neighbouring corners."""
    steps = [np.linalg.norm(np.diff(grid, axis=axis), axis=-1).ravel() for axis in (0, 1)]
    return float(np.nanmin(np.concatenate(steps)))


def contrast(grey: Labels) -> float:
    """Difference of bright and dark in an image of 8 bit."""
    low, high = np.percentile(grey[::2, ::2], [1, 99])
    return float(high - low)


def in_board_order(grey: Labels, grid: Array) -> Array:
    """The grid (ny, nx, 2) turned so that its first corner is the board's: its outer square is black where the pattern shows its ends."""
    candidates = [turned for turned in _turns(grid) if _turns_clockwise(turned)]
    black = [first_square_is_black(grey, turned) for turned in candidates]
    if any(black) and not all(black):
        candidates = [turned for turned, is_black in zip(candidates, black, strict=True) if is_black]
    return max(candidates, key=lambda turned: float(_direction(turned, 1) @ [1.0, 0.01]))


def in_clockwise_order(grid: Array) -> Array:
    """The grid (ny, nx, 2) of a pattern without ends, turned so that x to y is clockwise and x points most to the right."""
    candidates = [turned for turned in _turns(grid) if _turns_clockwise(turned)]
    return max(candidates, key=lambda turned: float(_direction(turned, 1) @ [1.0, 0.01]))


def first_square_is_black(grey: Labels, grid: Array) -> bool:
    """Whether the outer square of the first corner is black: it is as dark as the cell inside that corner."""
    light = _lightness(grey, cell_centres(grid))
    even = _parity(light.shape) > 0
    return bool(np.nanmean(light[even]) < np.nanmean(light[~even]))


def cell_centres(grid: Array) -> Array:
    """Middles (ny - 1, nx - 1, 2) of the cells of a grid (ny, nx, 2)."""
    return np.asarray((grid[:-1, :-1] + grid[1:, :-1] + grid[:-1, 1:] + grid[1:, 1:]) / 4)


def extended(grid: Array, lines: int) -> Array:
    """The grid continued by some lines on every side."""
    for _ in range(lines):
        for axis in (0, 1):
            g = np.moveaxis(grid, axis, 0)
            before, after = _continued(g[0], g[1], g[2] if len(g) > 2 else None), _continued(g[-1], g[-2], g[-3] if len(g) > 2 else None)
            grid = np.moveaxis(np.concatenate([before[None], g, after[None]]), 0, axis)
    return grid


def _continued(last: Array, second: Array, third: Array | None) -> Array:
    return np.asarray(2 * last - second if third is None else 3 * last - 3 * second + third)


def _parity(shape: tuple[int, ...]) -> Array:
    j, i = np.indices(shape)
    return np.asarray((-1.0) ** (i + j))


def _lightness(grey: Labels, places: Array) -> Array:
    """Light (...) at places (..., 2), averaged over a quarter of their distance; NaN outside the image."""
    import cv2

    side = max(1, int(spacing_px(places) / 4)) if min(places.shape[:2]) > 1 else 3
    smooth = cv2.blur(grey, (side, side))
    places = np.nan_to_num(places, nan=-1.0)
    column, row = np.rint(places[..., 0]).astype(int), np.rint(places[..., 1]).astype(int)
    inside = (column >= 0) & (row >= 0) & (column < grey.shape[1]) & (row < grey.shape[0])
    light = smooth[np.clip(row, 0, grey.shape[0] - 1), np.clip(column, 0, grey.shape[1] - 1)].astype(float)
    return np.where(inside, light, np.nan)


def _turns(grid: Array) -> list[Array]:
    """The grid's other readings: every end first, rows and columns swapped where there are as many of both."""
    readings = [grid, grid[::-1], grid[:, ::-1], grid[::-1, ::-1]]
    if grid.shape[0] == grid.shape[1]:
        readings += [np.swapaxes(reading, 0, 1) for reading in readings]
    return readings


def _direction(grid: Array, axis: int) -> Array:
    """Mean direction (2,) in the image along x (axis 1) or y (axis 0)."""
    step = np.nanmean(np.diff(grid, axis=axis), axis=(0, 1))
    return np.asarray(step / np.linalg.norm(step))


def _turns_clockwise(grid: Array) -> bool:
    x, y = _direction(grid, 1), _direction(grid, 0)
    return bool(x[0] * y[1] - x[1] * y[0] > 0)
