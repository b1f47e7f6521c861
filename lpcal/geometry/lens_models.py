"""Lens models other than OpenCV's: mrcal's splined model, and the OpenCV model nearest to any lens.

The splined model is a stereographic core with a grid of corrections, projected by mrcal itself. Symbols: ``lensmodel`` is mrcal's model
name with its configuration, ``spline`` the vector fx fy cx cy and all knots. Source: mrcal's documentation, "splined stereographic".

The nearest OpenCV model: rays x_C (N, 3) through pixels u (N, 2) of the given lens; K and k1 k2 p1 p2 [k3 [k4 k5 k6]] minimise the squared
pixel errors of ``u = project(x_C, K, k)``. Source: mrcal's documentation, "lens model conversion"; as there, without uncertainty.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lpcal.geometry import camera as central
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


COLUMNS = 41
"""Rays sampled across the image: more change no parameter, as lenses are smooth."""
WIDEST = 1.4
"""Angle from the axis, radians, beyond which rays are left out: central projection cannot represent them."""


@dataclass(frozen=True)
class FittedLens:
    """A lens fitted in another model, and the difference of the two over the image."""

    K: Array
    distortion: Array
    rms_px: float
    largest_px: float


def fit_lens(unproject: Callable[[Array], Array], K: Array, image_size: tuple[int, int], count: int, start: Array) -> FittedLens:
    """Fit a lens of `count` distortion coefficients to one that takes pixels (..., 2) to rays (..., 3).

    `K` (3, 3) and `start` (the first coefficients, at most `count`) are the initial values.
    """
    from scipy.optimize import least_squares

    width, height = image_size
    rows = max(2, round(COLUMNS * height / width))
    across, down = np.meshgrid(np.linspace(0, width - 1, COLUMNS), np.linspace(0, height - 1, rows))
    pixels = np.stack([across.ravel(), down.ravel()], axis=1)
    rays = unproject(pixels)
    ahead = np.arctan2(np.linalg.norm(rays[:, :2], axis=1), rays[:, 2]) < WIDEST
    pixels, rays = pixels[ahead], rays[ahead]

    def misses(unknowns: Array) -> Array:
        fx, fy, cx, cy = unknowns[:4] * np.array([K[0, 0], K[1, 1], width, height])
        found = central.project(rays, np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1.0]]), unknowns[4:])
        return np.asarray((found - pixels).ravel())

    first = np.zeros(4 + count)
    first[:4] = 1, 1, K[0, 2] / width, K[1, 2] / height
    first[4 : 4 + min(count, start.size)] = start[:count]
    found = least_squares(misses, first, x_scale="jac", xtol=1e-14, ftol=1e-14, gtol=1e-14)
    fx, fy, cx, cy = found.x[:4] * np.array([K[0, 0], K[1, 1], width, height])
    apart = np.linalg.norm(misses(found.x).reshape(-1, 2), axis=1)
    return FittedLens(np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1.0]]), found.x[4:], float(np.sqrt(np.mean(apart**2))), float(apart.max()))
