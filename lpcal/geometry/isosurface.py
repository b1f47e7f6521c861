"""Marching cubes: the triangles of a grid's zero level; the only module that imports scikit-image."""

from __future__ import annotations

import warnings

import numpy as np

from lpcal.errors import InputError
from lpcal.geometry.arrays import Array, Image, Index


def isosurface(distance: Image) -> tuple[Array, Index]:
    """Vertices (V, 3) in grid steps and faces (F, 3), counter-clockwise seen from where `distance` (I, J, K) is positive.

    Raises
    ------
    InputError
        scikit-image is not installed.
    """
    try:
        from skimage.measure import marching_cubes
    except ImportError as error:
        raise InputError("scikit-image is not installed", where="lpcal", needed="lpcal[fuse]", todo="uv add 'lpcal[fuse]'") from error
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # scikit-image's tables assign to shape, which numpy deprecates
        vertices, faces, _, _ = marching_cubes(distance, 0.0, allow_degenerate=False)
    return vertices.astype(float), np.asarray(faces, dtype=np.intp)
