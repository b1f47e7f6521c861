"""The working volume over which a light's standard deviations are stated, and the directions of points of uncertain place in it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal.geometry.arrays import Array

REACH = 0.1
"""The volume's nine-fold cube of places reaches this share of the focus's distance from the camera to each side: its spread is that of
a cube of even density half as wide as 0.14 of the distance, 5 cm at 35 cm."""


def volume_points(focus_C: Array) -> Array:
    """Places (27, 3) about the focus whose mean is that of the volume."""
    grid = np.stack(np.meshgrid([-1.0, 0.0, 1.0], [-1.0, 0.0, 1.0], [-1.0, 0.0, 1.0], indexing="ij"), axis=-1).reshape(-1, 3)
    return np.asarray(focus_C + REACH * float(np.linalg.norm(focus_C)) * grid)


def direction_std(source_C: Array, covariance: Array, points_C: Array) -> float:
    """Standard deviation a tangent axis (rad), rms over points (N, 3), of the direction to a source (3,) of this covariance (3, 3)."""
    away = source_C - points_C
    r = np.linalg.norm(away, axis=1, keepdims=True)
    d = away / r
    across = np.eye(3) - d[:, :, None] * d[:, None, :]
    variance = np.einsum("nij,jk,nki->n", across, covariance, across) / (2 * r[:, 0] ** 2)
    return float(np.sqrt(variance.mean()))


def level_std(source_C: Array, covariance: Array, seen: Sequence[tuple[Array, Array]], points_C: Array) -> Array:
    """Standard deviation (L,) of each light's log irradiance, rms over points (N, 3), that its source's place leaves.

    A light's level is what makes its shading fit at the blocks that it lights, so a source that is off by e shifts it by minus the mean
    of the shading's change there; what all lights share is the albedo's.

    Parameters
    ----------
    source_C : (L, 3)
    covariance : (3 L, 3 L), joint
    seen : of each light places (M, 3) and unit normals (M, 3) of its blocks; none: its level is not measured
    """
    count = len(source_C)
    change = np.zeros((count, len(points_C), 3 * count))
    for k, (P, n) in enumerate(seen):
        own = slice(3 * k, 3 * k + 3)
        if len(P):
            d, r = _towards(source_C[k], P)
            change[k, :, own] -= np.mean((n / np.sum(n * d, axis=1, keepdims=True) - 3 * d) / r, axis=0)
        d, r = _towards(source_C[k], points_C)
        change[k, :, own] -= 2 * d / r
    change -= change.mean(axis=(0, 1))
    return np.sqrt(np.einsum("knj,ji,kni->kn", change, covariance, change).mean(axis=1))


def _towards(source_C: Array, P_C: Array) -> tuple[Array, Array]:
    """Unit vectors (N, 3) from places to a source, and distances (N, 1)."""
    away = source_C - P_C
    r = np.linalg.norm(away, axis=1, keepdims=True)
    return away / r, r
