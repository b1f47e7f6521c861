"""A board that no search finds, from its outermost corners as a person marks them."""

from __future__ import annotations

import numpy as np
import pytest

from board_pictures import Pattern, Studio, exposed, poses
from lpcal.detect.board import find_board
from lpcal.detect.board_marked import find_marked
from lpcal.records.observations import Board

STUDIO, PATTERN = Studio(), Pattern()
BOARD = Board(PATTERN.corners, PATTERN.square_m)


@pytest.fixture(scope="module")
def hidden() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A picture in which a hand covers a part of the board, where its corners are, and which of them can be seen."""
    H_CB = poses(2, 3)[0]
    at = STUDIO.project(H_CB, PATTERN.points())
    light = STUDIO.picture(H_CB, PATTERN, blur=0.8)
    centre = at.reshape(6, 9, 2)[2, 3]
    y, x = np.mgrid[: STUDIO.size[1], : STUDIO.size[0]]
    step = np.linalg.norm(np.diff(at.reshape(6, 9, 2), axis=1), axis=-1).mean()
    covered = (x - centre[0]) ** 2 + (y - centre[1]) ** 2 < (1.9 * step) ** 2
    light = np.where(covered, 0.4, light)
    away = np.linalg.norm(at - centre, axis=1)
    return exposed(light, 1, noise=2), at, away > 2.4 * step


@pytest.mark.parametrize("turn", [0, 3, 6])
def test_marks_in_any_turn_and_some_pixels_off_find_what_the_search_does_not(hidden: tuple[np.ndarray, ...], turn: int) -> None:
    image, at, clear = hidden
    assert find_board(image, BOARD).corners_px is None
    marks = at.reshape(6, 9, 2)[[0, 0, -1, -1], [0, -1, -1, 0]] + np.random.default_rng(turn).normal(0, 3, (4, 2))
    marks = np.roll(marks[:: 1 if turn % 2 else -1], turn // 2, axis=0)
    view = find_marked(image, BOARD, marks, "hand.png")
    assert view.image == "hand.png"
    assert view.corners_px is not None, view.why
    apart = np.linalg.norm(view.corners_px - at, axis=1)
    assert np.isfinite(apart[clear]).all()
    assert np.sqrt(np.mean(apart[clear] ** 2)) < 0.08
    assert np.isnan(apart).sum() >= 4, "what the hand covers is not made up"
    assert np.nanmax(apart) < 1.5


def test_marks_beside_the_board_are_refused(hidden: tuple[np.ndarray, ...]) -> None:
    image, at, _ = hidden
    marks = at.reshape(6, 9, 2)[[0, 0, -1, -1], [0, -1, -1, 0]]
    for wrong in (0.4 * marks, marks[[0, 1, 2, 2]] + [[0, 0], [0, 0], [0, 0], [9, 40]], marks + np.array([70, 50])):
        view = find_marked(image, BOARD, np.asarray(wrong, float))
        assert view.corners_px is None
        assert "span no board of 9x6" in (view.why or "")
    blank = find_marked(np.full_like(image, 90), BOARD, marks)
    assert blank.corners_px is None
