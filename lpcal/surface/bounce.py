r"""Light that the parts of an object throw on each other, taken up as more light.

Symbols: patch j of area A_j and normal n_j has the radiance that its pixels show, signal I_k(j) under light k; e_pj is the unit vector from
p to j at the distance r. A patch of reflectance a emits its signal, so point p of normal n and reflectance a_p gets besides::

    a_p n . J_k(p),      J_k(p) = sum_j V_pj  e_pj  (e_jp . n_j) A_j / (pi r^2 + A_j)  I_k(j)

with V whether p and j see each other. As b = albedo times n in the units of the signals and ``a = s albedo`` with one factor s for the
whole capture, the signal is ``b . (B_k + s J_k)``: what bounces acts as more light at each pixel, and the estimators stay as they are. J
holds all bounces, since I_k(j) does. s is the one number that the signals do not state: it is chosen by the robust misfit, with the
reflectance of common matter as prior. Sources: Nayar, Ikeuchi and Kanade 1991, Int. J. Computer Vision 6; Cohen and Greenberg 1985 (form
factors).
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.surface import normals
from lpcal.surface.normals import Estimate
from lpcal.surface.relief import Relief
from lpcal.surface.sight import Lit, Sight

PATCHES = 1200
STEPS = 6
BLOCK = 128
GRAZING = 0.05
"""Cosine under which patches say nothing of each other: their own normals are not that good."""
STEEPEST = 0.1
"""Least cosine to the viewer by which a pixel's area is told."""
REFLECTANCES = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
"""Of the object's median pixel."""
COMMON, COMMON_SIGMA = 0.6, 0.3
"""Reflectance of objects as prior."""
SAMPLE = 900
INDEPENDENT = 170.0
"""Pixels that an object's are worth in the choice of the reflectance: what the model lacks hangs together."""


def thrown(seen: Sight, depth: Array, n: Array, signal: Array) -> Array:
    """J (L, P, 3) of a surface of depths (P,), normals n (P, 3) and diffuse signals (L, P)."""
    from scipy import ndimage

    size = max(1, int(np.ceil(np.sqrt(seen.pixels / PATCHES))))
    rows, columns = np.nonzero(seen.mask)
    _, of_pixel = np.unique(rows // size * seen.mask.shape[1] + columns // size, return_inverse=True)
    x_C, area = seen.points_C(depth), _areas(seen, depth, n)

    def joined(values: Array) -> Array:
        """Mean (Q, ...) of values (P, ...) over the patches, by area."""
        return np.stack([np.bincount(of_pixel, area * column) for column in values.T], axis=-1) / total[:, None]

    total = np.bincount(of_pixel, area)
    at_patches = _exchange(joined(x_C), lambert.unit(joined(n))[0], total, joined(signal.T).T, Relief.of(seen, depth))
    inside = ndimage.gaussian_filter(seen.mask.astype(np.float32), size / 2)[seen.mask]
    found = np.empty((len(signal), seen.pixels, 3))
    blank = np.zeros(seen.mask.shape, np.float32)
    for k in range(len(signal)):
        for axis in range(3):
            blank[seen.mask] = at_patches[k, of_pixel, axis]
            found[k, :, axis] = ndimage.gaussian_filter(blank, size / 2)[seen.mask] / np.maximum(inside, 1e-6)
    return found


def reflectance(seen: Sight, lit: Lit, J: Array, usable: Mask, found: Estimate) -> tuple[float, float]:
    """Reflectance of the object's median pixel and its albedo in the signals' units: J (L, P, 3) acts by their ratio.

    `lit` is the light without J.
    """
    known = np.flatnonzero(np.isfinite(found.b[:, 0]))
    some = known[:: max(1, len(known) // SAMPLE)]
    sample, light, J, usable = seen.at(some), lit.at(some), J[:, some], usable[:, some]
    shine = None if found.gloss is None else found.gloss[:, some]
    albedo = np.linalg.norm(found.b[some], axis=1)
    middle, bright = np.median(albedo), np.percentile(albedo, 95)
    possible = [one for one in REFLECTANCES if one * bright <= middle]

    def misfit(one: float) -> float:
        B = light.B + one / middle * J
        trial = normals.estimate(sample, B, usable, normals.variances(sample, shine), shine)
        return INDEPENDENT * len(B) * normals.misfit(sample, B, usable, trial, shine) + ((one - COMMON) / COMMON_SIGMA) ** 2

    return min(possible, key=misfit), float(middle)


def _areas(seen: Sight, depth: Array, n: Array) -> Array:
    """Area (P,) of the surface that each pixel sees."""
    length = np.linalg.norm(seen.rays_C, axis=1)
    towards = np.maximum(-lambert.dot(n, seen.rays_C) / length, STEEPEST)
    _, columns = np.nonzero(seen.mask)
    step = np.linalg.norm(np.diff(seen.rays_C, axis=0), axis=1)[np.diff(columns) == 1]
    pixel = float(np.median(step)) if step.size else 1e-3
    return np.asarray((depth * pixel) ** 2 / (length * towards))


def _exchange(x_C: Array, n: Array, area: Array, signal: Array, relief: Relief) -> Array:
    """J (L, Q, 3) of patches at x_C (Q, 3) with normals, areas (Q,) and signals (L, Q)."""
    found = np.zeros((len(signal), *x_C.shape))
    for first in range(0, len(x_C), BLOCK):
        at = slice(first, first + BLOCK)
        e = x_C[None] - x_C[at, None]
        square = np.maximum(lambert.dot(e, e), 1e-18)
        e /= np.sqrt(square)[..., None]
        leaving = -np.einsum("pqi,qi->pq", e, n)
        face = (np.einsum("pqi,pi->pq", e, n[at]) > GRAZING) & (leaving > GRAZING)
        p, q = np.nonzero(face)
        face[p, q] = ~relief.hidden(x_C[at][p], x_C[q], STEPS)
        factor = np.where(face, leaving * area / (np.pi * square + area), 0.0)
        found[:, at] = np.stack([signal @ (factor * e[..., axis]).T for axis in range(3)], axis=-1)
    return found
