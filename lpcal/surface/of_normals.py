"""A surface from a normal map that was found elsewhere: depth and mesh; normals do not tell the distance."""

from __future__ import annotations

import numpy as np

from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Camera
from lpcal.records.figures import SurfaceFigures
from lpcal.records.surface import Component, Surface
from lpcal.surface import bilateral, pieces
from lpcal.surface.integrate import Grid
from lpcal.surface.sight import ray_map

FEWEST_PIXELS = 50
UNKNOWN_DISTANCE = 0.5
"""Relative standard deviation of a distance that nothing tells."""


def surface_of_normals(name: str, normals_C: Image, mask: Mask, camera: Camera | None, distance_m: float) -> Surface:
    """The surface of normals (H, W, 3) in C within a mask (H, W); its median depth is put at `distance_m`, or at 0 pixels without a camera.

    Raises
    ------
    DisagreementError
        The map is not of the camera's size.
    DegenerateError
        Too few pixels, or most normals look away from the camera.
    """
    check(name, mask, camera)
    rays_C = ray_map(mask.shape, camera)
    n = lambert.unit(normals_C[mask].astype(float))[0]
    away = float(np.mean(np.einsum("pi,pi->p", n, rays_C[mask]) >= 0))
    if away > 0.5:
        raise DegenerateError(
            f"{100 * away:.0f} % of the normals look away from the camera", where=name, needed="normals of what the camera sees"
        )
    grid = Grid.of(mask)
    u, weight = bilateral.integrate_normals(grid, n, rays_C[mask], central=camera is not None)
    weight = pieces.without_slivers(grid, weight, mask)
    depth = u - np.median(u) if camera is None else distance_m * np.exp(u - np.median(u))
    label = pieces.pieces(grid, weight, mask)

    def as_map(values: Array) -> Image:
        found = np.full((*mask.shape, *values.shape[1:]), np.nan, np.float32)
        found[mask] = values
        return found

    unknown = np.full(len(n), np.nan)
    labels = np.zeros(mask.shape, np.uint8)
    labels[mask] = label
    return Surface(
        name=name,
        normals=as_map(n),
        depth=as_map(depth),
        albedo=as_map(np.ones(len(n))),
        mask=mask,
        normal_std_deg=as_map(unknown),
        depth_std=as_map(unknown),
        lights_used=np.zeros(mask.shape, np.uint8),
        component=labels,
        rays_C=rays_C,
        components=tuple(
            Component(int(one), int((label == one).sum()), float(depth[label == one].mean()), UNKNOWN_DISTANCE) for one in np.unique(label)
        ),
        figures=SurfaceFigures(pixels=len(n), normals_away_from_the_camera=round(away, 4)),
        breaks=pieces.break_map(grid, weight, mask),
    )


def check(name: str, mask: Mask, camera: Camera | None) -> None:
    """Refuse a map of another size than the camera's, or of too few pixels.

    Raises
    ------
    DisagreementError, DegenerateError
        It is one of the two.
    """
    height, width = mask.shape
    if camera is not None and (width, height) != tuple(camera.image_size):
        raise DisagreementError(
            f"normals of {width}x{height}",
            where=name,
            needed=f"{camera.image_size[0]}x{camera.image_size[1]}, the calibrated camera's size",
            todo="give the map of the whole image, or leave the calibration out",
        )
    if mask.sum() < FEWEST_PIXELS:
        raise DegenerateError(
            f"normals of {mask.sum()} pixels", where=name, needed=f"{FEWEST_PIXELS} at least", todo="check the map and the mask"
        )
