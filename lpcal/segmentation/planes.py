r"""Planes, placed by near light.

Symbols: a plane is q (3,) with ``q . x = 1`` for its points x, so a ray r meets it at depth ``z = 1 / (q . r)``; its normal is -q / abs(q).
Light k would give a white plane the signal ``m_k = E_k(x) (n . d_k)``; a pixel of albedo rho on it has ``I_k = rho m_k`` unless it lies in
shadow. Near light alone places the plane: E and d change with x. Robust least squares over q, the albedo free at every pixel.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.kernels.library import kernel
from lpcal.records.calibration import Light
from lpcal.segmentation.sample_costs import MODEL
from lpcal.view import parallel
from lpcal.view.pixel_list import PixelList, light_vectors

SHADE = 0.5
"""A signal under this share of what the second highest predicts is in shadow."""
WEAK = 0.1
"""A light that brings less than this share of what the strongest brings to a pixel is left out there: its lobe's tail."""
FIT_PIXELS = 700
BEHIND = 1e-3
"""Reciprocal of a depth, 1/m, under which a ray misses a plane."""
NODES = 64
"""Nodes along a side of the lattice of rays on which the light of a plane is summed where there are twice as many rays as nodes: between
the nodes it is right to 1e-4 of its most."""
FEW_LIGHTS = 64
"""Lights up to which the kernel finds a plane's misfit."""
TRUSTED = 4.0
"""Misfit of a pixel under which the plane is believed there."""


@dataclass(frozen=True)
class Plane:
    """A plane and how well it fits the pixels that it was fitted to."""

    q: Array
    misfit: float
    """Root of the median of the pixels' mean square residuals."""


def predicted(q: Array, rays_C: Array, lights: Sequence[Light]) -> Array:
    """Signals m (L, P) of a white plane along rays (P, 3); NaN where a ray misses it."""
    if len(rays_C) > 2 * NODES**2:
        m = interpolated(lambda xy: _at_infinity(q, np.column_stack([xy, np.ones(len(xy))]), lights), rays_C[:, :2], NODES)
    else:
        m = _at_infinity(q, rays_C, lights)
    slope = rays_C @ q
    np.maximum(m, 0.0, out=m)
    m *= np.where(slope > BEHIND, slope**2, np.nan)
    return m


def _at_infinity(q: Array, rays_C: Array, lights: Sequence[Light]) -> Array:
    """Signals (L, P) of a white plane times the square of its depth, which stay smooth up to its horizon; negative where it looks away."""
    depth = 1 / np.maximum(rays_C @ q, BEHIND)
    d, E = light_vectors(lights, depth[:, None] * rays_C)
    return E * (d @ (-q / np.linalg.norm(q))) * depth**2


def interpolated(values: Callable[[Array], Array], at: Array, nodes: int) -> Array:
    """Values (L, P) at places (P, 2), by those (L, N) at places (N, 2) on a lattice of nodes x nodes about them.

    Cubic along each side, through the two nodes before a place and the two after it (Lagrange).
    """
    low, high = at.min(axis=0), at.max(axis=0)
    step = np.maximum((high - low) / (nodes - 3), 1e-12)  # a node beyond each end
    side = [low[axis] + (np.arange(nodes) - 1) * step[axis] for axis in (0, 1)]
    lattice = np.stack(np.meshgrid(*side, indexing="ij"), axis=-1).reshape(-1, 2)
    return between(np.moveaxis(values(lattice), 0, -1).reshape(nodes, nodes, -1), (at - low) / step + 1)


