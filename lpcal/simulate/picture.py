r"""Images of a scene, each light by itself and the room's light by itself.

Symbols: rho a point's albedo, n its normal, J the interreflected light on it (see interreflection), A the room's radiance on white::

    radiance = direct + rho J             a light
    radiance = rho A (1 + n . up / 3)     the room

A pixel is one ray, or sixteen where an outline crosses it. A chrome sphere shows what its mirrored rays meet instead; what it reflects onto
the wall, a thin glow far from it, is left out, and so is what the thin dark rod under a sphere reflects.

Interreflected light of the scene: cosine-distributed rays, which end at surfels of the true surfaces.

Symbols: d_m the M rays of a point, of density cos / pi over its hemisphere, s(m) the surfel nearest to where ray m ends, D_s a surfel's
radiance under the lamp alone, rho_s its albedo, L_s its radiance with every bounce::

    J(x) = 1/M sum_m L_s(m)            irradiance from the scene over pi: a point of albedo rho has rho J more radiance
    L_s  = D_s + rho_s J(x_s)          by as many turns as there are bounces

Surfels are the ends of the rays themselves, one of each small box, so that faces which the camera does not see throw light as well. The
rays are the same for all lamps. Sources: J. T. Kajiya, The rendering equation (1986); G. Ward et al., A ray tracing solution for diffuse
interreflection (1988); A. Keller, Instant radiosity (1997), for light carried by samples.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Index, Labels, Mask
from lpcal.simulate.lens import Lens
from lpcal.simulate.rays import LEAVE
from lpcal.simulate.scene import DrawnScene, Points, direct, joined, meet, wall_reflectance

EDGE_OVERSAMPLING = 4
CHUNK = 1 << 15
MIRROR = 0.6
WALL_HALF_M = 0.45
"""Half the wall's side: beyond it a mirror shows the room."""
ROD_ALBEDO = 0.04
ROOM_SHARE = (0.6, 0.8)
"""Radiance of the room over that of a white surface in it: beside the object, and how much more of it behind the camera."""
NODES = 20000, 6000
"""Pixels, of the shape and of the wall, at which the interreflected light of the scene is gathered."""


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
    """Pixels, by their index, at which the interreflected light of the scene is gathered: grids on the shape and on the wall."""
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


RAYS, SURFEL_RAYS = 64, 32
BOUNCES = 8
BOXES = 32
"""Boxes of surfels to the shape's bounding radius; beyond it they grow with the distance."""
FINE_ENOUGH = 3e-4
"""Touch of a ray, in bounding radii: it need not end as exactly as those of the image."""
NEIGHBOURS = 16
TURN = 12.0
"""How many node distances a turn of the normal by one radian counts."""
SEQUENCE = (0.7548776662466927, 0.5698402909980532)
"""Steps of the R2 sequence: the inverse of the plastic number, and its square."""
RAYS_AT_ONCE = 1 << 17


@dataclass(frozen=True)
class ThrownLight:
    """J (N, L) at nodes: the radiance that a white point there would have of it, for each light."""

    nodes: Points
    J: Array
    length_m: float
    """From one node to the next, about."""

    def at(self, points: Points) -> Array:
        """J (L, N) at points: a mean over the nodes near them whose normals are like theirs."""
        apart, index = self._tree.query(_place(points, self.length_m, TURN), min(NEIGHBOURS, len(self.J)))
        weight = (1 - (apart / (1.001 * apart[:, -1:] + 1e-12)) ** 2) ** 2
        weight /= weight.sum(axis=1, keepdims=True)
        return np.einsum("nk,nkl->ln", weight, self.J[index])

    @cached_property
    def _tree(self) -> Any:
        from scipy.spatial import cKDTree

        return cKDTree(_place(self.nodes, self.length_m, TURN))


