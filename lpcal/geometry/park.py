r"""Closed-form hand-eye: H_PC and H_OB of ``H_OP[k] H_PC H_CB[k] = H_OB``, plain and among outliers.

Symbols: a_ij = rotation vector of ``R_OP,j^T R_OP,i``, b_ij = that of ``R_CB,j R_CB,i^T``, for which ``a_ij = R_PC b_ij``::

    R_PC = nearest rotation to sum a_ij b_ij^T,      R_OP,k t_PC - t_OB = -R_OP,k R_PC t_CB,k - t_OP,k   (least squares)

Sources: Park & Martin, Robot sensor calibration (1994), the rotation as the orthogonal Procrustes problem of the log pairs; Fischler &
Bolles, Random sample consensus (1981).
"""

from __future__ import annotations

import functools
import itertools
from dataclasses import dataclass

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Index, Mask
from lpcal.kernels.library import kernel

SAMPLES = 400
SAMPLE_VIEWS = 4
ALL_PAIRS_UP_TO = 80
"""Views up to which all pairs are used; beyond, about as many of them."""
ROUNDS = 10
INLIER_SIGMAS = 4.0
ROTATION_FLOOR = 0.02
STRETCHES = 12
"""Stretches of a session, left out one at a time for the doubt of the board's scale: enough that their spread is known within a quarter."""
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
    R_OP, R_CB = H_OP[..., :3, :3], H_CB[..., :3, :3]
    R_PC = _rotations(R_OP, R_CB)
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
    candidates = [_refined(H_OP, H_CB, H_PC[best], H_OB[best]) for best in np.argsort(scores)[:3]]
    return min(candidates, key=lambda found: (found.scatter_m, -int(found.inliers.sum())))


def consensus_of_rotations(H_OP: Array, H_CB: Array, seed: int = 0) -> tuple[Array, Mask] | None:
    """R_PC (3, 3) and the views (N,) that agree with it by their rotations alone; None where fewer than half do.

    Knows nothing of lengths, so that it holds whatever their units.
    """
    count = len(H_OP)
    picks = np.argsort(np.random.default_rng(seed).random((SAMPLES, count)), axis=1)[:, : min(SAMPLE_VIEWS, count)]
    R_OP, R_CB = H_OP[:, :3, :3], H_CB[:, :3, :3]
    R_PC = _rotations(R_OP[picks], R_CB[picks])
    R_OB = se3.nearest_rotation(np.mean(R_OP[picks] @ R_PC[:, None] @ R_CB[picks], axis=1))
    chord = _misses(H_OP, H_CB, *(se3.transform(R, np.zeros(3)) for R in (R_PC, R_OB)))[0]
    best = int(np.argmin(np.median(chord, axis=1)))
    inliers = chord[best] <= max(INLIER_SIGMAS * float(np.median(chord[best])), ROTATION_FLOOR)
    if inliers.sum() < max(3, count / 2):
        return None
    return _rotations(R_OP[inliers], R_CB[inliers]), inliers


def board_scale(H_OP: Array, H_CB: Array, R_PC: Array) -> float:
    """How large the board is by the mocap, over how large it was said to be.

    The translation part with the boards' distances scaled: ``R_OP,k (s R_PC t_CB,k + t_PC) + t_OP,k = t_OB``, robust.
    """
    R_OP = H_OP[:, :3, :3]
    seen = R_OP @ R_PC @ H_CB[:, :3, 3:]
    A = np.concatenate([seen, R_OP, np.broadcast_to(-np.eye(3), R_OP.shape)], axis=2).reshape(-1, 7)
    b = -H_OP[:, :3, 3].ravel()
    weight, x = np.ones(len(H_OP)), np.zeros(7)
    for _ in range(ROUNDS * 2):
        root = np.repeat(np.sqrt(weight), 3)
        x = np.linalg.lstsq(A * root[:, None], b * root, rcond=1e-12)[0]
        miss = np.linalg.norm((A @ x - b).reshape(-1, 3), axis=1)
        spread = max(1.4826 * float(np.median(miss)) / 1.5, 1e-9)
        weight = 1 / (1 + (miss / (3 * spread)) ** 2)
    return float(x[0])


def board_scale_sigma(H_OP: Array, H_CB: Array) -> float:
    """One standard deviation of `board_scale`, by leaving out stretches of the session, one after another.

    Unlike the spread of the residuals it knows of errors that neighbours share and of those of R_PC, which every stretch's absence gives
    again. Source: the delete-d jackknife, Efron & Tibshirani, An introduction to the bootstrap (1993).
    """
    views = np.arange(len(H_OP))
    parts = np.array_split(views, min(STRETCHES, len(views)))
    found = []
    for part in parts:
        rest = np.setdiff1d(views, part)
        found.append(board_scale(H_OP[rest], H_CB[rest], _rotations(H_OP[rest, :3, :3], H_CB[rest, :3, :3])))
    return float(np.sqrt((len(parts) - 1) * np.var(found)))


def residuals(H_OP: Array, H_CB: Array, H_PC: Array, H_OB: Array) -> tuple[Array, Array]:
    """Angle (N,) and distance (N,) of each view's board from H_OB."""
    angle, distance = _residuals(H_OP, H_CB, H_PC[None], H_OB[None])
    return angle[0], distance[0]


@functools.cache
def _pairs(count: int) -> tuple[Index, Index]:
    """First and second views of the pairs."""
    if count <= ALL_PAIRS_UP_TO:
        pairs = list(itertools.combinations(range(count), 2))
    else:
        rng = np.random.default_rng(0)
        strides = rng.permutation(np.arange(1, count // 2))[: max(4, ALL_PAIRS_UP_TO**2 // 2 // count)]
        pairs = [(k, (k + int(stride)) % count) for stride in strides for k in range(count)]
    i, j = np.ascontiguousarray(np.array(pairs).T)
    return i, j


def _rotations(R_OP: Array, R_CB: Array) -> Array:
    i, j = _pairs(R_OP.shape[-3])
    if run := kernel("turns"):
        sums = np.empty((*R_OP.shape[:-3], 3, 3))
        run(sums.size // 9, R_OP.shape[-3], len(i), *(np.ascontiguousarray(R, float) for R in (R_OP, R_CB)), i, j, sums)
        return se3.nearest_rotation(sums)
    a = se3.rotation_vector(np.swapaxes(R_OP[..., j, :, :], -1, -2) @ R_OP[..., i, :, :])
    b = se3.rotation_vector(R_CB[..., j, :, :] @ np.swapaxes(R_CB[..., i, :, :], -1, -2))
    return se3.nearest_rotation(np.swapaxes(a, -1, -2) @ b)


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
    chord, distance = _misses(H_OP, H_CB, H_PC, H_OB)
    return 2 * np.arcsin(np.clip(chord / np.sqrt(8), 0, 1)), distance


def _misses(H_OP: Array, H_CB: Array, H_PC: Array, H_OB: Array) -> tuple[Array, Array]:
    """Chords of the rotations and distances (S, N), as `_residuals`."""
    if run := kernel("misses"):
        chord, distance = np.empty((2, len(H_PC), len(H_OP)))
        run(*chord.shape, *(np.ascontiguousarray(H, float) for H in (H_OP, H_CB, H_PC, H_OB)), chord, distance)
        return chord, distance
    H = H_OP @ H_PC[:, None] @ H_CB
    chord = np.linalg.norm((H[..., :3, :3] - H_OB[:, None, :3, :3]).reshape(*H.shape[:2], 9), axis=-1)
    return chord, np.linalg.norm(H[..., :3, 3] - H_OB[:, None, :3, 3], axis=-1)


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
