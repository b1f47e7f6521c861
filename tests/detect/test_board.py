"""The board's corners against where they are, in pictures made by casting rays."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from board_pictures import Pattern, Studio, exposed, poses
from lpcal.detect.board import count_corners, find_board
from lpcal.detect.board_grid import extended, first_square_is_black
from lpcal.detect.board_links import grown
from lpcal.records.observations import Board

STUDIO = Studio()
VIEWS = 4


@pytest.fixture(scope="module")
def rays() -> np.ndarray:
    return STUDIO.rays()


def turned(angle_deg: float, pattern: Pattern, distance: float = 0.45) -> np.ndarray:
    H_CB = np.eye(4)
    H_CB[:3, :3] = cv2.Rodrigues(np.array([0.25, 0.1, 0]))[0] @ cv2.Rodrigues(np.array([0, 0, np.radians(angle_deg)]))[0]
    H_CB[:3, 3] = [0.01, 0.0, distance] - H_CB[:3, :3] @ pattern.points().mean(axis=0)
    return H_CB


@pytest.mark.parametrize(("blur", "noise", "limit"), [(0.0, 2, 0.04), (0.7, 2, 0.03), (1.5, 4, 0.045), (2.5, 4, 0.07)])
def test_corners_are_where_they_are(rays: np.ndarray, blur: float, noise: float, limit: float) -> None:
    pattern, errors = Pattern(), []
    board = Board(pattern.corners, pattern.square_m)
    for k, H_CB in enumerate(poses(VIEWS, 3)):
        view = find_board(exposed(STUDIO.picture(H_CB, pattern, blur=blur, rays=rays), k, noise=noise), board)
        assert view.corners_px is not None, view.why
        errors.append(view.corners_px - STUDIO.project(H_CB, pattern.points()))
    assert np.sqrt(np.mean(np.square(errors))) < limit
    assert np.abs(np.mean(errors, axis=(0, 1))).max() < 0.01


def test_white_that_spreads_over_black_moves_no_corner(rays: np.ndarray) -> None:
    """A sensor that is not linear parts edges of opposite sense by a third of a pixel here; what is found must not follow the window."""
    pattern, errors = Pattern(), {"edges": [], "opencv": []}
    for k, H_CB in enumerate(poses(VIEWS, 3)):
        light = np.clip(STUDIO.picture(H_CB, pattern, blur=0.8, rays=rays), 0, None)
        image = exposed(np.clip(0.9 * light, 0, 1) ** 0.35, k)
        for fit, found in errors.items():
            view = find_board(image, Board(pattern.corners, pattern.square_m, corner_fit=fit))
            assert view.corners_px is not None, view.why
            found.append(view.corners_px - STUDIO.project(H_CB, pattern.points()))
    edges, opencv = (np.sqrt(np.mean(np.square(found))) for found in errors.values())
    assert edges < 0.035
    assert edges < opencv


@pytest.mark.parametrize("kind", ["16 bit", "float", "dim"])
def test_other_numbers_give_the_same_corners(rays: np.ndarray, kind: str) -> None:
    pattern, H_CB = Pattern(), poses(1, 5)[0]
    light = STUDIO.picture(H_CB, pattern, rays=rays)
    images = {
        "16 bit": exposed(light, 0, bits=16),
        "float": exposed(light, 0).astype(np.float32) / 255,
        "dim": exposed(0.12 * light, 0, noise=0.4),
    }
    view = find_board(images[kind], Board(pattern.corners, pattern.square_m))
    assert view.corners_px is not None, view.why
    assert np.sqrt(np.mean((view.corners_px - STUDIO.project(H_CB, pattern.points())) ** 2)) < 0.09


@pytest.mark.parametrize("corners", [(9, 6), (6, 9), (8, 7)])
@pytest.mark.parametrize("angle_deg", [0, 75, 170, 265])
def test_the_first_corner_is_the_one_whose_outer_square_is_black(rays: np.ndarray, corners: tuple[int, int], angle_deg: float) -> None:
    pattern = Pattern(corners, (0.022, 0.022))
    H_CB = turned(angle_deg, pattern)
    image = exposed(STUDIO.picture(H_CB, pattern, rays=rays), 1)
    view = find_board(image, Board(corners, pattern.square_m))
    assert view.corners_px is not None, view.why
    np.testing.assert_allclose(view.corners_px, STUDIO.project(H_CB, pattern.points()), atol=0.3)
    assert first_square_is_black(image, view.corners_px.reshape(corners[1], corners[0], 2))


@pytest.mark.parametrize("corners", [(9, 7), (6, 4), (7, 7)])
def test_an_ambiguous_board_has_the_same_end_first_in_views_of_one_roll(rays: np.ndarray, corners: tuple[int, int]) -> None:
    pattern = Pattern(corners, (0.022, 0.022))
    for angle_deg in (-40, -10, 20, 40):
        H_CB = turned(angle_deg, pattern)
        view = find_board(exposed(STUDIO.picture(H_CB, pattern, rays=rays), 1), Board(corners, pattern.square_m))
        assert view.corners_px is not None, view.why
        np.testing.assert_allclose(view.corners_px, STUDIO.project(H_CB, pattern.points()), atol=0.3)


@pytest.mark.parametrize("asked", [(8, 6), (9, 5), (7, 4), (8, 5)])
def test_a_part_of_a_larger_board_is_not_taken_for_the_board(rays: np.ndarray, asked: tuple[int, int]) -> None:
    pattern = Pattern()
    for k, H_CB in enumerate(poses(2, 11)):
        image = exposed(STUDIO.picture(H_CB, pattern, rays=rays), k)
        assert find_board(image, Board(asked, (0.025, 0.025))).corners_px is None


def test_another_count_of_corners_is_told(rays: np.ndarray) -> None:
    pattern = Pattern((7, 5), (0.03, 0.03))
    assert count_corners(exposed(STUDIO.picture(turned(20, pattern), pattern, rays=rays), 0)) == (7, 5)


def test_where_the_grid_ends(rays: np.ndarray) -> None:
    pattern, H_CB = Pattern(), turned(10, Pattern())
    image = exposed(STUDIO.picture(H_CB, pattern, rays=rays), 0)
    grid = STUDIO.project(H_CB, pattern.points()).reshape(6, 9, 2)
    for part in (grid, grid[:, 1:], grid[:, :-2], grid[1:], grid[:-1], grid[1:-1, 2:-1]):
        np.testing.assert_allclose(grown(image, part), grid, atol=2.5)
    holes = grid.copy()
    holes[2, 3:6] = np.nan
    np.testing.assert_allclose(grown(image, holes), grid, atol=2.5)


def test_a_grid_continues_by_its_own_curvature() -> None:
    i, j = np.meshgrid(np.arange(5.0), np.arange(4.0))
    grid = np.stack([10 * i + 0.3 * i * i, 12 * j + 0.1 * j * j + i], axis=-1)
    i, j = np.meshgrid(np.arange(-2.0, 7), np.arange(-2.0, 6))
    np.testing.assert_allclose(extended(grid, 2), np.stack([10 * i + 0.3 * i * i, 12 * j + 0.1 * j * j + i], axis=-1), atol=1e-9)


def test_nothing_is_found_where_nothing_is() -> None:
    noise = np.random.default_rng(0).integers(0, 255, (480, 640)).astype(np.uint8)
    for image in (np.full((480, 640), 90, np.uint8), noise):
        view = find_board(image, Board((9, 6), (0.025, 0.025)))
        assert view.corners_px is None
        assert view.why


def test_a_charuco_board_cut_off_at_the_side() -> None:
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_5X5_100)
    drawn = cv2.aruco.CharucoBoard((8, 6), 0.03, 0.022, dictionary).generateImage((640, 480))
    image = np.pad(drawn, 40, constant_values=255)[:, :560]
    board = Board((7, 5), (0.03, 0.03), kind="charuco", marker_m=0.022, dictionary="DICT_5X5_100")
    view = find_board(image, board)
    assert view.corners_px is not None, view.why
    x, y = np.meshgrid(np.arange(1, 8) * 80 + 39.5, np.arange(1, 6) * 80 + 39.5)
    truth = np.stack([x, y], axis=-1).reshape(-1, 2)
    seen = np.isfinite(view.corners_px[:, 0])
    np.testing.assert_array_equal(seen, truth[:, 0] < 450)  # the last column's marker is cut
    np.testing.assert_allclose(view.corners_px[seen], truth[seen], atol=0.3)


@pytest.mark.parametrize(
    ("name", "pattern", "corners", "least"),
    [
        ("intrinsics/bouguet_ex1", "*.tif", (13, 12), 25),
        ("intrinsics/boofcv_sony", "*.jpg", (6, 4), 13),
        ("intrinsics/boofcv_bumblebee2", "left*.jpg", (6, 4), 11),
    ],
)
def test_real_boards_are_found(data: Callable[[str], Path], name: str, pattern: str, corners: tuple[int, int], least: int) -> None:
    images = sorted(data(name).glob(pattern))
    views = [find_board(cv2.imread(str(path), cv2.IMREAD_GRAYSCALE), Board(corners, (0.03, 0.03))) for path in images]
    assert sum(view.corners_px is not None for view in views) >= least
