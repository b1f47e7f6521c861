"""The same corners by another's adjustment: OpenCV's calibrateCamera, from lpcal's solution, on lpcal's board and inliers.

It shares neither code nor priors with mrcal or with `bundle`; what it is apart from them, against the uncertainty that is said, is the
check. Source: OpenCV, calib3d; the difference: `geometry.camera_difference`.
"""

from __future__ import annotations

import numpy as np

from lpcal.chain.k_camera.assess import judged_pixels
from lpcal.chain.k_camera.problem import DIGITS, DISTORTIONS, CameraFit, CornerProblem
from lpcal.geometry.camera_difference import pixel_grid, projection_difference
from lpcal.records.camera import Camera
from lpcal.records.evidence import OtherSolver

BY = "OpenCV calibrateCamera"
"""Who checks."""

STOP = (30, 1e-9)


def check(problem: CornerProblem, fit: CameraFit) -> OtherSolver | None:
    """How far OpenCV's camera projects from the fit's, where corners are; None for lenses that it does not know."""
    import cv2

    if fit.camera.model not in DISTORTIONS:
        return None
    flags = cv2.CALIB_USE_INTRINSIC_GUESS
    flags |= {"opencv4": cv2.CALIB_FIX_K3, "opencv8": cv2.CALIB_RATIONAL_MODEL}.get(fit.camera.model, 0)
    points = [fit.points_B[used].astype(np.float32) for used in fit.inlier if used.any()]
    corners = [px[used].astype(np.float32) for px, used in zip(problem.corners_px, fit.inlier, strict=True) if used.any()]
    start = np.zeros(max(5, fit.camera.distortion.size))
    start[: fit.camera.distortion.size] = fit.camera.distortion
    criteria = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, *STOP)
    try:
        _, K, distortion, *_ = cv2.calibrateCamera(
            points, corners, problem.image_size, fit.camera.K.copy(), start, flags=flags, criteria=criteria
        )
    except cv2.error as error:
        return OtherSolver(by=BY, failed=str(error).strip().splitlines()[-1])
    other = Camera(problem.image_size, fit.camera.model, np.asarray(K, dtype=float), np.ravel(distortion)[: fit.camera.distortion.size])
    pixels = pixel_grid(problem.image_size)
    pixels = pixels[judged_pixels(pixels, fit)]
    if not len(pixels):
        return None
    apart = np.linalg.norm(projection_difference(pixels, fit.camera.unproject(pixels), other.project)[0], axis=1)
    return OtherSolver(
        by=BY,
        f_px=(round(float(K[0, 0]), DIGITS), round(float(K[1, 1]), DIGITS)),
        c_px=(round(float(K[0, 2]), DIGITS), round(float(K[1, 2]), DIGITS)),
        difference_rms_px=round(float(np.sqrt(np.mean(apart**2))), DIGITS),
        difference_worst_px=round(float(apart.max()), DIGITS),
    )
