"""The intrinsics by mrcal: regularised lens models, outliers rejected, the board's bow along x and along y estimated.

Symbols: intrinsics (fx, fy, cx, cy, distortion...), bow k along an axis with xi from 0 to 1: ``z = 4 k xi (1 - xi)``; J the derivative
of all measurements (corners and regularisation) by all unknowns, J_q its rows of corners::

    covariance = sigma^2 (J'J)^-1 J_q'J_q (J'J)^-1

The order of the solve: a stereographic lens, poses alone, then its core; small distortions appended; all with outlier rejection; then
the bow. Source: mrcal's documentation (formulation, uncertainty).
"""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from lpcal.chain.k_camera.problem import DISTORTIONS, ROUNDS, CameraFit, CornerProblem, fitting, parameter_names, rms, scatter
from lpcal.chain.k_camera.shape import BOARDS
from lpcal.errors import ConvergenceError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera

FOCAL_GUESSES = (0.9, 0.5, 1.8, 3.6)
"""In units of the image's width; the first that leads to a fit under GOOD_START is taken."""
GOOD_START = 0.01
"""rms of a start without distortion, in units of the image's width."""
FEWEST_CORNERS = 6
"""Corners of a view below which mrcal estimates no pose of it: it raises a class that cannot be named outside."""
SPLINE_PX = 60
"""About so many pixels between the knots of a splined lens."""
RMS = "rms_reproj_error__pixels"
"""The name under which mrcal's optimiser gives the rms of its residuals, pixels."""


@dataclass
class Inputs:
    """mrcal's optimisation inputs under its own names, unused ones None; its solver changes the arrays in place."""

    observations_board: Array
    """(N, rows, columns, 3): x, y in px and a weight, negative where a corner does not count."""
    indices_frame_camintrinsics_camextrinsics: npt.NDArray[np.int32]
    imagersizes: npt.NDArray[np.int32]
    calibration_object_spacing: float
    intrinsics: Array = field(default_factory=lambda: np.zeros((1, 4)))
    rt_ref_frame: Array = field(default_factory=lambda: np.zeros((0, 6)))
    rt_cam_ref: None = None
    points: None = None
    observations_point: None = None
    indices_point_camintrinsics_camextrinsics: None = None
    observations_point_triangulated: None = None
    indices_point_triangulated_camintrinsics_camextrinsics: None = None
    lensmodel: str = "LENSMODEL_STEREOGRAPHIC"
    calobject_warp: Array | None = None
    do_optimize_intrinsics_core: bool = False
    do_optimize_intrinsics_distortions: bool = False
    do_optimize_extrinsics: bool = False
    do_optimize_frames: bool = True
    do_optimize_calobject_warp: bool = False
    point_min_range: float = 1e-3
    point_max_range: float = 1e3
    do_apply_outlier_rejection: bool = False
    do_apply_regularization: bool = False
    verbose: bool = False
    imagepaths: None = None


def solve(problem: CornerProblem, model: str, board: str) -> CameraFit:
    """Intrinsics, poses and, where the board is not taken as flat, its bow; mrcal knows no other shape.

    Raises
    ------
    ConvergenceError
        mrcal finds no solution from any start, or a view has too few corners for a pose.
    """
    seen = np.isfinite(problem.corners_px).all(axis=-1).sum(axis=1)
    if seen.min() < FEWEST_CORNERS:
        raise ConvergenceError(
            f"a view of the board has {seen.min()} corners that fit",
            needed=f"at least {FEWEST_CORNERS} in each view",
            todo="look at the corners found",
        )
    with silenced():
        inputs = _start(problem)
        try:
            _append_lens(inputs, problem, model)
            _optimize(inputs, problem, model)
            if board != BOARDS[0]:
                inputs.calobject_warp, inputs.do_optimize_calobject_warp = np.zeros(2), True
                _optimize(inputs, problem, model)
            return _fit(problem, model, inputs)
        except RuntimeError as error:
            raise ConvergenceError(
                "mrcal finds no lens for these corners", needed="board corners of one camera", todo="look at the corners found"
            ) from error


def _optimize(inputs: Inputs, problem: CornerProblem, model: str) -> None:
    """Solve, reject, solve again, until the rejected corners stay the same."""
    import mrcal

    weights = inputs.observations_board[..., 2]
    for _ in range(ROUNDS):
        mrcal.optimize(**vars(inputs))
        inlier = weights.reshape(len(weights), -1) > 0
        residual_px = _residual(problem, _camera(problem, model, inputs), *_geometry(problem, inputs))
        kept = fitting(residual_px, scatter(residual_px, inlier, _count(inputs)))
        if np.array_equal(kept, inlier):
            break
        weights[:] = np.where(kept, 1.0, -1.0).reshape(weights.shape)


