"""The intrinsics against a known camera: pictures by ray casting for the estimator's honesty, corners for its failures."""

from __future__ import annotations

import importlib.util
from dataclasses import replace

import numpy as np
import pytest

from board_pictures import LENS, K, Pattern, Studio, exposed, poses
from lpcal.chain import k_camera
from lpcal.chain.h_cb_board import fit_board_pose
from lpcal.chain.k_camera.bundle import find_shape, lens_jacobian
from lpcal.chain.k_camera.bundle import solve_from_opencv as solve_own
from lpcal.chain.k_camera.choice import cross_validate
from lpcal.chain.k_camera.problem import CornerProblem
from lpcal.detect.board import find_board
from lpcal.errors import ConvergenceError, DegenerateError, InputError
from lpcal.geometry import camera as central
from lpcal.geometry import se3
from lpcal.geometry.camera_difference import pixel_grid, projection_difference
from lpcal.records.calibration import Camera
from lpcal.records.observations import Board, BoardView, BoardViews

STUDIO = Studio()
BOWED = Pattern(bow_m=(0.0004, -0.0002))
BOARD = Board((9, 6), (0.025, 0.025))
TRUTH = np.array([K[0, 0], K[1, 1], K[0, 2], K[1, 2], *LENS])
VIEWS = 20
mrcal_only = pytest.mark.skipif(importlib.util.find_spec("mrcal") is None, reason="mrcal is not installed")
SOLVERS = [pytest.param("mrcal", marks=mrcal_only), "opencv"]


def corner_views(
    count: int = VIEWS, *, sigma_px: float = 0.05, seed: int = 0, pattern: Pattern = BOWED, studio: Studio = STUDIO
) -> BoardViews:
    """Projected corners with noise, for what does not ask how pictures make corners."""
    rng = np.random.default_rng(seed)
    seen = [studio.project(H_CB, pattern.points()) for H_CB in poses(count, 17, pattern, studio)]
    return BoardViews(studio.size, tuple(BoardView(f"{k}.png", px + sigma_px * rng.standard_normal(px.shape)) for k, px in enumerate(seen)))


@pytest.fixture(scope="module")
def lights() -> list[np.ndarray]:
    rays = STUDIO.rays()
    return [STUDIO.picture(H_CB, BOWED, blur=0.8, rays=rays) for H_CB in poses(VIEWS, 17, BOWED)]


def detected(lights: list[np.ndarray], seed: int) -> BoardViews:
    views = [find_board(exposed(light, 1000 * seed + k, noise=3), BOARD, f"{k}.png") for k, light in enumerate(lights)]
    return BoardViews(STUDIO.size, tuple(views))


@pytest.mark.slow
def test_errors_are_as_large_as_said(lights: list[np.ndarray]) -> None:
    """NEES of the nine intrinsics over seeds of noise, by each solver: its mean has the spread of chi^2 over the trials."""
    sessions = [detected(lights, seed) for seed in range(10)]
    for solver in ("mrcal", "opencv") if importlib.util.find_spec("mrcal") else ("opencv",):
        nees, pulls = [], []
        for views in sessions:
            camera = k_camera.solve_camera(views, BOARD, model="opencv5", solver=solver).camera
            assert camera.covariance is not None
            error = np.array([camera.K[0, 0], camera.K[1, 1], camera.K[0, 2], camera.K[1, 2], *camera.distortion]) - TRUTH
            nees.append(error @ np.linalg.solve(camera.covariance, error))
            pulls.append(error / np.sqrt(np.diag(camera.covariance)))
        assert 9 * 0.5 < np.mean(nees) < 9 * 1.8, (solver, np.round(nees, 1))
        assert np.abs(np.mean(pulls, axis=0)).max() < 1.5, (solver, np.round(np.mean(pulls, axis=0), 2))


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_bowed_board_is_seen_and_a_flat_one_left_flat(solver: str) -> None:
    bowed = k_camera.solve_camera(corner_views(), BOARD, solver=solver)
    np.testing.assert_allclose(bowed.evidence.board_warp_m, BOWED.bow_m, atol=3e-5)
    assert abs(bowed.points_B[:, 2].mean()) < 1e-12
    flat = k_camera.solve_camera(corner_views(pattern=Pattern()), Board((9, 6), (0.025, 0.025), warp=False), solver=solver)
    assert flat.evidence.board_warp_m is None
    assert np.all(flat.points_B[:, 2] == 0)


