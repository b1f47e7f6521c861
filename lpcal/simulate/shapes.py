r"""Objects as signed distances, in a frame S of their own: origin in the object's middle, x right, y down, z away from the camera.

A piece's signed distance takes coordinates (3, N), one row an axis, for speed. It is at most the distance to the surface and negative
inside, so a ray may go that far without missing it.
Unions of ellipsoids are blended with a polynomial smooth minimum. Source: J. C. Hart, Sphere Tracing (1996).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from lpcal.geometry.arrays import Array, Index, Labels

ROPE_CELLS = 48
"""Cells along each edge of the cube in which a rope's near segments are listed: of 96 segments some eight are left to
a cell, finer cells are not faster, and the lists take some tenths of a second to make."""
ROPE_AT_ONCE = 1 << 13
"""Points whose distance from a rope is found together: their pairs with its segments fit a processor's cache."""

type Distance = Callable[[Array], Array]
"""Signed distance (N,) at coordinates (3, N)."""


@dataclass(frozen=True)
class Shape:
    """An object of a bounding radius about the origin of S."""

    note: str
    bound_m: float
    pieces: tuple[Distance, ...]
    """One signed distance a connected piece."""
    albedo: float = 0.7
    texture: float = 0.03
    """1 sigma of the albedo, relative."""
    texture_length_m: float = 0.012
    waves: Array = field(default_factory=lambda: np.zeros((0, 4)))
    """(K, 4) wave vectors and phases of the texture."""

    def distance(self, x_S: Array) -> Array:
        """Signed distance (N,) of points (N, 3)."""
        return self.distance_at(np.ascontiguousarray(x_S.T))

    def distance_at(self, x: Array) -> Array:
        """Signed distance (N,) at coordinates (3, N) in S."""
        found = self.pieces[0](x)
        for piece in self.pieces[1:]:
            found = np.minimum(found, piece(x))
        return found

    def component(self, x_S: Array) -> Labels:
        """The nearest piece (N,), counted from 1."""
        return (1 + np.argmin([piece(x_S.T) for piece in self.pieces], axis=0)).astype(np.uint8)

    def normal(self, x_S: Array) -> Array:
        """Outward unit normals (N, 3) by central differences."""
        step = 1e-4 * self.bound_m
        slope = [self.distance(x_S + step * axis) - self.distance(x_S - step * axis) for axis in np.eye(3)]
        n = np.stack(slope, axis=-1)
        return np.asarray(n / np.maximum(np.linalg.norm(n, axis=-1, keepdims=True), 1e-30))

    def reflectance(self, x_S: Array) -> Array:
        """Albedo (N,) at points of the surface."""
        if not len(self.waves):
            return np.full(len(x_S), self.albedo)
        grain = np.sin(x_S @ self.waves[:, :3].T + self.waves[:, 3]).sum(axis=1) * np.sqrt(2 / len(self.waves))
        return np.asarray(self.albedo * (1 + self.texture * grain))


def sphere(radius_m: float, waves: Array | None = None, albedo: float = 0.72, texture: float = 0.02) -> Shape:
    """A sphere about the origin."""
    note = f"sphere of {1e3 * radius_m:g} mm"
    return Shape(note, radius_m, (_ball((0, 0, 0), radius_m),), albedo, texture, waves=waves if waves is not None else np.zeros((0, 4)))


