"""The board's inner corners in an image, to a few hundredths of a pixel, in the board's own order.

Symbols: corner (i, j) of nx along x and ny along y, row j * nx + i of the result; spacing s, the distance of neighbouring corners in
pixels. The grid is grown from the image's saddle points (`board_links`), whatever its count; where that shows most of the board but not
all of it, OpenCV's two detectors are tried. None is exact, so every corner is refined to the saddle of its
window, whose half side is 0.4 s, and then, unless the board asks for OpenCV's corners, to where two blurred edges fitted to that window
cross (`saddle`).
Source: Forstner & Gulch 1987 (the saddle); Duda & Frese 2018 (SB); the window: measured on rendered boards.

The order: x to y turns clockwise as seen (z of B points away from the camera); of the ends that are left, the one whose outer square is
black; where the pattern does not tell, the one with x most to the right in the image, so that views of one roll agree.
"""

from __future__ import annotations

import time

import numpy as np

from lpcal.detect.board_absent import cut_sides, edge_blur, hardly_any_contrast, what_is_there
from lpcal.detect.board_charuco import find_charuco, marker_free
from lpcal.detect.board_grid import in_board_order, spacing_px
from lpcal.detect.board_links import grown, seen_grid
from lpcal.detect.saddle import BLUR_PX, fit_saddles
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.records.observations import Board, BoardView

DETECTOR_VERSION = 7
"""Part of the key under which detections are kept."""
WINDOW_SHARE = 0.4
"""Half side of the refinement's window in units of the smallest spacing; 0.3 to 0.5 is unbiased."""
NARROW_PX, NARROW_BLURS, LEAST_NARROW_PX = 2.0, 3.0, 5
"""Once the blur is known the window need not be wider than this and so many blurs: the lens bends the edges, the light slopes."""
SAMPLED = 24
"""The blur is first learnt from so many corners."""
SEEN_SHARE = 0.9
"""Share of a grid's corners that must be seen for the grid to be the board: a finger or a speck may hide some."""
WORTH_SEARCHING = 0.5
"""Share of the board's corners that the saddles must show before OpenCV's detectors are tried, which cost seconds on fine texture."""
MOST_BLUR, BLUR_SQUARES = 0.9, 0.25
"""A board whose edges are as blurred as the fit goes (this share of it), and by so many squares, has no corners worth their name."""
SEARCH_S = 3.0
"""Processor time, in s an image, after which no further search is begun: on 12 megapixels one of OpenCV's takes about one second."""
LARGE_PX = 2000
"""Images of a longer side are searched at half size first."""
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
    if (flat := hardly_any_contrast(image)) is not None:
        return BoardView(name, None, f"no board found: {flat}")
    grey = _stretched(image)
    if board.kind == "charuco":
        rough = find_charuco(grey, board)
        why = "fewer than eight of its corners have their markers in sight; see marker and dictionary"
        return _verdict(grey, image, rough, board, name) if rough is not None else BoardView(name, None, f"no board found: {why}")
    began = time.thread_time()
    seen = seen_grid(grey, board.corners)
    rough, ended = _as_asked(seen, board.corners), False
    if rough is None and seen is not None and _nearly(seen, board.corners):
        rough, ended = _search(grey, board.corners, began + SEARCH_S, ragged=not np.isfinite(seen).all())
        if rough is not None and (whole := grown(grey, rough)).shape != rough.shape:
            rough, seen = None, whole if whole.shape[1] >= whole.shape[0] else np.swapaxes(whole, 0, 1)
    if rough is None:
        cap = f" (the search was ended after {SEARCH_S:.0f} s)" if ended else ""
        return BoardView(name, None, what_is_there(grey, _saturated(image), board.corners, seen) + cap)
    return _verdict(grey, image, rough, board, name)


def count_corners(image: Image | Labels) -> tuple[int, int] | None:
    """Inner corners along the longer and the shorter side of whatever whole chessboard a grey image (H, W) shows; None: none."""
    if hardly_any_contrast(image) is not None:
        return None
    grid = seen_grid(_stretched(image))
    if grid is None or np.isfinite(grid).mean() < SEEN_SHARE or cut_sides(grid, image.shape):
        return None
    return grid.shape[1], grid.shape[0]