@mrcal_only
@pytest.mark.parametrize("model", [pytest.param("opencv4", marks=pytest.mark.slow), "opencv5"])
def test_both_solvers_find_the_same(model: str) -> None:
    mrcal, own = (k_camera.solve_camera(corner_views(), BOARD, model=model, solver=solver).camera for solver in ("mrcal", "opencv"))
    assert own.covariance is not None
    assert mrcal.covariance is not None
    sigma = np.sqrt(np.diag(own.covariance))[:4]
    np.testing.assert_allclose(own.K[[0, 1, 0, 1], [0, 1, 2, 2]], mrcal.K[[0, 1, 0, 1], [0, 1, 2, 2]], atol=0.2 * sigma.max())
    np.testing.assert_allclose(np.sqrt(np.diag(mrcal.covariance))[:4], sigma, rtol=0.05)


def test_a_lens_that_needs_k3_gets_it() -> None:
    lens = np.array([-0.3, 0.15, 0.0, 0.0, -0.2])
    studio = Studio(lens=lens)
    solution = k_camera.solve_camera(corner_views(24, sigma_px=0.02, studio=studio), BOARD)
    assert solution.camera.model in {"opencv5", "opencv8"}
    pixels = pixel_grid(STUDIO.size, 20, 15)
    pixels = pixels[np.all(np.abs(pixels - np.array(STUDIO.size) / 2) < 0.42 * np.array(STUDIO.size), axis=1)]
    rays = central.unproject(pixels, K, lens)
    error, _ = projection_difference(pixels, rays, solution.camera.project)
    assert np.sqrt(np.mean(np.sum(error**2, axis=1))) < 0.1


@pytest.mark.parametrize("solver", SOLVERS)
def test_gross_corners_are_rejected_and_counted(solver: str) -> None:
    views = list(corner_views().views)
    for index, shift in ((2, 3.0), (7, 1.5)):
        corners_px = np.array(views[index].corners_px)
        corners_px[[4, 30]] += shift
        views[index] = BoardView(views[index].image, corners_px)
    solution = k_camera.solve_camera(BoardViews(STUDIO.size, tuple(views)), BOARD, model="opencv4", solver=solver)
    assert [view.rejected for view in solution.views if view.image in {"2.png", "7.png"}] == [2, 2]
    assert sum(view.rejected for view in solution.views) <= 6
    np.testing.assert_allclose(solution.camera.K[0, 0], K[0, 0], atol=5 * 0.1)


@pytest.mark.parametrize("solver", SOLVERS)
def test_corners_that_were_not_seen_are_done_without(solver: str) -> None:
    rng = np.random.default_rng(2)
    views = []
    for view in corner_views().views:
        corners_px = np.array(view.corners_px)
        corners_px[rng.permutation(54)[:15]] = np.nan
        views.append(BoardView(view.image, corners_px))
    solution = k_camera.solve_camera(BoardViews(STUDIO.size, tuple(views)), BOARD, model="opencv4", solver=solver)
    assert abs(solution.camera.K[0, 0] - K[0, 0]) < 1.0
    assert {view.corners + view.rejected for view in solution.views} == {39}


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_view_that_does_not_fit_is_left_out_and_named(solver: str) -> None:
    views = list(corner_views().views)
    views[5] = BoardView("5.png", np.asarray(views[5].corners_px) + np.random.default_rng(1).normal(0, 4.0, (54, 2)))
    solution = k_camera.solve_camera(BoardViews(STUDIO.size, tuple(views)), BOARD, model="opencv4", solver=solver)
    assert [view.image for view in solution.views if not view.used] == ["5.png"]
    assert "do not fit" in (solution.views[5].why or "")


def test_squares_that_are_not_square() -> None:
    pattern = Pattern(square_m=(0.0249, 0.0252))
    solution = k_camera.solve_camera(corner_views(pattern=pattern), Board((9, 6), (0.0249, 0.0252)), model="opencv4")
    assert solution.solver == "opencv"
    assert "unequal" in str(solution.evidence.solver_note)
    np.testing.assert_allclose([solution.camera.K[0, 0], solution.camera.K[1, 1]], [K[0, 0], K[1, 1]], atol=0.6)


