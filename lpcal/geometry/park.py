r"""Closed-form hand-eye: H_PC and H_OB of ``H_OP[k] H_PC H_CB[k] = H_OB``, plain and among outliers.

Symbols: a_ij = rotation vector of ``R_OP,j^T R_OP,i``, b_ij = that of ``R_CB,j R_CB,i^T``, for which ``a_ij = R_PC b_ij``::

    R_PC = nearest rotation to sum a_ij b_ij^T,      R_OP,k t_PC - t_OB = -R_OP,k R_PC t_CB,k - t_OP,k   (least squares)

Sources: Park & Martin, Robot sensor calibration (1994), the rotation as the orthogonal Procrustes problem of the log pairs; Fischler &
Bolles, Random sample consensus (1981).
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask

SAMPLES = 400
SAMPLE_VIEWS = 4
ALL_PAIRS_UP_TO = 80
"""Views up to which all pairs are used; beyond, each with some tens of others."""
ROUNDS = 10
INLIER_SIGMAS = 4.0
FLOOR_M = 2e-4
"""The least scatter that counts as one, so that perfect data have inliers."""


@dataclass(frozen=True)
class Consensus:
    """What a majority of the views agrees on."""

    H_PC: Array
    H_OB: Array
    inliers: Mask
    """(N,)."""
    residual_rad: Array
    """(N,) angle between a view's board and H_OB."""
    residual_m: Array
    """(N,) distance of a view's board from H_OB, at its origin."""
    scatter_m: float
    """Median of the combined residual of all views."""


def park(H_OP: Array, H_CB: Array) -> tuple[Array, Array]:
    """H_PC (..., 4, 4) and H_OB (..., 4, 4) of views H_OP (..., N, 4, 4), H_CB (..., N, 4, 4); leading axes are independent problems."""
    i, j = _pairs(H_OP.shape[-3])
    R_OP, R_CB = H_OP[..., :3, :3], H_CB[..., :3, :3]
    a = se3.rotation_vector(np.swapaxes(R_OP[..., j, :, :], -1, -2) @ R_OP[..., i, :, :])
    b = se3.rotation_vector(R_CB[..., j, :, :] @ np.swapaxes(R_CB[..., i, :, :], -1, -2))
    R_PC = se3.nearest_rotation(np.swapaxes(a, -1, -2) @ b)
    t_PC, t_OB = _translations(H_OP, H_CB, R_PC)
    R_OB = se3.nearest_rotation(np.mean(R_OP @ R_PC[..., None, :, :] @ R_CB, axis=-3))
    return se3.transform(R_PC, t_PC), se3.transform(R_OB, t_OB)


def consensus(H_OP: Array, H_CB: Array, seed: int = 0) -> Consensus:
    """The closed form among outliers: the sample of views whose solution leaves the least median residual, then its inliers, refitted.

    Works up to nearly half of the views wrong. Needs three views or more.
    """
    count = len(H_OP)
    rng = np.random.default_rng(seed)
    size = min(SAMPLE_VIEWS, count)
    picks = np.argsort(rng.random((SAMPLES, count)), axis=1)[:, :size]
    H_PC, H_OB = park(H_OP[picks], H_CB[picks])
    scores = np.median(_combined(*_residuals(H_OP, H_CB, H_PC, H_OB), H_CB), axis=1)
    candidates = [_refined(H_OP, H_CB, H_PC[best], H_OB[best]) for best in np.argsort(scores)[:5]]
    return min(candidates, key=lambda found: (found.scatter_m, -int(found.inliers.sum())))


def residuals(H_OP: Array, H_CB: Array, H_PC: Array, H_OB: Array) -> tuple[Array, Array]:
    """Angle (N,) and distance (N,) of each view's board from H_OB."""
    angle, distance = _residuals(H_OP, H_CB, H_PC[None], H_OB[None])
    return angle[0], distance[0]


def _pairs(count: int) -> tuple[Array, Array]:
    if count <= ALL_PAIRS_UP_TO:
        pairs = list(itertools.combinations(range(count), 2))
    else:
        rng = np.random.default_rng(0)
        strides = rng.permutation(np.arange(1, count // 2))[:40]
        pairs = [(k, (k + int(stride)) % count) for stride in strides for k in range(count)]
    i, j = np.array(pairs).T
    return i, j


def _translations(H_OP: Array, H_CB: Array, R_PC: Array) -> tuple[Array, Array]:
    R_OP = H_OP[..., :3, :3]
    A = np.concatenate([R_OP, np.broadcast_to(-np.eye(3), R_OP.shape)], axis=-1)
    b = -(R_OP @ R_PC[..., None, :, :] @ H_CB[..., :3, 3:])[..., 0] - H_OP[..., :3, 3]
    N = np.sum(np.swapaxes(A, -1, -2) @ A, axis=-3)
    g = np.sum(np.swapaxes(A, -1, -2) @ b[..., None], axis=-3)
    t = (np.linalg.pinv(N, rcond=1e-12, hermitian=True) @ g)[..., 0]
    return t[..., :3], t[..., 3:]


def _residuals(H_OP: Array, H_CB: Array, H_PC: Array, H_OB: Array) -> tuple[Array, Array]:
    """Angles and distances (S, N) of S solutions on N views."""
    H = H_OP @ H_PC[:, None] @ H_CB
    chord = np.linalg.norm((H[..., :3, :3] - H_OB[:, None, :3, :3]).reshape(*H.shape[:2], 9), axis=-1)
    return 2 * np.arcsin(np.clip(chord / np.sqrt(8), 0, 1)), np.linalg.norm(H[..., :3, 3] - H_OB[:, None, :3, 3], axis=-1)


def _combined(angle: Array, distance: Array, H_CB: Array) -> Array:
    """Both residuals as a length: the angle acts over half the board's distance."""
    lever = 0.5 * np.median(np.linalg.norm(H_CB[:, :3, 3], axis=1))
    return np.asarray(np.hypot(distance, lever * angle))


def _refined(H_OP: Array, H_CB: Array, H_PC: Array, H_OB: Array) -> Consensus:
    inliers = np.zeros(len(H_OP), dtype=bool)
    for _ in range(ROUNDS):
        angle, distance = residuals(H_OP, H_CB, H_PC, H_OB)
        combined = _combined(angle, distance, H_CB)
        limit = INLIER_SIGMAS * max(1.4826 * float(np.median(combined)) / 1.5, FLOOR_M)  # the median of a residual of six parts
        found = combined <= limit
        if found.sum() < 3 or np.array_equal(found, inliers):
            break
        inliers = found
        H_PC, H_OB = park(H_OP[inliers], H_CB[inliers])
    angle, distance = residuals(H_OP, H_CB, H_PC, H_OB)
    return Consensus(H_PC, H_OB, inliers, angle, distance, float(np.median(_combined(angle, distance, H_CB))))
