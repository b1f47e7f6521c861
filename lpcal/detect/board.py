"""The board's inner corners in an image, to a few hundredths of a pixel, in the board's own order.

Symbols: corner (i, j) of nx along x and ny along y, row j * nx + i of the result; spacing s, the distance of neighbouring corners in
pixels. Two detectors of OpenCV find the grid: the quads of the classic one first (it is faster and finds more on distorted lenses), unless
the squares are small, and the sector-based one (SB) where it fails. Neither is exact, so every corner is refined to the saddle of its
window, whose half side is 0.4 s, and then, unless the board asks for OpenCV's corners, to where two blurred edges fitted to that window
cross (`saddle`).
Source: Forstner & Gulch 1987 (the saddle); Duda & Frese 2018 (SB); the window: measured on rendered boards.

The order: x to y turns clockwise as seen (z of B points away from the camera); of the ends that are left, the one whose outer square is
black; where the pattern does not tell, the one with x most to the right in the image, so that views of one roll agree.
"""

from __future__ import annotations

import numpy as np

from lpcal.detect.board_absent import any_grid, what_is_there
from lpcal.detect.board_charuco import find_charuco, marker_free
from lpcal.detect.board_grid import beyond, in_board_order, spacing_px
from lpcal.detect.saddle import fit_saddles
from lpcal.geometry.arrays import Array, Image, Labels
from lpcal.records.observations import Board, BoardView

DETECTOR_VERSION = 5
"""Part of the key under which detections are kept."""
WINDOW_SHARE = 0.4
"""Half side of the refinement's window in units of the smallest spacing; 0.3 to 0.5 is unbiased."""
NARROW_PX, NARROW_BLURS, LEAST_NARROW_PX = 2.0, 3.0, 5
"""Once the blur is known the window need not be wider than this and so many blurs: the lens bends the edges, the light slopes."""
SAMPLED = 24
"""The blur is first learnt from so many corners."""
COUNTED_PX, COUNT_REACH = 800, range(-3, 4)
"""Another count is looked for in images of this size at most, so many corners more or fewer along each side."""
LARGE_PX = 2000
"""Images of a longer side are searched at half size first."""
FINE_PX = 60
"""Where a board that filled the image would have smaller squares, the classic detector's quads grow together: SB goes first."""
SATURATED = 0.996
"""Of full scale: as bright as an image gets."""
SMALL_SPACING_PX = 5.0
"""Corners closer than this cannot be refined."""


def find_board(image: Image | Labels, board: Board, name: str = "") -> BoardView:
    """Look for the board in a grey image (H, W) of any scale and type.

    Returns
    -------
    The corners (ny*nx, 2) in the order of ``board.points_B()``, NaN where one was not seen; or None and why, in words, and another
    count of corners where that is what the image shows.
    """
    grey = _stretched(image)
    rough = find_charuco(grey, board) if board.kind == "charuco" else _search(grey, board.corners)
    return _verdict(grey, image, rough, board, name) if rough is not None else BoardView(name, None, _absent(grey, board))