def test_without_mrcal_it_is_said_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(k_camera, "find_spec", lambda name: None)
    solution = k_camera.solve_camera(corner_views(), BOARD, model="opencv5")
    assert solution.solver == "opencv"
    assert "mrcal is not installed" in str(solution.evidence.solver_note)
    assert not any("mrcal" in line for line in solution.warnings)  # as good a fit as mrcal's: no doubt of the camera
    with pytest.raises(InputError, match="needs mrcal"):
        k_camera.solve_camera(corner_views(), BOARD, model="splined")


def test_two_views_are_too_few() -> None:
    with pytest.raises(DegenerateError, match="2 of 2 images"):
        k_camera.solve_camera(corner_views(2), BOARD)


@pytest.mark.parametrize("solver", SOLVERS)
def test_views_that_all_face_the_camera_are_refused(solver: str) -> None:
    points, views = Pattern().points(), []
    rng = np.random.default_rng(0)
    for k in range(9):
        H_CB = np.eye(4)
        H_CB[:3, 3] = [-0.1 + 0.02 * (k % 3 - 1), -0.06 + 0.02 * (k // 3 - 1), 0.4]
        views.append(BoardView(f"{k}.png", STUDIO.project(H_CB, points) + 0.05 * rng.standard_normal((54, 2))))
    with pytest.raises(DegenerateError, match="focal length"):
        k_camera.solve_camera(
            BoardViews(STUDIO.size, tuple(views)), Board((9, 6), (0.025, 0.025), warp=False), model="opencv4", solver=solver
        )


def test_the_lens_derivative_is_one() -> None:
    lens = np.array([-0.3, 0.12, 0.0007, -0.0005, 0.01, 0.01, 0.02, 0.003])
    x_C = np.random.default_rng(0).uniform([-0.3, -0.3, 0.8], [0.3, 0.3, 1.2], (30, 3))
    J = lens_jacobian(x_C, K, lens)
    for column in range(12):
        moved = [np.array([K[0, 0], K[1, 1], K[0, 2], K[1, 2], *lens]) for _ in range(2)]
        moved[0][column] += 1e-6
        moved[1][column] -= 1e-6
        ends = [central.project(x_C, np.array([[m[0], 0, m[2]], [0, m[1], m[3]], [0, 0, 1]]), m[4:]) for m in moved]
        np.testing.assert_allclose(J[..., column], (ends[0] - ends[1]) / 2e-6, rtol=1e-5, atol=1e-4)


def test_a_pose_and_its_covariance() -> None:
    camera, sigma_px, nees = Camera(STUDIO.size, "opencv5", K, LENS), 0.2, []
    points_B = Pattern().points()
    rng = np.random.default_rng(5)
    for H_CB in poses(60, 9):
        corners_px = STUDIO.project(H_CB, points_B) + sigma_px * rng.standard_normal((54, 2))
        corners_px[3] += 9.0
        corners_px[10] = np.nan
        pose = fit_board_pose(corners_px, points_B, camera, sigma_px)
        assert not pose.inlier[3]
        assert not pose.inlier[10]
        xi = se3.log(H_CB @ se3.inv(pose.H_CB))
        nees.append(xi @ np.linalg.solve(pose.covariance, xi))
    assert 4.5 < np.mean(nees) < 7.5


def test_a_bow_is_found_under_a_given_camera() -> None:
    views = corner_views()
    problem = CornerProblem(BOARD, STUDIO.size, np.stack([np.asarray(view.corners_px) for view in views.views]))
    points_B = find_shape(problem, Camera(STUDIO.size, "opencv5", K, LENS), poses(VIEWS, 17, BOWED))
    truth = BOWED.points()[:, 2]
    np.testing.assert_allclose(points_B[:, 2], truth - truth.mean(), atol=2e-5)


@mrcal_only
def test_a_splined_lens_projects_where_the_lens_does() -> None:
    solution = k_camera.solve_camera(corner_views(24), BOARD, model="splined")
    camera = solution.camera
    pixels = pixel_grid(STUDIO.size, 12, 9)
    pixels = pixels[np.all(np.abs(pixels - np.array(STUDIO.size) / 2) < 0.35 * np.array(STUDIO.size), axis=1)]
    error, _ = projection_difference(pixels, central.unproject(pixels, K, LENS), camera.project)
    assert np.sqrt(np.mean(np.sum(error**2, axis=1))) < 0.25
    np.testing.assert_allclose(camera.project(camera.unproject(pixels)), pixels, atol=1e-6)


def rippled(px: np.ndarray) -> np.ndarray:
    """Half a pixel of waves that no polynomial of a lens follows."""
    x, y = np.moveaxis((px - np.array(STUDIO.size) / 2) / 200, -1, 0)
    return np.asarray(px + 0.5 * np.stack([np.sin(5 * x) * np.cos(4 * y), np.cos(6 * x + 1) * np.sin(5 * y)], axis=-1))


@mrcal_only
@pytest.mark.slow
def test_a_lens_that_no_polynomial_follows_is_splined_and_says_how_sure() -> None:
    views = corner_views(40, pattern=Pattern())
    waves = replace(views, views=tuple(replace(view, corners_px=rippled(np.asarray(view.corners_px))) for view in views.views))
    solution = k_camera.solve_camera(waves, BOARD)
    assert solution.camera.model == "splined"
    said = solution.evidence.projection_uncertainty
    assert np.all(np.isfinite(said.worst_direction_std_px))
    pixels = pixel_grid(STUDIO.size, 12, 9)
    pixels = pixels[np.all(np.abs(pixels - np.array(STUDIO.size) / 2) < 0.3 * np.array(STUDIO.size), axis=1)]
    rays_C = central.unproject(pixels, K, LENS)
    spline, polynomial = (
        np.sqrt(np.mean((projection_difference(rippled(pixels), rays_C, camera.project)[0]) ** 2))
        for camera in (solution.camera, k_camera.solve_camera(waves, BOARD, model="opencv8").camera)
    )
    assert spline < 0.5 * polynomial


@mrcal_only
def test_a_lens_that_a_polynomial_follows_is_not_splined() -> None:
    assert k_camera.solve_camera(corner_views(24), BOARD).camera.model != "splined"


def test_own_solver_leaves_the_poses_consistent() -> None:
    views = corner_views()
    problem = CornerProblem(BOARD, STUDIO.size, np.stack([np.asarray(view.corners_px) for view in views.views]))
    fit = solve_own(problem, "opencv5", "bowed")
    found = fit.camera.project(se3.apply(fit.H_CB, fit.points_B))
    np.testing.assert_allclose(problem.corners_px - found, fit.residual_px, atol=1e-9)
    assert 0.045 < fit.sigma_px < 0.055


def emptied(kept: list[int]) -> CornerProblem:
    """Views of which the first has these corners only, as where the others were rejected."""
    views = corner_views(6)
    corners_px = np.stack([np.asarray(view.corners_px) for view in views.views])
    lost = np.setdiff1d(np.arange(corners_px.shape[1]), kept)
    corners_px[0, lost] = np.nan
    return CornerProblem(BOARD, views.image_size, corners_px)


@mrcal_only
@pytest.mark.parametrize("kept", [[], [20], [0, 8, 22, 45, 53]], ids=["none", "one", "five"])
def test_a_view_that_lost_its_corners_is_an_error_of_the_contract(kept: list[int]) -> None:
    from lpcal.chain.k_camera import mrcal_solver

    problem = emptied(kept)
    with pytest.raises(ConvergenceError, match=f"{len(kept)} corners that fit"):
        mrcal_solver.solve(problem, "opencv4", "flat")
    assert cross_validate(problem, mrcal_solver.solve, "opencv4", "flat", pixel_grid(problem.image_size)) == float("inf")


@mrcal_only
@pytest.mark.parametrize("failure", [Exception("solvePnP() failed"), type("Behind", (Exception,), {})(), RuntimeError("no")])
def test_whatever_mrcal_raises_from_a_start_is_an_error_of_the_contract(failure: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    import mrcal

    from lpcal.chain.k_camera import mrcal_solver

    def fails(**_: object) -> None:
        raise failure

    monkeypatch.setattr(mrcal, "seed_stereographic", fails)
    with pytest.raises(ConvergenceError, match="no start"):
        mrcal_solver.solve(emptied(list(range(54))), "opencv4", "flat")


@mrcal_only
def test_a_solve_that_mrcal_gives_up_is_an_error_of_the_contract(monkeypatch: pytest.MonkeyPatch) -> None:
    from lpcal.chain.k_camera import mrcal_solver

    def fails(*_: object) -> None:
        raise RuntimeError("mrcal.optimize() failed!")

    monkeypatch.setattr(mrcal_solver, "_optimize", fails)
    with pytest.raises(ConvergenceError, match="no lens"):
        mrcal_solver.solve(emptied(list(range(54))), "opencv4", "flat")
