"""Frames without the board, and boards at whose rim something is unusual: what is found, what is said, and what it costs."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from board_sheets import BOARDLESS, DARK, LIGHT, bright_noise, cap, carpet, seen, sheet
from lpcal.detect.board import count_corners, find_board, hardly_any_contrast
from lpcal.records.observations import Board

BOARD = Board((9, 6), (0.025, 0.025))


@pytest.mark.parametrize("draw", BOARDLESS)
@pytest.mark.parametrize("corners", [(9, 6), pytest.param((26, 16), marks=pytest.mark.slow)])
def test_a_frame_without_a_board_has_none(draw: Callable[..., np.ndarray], corners: tuple[int, int]) -> None:
    image = np.clip(np.rint(draw(np.random.default_rng(7), 1080, 1920)), 0, 255).astype(np.uint8)
    view = find_board(image, Board(corners, (0.025, 0.025)))
    assert view.corners_px is None
    assert count_corners(image) is None or draw is carpet


def test_a_dark_frame_is_said_to_have_no_contrast() -> None:
    dark = np.rint(cap(np.random.default_rng(3), 480, 640)).astype(np.uint8)
    assert "hardly any contrast (0 to 11 of 255)" in (find_board(dark, BOARD).why or "")
    assert "hardly any contrast" in (find_board(np.full((480, 640), 90, np.uint8), BOARD).why or "")
    assert "hardly any contrast" in (find_board((dark.astype(np.uint16) * 16), BOARD).why or "")
    assert "hardly any contrast (0 to 11 of 255)" in (find_board(dark.astype(np.float32) / 255, BOARD).why or "")
    loud = np.rint(bright_noise(np.random.default_rng(3), 480, 640)).astype(np.uint8)
    assert "nothing but noise" in (find_board(loud, BOARD).why or "")


@pytest.mark.parametrize("share", [0.06, 0.12, 0.5])
def test_a_faint_board_has_contrast_enough(share: float) -> None:
    image = seen(sheet((9, 6)), 3, noise=0).astype(float) * share
    faint = np.rint(np.clip(image + np.random.default_rng(0).normal(0, 0.6, image.shape), 0, 255)).astype(np.uint8)
    assert hardly_any_contrast(faint) is None
    assert find_board(faint, BOARD).corners_px is not None


@pytest.mark.parametrize("outer", [1.0, 0.5, 0.3, 0.1])
@pytest.mark.parametrize(
    ("frame", "surround"),
    [((0.0, LIGHT), LIGHT), ((0.0, LIGHT), DARK), ((0.4, DARK), LIGHT), ((0.5, LIGHT), 90), ((0.2, 5), 120), ((0.06, DARK), LIGHT)],
)
@pytest.mark.parametrize("seeds", [[1, 2], pytest.param([3, 4], marks=pytest.mark.slow)])
def test_the_rim_of_a_board_does_not_matter(outer: float, frame: tuple[float, int], surround: int, seeds: list[int]) -> None:
    paper = sheet((9, 6), outer=outer, frame=frame, surround=surround)
    for seed in seeds:
        view = find_board(seen(paper, seed), BOARD)
        assert view.corners_px is not None, (seed, view.why)
        assert np.isfinite(view.corners_px).mean() > (0.9 if outer < 0.2 else 0.99)


@pytest.mark.parametrize(
    ("there", "asked"), [((10, 7), (9, 6)), ((10, 6), (9, 6)), ((9, 7), (9, 6)), ((14, 9), (9, 6)), ((28, 17), (24, 17))]
)
@pytest.mark.parametrize("outer", [1.0, 0.4])
@pytest.mark.parametrize("seeds", [[1], pytest.param([2, 3], marks=pytest.mark.slow)])
def test_a_larger_board_is_named(there: tuple[int, int], asked: tuple[int, int], outer: float, seeds: list[int]) -> None:
    for seed in seeds:
        image = seen(sheet(there, outer=outer), seed)
        view = find_board(image, Board(asked, (0.025, 0.025)))
        assert view.corners_px is None
        assert f"another board: a grid of {there[0]}x{there[1]} inner corners" in (view.why or "")
        assert count_corners(image) == there


@pytest.mark.parametrize("corners", [(17, 28), (28, 17), (60, 40), (3, 3), (5, 4)])
def test_boards_of_any_count_are_found(corners: tuple[int, int]) -> None:
    size = (2400, 1800) if max(corners) > 30 else (1280, 960)
    view = find_board(seen(sheet(corners), 2, size=size), Board(corners, (0.025, 0.025)))
    assert view.corners_px is not None, view.why
    assert view.corners_px.shape == (corners[0] * corners[1], 2)


@pytest.mark.parametrize("seeds", [[1], pytest.param([2, 3], marks=pytest.mark.slow)])
def test_a_spot_of_glare_is_named(seeds: list[int]) -> None:
    for seed in seeds:
        image = seen(sheet((9, 6)), seed)
        corners = np.asarray(find_board(image, BOARD).corners_px).reshape(6, 9, 2)
        x, y = corners[2:4, 3:6].mean(axis=(0, 1))
        step = np.linalg.norm(corners[2, 4] - corners[2, 3])
        cv2.circle(image, (int(x), int(y)), int(1.4 * step), 255, -1)
        assert "saturated spot (glare)" in (find_board(image, BOARD).why or "")


@pytest.mark.parametrize(("there", "stated"), [((28, 17), (24, 17)), ((10, 7), (9, 6)), ((8, 6), (9, 6)), ((17, 28), (17, 24))])
def test_another_count_is_named(
    there: tuple[int, int], stated: tuple[int, int], tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]
) -> None:
    (tmp_path / "boards").mkdir()
    for seed in range(2 if there[0] == 28 else 5):
        cv2.imwrite(str(tmp_path / f"boards/{seed}.png"), seen(sheet(there), seed, size=(1280, 960)))
    board = f"{{kind: chessboard, corners: [{stated[0]}, {stated[1]}], square: 25 mm}}"
    (tmp_path / "panel.yaml").write_text(f"lpcal: 1\ncamera: {{images: boards/*.png}}\nboard: {board}\n")
    code, _, err = lpcal("intrinsics", cwd=tmp_path)
    assert code == 6
    assert f"found a board of {max(there)}x{min(there)} inner corners" in err
    assert f"you asked for {stated[0]}x{stated[1]}" in err


def test_a_board_that_is_often_cut_off_is_no_other_count(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    (tmp_path / "boards").mkdir()
    for seed in range(3):
        image = seen(sheet((9, 6)), seed)
        corners = np.asarray(find_board(image, BOARD).corners_px)
        cut = int(np.sort(corners[:, 0])[5 + 3 * seed])
        cv2.imwrite(str(tmp_path / f"boards/{seed}.png"), np.pad(image[:, cut:], ((0, 0), (0, cut)), mode="edge"))
    (tmp_path / "panel.yaml").write_text(
        "lpcal: 1\ncamera: {images: boards/*.png}\nboard: {kind: chessboard, corners: [9, 6], square: 25 mm}\n"
    )
    code, _, err = lpcal("intrinsics", cwd=tmp_path)
    assert code == 4
    assert "cut off at the left edge" in err
