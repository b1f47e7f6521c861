r"""A robot carries the panel round an object: where it stops, and how it gets from one stop to the next.

Symbols: S the object's frame (x right, y down, z away from the first stop), a the azimuth round its upright axis, e the elevation::

    c_S  = d [-sin a cos e, -sin e, -cos a cos e]           the camera, which looks at the object's middle
    H_OC = H_OS inv(H_CS),   H_OP = H_OC inv(H_PC)          the stop in the room

Stops lie on rings about the object: most near its height, the others above it and below.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Index
from lpcal.geometry.isosurface import isosurface
from lpcal.simulate import shapes
from lpcal.simulate.built import Built

RINGS = ((10.0, 0.50), (42.0, 0.30), (-28.0, 0.20))
"""Elevation in degrees of each ring of stops, and its share of them: the belt of an object takes more than its top or its underside."""
SCATTER = (0.03, 0.02)
"""How far stops scatter, one standard deviation: of the distance to the object, and in radians of each turn: as a taught path does."""
SIZE_SHARE = 0.7
"""Size of the object over half the field of view at the working distance: so it is whole in the image from all sides."""
SHAPES = {name: shapes.SHAPES[name] for name in ("bust", "pair")} | shapes.ROUND
"""Objects that are worth a look from all sides, by name."""


@dataclass(frozen=True)
class Tour:
    """The object in the room and the camera at every stop."""

    shape: shapes.Shape
    H_OS: Array
    """(4, 4) the object's frame in the room, metres."""
    H_CS: Array
    """(N, 4, 4) the object seen from the camera at each stop."""

    @property
    def H_OC(self) -> Array:
        """The camera (N, 4, 4) in the room."""
        return np.asarray(self.H_OS @ se3.inv(self.H_CS))


def solid(shape: shapes.Shape, step_m: float) -> tuple[Array, Index]:
    """Vertices (V, 3) in S on the object's surface, and triangles (F, 3), counter-clockwise seen from outside.

    Raises
    ------
    InputError
        scikit-image is not installed.
    """
    reach = np.arange(-shape.bound_m - 2 * step_m, shape.bound_m + 3 * step_m, step_m)
    plane = np.stack(np.meshgrid(reach, reach, indexing="ij"), axis=-1).reshape(-1, 2)
    distance = np.stack([shape.distance(np.column_stack([np.full(len(plane), x), plane])).reshape(len(reach), -1) for x in reach])
    vertices, faces = isosurface(distance.astype(np.float32))
    x_S = reach[0] + step_m * vertices
    for _ in range(3):
        x_S = x_S - shape.normal(x_S) * (shape.distance(x_S) / _steepness(shape, x_S))[:, None]
    return x_S, faces


def _steepness(shape: shapes.Shape, x_S: Array) -> Array:
    """How fast the signed distance grows along the normal: 1 where it is exact, less where it is only a bound."""
    step = 1e-4 * shape.bound_m * shape.normal(x_S)
    rise = shape.distance(x_S + step) - shape.distance(x_S - step)
    return np.asarray(np.maximum(rise / (2e-4 * shape.bound_m), 0.1))


def plan(built: Built, name: str, stops: int, seed: int) -> Tour:
    """A path round an object of a name, from ring to ring, the way round on each."""
    rng = np.random.default_rng([seed, 10])
    lens, focus_C = built.lens, built.focus_C
    half_m = float(focus_C[2] * min(lens.image_size[0] / lens.K[0, 0], lens.image_size[1] / lens.K[1, 1]) / 2)
    shape = shapes.grained(SHAPES[name](SIZE_SHARE * half_m), rng)
    poses = []
    for azimuth, elevation in _stops(stops):
        H_CS = se3.transform(_looking(azimuth, elevation), focus_C * [1, 1, 1 + np.clip(rng.normal(0, SCATTER[0]), -0.06, 0.06)])
        turn = np.clip(rng.normal(0, SCATTER[1], 3), -0.04, 0.04)
        poses.append(se3.transform(se3.rotation(turn), np.zeros(3)) @ H_CS)
    upright = se3.rotation(np.array([np.pi, 0, 0])) @ se3.rotation(np.array([0, rng.uniform(-np.pi, np.pi), 0]))
    return Tour(shape, se3.transform(upright, np.array([1.1, 1.15, 0.5]) + rng.normal(0, 0.1, 3)), np.array(poses))


def _stops(count: int) -> list[tuple[float, float]]:
    """Azimuth and elevation of each stop, in radians."""
    shares = np.array([share for _, share in RINGS]) * count
    numbers = np.maximum(np.floor(shares).astype(int), 1)
    for place in np.argsort(shares % 1)[::-1]:
        numbers[place] += numbers.sum() < count
    found = []
    for ring, ((elevation_deg, _), number) in enumerate(zip(RINGS, numbers, strict=True)):
        azimuth = 2 * np.pi * (np.arange(number) + 0.37 * ring) / number
        found += [(float(a), float(np.radians(elevation_deg))) for a in azimuth]
    return found[:count]


def _looking(azimuth: float, elevation: float) -> Array:
    """R_CS of a camera that looks at the object's middle, its x axis level."""
    z_S = np.array([np.sin(azimuth) * np.cos(elevation), np.sin(elevation), np.cos(azimuth) * np.cos(elevation)])
    x_S = np.cross([0.0, 1.0, 0.0], z_S)
    x_S /= np.linalg.norm(x_S)
    return np.stack([x_S, np.cross(z_S, x_S), z_S])
