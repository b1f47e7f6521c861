r"""Signals and misfit of a plane under near light.

Symbols: a plane is q (3,) with ``q . x = 1`` for its points x, so a ray r meets it at depth ``z = 1 / (q . r)``; its normal is -q / abs(q).
Light k gives a plane of albedo 1 the signal ``m_k = E_k(x) (n . d_k)``; a pixel of albedo rho on it has ``I_k = rho m_k`` unless it is
shadowed. Near light determines the plane, as E and d vary with x; the albedo is free at every pixel.
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
"""Share of the signal predicted from the reference albedo below which a sample counts as shadowed."""
WEAK = 0.1
"""Share of the strongest light's signal at a pixel below which a light is left out there: it is the tail of its lobe."""
FIT_PIXELS = 700
"""Largest number of pixels, spread over a plane, on which its misfit is judged."""
BEHIND = 1e-3
"""Reciprocal depth, 1/m, below which a ray misses a plane."""
NODES = 64
"""Nodes along a side of the lattice of rays on which a plane's signals are computed, when there are more than twice as many rays as nodes;
interpolation between them is right to 1e-4 of the maximum."""
FEW_LIGHTS = 64
"""Largest number of lights that the kernel of the misfit supports."""
TRUSTED = 4.0
"""Misfit of a pixel (mean square residual) below which it counts as part of the plane."""


@dataclass(frozen=True)
class Plane:
    """A plane and how well it fits the pixels that it was fitted to."""

    q: Array
    misfit: float
    """Root of the median of the pixels' mean square residuals."""


def predicted(q: Array, rays_C: Array, lights: Sequence[Light]) -> Array:
    """Signals m (L, P) of a plane of albedo 1 along rays (P, 3); NaN where a ray misses it."""
    if len(rays_C) > 2 * NODES**2:
        m = interpolated(lambda xy: _at_infinity(q, np.column_stack([xy, np.ones(len(xy))]), lights), rays_C[:, :2], NODES)
    else:
        m = _at_infinity(q, rays_C, lights)
    slope = rays_C @ q
    np.maximum(m, 0.0, out=m)
    m *= np.where(slope > BEHIND, slope**2, np.nan)
    return m


def _at_infinity(q: Array, rays_C: Array, lights: Sequence[Light]) -> Array:
    """Signals (L, P) of a plane of albedo 1 times the squared depth: smooth up to the horizon, negative where it faces away."""
    depth = 1 / np.maximum(rays_C @ q, BEHIND)
    d, E = light_vectors(lights, depth[:, None] * rays_C)
    return E * (d @ (-q / np.linalg.norm(q))) * depth**2


def interpolated(values: Callable[[Array], Array], at: Array, nodes: int) -> Array:
    """Bicubic (Lagrange) interpolation of a function at places (P, 2), giving (L, P), from a lattice of nodes x nodes about them.

    `values` takes places (N, 2) to (L, N).
    """
    low, high = at.min(axis=0), at.max(axis=0)
    step = np.maximum((high - low) / (nodes - 3), 1e-12)  # a node beyond each end
    side = [low[axis] + (np.arange(nodes) - 1) * step[axis] for axis in (0, 1)]
    lattice = np.stack(np.meshgrid(*side, indexing="ij"), axis=-1).reshape(-1, 2)
    return between(np.moveaxis(values(lattice), 0, -1).reshape(nodes, nodes, -1), (at - low) / step + 1)


def between(lattice: Array, place: Array) -> Array:
    """Bicubic (Lagrange) interpolation (L, P) of a lattice (N, N, L) at places (P, 2), in steps from its first node."""
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
    """Residuals (L, P) in standard deviations, 0 for shadowed or saturated samples, inf where the ray misses the plane; number (P,) used.

    `shaded`: all but two samples of a pixel may be shadowed; else fewer than half.
    """
    hit, albedo, counted, white = _fitted(seen, m, shaded=shaded)
    spread = np.sqrt(seen.sigma**2 + (MODEL * seen.signal) ** 2)
    r = np.where(counted, (seen.signal - albedo * white) / spread, 0.0)
    return np.where(hit, r, np.inf), np.asarray(counted.sum(axis=0), float)


def strong(seen: PixelList, m: Array) -> tuple[Mask, Array]:
    """The samples (L, P) that are used to judge a plane, and m with 1 where a ray misses it."""
    hit = _hit(m)
    white = np.where(hit, m, 1.0)
    return seen.usable & hit & (white > WEAK * white.max(axis=0)), white


def _hit(m: Array) -> Mask:
    """Mask (P,) of rays that meet the plane where some light reaches it."""
    return np.asarray(np.isfinite(m).all(axis=0) & (m > 0).any(axis=0))


def _fitted(seen: PixelList, m: Array, *, shaded: bool) -> tuple[Mask, Array, Mask, Array]:
    """Mask (P,) of rays that hit the plane, albedo (P,), samples (L, P) used for it, and m (L, P)."""
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
    """Squared residual per degree of freedom (P,) against a plane's m (L, P), inf for fewer than two samples; and their number (P,)."""
    if len(m) <= FEW_LIGHTS and (run := kernel("misfit")):
        signal, sigma, white = (np.ascontiguousarray(one, float) for one in (seen.signal, seen.sigma, m))
        given = (*m.shape, signal, sigma, np.ascontiguousarray(seen.usable), white, shaded, np.array([MODEL, SHADE, WEAK]))
        square, count = np.empty(seen.pixels), np.empty(seen.pixels)
        parallel.run_bands(seen.pixels, len(m), lambda at: run(*given, at.start, at.stop, square, count))
        return square, count
    r, count = residuals(seen, m, shaded=shaded)
    return np.where(count >= 2, np.sum(r**2, axis=0) / np.maximum(count - 1, 1), np.inf), count


def thinned(seen: PixelList) -> PixelList:
    """A subset of about FIT_PIXELS pixels, evenly spaced in the list."""
    return seen.at(np.arange(0, seen.pixels, max(1, seen.pixels // FIT_PIXELS)))
