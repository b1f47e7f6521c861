r"""Light that the scene throws on itself: cosine-distributed rays, which end at surfels of the true surfaces.

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

from lpcal.geometry.arrays import Array, Index
from lpcal.simulate.rays import LEAVE
from lpcal.simulate.scene import DrawnScene, Points, direct, joined, meet

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
CHUNK = 1 << 17


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
    """The light that the scene throws on nodes on its surfaces, every bounce of it."""
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
    for start in range(0, len(points.x_C), CHUNK // rays):
        some = points[start : start + CHUNK // rays]
        d_C = _directions(some.n_C, start * rays, rays)
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


def _directions(n_C: Array, first: int, rays: int) -> Array:
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
