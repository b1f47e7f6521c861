"""Images of a capture, or normals from elsewhere, to a surface and its mesh.

Whether a capture's own images contradict its calibration: a light that shines otherwise than it says.

Symbols: s_l signal of light l, rho albedo, E_l its irradiance at the point x, d_l the direction to it, n the normal::

    q_l = median over pixels of  log(s_l / (rho E_l n . d_l))

The surface is fitted to all lights, so one that is off pulls it and shows about half of what it is off by; the others hardly move. What
is the object's (interreflection) lies in few pixels and does not move a median; where gloss was found nothing is said.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Literal

import numpy as np
import numpy.typing as npt

from lpcal.api import compared, stacks
from lpcal.api.curve import settle_sensor
from lpcal.api.full_size import SOLVED, Asked, in_full_size
from lpcal.api.sensor import BY_CALLER, BY_CAPTURE, Statements, contradictions, stated_in
from lpcal.api.staged import staged
from lpcal.api.surface_notes import contradicting, far_stated, notes_of, refuse_outside
from lpcal.api.wishes import WAYS, hints_of, refuse_hints, refuse_no_distance, refuse_unknown_lights, refuse_unknown_words
from lpcal.detect.ambient import RoomChanges, ambient_notes, refuse_bright_ambient, refuse_foreign_ambient, room_changes
from lpcal.detect.arrangement import refuse_rearranged
from lpcal.detect.exposures import with_short_exposures
from lpcal.detect.image_shifts import shifted_said
from lpcal.detect.radiometry import to_radiance
from lpcal.errors import InputError
from lpcal.formats.full_size import made_coarse
from lpcal.geometry.arrays import Image, Mask
from lpcal.integration import convention
from lpcal.integration import mesh as meshes
from lpcal.integration.mesh import Mesh
from lpcal.integration.of_normals import check
from lpcal.records import given, given_records, screens
from lpcal.records.calibration import Calibration, Camera
from lpcal.records.figures import ConventionFound
from lpcal.records.observations import Radiance, RawCapture
from lpcal.records.outcome import Progress, silent
from lpcal.records.placement import Placement
from lpcal.records.sensor import Sensor, SensorInUse, StatedSensor
from lpcal.records.surface import Surface
from lpcal.segmentation.mask import NO_HINTS, Keep
from lpcal.surface import reconstruct as solver
from lpcal.surface.sensor_reading import reading_of
from lpcal.view.crop import Crop

DISTANCE_M = 0.35
"""Metres at which an object is put where neither a calibration nor the caller says how far away it is: the LightPanel's own distance."""
type Green = Literal["auto", "as-is", "flipped"]
UNMEASURED = "normals give the shape; the distance, and that of pieces to each other, is not measured"


