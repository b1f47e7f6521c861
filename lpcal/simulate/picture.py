r"""Images of a scene, each light by itself and the room's light by itself.

Symbols: rho a point's albedo, n its normal, J what the scene throws on it (see interreflection), A the room's radiance on white::

    radiance = direct + rho J             a light
    radiance = rho A (1 + n . up / 3)     the room

A pixel is one ray, or sixteen where an outline crosses it. A chrome sphere shows what its mirrored rays meet instead; what it throws on
the wall, a thin glow far from it, is left out, and so is what the thin dark rod under a sphere throws.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Index, Labels, Mask
from lpcal.simulate.interreflection import ThrownLight, thrown
from lpcal.simulate.lens import Lens
from lpcal.simulate.scene import DrawnScene, Points, direct, meet, wall_reflectance

EDGE_OVERSAMPLING = 4
CHUNK = 1 << 15
MIRROR = 0.6
WALL_HALF_M = 0.45
"""Half the wall's side: beyond it a mirror shows the room."""
ROD_ALBEDO = 0.04
ROOM_SHARE = (0.6, 0.8)
"""Radiance of the room over that of a white surface in it: beside the object, and how much more of it behind the camera."""
NODES = 20000, 6000
"""Pixels, of the shape and of the wall, at which the light that the scene throws on itself is gathered."""


@dataclass(frozen=True)
class Rendered:
    """Light (L, H, W) of each light, (H, W) of the room, and the truth a pixel."""

    light: Array
    room: Array
    normals: Array
    depth: Array
    albedo: Array
    mask: Mask
    component: Labels


def render(lens: Lens, scene: DrawnScene) -> Rendered:
    """All lights and the room, unblurred, with the truth at the pixels' centres."""
    width, height = lens.image_size
    plane = lens.grid()
    met = _seen(scene, plane.reshape(-1, 2))
    component = np.zeros(len(met.x_C), np.uint8)
    component[met.on_shape] = scene.shape.component(se3.apply(se3.inv(scene.H_CS), met.x_C[met.on_shape]))
    edge = _edges(met, component, (height, width), 3 if scene.chrome else 1)
    rays, pixel, weight = _samples(lens, plane.reshape(-1, 2), edge)
    between = None if scene.chrome else thrown(scene, met[_nodes(met.on_shape, width)])
    light, room = np.zeros((len(scene.lights), width * height)), np.zeros(width * height)
    for start in range(0, len(rays), CHUNK):
        part = slice(start, start + CHUNK)
        lit, soft = _radiance(scene, rays[part], between)
        for k in range(len(light)):
            light[k] += np.bincount(pixel[part], weight[part] * lit[k], width * height)
        room += np.bincount(pixel[part], weight[part] * soft, width * height)
    return Rendered(
        light=light.reshape(-1, height, width),
        room=room.reshape(height, width),
        normals=np.where(met.on_shape[:, None], met.n_C, np.nan).reshape(height, width, 3),
        depth=np.where(met.on_shape, met.x_C[:, 2], np.nan).reshape(height, width),
        albedo=np.where(met.on_shape, met.albedo, np.nan).reshape(height, width),
        mask=met.on_shape.reshape(height, width),
        component=component.reshape(height, width),
    )


def _radiance(scene: DrawnScene, plane: Array, between: ThrownLight | None) -> tuple[Array, Array]:
    """What rays (N, 2) of the image see of each light (L, N) and of the room (N,)."""
    points, glow = _seen(scene, plane), np.zeros(len(plane))
    if scene.chrome:
        points, glow = _mirrored(scene, points, plane)
    lit = np.stack([direct(scene, points, light) for light in scene.lights])
    if between is not None:
        lit += points.albedo * between.at(points)
    return lit, points.albedo * scene.ambient * (1 - points.n_C[:, 1] / 3) + glow


