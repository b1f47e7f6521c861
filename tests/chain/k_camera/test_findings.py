"""How sure the camera is, the board's shape beyond a bow, corners by fitted edges, and what is said where something is off."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest

from board_pictures import LENS, K, Pattern, Studio, exposed, poses
from lpcal.chain.k_camera import patterns, solve_camera
from lpcal.chain.k_camera.assess import assess, information, mean_sigma, ray_slope
from lpcal.chain.k_camera.bundle import refit
from lpcal.chain.k_camera.findings import blurred_or_glaring, findings
from lpcal.chain.k_camera.next_view import TILTS, _information_of, _pose, advise
from lpcal.chain.k_camera.problem import CameraFit, CornerProblem
from lpcal.chain.k_camera.shape import BOARDS, shape_terms
from lpcal.detect.board import find_board, refine
from lpcal.detect.saddle import fit_saddles
from lpcal.geometry import camera as central
from lpcal.geometry import se3
from lpcal.geometry.camera_difference import pixel_grid, projection_difference
from lpcal.records.calibration import Camera
from lpcal.records.observations import Board, BoardView, BoardViews

STUDIO, BOARD = Studio(), Board((9, 6), (0.025, 0.025))
TRUTH = np.array([K[0, 0], K[1, 1], K[0, 2], K[1, 2], *LENS])
SIGMA_PX = 0.03


def bent(amount_m: float = 3e-4) -> np.ndarray:
    """Points (54, 3) of a board with a twist, a ripple that no polynomial here has, and a bow."""
    points = Pattern(bow_m=(0.0003, 0.0001)).points()
    u, v = points[:, 0] / 0.2, points[:, 1] / 0.125
    points[:, 2] += amount_m * (0.4 * (2 * u - 1) * (2 * v - 1) + 0.1 * np.sin(2.2 * u + 1.3 * v))
    return points


def raised(points: np.ndarray) -> np.ndarray:
    """Heights over the points' mean plane."""
    level = np.c_[np.ones(len(points)), points[:, :2]]
    return np.asarray(points[:, 2] - level @ np.linalg.lstsq(level, points[:, 2], rcond=None)[0])


def problem(points: np.ndarray, seed: int, count: int = 16, sigma_px: float = SIGMA_PX) -> CornerProblem:
    rng = np.random.default_rng(seed)
    places = poses(count, 17)
    corners_px = np.stack([STUDIO.project(H_CB, points) for H_CB in places])
    corners_px += sigma_px * rng.standard_normal(corners_px.shape)
    return CornerProblem(BOARD, STUDIO.size, corners_px, Camera(STUDIO.size, "opencv5", K, LENS), places)


def views_of(one: CornerProblem) -> BoardViews:
    return BoardViews(one.image_size, tuple(BoardView(f"{k}.png", px) for k, px in enumerate(one.corners_px)))


def error_of(fit: CameraFit) -> np.ndarray:
    camera = fit.camera
    return np.array([camera.K[0, 0], camera.K[1, 1], camera.K[0, 2], camera.K[1, 2], *camera.distortion]) - TRUTH


def nees(fit: CameraFit) -> float:
    assert fit.camera.covariance is not None
    return float(error_of(fit) @ np.linalg.solve(fit.camera.covariance, error_of(fit)))


@pytest.fixture(scope="module")
def bent_fits() -> dict[str, list[CameraFit]]:
    return {board: [refit(problem(bent(), seed), "opencv5", board) for seed in range(30)] for board in ("bowed", "shaped")}


def test_a_twisted_board_costs_nothing_once_its_shape_is_free(bent_fits: dict[str, list[CameraFit]]) -> None:
    """The mean of 30 NEES of nine numbers has a standard deviation of sqrt(18 / 30)."""
    assert abs(np.mean([nees(fit) for fit in bent_fits["shaped"]]) - 9) < 4 * np.sqrt(18 / 30)
    assert np.mean([nees(fit) for fit in bent_fits["bowed"]]) > 15
    found = bent_fits["shaped"][0]
    np.testing.assert_allclose(found.points_B[:, 2].mean(), 0, atol=1e-12)
    np.testing.assert_allclose(found.points_B[:, 2], raised(bent()), atol=1.5e-5)


