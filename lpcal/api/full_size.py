"""A surface in full size, of a capture that is too large to be held: the coarse one first, the rest tile by tile upon it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from lpcal.api.wishes import WAYS
from lpcal.detect.exposures import with_short_exposures
from lpcal.detect.radiometry import noise_model, over_white, part_to_radiance
from lpcal.errors import UsageError
from lpcal.formats.full_size import coarse_mask
from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Calibration, Camera
from lpcal.records.full_images import FullImages
from lpcal.records.observations import Radiance, RawCapture
from lpcal.records.outcome import Progress
from lpcal.records.sensor import Sensor
from lpcal.records.surface import Surface
from lpcal.segmentation import cut
from lpcal.segmentation.mask import Hints, Keep
from lpcal.surface import full_size as solver
from lpcal.surface import uncertainty
from lpcal.surface.coarse_solution import CoarseSolution, between
from lpcal.surface.reconstruct import AGREE_DEG, Solved
from lpcal.view import pixel_list
from lpcal.view.parallel import run_all
from lpcal.view.pixel_list import Indices

SOLVED = 10_000_000
"""Samples, lights times pixels of an object, that are solved at once: the solver's lists take 200 bytes of each."""
NOISE_PARTS = 5
"""Parts of the picture, along each side, that the noise is read off: they hold some 400,000 pixels of every image."""
BAND_ROWS = 64
"""Rows that are worked on at once where maps are made of coarse ones."""
OUTLINE_PX = 2
"""Coarse pixels on either side of a coarse outline that the picture in full size is asked for."""
OUTLINE_SIDE, OUTLINE_MARGIN = 256, 32
"""Pixels of the tiles in which that is done, and of their margins."""
STIFFNESS = 0.6
"""Evidence that a unit of outline must be worth where the picture shows no edge."""


@dataclass(frozen=True)
class Asked:
    """What a caller of `reconstruct` asks for."""

    given: Mask | None
    automatic: bool
    """Whether the mask is the capture's, or found; else every pixel counts where none is given."""
    hints: Hints
    keep: Keep
    method: str
    integrator: str
    distance_m: float | None
    reading_m: float | None = None
    arrangement_stated: bool = False
    """Whether the images are taken as their names say, whatever they themselves show."""


type Solve = Callable[[RawCapture, Calibration, Asked, list[Solved]], Surface]
"""Gives the surface of a coarse capture, and adds what it was made from to a list."""


