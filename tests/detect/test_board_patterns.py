"""Circle grids and AprilGrids: drawn, seen aslant, found in the board's own order."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from lpcal.detect.board import find_board
from lpcal.errors import InputError
from lpcal.records.observations import Board

PX_PER_MM = 5.0
ASLANT = np.array([[0.9, 0.12, 60.0], [-0.08, 0.85, 90.0], [1.2e-4, -0.8e-4, 1.0]])
CIRCLES = Board((9, 6), (0.012, 0.012), kind="circles")
GRID = Board((8, 6), (0.026, 0.026), kind="aprilgrid", marker_m=0.02, dictionary="DICT_APRILTAG_36h11")
MARGIN_MM = 15.0


def place_px(points_B: np.ndarray) -> np.ndarray:
    """Where points of the board lie in its own drawing."""
    return (1e3 * points_B[:, :2] + MARGIN_MM) * PX_PER_MM - 0.5


def seen(drawing: np.ndarray, board: Board, size: tuple[int, int] = (900, 800)) -> tuple[np.ndarray, np.ndarray]:
    """The drawing as a camera sees it, and where the board's corners are then."""
    picture = cv2.warpPerspective(cv2.GaussianBlur(drawing, (0, 0), 1.0), ASLANT, size, borderValue=235, flags=cv2.INTER_AREA)
    truth = cv2.perspectiveTransform(place_px(board.points_B())[None].astype(np.float64), ASLANT)[0]
    return cv2.GaussianBlur(picture, (0, 0), 0.6), truth


def drawn_circles() -> np.ndarray:
    """Dark dots on white."""
    drawing = np.full((700, 800), 235, np.uint8)
    for x, y in place_px(CIRCLES.points_B()):
        cv2.circle(drawing, (round(16 * x), round(16 * y)), round(16 * 3 * PX_PER_MM), 20, -1, cv2.LINE_AA, shift=4)
    return drawn_blank(drawing)


def drawn_blank(drawing: np.ndarray) -> np.ndarray:
    """A drawing with a little noise, as of paper."""
    return np.clip(drawing + np.random.default_rng(0).normal(0, 2, drawing.shape), 0, 255).astype(np.uint8)


def drawn_grid(bits: int, *, from_below: bool) -> np.ndarray:
    """Tags numbered from the lower row, as Kalibr prints them, with black squares where their corners meet."""
    drawing = np.full((700, 800), 235, np.uint8)
    tags = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    side, pitch, gap = round(20 * PX_PER_MM), round(26 * PX_PER_MM), round(6 * PX_PER_MM)
    start = round(MARGIN_MM * PX_PER_MM)
    for row in range(3):
        for column in range(4):
            name = (2 - row if from_below else row) * 4 + column
            y, x = start + row * pitch, start + column * pitch
            drawing[y : y + side, x : x + side] = cv2.aruco.generateImageMarker(tags, name, side, borderBits=bits)
    for row in range(4):
        for column in range(5):
            y, x = start + row * pitch - gap, start + column * pitch - gap
            drawing[y : y + gap, x : x + gap] = 0
    return drawn_blank(drawing)


def test_a_grid_of_circles_is_found_in_order() -> None:
    picture, truth = seen(drawn_circles(), CIRCLES)
    found = find_board(picture, CIRCLES)
    assert found.corners_px is not None, found.why
    away = np.linalg.norm(found.corners_px - truth, axis=1)
    assert away.max() < 0.6
    turned = find_board(np.ascontiguousarray(np.rot90(picture, 2)), CIRCLES)
    assert turned.corners_px is not None
    assert turned.corners_px[0, 0] < turned.corners_px[8, 0]
    nothing = find_board(drawn_grid(2, from_below=True), CIRCLES)
    assert nothing.corners_px is None
    assert "circles" in str(nothing.why)


@pytest.mark.parametrize(("bits", "from_below"), [(2, True), (1, False)])
def test_an_aprilgrid_is_found_in_order(bits: int, from_below: bool) -> None:
    picture, truth = seen(drawn_grid(bits, from_below=from_below), GRID)
    found = find_board(picture, GRID)
    assert found.corners_px is not None, found.why
    away = np.linalg.norm(found.corners_px - truth, axis=1)
    assert np.isfinite(away).mean() > 0.9
    assert np.nanmedian(away) < 0.15
    assert np.nanmax(away) < 0.6
    turned = find_board(np.ascontiguousarray(np.rot90(picture, 1)), GRID)
    assert turned.corners_px is not None
    back = np.stack([picture.shape[1] - 1 - turned.corners_px[:, 1], turned.corners_px[:, 0]], axis=1)
    assert np.nanmedian(np.linalg.norm(back - found.corners_px, axis=1)) < 0.1


def test_part_of_an_aprilgrid_is_enough() -> None:
    picture, truth = seen(drawn_grid(2, from_below=True), GRID)
    picture = picture.copy()
    picture[:, : int(truth[:, 0].mean())] = 128
    found = find_board(picture, GRID)
    assert found.corners_px is not None, found.why
    known = np.isfinite(found.corners_px).all(axis=1)
    assert 8 <= known.sum() < len(truth)
    assert np.linalg.norm(found.corners_px[known] - truth[known], axis=1).max() < 0.6


def test_an_aprilgrid_of_odd_corners_is_refused() -> None:
    with pytest.raises(InputError, match="AprilGrid"):
        find_board(
            drawn_grid(2, from_below=True), Board((7, 6), (0.026, 0.026), kind="aprilgrid", marker_m=0.02, dictionary="DICT_APRILTAG_36h11")
        )