def test_an_unevenly_printed_board_is_told_by_freeing_its_corners() -> None:
    """COLMAP's adjustment finds where the corners are, and by how much the camera is off for it; on an even board it agrees."""
    pytest.importorskip("pycolmap")
    even = problem(Pattern().points(), 3, count=24)
    uneven_m = Pattern().points() + 2e-4 * np.random.default_rng(5).standard_normal((54, 3))
    for one, off_m in ((even, 0.0), (problem(uneven_m, 3, count=24), 2e-4)):
        solution = solve_camera(views_of(one), BOARD, model="opencv4")
        found = solution.evidence.free_board_check
        assert abs(found.board_off_rms_m - off_m) < 5e-5
        assert any("mm rms from where its shape says" in word for word in solution.warnings) == (off_m > 0)
        assert found.difference_rms_px < 0.05 if off_m == 0 else found.difference_rms_px > 0.05


def test_the_shape_is_chosen_where_there_is_one_and_said() -> None:
    solution = solve_camera(views_of(problem(bent(1e-3), 3)), BOARD, model="opencv5")
    assert solution.evidence.chosen.board in BOARDS[2:]
    np.testing.assert_allclose(solution.points_B[:, 2], raised(bent(1e-3)), atol=4e-5)
    plain = solve_camera(views_of(problem(Pattern().points(), 3)), BOARD, model="opencv5")
    assert plain.evidence.chosen.board in BOARDS[:2]
    assert np.abs(plain.points_B[:, 2]).max() < 3e-5


def test_unequal_sides_are_found() -> None:
    points = Pattern().points() * [1.002, 0.998, 1.0]
    views = views_of(problem(points, 5, count=24, sigma_px=0.02))
    solution = solve_camera(views, BOARD, model="opencv4")
    assert solution.evidence.chosen.board == "stretched"
    assert abs(solution.evidence.board_shape["stretch"].value - 0.004) < 4e-4
    assert abs(solution.camera.K[0, 0] / solution.camera.K[1, 1] - K[0, 0] / K[1, 1]) < 5e-4


def test_every_field_leaves_the_boards_plane_alone() -> None:
    for board in BOARDS:
        terms = shape_terms(BOARD, board)
        level = np.c_[np.ones(54), BOARD.points_B()[:, :2]]
        np.testing.assert_allclose(np.einsum("jm,mk->jk", terms.fields[..., 2], level), 0, atol=1e-12)
        assert len(terms.names) == len(terms.prior)


def test_the_uncertainty_that_is_said_is_the_spread_that_is_there(bent_fits: dict[str, list[CameraFit]]) -> None:
    fits = bent_fits["shaped"]
    sure = assess(information(problem(bent(), 0), fits[0]), fits[0])
    assert np.isfinite(sure.worst_px).all()
    pixels = sure.pixels.reshape(-1, 2)
    rays_C = central.unproject(pixels, K, LENS)
    errors = np.stack([projection_difference(pixels, rays_C, fit.camera.project)[0] for fit in fits])
    known = information(problem(bent(), 0), fits[0])
    said = np.trace(
        ray_slope(known, pixels, fits[0]) @ np.asarray(fits[0].camera.covariance) @ np.swapaxes(ray_slope(known, pixels, fits[0]), 1, 2),
        axis1=1,
        axis2=2,
    )
    ratio = np.sqrt(np.mean(np.sum(errors**2, axis=-1)) / said.mean())
    assert 0.75 < ratio < 1.3
    assert sure.trusted[sure.covered].all()
    assert np.all(sure.gain > 0.999)