@dataclass(frozen=True)
class BinnedCamera(Camera):
    """A camera whose pixels are squares of another's."""

    factor: int = 1

    @staticmethod
    def of(camera: Camera, factor: int) -> Camera:
        """A camera with squares of so many pixels joined; what is left at the right and below is dropped."""
        width, height = camera.image_size
        own = {one.name: getattr(camera, one.name) for one in fields(Camera)} | {"image_size": (width // factor, height // factor)}
        return BinnedCamera(**own, factor=factor)

    def project(self, x_C: Array) -> Array:
        """Pixels (..., 2) of points x_C (..., 3)."""
        return (super().project(x_C) - (self.factor - 1) / 2) / self.factor

    def unproject(self, pixels: Array) -> Array:
        """Unit rays (..., 3) of pixels (..., 2)."""
        return super().unproject(self._whole(pixels))

    def slopes(self, pixels: Array) -> Array:
        """x / z and y / z (..., 2) of the rays of pixels (..., 2)."""
        return super().slopes(self._whole(pixels))

    def _whole(self, pixels: Array) -> Array:
        """Pixels (..., 2) in those of the other camera."""
        return self.factor * np.asarray(pixels) + (self.factor - 1) / 2


def coarse_calibration(calibration: Calibration, factor: int) -> Calibration:
    """The calibration for coarse pixels."""
    return calibration if calibration.camera is None else replace(calibration, camera=BinnedCamera.of(calibration.camera, factor))


def in_full_size(raw: RawCapture, calibration: Calibration, asked: Asked, solve: Solve, progress: Progress) -> Surface:
    """The surface of a capture in coarse pixels with its images in full size beside it: `solve` gives the coarse one.

    Raises
    ------
    UsageError
        A method to compare with is asked for.
    DisagreementError
        The images are not of the camera's size.
    """
    full = raw.full
    assert full is not None
    if asked.method not in WAYS:
        raise UsageError(
            f"{len(raw.lights)} images of {full.size[1]}x{full.size[0]} are too large for a method to compare with",
            where=asked.method,
            needed="near or distant",
            todo="compare on a smaller picture",
        )
    pixel_list.agree_on_size(raw.name, full.size, calibration.camera)
    kept: list[Solved] = []
    mask = asked.given if asked.given is not None else full.mask if asked.automatic else np.ones(full.size, bool)
    given = None if asked.given is None else coarse_mask(asked.given, full.factor)
    of_fewer = replace(asked, given=given, hints=asked.hints.shrunk(full.factor))
    coarse = solve(replace(raw, full=None), coarse_calibration(calibration, full.factor), of_fewer, kept)
    solved = next(one for one in kept if one.surface.depth is coarse.depth)
    return enlarged(raw, full, calibration, coarse, solved, None if mask is None else asked.hints.of(mask), progress)


def enlarged(
    raw: RawCapture, full: FullImages, calibration: Calibration, coarse: Surface, solved: Solved, mask: Mask | None, progress: Progress
) -> Surface:
    """The surface in full size upon the coarse one; `mask` (H, W) is the user's, None where it was found."""
    sensor = Sensor() if coarse.sensor is None else coarse.sensor.sensor
    solution = CoarseSolution.of(solved.scene, solved.state, coarse.rays_C, coarse.normals, full.factor)
    radiance_of = _parts(raw, full, sensor, solved)
    inside = _outlined(full, coarse, radiance_of, solved) if mask is None else mask
    colours = None if solved.radiance.signal.ndim == 3 else pixel_list.colour_weight(solved.radiance, solved.scene.lights)
    whole = solver.Full(radiance_of, inside, calibration.camera, solved.scene, solved.state.field.gloss, solution, colours)
    found = whole.solve(progress)
    solver.finished(whole, found, AGREE_DEG, uncertainty.calibration_deg(solved.scene.lights))
    return _surface(whole, found, coarse)


def _parts(raw: RawCapture, full: FullImages, sensor: Sensor, solved: Solved) -> Callable[[slice, slice], Radiance]:
    """What makes parts of the images linear, the room's light taken away as it was from the coarse ones."""
    white = min(sensor.white_level, full.saturated_from)
    some = full.sampled(NOISE_PARTS)
    noise = noise_model(
        np.stack([sensor.linear(image) for image in some]), over_white(some, replace(sensor, white_level=white), raw.step), raw.step
    )
    room = _room_share(solved.radiance) if raw.ambient is None else None

    def of(rows: slice, columns: slice) -> Radiance:
        lights, ambient, short = full.read(rows, columns)
        part = replace(raw, images=lights, ambient=ambient if raw.ambient is not None else None, short=short, mask=None, full=None)
        flat = sensor.flat_field
        response = np.ones(lights.shape[1:3], np.float32) if flat is None else flat.part(full.size, rows, columns)
        found = part_to_radiance(part, sensor, noise, white, response)
        found = with_short_exposures(found, part, sensor, response[..., None] if lights.ndim == 4 else response, noise)
        if room is None:
            return found
        light = between(room, full.factor, rows, columns) * found.signal.mean(axis=0)
        return replace(found, signal=found.signal - light.astype(np.float32))

    return of


def _room_share(radiance: Radiance) -> Image | None:
    """The room's light (h, w[, 3]) by the mean of the images with it; None where there is none."""
    if not radiance.ambient.any():
        return None
    return np.asarray(radiance.ambient / np.maximum(radiance.signal.mean(axis=0) + radiance.ambient, 1e-9), np.float32)


def _outlined(full: FullImages, coarse: Surface, radiance_of: Callable[[slice, slice], Radiance], solved: Solved) -> Mask:
    """The coarse mask in full size, its outline drawn to the edges of the picture there."""
    shown = coarse.mask.astype(np.float32)
    inside = np.zeros(full.size, bool)
    rows_of_tiles = solver.tiles(full.size, OUTLINE_SIDE, OUTLINE_MARGIN)

    def outlined(tile: solver.Tile) -> Mask:
        share = between(shown, full.factor, *tile.outer)
        if share.min() > 0.5 or share.max() <= 0.5:
            return np.asarray(share > 0.5)[tile.within]
        far = int(OUTLINE_PX * full.factor)
        first = share > 0.5
        said = np.where(first, 2.0, -2.0).astype(np.float32)
        said[~raster.eroded(first, far, beyond=True) & ~raster.eroded(~first, far, beyond=True)] = 0.0
        bright = pixel_list.strength(pixel_list.grey(radiance_of(*tile.outer), solved.scene.lights))
        picture = np.log(np.maximum(bright, max(0.01 * float(np.percentile(bright, 99)), 1e-9))).astype(np.float32)
        return cut.total_variation(np.where(said == 0, np.where(first, 1e-3, -1e-3), said).astype(np.float32), picture, STIFFNESS)[
            tile.within
        ]

    for row in rows_of_tiles:
        for tile, found in zip(row, run_all(outlined, row), strict=True):
            inside[tile.core] = found
    return inside


def _surface(whole: solver.Full, found: solver.Maps, coarse: Surface) -> Surface:
    """The coarse surface with the maps in full size in place of its own."""
    inside, solution = whole.mask, whole.coarse
    component, layer = np.zeros(inside.shape, np.uint8), np.zeros(inside.shape, np.uint8)
    depth_std = np.full(inside.shape, np.nan, np.float32)
    columns = slice(0, inside.shape[1])
    rays_C: Any = np.broadcast_to(np.array([0.0, 0.0, 1.0]), (*inside.shape, 3))
    if whole.camera is not None:
        rays_C = np.empty((*inside.shape, 3), np.float32)
    scale = np.float32(1.0 if whole.scene.seen.central else solution.factor)

    def fill(rows: slice) -> Indices:
        here = inside[rows]
        component[rows] = np.where(here, solution.at(coarse.component, rows, columns), 0)
        layer[rows] = np.where(here, solution.at(coarse.layer, rows, columns), 0)
        depth_std[rows] = np.where(here, scale * solution.at(coarse.depth_std, rows, columns), np.nan)
        if whole.camera is not None:
            rays_C[rows] = whole.rays_C(rows, columns)
        return np.bincount(component[rows].ravel(), minlength=256)

    height = inside.shape[0]
    bands = [slice(first, min(first + BAND_ROWS, height)) for first in range(0, height, BAND_ROWS)]
    pixels = np.sum(run_all(fill, bands), axis=0)
    components = tuple(replace(piece, pixels=int(pixels[piece.label])) for piece in coarse.components)
    used = found.lights_used[inside]
    three = int(np.sum(np.isfinite(found.normal_std_deg[inside]) & (used >= 3)))
    figures = replace(coarse.figures, pixels=int(inside.sum()), pixels_with_three_lights=three, median_lights_used=float(np.median(used)))
    return replace(
        coarse,
        normals=found.normals,
        depth=found.depth,
        albedo=found.albedo,
        mask=inside,
        normal_std_deg=found.normal_std_deg,
        depth_std=depth_std,
        lights_used=found.lights_used,
        component=component,
        rays_C=rays_C,
        components=components,
        figures=figures,
        breaks=found.breaks,
        layer=layer,
    )
