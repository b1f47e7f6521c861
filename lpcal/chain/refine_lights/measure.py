r"""What a sphere's outline says of its centre, and how sure that is; what a pixel's residual is in any lens.

Symbols: outline points with scatter s a point (px), radius r (px); a common radial bias b (px, outwards) moves the centre by
``by_bias * b``. To the formal covariance come systematic parts, measured on simulated spheres of known place (`tools/outline_errors.py`)::

    shift an axis   sigma^2 = (floor max(1, (25 / r)^2))^2 + (slope s^2)^2
    bias            sigma^2 = floor^2 + (slope s^2)^2 + (small' q)^2,   q = min(1, (25 / r)^3)
    its mean        matte small q, chrome rim (1 - min(1, r / 47)), beside what all of the kind share

Scatter shows what the edge met besides the sphere's rim: squared, as it takes part of the rays along and is itself seen only in the rest.
They are those of an outline seen all round. Where a part is lacking, bias and shift are hard to separate: they grow with the inverse of
the normal matrix of (1, n) over its normals n. A matte outline's model of the limb does not hold within the blur, which moves it
outwards; a chrome rim mirrors what is behind it in rings whose width is a share of the radius, and so is the bias that they make.
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

LATERAL_PX, LATERAL_SLOPE = {"chrome": 0.025, "matte": 0.010}, {"chrome": 0.75, "matte": 3.8}
"""How far the whole outline is shifted, a standard deviation an axis in pixels: without scatter, and more by the scatter's square. Below
SMALL_PX the first grows, as the rim's features are fewer and within the blur."""
OWN_BIAS_PX, OWN_BIAS_SLOPE = {"chrome": 0.005, "matte": 0.005}, {"chrome": 1.85, "matte": 1.4}
"""How far a sphere's radial bias departs from that of its kind, a standard deviation in pixels, likewise."""
SMALL_PX, SMALL_OWN_PX = 25.0, {"chrome": 0.036, "matte": 0.07}
"""The bias of outlines of this radius (pixels) and less departs by so much more (pixels); that of larger ones by the cube less."""
MATTE_BIAS_PX, RIM_BIAS_PX, RIM_PX = 0.21, 0.31, 47.0
"""A matte outline of SMALL_PX is seen larger by the first figure (pixels); a chrome one smaller by the second from the third on."""
SCATTER_FACTOR = 2.0
"""Neighbouring rays share their errors: so many times the error that points apart would leave."""
STEP = 1e-6


@dataclass(frozen=True)
class OutlineErrors:
    """What an outline is known to be off by, in pixels: mean radial bias, its standard deviation, and that of a shift an axis."""

    bias_px: float
    bias_sd_px: float
    shift_sd_px: float

    def covariance(self, normals: Array, scatter_px: float) -> Array:
        """Covariance (3, 3) of bias and shift, in pixels, of an outline seen where it has these normals (K, 2)."""
        waves = np.column_stack([np.ones(len(normals)), normals])
        lacking = np.linalg.inv(waves.T @ waves / len(normals))
        sd = np.array([self.bias_sd_px, *[self.shift_sd_px / np.sqrt(2)] * 2])
        return np.asarray(lacking * np.outer(sd, sd) + (SCATTER_FACTOR * scatter_px) ** 2 / len(normals) * lacking)


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
    middle = camera.project(centre_C[None])[0]
    outward = (points - middle) / np.linalg.norm(points - middle, axis=1, keepdims=True)
    by_bias = (centre_of(points + STEP * outward) - centre_of(points - STEP * outward)) / (-2 * STEP)
    by_shift = np.stack([(centre_of(points + step) - centre_of(points - step)) / (2 * STEP) for step in STEP * np.eye(2)], axis=1)
    errors = outline_errors(view.kind, float(np.linalg.norm(points - middle, axis=1).mean()), view.outline_sigma_px)
    by_errors = np.column_stack([-by_bias, by_shift])
    covariance = by_errors @ errors.covariance(outward, view.outline_sigma_px) @ by_errors.T
    by_core = np.zeros((3, 0))
    if free_core and core_size(camera):
        ahead, behind = ([centre_of(points, with_core(camera, sign * step)) for step in steps(camera)] for sign in (1, -1))
        by_core = np.subtract(ahead, behind).T / (2 * steps(camera).sum(axis=1))
    return CentreMeasurement(centre_C + errors.bias_px * by_bias, covariance, by_bias, by_core)


def outline_errors(kind: str, radius_px: float, scatter_px: float) -> OutlineErrors:
    """What an outline of this kind, radius and scatter is off by, besides the bias that all of a kind share."""
    small, s2 = min(1.0, (SMALL_PX / radius_px) ** 3), scatter_px**2
    own = np.sqrt(OWN_BIAS_PX[kind] ** 2 + (OWN_BIAS_SLOPE[kind] * s2) ** 2 + (SMALL_OWN_PX[kind] * small) ** 2)
    mean = MATTE_BIAS_PX * small if kind == "matte" else RIM_BIAS_PX * (1 - min(1.0, radius_px / RIM_PX))
    floor = LATERAL_PX[kind] * max(1.0, (SMALL_PX / radius_px) ** 2)
    return OutlineErrors(mean, float(own), float(np.hypot(floor, LATERAL_SLOPE[kind] * s2)))


def local_projection(camera: Camera, u_C: Array) -> Array:
    """Derivative A (..., 2, 3) of the projection at unit rays u_C (..., 3): pixels move by ``A (x / (x . u) - u)``, in any lens."""
    columns = [(camera.project(u_C + step) - camera.project(u_C - step)) / (2 * STEP) for step in STEP * np.eye(3)]
    return np.stack(columns, axis=-1)


def measured_spheres(views: Sequence[SphereView], camera: Camera, *, free_core: bool = False) -> tuple[Measured, dict[str, str]]:
    """The spheres whose outlines give their centres, each with its measurement; and why not, in words, for the others by name."""
    used, refused = [], {}
    for view in views:
        try:
            used.append((view, measure_centre(view, camera, free_core=free_core)))
        except DegenerateError as error:
            refused[view.name] = error.found
    return used, refused