def test_the_next_view_gains_what_is_said() -> None:
    one = problem(bent(), 0, count=8)
    fit = refit(one, "opencv5", "shaped")
    known = information(one, fit)
    advice = advise(known, fit)
    assert advice is not None
    assert advice.after_px < advice.before_px
    H_CB = _pose(fit, (0.0, 0.0), TILTS["its right edge turned away by 35 degrees"], 0.55)
    more = _information_of(known, fit, H_CB)
    assert more is not None
    slope = ray_slope(known, pixel_grid(STUDIO.size, 12, 8), fit)
    said = mean_sigma(slope, known.covariance(known.views.sum(axis=0) + more))
    seen = STUDIO.project(H_CB, bent())[None]
    longer = replace(one, corners_px=np.concatenate([one.corners_px, seen]), H_CB=np.concatenate([one.H_CB, H_CB[None]]))  # type: ignore[arg-type]
    again = refit(longer, "opencv5", "shaped")
    found = mean_sigma(
        slope, information(longer, replace(again, sigma_px=fit.sigma_px)).covariance(information(longer, again).views.sum(axis=0))
    )
    np.testing.assert_allclose(found, said, rtol=0.05)


def test_tilts_are_as_the_words_say() -> None:
    fit = refit(problem(bent(), 0, count=8), "opencv5", "shaped")
    points_B = BOARD.points_B().reshape(6, 9, 3)
    edges = {"right": points_B[:, -1], "left": points_B[:, 0], "top": points_B[0], "bottom": points_B[-1]}
    opposite = {"right": "left", "left": "right", "top": "bottom", "bottom": "top"}
    for side, other in opposite.items():
        H_CB = _pose(fit, (0.0, 0.0), TILTS[f"its {side} edge turned away by 35 degrees"], 0.5)
        assert se3.apply(H_CB, edges[side])[:, 2].mean() > se3.apply(H_CB, edges[other])[:, 2].mean() + 0.05


def test_a_shape_that_is_not_modelled_is_said() -> None:
    points = Pattern().points()
    points[:, 2] += 4e-4 * np.sin(14 * points[:, 0] / 0.2)
    rippled, clean = problem(points, 1), problem(bent(0.0), 1)
    fit, good = refit(rippled, "opencv5", "shaped"), refit(clean, "opencv5", "shaped")
    assert patterns.on_board(fit).seen(fit.sigma_px)
    assert not patterns.on_board(good).seen(good.sigma_px)
    names = [f"{k}.png" for k in range(16)]
    assert any("pattern" in warning and "board" in warning for warning in findings(rippled, fit, names)[1])
    assert findings(clean, good, names)[1] == []


def test_a_lens_that_is_not_modelled_is_said() -> None:
    lens = np.array([-0.4, 0.3, 0.0, 0.0, -0.9])
    studio = Studio(lens=lens)
    places = poses(24, 17, Pattern(), studio)
    corners_px = np.stack([studio.project(H_CB, Pattern().points()) for H_CB in places])
    corners_px += 0.01 * np.random.default_rng(0).standard_normal(corners_px.shape)
    fit = refit(CornerProblem(BOARD, STUDIO.size, corners_px, Camera(STUDIO.size, "opencv4", K, lens[:4]), places), "opencv4", "flat")
    assert patterns.on_image(fit).seen(fit.sigma_px)


def test_a_board_of_an_odd_size_is_asked_about() -> None:
    one = problem(Pattern().points(), 0)
    inches = replace(one, board=Board((9, 6), (0.635, 0.635)), H_CB=None, camera=None)
    solution = solve_camera(views_of(inches), inches.board, model="opencv4")
    assert any("25.4" in warning for warning in solution.warnings)
    np.testing.assert_allclose(solution.camera.K[0, 0], K[0, 0], atol=1.0)


@pytest.mark.parametrize(("blur", "noise", "most"), [(0.7, 2.0, 0.016), (1.5, 3.0, 0.03), (2.5, 4.0, 0.07)])
def test_fitted_edges_are_nearer_than_the_saddle(blur: float, noise: float, most: float) -> None:
    rays, fitted, saddle = STUDIO.rays(), [], []
    for k, H_CB in enumerate(poses(4, 29)):
        image = exposed(STUDIO.picture(H_CB, Pattern(), blur=blur, rays=rays), k, noise=noise)
        truth = STUDIO.project(H_CB, Pattern().points())
        view = find_board(image, BOARD)
        assert view.corners_px is not None
        fitted.append(view.corners_px - truth)
        saddle.append(refine(image.astype(np.float32), truth.reshape(6, 9, 2), 20.0).reshape(-1, 2) - truth)
        assert abs(view.blur_px - np.hypot(blur, 0.3)) < 0.35
    assert np.sqrt(np.mean(np.square(fitted))) < most
    assert np.mean(np.square(fitted)) < 0.7 * np.nanmean(np.square(saddle))


