"""Views that tell little, wide lenses, stretched images: what is said is of the right thing, and figures mean something."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
import pytest

from board_pictures import LENS, K, Pattern, Studio, poses
from lpcal.chain.k_camera import solve_camera
from lpcal.errors import DegenerateError
from lpcal.records.digits import fine
from lpcal.records.observations import Board, BoardView, BoardViews

BOARD = Board((9, 6), (0.025, 0.025))
PATTERN = Pattern()


def placed(tilt_deg: tuple[float, float], spot: tuple[float, float], distance: float, roll_deg: float = 0.0) -> np.ndarray:
    R = cv2.Rodrigues(np.radians([*tilt_deg, 0.0]))[0] @ cv2.Rodrigues(np.radians([0.0, 0.0, roll_deg]))[0]
    H_CB = np.eye(4)
    H_CB[:3, :3], H_CB[:3, 3] = R, np.array([*spot, 1.0]) * distance - R @ PATTERN.points().mean(axis=0)
    return H_CB


def views(places: list[np.ndarray], studio: Studio, *, sigma_px: float = 0.05, stretch: float = 1.0) -> BoardViews:
    rng = np.random.default_rng(1)
    found = []
    for k, H_CB in enumerate(places):
        px = studio.project(H_CB, PATTERN.points()) * [stretch, 1.0]
        found.append(BoardView(f"{k}.png", px + sigma_px * rng.standard_normal(px.shape)))
    return BoardViews((round(stretch * studio.size[0]), studio.size[1]), tuple(found))


def monotonous(kind: str) -> list[np.ndarray]:
    rng = np.random.default_rng(4)
    spots = rng.uniform([-0.25, -0.18], [0.25, 0.18], (12, 2))
    if kind == "facing":
        return [placed(tuple(rng.uniform(-1, 1, 2)), tuple(spot), rng.uniform(0.4, 0.7), rng.uniform(-40, 40)) for spot in spots]
    if kind == "one plane":
        return [placed((25.0, -10.0), tuple(spot), rng.uniform(0.4, 0.7)) for spot in spots]
    if kind == "one pose":
        return [placed((25.0, -10.0), (0.01, 0.02), 0.45) for _ in spots]
    return [placed((25.0, -10.0) if k % 2 else (-20.0, 15.0), tuple(spot), 0.5) for k, spot in enumerate(spots)]


@pytest.mark.parametrize(
    ("kind", "words", "model"),
    [
        ("facing", "deg of one plane: tilt the board", "opencv5"),
        ("one plane", "deg of one plane", "opencv5"),
        ("one pose", "in one pose", "opencv5"),
        ("two tilts", "2 tilts only", "auto"),
        ("two tilts", "2 tilts only", "opencv5"),
        pytest.param("facing", "deg of one plane: tilt the board", "auto", marks=pytest.mark.slow),
        pytest.param("one pose", "in one pose", "auto", marks=pytest.mark.slow),
        pytest.param("one plane", "deg of one plane", "auto", marks=pytest.mark.slow),
    ],
)
def test_views_that_are_alike_blame_themselves(kind: str, words: str, model: str) -> None:
    try:
        said = " ".join(solve_camera(views(monotonous(kind), Studio()), BOARD, model=model).warnings)
    except DegenerateError as error:
        said = str(error)
    assert words in said
    assert "stiff" not in said


def test_a_board_always_in_one_corner_is_said() -> None:
    rng = np.random.default_rng(2)
    places = [placed(tuple(rng.uniform(-35, 35, 2)), tuple(rng.uniform(-0.36, -0.33, 2)), 1.1, rng.uniform(-40, 40)) for _ in range(12)]
    try:
        said = " ".join(solve_camera(views(places, Studio()), BOARD).warnings)
    except DegenerateError as error:
        said = str(error)
    assert "always at the top left" in said


@pytest.mark.parametrize("seed", [3, 17, 29])
def test_views_that_differ_are_not_blamed(seed: int) -> None:
    solution = solve_camera(views(list(poses(10, seed)), Studio()), BOARD)
    assert not any("tilt" in word or "pose" in word for word in solution.warnings)
    assert not any("fx" in word for word in solution.warnings)


@pytest.mark.parametrize("stretch", [1.18, 0.85, 1.05])
def test_focal_lengths_that_differ_are_said(stretch: float) -> None:
    said = solve_camera(views(list(poses(12, 17)), Studio(), stretch=stretch), BOARD).warnings
    words = [word for word in said if "pixels that are not square are rare" in word]
    assert len(words) == 1
    said_percent = float(words[0].split("differ by ")[1].split(" %")[0])
    assert abs(said_percent - 100 * (max(stretch, 1 / stretch) - 1)) < 0.6
    assert ("along x" if stretch > 1 else "along y") in words[0]


@pytest.mark.parametrize(
    ("lens", "focal", "count"),
    [((-0.32, 0.13, 0, 0, -0.024), 300, 12), ((-0.3, 0.1, 0, 0, -0.013), 340, 5), ((-0.25, 0.06, 0, 0, -0.006), 260, 20)],
)
def test_what_is_said_of_a_wide_lens_means_something(lens: tuple[float, ...], focal: float, count: int) -> None:
    """What OpenCV's adjustment is apart and what the sigma says are small where corners are; nothing is trusted elsewhere."""
    K_wide = np.array([[focal, 0, 320.0], [0, focal, 240.0], [0, 0, 1]])
    studio = Studio(K=K_wide, lens=np.array(lens))
    rng = np.random.default_rng(8)
    places = []
    while len(places) < count:
        H_CB = placed(
            tuple(rng.uniform(-35, 35, 2)), tuple(rng.uniform([-0.5, -0.4], [0.5, 0.4])), rng.uniform(0.2, 0.35), rng.uniform(-60, 60)
        )
        px = studio.project(H_CB, PATTERN.points())
        if np.all(px > 5) and np.all(px < np.array(studio.size) - 6):
            places.append(H_CB)
    solution = solve_camera(views(places, studio), BOARD)
    sure, check = solution.evidence.projection_uncertainty, solution.evidence.independent_check
    assert sure.rms_px <= sure.most_px < 5
    assert check.difference_worst_px < 5
    assert sure.trusted_share <= sure.covered_share < 1
    assert not np.any(np.array(sure.trusted) & ~np.array(sure.covered))