def _samples(lens: Lens, plane: Array, edge: Mask) -> tuple[Array, Index, Array]:
    """Rays (N, 2), the pixel of each and its weight there: one a pixel, more where an edge crosses it."""
    plain, crossed, n = np.flatnonzero(~edge), np.flatnonzero(edge), EDGE_OVERSAMPLING
    offset = (np.arange(n) + 0.5) / n - 0.5
    middle = np.stack([crossed % lens.image_size[0], crossed // lens.image_size[0]], axis=1)
    at = middle[:, None] + np.stack(np.meshgrid(offset, offset), axis=-1).reshape(1, -1, 2)
    rays = np.concatenate([plane[plain], lens.plane(at.reshape(-1, 2))])
    pixel = np.concatenate([plain, np.repeat(crossed, n * n)])
    return rays, pixel, np.concatenate([np.ones(len(plain)), np.full(len(crossed) * n * n, 1 / n**2)])


def _nodes(on_shape: Mask, width: int) -> Index:
    """Pixels, by their index, at which the light that the scene throws on itself is gathered: grids on the shape and on the wall."""
    found = []
    for on, most in zip((on_shape, ~on_shape), NODES, strict=True):
        step = int(np.ceil(np.sqrt(on.sum() / most)))
        pixel = np.flatnonzero(on)
        found.append(pixel[(pixel % width % step == step // 2) & (pixel // width % step == step // 2)])
    return np.concatenate(found)


def _directions(plane: Array) -> Array:
    d_C = np.column_stack([plane, np.ones(len(plane))])
    return np.asarray(d_C / np.linalg.norm(d_C, axis=1, keepdims=True))


def _seen(scene: DrawnScene, plane: Array) -> Points:
    """What rays (N, 2) of the image meet first: the shape, else the rod, else the wall."""
    d_C = _directions(plane)
    points = meet(scene, np.zeros(3), d_C)
    on_rod = ~points.on_shape & _rod(scene, d_C)
    points.x_C[on_rod] = d_C[on_rod] * (scene.H_CS[2, 3] / d_C[on_rod, 2])[:, None]
    points.albedo[on_rod] = ROD_ALBEDO
    return points


def _rod(scene: DrawnScene, d_C: Array) -> Mask:
    """Rays that meet the rod: it goes down from the shape's middle, in the plane of that depth."""
    at = d_C[:, :2] * (scene.H_CS[2, 3] / d_C[:, 2])[:, None] - scene.H_CS[:2, 3]
    return np.asarray((np.abs(at[:, 0] + 0.03 * at[:, 1]) < scene.rod_m) & (at[:, 1] > 0))


def _edges(met: Points, component: Labels, size: tuple[int, int], reach: int) -> Mask:
    """Pixels (H*W,) that an outline or a jump in depth may cross."""
    from scipy.ndimage import binary_dilation, maximum_filter, minimum_filter

    label, depth = component.reshape(size), met.x_C[:, 2].reshape(size)
    across = (maximum_filter(label, 3) != minimum_filter(label, 3)) | (maximum_filter(depth, 3) - minimum_filter(depth, 3) > 0.02 * depth)
    near = binary_dilation(label > 0, iterations=3)
    return np.asarray(binary_dilation(across & near, iterations=reach)).ravel()


def _mirrored(scene: DrawnScene, points: Points, plane: Array) -> tuple[Points, Array]:
    """Points that a chrome sphere shows in place of its own, the wall behind it; and the room light (N,) of the dark panel and the room."""
    d_C = _directions(plane)
    r_C = d_C - 2 * np.sum(d_C * points.n_C, axis=1, keepdims=True) * points.n_C
    away = -(r_C @ scene.wall_n_C)
    s = ((scene.wall_x_C - points.x_C) @ -scene.wall_n_C) / np.maximum(away, 1e-6)
    at_wall = points.x_C[:, :2] + s[:, None] * r_C[:, :2] - scene.H_CS[:2, 3]
    to_wall = points.on_shape & (away > 0.02) & (np.abs(at_wall).max(axis=1) < WALL_HALF_M)
    to_room = points.on_shape & ~to_wall
    x_C = np.where(to_wall[:, None], points.x_C + s[:, None] * r_C, points.x_C)
    n_C = np.where(points.on_shape[:, None], scene.wall_n_C, points.n_C)
    albedo = np.where(to_wall, MIRROR * wall_reflectance(scene, x_C), np.where(to_room, 0.0, points.albedo))
    back = points.x_C[:, 2] / np.maximum(-r_C[:, 2], 1e-6)
    at_panel = points.x_C[:, :2] + back[:, None] * r_C[:, :2]
    dark = (r_C[:, 2] < 0) & (np.hypot(*at_panel.T) < scene.panel_radius_m)
    front = np.clip(-r_C[:, 2], 0, 1) ** 2
    cloud = 1 - 0.3 * r_C[:, 1] + 0.2 * np.sin(5 * r_C[:, 0] + 1) * np.sin(4 * r_C[:, 1])
    sky = scene.ambient * (ROOM_SHARE[0] + ROOM_SHARE[1] * front) * cloud
    glow = np.where(to_room, MIRROR * np.where(dark, 0.15, 1.0) * sky, 0.0)
    return Points(x_C, n_C, albedo, points.on_shape & ~to_wall), glow