def test_a_fit_that_leads_away_is_not_believed() -> None:
    grid = np.stack(np.meshgrid(np.arange(40.0, 200, 20), np.arange(40.0, 140, 20)), axis=-1)
    nothing = np.random.default_rng(0).normal(100, 3, (200, 260)).astype(np.float32)
    found = fit_saddles(nothing, grid, 8)
    assert np.abs(found.corners_px - grid).max() <= 0.3 * 8
    grid[0, 0] = np.nan
    assert np.isnan(fit_saddles(nothing, grid, 8).corners_px[0, 0]).all()
    np.testing.assert_array_equal(fit_saddles(nothing, grid, 2).corners_px, grid)


def picture(seed: int = 29) -> np.ndarray:
    return exposed(STUDIO.picture(poses(1, seed)[0], Pattern()), 0)


def test_what_is_there_instead_of_the_board() -> None:
    image = picture()
    corners = np.asarray(find_board(image, BOARD).corners_px)
    edge = int(corners[:, 0].min() + 45)
    cut = find_board(np.ascontiguousarray(image[:, edge:]), BOARD)
    assert cut.corners_px is None
    assert "cut off at the left edge" in (cut.why or "")
    assert "blurred" in (find_board(cv2.GaussianBlur(image, (0, 0), 14), BOARD).why or "")
    assert "contrast" in (find_board(np.full_like(image, 90), BOARD).why or "")
    other = find_board(image, Board((11, 8), (0.025, 0.025)))
    assert "9x6" in (other.why or "")
    small = np.full_like(image, 120)
    tiny = cv2.resize(image, None, fx=0.13, fy=0.13, interpolation=cv2.INTER_AREA)
    small[200 : 200 + tiny.shape[0], 300 : 300 + tiny.shape[1]] = tiny
    assert "too small" in (find_board(small, BOARD).why or "")


def test_blurred_and_glaring_views_are_named() -> None:
    image = picture()
    glaring = image.copy()
    corners = np.asarray(find_board(image, BOARD).corners_px)
    x, y = corners.mean(axis=0).astype(int)
    cv2.circle(glaring, (int(x), int(y)), 14, 255, -1)
    views = [find_board(image, BOARD, f"{k}.png") for k in range(3)]
    views.append(replace(find_board(cv2.GaussianBlur(image, (0, 0), 2.5), BOARD), image="soft.png"))
    views.append(replace(views[0], image="shiny.png", glare=0.1))
    said = blurred_or_glaring(views)
    assert any("soft.png" in one and "0.png" not in one for one in said)
    assert any("shiny.png" in one for one in said)
    assert views[0].glare == 0


@pytest.mark.parametrize(("share", "moved_px", "at"), [(0.0, 0.0, 12), (0.02, 0.0, 12), (-0.02, 0.0, 9), (0.1, 0.0, 15), (0.0, 5.0, 12)])
def test_a_zoom_or_a_lens_moved_midway_is_named(share: float, moved_px: float, at: int) -> None:
    for seed in (1, 2):
        whole = problem(Pattern(bow_m=(0.0003, 0.0001)).points(), seed, 24)
        px = whole.corners_px.copy()
        px[at:] = K[:2, 2] + (px[at:] - K[:2, 2]) * (1 + share) + [moved_px, 0]
        said = [one for one in solve_camera(views_of(replace(whole, corners_px=px)), BOARD).warnings if "the camera is another" in one]
        assert len(said) == bool(share or moved_px), said
        assert all(f"from {at}.png on" in one or f"from {at + 1}.png on" in one or f"from {at - 1}.png on" in one for one in said), said
        assert all((f"{share:+.2g}"[0] in one.partition("%")[0]) for one in said if share), said
