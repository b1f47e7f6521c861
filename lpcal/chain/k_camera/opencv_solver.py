"""The intrinsics without mrcal: OpenCV's closed form and first adjustment as the start, then lpcal's own bundle adjustment.

What is missing against mrcal: splined lenses, and the optimisation inputs in camera.cameramodel. Source: Zhang 2000; see `bundle`.
"""

from __future__ import annotations

import numpy as np

from lpcal.chain.k_camera.bundle import Adjusted, Bundle, Unknowns, adjust
from lpcal.chain.k_camera.problem import DISTORTIONS, CameraFit, CornerProblem, parameter_names, rms
from lpcal.errors import ConvergenceError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera


def solve(problem: CornerProblem, model: str, warp: bool) -> CameraFit:
    """Intrinsics, poses and the board's bow.

    Raises
    ------
    ConvergenceError
        OpenCV finds no start, or the adjustment runs away.
    """
    start = _start(problem, DISTORTIONS[model])
    points_B = problem.board.points_B()
    flat = adjust(Bundle(problem.corners_px, points_B, problem.board.corners, free_lens=True, free_warp=False), start)
    bundle = Bundle(problem.corners_px, points_B, problem.board.corners, free_lens=True, free_warp=warp)
    return _fit(problem, model, bundle, adjust(bundle, flat.state) if warp else flat)


def find_warp(problem: CornerProblem, camera: Camera, H_CB: Array) -> Array:
    """Points_B (M, 3) with the bow that fits best where the lens is given; poses H_CB (N, 4, 4) to start from."""
    bundle = Bundle(problem.corners_px, problem.board.points_B(), problem.board.corners, free_lens=False, free_warp=True)
    found = adjust(bundle, Unknowns(camera.K, camera.distortion, H_CB, np.zeros(2))).state
    return _level(bundle, found)[1]


def _start(problem: CornerProblem, coefficients: int) -> Unknowns:
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
    start = np.zeros(coefficients)
    start[:4] = np.ravel(distortion)[:4]
    return Unknowns(np.asarray(K, dtype=float), start, H_CB, np.zeros(2))


def _level(bundle: Bundle, state: Unknowns) -> tuple[Array, Array]:
    """H_CB and points_B with the mean plane at z = 0."""
    points_B = bundle.bowed(state)
    lift = np.array([0.0, 0.0, points_B[:, 2].mean()])
    return state.H_CB @ se3.transform(np.eye(3), lift), points_B - lift


def _fit(problem: CornerProblem, model: str, bundle: Bundle, found: Adjusted) -> CameraFit:
    state, count = found.state, 4 + found.state.distortion.size
    H_CB, points_B = _level(bundle, state)
    camera = Camera(
        problem.image_size,
        model,
        state.K,
        state.distortion,
        rms_px=rms(found.residual_px, found.inlier),
        parameters=parameter_names(model),
        covariance=found.sigma_px**2 * found.covariance[:count, :count],
    )
    warp_m = (float(state.warp_m[0]), float(state.warp_m[1])) if bundle.free_warp else None
    return CameraFit(camera, H_CB, points_B, found.inlier, found.residual_px, found.sigma_px, warp_m)
