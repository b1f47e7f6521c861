"""A surface by a method to compare: normals from the shading at one distance, then a depth from the normals.

With near lights all points are taken to be at the working distance, as the papers of these methods do: what that costs is part of what is
compared. Slopes of u: without a camera ``du/dx = -n_x / n_z``; with one u is the log of depth, ``du/dx = -(n . dr/dx) / (n . r)`` for rays
r of length 1 in z.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from lpcal import methods
from lpcal.errors import DegenerateError, InputError
from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.integration.mesh import ends_of
from lpcal.integration.of_normals import UNKNOWN_DISTANCE, surface_of_normals
from lpcal.records.calibration import Calibration, Camera
from lpcal.records.figures import SurfaceFigures
from lpcal.records.observations import Radiance
from lpcal.records.surface import Component, Surface
from lpcal.segmentation import mask as masks
from lpcal.segmentation.mask import Hints
from lpcal.view import pixel_list

OWN = "lpcal"
"""The name of lpcal's own integrator."""
STEEPEST = 0.05
"""Least -n . r at which a normal gives a slope: steeper ones are slopes of this."""
NO_SIGMAS = "by the method {method}, to compare: the normals carry no standard deviations, and the distance is not measured"


def of_name[Method](name: str, known: Mapping[str, Method], where: str, *others: str) -> Method | None:
    """A method by its name; None for one of `others`, which are lpcal's own.

    Raises
    ------
    InputError
        There is none of this name.
    """
    if name in others:
        return None
    if name not in known:
        raise InputError(repr(name), where=where, needed=", ".join([*others, *known]), todo="or add yours to lpcal.methods")
    return known[name]


def reconstruct(
    radiance: Radiance, calibration: Calibration, object_mask: Mask | None, hints: Hints, distance_m: float, method: str, integrator: str
) -> Surface:
    """The surface by a method of `methods.NORMALS` and an integrator of `methods.INTEGRATORS`, or lpcal's own.

    Raises
    ------
    DegenerateError
        The method determines no normal.
    InputError
        There is no method of this name, or it returns something else than (P, 3) numbers.
    """
    pixel_list.agree_on_size(radiance.name, radiance.signal.shape[1:3], calibration.camera)
    lights = pixel_list.lights_of(calibration, radiance)
    maps, rays_C = pixel_list.grey(radiance, lights), pixel_list.ray_map(radiance.signal.shape[1:3], calibration.camera)
    near = calibration.camera is not None and any(light.source_C is not None for light in lights)
    if object_mask is None:
        object_mask = masks.automatic(maps, rays_C, lights, distance_m if near else None, hints, pixel_list.room(radiance)).mask
    seen = pixel_list.list_pixels(maps, rays_C, object_mask, central=calibration.camera is not None)
    focus_C = None if near else np.array([0.0, 0.0, distance_m])
    d, E = pixel_list.light_vectors(lights, seen.rays_C * distance_m, focus_C)
    function = of_name(method, methods.NORMALS, "method")
    assert function is not None
    b = np.asarray(function(methods.Shading(seen.signal, seen.sigma, seen.usable, d * E[..., None])), dtype=float)
    if b.shape != (seen.pixels, 3):
        raise InputError(f"{b.shape} from the method {method}", where="method", needed=f"({seen.pixels}, 3)")
    known = np.isfinite(b).all(axis=1) & (np.einsum("pi,pi->p", b, seen.rays_C) < 0)
    if not known.any():
        raise DegenerateError(f"the method {method} determines no normal", where=radiance.name, needed="three lights that reach a pixel")
    inside = object_mask.copy()
    inside[object_mask] = known
    normals, length = lambert.unit(b[known])
    normals_C = np.full((*inside.shape, 3), np.nan, np.float32)
    normals_C[inside] = normals
    surface = integrated(radiance.name, normals_C, inside, calibration.camera, distance_m, integrator)
    albedo = np.full(inside.shape, np.nan, np.float32)
    albedo[inside] = np.ravel(length)
    used = np.zeros(inside.shape, np.uint8)
    used[inside] = seen.usable.sum(axis=0)[known]
    return replace(surface, albedo=albedo, lights_used=used, warnings=(NO_SIGMAS.format(method=method),))


def integrated(name: str, normals_C: Image, mask: Mask, camera: Camera | None, distance_m: float, integrator: str) -> Surface:
    """The surface of normals (H, W, 3) in C by an integrator of `methods.INTEGRATORS`, or lpcal's own.

    Raises
    ------
    InputError
        There is no integrator of this name, or it returns something else than (H, W) numbers within the mask.
    """
    function = of_name(integrator, methods.INTEGRATORS, "integrator", OWN)
    if function is None:
        return surface_of_normals(name, normals_C, mask, camera, distance_m)
    rays_C = pixel_list.ray_map(mask.shape, camera)
    u = np.asarray(function(slopes_of(normals_C, rays_C, central=camera is not None), mask), dtype=float)
    if u.shape != mask.shape or not np.isfinite(u[mask]).all():
        raise InputError(f"{u.shape} from the integrator {integrator}", where="integrator", needed=f"{mask.shape}, finite in the mask")
    u = u - np.median(u[mask])
    return _assembled(name, normals_C, u if camera is None else distance_m * np.exp(u), mask, rays_C)


def slopes_of(normals_C: Image, rays_C: Array, *, central: bool) -> Array:
    """Slopes (H, W, 2) of u a pixel, of normals (H, W, 3) seen along rays (H, W, 3)."""
    facing = np.minimum(np.einsum("hwi,hwi->hw", normals_C, rays_C), -STEEPEST)
    if not central:
        return np.asarray(-normals_C[..., :2] / facing[..., None], dtype=float)
    return np.stack([-np.einsum("hwi,hwi->hw", normals_C, np.gradient(rays_C, axis=axis)) / facing for axis in (1, 0)], axis=-1)


def _assembled(name: str, normals_C: Image, depth: Array, mask: Mask, rays_C: Array) -> Surface:
    """The record; pieces are the connected parts of the mask, without breaks."""

    def within(values: Array) -> Image:
        return np.where(mask, values, np.nan).astype(np.float32)

    most = np.iinfo(np.uint8).max
    component = np.minimum(raster.connected_components(mask)[0], most).astype(np.uint8)
    labels = [int(one) for one in np.unique(component[mask])]
    return Surface(
        name=name,
        normals=normals_C,
        depth=within(depth),
        albedo=within(np.ones(mask.shape)),
        mask=mask,
        normal_std_deg=within(np.full(mask.shape, np.nan)),
        depth_std=within(np.full(mask.shape, np.nan)),
        lights_used=np.zeros(mask.shape, np.uint8),
        component=component,
        rays_C=rays_C,
        components=tuple(Component(k, int((component == k).sum()), float(depth[component == k].mean()), UNKNOWN_DISTANCE) for k in labels),
        figures=SurfaceFigures(pixels=int(mask.sum())),
        breaks=ends_of(mask),
    )
