r"""Light that an object gets from its own parts and from what stands round it, taken up as more light.

Symbols: patch j of area A_j and normal n_j has the radiance that its pixels show, signal I_k(j) under light k; e_pj is the unit vector from
p to j at the distance r. A patch of reflectance a emits its signal, so point p of normal n and reflectance a_p gets besides::

    a_p n . J_k(p),      J_k(p) = sum_j V_pj  e_pj  (e_jp . n_j) A_j / (pi r^2 + A_j)  I_k(j)

with V whether p and j see each other. As b = albedo times n in the units of the signals and ``a = s albedo`` with one factor s for the
whole capture, the signal is ``b . (B_k + s J_k)``: what bounces acts as more light at each pixel, and the estimators stay as they are. J
holds all bounces, since I_k(j) does. The wall and the support are patches like the object's own (surface.surroundings); sides that the
camera does not see are guessed (surface.sides). The signals do not state s, nor how much goes on out of sight: both are means over a grid,
weighted by the robust misfit and by the reflectance of common matter as prior. Sources: Nayar, Ikeuchi and Kanade 1991, Int. J. Computer
Vision 6; Cohen and Greenberg 1985 (form factors).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.kernels.library import kernel
from lpcal.records.calibration import Light
from lpcal.surface import normals, sides
from lpcal.surface import relief as body
from lpcal.surface.normals import Estimate
from lpcal.surface.relief import Relief
from lpcal.surface.sight import Lit, Sight
from lpcal.surface.surroundings import Around, Patches

PATCHES = 2000
STEPS = 6
OFF = 0.025
"""Of the depth: so near to either end nothing is taken to stand between two patches that face each other: backs are rounder than told."""
BLOCK = 128
GRAZING = 0.05
"""Cosine under which patches say nothing of each other: their own normals are not that good."""
STEEPEST = 0.1
"""Least cosine to the viewer by which a pixel's area is told."""
REFLECTANCES = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
"""Of the object's median pixel."""
BEYOND = (0.0, 0.5, 1.0)
"""Shares of what is taken to go on around the object out of sight that are tried."""
COMMON, COMMON_SIGMA = 0.6, 0.3
"""Reflectance of objects as prior."""
SAMPLE = 900
INDEPENDENT = 25.0
"""Pixels that an object's are worth in the choice of the reflectance: what the model lacks hangs together."""


@dataclass(frozen=True)
class Thrown:
    """Light that surfaces throw on P pixels under L lights, before the reflectance that makes it one."""

    seen: Array
    """J (L, P, 3) of the object's own parts and of what is seen around it."""
    beyond: Array | None
    """J (L, P, 3) of what is taken to go on around it where the camera sees nothing of it."""
    unseen: Array
    """Share (P,) of what stands round each pixel, by the cosine, that is a side of the object which the camera does not see."""

    def J(self, beyond: float) -> Array:
        """All of it (L, P, 3), with a share of what lies beyond."""
        return self.seen if self.beyond is None or not beyond else self.seen + beyond * self.beyond