def bust(size_m: float) -> Shape:
    """Head, nose, brows, neck, hair and shoulders, blended."""

    def whole(x_S: Array) -> Array:
        mirrored = x_S / size_m
        mirrored[0] = np.abs(mirrored[0])
        head = _ellipsoid(mirrored, (0, -0.34, 0), (0.40, 0.52, 0.46))
        face = _blend(head, _ellipsoid(mirrored, (0, -0.26, -0.42), (0.085, 0.16, 0.11)), 0.07)
        face = _blend(face, _ellipsoid(mirrored, (0.15, -0.46, -0.36), (0.14, 0.05, 0.10)), 0.06)
        face = _blend(face, _ellipsoid(mirrored, (0, -0.02, -0.36), (0.13, 0.05, 0.09)), 0.05)
        face = _blend(face, _ellipsoid(mirrored, (0.17, -0.17, -0.29), (0.13, 0.13, 0.13)), 0.10)
        hair = _blend(face, _ellipsoid(mirrored, (0, -0.72, 0.08), (0.42, 0.26, 0.44)), 0.05)
        neck = _blend(hair, _ellipsoid(mirrored, (0, 0.22, 0.08), (0.22, 0.42, 0.24)), 0.10)
        return size_m * _blend(neck, _ellipsoid(mirrored, (0, 0.78, 0.10), (0.72, 0.36, 0.36)), 0.16)

    return Shape("bust: blended ellipsoids", 1.15 * size_m, (whole,), albedo=0.7)


def pair(size_m: float) -> Shape:
    """A ball beside a grooved cylinder that stands somewhat nearer: two pieces."""

    def cylinder(x_S: Array) -> Array:
        x, y, z = x_S[0] / size_m - 0.42, x_S[1] / size_m, x_S[2] / size_m + 0.12
        radius = 0.34 + 0.035 * np.cos(9 * y)
        sides, ends = np.sqrt(x * x + z * z) - radius, np.abs(y) - 0.82
        outside = np.hypot(np.maximum(sides, 0), np.maximum(ends, 0)) + np.minimum(np.maximum(sides, ends), 0)
        return np.asarray(0.9 * size_m * (outside - 0.03))

    ball = _ball((-0.5 * size_m, 0.25 * size_m, 0.18 * size_m), 0.46 * size_m)
    return Shape("pair: ball and grooved cylinder", 1.15 * size_m, (ball, cylinder), albedo=0.66)


def relief(size_m: float) -> Shape:
    """A round plaque with a rim, waves and three bosses."""

    def whole(x_S: Array) -> Array:
        x, y, z = x_S / size_m
        r = np.sqrt(x * x + y * y)
        height = 0.09 * np.exp(-(((r - 0.80) / 0.07) ** 2)) + 0.035 * np.cos(8 * x + 3 * y) * np.exp(-((r / 0.65) ** 4))
        for at in ((-0.35, -0.25), (0.35, -0.2), (0.0, 0.38)):
            height = height + 0.16 * np.exp(-((x - at[0]) ** 2 + (y - at[1]) ** 2) / 0.03)
        front = -z - height
        return np.asarray(0.55 * size_m * np.maximum(np.maximum(front, z - 0.12), r - 0.95))

    return Shape("relief: round plaque with rim, waves and bosses", 1.05 * size_m, (whole,), albedo=0.75)


def card(size_m: float) -> Shape:
    """A flat square card."""

    def whole(x_S: Array) -> Array:
        return np.asarray(np.max(np.abs(x_S) - size_m * np.array([[0.75], [0.75], [0.02]]), axis=0))

    return Shape("card: flat, square", 1.1 * size_m, (whole,), albedo=0.75, texture=0.0)


def bowl(size_m: float) -> Shape:
    """A shallow spherical bowl seen from inside."""

    def whole(x_S: Array) -> Array:
        x, y, z = x_S / size_m
        shell = np.abs(np.sqrt(x * x + y * y + (z + 1.1) ** 2) - 1.4) - 0.03
        return np.asarray(size_m * np.maximum(shell, -0.12 - z))

    return Shape("bowl: shallow, seen from inside", 1.1 * size_m, (whole,), albedo=0.6)