def _start(problem: CornerProblem) -> Inputs:
    """Optimisation inputs with poses and a stereographic core, from whichever guess of the focal length fits best."""
    import mrcal

    width = problem.image_size[0]
    best: tuple[float, Inputs | None] = (np.inf, None)
    for guess in FOCAL_GUESSES:
        inputs = _inputs(problem)
        try:
            core, rt_CB = _seed(inputs, guess * width)
            inputs.intrinsics, inputs.rt_ref_frame = core, rt_CB
            mrcal.optimize(**vars(inputs))
            inputs.do_optimize_intrinsics_core = True
            error = mrcal.optimize(**vars(inputs))[RMS]
        except (ConvergenceError, RuntimeError, ValueError, np.linalg.LinAlgError):
            continue
        if error < best[0] and np.all(inputs.intrinsics[0, :2] > 0):
            best = (error, inputs)
        if error < GOOD_START * width:
            break
    if best[1] is None:
        raise ConvergenceError(
            "no start for the intrinsics leads anywhere", needed="board corners of a central camera", todo="look at the corners found"
        )
    return best[1]


def _seed(inputs: Inputs, focal_px: float) -> tuple[Array, Array]:
    """The core and the poses from a focal length; what mrcal raises here are classes inside its functions, and Exception itself."""
    import mrcal

    try:
        core, _, rt_CB = mrcal.seed_stereographic(
            imagersizes=inputs.imagersizes,
            focal_estimate=focal_px,
            indices_frame_camera=np.ascontiguousarray(inputs.indices_frame_camintrinsics_camextrinsics[:, :2]),
            observations=inputs.observations_board,
            object_spacing=inputs.calibration_object_spacing,
        )
    except Exception as error:
        raise ConvergenceError("mrcal estimates no pose from these corners", todo="look at the corners found") from error
    return np.array(core, dtype=float), np.array(rt_CB, dtype=float)


def _inputs(problem: CornerProblem) -> Inputs:
    """What mrcal is asked of a problem: poses and a stereographic core, no lens yet."""
    count = len(problem.corners_px)
    columns, rows = problem.board.corners
    seen = np.isfinite(problem.corners_px).all(axis=-1, keepdims=True)
    observations = np.concatenate([np.where(seen, problem.corners_px, 0.0), np.where(seen, 1.0, -1.0)], axis=-1)
    indices = np.stack([np.arange(count), np.zeros(count), -np.ones(count)], axis=1)
    return Inputs(
        observations_board=np.ascontiguousarray(observations.reshape(count, rows, columns, 3)),
        indices_frame_camintrinsics_camextrinsics=np.ascontiguousarray(indices, dtype=np.int32),
        imagersizes=np.array([problem.image_size], dtype=np.int32),
        calibration_object_spacing=float(problem.board.square_m[0]),
    )


def _append_lens(inputs: Inputs, problem: CornerProblem, model: str) -> None:
    """Give the lens its model, with distortions that are small but not at their saddle."""
    import mrcal

    lensmodel = f"LENSMODEL_{model.upper()}" if model in DISTORTIONS else _spline(inputs, problem)
    count = mrcal.lensmodel_num_params(lensmodel) - 4
    small = 1e-6 * np.random.default_rng(0).uniform(-1, 1, (1, count))
    inputs.lensmodel = lensmodel
    inputs.intrinsics = np.concatenate([inputs.intrinsics, small], axis=1)
    inputs.do_optimize_intrinsics_core = model in DISTORTIONS
    inputs.do_optimize_intrinsics_distortions = inputs.do_apply_regularization = True


def _spline(inputs: Inputs, problem: CornerProblem) -> str:
    """The splined lens model whose knots cover the imager a little beyond its edges."""
    width, height = problem.image_size
    fov_deg = 2 * np.degrees(2 * np.arctan(0.5 * width / 2 / inputs.intrinsics[0, 0])) * 1.15
    columns = int(np.clip(round(width / SPLINE_PX), 6, 30))
    rows = max(5, round(columns * height / width))
    return f"LENSMODEL_SPLINED_STEREOGRAPHIC_order=3_Nx={columns}_Ny={rows}_fov_x_deg={fov_deg:.0f}"