def thrown(seen: Sight, depth: Array, found: Estimate, n: Array, lights: Sequence[Light], around: Around | None = None) -> Thrown:
    """The light that a surface of depths (P,), normals n (P, 3) and an estimate of its albedo gets from itself and what is around it."""
    from scipy import ndimage

    size = max(1, int(np.ceil(np.sqrt(seen.pixels / PATCHES))))
    rows, columns = np.nonzero(seen.mask)
    _, of_pixel = np.unique(rows // size * seen.mask.shape[1] + columns // size, return_inverse=True)
    x_C, area = seen.points_C(depth), _areas(seen, depth, n)

    def joined(values: Array) -> Array:
        """Mean (Q, ...) of values (P, ...) over the patches, by area."""
        return np.stack([np.bincount(of_pixel, area * column) for column in values.T], axis=-1) / total[:, None]

    total = np.bincount(of_pixel, area)
    own = Patches(joined(x_C), lambert.unit(joined(n))[0], total, joined(found.diffuse(seen).T).T)
    relief = Relief.of(seen, depth)
    albedo = np.zeros(seen.mask.shape)
    albedo[seen.mask] = np.nan_to_num(np.linalg.norm(found.b, axis=1))
    by_unseen, unseen = sides.thrown(own.x_C, own.n, relief, albedo, lights)
    at_patches = _received(own, own, relief) + by_unseen
    beyond = None
    if around is not None:
        at_patches = at_patches + _received(own, around.seen, relief)
        beyond = around.beyond(relief, lights)
    inside = ndimage.gaussian_filter(seen.mask.astype(np.float32), size / 2)[seen.mask]
    blank = np.zeros(seen.mask.shape, np.float32)

    def spread(values: Array) -> Array:
        """Values (P,) of the patches' values (Q,)."""
        blank[seen.mask] = values[of_pixel]
        return np.asarray(ndimage.gaussian_filter(blank, size / 2)[seen.mask] / np.maximum(inside, 1e-6))

    def at_pixels(values: Array) -> Array:
        return np.stack([np.stack([spread(one) for one in of_light.T], axis=-1) for of_light in values])

    return Thrown(at_pixels(at_patches), None if beyond is None else at_pixels(_received(own, beyond, relief)), spread(unseen))


def reflectance(seen: Sight, lit: Lit, by: Thrown, usable: Mask, found: Estimate) -> tuple[float, float, float]:
    """Reflectance of the object's median pixel, its albedo in the signals' units, and the share of what lies beyond that is there.

    J acts by the ratio of the first two; `lit` is the light without it. A table may end where the picture does. Both choices are posterior
    means: the samples often constrain them weakly, and the place of the least cost would jump.
    """
    known = np.flatnonzero(np.isfinite(found.b[:, 0]))
    some = known[:: max(1, len(known) // SAMPLE)]
    sample, light, usable = seen.at(some), lit.at(some), usable[:, some]
    shine = None if found.gloss is None else found.gloss[:, some]
    albedo = np.linalg.norm(found.b[some], axis=1)
    middle, bright = np.median(albedo), np.percentile(albedo, 95)
    possible = [one for one in REFLECTANCES if one * bright <= middle]

    def misfit(both: tuple[float, float]) -> float:
        one, beyond = both
        B = light.B + one / middle * by.J(beyond)[:, some]
        trial = normals.estimate(sample, B, usable, normals.variances(sample, shine), shine)
        return INDEPENDENT * len(B) * normals.misfit(sample, B, usable, trial, shine) + ((one - COMMON) / COMMON_SIGMA) ** 2

    trials = [(one, beyond) for beyond in ((0.0,) if by.beyond is None else BEYOND) for one in possible]
    cost = np.array([misfit(both) for both in trials])
    odds = np.exp(-(cost - cost.min()) / 2)
    one, beyond = np.array(trials).T
    mean = float(np.average(one, weights=odds))
    return mean, float(middle), float(np.average(one * beyond, weights=odds)) / max(mean, 1e-9)


def _areas(seen: Sight, depth: Array, n: Array) -> Array:
    """Area (P,) of the surface that each pixel sees."""
    length = np.linalg.norm(seen.rays_C, axis=1)
    towards = np.maximum(-lambert.dot(n, seen.rays_C) / length, STEEPEST)
    _, columns = np.nonzero(seen.mask)
    step = np.linalg.norm(np.diff(seen.rays_C, axis=0), axis=1)[np.diff(columns) == 1]
    pixel = float(np.median(step)) if step.size else 1e-3
    return np.asarray((depth * pixel) ** 2 / (length * towards))


def _received(at: Patches, of: Patches, relief: Relief) -> Array:
    """J (L, Q, 3) at patches, of the light of others."""
    found = np.zeros((len(of.signal), *at.x_C.shape))
    if run := kernel("received"):
        patches = [np.ascontiguousarray(one) for one in (at.x_C, at.n, of.x_C, of.n, of.area, of.signal.T)]
        between = (*relief.front.shape, relief.front, relief.pixel_of_ray, STEPS, body.TOLERANCE, body.THICKNESS)
        run(*found.shape[:2], len(of.x_C), *patches, found, *between, GRAZING, OFF)
        return found
    for first in range(0, len(at.x_C), BLOCK):
        some = slice(first, first + BLOCK)
        e = of.x_C[None] - at.x_C[some, None]
        square = np.maximum(lambert.dot(e, e), 1e-18)
        e /= np.sqrt(square)[..., None]
        leaving = -np.einsum("pqi,qi->pq", e, of.n)
        face = (np.einsum("pqi,pi->pq", e, at.n[some]) > GRAZING) & (leaving > GRAZING)
        p, q = np.nonzero(face)
        off = np.minimum(OFF * at.x_C[some][p, 2] / np.sqrt(square[p, q]), 0.5)[:, None]
        way = of.x_C[q] - at.x_C[some][p]
        face[p, q] = ~relief.hidden(at.x_C[some][p] + off * way, of.x_C[q] - off * way, STEPS)
        factor = np.where(face, leaving * of.area / (np.pi * square + of.area), 0.0)
        found[:, some] = np.stack([of.signal @ (factor * e[..., axis]).T for axis in range(3)], axis=-1)
    return found
