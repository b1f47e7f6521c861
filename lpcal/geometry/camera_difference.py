"""How far apart two cameras are, in pixels over the imager.

Symbols: p a pixel, v_A(p) its ray in camera A, R a rotation::

    difference(p) = project_B(R v_A(p)) - p,    R the rotation that minimises the sum of squares

Two calibrations from different views differ by a small, meaningless rotation of their frames, which is removed first. Rays are compared at
infinity. Source: mrcal's documentation, "projection difference".
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

STEPS = 12
STEP_RAD = 1e-6


def pixel_grid(image_size: tuple[int, int], columns: int = 40, rows: int = 30) -> Array:
    """Pixels (rows * columns, 2) over the imager, its edges included."""
    u, v = np.meshgrid(np.linspace(0, image_size[0] - 1, columns), np.linspace(0, image_size[1] - 1, rows))
    return np.stack([u.ravel(), v.ravel()], axis=1)


def projection_difference(pixels: Array, rays_C: Array, project: Callable[[Array], Array]) -> tuple[Array, Array]:
    """Projection differences (N, 2), pixels, of one camera's rays (N, 3) in another, and the rotation vector (3,) that was removed."""
    phi = np.zeros(3)

    def difference(turn: Array) -> Array:
        return np.asarray(project(rays_C @ se3.rotation(turn).T) - pixels)

    for _ in range(STEPS):
        error = difference(phi)
        J = np.stack([(difference(phi + STEP_RAD * axis) - error).ravel() / STEP_RAD for axis in np.eye(3)], axis=1)
        step = np.linalg.lstsq(J, -error.ravel(), rcond=None)[0]
        phi = phi + step
        if np.max(np.abs(step)) < 1e-10:
            break
    return difference(phi), phi