def between(lattice: Array, place: Array) -> Array:
    """Values (L, P) of a lattice (N, N, L) at places (P, 2) in steps from its first node."""
    if run := kernel("lattice"):
        lattice = np.ascontiguousarray(lattice, float)

        def of(at: slice) -> Array:
            some = np.ascontiguousarray(place[at], float)
            found = np.empty((lattice.shape[2], len(some)))
            run(len(found), len(lattice), len(some), lattice, some, found)
            return found

        return np.concatenate(parallel.run_bands(len(place), lattice.shape[2], of), axis=1)
    node = np.clip(place.astype(int), 1, len(lattice) - 3)
    f = (place - node).T
    weight = np.stack([-f * (f - 1) * (f - 2) / 6, (f + 1) * (f - 1) * (f - 2) / 2, -(f + 1) * f * (f - 2) / 2, (f + 1) * f * (f - 1) / 6])
    total = np.zeros((len(place), lattice.shape[2]))
    for i in range(4):
        for j in range(4):
            total += (weight[i, 0] * weight[j, 1])[:, None] * lattice[node[:, 0] + i - 1, node[:, 1] + j - 1]
    return total.T


def residuals(seen: PixelList, m: Array, *, shaded: bool) -> tuple[Array, Array]:
    """Residuals (L, P) in sigmas, 0 for samples in shadow or saturated, and the number (P,) of samples that count; pixels that miss: inf.

    `shaded`: shadow may lie on most of the samples of a pixel, else on fewer than half.
    """
    hit, albedo, counted, white = _fitted(seen, m, shaded=shaded)
    spread = np.sqrt(seen.sigma**2 + (MODEL * seen.signal) ** 2)
    r = np.where(counted, (seen.signal - albedo * white) / spread, 0.0)
    return np.where(hit, r, np.inf), np.asarray(counted.sum(axis=0), float)


def strong(seen: PixelList, m: Array) -> tuple[Mask, Array]:
    """The samples (L, P) by which a plane is judged, and m with 1 where a ray misses the plane."""
    hit = _hit(m)
    white = np.where(hit, m, 1.0)
    return seen.usable & hit & (white > WEAK * white.max(axis=0)), white


def _hit(m: Array) -> Mask:
    """Where (P,) rays meet the plane and some light."""
    return np.asarray(np.isfinite(m).all(axis=0) & (m > 0).any(axis=0))


def _fitted(seen: PixelList, m: Array, *, shaded: bool) -> tuple[Mask, Array, Mask, Array]:
    """Where rays hit the plane (P,), albedo (P,), the samples (L, P) that it rests on, and m (L, P)."""
    sound, white = strong(seen, m)
    ratio = np.where(sound, seen.signal / np.maximum(white, 1e-9), -np.inf)
    ranked = np.sort(ratio, axis=0)
    middle = len(m) - 1 - np.maximum(sound.sum(axis=0) - 1, 0) // 2
    high = ranked[-2] if shaded else np.take_along_axis(ranked, middle[None], axis=0)[0]
    counted = sound & (ratio > SHADE * high)
    weight = counted / (seen.sigma**2 + (MODEL * seen.signal) ** 2)
    found = np.sum(weight * white * seen.signal, axis=0) / np.maximum(np.sum(weight * white**2, axis=0), 1e-30)
    return _hit(m), found, counted, white


def misfit(seen: PixelList, m: Array, *, shaded: bool = True) -> tuple[Array, Array]:
    """Mean square residual a degree of freedom (P,) of pixels against a plane's m, inf where fewer than two samples count; their number."""
    if len(m) <= FEW_LIGHTS and (run := kernel("misfit")):
        signal, sigma, white = (np.ascontiguousarray(one, float) for one in (seen.signal, seen.sigma, m))
        given = (*m.shape, signal, sigma, np.ascontiguousarray(seen.usable), white, shaded, np.array([MODEL, SHADE, WEAK]))
        square, count = np.empty(seen.pixels), np.empty(seen.pixels)
        parallel.run_bands(seen.pixels, len(m), lambda at: run(*given, at.start, at.stop, square, count))
        return square, count
    r, count = residuals(seen, m, shaded=shaded)
    return np.where(count >= 2, np.sum(r**2, axis=0) / np.maximum(count - 1, 1), np.inf), count


def thinned(seen: PixelList) -> PixelList:
    """Every so many pixels, FIT_PIXELS at most."""
    return seen.at(np.arange(0, seen.pixels, max(1, seen.pixels // FIT_PIXELS)))
