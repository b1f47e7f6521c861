r"""Each pixel's own distance, as near light determines it.

Symbols: u = log z, samples ``I_k = B_k(u) . b + e_k`` of variance s_k^2. With b projected out, whitened residual r and derivative
``J = dr/du``::

    H = J . J          curvature        h = u - J . r / H          position of the optimum

A pixel determines its distance to a tenth, thousands of them to a thousandth. Source: the separable least squares of Golub and Pereyra
1973, SIAM J. Numerical Analysis 10 (variable projection, Kaufman's simplification).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array
from lpcal.integration.integrate import Own
from lpcal.kernels.library import kernel
from lpcal.shading import normals
from lpcal.shading.normals import Estimate, interreflected_share, variances
from lpcal.view import parallel
from lpcal.view.constants import DOUBT, FEWEST_PIXELS, OUTLIER, REGULARISATION
from lpcal.view.pixel_list import Illumination, Indices, PixelList, vectors

FURTHEST = 0.5
"""Largest change of log z by a pixel's own distance in a round."""
GLOSS_DOUBT = 2.0
"""Relative standard deviation of the subtracted gloss: large, as distances depend on small parts of the signal."""
ALIKE = 0.005
"""Relative error of the signal that is common to neighbouring samples."""


def own_distance(light: Illumination | Array, slope_of: Callable[[slice], Array], depth: Array, seen: PixelList, found: Estimate) -> Own:
    """Curvature and optimum of u (P,) about depths (P,), under an illumination or light vectors (L, P, 3).

    `slope_of` gives the derivatives (L, Q, 3) by u of the light vectors of a slice of the pixels.
    """

    def of(at: slice) -> Own:
        return _own(vectors(light, at), slope_of(at), depth[at], seen.at(at), found.at(at))

    parts = parallel.run_bands(seen.pixels, len(seen.signal), of)
    return Own(np.concatenate([part.curvature for part in parts]), np.concatenate([part.optimum for part in parts]))


def _own(B: Array, slope: Array, depth: Array, seen: PixelList, found: Estimate) -> Own:
    """`own_distance` from light vectors B (L, P, 3) and their derivative by u."""
    if run := kernel("own_distance"):
        constants = np.array([normals.MODEL, GLOSS_DOUBT, REGULARISATION, FURTHEST, OUTLIER, lambert.SINGULAR])
        gloss = np.zeros(0) if found.gloss is None else found.gloss
        curvature, optimum = np.empty(seen.pixels), np.empty(seen.pixels)
        light, at, sigma, off, b, z = (np.ascontiguousarray(one, float) for one in (B, slope, seen.sigma, gloss, found.b, depth))
        signal, agree = np.ascontiguousarray(seen.signal, float), np.ascontiguousarray(found.inliers)
        run(*signal.shape, light, at, signal, sigma, off.size > 0, off, agree, b, z, constants, curvature, optimum)
        return Own(curvature, optimum)
    variance = variances(seen)
    signal = seen.signal
    if found.gloss is not None:
        variance, signal = variance + (GLOSS_DOUBT * found.gloss) ** 2, signal - found.gloss
    weight = np.where(found.inliers & np.isfinite(found.b[:, 0]), 1 / np.sqrt(variance), 0.0)
    b = np.nan_to_num(found.b)
    A = weight[..., None] * B
    J = -weight * np.einsum("kpi,pi->kp", slope, b)
    r = weight * signal - np.einsum("kpi,pi->kp", A, b)
    inverse = lambert.inverse_3x3(np.einsum("kpi,kpj->pij", A, A))
    inverse = np.nan_to_num(inverse)
    J_free = J - np.einsum("kpi,pij,pj->kp", A, inverse, np.einsum("kpi,kp->pi", A, J))
    H = np.sum(J_free**2, axis=0) + REGULARISATION
    most = np.minimum(FURTHEST, OUTLIER / np.sqrt(H))
    move = np.clip(-np.sum(J_free * r, axis=0) / H, -most, most)
    return Own(H, np.log(depth) + move)


def levelled(own: Own, u: Array, label: Indices) -> Array:
    """u (P,) with each connected component, by its label (P,), shifted to the weighted mean of its pixels' own distances.

    The downweighting of `doubted` is for the shape only: for the distance it would leave few regions, whose errors are correlated; the mean
    over all regions averages over more errors.
    """
    total = np.bincount(label, own.curvature)
    move = np.bincount(label, own.curvature * (own.optimum - u)) / np.maximum(total, REGULARISATION)
    return np.asarray(u + np.where(np.bincount(label) >= FEWEST_PIXELS, move, 0.0)[label])


def doubted(own: Own, lit: Illumination, seen: PixelList, found: Estimate) -> Own:
    """The own distances downweighted where interreflection is poorly known: errors are common to a whole region there."""
    if lit.unseen is None:
        return own
    square = lit.unseen**2 + interreflected_share(lit, found) ** 2
    if found.gloss is not None:
        square = square + np.max(np.where(found.inliers, found.gloss / np.maximum(seen.signal, 1e-12), 0.0), axis=0) ** 2
    return Own(own.curvature / (1 + square * (DOUBT / ALIKE) ** 2), own.optimum)