def _as_asked(seen: Array | None, corners: tuple[int, int]) -> Array | None:
    """The grid seen as (ny, nx, 2), where it has the count asked for and hardly a corner is missing."""
    if seen is None or np.isfinite(seen).mean() < SEEN_SHARE or sorted(seen.shape[:2]) != sorted(corners):
        return None
    return seen if seen.shape[:2] == corners[::-1] else np.ascontiguousarray(np.swapaxes(seen, 0, 1))


def _nearly(seen: Array, corners: tuple[int, int]) -> bool:
    """Whether the grid seen may be a part of the board asked for, and most of it."""
    fits = max(seen.shape[:2]) <= max(corners) and min(seen.shape[:2]) <= min(corners)
    return bool(fits and np.isfinite(seen[..., 0]).sum() >= WORTH_SEARCHING * np.prod(corners))


def _stretched(image: Image | Labels) -> Labels:
    """8 bit, the darkest and brightest half percent clipped."""
    low, high = np.percentile(image[::4, ::4], [0.5, 99.5])
    if image.dtype == np.uint8 and high - low > 60:
        return image.astype(np.uint8, copy=False)
    return np.clip((image.astype(np.float32) - low) * (255.0 / max(high - low, 1e-9)), 0, 255).astype(np.uint8)


def _search(grey: Labels, corners: tuple[int, int], until_s: float, *, ragged: bool) -> tuple[Array | None, bool]:
    """Rough corners (ny, nx, 2) by whichever detector of OpenCV's finds them, at whichever size; and whether the time ended the search.

    The classic detector, which takes up to half a minute where there is no such board, is asked only of a grid with corners missing.
    """
    import cv2

    detectors = [_sector_based, _classic] if ragged else [_sector_based]
    passes = [(1.0, detector) for detector in detectors]
    if max(grey.shape) > LARGE_PX:
        passes = [*((0.5, detector) for detector in detectors), *passes]
    elif cv2.checkChessboard(grey, corners):
        passes.append((2.0, _sector_based))
    for size, detector in passes:
        if time.thread_time() > until_s:
            return None, True
        smooth = cv2.INTER_AREA if size < 1 else cv2.INTER_CUBIC
        found = detector(grey if size == 1 else cv2.resize(grey, None, fx=size, fy=size, interpolation=smooth), corners)
        if found is not None:
            return np.asarray((found.reshape(corners[1], corners[0], 2).astype(float) + 0.5) / size - 0.5), False
    return None, False


def _classic(grey: Labels, corners: tuple[int, int]) -> Array | None:
    import cv2

    found, places = cv2.findChessboardCorners(grey, corners, None, cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE)
    return places if found else None


def _sector_based(grey: Labels, corners: tuple[int, int]) -> Array | None:
    import cv2

    found, places = cv2.findChessboardCornersSB(grey, corners, flags=0)
    return places if found else None


def _verdict(grey: Labels, image: Image | Labels, rough: Array, board: Board, name: str) -> BoardView:
    """The refined corners in order, unless the grid is too fine."""
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
    if blur_px > MOST_BLUR * BLUR_PX[1] and (edge_px := edge_blur(grey)) > BLUR_SQUARES * spacing:
        return BoardView(name, None, f"no board found: the image is blurred, its sharpest edge by {edge_px:.0f} px")
    refined = start
    if board.corner_fit == "edges":
        refined = fit_saddles(light, refine(light, rough, spacing, narrow / spacing) if narrow < wide else start, narrow).corners_px
    glare = _glare(image, refined)
    if board.kind == "charuco":
        return BoardView(name, refined.reshape(-1, 2), blur_px=blur_px, glare=glare)
    return BoardView(name, in_board_order(grey, refined).reshape(-1, 2), blur_px=blur_px, glare=glare)


def _glare(image: Image | Labels, grid: Array) -> float:
    """Share of the board's corners' hull that is as bright as the image gets, where that is its scale's end."""
    import cv2

    hull = cv2.convexHull(grid[np.isfinite(grid).all(axis=-1)].astype(np.float32).reshape(-1, 1, 2))
    inside = cv2.fillConvexPoly(np.zeros(image.shape, np.uint8), np.rint(hull).astype(np.int32), 1) > 0
    return float(np.mean(_saturated(image)[inside])) if inside.any() else 0.0


def _saturated(image: Image | Labels) -> Mask:
    """Pixels (H, W) as bright as the image's type gets."""
    return np.asarray(image >= SATURATED * {"uint8": 255.0, "uint16": 65535.0}.get(image.dtype.name, 1.0))


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