@pytest.mark.parametrize(("size", "words"), [(0.0004, "0.00040"), (0.031, "0.031"), (1.5, "1.50"), (2e-9, "2.0e-09"), (0.0, "0.00")])
def test_no_sigma_is_written_as_nought(size: float, words: str) -> None:
    assert fine(size) == words


def test_the_lens_of_the_studio_is_a_usual_one() -> None:
    solution = solve_camera(views(list(poses(16, 17)), Studio()), BOARD, model="opencv5")
    np.testing.assert_allclose(solution.camera.K[0, 0], K[0, 0], atol=2)
    np.testing.assert_allclose(solution.camera.distortion[:2], LENS[:2], atol=0.03)


@pytest.mark.parametrize(
    ("bow_m", "seeds"),
    [
        (0.0, [0, 4]),
        (2.5e-4, [0, 1, 4]),
        *(pytest.param(*one, marks=pytest.mark.slow) for one in ((0.0, [1, 2, 3]), (2.5e-4, [2, 3]), (1e-4, range(5)), (5e-4, range(5)))),
    ],
)
def test_five_cameras_agree_on_one_board(bow_m: float, seeds: Sequence[int]) -> None:
    """Focal length and bow agree with the truth within three sigmas, whatever the views; a flat board is flat within them."""
    pattern = Pattern(bow_m=(bow_m, 0.6 * bow_m))
    for seed in seeds:
        rng = np.random.default_rng(100 + seed)
        found = [
            BoardView(f"{k}.png", Studio().project(H_CB, pattern.points()) + 0.05 * rng.standard_normal((54, 2)))
            for k, H_CB in enumerate(poses(7 if seed == 4 else 14, 40 + seed))
        ]
        solution = solve_camera(BoardViews(Studio().size, tuple(found)), BOARD)
        assert solution.camera.covariance is not None
        sigma = np.sqrt(np.diag(solution.camera.covariance))
        assert abs(solution.camera.K[0, 0] - K[0, 0]) < 3 * sigma[0]
        shape = solution.evidence.board_shape
        for term, truth in zip(("bow_x_m", "bow_y_m"), pattern.bow_m, strict=True):
            assert abs(shape[term].value - truth) < 3 * shape[term].std < 1e-4
