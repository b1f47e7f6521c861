"""What the stages find: camera, hand-eye, wings, lights, and the calibration that a reconstructor needs.

A covariance of a transform is (6, 6), rotation (rad) first, then translation (m), of the left perturbation ``H = exp(xi) H_mean``.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from lpcal.errors import InputError
from lpcal.geometry import led_cluster, light_field, lobe_map, se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.camera import Camera, CameraSolution, ViewVerdict
from lpcal.records.distance import DistanceSensor
from lpcal.records.evidence import HandEyeEvidence, LightsEvidence
from lpcal.records.lobes import LedCluster, Lobe
from lpcal.records.placement import RoomTracking
from lpcal.records.sensor import StatedSensor
from lpcal.records.shown import Shown
from lpcal.records.sphere_finding import SphereFinding

FURTHER = 1e-3
"""Share of the distance on either side over which a light's change with distance is taken where it has no formula."""

__all__ = [
    "NAMES",
    "Calibration",
    "Camera",
    "CameraSolution",
    "Carries",
    "HandEye",
    "LedCluster",
    "Light",
    "LightsSolution",
    "Lobe",
    "SphereFinding",
    "ViewVerdict",
    "Wing",
    "Wings",
]

Carries = Literal["camera", "board"]
NAMES: dict[Carries, tuple[str, str]] = {"camera": ("H_PC", "H_OB"), "board": ("H_OC", "H_PB")}
"""What the two transforms of a hand-eye solve are, by what the tracked body carries: the camera's place, the board's."""


@dataclass(frozen=True, repr=False)
class HandEye(Shown):
    """H_PC and H_OB with their covariances, the clock offset (t_camera = t_mocap + offset), and what became of each view.

    Where the body `carries` the board, before a camera that stands still in the room, ``H_PC`` holds H_OC, the camera in the room, and
    ``H_OB`` holds H_PB, the board on the body: ``H_PO H_OC H_CB = H_PB`` is the same equation. Files and messages use the names in `names`.

    Parameters
    ----------
    H_PC, H_OB : ndarray (4, 4)
        The camera in the tracked body and the board in the room, metres.
    H_PC_covariance, H_OB_covariance : ndarray (6, 6)
        Rotation (rad) first, then translation (m), of the left perturbation.
    clock_offset_s, clock_offset_std_s : float or None
        ``t_camera = t_mocap + clock_offset_s``, seconds; None where the data cannot show it.
    views : tuple of ViewVerdict
        What became of each view.
    clock_drift, clock_middle_s : float
        By how much the camera's clock runs faster, s/s (0: no drift shows), and the camera's time at which the offset holds, seconds.
    warnings : tuple of str
        What is worth knowing.
    evidence : HandEyeEvidence, optional
        What the solve rests on; None where the transform was not solved for here.
    carries : {"camera", "board"}
        What the tracked body carries.
    taken_offset_s : float
        The clock offset at which the body's poses were taken, where the data do not show it too, seconds.
    misread : bool
        Whether the body's poses turned out to be the inverse of what was stated.

    Examples
    --------
    >>> import lpcal
    >>> session = lpcal.simulate_rig(lpcal.read_rig("robot-camera"), stations=8)
    >>> truth = session.board_truth()
    >>> lpcal.solve_handeye(truth.H_OP, truth.H_CB).names
    ('H_PC', 'H_OB')
    """

    H_PC: Array
    """(4, 4) the camera in the tracked body."""
    H_PC_covariance: Array
    """(6, 6) of `H_PC`."""
    H_OB: Array
    """(4, 4) the board in the room."""
    H_OB_covariance: Array
    """(6, 6) of `H_OB`."""
    clock_offset_s: float | None
    """None: the data cannot show it, or there are no clocks."""
    clock_offset_std_s: float | None
    """Standard deviation of the offset."""
    views: tuple[ViewVerdict, ...]
    clock_drift: float = 0.0
    """By how much the camera's clock runs faster, s/s; the offset holds at the camera's time `clock_middle_s`. 0: no drift shows."""
    clock_middle_s: float = 0.0
    """The time on the camera's clock at which the offset holds, where the rates differ."""
    warnings: tuple[str, ...] = ()
    evidence: HandEyeEvidence | None = None
    """What the solve rests on; None where the transform was not solved for here."""
    carries: Carries = "camera"
    taken_offset_s: float = 0.0
    """The clock offset at which the body's poses were taken, where the data do not show it too."""
    misread: bool = False
    """Whether the body's poses turned out to take the room to the body, or the body to the room where they were stated not to."""

    def mocap_times(self, t_camera_s: Array) -> Array:
        """Times (N,) on the mocap's clock of times (N,) on the camera's, seconds."""
        return np.asarray(t_camera_s - self.clock_drift * (t_camera_s - self.clock_middle_s) - self.taken_offset_s)

    @property
    def position_std_m(self) -> Array:
        """Standard deviation (3,) of the camera's place: of the last column of ``H_PC``, metres."""
        return np.asarray(se3.origin_sigmas(self.H_PC, self.H_PC_covariance))

    @property
    def rotation_std_rad(self) -> Array:
        """Standard deviation (3,) of the turn of ``H_PC``, about the axes of the body, radians."""
        return np.sqrt(np.diag(self.H_PC_covariance)[:3])

    @property
    def names(self) -> tuple[str, str]:
        """What ``H_PC`` and ``H_OB`` are."""
        return NAMES[self.carries]


