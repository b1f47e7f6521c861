"""Images of spheres to what they show, and to the lights."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Literal

import numpy as np
import numpy.typing as npt

from lpcal.api import stacks
from lpcal.api.lights import INTENSITY_STD
from lpcal.api.sensor import BY_CALLER, BY_CAPTURE, BY_LARGEST, Statements, sensor_of_camera, sensor_of_capture, unlike_plain
from lpcal.api.staged import staged
from lpcal.chain.refine_lights import refine_judged
from lpcal.detect.ambient import ambient_changes, refuse_auto_exposure, room_changes
from lpcal.detect.exposures import with_short_exposures
from lpcal.detect.radiometry import to_radiance
from lpcal.detect.spheres import Expected, observe_sphere
from lpcal.errors import InputError
from lpcal.records import given, given_records
from lpcal.records.calibration import Camera, LightsSolution, Lobe, Wings
from lpcal.records.observations import RawCapture, SphereView
from lpcal.records.outcome import Progress, silent
from lpcal.records.sensor import StatedSensor


@staged("sphere")
def find_sphere(
    images: npt.ArrayLike | RawCapture,
    kind: Literal["chrome", "matte"],
    radius_m: float | None = None,
    camera: Camera | None = None,
    *,
    lights: Sequence[str] | None = None,
    ambient: npt.ArrayLike | None = None,
    mask: npt.ArrayLike | None = None,
    hint_px: npt.ArrayLike | None = None,
    distance_m: tuple[float, float] | None = None,
    sensor: StatedSensor | Statements = (),
    name: str = "sphere",
) -> SphereView:
    """Find the one sphere in a capture: its outline, and its highlights (chrome) or its shading (matte).

    Parameters
    ----------
    images : ndarray (L, H, W) or (L, H, W, 3), or RawCapture
        One image a light, as for `reconstruct`.
    kind : str
        What the sphere is like: "chrome" or "matte".
    radius_m : float, optional
        Its radius in metres; without a camera it may be left out.
    camera : Camera, optional
        The camera; without it rays are taken as parallel.
    lights : sequence of str, optional
        Names of the images' lights, in their order; ``L0``, ``L1``, ... by default.
    ambient : ndarray (H, W[, 3]) or (K, H, W[, 3]), optional
        The scene with no light on.
    mask : ndarray (H, W), optional
        Where the sphere is, not zero there.
    hint_px : ndarray (3,), optional
        About where its outline is: x, y, radius in pixels.
    distance_m : (float, float), optional
        Nearest and farthest distance from the camera at which it may be, metres.
    sensor : StatedSensor, or sequence of (str, StatedSensor)
        What is known of the sensor; it counts before what the capture and the camera say. A sequence stands for all that is said, by who
        says it.
    name : str
        What it is called in results and messages.

    Returns
    -------
    SphereView
        Points (K, 2) of its outline and the highlights (2,) by light in pixels, or its linear images; notes.

    Raises
    ------
    InputError, DisagreementError
        Images of another shape; a radius that cannot be right; images that are not linear.
    DegenerateError
        No outline, or not the only one; no highlight; all dark or saturated.

    Examples
    --------
    >>> import lpcal
    >>> rig = lpcal.read_rig("demo")
    >>> images = lpcal.read_capture(rig.folder / "spheres/chrome_0", list(rig.rig.lights))
    >>> view = lpcal.find_sphere(images, "chrome")
    >>> sorted(view.highlights_px)
    ['L0', 'L1', 'L2', 'L3', 'L4', 'L5']
    """
    if kind not in {"chrome", "matte"}:
        raise InputError(repr(kind), where="kind", needed='"chrome" or "matte"')
    if camera is not None and radius_m is None:
        raise InputError("none is given", where="radius_m", needed="the sphere's radius in metres: there is a camera")
    camera = None if camera is None else given_records.camera(camera)
    raw = stacks.capture(images, lights, name=name, ambient=ambient, mask=mask)
    in_use = sensor_of_capture(raw, _saying(sensor, raw, camera))
    used = in_use.sensor
    plain = to_radiance(raw, used)
    by_light = room_changes(plain)
    refuse_auto_exposure(plain, raw, used, by_light)
    changes = [f"left out: {image} is no light's" for image in raw.left_out] + list(ambient_changes(plain, raw, used, by_light))
    own = [f"{raw.name}: sensor: {in_use.document()['in_words']}"] if {BY_CAPTURE, BY_LARGEST} & {*in_use.said_by.values()} else []
    radiance = with_short_exposures(plain, raw, used) if kind == "matte" else plain
    hint = None if hint_px is None else given.shaped(hint_px, (3,), "hint_px")
    view = observe_sphere(radiance, Expected(kind, radius_m, hint, distance_m), camera)
    return replace(
        view,
        notes=(*own, *(f"sphere {raw.name}: {note}" for note in changes), *view.notes),
        image_size=(raw.images.shape[2], raw.images.shape[1]),
    )


def _saying(sensor: StatedSensor | Statements, raw: RawCapture, camera: Camera | None) -> Statements:
    """All that is said of the sensor, what counts more first."""
    if isinstance(sensor, tuple | list) and sensor:
        return sensor
    first = [] if isinstance(sensor, tuple | list) else [(BY_CALLER, given_records.sensor(sensor))]
    own = StatedSensor() if camera is None else unlike_plain(sensor_of_camera(camera))
    return [*first, (BY_CAPTURE, raw.sensor), ("the camera", own)]


@staged("lights")
def refine_lights(
    spheres: Sequence[SphereView],
    lights: Sequence[str],
    camera: Camera | None = None,
    prior: Wings | None = None,
    *,
    intensity_std: float = INTENSITY_STD,
    lobes: Mapping[str, Lobe] | None = None,
    joint: bool = False,
    progress: Progress = silent,
) -> LightsSolution:
    """Refine the lights from views of spheres, with the wings as designed as prior.

    Parameters
    ----------
    spheres : sequence of SphereView
        What `find_sphere` gives, chrome and matte.
    lights : sequence of str
        The names of all lights.
    camera : Camera, optional
        The camera; without it only directions are found, in the axes of C.
    prior : Wings, optional
        The lights as designed, of `design_lights`; lights that are no wings are free.
    intensity_std : float
        Relative standard deviation of a light's intensity beforehand.
    lobes : mapping of str to Lobe, optional
        How lights emit whose maker says so.
    joint : bool
        Whether the camera is solved for too, with what the boards said of it as prior.
    progress : callable, optional
        Called as ``progress(what, done, total)``.

    Returns
    -------
    LightsSolution
        Every light with its source, axis and direction in C (metres, unit vectors), intensity, lobe and standard deviations; what each
        sphere says by itself; warnings.

    Raises
    ------
    DegenerateError
        No sphere; or a light that the data leave undetermined.
    DisagreementError
        Images under each other's names, a sphere of another radius, a moved camera, images that are not linear.
    ConvergenceError
        The lights do not explain the spheres, and no single mistake does.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> from lpcal.records.observations import SphereView
    >>> S = {f"L{k}": np.array([0.5 * np.cos(k), 0.5 * np.sin(k), -1]) / np.sqrt(1.25) for k in range(6)}
    >>> half = {name: (s - [0, 0, 1]) / np.linalg.norm(s - [0, 0, 1]) for name, s in S.items()}
    >>> turn = np.linspace(0, 2 * np.pi, 90)
    >>> outline = [120, 90] + 50 * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    >>> spots = {name: [120, 90] + 50 * n[:2] for name, n in half.items()}
    >>> view = SphereView("ball", "chrome", np.nan, outline, 0.05, spots, dict.fromkeys(S, 0.05))
    >>> found = lpcal.refine_lights([view], list(S))
    >>> bool(min(light.direction_C @ S[light.name] for light in found.lights) > 0.9999)
    True
    """
    if not lights:
        raise InputError("no light", where="lights", needed="the names of all lights")
    unmeasured = [view.name for view in spheres if camera is not None and not np.isfinite(view.radius_m)]
    if unmeasured:
        raise InputError(
            f"no radius of {', '.join(unmeasured)}", where="spheres", needed="every sphere's radius in metres: there is a camera"
        )
    progress("lights", 0, 1)
    found = refine_judged(spheres, lights, camera, prior, intensity_sd=intensity_std, lobes=lobes, free_core=joint)
    progress("lights", 1, 1)
    return found
