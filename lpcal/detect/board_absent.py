"""Why no board was found in an image, and what is there instead, in words.

Looked for in turn: light at all, edges that are sharp somewhere, any grid of corners (its count, and whether it runs into the image's
edge), the board as a negative, a board too fine to be seen. Symbols: blur s of an edge of contrast c whose steepest step is g::

    s = c / (g sqrt(2 pi))
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lpcal.detect.board_grid import contrast, spacing_px
from lpcal.geometry.arrays import Array, Labels

LEAST_CONTRAST = 20
BLURRED_PX = 3.0
"""A picture whose steepest edge has more blur than this is blurred."""
FINE_PX = 8.0
"""Corners closer than this are seen in part only."""
EDGE_SQUARES = 1.5
"""A grid whose last corner is closer to the image's edge than so many squares runs out of it."""

type Search = Callable[[Labels, tuple[int, int]], Array | None]


def any_grid(grey: Labels) -> tuple[tuple[int, int], Array] | None:
    """Inner corners along the longer and the shorter side of whatever grid an image shows, and the grid (short, long, 2)."""
    import cv2

    try:
        found, places, squares = cv2.findChessboardCornersSBWithMeta(grey, (3, 3), cv2.CALIB_CB_LARGER | cv2.CALIB_CB_NORMALIZE_IMAGE)
    except cv2.error:
        return None
    if not found or squares is None:
        return None
    rows, columns = squares.shape[:2]
    grid = np.asarray(places, dtype=float).reshape(rows, columns, 2)
    return (max(rows, columns), min(rows, columns)), grid if columns >= rows else grid.swapaxes(0, 1)


def what_is_there(grey: Labels, corners: tuple[int, int], search: Search) -> str:
    """Why a board of some inner corners was not found in an image (H, W) of 8 bit; `search` is how it was looked for."""
    import cv2

    none = "no board found"
    if contrast(grey) < LEAST_CONTRAST:
        return f"{none}: the image has hardly any contrast"
    blur_px = edge_blur(grey)
    if blur_px > BLURRED_PX:
        return f"{none}: the image is blurred, its sharpest edge by {blur_px:.0f} px"
    seen = any_grid(grey)
    if seen is not None:
        return f"{none}: {_instead(*seen, corners, grey.shape)}"
    if search(np.asarray(255 - grey, dtype=np.uint8), corners) is not None:
        return f"{none}: it is there in the negative, white for black; its outer squares need a white margin"
    larger = cv2.resize(grey, None, fx=3, fy=3, interpolation=cv2.INTER_CUBIC) if max(grey.shape) < 1500 else None
    rough = search(np.asarray(larger, dtype=np.uint8), corners) if larger is not None else None
    if rough is not None:
        return f"{none}: it is too small, its corners are {spacing_px(rough) / 3:.1f} px apart; come closer"
    return f"{none}: it may be cut off, too small or hidden in part"


def edge_blur(grey: Labels) -> float:
    """Blur (one sigma, px) of the steepest edges of an image."""
    import cv2

    smooth = cv2.GaussianBlur(grey, (0, 0), 0.7).astype(np.float32)
    slope = np.hypot(cv2.Sobel(smooth, cv2.CV_32F, 1, 0, ksize=3), cv2.Sobel(smooth, cv2.CV_32F, 0, 1, ksize=3)) / 8
    return float(contrast(grey) / max(np.percentile(slope, 99.8), 1e-9) / np.sqrt(2 * np.pi))


def _instead(count: tuple[int, int], grid: Array, corners: tuple[int, int], shape: tuple[int, ...]) -> str:
    """What a grid is, if it is not the board."""
    long, short = sorted(corners)[::-1]
    size = f"a grid of {count[0]}x{count[1]} inner corners"
    spacing = spacing_px(grid)
    if spacing < FINE_PX:
        return f"it is too small: {size} is there, {spacing:.1f} px apart; come closer"
    if count == (long, short):
        return f"{size} is there, but its corners are not clear enough"
    sides = _sides(grid, shape)
    if count[0] <= long and count[1] <= short and sides:
        return f"it is cut off at the {' and the '.join(sides)}: {size} is in the image"
    if count[0] <= long and count[1] <= short:
        return f"it is hidden in part, or another board: {size} is in the image"
    return f"another board: {size} is in the image"


def _sides(grid: Array, shape: tuple[int, ...]) -> list[str]:
    """The image's edges that a grid runs into."""
    margin = EDGE_SQUARES * spacing_px(grid)
    low, high = grid.reshape(-1, 2).min(axis=0), grid.reshape(-1, 2).max(axis=0)
    near = {"left": low[0] < margin, "top": low[1] < margin, "right": high[0] > shape[1] - margin, "bottom": high[1] > shape[0] - margin}
    return [f"{side} edge" for side, is_near in near.items() if is_near]