@staged("reconstruction")
def reconstruct(
    images: npt.ArrayLike | RawCapture,
    calibration: Calibration,
    *,
    lights: Sequence[str] | None = None,
    ambient: npt.ArrayLike | None = None,
    mask: npt.ArrayLike | str = "auto",
    box: tuple[int, int, int, int] | None = None,
    points: Sequence[tuple[int, int]] = (),
    keep: Keep = "object",
    method: str = "near",
    integrator: str = "lpcal",
    distance_m: float | None = None,
    exposure_s: npt.ArrayLike | None = None,
    ambient_exposure_s: npt.ArrayLike | None = None,
    sensor: StatedSensor | Statements = (),
    placement: Placement | None = None,
    arrangement: Literal["auto", "stated"] = "auto",
    name: str = "capture",
    progress: Progress = silent,
) -> Surface:
    """Reconstruct a surface from images that are lit by one light each.

    Parameters
    ----------
    images : ndarray (L, H, W) or (L, H, W, 3), or RawCapture
        One image a light, grey or RGB: whole numbers of 8 or 16 bits, or floats as fractions of full scale; or what `read_capture` gives,
        which brings its own lights, ambient images, exposures and mask.
    calibration : Calibration
        The camera and the lights.
    lights : sequence of str, optional
        The names of the images' lights, in their order; by default all of the calibration's.
    ambient : ndarray (H, W[, 3]) or (K, H, W[, 3]), optional
        The scene with no light on; without it the room's light is estimated.
    mask : ndarray (H, W), "auto" or "none"
        Which pixels are the object, not zero there. "auto" finds it where the capture has no mask; "none" takes every pixel.
    box : (int, int, int, int), optional
        x, y, width and height in pixels of a box that holds the object, where the automatic mask errs.
    points : sequence of (int, int)
        Pixels (x, y) that show the object.
    keep : {"object", "support", "all"}
        What of the layers found is reconstructed: the object; with it what carries it; all that is lit.
    method : str
        "near" or "distant": lpcal's own, with lights that act from where they are, where that is known, or all as if they were far away.
        Or one of `lpcal.methods.NORMALS` to compare with ("least-squares", "l1", "ranks"): it gives normals, and no standard deviations.
    integrator : str
        How a depth is made of such a method's normals: "lpcal", or one of `lpcal.methods.INTEGRATORS` ("poisson", "cosines").
    distance_m : float, optional
        The median distance of the object along z of C, metres, where it is known; it counts before what a distance sensor reads.
    exposure_s : ndarray (L,), optional
        Exposure times times gains of the images, seconds, where they differ.
    ambient_exposure_s : ndarray (K,), optional
        Those of the ambient images; needed where those of the images differ.
    sensor : StatedSensor, or sequence of (str, StatedSensor)
        What is known of the sensor (gamma, black and white level, flat field) for these images; it counts before what the capture and the
        calibration say. A sequence stands for all that is said, by who says it.
    placement : Placement, optional
        Where it was taken, of `place`; the surface keeps it.
    arrangement : {"auto", "stated"}
        Images that clearly fit their lights in another order, or turned, are refused; "stated" takes them as they are and says so.
    name : str
        What the capture is called in messages, where `images` is an array.
    progress : callable, optional
        Called as ``progress(what, done, total)``.

    Returns
    -------
    Surface
        Maps (H, W), NaN outside the mask: unit normals in C, turned towards the camera; depth in metres along z of C (pixels without a
        camera); albedo; standard deviations of both; connected pieces with their distances; warnings.

    Raises
    ------
    InputError, DisagreementError
        Images of another shape, more or fewer than lights, of another size than the camera's, or clearly not linear.
    DegenerateError
        Fewer than three lights, no object, all dark or saturated, or an object far outside the working volume.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> S = np.array([[0.5, 0, -1], [-0.25, 0.45, -1], [-0.25, -0.45, -1], [0.0, 0.0, -1]])
    >>> S /= np.linalg.norm(S, axis=1, keepdims=True)
    >>> dome = lpcal.Calibration("dome", tuple(lpcal.Light(f"L{k}", s, np.ones(1)) for k, s in enumerate(S)))
    >>> y, x = np.mgrid[-1.2:1.2:48j, -1.2:1.2:48j]
    >>> ball = x**2 + y**2 < 0.9
    >>> n = np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0.1))], axis=-1)
    >>> images = np.where(ball, np.clip(np.einsum("lc,hwc->lhw", S, n), 0, 1), 0) * 0.7
    >>> surface = lpcal.reconstruct(images, dome, ambient=np.zeros_like(images[0]), mask=ball)
    >>> error = np.degrees(np.arccos(np.clip(np.sum(surface.normals * n, axis=-1)[ball], -1, 1)))
    >>> bool(np.median(error) < 2)
    True
    """
    calibration = given_records.calibration(calibration)
    if lights is None and not isinstance(images, RawCapture):
        lights = [light.name for light in calibration.with_lights().lights]
    mask_given = None if isinstance(mask, str) else np.asarray(mask)
    raw = stacks.capture(images, lights, name=name, ambient=ambient, exposure_s=exposure_s, ambient_exposure_s=ambient_exposure_s)
    refuse_unknown_words(mask, method, integrator, keep, distance_m, arrangement)
    refuse_unknown_lights(raw, calibration)
    hints = hints_of(box, points)
    refuse_hints(hints, raw.size[::-1], raw.name)
    if placement is not None and not isinstance(placement, Placement):
        raise InputError(f"a {type(placement).__name__}", where="placement", needed="a Placement", todo="lpcal.place gives one")
    asked = Asked(
        given=None if mask_given is None else stacks.of_image_size(mask_given, raw.size[::-1], "mask"),
        automatic=isinstance(mask, str) and mask == "auto",
        hints=hints,
        keep=keep,
        method=method,
        integrator=integrator,
        distance_m=distance_m or (None if calibration.distance_sensor is not None else raw.distance_m),
        reading_m=raw.distance_m if calibration.distance_sensor is not None else None,
        arrangement_stated=arrangement == "stated",
    )
    calibration = calibration.of_images(raw.size)
    saying = _saying(sensor, raw, calibration)
    if raw.full is None:
        with suppress(solver.TooManySamplesError):
            return replace(_reconstructed(raw, calibration, asked, saying, progress), placement=placement)
        raw = made_coarse(raw)

    def solve(fewer: RawCapture, coarse: Calibration, of_fewer: Asked, kept: list[solver.Solved]) -> Surface:
        return _reconstructed(fewer, coarse, of_fewer, saying, progress, kept)

    return replace(in_full_size(raw, calibration, asked, solve, progress), placement=placement)


