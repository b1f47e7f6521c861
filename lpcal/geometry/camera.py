r"""Central projection with OpenCV's distortion.

Symbols: ``x_C`` a point in C (x right, y down, z forward), ``(x, y) = (X/Z, Y/Z)``, ``r2 = x^2 + y^2``, distortion
``(k1, k2, p1, p2[, k3[, k4, k5, k6]])``, pixel ``u = fx x_d + cx``; pixel centres at whole numbers::

    x_d = x (1 + k1 r2 + k2 r4 + k3 r6) / (1 + k4 r2 + k5 r4 + k6 r6) + 2 p1 x y + p2 (r2 + 2 x^2)
    y_d = y (...)                                                     + p1 (r2 + 2 y^2) + 2 p2 x y

Source: OpenCV, calib3d module documentation.
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.kernels.library import kernel

NEWTON_STEPS = 30
NEWTON_PRECISION = 1e-13


def project(x_C: Array, K: Array, distortion: Array) -> Array:
    """Pixels (..., 2) of points x_C (..., 3) in front of the camera."""
    plane = x_C[..., :2] / x_C[..., 2:]
    return distort(plane, distortion) * [K[0, 0], K[1, 1]] + [K[0, 2], K[1, 2]]


def unproject(pixels: Array, K: Array, distortion: Array) -> Array:
    """Unit rays u_C (..., 3) of pixels (..., 2)."""
    plane = plane_of(pixels, K, distortion)
    ray_C = np.concatenate([plane, np.ones_like(plane[..., :1])], axis=-1)
    return np.asarray(ray_C / np.linalg.norm(ray_C, axis=-1, keepdims=True))


def plane_of(pixels: Array, K: Array, distortion: Array) -> Array:
    """Plane coordinates (..., 2) of pixels (..., 2), undistorted."""
    plane = np.asarray(pixels, dtype=float) - K[:2, 2]
    plane /= K[[0, 1], [0, 1]]
    return undistort(plane, distortion)


def distort(plane: Array, distortion: Array) -> Array:
    """Distorted plane coordinates (..., 2) of undistorted ones (..., 2)."""
    return _distort_with_jacobian(plane, distortion)[0]


def undistort(plane_d: Array, distortion: Array) -> Array:
    """Undistorted plane coordinates (..., 2) of distorted ones (..., 2), by Newton's method from the distorted point."""
    plane = np.array(plane_d, dtype=float, order="C")
    if not np.any(distortion):
        return plane
    if run := kernel("undistort"):
        run(plane.size // 2, np.ascontiguousarray(plane_d, float), _lens(distortion), NEWTON_STEPS, NEWTON_PRECISION, plane)
        return plane
    for _ in range(NEWTON_STEPS):
        found, J = _distort_with_jacobian(plane, distortion)
        x, y = np.moveaxis(plane_d - found, -1, 0)
        determinant = J[..., 0, 0] * J[..., 1, 1] - J[..., 0, 1] * J[..., 1, 0]
        step = np.stack([J[..., 1, 1] * x - J[..., 0, 1] * y, J[..., 0, 0] * y - J[..., 1, 0] * x], axis=-1) / determinant[..., None]
        plane += step
        if np.max(np.abs(step), initial=0.0) < NEWTON_PRECISION:
            break
    return plane


def _lens(distortion: Array) -> Array:
    """The eight coefficients, 0 where there are fewer."""
    return np.concatenate([np.ravel(distortion), np.zeros(8 - np.size(distortion))])


def projection_jacobian(x_C: Array, K: Array, distortion: Array) -> Array:
    """Derivative (..., 2, 3) of `project` by x_C (..., 3)."""
    inverse_z = 1.0 / x_C[..., 2]
    plane = x_C[..., :2] * inverse_z[..., None]
    _, J_distort = _distort_with_jacobian(plane, distortion)
    J_plane = np.zeros((*x_C.shape[:-1], 2, 3))
    J_plane[..., 0, 0] = J_plane[..., 1, 1] = inverse_z
    J_plane[..., :, 2] = -plane * inverse_z[..., None]
    return np.asarray(np.array([K[0, 0], K[1, 1]])[:, None] * (J_distort @ J_plane))


def _distort_with_jacobian(plane: Array, distortion: Array) -> tuple[Array, Array]:
    lens = _lens(distortion)
    if run := kernel("distort"):
        found, J = np.empty(plane.shape), np.empty((*plane.shape, 2))
        run(plane.size // 2, np.ascontiguousarray(plane, float), lens, found, J)
        return found, J
    k1, k2, p1, p2, k3, k4, k5, k6 = lens
    x, y = plane[..., 0], plane[..., 1]
    r2 = x * x + y * y
    above, below = 1 + r2 * (k1 + r2 * (k2 + r2 * k3)), 1 + r2 * (k4 + r2 * (k5 + r2 * k6))
    slope_above, slope_below = k1 + r2 * (2 * k2 + 3 * k3 * r2), k4 + r2 * (2 * k5 + 3 * k6 * r2)
    radial = above / below
    slope = 2 * (slope_above - radial * slope_below) / below  # d radial / d x = slope * x
    x_d = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)
    y_d = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y
    J = np.empty((*x.shape, 2, 2))
    J[..., 0, 0] = radial + slope * x * x + 2 * p1 * y + 6 * p2 * x
    J[..., 0, 1] = J[..., 1, 0] = slope * x * y + 2 * p1 * x + 2 * p2 * y
    J[..., 1, 1] = radial + slope * y * y + 6 * p1 * y + 2 * p2 * x
    return np.stack([x_d, y_d], axis=-1), J