@dataclass(frozen=True)
class Wing:
    """One wing as designed: ``H_DL = Rz(azimuth) Tx(d1) Ry(-g) Tx(d2)``.

    Parameters
    ----------
    name : str
        The light's name.
    azimuth_rad, joint_angle_rad : float
        The azimuth about the disc's axis, from x towards y, and the joint's angle g, radians.
    d1_m, d2_m : float
        The lever arms from the axis to the joint and from the joint to the blob, metres.
    leds : int, optional
        The blob's LEDs.

    Examples
    --------
    >>> import lpcal, math
    >>> wing = lpcal.Wing("L0", azimuth_rad=0.0, joint_angle_rad=math.radians(30), d1_m=0.104, d2_m=0.085)
    >>> lpcal.design_lights([wing]).H_CL[0, :3, 3].round(4).tolist()
    [0.1776, 0.0, 0.0425]
    """

    name: str
    azimuth_rad: float
    """The wing's azimuth about the disc's axis, from x towards y."""
    joint_angle_rad: float
    """The joint's angle, 0 along the disc."""
    d1_m: float
    """From the disc's axis to the joint."""
    d2_m: float
    """From the joint to the blob."""
    leds: int | None = None


@dataclass(frozen=True, repr=False)
class Wings(Shown):
    """The lights as designed, in C, with the covariance that the tolerances and the frames' errors give them jointly."""

    wings: tuple[Wing, ...]
    """The wings, light by light."""
    H_CD: Array
    """(4, 4) the disc in the camera."""
    H_CD_covariance: Array
    """(6, 6) of `H_CD`."""
    setting_sigma: Array
    """(4,) of azimuth (rad), joint angle (rad), d1 (m), d2 (m)."""
    H_DL: Array
    """(L, 4, 4)."""
    H_CL: Array
    """(L, 4, 4)."""
    covariance: Array
    """(6 L, 6 L) joint, of the left perturbations of H_CL in the lights' order."""
    source_of_H_CD: str = ""
    """Where H_CD comes from, in words."""
    d_object_m: float = float("nan")
    """From the disc's origin to where the lights' axes meet."""

    @property
    def position_std_m(self) -> Array:
        """Standard deviation (L,) of each light's position, an axis, metres."""
        blocks = [self._block(k) for k in range(len(self.wings))]
        return np.array([np.sqrt(np.trace(se3.origin_covariance(H_CL, b)) / 3) for H_CL, b in zip(self.H_CL, blocks, strict=True)])

    @property
    def axis_std_rad(self) -> Array:
        """Standard deviation (L,) of each light's axis, an axis, radians."""
        return np.array([np.sqrt(np.trace(self._block(k)[:3, :3]) / 3) for k in range(len(self.wings))])

    def _block(self, k: int) -> Array:
        return self.covariance[6 * k : 6 * k + 6, 6 * k : 6 * k + 6]