def _fit(problem: CornerProblem, model: str, inputs: Inputs) -> CameraFit:
    import mrcal

    H_CB, points_B = _geometry(problem, inputs)
    camera = _camera(problem, model, inputs)
    residual_px = _residual(problem, camera, H_CB, points_B)
    inlier = inputs.observations_board[..., 2].reshape(residual_px.shape[:2]) > 0
    covariance = _covariance(inputs)
    sigma_px = scatter(residual_px, inlier, _count(inputs))
    names = parameter_names(model) if model in DISTORTIONS else ()
    camera = Camera(
        **{
            **vars(camera),
            "rms_px": rms(residual_px, inlier),
            "parameters": names,
            "covariance": sigma_px**2 * covariance if names else None,
        }
    )

    def text() -> str:
        stream = io.StringIO()
        mrcal.cameramodel(optimization_inputs=vars(inputs).copy(), icam_intrinsics=0).write(stream)
        return stream.getvalue()

    def uncertainty(pixels: Array) -> Array:
        with silenced():
            lens = mrcal.cameramodel(optimization_inputs=vars(inputs).copy(), icam_intrinsics=0)
            worst_px = mrcal.projection_uncertainty(
                camera.unproject(pixels), lens, atinfinity=True, what="worstdirection-stdev", observed_pixel_uncertainty=sigma_px
            )
        return np.nan_to_num(worst_px, nan=problem.image_size[0], posinf=problem.image_size[0])

    bow = inputs.calobject_warp
    shape = {} if bow is None else {name: (float(value), float("nan")) for name, value in zip(("bow_x_m", "bow_y_m"), bow, strict=True)}
    return CameraFit(
        camera, H_CB, points_B, inlier, residual_px, sigma_px, BOARDS[bool(shape)], shape, text, None if names else uncertainty
    )


def _geometry(problem: CornerProblem, inputs: Inputs) -> tuple[Array, Array]:
    """H_CB and points_B with the mean plane at z = 0."""
    import mrcal

    columns, rows = problem.board.corners
    grid_B = mrcal.ref_calibration_object(columns, rows, inputs.calibration_object_spacing, calobject_warp=inputs.calobject_warp).reshape(
        -1, 3
    )
    lift = np.array([0.0, 0.0, grid_B[:, 2].mean()])
    rt_CB = inputs.rt_ref_frame
    H_CB = se3.transform(se3.rotation(rt_CB[:, :3]), rt_CB[:, 3:])
    return H_CB @ se3.transform(np.eye(3), lift), grid_B - lift


def _camera(problem: CornerProblem, model: str, inputs: Inputs) -> Camera:
    vector = inputs.intrinsics[0]
    K = np.array([[vector[0], 0, vector[2]], [0, vector[1], vector[3]], [0, 0, 1.0]])
    if model in DISTORTIONS:
        return Camera(problem.image_size, model, K, vector[4:].copy())
    return Camera(problem.image_size, model, K, np.zeros(0), lensmodel=inputs.lensmodel, spline=vector.copy())


def _residual(problem: CornerProblem, camera: Camera, H_CB: Array, points_B: Array) -> Array:
    return np.asarray(problem.corners_px - camera.project(se3.apply(H_CB, points_B)))


def _count(inputs: Inputs) -> int:
    """Number of unknowns."""
    import mrcal

    return int(mrcal.num_states(**vars(inputs)))


def _covariance(inputs: Inputs) -> Array:
    """Covariance (P, P) of the intrinsics for corners of unit sigma."""
    import mrcal

    _, _, J, factor = mrcal.optimizer_callback(**vars(inputs))
    states = J.shape[1]
    first = mrcal.state_index_intrinsics(0, **vars(inputs))
    count = mrcal.num_intrinsics_optimization_params(**vars(inputs))
    if factor is None or count > 12:
        return np.full((count, count), np.nan)
    picks = np.zeros((count, states))
    picks[range(count), range(first, first + count)] = 1.0
    solved = factor.solve_xt_JtJ_bt(picks)
    observed = J[: mrcal.num_measurements_boards(**vars(inputs))] @ solved.T
    scale = np.ones(states)
    mrcal.unpack_state(scale, **vars(inputs))
    scale = scale[first : first + count]
    return scale[:, None] * (observed.T @ observed) * scale


@contextmanager
def silenced() -> Iterator[None]:
    """Keep mrcal's C code from the terminal: it writes straight to the descriptors of stdout and stderr."""
    sys.stdout.flush()
    sys.stderr.flush()
    kept = [os.dup(1), os.dup(2)]
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        yield
    finally:
        os.dup2(kept[0], 1)
        os.dup2(kept[1], 2)
        for descriptor in (*kept, nowhere):
            os.close(descriptor)
