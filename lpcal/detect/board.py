"""The board's inner corners in an image, to a few hundredths of a pixel, in the board's own order.

Symbols: corner (i, j) of nx along x and ny along y, row j * nx + i of the result; spacing s, the distance of neighbouring corners in
pixels. The grid is grown from the image's saddle points (`board_links`), whatever its count; where that shows most of the board but not
all of it, OpenCV's two detectors are tried. None is exact, so every corner is refined to the saddle of its
window, whose half side is 0.4 s, and then, unless the board asks for OpenCV's corners, to where two blurred edges fitted to that window
cross (`saddle`).
Source: Forstner & Gulch 1987 (the saddle); Duda & Frese 2018 (SB); the window: measured on rendered boards.

The order: x to y turns clockwise as seen (z of B points away from the camera); of the ends that are left, the one whose outer square is
black; where the pattern does not show it, the one with x most to the right in the image, so that views of one roll agree.

Why no board was found in an image, and what is there instead, in words.

Looked for in turn: light that differs by more than its noise (`noise`), edges that are sharp somewhere, any grid of corners (its count,
whether light too bright hides part of it, whether it runs into the image's edge). Symbols: blur s of an edge of contrast c whose steepest
step is g: ``s = c / (g sqrt(2 pi))``.

Charuco boards: chessboard corners named by the markers between them, so that part of a board is enough.

Corner numbers run along x first, from the corner of the board's first marker, as in `Board.points_B`. Source: OpenCV, aruco module.

The board at a glance: OpenCV's classic detector with its fast check, a few milliseconds, corners to a pixel.
"""

from __future__ import annotations

import time

import numpy as np

from lpcal.detect.board_grid import contrast, extended, in_board_order, spacing_px
from lpcal.detect.board_links import grown, seen_grid, without_holes
from lpcal.detect.board_patterns import find_aprilgrid, find_circles
from lpcal.detect.noise import hardly_any_contrast
from lpcal.detect.saddle import BLUR_PX, fit_saddles
from lpcal.errors import InputError
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.records.observations import Board, BoardView

DETECTOR_VERSION = 8
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
"""Share of full scale from which a pixel is taken as saturated."""
SMALL_SPACING_PX = 5.0
"""Corners closer than this cannot be refined."""


OTHERS = {"circles": find_circles, "aprilgrid": find_aprilgrid}
"""Detectors of patterns without squares, by the board's kind."""
WHY_NONE = {
    "circles": "no grid of dark circles of this count, all of them in sight",
    "aprilgrid": "fewer than four of its tags are in sight; see corners (two a tag), marker and dictionary",
}
"""What is said where they find nothing."""


def find_board(image: Image | Labels, board: Board, name: str = "") -> BoardView:
    """Look for the board in a grey image (H, W) of any scale and type.

    Returns
    -------
    The corners (ny*nx, 2) in the order of ``board.points_B()``, NaN where one was not seen; or None and why, in words, and another
    count of corners where that is what the image shows.
    """
    if (flat := hardly_any_contrast(image)) is not None:
        return BoardView(name, None, f"no board found: {flat}")
    grey = stretched(image)
    if board.kind == "charuco":
        rough = find_charuco(grey, board)
        why = "fewer than eight of its corners have their markers in sight; see marker and dictionary"
        return judged(grey, image, rough, board, name) if rough is not None else BoardView(name, None, f"no board found: {why}")
    if board.kind in OTHERS:
        rough, why = OTHERS[board.kind](grey, board), WHY_NONE[board.kind]
        return BoardView(name, None, f"no board found: {why}") if rough is None else judged(grey, image, rough, board, name)
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
    return judged(grey, image, rough, board, name)


def count_corners(image: Image | Labels) -> tuple[int, int] | None:
    """Inner corners along the longer and the shorter side of whatever whole chessboard a grey image (H, W) shows; None: none."""
    if hardly_any_contrast(image) is not None:
        return None
    grid = seen_grid(stretched(image))
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