@dataclass(frozen=True, repr=False)
class Light(Shown):
    """One light in C.

    Near: irradiance on a surface at x that faces it is ``intensity * lobe(angle) / |x - source|^2`` with the angle between `axis_C`
    and the ray from the source. Distant (`source_C` None): ``intensity`` everywhere, from `direction_C`.

    Parameters
    ----------
    name : str
        The light's name, which is that of its images.
    direction_C : ndarray (3,)
        Unit vector in C from the focus to the light.
    intensity : ndarray (1,) or (3,)
        Relative; the mean over all lights is 1.
    H_CL : ndarray (4, 4), optional
        The light's mechanical frame: origin at the blob's centre, z its axis of emission.
    source_C, axis_C : ndarray (3,), optional
        The point that its rays seem to come from, metres, and its unit axis of emission; None for a distant light.
    lobe : Lobe
        How its intensity falls with the angle from the axis.
    position_std_m, direction_std_rad, intensity_std : float
        Standard deviations, of position and direction an axis; NaN where they are not known.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> lamp = lpcal.Light("L0", np.array([0, 0, -1.0]), np.ones(1), source_C=np.zeros(3), axis_C=np.array([0, 0, 1.0]))
    >>> direction, irradiance = lamp.field(np.array([0, 0, 0.5]))
    >>> direction.tolist(), irradiance.tolist()
    ([0.0, 0.0, -1.0], [4.0])
    """

    name: str
    direction_C: Array
    """Unit vector from the focus to the light."""
    intensity: Array
    """(1,) or (3,), relative."""
    H_CL: Array | None = None
    source_C: Array | None = None
    """(3,) the point in C that its rays seem to come from; None for a distant light."""
    axis_C: Array | None = None
    """(3,) unit vector of emission in C."""
    lobe: Lobe = field(default_factory=Lobe)
    position_std_m: float = float("nan")
    """Standard deviation of the position, an axis."""
    direction_std_rad: float = float("nan")
    """Standard deviation of the direction, an axis."""
    intensity_std: float = float("nan")
    """Relative standard deviation of the intensity."""

    def extrapolated(self, x_C: Array) -> Mask:
        """Whether points x_C (..., 3) lie in directions from which no sphere showed the light."""
        if self.source_C is None or self.axis_C is None or np.isnan(self.lobe.seen_rad):
            return np.zeros(x_C.shape[:-1], dtype=bool)
        return np.asarray(light_field.near_light(x_C, self.source_C, self.axis_C)[2] > self.lobe.seen_rad)

    def field(self, x_C: Array) -> tuple[Array, Array]:
        """Unit vectors to the light (..., 3) and irradiance (..., C) of surfaces that face it at points x_C (..., 3)."""
        d_C, irradiance = self.unit_field(x_C)
        return d_C, irradiance[..., None] * self.intensity

    def unit_field(self, x_C: Array, *, single: bool = False) -> tuple[Array, Array]:
        """As `field`, the irradiance (...) a unit of intensity; `single`: LEDs in single precision, right to 1e-5 of the light."""
        if self.source_C is None or self.axis_C is None:
            return np.broadcast_to(self.direction_C, x_C.shape), np.broadcast_to(1.0, x_C.shape[:-1])
        if self.lobe.leds is not None and self.H_CL is not None:
            return led_cluster.cluster_field(x_C, *self.lobe.leds.in_C(self.H_CL), single=single)
        d, r, angle = light_field.near_light(x_C, self.source_C, self.axis_C)
        emission = self.lobe(angle)
        if self.lobe.node_rad.size and self.H_CL is not None:
            ray_L = se3.rotate(se3.inv(self.H_CL), -d)
            emission = emission * lobe_map.evaluate(angle, np.arctan2(ray_L[..., 1], ray_L[..., 0]), self.lobe.node_rad, self.lobe.factor)
        return d, emission / r**2

    def slope(self, x_C: Array) -> Array:
        """How its irradiance vector (..., 3) a unit of intensity changes with log distance from C at points x_C (..., 3)."""
        if self.source_C is not None and self.lobe.leds is not None and self.H_CL is not None:
            return led_cluster.cluster_slope(x_C, *self.lobe.leds.in_C(self.H_CL))
        (d, E), (d_near, E_near) = self.unit_field(x_C * (1 + FURTHER)), self.unit_field(x_C * (1 - FURTHER))
        return np.asarray((d * E[..., None] - d_near * E_near[..., None]) / (2 * FURTHER))


