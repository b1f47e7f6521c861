r"""One gloss lobe for a whole object.

Symbols: normal n, light d, viewer v, half vector h between d and v, roughness a; the signal is the Lambertian one plus::

    ks E (D G) / (4 n.v)        D = a^2 / (pi ((n.h)^2 (a^2 - 1) + 1)^2),   G = Smith's shadowing of both sides

ks is the robust regression of what the Lambertian part leaves on the lobe, at each of a few roughnesses; the normals are those of the field
(surface.field), which fits it anew in every round: a highlight that would bend one pixel's normal contradicts its neighbours.
Source: Walter, Marschner, Li and Torrance 2007, Microfacet models for refraction through rough surfaces (GGX).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.kernels.library import kernel
from lpcal.surface.sight import Lit

MOST_PIXELS, FEWEST_PIXELS = 4000, 1000
"""Pixels of an object that its gloss is fitted to, spread over it, with few lights and with many."""
SAMPLES = 100_000
"""Samples, lights times pixels, that the gloss is fitted to where the lights are many: what is fitted are two numbers."""
ROUGHNESSES = tuple(np.geomspace(0.06, 0.5, 10))
"""Roughnesses that are tried: a quarter apart, as finely as a lobe's width can be distinguished."""
DOUBT = 0.2
"""Standard deviation of a lobe, as a share of itself."""
WIDTH2 = 9.0
"""Square of a residual, in standard deviations, at which a sample's weight has fallen to a quarter."""
ROUNDS = 6
"""Rounds of the robust regression."""
CLEAR = 0.95
"""Share of the misfit that is left with a lobe under which the object is called glossy; a faint lobe is taken off all the same."""


@dataclass(frozen=True)
class Gloss:
    """The lobe's strength and roughness; `gain` is the share of the robust cost that is left with it."""

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
    h /= np.maximum(np.linalg.norm(h, axis=2, keepdims=True), 1e-9)
    a2 = roughness**2
    nh, nd = np.einsum("kpi,pi->kp", h, n), np.einsum("kpi,pi->kp", d, n)
    nv = np.maximum(np.einsum("pi,pi->p", v, n), 0.05)
    D = a2 / (np.pi * (np.maximum(nh, 0) ** 2 * (a2 - 1) + 1) ** 2)

    def smith(cosine: Array) -> Array:
        return 2 * cosine / (cosine + np.sqrt(a2 + (1 - a2) * cosine**2) + 1e-12)

    return np.asarray(np.where(nd > 0, D * smith(np.maximum(nd, 0)) * smith(nv) / (4 * nv), 0.0))


def sample(pixels: int, lights: int) -> slice:
    """The pixels that a gloss is fitted to, of so many."""
    return slice(None, None, max(1, pixels // min(MOST_PIXELS, max(FEWEST_PIXELS, SAMPLES // lights))))


def fit(residual: Array, weight: Array, spread2: Array, lit: Lit, n: Array, v: Array) -> Gloss | None:
    """The lobe that explains residuals (L, P) of variances `spread2` best, by normals n and directions v to the viewer (P, 3).

    `weight` (L, P) is 1 for samples that count. For each roughness the strength is the robust regression of the residuals on the lobe; the
    least cost wins, None where no gloss costs as little.
    """
    r, w, s2 = residual, weight, spread2
    best, least = None, _cost(r, w, s2)
    plain = _misfit(r, w, s2)
    for roughness in ROUGHNESSES:
        shape = lit.E * lobe(lit.d, n, v, roughness)
        ks = 0.0
        for _ in range(ROUNDS):
            pull = w / (1 + (r - ks * shape) ** 2 / s2 / WIDTH2) ** 2 / s2
            ks = max(float(np.sum(pull * r * shape) / max(np.sum(pull * shape**2), 1e-300)), 0.0)
        cost = _cost(r - ks * shape, w, s2 + (DOUBT * ks * shape) ** 2)
        if cost < least:
            best, least = Gloss(ks, float(roughness), _misfit(r - ks * shape, w, s2) / max(plain, 1e-12)), cost
    return best


def _misfit(residual: Array, weight: Array, spread2: Array) -> float:
    return float(np.sum(weight * WIDTH2 * np.log1p(residual**2 / spread2 / WIDTH2)))


def _cost(residual: Array, weight: Array, spread2: Array) -> float:
    """Twice the negative logarithm of Geman and McClure's likelihood."""
    return _misfit(residual, weight, spread2) + float(np.sum(weight * np.log(spread2)))
