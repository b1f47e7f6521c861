r"""One gloss lobe for a whole object.

Symbols: normal n, light d, viewer v, half vector h between d and v, roughness a; the signal is the Lambertian one plus::

    ks E (D G) / (4 n.v)        D = a^2 / (pi ((n.h)^2 (a^2 - 1) + 1)^2),   G = Smith's shadowing of both sides

(ks, a) are found on a sample of pixels: at each trial the normals are estimated anew from what is left of the signal, and the robust cost
of all samples decides. It is kept only where it explains much of the misfit: at a false depth a lobe can fit by chance.
Source: Walter, Marschner, Li and Torrance 2007, Microfacet models for refraction through rough surfaces (GGX).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.surface import normals
from lpcal.surface.normals import Estimate
from lpcal.surface.sight import Lit, Sight

SAMPLE = 900
ROUGHNESSES = (0.08, 0.15, 0.3)
STRENGTHS = (0.003, 0.01, 0.03, 0.1)
"""Of ks, by the object's median albedo."""
KEPT_BELOW = 0.95
"""Share of the cost without gloss under which a lobe is kept: by how much it falls hangs on the number of lights, so the gate is wide."""
ROUNDS = 3
TRIAL_STEPS = 30
CLEAN = 0.25
"""A cost this low without gloss leaves nothing for it to explain."""


@dataclass(frozen=True)
class Gloss:
    """The lobe's strength and roughness; `gain` is the share of the robust cost that is left with it."""

    ks: float
    roughness: float
    gain: float


def lobe(d: Array, n: Array, v: Array, roughness: float) -> Array:
    """D G / (4 n.v) (L, P) of light directions d (L, P, 3), normals n (P, 3), directions v (P, 3) to the viewer."""
    h = d + v
    h /= np.maximum(np.linalg.norm(h, axis=2, keepdims=True), 1e-9)
    a2 = roughness**2
    nh, nd = np.einsum("kpi,pi->kp", h, n), np.einsum("kpi,pi->kp", d, n)
    nv = np.maximum(np.einsum("pi,pi->p", v, n), 0.05)
    D = a2 / (np.pi * (np.maximum(nh, 0) ** 2 * (a2 - 1) + 1) ** 2)

    def smith(cosine: Array) -> Array:
        return 2 * cosine / (cosine + np.sqrt(a2 + (1 - a2) * cosine**2) + 1e-12)

    return np.asarray(np.where(nd > 0, D * smith(np.maximum(nd, 0)) * smith(nv) / (4 * nv), 0.0))


def estimate(seen: Sight, lit: Lit, usable: Mask, gloss: Gloss, start: Estimate) -> Estimate:
    """Normals and albedo (see surface.normals) with the gloss taken off, from those at the start; a few rounds."""
    found, v = start, -seen.rays_C / np.linalg.norm(seen.rays_C, axis=1, keepdims=True)
    for _ in range(ROUNDS):
        n = lambert.unit(np.where(np.isfinite(found.b), found.b, v))[0]
        shine = gloss.ks * lit.E * lobe(lit.d, n, v, gloss.roughness)
        found = replace(normals.estimate(seen, lit.B, usable, normals.variances(seen, shine), shine), gloss=shine)
    return found


def fit(seen: Sight, lit: Lit, usable: Mask, start: Estimate, before: Gloss | None = None) -> Gloss | None:
    """The lobe of the object, None where it has none to speak of; the search begins from the one `before`."""
    from scipy import optimize

    known = np.flatnonzero(np.isfinite(start.b[:, 0]))
    if len(known) < normals.LEAST * 100:
        return None
    some = known[:: max(1, len(known) // SAMPLE)]
    sample, light, usable = seen.at(some), lit.at(some), usable[:, some]
    begin = Estimate(start.b[some], start.inliers[:, some], start.covariance[some], start.chi2[some], start.cost[some])
    albedo = float(np.median(np.linalg.norm(begin.b, axis=1)))
    plain = normals.misfit(sample, light.B, usable, normals.estimate(sample, light.B, usable, normals.variances(sample)))

    if plain < CLEAN:
        return None

    def cost(x: Array) -> float:
        trial = Gloss(albedo * float(np.exp(x[0])), float(np.clip(np.exp(x[1]), 0.03, 1.0)), 1.0)
        found = estimate(sample, light, usable, trial, begin)
        return normals.misfit(sample, light.B, usable, found, found.gloss)

    trials = [np.log([strength, roughness]) for strength in STRENGTHS for roughness in ROUGHNESSES]
    best = min(trials, key=cost) if before is None else np.log([before.ks / albedo, before.roughness])
    if cost(best) > plain:
        return None
    simplex = best + np.array([[0, 0], [0.5, 0], [0, 0.25]])
    found = optimize.minimize(cost, best, method="Nelder-Mead", options={"maxfev": TRIAL_STEPS, "initial_simplex": simplex})
    gain = float(found.fun) / plain
    return Gloss(albedo * float(np.exp(found.x[0])), float(np.clip(np.exp(found.x[1]), 0.03, 1.0)), gain) if gain < KEPT_BELOW else None
