"""What the stages find: camera, hand-eye, wings, lights, and the calibration that a reconstructor needs.

A covariance of a transform is (6, 6), rotation (rad) first, then translation (m), of the left perturbation ``H = exp(xi) H_mean``.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from lpcal.geometry import camera as central
from lpcal.geometry import led_cluster, light_field, lobe_map, se3, splined
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.tone_curve import Gamma
from lpcal.records.sensor import FlatField, StatedSensor

SIZE_DOUBT = 0.25
"""Share of a guessed image size by which images may differ from it: a principal point lies that close to the middle of a real image."""


@dataclass(frozen=True)
class Camera:
    """Intrinsics and radiometry. ``model`` is opencv4 | opencv5 | opencv8 | splined.

    A splined model has no K and no distortion of its own: K is that of its stereographic core, and `spline` holds mrcal's vector.
    """

    image_size: tuple[int, int]
    model: str
    K: Array
    distortion: Array
    black_level: float = 0.0
    white_level: float = 1.0
    gamma: Gamma = 1.0
    flat_field: FlatField | None = None
    rms_px: float = float("nan")
    """Per coordinate."""
    parameters: tuple[str, ...] = ()
    covariance: Array | None = None
    """(P, P) of `parameters`."""
    lensmodel: str = ""
    """Splined: mrcal's name of the model with its configuration."""
    spline: Array | None = None
    """Splined: mrcal's vector, core and knots."""
    size_guessed: bool = False
    """The image size was made out from the principal point: images of about that size tell the true one."""

    def of_images(self, size: tuple[int, int]) -> Camera:
        """The camera with the images' (width, height) where its own is guessed and theirs is about that; else as it is."""
        near = all(abs(told - own) <= SIZE_DOUBT * own for told, own in zip(size, self.image_size, strict=True))
        return replace(self, image_size=size, size_guessed=False) if self.size_guessed and near else self

    def project(self, x_C: Array) -> Array:
        """Pixels (..., 2) of points x_C (..., 3)."""
        if self.spline is not None:
            return splined.project(x_C, self.lensmodel, self.spline)
        return central.project(x_C, self.K, self.distortion)

    def unproject(self, pixels: Array) -> Array:
        """Unit rays (..., 3) of pixels (..., 2)."""
        if self.spline is not None:
            return splined.unproject(pixels, self.lensmodel, self.spline)
        return central.unproject(pixels, self.K, self.distortion)

    def projection_jacobian(self, x_C: Array) -> Array:
        """Derivative (..., 2, 3) of `project` by x_C (..., 3)."""
        if self.spline is not None:
            return splined.projection_jacobian(x_C, self.lensmodel, self.spline)
        return central.projection_jacobian(x_C, self.K, self.distortion)


@dataclass(frozen=True)
class ViewVerdict:
    """What became of one image in a solve; `why` is None where it was used."""

    image: str
    used: bool
    why: str | None
    residual_px: float | None = None
    residual_m: float | None = None
    residual_rad: float | None = None
    corners: int = 0
    rejected: int = 0
    """Corners that did not fit."""
    blur_px: float | None = None
    """Blur of a board's edges, one sigma."""
    glare: float | None = None
    """Share of a board that is as bright as the image gets."""
    held_out_m: float | None = None
    """What it misses a solve of the other views by."""


@dataclass(frozen=True)
class CameraSolution:
    """The intrinsics solve: the camera, the board's shape, and what became of each view."""

    camera: Camera
    points_B: Array
    """(M, 3) corners of the board with its warp, mean plane z = 0."""
    views: tuple[ViewVerdict, ...]
    solver: str
    """mrcal | opencv."""
    corner_sigma_px: float
    """One standard deviation of a corner coordinate."""
    evidence: dict[str, object] = field(default_factory=dict)
    """How the model was chosen, in figures that go into camera.yaml."""
    warnings: tuple[str, ...] = ()
    cameramodel: str = ""
    """The text of the .cameramodel file, with the optimisation inputs where mrcal solved."""
    H_CB: dict[str, Array] = field(default_factory=dict)
    """The board in the images that were used, by image, as the solve has it."""


Carries = Literal["camera", "board"]
NAMES: dict[Carries, tuple[str, str]] = {"camera": ("H_PC", "H_OB"), "board": ("H_OC", "H_PB")}
"""What the two transforms of a hand-eye solve are, by what the tracked body carries: the camera's place, the board's."""


