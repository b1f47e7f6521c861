"""A surface from the linear images of a capture and the calibrated lights: mask, distance search, rounds, and the maps of the result.

Distant lights, or pixels without a camera, do not determine the distance: parallel rays give a depth in pixels about zero, a camera one
about the stated or working distance.

Where nothing states the working distance, a sweep over distances starts from a flat front: at each distance every pixel has its own normal
and albedo, and the distance of the smallest residual is taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.integration import pieces
from lpcal.integration.integrate import NORMAL_ERROR_RAD, Grid
from lpcal.records.calibration import Calibration, Camera, Light
from lpcal.records.figures import GlossFound, SurfaceFigures
from lpcal.records.observations import Radiance
from lpcal.records.outcome import Progress, silent
from lpcal.records.surface import Surface
from lpcal.segmentation import mask
from lpcal.segmentation.background import Layer
from lpcal.segmentation.mask import NO_HINTS, Hints, Keep
from lpcal.shading import normals
from lpcal.shading.normals import albedo_of
from lpcal.surface import (
    components,
    distance_search,
    normal_prior,
    rounds,
    self_calibration,
    sensor_reading,
    surroundings,
    uncertainty,
    without_ambient,
)
from lpcal.surface.distance_search import DistanceMinima
from lpcal.surface.rounds import Scene, State
from lpcal.surface.self_calibration import exchanged
from lpcal.surface.sensor_reading import Reading
from lpcal.view import parallel, pixel_list
from lpcal.view.constants import FEWEST_PIXELS, MANY_PIXELS
from lpcal.view.pixel_list import PixelList

AGREE_DEG = float(np.degrees(NORMAL_ERROR_RAD))
"""Angle, degrees, on which the averaging of measured normals with those of the depth decays: the error that the steps assume."""
DISTANCE_M = uncertainty.WORKING_M
"""Distance, metres, that is assumed where nothing states or determines it."""


@dataclass(frozen=True)
class Options:
    """What the user asks for."""

    near: bool = True
    """Whether lights act from their positions, where these are known; else all as distant lights."""
    distance_m: float | None = None
    """Median depth of the largest piece, where the user knows it."""
    reading: Reading | None = None
    """Reading of the panel's distance sensor; it counts where the user states no distance."""
    mask: Mask | None = None
    automatic_mask: bool = True
    """Whether the object is to be found where no mask is given; else every pixel counts."""
    hints: Hints = NO_HINTS
    """Box and points by which the user says where the object is."""
    keep: Keep = "object"
    """Which layers are reconstructed: the object; the object and its support; everything that is lit."""
    ambient_known: bool = True
    """Whether the ambient light has been subtracted; else it is estimated."""
    ambient_seen: bool = True
    """Whether the subtracted light is an image, which shows shapes itself; else it is an estimate."""
    linear: bool = True
    """Whether the signals may be taken as linear; else unmeasured intensities of lights stay as stated."""
    most_samples: int | None = None
    """Largest number of samples (lights times pixels of the object) that are solved at once; None: any number."""


class TooManySamplesError(Exception):
    """The object has more samples than are solved at once; api.full_size catches it and solves in coarse pixels first."""


@dataclass(frozen=True)
class Solved:
    """A surface, with the scene, state and radiance that it was computed from."""

    surface: Surface
    scene: Scene
    state: State
    radiance: Radiance
    """Radiance without ambient light."""


