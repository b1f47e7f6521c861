r"""One gloss lobe for a whole object.

Symbols: normal n, light d, viewer v, half vector h between d and v, roughness a; the signal is the Lambertian one plus::

    ks E (D G) / (4 n.v)        D = a^2 / (pi ((n.h)^2 (a^2 - 1) + 1)^2),   G = Smith's shadowing of both sides

The Lambertian part absorbs most of a wide lobe, so residuals after fitting b underestimate it: residuals and lobe are both projected onto
the complement of what b can explain (variable projection, Golub and Pereyra 1973), pixel by pixel and with robust weights. Matter of
reflectance R and albedo b in the signals' unit has the normal-incidence reflectance ``F0 = ks R / (pi b)``. Common matter has F0 near .045,
which is the prior. R is that of common matter, too: an estimate from interreflection may be too small at first, by which any lobe is
plausible, and the wide lobe that is then found keeps it small. Strength and roughness are posterior means over a grid of both and of the
hypothesis of no gloss, whose prior is one half. The normals are those of the
field (shading.field), which fits the gloss again in every round.

Sources: Walter, Marschner, Li and Torrance 2007, Microfacet models for refraction through rough surfaces (GGX); Akenine-Moeller et al.
2018, Real-Time Rendering, 9.5 (F0 of common matter).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array
from lpcal.kernels.library import kernel
from lpcal.shading import normals
from lpcal.view import parallel
from lpcal.view.constants import DOUBT, LEAST_COSINE, MANY_PIXELS, NEIGHBOURS, OUTLIER2, OUTLIER_RATE, REGULARISATION, UNLIKELY
from lpcal.view.pixel_list import Illumination

ROUGHNESSES = tuple(np.geomspace(0.06, 0.5, 10))
"""Grid of roughnesses, a quarter apart: as finely as lobe widths can be distinguished."""
MIRRORED = tuple(np.geomspace(0.01, 1.0, 21))
"""Grid of F0, a quarter apart, from below any matter's to a mirror's."""
COMMON_F0, COMMON_SPREAD = 0.045, 0.5
"""Prior of F0: median of common matter and standard deviation of its log; plastic, glaze, skin and wood have .02 to .08. Metals are the
outliers (OUTLIER_RATE), with a uniform prior."""
CLEAR = 0.95
"""Misfit with the lobe over that without, below which the object is reported as glossy; a fainter lobe is subtracted all the same."""


@dataclass(frozen=True)
class Gloss:
    """The lobe's strength and roughness; `gain` is the robust cost with the lobe over that without."""

    ks: float
    roughness: float
    gain: float

    @property
    def clear(self) -> bool:
        """Whether the lobe explains enough to be called gloss."""
        return self.gain < CLEAR


def lobe(d: Array, n: Array, v: Array, roughness: float) -> Array:
    """D G / (4 n.v) (L, P) of light directions d (L, P, 3), normals n (P, 3), directions v (P, 3) to the viewer."""
    if run := kernel("lobe"):
        found = np.empty(d.shape[:2])
        run(*found.shape, *(np.ascontiguousarray(one, float) for one in (d, n, v)), roughness, found)
        return found
    h = d + v
    h /= np.maximum(lambert.length(h)[..., None], 1e-9)
    a2 = roughness**2
    nh, nd = lambert.dot(h, n), lambert.dot(d, n)
    nv = np.maximum(lambert.dot(v, n), LEAST_COSINE)
    D = a2 / (np.pi * (np.maximum(nh, 0) ** 2 * (a2 - 1) + 1) ** 2)

    def smith(cosine: Array) -> Array:
        return 2 * cosine / (cosine + np.sqrt(a2 + (1 - a2) * cosine**2) + 1e-12)

    return np.asarray(np.where(nd > 0, D * smith(np.maximum(nd, 0)) * smith(nv) / (4 * nv), 0.0))


def turned(d: Array, n: Array, v: Array, roughness: float) -> Array:
    """Derivative of `lobe` by the normal (L, P, 3), within the tangent plane."""
    h = d + v
    h /= np.maximum(lambert.length(h)[..., None], 1e-9)
    a2 = roughness**2
    nh, nd = np.maximum(lambert.dot(h, n), 0.0), np.maximum(lambert.dot(d, n), 0.0)
    nv = np.maximum(lambert.dot(v, n), LEAST_COSINE)
    q = nh**2 * (a2 - 1) + 1
    D, s_d, s_v = a2 / (np.pi * q**2), np.sqrt(a2 + (1 - a2) * nd**2), np.sqrt(a2 + (1 - a2) * nv**2)
    S, V = 2 * nd / (nd + s_d + 1e-12), 0.5 / (nv + s_v)
    by_h, by_d = 4 * D * nh * (1 - a2) / q * S * V, D * 2 * a2 / (s_d * (nd + s_d) ** 2 + 1e-12) * V
    by_v = np.where(nv > LEAST_COSINE, -D * S * V * (1 + (1 - a2) * nv / s_v) / (nv + s_v), 0.0)
    found = np.where(nd > 0, by_h, 0.0)[..., None] * h + np.where(nd > 0, by_d, 0.0)[..., None] * d + by_v[..., None] * v
    return np.asarray(found - np.einsum("kpi,pi->kp", found, n)[..., None] * n)


