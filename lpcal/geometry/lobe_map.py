"""A smooth factor over emission directions on a square grid, for lobes that are not rotationally symmetric.

Symbols: a direction at angle t from the axis and azimuth f has plane coordinates ``(t cos f, t sin f)`` (azimuthal equidistant); the factor
is bilinear between the grid's nodes and constant beyond its edge.
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array, Index


def nodes(reach_rad: float, spacing_rad: float) -> Array:
    """Coordinates (n,) of the grid's nodes along either axis, symmetric, covering at least -reach to reach."""
    count = int(np.ceil(reach_rad / spacing_rad))
    return np.asarray(spacing_rad * np.arange(-count, count + 1), dtype=float)


def corners(angle_rad: Array, around_rad: Array, node_rad: Array) -> tuple[Index, Array]:
    """Indices (..., 4), row by row, of the four nodes about each direction, and their bilinear weights (..., 4)."""
    step, last = node_rad[1] - node_rad[0], len(node_rad) - 1
    places, shares = [], []
    for coordinate in (angle_rad * np.sin(around_rad), angle_rad * np.cos(around_rad)):
        at = np.clip((coordinate - node_rad[0]) / step, 0, last)
        low = np.minimum(at.astype(np.intp), last - 1)
        places.append(low)
        shares.append(at - low)
    (row, column), (v, u) = places, shares
    first = row * (last + 1) + column
    index = np.stack([first, first + 1, first + last + 1, first + last + 2], axis=-1)
    weight = np.stack([(1 - v) * (1 - u), (1 - v) * u, v * (1 - u), v * u], axis=-1)
    return index, weight


def evaluate(angle_rad: Array, around_rad: Array, node_rad: Array, value: Array) -> Array:
    """Factor (...) of directions from values (n, n) at the nodes; rows run along t sin f."""
    index, weight = corners(angle_rad, around_rad, node_rad)
    return np.asarray(np.sum(np.ravel(value)[index] * weight, axis=-1))


def modes(node_rad: Array, sd: float, length_rad: float, least: float) -> Array:
    """Karhunen-Loeve modes (n*n, m) of a Gaussian process over the nodes, each scaled by its standard deviation.

    The process has standard deviation sd and correlation exp(-distance^2 / 2 length^2); it is the modes' sum with standard normal weights.
    Modes of less than `least` of the largest variance are left out.
    """
    variance, along = np.linalg.eigh(np.exp(-0.5 * ((node_rad[:, None] - node_rad) / length_rad) ** 2))
    both = np.outer(variance, variance).ravel()
    kept = np.flatnonzero(both > least * both.max())
    first, second = np.divmod(kept, len(node_rad))
    shape = along[:, None, first] * along[None, :, second]
    return np.asarray(sd * np.sqrt(both[kept]) * shape.reshape(-1, len(kept)))
