"""Regions of the field of normals at another minimum of its energy, where those normals make a surface too.

A search (shading.search) proposes another field. Its energy knows nothing of depth: normals that are mirrored, or that explain the light of
other surfaces by turning towards it, can cost as little as the right ones. But they are the slopes of no surface, and the right ones are.
So a region of the proposal is taken where both fall: the field's energy, and that of the depth integrated from its normals.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array
from lpcal.integration import pieces
from lpcal.integration.integrate import Grid, Own, integrate, steps
from lpcal.shading import field, search
from lpcal.shading.field import Field
from lpcal.view.agreed import OUTLIER2
from lpcal.view.sight import Sight


def another_minimum(grid: Grid, costs: search.Costs, own: Own, u: Array, before: Field) -> Field | None:
    """The field with the regions of a search that cost less by samples and by depth; None where there are none.

    `u` and `own` are the log depth (P,) and each pixel's own distance.
    """
    seen = costs.seen
    proposed = replace(before, b=search.propose(costs, grid, before.b))
    found = field.solve(seen, grid, costs.lit, costs.hidden, proposed, palette=costs.palette).b  # candidates are some degrees off
    changed = field.apart(before.b, found) > 1
    if not changed.any():
        return None
    whole = changed[grid.a] & changed[grid.b] & (field.apart(found[grid.a], found[grid.b]) < field.LINK2)
    region = pieces.connected(grid, whole)
    found = np.where(changed[:, None], found, before.b)
    by_samples = search.energy(costs, grid, before.b) - search.energy(costs, grid, found)
    by_depth = _depth_energy(seen, grid, own, u, before.b) - _depth_energy(seen, grid, own, u, found)
    less = [np.bincount(region, np.where(changed, one, 0.0)) > 0 for one in (by_samples, by_depth)]
    taken = changed & (less[0] & less[1])[region]
    return replace(before, b=np.where(taken[:, None], found, before.b)) if taken.any() else None


def _depth_energy(seen: Sight, grid: Grid, own: Own, u: Array, b: Array) -> Array:
    """How badly a depth keeps the steps of normals b (P, 3), pixel by pixel (P,): an edge's is shared by its ends."""
    step, sigma = steps(grid, lambert.unit(b)[0], seen.rays_C, central=seen.central)
    depth, _ = integrate(grid, step, sigma, own, u, graduated=False)
    square = ((depth[grid.b] - depth[grid.a] - step) / sigma) ** 2
    cost = square / (1 + square / OUTLIER2) / 2
    return np.asarray(np.bincount(grid.a, cost, len(u)) + np.bincount(grid.b, cost, len(u)))