def sample(pixels: int) -> slice:
    """Slice of about MANY_PIXELS pixels to which the gloss is fitted."""
    return slice(None, None, max(1, pixels // MANY_PIXELS))


def fit(residual: Array, weight: Array, spread2: Array, lit: Illumination, n: Array, v: Array, per_unit: float) -> Gloss | None:
    """Fit the lobe to residuals (L, P) of variances `spread2`, for normals n and directions v to the viewer (P, 3).

    `weight` (L, P) is 1 for samples in use; `per_unit` is reflectance over albedo in the signals' unit. None if the probability of gloss
    is below UNLIKELY.
    """
    F0 = np.array(MIRRORED)
    ks, none = F0 * np.pi / per_unit, np.zeros(1)
    plain = _unexplained(residual, np.zeros_like(residual), weight, spread2, lit.B)
    matte, B = _costs(*plain, none, weight, spread2, DOUBT).sum(), lit.B

    def of(roughness: float) -> tuple[tuple[Array, Array], Array]:
        one = _unexplained(residual, lit.E * lobe(lit.d, n, v, roughness), weight, spread2, B)
        return one, _costs(*one, ks, weight, spread2, DOUBT).sum(axis=1)

    found = parallel.run_all(of, ROUGHNESSES)
    cost = np.stack([each for _, each in found])
    common = np.exp(-((np.log(F0 / COMMON_F0) / COMMON_SPREAD) ** 2) / 2)
    prior = ((1 - OUTLIER_RATE) * common / common.sum() + OUTLIER_RATE / len(F0)) / len(ROUGHNESSES)
    evidence = (matte - cost) / (2 * NEIGHBOURS)
    most = max(float(evidence.max()), 0.0)
    odds = prior * np.exp(evidence - most)
    glossy = float(odds.sum() / (odds.sum() + np.exp(-most)))
    if glossy < UNLIKELY:
        return None
    odds = np.where(odds > REGULARISATION * odds.max(), odds, 0.0)
    odds = odds / odds.sum()
    strength = glossy * float(np.exp(np.sum(odds * np.log(ks))))
    width = float(np.exp(np.sum(odds * np.log(ROUGHNESSES)[:, None])))
    misfit = 0.0
    for row in np.flatnonzero(odds.any(axis=1)):
        some = odds[row] > 0
        misfit += float(odds[row, some] @ _costs(*found[row][0], ks[some], weight, spread2, 0.0)[:, 0])
    return Gloss(strength, width, misfit / max(float(_costs(*plain, none, weight, spread2, 0.0)[0, 0]), 1e-12))


def _unexplained(residual: Array, shape: Array, weight: Array, spread2: Array, B: Array) -> tuple[Array, Array]:
    """Residual and lobe (L, P) projected onto the complement of b, with the weights of a robust regression of the one on the other."""
    if run := kernel("unexplained"):
        given = (np.ascontiguousarray(one, float) for one in (residual, shape, weight, spread2, B))
        pull, left, own = np.empty((3, *residual.shape))
        run(*residual.shape, *given, OUTLIER2, normals.ROUNDS, pull, left, own)
        return left, own
    pull = weight / spread2
    for k in range(normals.ROUNDS + 1):
        left, own = _free_of_b(np.stack([residual, shape]), pull, B)
        if k < normals.ROUNDS:
            best = max(float(np.sum(pull * left * own) / max(np.sum(pull * own**2), 1e-300)), 0.0)
            pull = weight / (1 + (left - best * own) ** 2 / spread2 / OUTLIER2) ** 2 / spread2
    return left, own


def _free_of_b(values: Array, weight: Array, B: Array) -> Array:
    """Values (..., L, P) minus their weighted least-squares fit by a b of each pixel, for weights (L, P) and light vectors B (L, P, 3)."""
    A = np.einsum("kp,kpi,kpj->pij", weight, B, B)
    A += 1e-9 * np.trace(A, axis1=1, axis2=2)[:, None, None] * np.eye(3) + 1e-300 * np.eye(3)
    right = np.einsum("kp,kpi,...kp->...pi", weight, B, values)
    b = np.linalg.solve(A, right[..., None])[..., 0]
    return np.asarray(values - np.einsum("kpi,...pi->...kp", B, b))


def _costs(left: Array, own: Array, ks: Array, weight: Array, spread2: Array, doubt: float) -> Array:
    """Robust minus twice log likelihood (N, 2) of a lobe of strengths ks (N,) with relative standard deviation `doubt`.

    The two columns are the misfit and the log-variance term.
    """
    if run := kernel("lobe_costs"):
        found = np.empty((len(ks), 2))
        given = (np.ascontiguousarray(one, float) for one in (ks, left, own, weight, spread2))
        run(*left.shape, len(ks), *given, doubt, OUTLIER2, float(np.mean(spread2)), found)
        return found
    costs = []
    for one in ks:
        shown, variance = one * own, spread2 + (doubt * one * own) ** 2
        misfit = np.sum(weight * OUTLIER2 * np.log1p((left - shown) ** 2 / variance / OUTLIER2))
        costs.append((misfit, np.sum(weight * np.log(variance))))
    return np.array(costs)
