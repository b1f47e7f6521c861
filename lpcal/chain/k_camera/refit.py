"""The intrinsics by lpcal's own adjustment, from a camera and poses known about: the board may have any of the shapes of `shape`.

What it adds to mrcal's solve: twist, cubic terms and unequal squares; with the same terms it finds the same. See `bundle`.

The intrinsics without mrcal: OpenCV's closed form and first adjustment as the start, then lpcal's own bundle adjustment.

What is missing against mrcal: splined lenses, and the optimisation inputs in camera.cameramodel. Source: Zhang 2000; see `bundle`.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.chain.k_camera.bundle import Adjusted, Bundle, Unknowns, adjust
from lpcal.chain.k_camera.problem import DISTORTIONS, CameraFit, CornerProblem, parameter_names, rms
from lpcal.chain.k_camera.shape import BOARDS, shape_terms
from lpcal.errors import ConvergenceError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera


def refit(problem: CornerProblem, model: str, board: str) -> CameraFit:
    """Intrinsics, poses and the board's shape from ``problem.camera`` and ``problem.H_CB``.

    Raises
    ------
    ConvergenceError
        The adjustment runs away.
    """
    assert problem.camera is not None
    assert problem.H_CB is not None
    terms = shape_terms(problem.board, board)
    distortion = np.zeros(DISTORTIONS[model])
    known = problem.camera.distortion[: distortion.size]
    distortion[: known.size] = known
    bundle = Bundle(problem.corners_px, problem.board.points_B(), terms, free_lens=True)
    found = adjust(bundle, Unknowns(problem.camera.K, distortion, problem.H_CB, np.zeros(len(terms.names))))
    return _fit(problem, model, board, bundle, found)


def find_shape(problem: CornerProblem, camera: Camera, H_CB: Array) -> Array:
    """Points_B (M, 3) with the shape that fits best where the lens is given; poses H_CB (N, 4, 4) to start from."""
    terms = shape_terms(problem.board, BOARDS[2])
    bundle = Bundle(problem.corners_px, problem.board.points_B(), terms, free_lens=False)
    return bundle.shaped(adjust(bundle, Unknowns(camera.K, camera.distortion, H_CB, np.zeros(len(terms.names)))).state)


def _fit(problem: CornerProblem, model: str, board: str, bundle: Bundle, found: Adjusted) -> CameraFit:
    state, count = found.state, 4 + found.state.distortion.size
    camera = Camera(
        problem.image_size,
        model,
        state.K,
        state.distortion,
        rms_px=rms(found.residual_px, found.inlier),
        parameters=parameter_names(model),
        covariance=found.sigma_px**2 * found.covariance[:count, :count],
    )
    sigma = found.sigma_px * np.sqrt(np.diag(found.covariance)[count:])
    shape = {name: (float(value), float(one)) for name, value, one in zip(bundle.terms.names, state.shape, sigma, strict=True)}
    return CameraFit(camera, state.H_CB, bundle.shaped(state), found.inlier, found.residual_px, found.sigma_px, board, shape)


def solve_from_opencv(problem: CornerProblem, model: str, board: str) -> CameraFit:
    """Intrinsics, poses and the board's shape.

    Raises
    ------
    ConvergenceError
        OpenCV finds no start, or the adjustment runs away.
    """
    known = problem if problem.H_CB is not None else _started(problem)
    return refit(known, model, board)


def _started(problem: CornerProblem) -> CornerProblem:
    """The problem with a camera and poses to start from."""
    import cv2

    points_B = problem.board.points_B().astype(np.float32)
    seen = np.isfinite(problem.corners_px).all(axis=-1)
    corners = [view[mask].astype(np.float32).reshape(-1, 1, 2) for view, mask in zip(problem.corners_px, seen, strict=True)]
    flags = cv2.CALIB_FIX_K3
    try:
        _, K, distortion, phi, t = cv2.calibrateCamera(
            [points_B[mask] for mask in seen], corners, problem.image_size, None, None, flags=flags
        )
    except cv2.error as error:
        raise ConvergenceError(
            "OpenCV finds no start for the intrinsics", needed="views of different tilts", todo="take more images of the board, tilted"
        ) from error
    H_CB = se3.transform(se3.rotation(np.array(phi).reshape(-1, 3)), np.array(t).reshape(-1, 3))
    camera = Camera(problem.image_size, "opencv4", np.asarray(K, dtype=float), np.ravel(distortion)[:4].astype(float))
    return replace(problem, camera=camera, H_CB=H_CB)
