"""Lights: as the panel's drawing has them, as a calibration holds them, and what they do at a point."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from lpcal.api.tracking import tracking_of
from lpcal.chain.h_pl_wings import design_lights as wings_of
from lpcal.chain.refine_lights import as_designed
from lpcal.errors import InputError
from lpcal.geometry.arrays import Array
from lpcal.records import given, given_records
from lpcal.records.calibration import Calibration, Camera, HandEye, Light, LightsSolution, Wing, Wings
from lpcal.records.distance import DistanceSensor, SensorSolution
from lpcal.records.light_field import LightField
from lpcal.records.rig import LightSection, PanelSection, Rig, RigFile, Tolerance
from lpcal.records.sensor import StatedSensor

AS_DRAWN = "the camera's place as drawn"
"""Where H_CD comes from, in words, where no mocap gives it."""
DRAWN = Tolerance()
"""The tolerance of wings that come without a panel: what panel.yaml takes where it states none."""
INTENSITY_STD = 0.10
"""Relative standard deviation of a light's intensity before anything is measured: LEDs of one lot differ so much."""


def design_lights(
    wings: Rig | RigFile | Sequence[Wing],
    H_CD: npt.ArrayLike | None = None,
    *,
    H_CD_covariance: npt.ArrayLike | None = None,
    setting_std: tuple[float, float, float, float] | None = None,
    source: str = "the caller",
) -> Wings:
    """Place every light as the panel's drawing has it, with the joint covariance of the tolerances.

    Parameters
    ----------
    wings : Rig, RigFile, or sequence of Wing
        The wings' settings: azimuth and joint angle in radians, lever arms d1 and d2 in metres.
    H_CD : ndarray (4, 4), optional
        The disc in the camera, metres; by default the camera's place as the rig draws it, or the disc's own frame.
    H_CD_covariance : ndarray (6, 6), optional
        Its covariance, rotation (rad) first, then translation (m), of the left perturbation; all lights share it.
    setting_std : (float, float, float, float), optional
        Standard deviations of azimuth (rad), joint angle (rad), d1 and d2 (m); by default the rig's tolerance.
    source : str
        Where `H_CD` comes from, in words.

    Returns
    -------
    Wings
        H_CL (L, 4, 4) of every light, with the joint covariance (6 L, 6 L), and the distance at which the axes meet.

    Raises
    ------
    InputError
        `H_CD` is no rigid transform.
    DegenerateError
        There is no wing.

    Examples
    --------
    >>> import lpcal
    >>> wings = lpcal.design_lights(lpcal.read_rig("lightpanel-6"))
    >>> wings.H_CL.shape, round(wings.d_object_m, 3)
    ((6, 4, 4), 0.35)
    """
    rig = wings.rig if isinstance(wings, RigFile) else wings
    if isinstance(rig, Rig):
        panel = rig.panel
        settings = [] if panel is None else [wing_of(name, light, panel) for name, light in rig.lights.items() if light.is_wing]
        tolerance = DRAWN if panel is None else panel.tolerance
        place, place_covariance = as_drawn(panel)
    else:
        settings, tolerance, (place, place_covariance) = list(rig), DRAWN, as_drawn(None)
    if H_CD is not None:
        place = given.transforms(np.asarray(H_CD)[None], "H_CD")[0]
        place_covariance = np.zeros((6, 6)) if H_CD_covariance is None else given.shaped(H_CD_covariance, (6, 6), "H_CD_covariance")
    usual = (tolerance.azimuth, tolerance.joint_angle, tolerance.length, tolerance.length)
    sigma = given.shaped(usual if setting_std is None else setting_std, (4,), "setting_std")
    return wings_of(settings, place, place_covariance, sigma, source if H_CD is not None else AS_DRAWN)


def wing_of(name: str, light: LightSection, panel: PanelSection) -> Wing:
    """The kinematic setting of a light section that is a wing."""
    azimuth, joint_angle, disc_spacer, blob_spacer = light.azimuth, light.joint_angle, light.disc_spacer, light.blob_spacer
    if azimuth is None or joint_angle is None or disc_spacer is None or blob_spacer is None:
        raise InputError("is no wing", where=f"lights.{name}", needed="azimuth, joint_angle, disc_spacer and blob_spacer")
    return Wing(
        name=name,
        azimuth_rad=azimuth,
        joint_angle_rad=joint_angle,
        d1_m=panel.disc_radius + disc_spacer + panel.joint,
        d2_m=panel.joint + blob_spacer + panel.blob,
        leds=light.leds,
    )


def as_drawn(panel: PanelSection | None) -> tuple[Array, Array]:
    """H_CD and its covariance of a camera that stands in the disc as the drawing has it."""
    H_CD = np.eye(4)
    if panel is None:
        return H_CD, np.zeros((6, 6))
    sigma_m, sigma_rad = panel.camera.tolerance
    H_CD[:3, 3] = -np.array(panel.camera.position)
    return H_CD, np.diag([sigma_rad**2] * 3 + [sigma_m**2] * 3)