def stretched(image: Image | Labels) -> Labels:
    """8 bit, the darkest and brightest half percent clipped."""
    low, high = np.percentile(image[::4, ::4], [0.5, 99.5])
    if image.dtype == np.uint8 and high - low > 60:
        return image.astype(np.uint8, copy=False)
    light = image.astype(np.float32)
    light -= np.float32(low)
    light *= np.float32(255.0 / max(high - low, 1e-9))
    return np.clip(light, 0, 255, out=light).astype(np.uint8)


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


def judged(grey: Labels, image: Image | Labels, rough: Array, board: Board, name: str) -> BoardView:
    """The corners of a rough grid (ny, nx, 2) refined and in order, unless the grid is too fine."""
    spacing = spacing_px(rough)
    if not spacing >= SMALL_SPACING_PX:
        return BoardView(
            name, None, f"the board is too small in the image: its corners are {spacing:.1f} px apart, {SMALL_SPACING_PX:.0f} are needed"
        )
    if board.kind == "circles":
        return BoardView(name, rough.reshape(-1, 2), glare=_glare(image, rough))
    share = marker_free(board) if board.kind == "charuco" else WINDOW_SHARE
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
    if board.kind != "chessboard":
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


BLURRED_PX = 3.0
"""A picture whose steepest edge has more blur than this is blurred."""
FINE_PX = 8.0
"""Corners closer than this are seen in part only."""
RIM_SQUARES, MOSTLY = 0.3, 0.4
"""A corner cannot be seen nearer to the image's edge than so many squares; a grid is cut off where more than this share of its next line
cannot be seen, since a line of it is known by the rest."""
GLARE_SQUARES = 1.8
"""Area, in squares, of a saturated spot within the grid that is no white square."""


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


FEWEST_CORNERS = 8


def find_charuco(grey: Labels, board: Board) -> Array | None:
    """Rough corners (ny, nx, 2) of a charuco board in a grey image (H, W) of 8 bit, NaN where not seen; None: too few.

    Raises
    ------
    InputError
        The board has no marker size, or a dictionary that OpenCV does not know.
    """
    import cv2

    columns, rows = board.corners
    dictionary = getattr(cv2.aruco, board.dictionary, None)
    if not np.isfinite(board.marker_m) or not isinstance(dictionary, int):
        raise InputError(
            f"a charuco board with marker {board.marker_m} m and dictionary {board.dictionary!r}",
            where="board",
            needed="marker: 18 mm and dictionary: DICT_5X5_100, or another of OpenCV's",
        )
    pattern = cv2.aruco.CharucoBoard(
        (columns + 1, rows + 1), board.square_m[0], board.marker_m, cv2.aruco.getPredefinedDictionary(dictionary)
    )
    for legacy in (False, True):
        pattern.setLegacyPattern(legacy)
        places, names, _, _ = cv2.aruco.CharucoDetector(pattern).detectBoard(grey)
        if names is not None and len(names) >= FEWEST_CORNERS:
            grid = np.full((rows * columns, 2), np.nan)
            grid[names.ravel()] = places.reshape(-1, 2)
            return grid.reshape(rows, columns, 2)
    return None


def marker_free(board: Board) -> float:
    """Half side of the largest window about a corner that no marker reaches into, in units of the spacing."""
    return 0.45 * (1 - board.marker_m / board.square_m[0])


def glance(grey: Image, board: Board) -> Array | None:
    """Corners (N, 2) of a chessboard in an image (H, W) of 0..1; None where it is not seen at once, or is of another kind."""
    import cv2

    if board.kind != "chessboard":
        return None
    top = float(np.quantile(grey, 0.999))
    stored = np.rint(255 * np.clip(grey / max(top, 1e-6), 0, 1)).astype(np.uint8)
    flags = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE | cv2.CALIB_CB_FAST_CHECK
    found, corners = cv2.findChessboardCorners(stored, board.corners, flags=flags)
    return np.asarray(corners, dtype=float).reshape(-1, 2) if found else None
