r"""A binned capture of coarse pixels, and a table of the light field over log depth at each of them.

Symbols: pixel p of ray r_p, u = log z; the table holds ``z^2 B_k(z r_p)`` at equal steps of u, with cubic (Lagrange) interpolation. The
field is smooth, so it is summed over the LEDs only on a lattice of rays. `doubt` is the relative error of the irradiance that an error of
the light's direction causes: in the tail of a lobe a tenth of a degree is several per cent.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.kernels.library import kernel
from lpcal.records.calibration import Light
from lpcal.view import parallel
from lpcal.view.pixel_list import Indices, SignalMaps, light_vectors

SPAN = (0.25, 6.0)
"""Depth range of the table, in working distances: lights neither reach farther nor are calibrated there."""
NODES = 60
"""Nodes of the table, 5 per cent of the depth apart: cubic interpolation is then right to some thousandths."""
LATTICE = (19, 25)
"""Rays down and across the image at which the field is summed: spaced more finely than the ripples of an LED cluster."""
LEAST_DIRECTION_STD_RAD = 0.0026
"""Least standard deviation of a light's axis, radians (0.15 degrees): what calibrations of panels reach."""
HELD = 12
"""Nodes by which a spline's end values are continued: more would change it by less than 1e-7 of a step."""
EVERYWHERE = (slice(None), slice(None))
"""The box of all rows and columns."""


@dataclass(frozen=True)
class RoomPrior:
    """Prior of the ambient (room) light."""

    share: Array
    """(L,) factor of the ambient part A in the signal of each light: 1 / h_k."""
    level: float
    """A of a surface of |b| = 1."""


@dataclass(frozen=True)
class Coarse:
    """P coarse pixels, row by row, of L lights."""

    signal: Array
    """(L, P), a unit of intensity."""
    sigma: Array
    usable: Mask
    rays_C: Array
    """(P, 3) of length 1 in z."""
    shape: tuple[int, int]
    """Rows and columns."""
    factor: int
    """Side of a coarse pixel, in pixels."""
    room: RoomPrior | None = None
    """Prior of the ambient light in the signals; None where it has been subtracted."""

    def image[T: np.generic](self, values: npt.NDArray[T]) -> npt.NDArray[T]:
        """Values (P, ...) as a map (rows, columns, ...)."""
        return values.reshape(*self.shape, *values.shape[1:])

    @property
    def maps(self) -> SignalMaps:
        """The coarse pixels as maps."""
        shape = (len(self.signal), *self.shape)
        return SignalMaps(
            self.signal.reshape(shape).astype(np.float32), self.sigma.reshape(shape).astype(np.float32), self.usable.reshape(shape)
        )


def factor_of(maps: SignalMaps, most: int) -> int:
    """Least binning factor along a side that leaves no more than `most` pixels."""
    return int(np.ceil(np.sqrt(np.prod(maps.signal.shape[1:]) / most)))