@dataclass(frozen=True)
class HandEye:
    """H_PC and H_OB with their covariances, the clock offset (t_camera = t_mocap + offset), and what became of each view.

    Where the body `carries` the board, before a camera that stands still in the room, ``H_PC`` holds H_OC, the camera in the room, and
    ``H_OB`` holds H_PB, the board on the body: ``H_PO H_OC H_CB = H_PB`` is the same equation. All that is written bears `names`.
    """

    H_PC: Array
    H_PC_covariance: Array
    H_OB: Array
    H_OB_covariance: Array
    clock_offset_s: float | None
    """None: the data cannot show it, or there are no clocks."""
    clock_offset_std_s: float | None
    views: tuple[ViewVerdict, ...]
    clock_drift: float = 0.0
    """By how much the camera's clock runs faster, s/s; the offset holds at the camera's time `clock_middle_s`. 0: no drift shows."""
    clock_middle_s: float = 0.0
    warnings: tuple[str, ...] = ()
    evidence: dict[str, object] = field(default_factory=dict)
    carries: Carries = "camera"
    taken_offset_s: float = 0.0
    """The clock offset at which the body's poses were taken, where the data do not show it too."""
    misread: bool = False
    """Whether the body's poses turned out to take the room to the body, or the body to the room where they were stated not to."""

    def mocap_times(self, t_camera_s: Array) -> Array:
        """Times (N,) on the mocap's clock of times (N,) on the camera's, seconds."""
        return np.asarray(t_camera_s - self.clock_drift * (t_camera_s - self.clock_middle_s) - self.taken_offset_s)

    @property
    def names(self) -> tuple[str, str]:
        """What ``H_PC`` and ``H_OB`` are."""
        return NAMES[self.carries]


@dataclass(frozen=True)
class Wing:
    """One wing as designed: ``H_DL = Rz(azimuth) Tx(d1) Ry(-g) Tx(d2)``."""

    name: str
    azimuth_rad: float
    joint_angle_rad: float
    d1_m: float
    d2_m: float
    leds: int | None = None


@dataclass(frozen=True)
class Wings:
    """The lights as designed, in C, with the covariance that the tolerances and the frames' errors give them jointly."""

    wings: tuple[Wing, ...]
    H_CD: Array
    H_CD_covariance: Array
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


@dataclass(frozen=True)
class LedCluster:
    """The LEDs of a blob, in its mechanical frame L: power 1 in all on the axis, each with the lobe cos(angle)^exponent."""

    position_L: Array
    """(n, 3) metres."""
    axis_L: Array
    """(n, 3)."""
    power: Array
    """(n,)."""
    exponent: float


@dataclass(frozen=True)
class Lobe:
    """How a light's intensity falls with the angle from its axis, seen from its source; 1 on the axis.

    kind ``isotropic``: constant. ``cosine``: cos(angle)^exponent. ``table``: cubic through (angle_rad, value), 0 beyond the last.
    ``leds``: the sum of `leds`, which is not round; the table then holds its mean over the roll. A table may carry a smooth factor over the
    directions, `factor` (n, n) at the nodes `node_rad` (n,) of `geometry.lobe_map`, in the light's frame.
    """

    kind: str = "isotropic"
    exponent: float = 0.0
    angle_rad: Array = field(default_factory=lambda: np.zeros(0))
    value: Array = field(default_factory=lambda: np.zeros(0))
    leds: LedCluster | None = None
    node_rad: Array = field(default_factory=lambda: np.zeros(0))
    factor: Array = field(default_factory=lambda: np.zeros((0, 0)))
    seen_rad: float = float("nan")
    """Largest angle from the axis at which spheres showed this light: beyond it the lobe is extrapolated. NaN: not known."""

    def __call__(self, angle_rad: Array) -> Array:
        """Relative intensity (...) at angles (...) from the axis."""
        if self.kind == "cosine":
            return light_field.cosine_lobe(angle_rad, self.exponent)
        if self.kind in {"table", "leds"}:
            return light_field.table_lobe(angle_rad, self.angle_rad, self.value)
        return np.ones_like(angle_rad)


