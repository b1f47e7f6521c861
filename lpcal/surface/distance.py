r"""What near light says of each pixel's own distance.

Symbols: u = log z, samples ``I_k = B_k(u) . b + e_k`` of variance s_k^2. With b projected out, whitened residual r and derivative
``J = dr/du``::

    H = J . J          curvature        h = u - J . r / H          place of the optimum

One pixel knows its distance to a tenth, an object of thousands to a thousandth. Source: the separable least squares of Golub and Pereyra
1973, SIAM J. Numerical Analysis 10 (variable projection, Kaufman's simplification).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array
from lpcal.surface.integrate import Own
from lpcal.surface.normals import Estimate, variances
from lpcal.surface.sight import Sight

DELTA = 1e-3
FURTHEST = 0.5
"""A pixel by itself moves log z by no more than this in a round."""
SCORE = 3.0
"""Nor by more than this many of its own sigmas."""
WEAK = 1e-6
"""Curvature for pixels that know nothing, so that every piece is held somewhere."""


def own_distance(B_at: Callable[[Array], Array], depth: Array, seen: Sight, found: Estimate) -> Own:
    """Curvature and optimum of u (P,) about depths (P,); B_at gives light vectors (L, P, 3) at depths."""
    variance = variances(seen, found.gloss)
    signal = seen.signal if found.gloss is None else seen.signal - found.gloss
    weight = np.where(found.inliers & np.isfinite(found.b[:, 0]), 1 / np.sqrt(variance), 0.0)
    b = np.nan_to_num(found.b)
    A = weight[..., None] * B_at(depth)
    slope = (B_at(depth * (1 + DELTA)) - B_at(depth * (1 - DELTA))) / (2 * DELTA)
    J = -weight * np.einsum("kpi,pi->kp", slope, b)
    r = weight * signal - np.einsum("kpi,pi->kp", A, b)
    inverse = lambert.inverse_3x3(np.einsum("kpi,kpj->pij", A, A))
    inverse = np.nan_to_num(inverse)
    J_free = J - np.einsum("kpi,pij,pj->kp", A, inverse, np.einsum("kpi,kp->pi", A, J))
    H = np.sum(J_free**2, axis=0) + WEAK
    most = np.minimum(FURTHEST, SCORE / np.sqrt(H))
    move = np.clip(-np.sum(J_free * r, axis=0) / H, -most, most)
    return Own(H, np.log(depth) + move)