def coarse_of(maps: SignalMaps, rays_C: Array, factor: int) -> Coarse:
    """The maps binned by factor x factor pixels; a coarse pixel is usable where all its pixels are."""
    rows, columns = (side // factor for side in maps.signal.shape[1:])
    if run := kernel("blocks"):
        return _joined_by(run, maps, rays_C, factor)

    def cut[T: np.generic](values: npt.NDArray[T]) -> npt.NDArray[T]:
        """Values cropped to whole blocks, their rows grouped by block: (..., rows, factor, columns x factor)."""
        return values[..., : rows * factor, : columns * factor].reshape(*values.shape[:-2], rows, factor, columns * factor)

    def means(values: npt.NDArray[np.floating]) -> Array:
        if factor == 1:
            return values.astype(float)
        by_row = cut(values).sum(axis=-2, dtype=float).reshape(*values.shape[:-2], rows, columns, factor)
        return np.asarray(sum(by_row[..., k] for k in range(factor)) / factor**2)

    signal = means(maps.signal)
    return Coarse(
        signal.reshape(len(signal), -1),
        (np.sqrt(means(maps.sigma.astype(np.float32) ** 2)) / factor).reshape(len(signal), -1),
        cut(maps.usable).all(axis=-2).reshape(len(signal), rows, columns, factor).all(axis=-1).reshape(len(signal), -1),
        np.moveaxis(means(np.moveaxis(rays_C, -1, 0)), 0, -1).reshape(-1, 3),
        (rows, columns),
        factor,
    )


def joined(maps: SignalMaps, rays_C: Array, factor: int) -> tuple[SignalMaps, Array]:
    """The maps and rays (H, W, 3) binned by factor x factor pixels; unchanged for a factor of 1."""
    if factor == 1:
        return maps, rays_C
    image = coarse_of(maps, rays_C, factor)
    return image.maps, image.image(image.rays_C)


def _joined_by(run: Callable[..., None], maps: SignalMaps, rays_C: Array, factor: int) -> Coarse:
    """`coarse_of` by the kernels."""
    (L, height, width), average = maps.signal.shape, kernel("block_means")
    assert average is not None
    rows, columns = height // factor, width // factor
    signal, sigma, usable = np.empty((L, rows * columns)), np.empty((L, rows * columns)), np.empty((L, rows * columns), bool)
    given = np.ascontiguousarray(maps.signal, np.float32), np.ascontiguousarray(maps.sigma, np.float32), np.ascontiguousarray(maps.usable)
    run(L, rows, columns, factor, height, width, *given, np.empty(2 * width), signal, sigma, usable)
    rays = np.empty((rows * columns, 3))
    average(rows, columns, factor, width, 3, np.ascontiguousarray(rays_C, float), np.empty(3 * width), rays)
    return Coarse(signal, sigma, usable, rays, (rows, columns), factor)


@dataclass(frozen=True)
class LightTable:
    """Table of the light field on P coarse pixels."""

    first: float
    """u of the first node."""
    step: float
    B: Array
    """(P, nodes, L, 3) light vectors times z^2; the entries of a pixel are contiguous."""
    doubt: Array
    """(P, nodes, L) relative standard deviation of the irradiance."""

    @staticmethod
    def of(image: Coarse, lights: Sequence[Light], distance_m: float, box: tuple[slice, slice] = EVERYWHERE) -> LightTable:
        """The table about a working distance `distance_m`, on the pixels of a box of rows and columns."""
        rows, columns = image.shape
        down, across = np.linspace(0, rows - 1, LATTICE[0]), np.linspace(0, columns - 1, LATTICE[1])
        by_row, by_column = (_linear(side, at) for side, at in zip(image.shape, (down, across), strict=True))
        rays = np.einsum("ar,bc,rci->abi", by_row, by_column, image.image(image.rays_C), optimize=True)
        u = np.log(distance_m) + np.linspace(np.log(SPAN[0]), np.log(SPAN[1]), NODES)
        x_C = np.exp(u)[:, None, None, None] * rays
        d, E = light_vectors(lights, x_C.reshape(-1, 3))
        B = (d * E[..., None]).reshape(len(lights), *x_C.shape) * np.exp(2 * u)[:, None, None, None]
        doubt = _doubt(lights, x_C, rays, E.reshape(len(lights), *x_C.shape[:3]))

        def spread(values: Array, order: Literal[1, 3]) -> Array:
            """Values (lattice, N) interpolated at the pixels (P, N) by splines of this order along both sides."""
            sides = zip(LATTICE, image.shape, box, strict=True)
            by_row, by_column = (_spline(nodes, side, order)[some].astype(np.float32) for nodes, side, some in sides)
            found = np.empty((len(by_row), len(by_column), values[0, 0].size), np.float32)
            lattice = values.astype(np.float32).reshape(LATTICE[0], -1)

            def fill(k: int) -> None:
                np.matmul(by_column, (by_row[k] @ lattice).reshape(LATTICE[1], -1), out=found[k])

            parallel.run_all(fill, range(len(found)))
            return found.reshape(-1, *values.shape[2:])

        of_lattice = np.moveaxis(B, 0, 3).transpose(1, 2, 0, 3, 4)
        return LightTable(float(u[0]), float(u[1] - u[0]), spread(of_lattice, 3), spread(np.moveaxis(doubt, (2, 3, 1, 0), (0, 1, 2, 3)), 1))

    @property
    def nodes(self) -> Array:
        """u of the nodes."""
        return np.asarray(self.first + self.step * np.arange(self.B.shape[1]), float)

    def at(self, u: Array, pixels: Indices) -> tuple[Array, Array]:
        """Light vectors (L, Q, 3) and their doubt (L, Q) at log depths u (Q,) of pixels (Q,)."""
        if kernel("cubic"):
            return self._asked(u, pixels, slope=False)
        t, f, first = self._between(u)
        weights = (-f * (f - 1) * (f - 2) / 6, (f + 1) * (f - 1) * (f - 2) / 2, -(f + 1) * f * (f - 2) / 2, (f + 1) * f * (f - 1) / 6)
        z = np.exp(self.first + t * self.step)
        total = self._joined(pixels, first, weights) / z[:, None, None] ** 2
        return np.moveaxis(total, 0, 1), self.doubt[pixels, np.rint(t).astype(int)].T

    def slope(self, u: Array, pixels: Indices) -> Array:
        """Derivatives (L, Q, 3) of the light vectors by log depth at log depths u (Q,) of pixels (Q,)."""
        if kernel("cubic"):
            return self._asked(u, pixels, slope=True)[0]
        t, f, first = self._between(u)
        weights = (-(3 * f * f - 6 * f + 2) / 6, (3 * f * f - 4 * f - 1) / 2, -(3 * f * f - 2 * f - 2) / 2, (3 * f * f - 1) / 6)
        z = np.exp(self.first + t * self.step)
        total = self._joined(pixels, first, weights) / (self.step * z[:, None, None] ** 2)
        return np.moveaxis(total, 0, 1) - 2 * self.at(u, pixels)[0]

    def _asked(self, u: Array, pixels: Indices, *, slope: bool) -> tuple[Array, Array]:
        """`at`, or `slope` and the doubt, by the kernel."""
        (_, nodes, L, _), Q, run = self.B.shape, len(u), kernel("cubic")
        assert run is not None
        found, doubt = np.empty((L, Q, 3)), np.empty((L, Q), self.doubt.dtype)
        places = (np.ascontiguousarray(u, float), np.ascontiguousarray(pixels, np.int64))
        run(L, nodes, slope, Q, self.B, self.doubt, self.first, self.step, *places, found, doubt)
        return found, doubt

    def _between(self, u: Array) -> tuple[Array, Array, Indices]:
        """Positions (Q,) of log depths in steps of the table, their offsets from the second of four nodes, and the first of these nodes."""
        t = np.clip((u - self.first) / self.step, 0, self.B.shape[1] - 1.001)
        k = np.clip(t.astype(int), 1, self.B.shape[1] - 3)
        return t, t - k, k - 1

    def _joined(self, pixels: Indices, first: Indices, weights: Sequence[Array]) -> Array:
        """Weighted sums (Q, L, 3) of four consecutive nodes, of which `first` (Q,) is the first."""
        total = np.zeros((len(pixels), *self.B.shape[2:]))
        for j, weight in enumerate(weights):
            total += self.B[pixels, first + j] * weight[:, None, None]
        return total

    def at_pixels(self, some: Indices) -> LightTable:
        """The table on some of the pixels."""
        return LightTable(self.first, self.step, self.B[some], self.doubt[some])

    def holds(self, u: Array) -> Mask:
        """Mask (Q,) of log depths within the table."""
        return np.asarray((u >= self.first) & (u <= self.first + self.step * (self.B.shape[1] - 1)))


def _spline(nodes: int, places: int, order: Literal[1, 3]) -> Array:
    """Matrix (places, nodes) that evaluates a spline through evenly spaced nodes at evenly spaced places over the same interval."""
    at = np.linspace(0, nodes - 1, places)
    if order == 1:
        return _linear(nodes, at)
    count = nodes + 2 * HELD
    every = np.arange(count)
    through = 4 / 6 * np.eye(count)
    for beside in (every - 1, every + 1):
        through[every, np.clip(beside, 0, count - 1)] += 1 / 6
    coefficients = np.linalg.solve(through, np.eye(nodes)[np.clip(every - HELD, 0, nodes - 1)])
    before = np.minimum(at.astype(int), nodes - 2)
    f = at - before
    found = np.zeros((places, nodes))
    for k, weight in enumerate(((1 - f) ** 3, 3 * f**3 - 6 * f**2 + 4, -3 * f**3 + 3 * f**2 + 3 * f + 1, f**3)):
        found += weight[:, None] / 6 * coefficients[before + HELD - 1 + k]
    return found


def _linear(nodes: int, at: Array) -> Array:
    """Matrix (N, nodes) of linear interpolation between evenly spaced nodes, at positions (N,) in steps from the first."""
    before = np.clip(at.astype(int), 0, max(nodes - 2, 0))
    found = np.zeros((len(at), nodes))
    found[np.arange(len(at)), before] = 1 - (at - before)
    found[np.arange(len(at)), np.minimum(before + 1, nodes - 1)] += at - before
    return found


def _doubt(lights: Sequence[Light], x_C: Array, rays: Array, E: Array) -> Array:
    """Relative standard deviation (L, nodes, lattice) of the irradiance due to the light's direction, from the field's lateral gradient."""
    fall = np.log(np.maximum(E, 1e-30))
    across = np.gradient(fall, axis=3) / np.gradient(rays[..., 0], axis=1)
    down = np.gradient(fall, axis=2) / np.gradient(rays[..., 1], axis=0)
    slope = np.hypot(across, down) / x_C[..., 2]
    far = np.stack([lambert.length(x_C - (light.source_C if light.source_C is not None else 0.0)) for light in lights])
    std = np.array([max(np.nan_to_num(light.direction_std_rad, nan=0.0, posinf=0.0), LEAST_DIRECTION_STD_RAD) for light in lights])
    return np.asarray(np.minimum(slope * far * std[:, None, None, None], 1.0))
