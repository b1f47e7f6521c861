"""Why no board was found in an image, and what is there instead, in words.

Looked for in turn: light that differs by more than its noise, edges that are sharp somewhere, any grid of corners (its count, whether
light too bright hides part of it, whether it runs into the image's edge). Symbols: blur s of an edge of contrast c whose steepest step
is g; noise n from the image filtered by L, the difference of two Laplacians::

    s = c / (g sqrt(2 pi))        n = 1.4826 median |L * I| / 6

Source: Immerkaer 1996 (the noise).
"""

from __future__ import annotations

import numpy as np

from lpcal.detect.board_grid import contrast, extended, spacing_px
from lpcal.detect.board_links import without_holes
from lpcal.geometry.arrays import Array, Image, Labels, Mask

LEAST_STEPS, LEAST_NOISES = 6.0, 4.0
"""Smoothed over 3x3 pixels, light must range over so many steps of 255 and over so many sigmas of its noise in some block of the image;
pure noise reaches three sigmas."""
BLOCK_PX, SOME = 16, 99.8
"""Side of a block in px, and the percentile of the blocks' ranges that is looked at: a board may fill little of the image."""
CLEAR_STEPS = 40.0
"""Steps of 255 over which an image ranges that is not called dark or flat."""
BLURRED_PX = 3.0
"""A picture whose steepest edge has more blur than this is blurred."""
FINE_PX = 8.0
"""Corners closer than this are seen in part only."""
RIM_SQUARES, MOSTLY = 0.3, 0.4
"""A corner cannot be seen nearer to the image's edge than so many squares; a grid is cut off where more than this share of its next line
cannot be seen, since a line of it is known by the rest."""
GLARE_SQUARES = 1.8
"""Area, in squares, of a saturated spot within the grid that is no white square."""


def hardly_any_contrast(image: Image | Labels) -> str | None:
    """In words, where a grey image (H, W) of any scale holds nothing but its own noise; None: there is more in it."""
    import cv2

    light = image.astype(np.float32)
    scale = {"uint8": 1.0, "uint16": 255 / 65535}.get(image.dtype.name, 255.0 if light.max() <= 1 else None)
    mask = np.array([[1, -2, 1], [-2, 4, -2], [1, -2, 1]], np.float32)
    noise = 1.4826 * float(np.median(np.abs(cv2.filter2D(light, -1, mask)[::4, ::4]))) / 6
    smooth = cv2.blur(light, (3, 3))
    block = np.ones((BLOCK_PX, BLOCK_PX), np.uint8)
    spans = (cv2.dilate(smooth, block) - cv2.erode(smooth, block))[:: BLOCK_PX // 2, :: BLOCK_PX // 2]
    span = float(np.percentile(spans, SOME))
    least = LEAST_STEPS if image.dtype == np.uint8 else 0.0
    if span > max(least, LEAST_NOISES * noise) and span > 0:
        return None
    low, high = np.percentile(light[::4, ::4], [1, 99])
    size = f"{low:.4g} to {high:.4g}" if scale is None else f"{scale * low:.0f} to {scale * high:.0f} of 255"
    if scale is None or scale * (high - low) < CLEAR_STEPS:
        return f"the image has hardly any contrast ({size})"
    return f"the image is nothing but noise ({size})"


def what_is_there(grey: Labels, saturated: Mask, corners: tuple[int, int], seen: Array | None) -> str:
    """Why a board of some inner corners was not found in an image (H, W) of 8 bit that shows some grid (rows, columns, 2), or none."""
    none = "no board found"
    if seen is not None:
        return f"{none}: {_instead(seen, corners, grey.shape, saturated)}"
    blur_px = edge_blur(grey)
    if blur_px > BLURRED_PX:
        return f"{none}: the image is blurred, its sharpest edge by {blur_px:.0f} px"
    return f"{none}: no grid of corners is in the image; it may be out of sight, too small, or hidden in part"


def edge_blur(grey: Labels) -> float:
    """Blur (one sigma, px) of the steepest edges of an image."""
    import cv2

    smooth = cv2.GaussianBlur(grey, (0, 0), 0.7).astype(np.float32)
    slope = np.hypot(cv2.Sobel(smooth, cv2.CV_32F, 1, 0, ksize=3), cv2.Sobel(smooth, cv2.CV_32F, 0, 1, ksize=3)) / 8
    return float(contrast(grey) / max(np.percentile(slope, 99.8), 1e-9) / np.sqrt(2 * np.pi))


def _instead(grid: Array, corners: tuple[int, int], shape: tuple[int, ...], saturated: Mask) -> str:
    """What a grid is, if it is not the board."""
    long, short = sorted(corners)[::-1]
    rows, columns = grid.shape[:2]
    size = f"a grid of {columns}x{rows} inner corners"
    spacing = spacing_px(grid)
    if columns > long or rows > short:
        return f"another board: {size} is in the image"
    if _spot_squares(grid, saturated) > GLARE_SQUARES:
        return f"a saturated spot (glare) lies over it: {size} is in the image"
    if spacing < FINE_PX:
        return f"it is too small: {size} is there, {spacing:.1f} px apart; come closer"
    if (columns, rows) == (long, short):
        missing = int(np.isnan(grid[..., 0]).sum())
        return (
            f"{size} is there, but {missing} of them are not clear enough" if missing else f"{size} is there, but they are not clear enough"
        )
    sides = cut_sides(grid, shape)
    if sides:
        return f"it is cut off at the {' and the '.join(sides)}: {size} is in the image"
    return f"it is hidden in part, or another board: {size} is in the image"


def _spot_squares(grid: Array, saturated: Mask) -> float:
    """Area, in squares, of the largest saturated spot within a grid's outline, what is narrower than half a square left out."""
    import cv2

    whole = without_holes(grid)
    spacing = max(spacing_px(whole), 1.0)
    hull = cv2.convexHull(whole.astype(np.float32).reshape(-1, 1, 2))
    inside = cv2.fillConvexPoly(np.zeros(saturated.shape, np.uint8), np.rint(hull).astype(np.int32), 1)
    kernel = np.ones((max(1, int(spacing / 2)),) * 2, np.uint8)
    opened = cv2.morphologyEx(inside * saturated.astype(np.uint8), cv2.MORPH_OPEN, kernel)
    areas = cv2.connectedComponentsWithStats(opened, connectivity=4)[2][1:, cv2.CC_STAT_AREA]
    squares = float(inside.sum()) / max((grid.shape[0] - 1) * (grid.shape[1] - 1), 1)
    return float(areas.max() / max(squares, 1.0)) if areas.size else 0.0


def cut_sides(grid: Array, shape: tuple[int, ...]) -> list[str]:
    """The image's edges beyond which a grid may go on: its next line would lie outside the image."""
    wide = extended(without_holes(grid), 1)
    low, high = -RIM_SQUARES * spacing_px(wide), np.array(shape[1::-1]) - 1
    outside = {
        "left edge": wide[..., 0] < -low,
        "top edge": wide[..., 1] < -low,
        "right edge": wide[..., 0] > high[0] + low,
        "bottom edge": wide[..., 1] > high[1] + low,
    }
    lines = [np.s_[1:-1, 0], np.s_[1:-1, -1], np.s_[0, 1:-1], np.s_[-1, 1:-1]]
    return [edge for edge, beyond in outside.items() if any(beyond[line].mean() > MOSTLY for line in lines)]
