"""The working volume over which a light's standard deviations are stated, and the directions of points of uncertain place in it."""

from __future__ import annotations

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


def level_by_source(source_C: Array, points_C: Array) -> Array:
    """Derivative (..., 3) of a light's log irradiance at points (..., 3), on a plane that faces it, by its source's place (..., 3)."""
    d, r = _towards(source_C, points_C)
    return np.asarray(-2 * d / r)


def shading_by_source(source_C: Array, places_C: Array, normals_C: Array) -> Array:
    """Derivative (..., 3) of the log shading at places of unit normals (..., 3), ``n . d / r^2``, by the source's place."""
    d, r = _towards(source_C, places_C)
    return np.asarray((normals_C / np.sum(normals_C * d, axis=-1, keepdims=True) - 3 * d) / r)


def _towards(source_C: Array, P_C: Array) -> tuple[Array, Array]:
    """Unit vectors (..., 3) from places to sources, and distances (..., 1)."""
    away = source_C - P_C
    r = np.linalg.norm(away, axis=-1, keepdims=True)
    return away / r, r