def reconstruct(
    radiance: Radiance, calibration: Calibration, options: Options, progress: Progress = silent, kept: list[Solved] | None = None
) -> Surface:
    """The surface of a capture; the solution it was computed from is appended to `kept`.

    Raises
    ------
    DegenerateError
        Fewer than three lights, or all in a plane with the object; no object; too few lit pixels.
    DisagreementError
        The images are not of the calibrated camera's size.
    TooManySamplesError
        The object has more samples than the options want solved at once.
    """
    pixel_list.agree_on_size(radiance.name, radiance.signal.shape[1:3], calibration.camera)
    lights = pixel_list.lights_of(calibration, radiance)
    maps, rays_C = pixel_list.grey(radiance, lights), pixel_list.ray_map(radiance.signal.shape[1:3], calibration.camera)
    central = calibration.camera is not None
    near = options.near and central and any(light.source_C is not None for light in lights)
    begin = options.distance_m or calibration.d_object_m or (calibration.focus_C[2] if calibration.focus_C is not None else None)
    if begin is None:
        begin = distance_m(maps, rays_C, lights, _given(radiance, options)) if near else DISTANCE_M
    focus_C = None if near else (calibration.focus_C if calibration.focus_C is not None else np.array([0.0, 0.0, begin]))
    if not options.ambient_known and not self_calibration.unmeasured(lights):
        given = None if _is_wanted(radiance, options) else _object(None, radiance, options)
        known = replace(options, ambient_known=True, ambient_seen=False)

        def solve(lamps: Radiance, object_mask: Mask | None) -> Surface:
            return reconstruct(lamps, calibration, replace(known, mask=object_mask), progress, kept)

        return without_ambient.reconstruct(radiance, calibration, given, focus_C, float(begin), solve, options.hints)
    wanted = _is_wanted(radiance, options)
    given_mask = None if wanted else _object(None, radiance, options)
    progress(f"{radiance.name}: which pixels are the object", 0, 1)
    background = _background(radiance, maps, rays_C, lights, float(begin) if near else None, options)
    progress(f"{radiance.name}: which pixels are the object", 1, 1)
    object_mask = _object(background, radiance, options) if given_mask is None else given_mask
    seen = pixel_list.list_pixels(maps, rays_C, object_mask, central=central)
    gain = self_calibration.intensities(seen, lights) if options.linear and self_calibration.unmeasured(lights) else None
    if gain is not None:
        lights = tuple(replace(light, intensity=light.intensity * factor) for light, factor in zip(lights, gain, strict=True))
        maps = pixel_list.grey(radiance, lights)
        seen = pixel_list.list_pixels(maps, rays_C, object_mask, central=central)
    beside = parallel.start(partial(surroundings.found_beside, maps, rays_C, object_mask, background if near else None, lights))
    minima = None
    u = np.full(seen.pixels, np.log(begin) if central else 0.0)
    if near and options.distance_m is None:
        minima = distance_search.search(maps, rays_C, object_mask, lights, float(begin), progress, radiance.name)
        minima = sensor_reading.weighed(minima, options.reading, calibration.camera)
        u = minima.start(object_mask) if minima is not None else u
    around = beside()
    room, likely = room_of(radiance, object_mask), _of_object(background if wanted else None, radiance, options)
    scene = Scene(radiance.name, seen, Grid.of(object_mask), lights, focus_C, options.distance_m, around, None, room, likely)
    del maps, beside  # what the rounds need of them is in the scene
    state = rounds.run(scene, u, progress)
    surface = surface_of(radiance, scene, state, rays_C, minima)
    state, surface = _with_sensor_reading(radiance, scene, state, surface, minima, options, calibration.camera)
    layer = _layer(background if wanted or not options.automatic_mask else None, object_mask)
    figures = _with_mask(surface.figures, background if wanted else None, radiance, options)
    intensities = None if gain is None else dict(zip(radiance.lights, gain.round(4).tolist(), strict=True))
    exchanged_images = _exchanged(state, seen, radiance.lights) or None
    surface = replace(surface, layer=layer, figures=replace(figures, intensities_found=intensities, images_exchanged=exchanged_images))
    if kept is not None:
        kept.append(Solved(surface, scene, state, radiance))
    return surface


def _background(
    radiance: Radiance, maps: pixel_list.SignalMaps, rays_C: Array, lights: Sequence[Light], about_m: float | None, options: Options
) -> mask.Found | None:
    """Automatic mask and planes, for near lights with working distance `about_m`; None where neither is needed."""
    if not (wanted := _is_wanted(radiance, options)) and about_m is None:
        return None
    room, drawn = pixel_list.room(radiance) if options.ambient_seen else None, wanted or not options.automatic_mask
    return mask.automatic(maps, rays_C, lights, about_m, options.hints, room, drawn=drawn)


def _of_object(found_by: mask.Found | None, radiance: Radiance, options: Options) -> float:
    """Probability that the mask shows an object only: that of the automatic mask, 0 where support or wall are kept too."""
    if found_by is not None:
        return 1 - (found_by.doubt or 0.0) if options.keep == "object" else 0.0
    return 0.0 if _given(radiance, options) is None else 1.0


def room_of(radiance: Radiance, object_mask: Mask) -> Array | None:
    """The ambient signal (P,) of a mask's pixels; None without an ambient image."""
    room = pixel_list.room(radiance)
    return None if room is None else np.asarray(room[object_mask], float)


