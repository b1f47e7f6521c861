"""H_CB: where the board is in each image, the camera known.

Symbols: corners q_m, board points x_B,m, ``q_m = project(H_CB x_B,m)``; start from the homography of the board's plane to the plane
z = 1 of C, then Gauss-Newton on the left perturbation ``H = exp(xi) H``, both readings of a plane's pose tried; J the derivative::

    covariance = sigma^2 (J'J)^-1

Source: Zhang 2000 (homography to pose), Schweighofer & Pinz 2006 (a plane seen from afar has two poses that fit nearly alike).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.calibration import Camera

STEPS = 30
FEWEST_CORNERS = 6
OUTLIER_SIGMAS = 5.0


@dataclass(frozen=True)
class BoardPose:
    """The board in one image."""

    H_CB: Array
    """(4, 4)."""
    covariance: Array
    """(6, 6) of the left perturbation."""
    inlier: Mask
    """(M,) corners seen and not rejected."""
    rms_px: float
    """A coordinate, over the inliers."""


def fit_board_pose(corners_px: Array, points_B: Array, camera: Camera, sigma_px: float, H_CB: Array | None = None) -> BoardPose:
    """Pose of the board from corners_px (M, 2), NaN where not seen, and points_B (M, 3); from H_CB where it is known about.

    Corners off by more than five sigmas (of `sigma_px`, or of the view's own scatter where that is larger) are left out, one pass.

    Raises
    ------
    DegenerateError
        Fewer than six corners, or all on a line.
    """
    seen = np.isfinite(corners_px).all(axis=1)
    if seen.sum() < FEWEST_CORNERS or np.linalg.matrix_rank(points_B[seen, :2] - points_B[seen, :2].mean(axis=0), tol=1e-6) < 2:
        raise DegenerateError(f"{int(seen.sum())} corners, all on a line or too few", needed=f"{FEWEST_CORNERS} corners of the board")
    if H_CB is None:
        H_CB = _best_pose(corners_px[seen], points_B[seen], camera)
    inlier = seen.copy()
    for _ in range(3):
        error = np.full(len(seen), np.inf)
        error[seen] = np.linalg.norm(camera.project(se3.apply(H_CB, points_B[seen])) - corners_px[seen], axis=1)
        scale = max(sigma_px, 1.4826 * float(np.median(error[inlier])) / np.sqrt(1.386))
        kept = seen & (error < OUTLIER_SIGMAS * scale)
        if kept.sum() < FEWEST_CORNERS or np.array_equal(kept, inlier):
            break
        inlier = kept
        H_CB = _refine(H_CB, corners_px[inlier], points_B[inlier], camera)[0]
    H_CB, J, error_px = _refine(H_CB, corners_px[inlier], points_B[inlier], camera)
    rms_px = float(np.sqrt(np.mean(error_px**2)))
    return BoardPose(H_CB, max(sigma_px, rms_px) ** 2 * np.linalg.inv(J.T @ J), inlier, rms_px)


def _best_pose(corners_px: Array, points_B: Array, camera: Camera) -> Array:
    """The better of the two poses of a plane."""
    start = _from_homography(corners_px, points_B, camera)
    fits = [_refine(candidate, corners_px, points_B, camera) for candidate in (start, _other_reading(start, points_B))]
    return min(fits, key=lambda fit: float(np.sum(fit[2] ** 2)))[0]


def _from_homography(corners_px: Array, points_B: Array, camera: Camera) -> Array:
    ray_C = camera.unproject(corners_px)
    plane = ray_C[:, :2] / ray_C[:, 2:]
    centre = points_B[:, :2].mean(axis=0)
    size = np.abs(points_B[:, :2] - centre).max()
    board = np.column_stack([(points_B[:, :2] - centre) / size, np.ones(len(points_B))])
    zero = np.zeros_like(board)
    A = np.concatenate([np.hstack([board, zero, -plane[:, :1] * board]), np.hstack([zero, board, -plane[:, 1:] * board])])
    G = np.linalg.svd(A)[2][-1].reshape(3, 3)
    G = G / np.mean(np.linalg.norm(G[:, :2], axis=0)) * (1 if G[2, 2] > 0 else -1)
    R = se3.nearest_rotation(np.column_stack([G[:, 0], G[:, 1], np.cross(G[:, 0], G[:, 1])]))
    return se3.transform(R, size * G[:, 2] - R @ np.array([*centre, 0.0]))


def _other_reading(H_CB: Array, points_B: Array) -> Array:
    """The pose whose normal is mirrored at the line of sight to the board's middle."""
    middle_B = points_B.mean(axis=0)
    middle_C = se3.apply(H_CB, middle_B[None])[0]
    sight = middle_C / np.linalg.norm(middle_C)
    normal = H_CB[:3, 2]
    axis = np.cross(normal, sight)
    sine, cosine = np.linalg.norm(axis), normal @ sight
    turn = se3.rotation(axis / max(float(sine), 1e-12) * 2 * np.arctan2(sine, abs(cosine)) * np.sign(cosine))
    R = turn @ H_CB[:3, :3]
    return se3.transform(R, middle_C - R @ middle_B)


def _refine(H_CB: Array, corners_px: Array, points_B: Array, camera: Camera) -> tuple[Array, Array, Array]:
    """Levenberg-Marquardt: H_CB, J (2M, 6) at it, and the residual (M, 2)."""

    def at(H: Array) -> tuple[Array, Array, Array]:
        x_C = se3.apply(H, points_B)
        x_C[:, 2] = np.maximum(x_C[:, 2], 1e-6)
        return x_C, camera.project(x_C) - corners_px, H

    damping = 1e-4
    x_C, error_px, H_CB = at(H_CB)
    J = _jacobian(x_C, camera)
    for _ in range(STEPS):
        normal = J.T @ J
        step = np.linalg.solve(normal + damping * np.diag(np.diag(normal) + 1e-12), -J.T @ error_px.ravel())
        trial = at(se3.exp(step) @ H_CB)
        if np.sum(trial[1] ** 2) <= np.sum(error_px**2):
            x_C, error_px, H_CB = trial
            J, damping = _jacobian(x_C, camera), damping * 0.1
            if np.max(np.abs(step)) < 1e-10:
                break
        else:
            damping *= 10
            if damping > 1e8:
                break
    return H_CB, J, error_px


def _jacobian(x_C: Array, camera: Camera) -> Array:
    return np.asarray(camera.projection_jacobian(x_C) @ se3.point_jacobian(x_C)).reshape(-1, 6)
