r"""Each pixel's own distance, as near light determines it.

Symbols: u = log z, samples ``I_k = B_k(u) . b + e_k`` of variance s_k^2. With b projected out, whitened residual r and derivative
``J = dr/du``::

    H = J . J          curvature        h = u - J . r / H          place of the optimum

One pixel knows its distance to a tenth, an object of thousands to a thousandth. Source: the separable least squares of Golub and Pereyra
1973, SIAM J. Numerical Analysis 10 (variable projection, Kaufman's simplification).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.integration.integrate import Own
from lpcal.kernels.library import kernel
from lpcal.shading import normals
from lpcal.shading.normals import Estimate, thrown_share, variances
from lpcal.view import bands
from lpcal.view.agreed import DOUBT, NEXT_TO_NOTHING, OUTLIER, STATED_STD
from lpcal.view.sight import Lit, Sight, vectors

FURTHEST = 0.5
"""Most that a pixel's own distance moves log z in a round."""
GLOSS_DOUBT = 2.0
"""Standard deviation of the gloss that was taken off, as a share of it: distances depend on small parts of the signal."""
ALIKE = 0.005
"""Error that neighbouring samples share, as a share of the signal."""
PATCHES_ACROSS = 40
"""Patches across an object whose pixels are asked for their distance together."""
ESTRANGED = 1.5
"""Medians of the patches' differences beyond which a patch counts little."""
MIND_ROUNDS = 8


def own_distance(light: Lit | Array, slope_of: Callable[[slice], Array], depth: Array, seen: Sight, found: Estimate) -> Own:
    """Curvature and optimum of u (P,) about depths (P,) with their light, or its vectors (L, P, 3).

    `slope_of` gives the derivatives (L, Q, 3) of the light vectors of a slice of the pixels by u.
    """

    def of(at: slice) -> Own:
        return _own(vectors(light, at), slope_of(at), depth[at], seen.at(at), found.at(at))

    parts = bands.each(seen.pixels, len(seen.signal), of)
    return Own(np.concatenate([part.curvature for part in parts]), np.concatenate([part.optimum for part in parts]))


def _own(B: Array, slope: Array, depth: Array, seen: Sight, found: Estimate) -> Own:
    """The same by light vectors B (L, P, 3) and their slope by u."""
    if run := kernel("own_distance"):
        constants = np.array([normals.MODEL, GLOSS_DOUBT, NEXT_TO_NOTHING, FURTHEST, OUTLIER, lambert.SINGULAR])
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
    H = np.sum(J_free**2, axis=0) + NEXT_TO_NOTHING
    most = np.minimum(FURTHEST, OUTLIER / np.sqrt(H))
    move = np.clip(-np.sum(J_free * r, axis=0) / H, -most, most)
    return Own(H, np.log(depth) + move)


def doubted(own: Own, lit: Lit, seen: Sight, found: Estimate) -> Own:
    """The own distances with less weight where light from other parts of the object is poorly known: a whole region errs alike there."""
    if lit.unseen is None:
        return own
    square = lit.unseen**2 + thrown_share(lit, found) ** 2
    if found.gloss is not None:
        square = square + np.max(np.where(found.inliers, found.gloss / np.maximum(seen.signal, 1e-12), 0.0), axis=0) ** 2
    return Own(own.curvature / (1 + square * (DOUBT / ALIKE) ** 2), own.optimum)


def downweight_discordant(own: Own, u: Array, mask: Mask, label: Labels) -> Own:
    """The own distances, less weight on patches whose distances differ from most of their piece (P,): light from elsewhere biases them.

    Patches are Gaussian means of what each pixel would move by; the weights are Geman and McClure's about that of most of the piece.
    """
    size = max(1.0, np.sqrt(mask.sum()) / PATCHES_ACROSS)

    def blurred(values: Array) -> Array:
        image = np.zeros(mask.shape)
        image[mask] = values
        return np.asarray(raster.blurred(image, size, "constant")[mask])

    H = own.curvature
    move = blurred(H * (own.optimum - u)) / np.maximum(blurred(H), NEXT_TO_NOTHING)
    weight = np.ones_like(H)
    for one in np.unique(label):
        inside = label == one
        middle = _median(move[inside], H[inside])
        scale = max(STATED_STD, ESTRANGED * _median(np.abs(move[inside] - middle), H[inside]))
        for _ in range(MIND_ROUNDS):
            weight[inside] = 1 / (1 + ((move[inside] - middle) / scale) ** 2) ** 2
            middle = float(np.average(move[inside], weights=(weight * H)[inside]))
    return Own(H * weight + NEXT_TO_NOTHING, own.optimum)


def _median(values: Array, weight: Array) -> float:
    """The weighted median."""
    order = np.argsort(values)
    sums = np.cumsum(weight[order])
    return float(values[order[np.searchsorted(sums, sums[-1] / 2)]])
