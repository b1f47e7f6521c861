r"""What a sphere's outline says of its centre, and how sure that is; what a pixel's residual is in any lens.

Symbols: outline points with scatter s a point (px), radius r (px); a common radial bias b (px, outwards) moves the centre by
``by_bias * b``. To the formal covariance come systematic parts, measured on drawn spheres of known place (`tools/outline_errors.py`)::

    shift an axis   sigma^2 = floor^2 + (slope s^2)^2
    bias            mean small q, sigma^2 = floor^2 + (slope s^2)^2 + (small' q)^2,   q = min(1, (25 / r)^3)

Scatter shows what the edge met besides the sphere's rim: squared, as it takes part of the rays along and is itself seen only in the rest.
A small outline's model of the limb does not hold within the blur, which moves it outwards.
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

LATERAL_PX, LATERAL_SLOPE = {"chrome": 0.045, "matte": 0.010}, {"chrome": 1.3, "matte": 3.8}
"""How far the whole outline is shifted, a standard deviation an axis in pixels: without scatter, and more by the scatter's square."""
OWN_BIAS_PX, OWN_BIAS_SLOPE = {"chrome": 0.010, "matte": 0.005}, {"chrome": 1.5, "matte": 1.4}
"""How far a sphere's radial bias departs from that of its kind, a standard deviation in pixels, likewise."""
SMALL_PX, SMALL_BIAS_PX, SMALL_OWN_PX = 25.0, {"chrome": 0.22, "matte": 0.21}, {"chrome": 0.03, "matte": 0.07}
"""Outlines of this radius and less are seen larger by the second figures (pixels), give or take the third; larger ones by the cube less."""
SCATTER_FACTOR = 2.0
"""Neighbouring rays share their errors: so many times the error that points apart would leave."""
STEP = 1e-6


@dataclass(frozen=True)
class OutlineErrors:
    """What an outline is known to be off by, in pixels: mean radial bias, its standard deviation, and that of a shift an axis."""

    bias_px: float
    bias_sd_px: float
    shift_sd_px: float


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
    errors = outline_errors(view.kind, float(np.linalg.norm(points - middle, axis=1).mean()), view.outline_sigma_px)
    formal = view.outline_sigma_px**2 * np.linalg.inv(J.T @ J * len(points) / len(J))
    covariance = SCATTER_FACTOR**2 * formal + errors.shift_sd_px**2 * by_shift @ by_shift.T
    covariance += errors.bias_sd_px**2 * np.outer(by_bias, by_bias)
    by_core = np.zeros((3, 0))
    if free_core and core_size(camera):
        ahead, behind = ([centre_of(points, with_core(camera, sign * step)) for step in steps(camera)] for sign in (1, -1))
        by_core = np.subtract(ahead, behind).T / (2 * steps(camera).sum(axis=1))
    return CentreMeasurement(centre_C + errors.bias_px * by_bias, covariance, by_bias, by_core)


def outline_errors(kind: str, radius_px: float, scatter_px: float) -> OutlineErrors:
    """What an outline of this kind, radius and scatter is off by, besides the bias that all of a kind share."""
    small, s2 = min(1.0, (SMALL_PX / radius_px) ** 3), scatter_px**2
    own = np.sqrt(OWN_BIAS_PX[kind] ** 2 + (OWN_BIAS_SLOPE[kind] * s2) ** 2 + (SMALL_OWN_PX[kind] * small) ** 2)
    return OutlineErrors(SMALL_BIAS_PX[kind] * small, float(own), float(np.hypot(LATERAL_PX[kind], LATERAL_SLOPE[kind] * s2)))


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