@dataclass(frozen=True)
class Light:
    """One light in C.

    Near: irradiance on a surface at x that faces it is ``intensity * lobe(angle) / |x - source|^2`` with the angle between `axis_C`
    and the ray from the source. Distant (`source_C` None): ``intensity`` everywhere, from `direction_C`.
    """

    name: str
    direction_C: Array
    """Unit vector from the focus to the light."""
    intensity: Array
    """(1,) or (3,), relative."""
    H_CL: Array | None = None
    source_C: Array | None = None
    axis_C: Array | None = None
    lobe: Lobe = field(default_factory=Lobe)
    position_std_m: float = float("nan")
    direction_std_rad: float = float("nan")
    intensity_std: float = float("nan")

    def extrapolated(self, x_C: Array) -> Mask:
        """Whether points x_C (..., 3) lie in directions from which no sphere showed the light."""
        if self.source_C is None or self.axis_C is None or np.isnan(self.lobe.seen_rad):
            return np.zeros(x_C.shape[:-1], dtype=bool)
        return np.asarray(light_field.near_light(x_C, self.source_C, self.axis_C)[2] > self.lobe.seen_rad)

    def field(self, x_C: Array) -> tuple[Array, Array]:
        """Unit vectors to the light (..., 3) and irradiance (..., C) of surfaces that face it at points x_C (..., 3)."""
        if self.source_C is None or self.axis_C is None:
            shape = x_C.shape[:-1]
            return np.broadcast_to(self.direction_C, x_C.shape), np.broadcast_to(self.intensity, (*shape, self.intensity.size))
        if self.lobe.leds is not None and self.H_CL is not None:
            leds, H_LC = self.lobe.leds, se3.inv(self.H_CL)
            d_L, irradiance = led_cluster.cluster_field(se3.apply(H_LC, x_C), leds.position_L, leds.axis_L, leds.power, leds.exponent)
            return se3.rotate(self.H_CL, d_L), irradiance[..., None] * self.intensity
        d, r, angle = light_field.near_light(x_C, self.source_C, self.axis_C)
        emission = self.lobe(angle)
        if self.lobe.node_rad.size and self.H_CL is not None:
            ray_L = se3.rotate(se3.inv(self.H_CL), -d)
            emission = emission * lobe_map.evaluate(angle, np.arctan2(ray_L[..., 1], ray_L[..., 0]), self.lobe.node_rad, self.lobe.factor)
        return d, (emission / r**2)[..., None] * self.intensity


@dataclass(frozen=True)
class SphereFinding:
    """What one sphere says by itself."""

    name: str
    kind: str
    centre_C: Array | None
    radius_m: float | None
    used: bool
    why: str | None
    directions_C: dict[str, Array] = field(default_factory=dict)
    """Chrome: unit vector from the sphere's highlight towards each light."""
    residual: float = float("nan")
    """Chrome: highlight rms in px; matte: shading rms as a fraction."""
    outline_px: Array = field(default_factory=lambda: np.zeros((0, 2)))
    """(K, 2) points of the outline as it was found in the images."""
    highlights_px: dict[str, Array] = field(default_factory=dict)
    """Chrome: where (2,) each light's mirror image was found."""
    image_size: tuple[int, int] | None = None
    """Of its images."""


@dataclass(frozen=True)
class LightsSolution:
    """The refined lights and what they rest on."""

    lights: tuple[Light, ...]
    focus_C: Array
    d_object_m: float | None
    H_CD: Array | None
    spheres: tuple[SphereFinding, ...]
    warnings: tuple[str, ...] = ()
    evidence: dict[str, object] = field(default_factory=dict)
    H_CD_covariance: Array | None = None
    camera: Camera | None = None
    """The camera as the joint solve has it; None: it was taken as it is."""
    H_PC: Array | None = None
    H_PC_covariance: Array | None = None
    """The hand-eye transform as the joint solve has it; None: it was taken as it is."""
    H_PD: Array | None = None
    H_PD_covariance: Array | None = None
    """The disc in the tracked body, where no markers say it, or as the joint solve has it."""


@dataclass(frozen=True)
class Calibration:
    """All that a reconstructor needs. Without a camera the images are orthographic and all lights distant."""

    name: str
    lights: tuple[Light, ...]
    camera: Camera | None = None
    H_PC: Array | None = None
    d_object_m: float | None = None
    focus_C: Array | None = None
    sensor: StatedSensor = field(default_factory=StatedSensor)
    """What is stated of the sensor where there is no camera; else the camera holds it."""
    warnings: tuple[str, ...] = ()
    """What is to be said of the file that it comes from, in words."""

    def of_images(self, size: tuple[int, int]) -> Calibration:
        """The calibration with its camera of the images' (width, height), where the camera's own is guessed; see `Camera.of_images`."""
        return self if self.camera is None else replace(self, camera=self.camera.of_images(size))
