"""The intrinsics without mrcal: OpenCV's closed form and first adjustment as the start, then lpcal's own bundle adjustment.

What is missing against mrcal: splined lenses, and the optimisation inputs in camera.cameramodel. Source: Zhang 2000; see `bundle`.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.chain.k_camera.problem import CameraFit, CornerProblem
from lpcal.chain.k_camera.refit import refit
from lpcal.errors import ConvergenceError
from lpcal.geometry import se3
from lpcal.records.calibration import Camera


def solve(problem: CornerProblem, model: str, board: str) -> CameraFit:
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