def _reconstructed(
    raw: RawCapture,
    calibration: Calibration,
    asked: Asked,
    saying: Statements,
    progress: Progress,
    kept: list[solver.Solved] | None = None,
) -> Surface:
    """`reconstruct` for a capture that is held; what the surface was made from is added to `kept`.

    Raises
    ------
    TooManySamplesError
        The object has more samples than are solved at once, and nothing is kept.
    """
    settled = settle_sensor(raw, calibration, saying)
    used, said = settled.used.sensor, (*settled.notes, *contradictions(saying))
    given, hints, method = asked.given, asked.hints, asked.method
    refuse_bright_ambient(raw, used)
    automatic = asked.automatic and given is None
    wanted = raw.mask if automatic else given
    if method not in WAYS:
        inside = np.ones(raw.images.shape[1:3], bool) if given is None and not automatic else wanted
        radiance = _linear(raw, used, said, None, use_mask=automatic)
        begin_m = asked.distance_m or calibration.d_object_m or DISTANCE_M
        surface = compared.reconstruct(radiance, calibration, inside, hints, begin_m, method, asked.integrator)
        return replace(surface, warnings=(*radiance.notes, *surface.warnings), sensor=settled.used)
    cropped = wanted is not None and calibration.camera is None and hints == NO_HINTS and kept is None
    part = Crop.about(wanted) if cropped and wanted is not None else None
    options = solver.Options(
        near=method == "near",
        distance_m=asked.distance_m,
        reading=reading_of(calibration, asked.reading_m),
        mask=given if given is None or part is None else part.of(given),
        automatic_mask=automatic,
        hints=hints,
        keep=asked.keep,
        ambient_known=raw.ambient is not None,
        linear=settled.linear,
        most_samples=SOLVED if kept is None else None,
    )
    radiance = _linear(raw, used, said, part, use_mask=automatic)
    shown = radiance.mask if options.mask is None else options.mask
    fits = refuse_rearranged(radiance, calibration, shown, stated=asked.arrangement_stated or raw.arrangement_stated)
    solved = [] if kept is None else kept
    surface = solver.reconstruct(radiance, calibration, options, progress, solved)
    scene, state = solved[-1].scene, solved[-1].state
    notes = (
        *notes_of(radiance.notes, surface),
        *fits,
        *shifted_said(scene.seen, state.lit, state.found, radiance.lights),
        *contradicting(surface, radiance, calibration),
        *far_stated(options.distance_m if options.near else None, calibration),
    )
    surface = surface if part is None else part.put_back(surface)
    if options.near and options.distance_m is None:
        refuse_outside(surface, calibration, fits)
    return replace(surface, warnings=notes, sensor=settled.used)


def linear(raw: RawCapture, calibration: Calibration, saying: Statements) -> tuple[Radiance, SensorInUse]:
    """A capture that is held, made linear as `reconstruct` makes it, and by which sensor."""
    settled = settle_sensor(raw, calibration, saying)
    return _linear(raw, settled.used.sensor, (), None, use_mask=False), settled.used


def _linear(raw: RawCapture, sensor: Sensor, said: tuple[str, ...], part: Crop | None, *, use_mask: bool) -> Radiance:
    """The capture made linear, or the part of it that is asked for; notes hold what is said of it."""
    plain = to_radiance(raw, sensor)
    changes: RoomChanges = {}
    if raw.ambient is not None:
        changes = room_changes(plain)
        refuse_foreign_ambient(plain, changes)
    found = with_short_exposures(plain, raw, sensor)
    notes = (*found.notes, *said, *ambient_notes(plain, raw, sensor, changes))
    whole = [replace(found, notes=notes, mask=found.mask if use_mask else None)]
    del plain, found  # a large capture's maps go as their parts are taken
    return whole.pop() if part is None else part.radiance(whole.pop())


def _saying(sensor: StatedSensor | Statements, raw: RawCapture, calibration: Calibration) -> Statements:
    """All that is said of the sensor, what counts more first."""
    if isinstance(sensor, tuple | list) and sensor:
        return sensor
    first = [] if isinstance(sensor, tuple | list) else [(BY_CALLER, given_records.sensor(sensor))]
    return [*first, (BY_CAPTURE, raw.sensor), ("the calibration", stated_in(calibration))]


