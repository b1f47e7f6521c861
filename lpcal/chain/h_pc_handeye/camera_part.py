"""The camera's share of the likelihood: its prior, its corners as a pinhole with OpenCV's distortion sees them, boards by their other end.

The likelihood knows fx, fy, cx, cy and eight coefficients. A splined camera's corners are carried over to the pinhole of its core,
``q' = K [x/z, y/z]`` of the ray of q; a pixel's error grows by the factor that is returned with them.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.chain.h_pc_handeye.likelihood import CAMERA_SIZE, CameraPrior
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera
from lpcal.records.observations import BoardPoses

NAMES = ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6")
OVERLAP_FLOOR = 0.05
"""The least that is left of a prior whose corners are all counted again here."""
UNKNOWN_FOCAL, SPLINED_FOCAL = 3e-3, 5e-4
"""Relative sigma of focal length and centre (in focal lengths) of a camera of unknown uncertainty, and of a splined one."""
STEP_PX = 0.5
WIDEST = 0.05
"""Least z of a unit ray that a pinhole is asked to see."""


def camera_prior(camera: Camera, share: float = 0.0) -> CameraPrior:
    """The camera's parameters with their covariance as prior.

    `share` of the views were counted in that covariance already: its information is lessened by as much. A camera of unknown
    uncertainty moves in focal length and centre only.
    """
    core = np.array([camera.K[0, 0], camera.K[1, 1], camera.K[0, 2], camera.K[1, 2]])
    coefficients = np.zeros(0) if camera.spline is not None else np.ravel(camera.distortion)
    mean = np.concatenate([core, coefficients, np.zeros(CAMERA_SIZE)])[:CAMERA_SIZE]
    free = np.zeros(CAMERA_SIZE, dtype=bool)
    if camera.spline is None and camera.covariance is not None and set(camera.parameters) <= set(NAMES):
        places = [NAMES.index(name) for name in camera.parameters]
        order = np.argsort(places)
        free[places] = True
        return CameraPrior(mean, free, camera.covariance[np.ix_(order, order)] / max(1 - share, OVERLAP_FLOOR))
    free[:4] = True
    relative = SPLINED_FOCAL if camera.spline is not None else UNKNOWN_FOCAL
    return CameraPrior(mean, free, np.diag(np.full(4, (relative * core[0]) ** 2)))


def as_pinhole(corners_px: Array, camera: Camera) -> tuple[Array, Array | None]:
    """Corners (N, M, 2) for the likelihood's camera, and the factor (N, M) on their errors; None: 1."""
    if camera.spline is None:
        return corners_px.copy(), None
    seen = np.isfinite(corners_px).all(axis=2)
    found, scale = np.full_like(corners_px, np.nan), np.ones(seen.shape)
    beside = corners_px[seen][:, None] + STEP_PX * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])
    ray_C = camera.unproject(beside)
    plane = ray_C[..., :2] / np.maximum(ray_C[..., 2:], WIDEST)
    pixels = plane * [camera.K[0, 0], camera.K[1, 1]] + [camera.K[0, 2], camera.K[1, 2]]
    area = np.abs(np.linalg.det(np.stack([pixels[:, 1] - pixels[:, 2], pixels[:, 3] - pixels[:, 4]], axis=-1))) / (2 * STEP_PX) ** 2
    in_sight = ray_C[:, 0, 2] > WIDEST
    found[seen] = np.where(in_sight[:, None], pixels[:, 0], np.nan)
    scale[seen] = np.sqrt(area)
    return found, scale


def turned_by_half(boards: BoardPoses) -> BoardPoses:
    """Every board found by its other end: the corners in reverse, the frame turned by 180 degrees about the board's middle."""
    assert boards.corners_px is not None
    assert boards.points_B is not None
    H_BB = se3.transform(np.diag([-1.0, -1.0, 1.0]), np.append(boards.points_B[0, :2] + boards.points_B[-1, :2], 0.0))
    return replace(boards, H_CB=boards.H_CB @ H_BB, corners_px=boards.corners_px[:, ::-1])
