"""Bilateral normal integration (Cao et al. 2022, ECCV), written to be read: the peer that lpcal's own integration is held against.

Each pixel's vertical and horizontal slopes are taken from both sides; the side with the larger gap in depth counts less.
"""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import cg

K_OF_SIGMOID, MOST_ROUNDS, ENOUGH, CG_PRECISION = 2.0, 150, 1e-4, 1e-3
AHEAD_BEHIND = ((0, 1), (0, -1)), ((1, 0), (-1, 0))


def depth_of(normals_C: np.ndarray, mask: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Depth (H, W) up to scale of normals (H, W, 3) in C."""
    rows, columns = np.nonzero(mask)
    n = normals_C[mask]
    rays = np.stack([(columns - K[0, 2]) / K[0, 0], (rows - K[1, 2]) / K[1, 1], np.ones(len(rows))], axis=1)
    towards = -np.sum(n * rays, axis=1)
    slopes = [[one_sided(mask, shift, towards * K[axis, axis]) for shift in AHEAD_BEHIND[axis]] for axis in (0, 1)]
    D = sparse.vstack([slope for pair in slopes for slope in pair]).tocsr()
    there = np.asarray(abs(D).sum(axis=1)).ravel() > 0
    right = np.concatenate([n[:, 0], n[:, 0], n[:, 1], n[:, 1]]) * there
    log_z, before = np.zeros(len(n)), np.inf
    share = [np.full(len(n), 0.5), np.full(len(n), 0.5)]
    for _ in range(MOST_ROUNDS):
        weight = np.concatenate([share[0], 1 - share[0], share[1], 1 - share[1]])
        A = (D.T @ D.multiply(weight[:, None])).tocsr()
        diagonal = sparse.diags_array(1 / np.maximum(A.diagonal(), 1e-5))
        log_z, _ = cg(A, D.T @ (weight * right), x0=log_z, M=diagonal, rtol=CG_PRECISION, maxiter=5000)
        share = [sigmoid((behind @ log_z) ** 2 - (ahead @ log_z) ** 2) for ahead, behind in slopes]
        energy = float(np.sum(weight * (D @ log_z - right) ** 2))
        if abs(energy - before) < ENOUGH * before:
            break
        before = energy
    found = np.full(mask.shape, np.nan)
    found[mask] = np.exp(log_z)
    return found


def sigmoid(x: np.ndarray) -> np.ndarray:
    return 1 / (1 + np.exp(-np.clip(K_OF_SIGMOID * x, -50, 50)))


def one_sided(mask: np.ndarray, shift: tuple[int, int], factor: np.ndarray) -> sparse.csr_array:
    """factor times the slope of a map towards one neighbour, rows without that neighbour empty."""
    number = np.full(np.add(mask.shape, 2), -1)
    number[1:-1, 1:-1][mask] = np.arange(mask.sum())
    other = np.roll(number, (-shift[0], -shift[1]), axis=(0, 1))[1:-1, 1:-1][mask]
    here = np.flatnonzero(other >= 0)
    value = sum(shift) * factor[here]
    entries = np.concatenate([value, -value]), (np.concatenate([here, here]), np.concatenate([other[here], here]))
    return sparse.csr_array(entries, shape=(len(other), len(other)))