@dataclass(frozen=True, repr=False)
class LightsSolution(Shown):
    """The refined lights and what they rest on."""

    lights: tuple[Light, ...]
    """The lights as refined, with their covariances."""
    focus_C: Array
    """(3,) the point in C where the lights' axes nearly meet."""
    d_object_m: float | None
    """From the disc's origin to where the lights' axes meet."""
    H_CD: Array | None
    """(4, 4) the disc in the camera."""
    spheres: tuple[SphereFinding, ...]
    """What became of each sphere, and what it says by itself."""
    warnings: tuple[str, ...] = ()
    """What to look at, in words."""
    evidence: LightsEvidence = field(default_factory=LightsEvidence)
    """What the solve rests on."""
    H_CD_covariance: Array | None = None
    """(6, 6) of `H_CD`."""
    camera: Camera | None = None
    """The camera as the joint solve has it; None: it was taken as it is."""
    H_PC: Array | None = None
    """(4, 4) the camera in the tracked body."""
    H_PC_covariance: Array | None = None
    """The hand-eye transform as the joint solve has it; None: it was taken as it is."""
    H_PD: Array | None = None
    """(4, 4) the disc in the tracked body."""
    H_PD_covariance: Array | None = None
    """The disc in the tracked body, where no markers say it, or as the joint solve has it."""


@dataclass(frozen=True, repr=False)
class Calibration(Shown):
    """All that a reconstructor needs. Without a camera the images are orthographic and all lights distant.

    One without lights holds a camera, its place in the tracked body, or both: it is exported and compared, and reconstructs nothing.

    Parameters
    ----------
    name : str
        What it is called.
    lights : tuple of Light
        The lights, in C.
    camera : Camera, optional
        The camera.
    H_PC : ndarray (4, 4), optional
        The camera in the tracked body, metres.
    d_object_m : float, optional
        The distance of the object from the disc, metres.
    focus_C : ndarray (3,), optional
        The point where the lights' axes meet, metres.
    sensor : StatedSensor
        What is stated of the sensor where there is no camera; else the camera holds it.
    warnings : tuple of str
        Remarks on the file that it was read from.
    origin : str
        The format of another system that it was read from.
    carries : {"camera", "board"}
        What the tracked body carries; where it is the board, ``H_PC`` holds H_OC, the camera in the room.
    tracking : RoomTracking, optional
        How well H_PC, the clocks and the tracked poses are known: what it takes to place a capture in the room.
    distance_sensor : DistanceSensor, optional
        The beam of the panel's distance sensor, in C.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> lights = tuple(lpcal.Light(f"L{k}", np.array([x, 0, -0.8]), np.ones(1)) for k, x in enumerate((0.6, -0.6)))
    >>> [light.name for light in lpcal.Calibration("pair", lights).lights]
    ['L0', 'L1']
    """

    name: str
    lights: tuple[Light, ...]
    camera: Camera | None = None
    H_PC: Array | None = None
    d_object_m: float | None = None
    focus_C: Array | None = None
    sensor: StatedSensor = field(default_factory=StatedSensor)
    """What is stated of the sensor where there is no camera; else the camera holds it."""
    warnings: tuple[str, ...] = ()
    """Remarks on the file that it was read from."""
    origin: str = ""
    """The format of another system that it was read from."""
    carries: Carries = "camera"
    """What the tracked body carries; where it is the board, ``H_PC`` holds H_OC, the camera in the room."""
    tracking: RoomTracking | None = None
    """How well H_PC, the clocks and the tracked poses are known: what it takes to place a capture in the room."""
    distance_sensor: DistanceSensor | None = None

    def with_lights(self) -> Calibration:
        """The calibration, which holds lights.

        Raises
        ------
        InputError
            It holds a camera or its place alone.
        """
        if not self.lights:
            held = " and ".join(["the camera"] * (self.camera is not None) + ["its place"] * (self.H_PC is not None)) or "nothing"
            todo = "calibrate the lights too, or import them"
            raise InputError(f"holds no lights, but {held}", where=f"calibration {self.name}", needed="lights", todo=todo)
        return self

    def of_images(self, size: tuple[int, int]) -> Calibration:
        """The calibration with its camera of the images' (width, height), where the camera's own is guessed; see `Camera.of_images`."""
        return self if self.camera is None else replace(self, camera=self.camera.of_images(size))
