"""mrcal's splined lens: a stereographic core and a grid of corrections; projection by mrcal itself.

Symbols: ``lensmodel`` mrcal's name of the model with its configuration, ``spline`` the vector fx fy cx cy and all knots.
Source: mrcal's documentation, "splined stereographic".
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array


def project(x_C: Array, lensmodel: str, spline: Array) -> Array:
    """Pixels (..., 2) of points x_C (..., 3)."""
    import mrcal

    return np.asarray(mrcal.project(np.ascontiguousarray(x_C, dtype=float), lensmodel, spline))


def unproject(pixels: Array, lensmodel: str, spline: Array) -> Array:
    """Unit rays (..., 3) of pixels (..., 2)."""
    import mrcal

    return np.asarray(mrcal.unproject(np.ascontiguousarray(pixels, dtype=float), lensmodel, spline, normalize=True))


def projection_jacobian(x_C: Array, lensmodel: str, spline: Array) -> Array:
    """Derivative (..., 2, 3) of `project` by x_C (..., 3)."""
    import mrcal

    return np.asarray(mrcal.project(np.ascontiguousarray(x_C, dtype=float), lensmodel, spline, get_gradients=True)[1])