@staged("integration")
def integrate(
    normals: npt.ArrayLike,
    camera: Camera | None = None,
    mask: npt.ArrayLike | None = None,
    *,
    distance_m: float = DISTANCE_M,
    green: Green = "auto",
    integrator: str = "lpcal",
    name: str = "normals",
) -> Surface:
    """Integrate normals from elsewhere to a depth.

    Parameters
    ----------
    normals : ndarray (H, W, 3)
        Normals in C (x right, y down, z forward), turned towards the camera: z is negative. Of any length; NaN where there is none.
    camera : Camera, optional
        The camera; without it rays are parallel, and the depth is in pixels about zero.
    mask : ndarray (H, W), optional
        Which pixels count, not zero there; by default all that hold a normal.
    distance_m : float
        Metres at which the median depth is put, with a camera: normals do not determine it.
    green : {"auto", "as-is", "flipped"}
        Whether the y of the normals is turned over; "auto" asks the curl of their slopes.
    integrator : str
        "lpcal", which keeps steps; or one of `lpcal.methods.INTEGRATORS` to compare with ("poisson", "cosines").
    name : str
        What the map is called in messages.

    Returns
    -------
    Surface
        Depth in metres (pixels without a camera), the normals, connected pieces, and warnings; ``figures.convention`` holds what the
        curl says of y. Standard deviations are NaN: they are not known.

    Raises
    ------
    InputError, DisagreementError
        Another shape than the camera's or the mask's; channels that are swapped.
    DegenerateError
        Too few normals, most look away from the camera, or they are of no surface.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> y, x = np.mgrid[-20:21, -20:21] / 40.0
    >>> z = np.sqrt(1 - x**2 - y**2)
    >>> surface = lpcal.integrate(np.stack([x, y, -z], axis=-1))
    >>> depth = surface.depth - surface.depth[20, 20]
    >>> bool(abs(depth[20, 40] - 40 * (1 - np.sqrt(0.75))) < 0.1)
    True
    """
    map_C = given.numbers(normals, "normals", finite=False).astype(np.float32)
    if map_C.ndim != 3 or map_C.shape[2] != 3:
        raise InputError(f"an array of {map_C.shape}", where="normals", needed="(H, W, 3)")
    refuse_no_distance(distance_m)
    if green not in {"auto", "as-is", "flipped"}:
        raise InputError(repr(green), where="green", needed='"auto", "as-is" or "flipped"')
    length = np.linalg.norm(map_C, axis=2)
    inside = np.asarray(np.isfinite(length) & (length > 0))
    if mask is not None:
        inside &= stacks.of_image_size(mask, inside.shape, "mask")
    return _integrated(map_C, inside, camera, distance_m, green, integrator, name)


def _integrated(
    normals_C: Image, inside: Mask, camera: Camera | None, distance_m: float, green: Green, integrator: str, name: str
) -> Surface:
    camera = None if camera is None else given_records.camera(camera).of_images((inside.shape[1], inside.shape[0]))
    check(name, inside, camera)
    found = convention.settled(name, normals_C, inside, camera, green)
    surface = compared.integrated(name, found.normals_C, inside, camera, distance_m, integrator)
    said = ConventionFound(green_turned_over=found.flipped, curl_as_is=found.as_is, curl_turned_over=found.turned)
    warnings = (UNMEASURED,) if found.note is None else (found.note, UNMEASURED)
    return replace(surface, figures=replace(surface.figures, convention=said), warnings=warnings)


def mesh(surface: Surface) -> Mesh:
    """Make a mesh of a surface's pixels, cut where it breaks.

    Parameters
    ----------
    surface : Surface
        What `reconstruct`, `integrate` or `read_surface` gives.

    Returns
    -------
    Mesh
        Vertices (V, 3) and normals (V, 3) in C, metres (pixels without a camera); colours (V, 3) of 8 bits; faces (F, 3), which look at
        the camera.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> flat = np.zeros((9, 9, 3)) + [0, 0, -1.0]
    >>> lpcal.mesh(lpcal.integrate(flat)).faces.shape
    (128, 3)
    """
    if not isinstance(surface, Surface):
        raise InputError(f"a {type(surface).__name__}", where="surface", needed="a Surface, of reconstruct, integrate or read_surface")
    return meshes.build(surface)


@screens.screen_of.register
def _mesh_screen(found: Mesh) -> screens.RecordScreen:
    low, high = found.vertices_C.min(axis=0, initial=np.inf), found.vertices_C.max(axis=0, initial=-np.inf)
    rows = [("vertices", str(len(found.vertices_C))), ("faces", str(len(found.faces)))]
    rows += [("size", " x ".join(f"{side:.4g}" for side in high - low) + " along x, y, z of C")] if len(found.vertices_C) else []
    return screens.RecordScreen("Mesh", rows)
