"""What a sphere's outline says of its centre, and how sure that is; what a pixel's residual is in any lens.

Symbols: outline points with scatter sigma a point; a common radial bias b (px, outwards) moves the centre by ``by_bias * b``. To the
formal covariance come systematic parts that the scatter does not show: the whole outline shifted, and its bias. How large they are the
outline itself tells: what mirrors or hides it unevenly also bends it, and the bends of two to six waves round it (which no sphere has) are
about as large as the shift, of one wave, that cannot be told from the sphere's place.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from lpcal.chain.refine_lights.free_camera import core_size, steps, with_core
from lpcal.errors import DegenerateError
from lpcal.geometry import sphere
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera
from lpcal.records.observations import SphereView

LATERAL_PX = {"chrome": 0.05, "matte": 0.03}
OWN_BIAS_PX = {"chrome": 0.015, "matte": 0.02}
SCATTER_FACTOR = 2.0
WAVES = (2, 3, 4, 5, 6)
STEP = 1e-6


@dataclass(frozen=True)
class CentreMeasurement:
    """Centre (3,) of a sphere from its outline alone, its covariance (3, 3), and its derivative (3,) by the outline's bias (m a px)."""

    centre_C: Array
    covariance: Array
    by_bias: Array
    by_core: Array = field(default_factory=lambda: np.zeros((3, 0)))
    """(3, P) by the camera's parameters, where these are to be solved for too."""


type Measured = list[tuple[SphereView, CentreMeasurement]]
"""Spheres, each with the measurement of its centre."""


def measure_centre(view: SphereView, camera: Camera, *, free_core: bool = False) -> CentreMeasurement:
    """The centre of a sphere from its outline; `free_core`: and how it moves with the camera's parameters.

    Raises
    ------
    DegenerateError
        The outline is not that of a sphere of this radius before the camera.
    """
    points = view.outline_px

    def centre_of(moved: Array, lens: Camera = camera) -> Array:
        return sphere.from_outline(lens.unproject(moved), view.radius_m)

    try:
        centre_C = centre_of(points)
    except ValueError as error:
        raise DegenerateError(str(error), where=f"sphere {view.name}", todo="check its radius in panel.yaml") from error
    middle = points.mean(axis=0)
    outward = (points - middle) / np.linalg.norm(points - middle, axis=1, keepdims=True)
    by_bias = (centre_of(points + STEP * outward) - centre_of(points - STEP * outward)) / (-2 * STEP)
    by_shift = np.stack([(centre_of(points + step) - centre_of(points - step)) / (2 * STEP) for step in STEP * np.eye(2)], axis=1)
    J = normal_offset_jacobian(centre_C, view.radius_m, camera)
    bend_px = _bend(points, camera.project(sphere.outline(centre_C, view.radius_m, np.linspace(0, 2 * np.pi, 720, endpoint=False))))
    lateral_px, bias_px = max(LATERAL_PX[view.kind], bend_px), max(OWN_BIAS_PX[view.kind], bend_px / 2)
    formal = view.outline_sigma_px**2 * np.linalg.inv(J.T @ J * len(points) / len(J))
    covariance = SCATTER_FACTOR**2 * formal + lateral_px**2 * by_shift @ by_shift.T + bias_px**2 * np.outer(by_bias, by_bias)
    by_core = np.zeros((3, 0))
    if free_core and core_size(camera):
        ahead, behind = ([centre_of(points, with_core(camera, sign * step)) for step in steps(camera)] for sign in (1, -1))
        by_core = np.subtract(ahead, behind).T / (2 * steps(camera).sum(axis=1))
    return CentreMeasurement(centre_C, covariance, by_bias, by_core)


def _bend(points: Array, drawn: Array) -> float:
    """Amplitude (px, rms of a sine) of the outline's departure from the drawn one, over waves that no sphere has."""
    middle = drawn.mean(axis=0)
    seen, true = points - middle, drawn - middle
    around, true_around = np.arctan2(seen[:, 1], seen[:, 0]), np.arctan2(true[:, 1], true[:, 0])
    offset = np.linalg.norm(seen, axis=1) - np.interp(around, true_around, np.linalg.norm(true, axis=1), period=2 * np.pi)
    low = np.column_stack([np.ones_like(around), np.cos(around), np.sin(around)])
    bends = np.column_stack([wave(k * around) for k in WAVES for wave in (np.cos, np.sin)])
    found = np.linalg.lstsq(np.hstack([low, bends]), offset, rcond=None)[0][3:]
    return float(np.sqrt(np.mean(found**2)))


def normal_offset_jacobian(centre_C: Array, radius_m: float, camera: Camera) -> Array:
    """How the outline's points move along their normals (K, 3), in pixels a metre of the centre."""
    around = np.linspace(0, 2 * np.pi, 120, endpoint=False)

    def drawn(centre: Array) -> Array:
        return camera.project(sphere.outline(centre, radius_m, around))

    points = drawn(centre_C)
    tangent = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1) / np.linalg.norm(tangent, axis=1, keepdims=True)
    normal *= np.sign(np.sum(normal * (points - points.mean(axis=0)), axis=1, keepdims=True))
    step = STEP * np.linalg.norm(centre_C)
    columns = [np.sum((drawn(centre_C + step * axis) - drawn(centre_C - step * axis)) * normal, axis=1) / (2 * step) for axis in np.eye(3)]
    return np.stack(columns, axis=1)


def local_projection(camera: Camera, u_C: Array) -> Array:
    """Derivative A (..., 2, 3) of the projection at unit rays u_C (..., 3): pixels move by ``A (x / (x . u) - u)``, in any lens."""
    columns = [(camera.project(u_C + step) - camera.project(u_C - step)) / (2 * STEP) for step in STEP * np.eye(3)]
    return np.stack(columns, axis=-1)


def measured_spheres(views: Sequence[SphereView], camera: Camera, *, free_core: bool = False) -> tuple[Measured, dict[str, str]]:
    """The spheres whose centres their outlines tell, each with its measurement; and why, in words, of the others by name."""
    used, refused = [], {}
    for view in views:
        try:
            used.append((view, measure_centre(view, camera, free_core=free_core)))
        except DegenerateError as error:
            refused[view.name] = error.found
    return used, refused
