"""What the report is made from: the stages' records as read, and what was written for each object."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.body_course import BodyCourse
from lpcal.records.calibration import Calibration, HandEye, Light, LightsSolution, Wings
from lpcal.records.camera import Camera, CameraSolution
from lpcal.records.distance import SensorSolution
from lpcal.records.observations import BoardPoses
from lpcal.records.provenance import Provenance
from lpcal.records.surface import SurfaceSummary

KINDS = ("camera", "H_CB", "H_OP", "handeye", "wings", "distance", "lights", "calibration")
"""The documents in the chain's order, by kind; each stands in calib/ under its kind's name."""
PARTS = {
    "camera": ("camera", "H_CB"),
    "handeye": ("H_OP", "handeye"),
    "wings": ("wings",),
    "lights": ("calibration",),
    "spheres": ("lights",),
    "surfaces": (),
}
"""What a rig may have and need not, each with the kinds of document that stand for it."""
LACKING = {
    "camera": "a camera whose lens is known",
    "handeye": "motion capture",
    "wings": "wings whose setting is stated",
    "lights": "lights",
    "spheres": "spheres",
    "surfaces": "objects",
}
"""What each part is called where a rig goes without it."""
OPTIONAL = "distance"
"""The document that most rigs do not have: it is not missed."""


@dataclass(frozen=True)
class SurfaceReport:
    """One reconstructed object: its summary, small PNG pictures by what they show, and the relighting page beside the report."""

    name: str
    summary: SurfaceSummary = field(default_factory=SurfaceSummary)
    pictures: Mapping[str, bytes] = field(default_factory=dict)
    relight: str | None = None


@dataclass(frozen=True)
class RigReport:
    """A rig's name, what its stages found (None where one has not run), what each was made from, and its surfaces."""

    name: str
    camera: CameraSolution | None = None
    boards: BoardPoses | None = None
    """H_CB.yaml."""
    body_poses: Mapping[str, Array] | None = None
    """H_OP.yaml: the tracked body (4, 4) at each image that has a pose to trust."""
    course: BodyCourse | None = None
    """The tracked body over the recording; None where its poses came without one."""
    image_times_s: Mapping[str, float] = field(default_factory=dict)
    """On the camera's clock, of the images that have a time."""
    handeye: HandEye | None = None
    wings: Wings | None = None
    distance: SensorSolution | None = None
    """The panel's distance sensor."""
    lights: LightsSolution | None = None
    calibration: Calibration | None = None
    provenance: Mapping[str, Provenance] = field(default_factory=dict)
    """By kind, of the documents that there are."""
    surfaces: tuple[SurfaceReport, ...] = ()
    lacks: frozenset[str] = frozenset()
    """Parts (of PARTS) that the rig does not have: nothing is missed where they would stand."""

    def left_out(self, part: str) -> bool:
        """Whether a part does not belong to this rig and nothing was found for it either."""
        there = {
            "camera": self.lens,
            "handeye": self.handeye,
            "wings": self.wings,
            "lights": self.shown_lights,
            "spheres": self.lights and self.lights.spheres,
            "surfaces": self.surfaces,
        }
        return part in self.lacks and not there[part]

    @property
    def lens(self) -> Camera | None:
        """The camera as solved or read, or the one of an imported calibration; None for a rig that has none."""
        if self.camera is not None:
            return self.camera.camera
        return None if self.calibration is None else self.calibration.camera

    @property
    def placed(self) -> LightsSolution | Calibration | None:
        """What the lights stand in: refined, or exported or imported; None where they are designed at most."""
        return self.lights or self.calibration

    @property
    def focus_C(self) -> Array | None:
        """Where the lights' axes meet; None where they are distant, as directions meet nowhere."""
        found = self.placed
        near = found is not None and any(light.source_C is not None for light in found.lights)
        return found.focus_C if found is not None and near else None

    @property
    def shown_lights(self) -> tuple[Light, ...]:
        """The lights as refined or imported, else as designed."""
        if self.placed is not None:
            return self.placed.lights
        return () if self.wings is None else designed(self.wings)

    @property
    def intensities_measured(self) -> bool:
        """Whether the lights' intensities are more than a stand-in of 1: matte spheres showed them, or an import states them."""
        lights = () if self.placed is None else self.placed.lights
        if any(np.any(light.intensity != 1.0) for light in lights):
            return True
        if self.lights is not None:
            return any(sphere.used and sphere.kind == "matte" for sphere in self.lights.spheres)
        return self.wings is None and any(np.isfinite(light.intensity_std) for light in lights)


def designed(wings: Wings) -> tuple[Light, ...]:
    """The lights of the drawing, each where its blob is and along its axis."""
    return tuple(
        Light(wing.name, -H_CL[:3, 2], np.ones(1), H_CL=H_CL, axis_C=H_CL[:3, 2])
        for wing, H_CL in zip(wings.wings, wings.H_CL, strict=True)
    )


def sigmas(covariance: Array | None, size: int) -> Array:
    """Standard deviations (size,) of a covariance; NaN where there is none."""
    if covariance is None:
        return np.full(size, np.nan)
    return np.sqrt(np.maximum(np.diag(covariance), 0))


def origin_sigmas(H: Array, covariance: Array | None) -> Array:
    """Standard deviations (6,) of a rotation (rad) and of the origin (m), from the covariance (6, 6) of the left perturbation.

    NaN where there is no covariance.
    """
    if covariance is None:
        return np.full(6, np.nan)
    J = se3.turn_and_origin_jacobian(H)
    return sigmas(J @ covariance @ J.T, 6)