def count_corners(image: Image | Labels, near: tuple[int, int] | None = None) -> tuple[int, int] | None:
    """Inner corners along the longer and the shorter side of whatever whole chessboard a grey image (H, W) shows.

    Counts about `near` are tried one by one, and the largest grid that is found is the board; parts of it are found too.
    """
    import cv2

    grey = _stretched(image)
    if near is not None:
        size = min(1.0, COUNTED_PX / max(grey.shape))
        small = grey if size == 1 else np.asarray(cv2.resize(grey, None, fx=size, fy=size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
        sides = {tuple(sorted((near[0] + a, near[1] + b), reverse=True)) for a in COUNT_REACH for b in COUNT_REACH}
        counts = sorted((c for c in sides if c[1] > 2), key=lambda c: -c[0] * c[1])
        found = next(((long, short) for long, short in counts if _classic(small, (long, short)) is not None), None)
        if found is not None:
            return found
    seen = any_grid(grey)
    rough = None if seen is None else _search(grey, seen[0])
    return None if seen is None or rough is None or any(beyond(grey, rough)) else seen[0]


def _absent(grey: Labels, board: Board) -> str:
    """Why there is no board, in words."""
    if board.kind == "charuco":
        return "no board found: fewer than eight of its corners have their markers in sight; see marker and dictionary"
    return what_is_there(grey, board.corners, _search)


def _stretched(image: Image | Labels) -> Labels:
    """8 bit, the darkest and brightest half percent clipped."""
    low, high = np.percentile(image[::2, ::2], [0.5, 99.5])
    if image.dtype == np.uint8 and high - low > 60:
        return image.astype(np.uint8, copy=False)
    return np.clip((image.astype(np.float32) - low) * (255.0 / max(high - low, 1e-9)), 0, 255).astype(np.uint8)


def _search(grey: Labels, corners: tuple[int, int]) -> Array | None:
    """Rough corners (ny, nx, 2) by whichever detector finds them, at whichever size."""
    import cv2

    passes = [(1.0, _classic), (1.0, _sector_based)]
    if np.sqrt(grey.size / np.prod(corners)) < FINE_PX:
        passes.reverse()
    if max(grey.shape) > LARGE_PX:
        passes = [(0.5, _classic), (0.5, _sector_based), *passes]
    elif cv2.checkChessboard(grey, corners):
        passes.append((2.0, _sector_based))
    for size, detector in passes:
        smooth = cv2.INTER_AREA if size < 1 else cv2.INTER_CUBIC
        found = detector(grey if size == 1 else cv2.resize(grey, None, fx=size, fy=size, interpolation=smooth), corners)
        if found is not None:
            return np.asarray((found.reshape(corners[1], corners[0], 2).astype(float) + 0.5) / size - 0.5)
    return None


def _classic(grey: Labels, corners: tuple[int, int]) -> Array | None:
    import cv2

    found, places = cv2.findChessboardCorners(grey, corners, None, cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE)
    return places if found else None


def _sector_based(grey: Labels, corners: tuple[int, int]) -> Array | None:
    import cv2

    found, places = cv2.findChessboardCornersSB(grey, corners, flags=0)
    return places if found else None


def _verdict(grey: Labels, image: Image | Labels, rough: Array, board: Board, name: str) -> BoardView:
    """The refined corners in order, unless the grid goes on beyond them or is too fine."""
    spacing = spacing_px(rough)
    if not spacing >= SMALL_SPACING_PX:
        return BoardView(
            name, None, f"the board is too small in the image: its corners are {spacing:.1f} px apart, {SMALL_SPACING_PX:.0f} are needed"
        )
    share = WINDOW_SHARE if board.kind == "chessboard" else marker_free(board)
    light = image.astype(np.float32)
    wide = round(share * spacing)
    start = refine(light, rough, spacing, share)
    blur_px = fit_saddles(light, start, wide, every=max(1, rough[..., 0].size // SAMPLED)).blur_px
    narrow = round(float(np.clip(NARROW_PX + NARROW_BLURS * blur_px, LEAST_NARROW_PX, wide))) if blur_px > 0 else wide
    refined = start
    if board.corner_fit == "edges":
        refined = fit_saddles(light, refine(light, rough, spacing, narrow / spacing) if narrow < wide else start, narrow).corners_px
    glare = _glare(image, refined)
    if board.kind == "charuco":
        return BoardView(name, refined.reshape(-1, 2), blur_px=blur_px, glare=glare)
    if any(beyond(grey, refined)):
        return BoardView(name, None, "the grid found goes on beyond its last corners: part of a larger board, or shifted by a square")
    return BoardView(name, in_board_order(grey, refined).reshape(-1, 2), blur_px=blur_px, glare=glare)


def _glare(image: Image | Labels, grid: Array) -> float:
    """Share of the board's corners' hull that is as bright as the image gets, where that is its scale's end."""
    import cv2

    full = {"uint8": 255.0, "uint16": 65535.0}.get(image.dtype.name, 1.0)
    hull = cv2.convexHull(grid[np.isfinite(grid).all(axis=-1)].astype(np.float32).reshape(-1, 1, 2))
    inside = cv2.fillConvexPoly(np.zeros(image.shape, np.uint8), np.rint(hull).astype(np.int32), 1) > 0
    return float(np.mean(image[inside] >= SATURATED * full)) if inside.any() else 0.0


def refine(image: Image | Labels, rough: Array, spacing: float, share: float = WINDOW_SHARE) -> Array:
    """Corners (..., 2) moved to the saddle of their window; NaN where that leads away by more than a third of the spacing."""
    import cv2

    half = max(2, round(share * spacing))
    seen = np.isfinite(rough).all(axis=-1)
    start = np.ascontiguousarray(rough[seen], dtype=np.float32).reshape(-1, 1, 2)
    criteria = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 60, 1e-4)
    places = cv2.cornerSubPix(np.ascontiguousarray(image), start.copy(), (half, half), (-1, -1), criteria).astype(float)
    strayed = np.linalg.norm(places - start, axis=-1) > spacing / 3
    places[strayed] = np.nan
    refined = np.full(rough.shape, np.nan)
    refined[seen] = places.reshape(-1, 2)
    return refined