def vase(size_m: float) -> Shape:
    """A fluted vase with two handles."""

    def whole(x_S: Array) -> Array:
        x, y, z = x_S / size_m
        r, angle = np.sqrt(x * x + z * z), np.arctan2(z, x)
        profile = 0.34 + 0.16 * np.cos(2.6 * (y - 0.15)) + 0.10 * np.maximum(-y - 0.55, 0)
        flutes = 0.018 * np.cos(12 * angle) * np.exp(-(((y - 0.15) / 0.45) ** 4))
        side = 0.72 * (r - profile - flutes)
        ends = np.abs(y) - 0.92
        body = np.hypot(np.maximum(side, 0), np.maximum(ends, 0)) + np.minimum(np.maximum(side, ends), 0) - 0.03
        handle = np.hypot(np.hypot(np.abs(x) - 0.40, y + 0.42) - 0.26, z) - 0.065
        return np.asarray(0.9 * size_m * _blend(body, handle, 0.06))

    return Shape("vase: fluted, with two handles", 1.1 * size_m, (whole,), albedo=0.68)


def knot(size_m: float) -> Shape:
    """A trefoil knot of a thick rope."""
    t = np.linspace(0, 2 * np.pi, 97)
    line = np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], axis=0) * 0.26
    rope = _rope(line, 0.19)

    def whole(x_S: Array) -> Array:
        return size_m * rope(x_S / size_m)

    return Shape("knot: a trefoil of thick rope", 1.1 * size_m, (whole,), albedo=0.72)


def stone(size_m: float) -> Shape:
    """A boulder: an ellipsoid with waves of three lengths."""
    rng = np.random.default_rng(5)
    direction = rng.standard_normal((3, 8, 3))
    direction /= np.linalg.norm(direction, axis=2, keepdims=True)
    phase = rng.uniform(0, 2 * np.pi, (3, 8))

    def whole(x_S: Array) -> Array:
        x = x_S / size_m
        found = _ellipsoid(x, (0, 0, 0), (0.82, 0.66, 0.72))
        for k, (rate, height) in enumerate(((3.0, 0.020), (8.0, 0.007), (20.0, 0.002))):
            found = found - height * np.sin(rate * (direction[k] @ x) + phase[k][:, None]).sum(axis=0)
        return np.asarray(0.6 * size_m * found)

    return Shape("stone: a boulder with waves of three lengths", 1.1 * size_m, (whole,), albedo=0.6)


def beast(size_m: float) -> Shape:
    """An animal on four legs: trunk, head, muzzle, ears, tail, blended."""

    def whole(x_S: Array) -> Array:
        x = x_S / size_m
        x[2] = np.abs(x[2])
        trunk = _ellipsoid(x, (0.05, 0.0, 0), (0.62, 0.32, 0.30))
        found = _blend(trunk, _ellipsoid(x, (-0.62, -0.34, 0), (0.26, 0.24, 0.22)), 0.22)
        found = _blend(found, _ellipsoid(x, (-0.84, -0.24, 0), (0.16, 0.12, 0.12)), 0.08)
        found = _blend(found, _ellipsoid(x, (-0.56, -0.56, 0.14), (0.06, 0.14, 0.05)), 0.04)
        found = _blend(found, _ellipsoid(x, (0.70, -0.12, 0), (0.14, 0.06, 0.06)), 0.08)
        for place in (-0.32, 0.46):
            found = _blend(found, _ellipsoid(x, (place, 0.42, 0.17), (0.13, 0.40, 0.12)), 0.10)
        return np.asarray(size_m * found)

    return Shape("beast: an animal on four legs", 1.1 * size_m, (whole,), albedo=0.7)


ROUND: dict[str, Callable[[float], Shape]] = {"vase": vase, "knot": knot, "stone": stone, "beast": beast}
"""Objects that are worth a look from all sides, by name."""
SHAPES: dict[str, Callable[[float], Shape]] = {"bust": bust, "relief": relief, "pair": pair, "card": card, "bowl": bowl}
"""Objects by name; an object of panel.yaml with another name gets the next in turn."""


def grained(bare: Shape, rng: np.random.Generator) -> Shape:
    """The object with a random texture."""
    return replace(bare, waves=grain(bare.texture_length_m, rng))


