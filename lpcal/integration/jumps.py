r"""A depth whose breaks lie where they cost least: parts of it jump, whole, as long as that is cheaper.

The integration (integration.integrate) minimises

    E(u) = sum_ab rho((u_b - u_a - g_ab) / s_ab)  +  sum_p H_p (u_p - h_p)^2,      rho(e) = C^2 e^2 / (C^2 + e^2)

whose cost rho of an edge is hardly more for a large jump than for one of a few C, so that E has many minima. Weights that follow the
residuals find one near where they begin: half a break in the wrong place, with a smooth ramp from its end on. So pixels may jump,
``u_p + d x_p`` with x_p 0 or 1: of all sets of pixels at once the one that lowers E the most is the cheapest cut of a graph, if no edge
gains more by one of its pixels' jump than by the jump back costs, ``rho(r + d) + rho(r - d) >= 2 rho(r)``. Edges that do, those that a jump
would mend, have the dearer of both raised until they do not: no set is then worth more than it is. Jumps of both signs are tried by the
quantiles of those at the breaks, then weights and depth are settled from there.

Sources: Bioucas-Dias and Valadao 2007, IEEE Trans. Image Processing 16 (phases unwrapped by jumps of sets of pixels); Rother, Kumar,
Kolmogorov and Blake 2005, Digital tapestry (edges that are raised).
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.integration import cuts
from lpcal.integration.integrate import Grid, Own, scale_of, settle, weights_of
from lpcal.integration.pieces import BREAK_WEIGHT

QUANTILES = (0.2, 0.5, 0.8)
"""Those of the jumps at the present breaks that are tried: they say by how much parts of the surface may be off."""
SETTLES = 4
"""Times that weights and depth are computed after jumps, which leaves a thousandth of what mended edges have still to give."""


def jumped(grid: Grid, step: Array, sigma: Array, own: Own, u: Array) -> tuple[Array, Array]:
    """u (P,) and the weights (edges,) at a minimum of E that no jump leads out of, from u, which minimises it nearby.

    `step` and `sigma` (edges,) are g and s. A jump that saves less than the cost of a single break is not made.
    """
    scale = scale_of((u[grid.b] - u[grid.a] - step) / sigma)
    energy = _energy(grid, step, sigma, own, u, scale)
    weight = weights_of(grid, u, step, sigma)
    while True:
        sizes = np.abs(u[grid.b] - u[grid.a] - step)[weight <= BREAK_WEIGHT]
        if not len(sizes):
            return u, weight
        after = _jumped_once(grid, step, sigma, own, u, scale, np.unique(np.quantile(sizes, QUANTILES))[::-1])
        if after is u:
            return u, weight
        for _ in range(SETTLES):
            after_weight = weights_of(grid, after, step, sigma)
            after = settle(grid, step, sigma, own, after, after_weight)
        less = _energy(grid, step, sigma, own, after, scale)
        if less > energy - scale**2:
            return u, weight
        u, energy, weight = after, less, weights_of(grid, after, step, sigma)


def _jumped_once(grid: Grid, step: Array, sigma: Array, own: Own, u: Array, scale: float, sizes: Array) -> Array:
    """u (P,) after the jumps of the sizes that lower E, larger ones first; u itself where none does."""
    energy = _energy(grid, step, sigma, own, u, scale)
    for d in np.concatenate([sizes, -sizes]):
        after = u + d * _worth(grid, step, sigma, own, u, scale, d)
        less = _energy(grid, step, sigma, own, after, scale)
        if less < energy - scale**2:
            u, energy = after, less
    return u


def _worth(grid: Grid, step: Array, sigma: Array, own: Own, u: Array, scale: float, d: float) -> Mask:
    """The pixels (P,) that are worth a jump by d."""
    residual = u[grid.b] - u[grid.a] - step
    here, of_a, of_b = (_rho(one / sigma, scale) for one in (residual, residual - d, residual + d))
    lack = np.maximum(2 * here - of_a - of_b, 0)
    of_a, of_b = of_a + lack * (of_a >= of_b), of_b + lack * (of_a < of_b)
    taken = own.curvature * d * (d + 2 * (u - own.optimum))
    uneven = (of_a - of_b) / 2
    taken = taken + np.bincount(grid.a, uneven, len(u)) - np.bincount(grid.b, uneven, len(u))
    return cuts.cheapest(grid, taken, np.maximum((of_a + of_b) / 2 - here, 0))


def _energy(grid: Grid, step: Array, sigma: Array, own: Own, u: Array, scale: float) -> float:
    """E of u (P,)."""
    edges = _rho((u[grid.b] - u[grid.a] - step) / sigma, scale)
    return float(edges.sum() + (own.curvature * (u - own.optimum) ** 2).sum())


def _rho(e: Array, scale: float) -> Array:
    """The cost of residuals e in sigmas."""
    square = e**2
    return np.asarray(scale**2 * square / (scale**2 + square))
