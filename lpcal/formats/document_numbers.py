"""Numbers and transforms of lpcal's own documents: of the right count, finite, and rigid where a transform is meant."""

from __future__ import annotations

from typing import Any

import numpy as np

from lpcal.geometry.arrays import Array

RIGID = 1e-3
"""By how much R^T R may differ from the unit matrix: digits that a person cut off, not a scale."""
FARTHEST_M = 1e5
"""Metres beyond which nothing in a room stands from anything else."""


def numbers(document: Any, key: str, *shape: int) -> Array:
    """The finite numbers under a key, of a shape; -1 stands for any count.

    Raises
    ------
    KeyError, ValueError
        The key is lacking, or holds something else; the message is the key's name.
    """
    try:
        found = np.array(document[key], dtype=float)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(key) from error
    if found.shape == (0,) and -1 in shape:  # no rows: how long they would be, YAML does not say
        found = found.reshape([max(side, 0) for side in shape])
    alike = found.ndim == len(shape) and all(side in {-1, own} for side, own in zip(shape, found.shape, strict=True))
    if not alike or not np.isfinite(found).all():
        raise ValueError(key)
    return found


def rigid(document: Any, key: str) -> Array:
    """The transform (4, 4) under a key: a rotation and a translation in metres.

    Raises
    ------
    KeyError, ValueError
        The key is lacking, or holds something else.
    """
    H = numbers(document, key, 4, 4)
    R = H[:3, :3]
    square = np.abs(R).max() < 2 and np.abs(R.T @ R - np.eye(3)).max() < RIGID and np.linalg.det(R) > 0
    if not (square and np.abs(H[3] - [0, 0, 0, 1]).max() < RIGID and np.abs(H[:3, 3]).max() < FARTHEST_M):
        wrong = f"{key} (no rotation and translation)"
        raise ValueError(wrong)
    return H


def covariance(document: Any, key: str, size: int) -> Array:
    """The covariance (size, size) under a key, symmetric, without negative variances.

    Raises
    ------
    KeyError, ValueError
        The key is lacking, or holds something else.
    """
    found = numbers(document, key, size, size)
    if (np.diag(found) < 0).any() or np.abs(found - found.T).max(initial=0) > RIGID * np.abs(found).max(initial=0):
        wrong = f"{key} (no covariance)"
        raise ValueError(wrong)
    return found


def number(document: Any, key: str) -> float | None:
    """The finite number under a key; None where it is null or lacking.

    Raises
    ------
    ValueError
        It holds something else.
    """
    return None if document.get(key) is None else float(numbers(document, key))


def sigma(document: Any, key: str) -> float:
    """The standard deviation under a key; NaN where it is null or lacking.

    Raises
    ------
    ValueError
        It holds something else, or less than 0.
    """
    found = number(document, key)
    if found is not None and found < 0:
        raise ValueError(key)
    return float("nan") if found is None else found