def _exchanged(state: State, seen: PixelList, names: Sequence[str]) -> dict[str, str]:
    """Map from the names of images to the lights that they fit better than their own."""
    matte = seen.signal if state.found.gloss is None else seen.signal - state.found.gloss
    found = exchanged(matte, state.lit, state.found.b, seen.usable)
    return {names[image]: names[light] for image, light in found.items()}


def _with_mask(figures: SurfaceFigures, found_by: mask.Found | None, radiance: Radiance, options: Options) -> SurfaceFigures:
    """The figures with the mask's origin and doubt."""
    figures = replace(figures, mask=_how(found_by, radiance, options))
    if found_by is None or found_by.doubt is None:
        return figures
    return replace(figures, mask_doubt=found_by.doubt, mask_doubt_why=found_by.why)


def _how(background: mask.Found | None, radiance: Radiance, options: Options) -> str:
    """The mask's origin, in words."""
    given = "given" if _given(radiance, options) is not None else "every pixel"
    return given if background is None else background.how


def _with_sensor_reading(
    radiance: Radiance, scene: Scene, state: State, surface: Surface, found: DistanceMinima | None, options: Options, camera: Camera | None
) -> tuple[State, Surface]:
    """The state and surface after fusion with the distance sensor's reading, which scales the piece that the beam meets."""
    if options.reading is None or options.distance_m is not None or camera is None:
        return state, surface
    said = sensor_reading.of_surface(surface, camera, options.reading)
    if said.fused is not None and abs(said.fused.log_scale) > rounds.SETTLED:
        inside = surface.component[scene.seen.mask] == said.label
        u = state.u + said.fused.log_scale * inside
        again = rounds.once(scene, u, state)
        again.u[:] = u  # the reading is in it already
        state = replace(again, weight=state.weight)
        surface = surface_of(radiance, scene, state, surface.rays_C, found)
    return state, sensor_reading.with_reading(surface, said)


def _is_wanted(radiance: Radiance, options: Options) -> bool:
    """Whether an automatic mask is needed."""
    return _given(radiance, options) is None and options.automatic_mask


def _given(radiance: Radiance, options: Options) -> Mask | None:
    """The mask that the user or the capture gives; None without one."""
    return options.mask if options.mask is not None else radiance.mask


def _object(background: mask.Found | None, radiance: Radiance, options: Options) -> Mask:
    """The object's mask (H, W). Raises DegenerateError for too few pixels, TooManySamplesError for too many samples."""
    given = _given(radiance, options)
    if given is None:
        given = background.kept(options.keep) if background is not None else np.ones(radiance.signal.shape[1:3], bool)
    given = options.hints.of(given)
    if given.sum() < FEWEST_PIXELS:
        raise DegenerateError(
            f"the mask holds {given.sum()} pixels",
            where=radiance.name,
            needed=f"{FEWEST_PIXELS} at least",
            todo="give one with --mask FILE, or say where the object is with --box X,Y,WIDTH,HEIGHT or --point X,Y",
        )
    if options.most_samples is not None and len(radiance.lights) * given.sum() > options.most_samples:
        raise TooManySamplesError
    return given


def _layer(background: mask.Found | None, object_mask: Mask) -> Labels:
    """Layer of each pixel of the surface (H, W); all are the object where none were found."""
    found = np.full(object_mask.shape, Layer.OBJECT, np.uint8) if background is None or background.layer is None else background.layer
    return np.asarray(np.where(object_mask, found, Layer.NOTHING), np.uint8)