def thrown(scene: DrawnScene, nodes: Points) -> ThrownLight:
    """The interreflected light of the scene on nodes on its surfaces, every bounce of it."""
    length_m = float(np.median(np.linalg.norm(np.diff(nodes.x_C, axis=0), axis=1)))
    ends, of_node = gather(scene, nodes, RAYS)
    if not len(of_node):
        return ThrownLight(nodes, np.zeros((len(nodes.x_C), len(scene.lights))), length_m)
    surfels = thin(scene, ends)
    D = np.stack([direct(scene, surfels, light) for light in scene.lights], axis=1)
    back = transfer(scene, surfels, *gather(scene, surfels, SURFEL_RAYS), len(D), SURFEL_RAYS)
    L = D
    for _ in range(BOUNCES - 1):
        L = D + surfels.albedo[:, None] * (back @ L)
    return ThrownLight(nodes, transfer(scene, surfels, ends, of_node, len(nodes.x_C), RAYS) @ L, length_m)


def gather(scene: DrawnScene, points: Points, rays: int) -> tuple[Points, Index]:
    """Where cosine-distributed rays of points end, those that meet something, and the index of the point of each."""
    ends, owners = [], []
    for start in range(0, len(points.x_C), RAYS_AT_ONCE // rays):
        some = points[start : start + RAYS_AT_ONCE // rays]
        d_C = _cosine_directions(some.n_C, start * rays, rays)
        o_C = np.repeat(some.x_C + LEAVE * scene.shape.bound_m * some.n_C, rays, axis=0)
        met = meet(scene, o_C, d_C, FINE_ENOUGH)
        found = np.flatnonzero(met.albedo > 0)
        ends.append(met[found])
        owners.append(start + found // rays)
    return joined(ends), np.concatenate(owners)


def thin(scene: DrawnScene, ends: Points) -> Points:
    """One of the ends in each box and octant of normals; boxes grow with the distance from the shape."""
    away = np.linalg.norm(ends.x_C - scene.H_CS[:3, 3], axis=1) / scene.shape.bound_m
    level = np.ceil(np.log2(np.maximum(away, 1))).astype(np.int64)
    box = np.floor(ends.x_C / (scene.shape.bound_m / BOXES * 2.0**level)[:, None]).astype(np.int64)
    octant = (ends.n_C > 0) @ np.array([1, 2, 4]) + 8 * ends.on_shape
    key = np.column_stack([box, level, octant])
    key -= key.min(axis=0)
    _, first = np.unique(np.ravel_multi_index(tuple(key.T), tuple(key.max(axis=0) + 1)), return_index=True)
    return ends[first]


def transfer(scene: DrawnScene, surfels: Points, ends: Points, owner: Index, count: int, rays: int) -> Any:
    """Sparse (count, S): the share of each of `count` points' rays that ends nearest to each surfel."""
    from scipy.sparse import csr_array
    from scipy.spatial import cKDTree

    length_m = scene.shape.bound_m / BOXES
    index = np.asarray(cKDTree(_place(surfels, length_m, 2.0)).query(_place(ends, length_m, 2.0))[1])
    return csr_array((np.full(len(index), 1 / rays), (owner, index)), shape=(count, len(surfels.x_C)))


def _cosine_directions(n_C: Array, first: int, rays: int) -> Array:
    """Unit vectors (N * rays, 3) about normals (N, 3), of density cosine / pi; `first` is the first one's place in the sequence.

    The frame about a normal is that of T. Duff et al., Building an orthonormal basis, revisited (2017).
    """
    u, v = ((0.5 + np.arange(first, first + len(n_C) * rays)[:, None] * SEQUENCE) % 1).T
    x, y, z = np.repeat(n_C, rays, axis=0).T
    sign = np.where(z < 0, -1.0, 1.0)
    a, b = -1 / (sign + z), -x * y / (sign + z)
    e_C = np.stack([1 + sign * x * x * a, sign * b, -sign * x], axis=1)
    f_C = np.stack([b, sign + y * y * a, -y], axis=1)
    r, angle = np.sqrt(u), 2 * np.pi * v
    flat = (r * np.cos(angle))[:, None] * e_C + (r * np.sin(angle))[:, None] * f_C
    return np.asarray(flat + np.sqrt(1 - u)[:, None] * np.stack([x, y, z], axis=1))


def _place(points: Points, length_m: float, turn: float) -> Array:
    """Coordinates (N, 7) in which points of like position and normal are near: a radian of turn counts as `turn` lengths."""
    return np.column_stack([points.x_C / length_m, turn * points.n_C, 1e3 * points.on_shape])