def assemble_calibration(
    lights: LightsSolution | Wings,
    camera: Camera | None = None,
    *,
    H_PC: npt.ArrayLike | HandEye | None = None,
    intensity_std: float = INTENSITY_STD,
    sensor: StatedSensor | None = None,
    distance_sensor: DistanceSensor | SensorSolution | None = None,
    name: str = "rig",
) -> Calibration:
    """Assemble the calibration that `reconstruct` needs from what the stages found.

    Parameters
    ----------
    lights : LightsSolution or Wings
        The lights as refined, or as designed.
    camera : Camera, optional
        The camera; where the lights were refined jointly with it, that one counts. Without it images are orthographic.
    H_PC : HandEye, or ndarray (4, 4), optional
        What `solve_handeye` found; or the camera in the tracked body, metres, alone.
    intensity_std : float
        Relative standard deviation of an intensity that was not measured.
    sensor : StatedSensor, optional
        What is known of the sensor, where there is no camera to hold it.
    distance_sensor : SensorSolution or DistanceSensor, optional
        The panel's distance sensor, of `calibrate_distance_sensor`.
    name : str
        The calibration's name.

    Returns
    -------
    Calibration
        Camera, lights, the working distance and the point where the lights' axes meet, metres in C; the lights' warnings.

    Raises
    ------
    InputError
        `H_PC` is no rigid transform.

    Examples
    --------
    >>> import lpcal
    >>> wings = lpcal.design_lights(lpcal.read_rig("lightpanel-6"))
    >>> [light.name for light in lpcal.assemble_calibration(wings, name="as drawn").lights][:2]
    ['L0', 'L1']
    """
    if isinstance(lights, Wings):
        lights = as_designed(lights, [wing.name for wing in lights.wings], intensity_std)
    camera = lights.camera or camera
    handeye = H_PC if isinstance(H_PC, HandEye) else None
    matrix = H_PC.H_PC if isinstance(H_PC, HandEye) else H_PC
    place = None if matrix is None else given.transforms(np.asarray(matrix)[None], "H_PC")[0]
    return Calibration(
        name=name,
        lights=lights.lights,
        camera=camera,
        H_PC=place if lights.H_PC is None else lights.H_PC,
        d_object_m=lights.d_object_m,
        focus_C=lights.focus_C if camera is not None else None,
        sensor=StatedSensor() if camera is not None or sensor is None else sensor,
        warnings=lights.warnings,
        carries="camera" if handeye is None else handeye.carries,
        tracking=None if handeye is None else tracking_of(handeye, lights),
        distance_sensor=distance_sensor.sensor if isinstance(distance_sensor, SensorSolution) else distance_sensor,
    )


FAR = 100.0
"""Distances of the lights from the camera beyond which points are taken to be in another unit than metres."""


def _far(lights: Sequence[Light], points: Array) -> list[str]:
    """In words, where points (..., 3) are far out of the lights' reach, as millimetres taken for metres are."""
    near = [light.source_C for light in lights if light.source_C is not None]
    if not near or not points.size:
        return []
    reach = float(np.median(np.linalg.norm(near, axis=1)))
    away = float(np.median(np.linalg.norm(points, axis=-1)))
    if away < FAR * max(reach, 1e-3):
        return []
    return [f"the points are {away:.4g} m from the camera, the lights {reach:.3g} m: are they in millimetres? x_m, y_m and z_m are metres"]


def light_field(lights: Calibration | LightsSolution | Sequence[Light], x_C: npt.ArrayLike) -> LightField:
    """Evaluate the calibrated light field at points.

    Parameters
    ----------
    lights : Calibration, LightsSolution, or sequence of Light
        The lights.
    x_C : ndarray (..., 3)
        Points in C, metres.

    Returns
    -------
    LightField
        A light (first axis) and a point: unit vectors to the light (L, ..., 3) in C, irradiance (L, ..., channels) on a surface that faces
        it, relative on one scale for all lights; and where the lobe is extrapolated (L, ...), with a warning for each such light.

    Raises
    ------
    InputError
        Points of another shape, or not finite.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> lamp = lpcal.Light("L0", np.array([0, 0, -1.0]), np.ones(1), source_C=np.zeros(3), axis_C=np.array([0, 0, 1.0]))
    >>> field = lpcal.light_field([lamp], [[0, 0, 0.5], [0, 0, 1.0]])
    >>> field.irradiance[0, :, 0].tolist()
    [4.0, 1.0]
    """
    each = given_records.lights(lights if isinstance(lights, Sequence) else lights.lights)
    points = given.numbers(x_C, "x_C")
    if points.shape[-1:] != (3,):
        raise InputError(f"an array of {points.shape}", where="x_C", needed="points (..., 3) in metres")
    if not each:
        raise InputError("no light", where="lights", needed="one at least")
    fields = [light.field(points) for light in each]
    beyond = [light.extrapolated(points) for light in each]
    channels = max(light.intensity.size for light in each)
    warnings = [
        f"{light.name}: extrapolated at {int(one.sum())} points, more than {np.degrees(light.lobe.seen_rad):.1f} deg from its axis: "
        "no sphere was there"
        for light, one in zip(each, beyond, strict=True)
        if one.any()
    ]
    warnings += _far(each, points)
    return LightField(
        names=tuple(light.name for light in each),
        direction_C=np.stack([direction for direction, _ in fields]),
        irradiance=np.stack([np.broadcast_to(irradiance, (*points.shape[:-1], channels)) for _, irradiance in fields]),
        extrapolated=np.stack(beyond),
        warnings=tuple(warnings),
    )