def surface_of(radiance: Radiance, scene: Scene, state: State, rays_C: Array, found: DistanceMinima | None) -> Surface:
    """The surface of a scene from the final state of its rounds and the minima of the distance search."""
    seen, grid = scene.seen, scene.grid
    state, expected_rad = normal_prior.turned(scene, state)
    depth = np.exp(state.u) if seen.central else state.u
    label = pieces.pieces(grid, state.weight, seen.mask)
    albedo = _albedo(radiance, scene, state)
    whole = state.weight > pieces.BREAK_WEIGHT
    of_depth = normal_prior.normals_of_depth(scene, state)
    features = uncertainty.indicators(grid, seen.mask, state.found, state.lit, state.normals, of_depth, whole, expected_rad)
    sigma_deg = uncertainty.normal_sigma_deg(features, uncertainty.calibration_deg(scene.lights))
    drawn = np.exp(-((features.bend_deg / AGREE_DEG) ** 2))[:, None]
    n = lambert.unit(state.normals + drawn * of_depth)[0]
    towards = -lambert.dot(n, seen.rays_C) / lambert.length(seen.rays_C)
    plane = seen.shape_C(np.ones_like(depth))[:, :2]
    depth_sigma = uncertainty.depth_sigma(grid, sigma_deg, towards, plane, depth if seen.central else np.ones_like(depth), label)

    def as_map(values: Array) -> Image:
        return np.asarray(seen.map(values.astype(np.float32)), np.float32)

    return Surface(
        name=radiance.name,
        normals=as_map(n),
        depth=as_map(depth),
        albedo=as_map(albedo),
        mask=seen.mask,
        normal_std_deg=as_map(sigma_deg),
        depth_std=as_map(depth_sigma),
        lights_used=np.asarray(seen.map(state.found.used.astype(np.uint8), 0)),
        component=np.asarray(seen.map(label, 0)),
        rays_C=rays_C,
        breaks=pieces.break_map(grid, state.weight, seen.mask),
        components=components.of(scene, state, depth, label, found),
        figures=_figures(state),
    )


def _albedo(radiance: Radiance, scene: Scene, state: State) -> Array:
    """Albedo (P,) or (P, 3): per channel, the least-squares factor of the shading over the inlying samples."""
    seen, lights = scene.seen, scene.lights
    inside = np.flatnonzero(seen.mask.ravel())
    signal = radiance.signal.reshape(len(lights), seen.mask.size, -1)
    channels = signal.shape[2]
    intensity = np.stack([np.broadcast_to(light.intensity if channels > 1 else light.intensity[0], channels) for light in lights])

    def of(at: slice) -> Array:
        return albedo_of(signal[:, inside[at]], intensity, state.lit.at(at), state.normals[at], state.found.at(at), seen.at(at))

    found = np.concatenate(parallel.run_bands(seen.pixels, len(lights), of))
    return found[:, 0] if channels == 1 else found


def _figures(state: State) -> SurfaceFigures:
    found = state.found
    known = np.isfinite(found.b[:, 0])
    freedom = np.maximum(found.used - 3, 0)
    shine = state.field.gloss
    return SurfaceFigures(
        pixels=len(found.b),
        pixels_with_three_lights=int(known.sum()),
        median_lights_used=float(np.median(found.used)),
        gloss=GlossFound(**asdict(shine)) if shine is not None and shine.clear else None,
        reflectance=None if state.reflects is None else state.reflects.median,
        residual_sigmas_rms=float(np.sqrt(found.chi2[known].sum() / max(freedom[known].sum(), 1))),
    )


SPAN = (0.5, 40.0)
"""Range of the sweep, as multiples of the lights' spread: nearer, lights graze the object; farther, all are alike."""
STEPS = 27
"""Number of distances in the sweep, 18 per cent apart: closer than the basins of attraction of the rounds."""
BRIGHT = 0.2
"""Without a mask, pixels count whose brightest sample exceeds this share of the image's 99th percentile."""


def distance_m(maps: pixel_list.SignalMaps, rays_C: Array, lights: Sequence[Light], mask: Mask | None) -> float:
    """The distance along the camera's axis at which the signals fit best, from pixels of the mask, else from bright ones."""
    sweep = pixel_list.fronts_m(lights, SPAN, STEPS)
    brightest = maps.signal.max(axis=0)
    asked = brightest > BRIGHT * np.percentile(brightest, 99) if mask is None or not mask.any() else mask
    seen = pixel_list.list_pixels(maps, rays_C, asked, central=True)
    some = seen.at(np.unique(np.linspace(0, seen.pixels - 1, min(MANY_PIXELS, seen.pixels)).astype(int)))
    cost = []
    for z in sweep:
        d, E = pixel_list.light_vectors(lights, some.points_C(np.full(some.pixels, z)))
        B = d * E[..., None]
        usable = some.usable & (E > 0)
        found = normals.estimate(some, B, normals.candidates(some, E), normals.variances(some))
        cost.append(normals.misfit(some, B, usable, found))
    return float(sweep[int(np.argmin(cost))])