def grain(length_m: float, rng: np.random.Generator) -> Array:
    """Wave vectors and phases (24, 4) of a random texture whose details are about `length_m` across."""
    direction = rng.standard_normal((24, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    return np.column_stack([direction * 2 * np.pi / (length_m * rng.uniform(0.6, 2.5, (24, 1))), rng.uniform(0, 2 * np.pi, 24)])


def _ball(centre: tuple[float, float, float], radius: float) -> Distance:
    def whole(x_S: Array) -> Array:
        x, y, z = x_S[0] - centre[0], x_S[1] - centre[1], x_S[2] - centre[2]
        return np.asarray(np.sqrt(x * x + y * y + z * z) - radius)

    return whole


def _rope(line: Array, radius: float) -> Distance:
    """Distance from a line of straight segments (3, K + 1), less the radius.

    Only those segments are measured that may be the nearest in a point's cell of a grid: as seen from the cell's middle, none of them is
    farther than the nearest by more than the cell's diagonal. For points outside the grid all are.
    """
    a, along = line[:, :-1], np.diff(line)
    scaled = along / (along**2).sum(axis=0)
    origin = (scaled * a).sum(axis=0)

    def squares(x: Array, k: Index) -> Array:
        """Squared distances of coordinates (3, N) from segments k (N,)."""
        t = np.clip((scaled.take(k, axis=1) * x).sum(axis=0) - origin.take(k), 0, 1)
        return np.asarray(((x - a.take(k, axis=1) - along.take(k, axis=1) * t) ** 2).sum(axis=0))

    reach = float(np.abs(line).max()) + 2 * radius
    step = 2 * reach / ROPE_CELLS
    middles = np.stack(np.meshgrid(*[step * (np.arange(ROPE_CELLS) + 0.5) - reach] * 3, indexing="ij")).reshape(3, -1, 1)
    apart = [np.sqrt(squares(some, np.arange(a.shape[1])[None])) for some in np.array_split(middles, ROPE_CELLS, axis=1)]
    near = np.concatenate(
        [some <= some.min(axis=1, keepdims=True) + np.sqrt(3) * step for some in apart] + [np.ones((1, a.shape[1]), bool)]
    )
    counts, listed = near.sum(axis=1), np.nonzero(near)[1]
    starts = np.cumsum(counts) - counts

    def these(x: Array) -> Array:
        at = np.floor((x + reach) / step).astype(np.int64)
        inside = np.all((at >= 0) & (at < ROPE_CELLS), axis=0)
        cell = np.where(inside, (at[0] * ROPE_CELLS + at[1]) * ROPE_CELLS + at[2], ROPE_CELLS**3)
        count = counts[cell]
        first = np.cumsum(count) - count
        k = listed[np.repeat(starts[cell] - first, count) + np.arange(count.sum())]
        return np.sqrt(np.minimum.reduceat(squares(np.repeat(x, count, axis=1), k), first)) - radius

    def whole(x: Array) -> Array:
        parts = [these(x[:, start : start + ROPE_AT_ONCE]) for start in range(0, x.shape[1], ROPE_AT_ONCE)]
        return np.concatenate(parts) if parts else np.zeros(0)

    return whole


def _ellipsoid(x_S: Array, centre: tuple[float, float, float], radii: tuple[float, float, float]) -> Array:
    """A lower bound of the distance, near enough near the surface: f (f - 1) / g with f = |x / r|, g = |x / r^2|."""
    f2, g2 = np.zeros(x_S.shape[1]), np.full(x_S.shape[1], 1e-18)
    for x, c, r in zip(x_S, centre, radii, strict=True):
        square = ((x - c) / r) ** 2
        f2 += square
        g2 += square / r**2
    f = np.sqrt(f2)
    return np.asarray(0.9 * f * (f - 1) / np.sqrt(g2))


def _blend(a: Array, b: Array, width: float) -> Array:
    """Smooth minimum: differs from the minimum where |a - b| < width only."""
    h = np.maximum(width - np.abs(a - b), 0) / width
    return np.asarray(np.minimum(a, b) - h * h * width / 4)
