"""Minimum cuts: the binary labelling of a grid's pixels that minimises a cost of single pixels and of edges."""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.integration.integrate import Grid
from lpcal.kernels.library import kernel

CENTS = 1e5
"""Integer units of a unit of cost: the library's maximum flow takes 32-bit integers."""


def cheapest_change(grid: Grid, taken: Array, neither: Array, only_a: Array, only_b: Array, both: Array) -> Mask:
    """The set of pixels (P,) whose change minimises the total cost.

    A change of a pixel costs `taken` (P,); an edge costs `neither`, `only_a`, `only_b` or `both` (edges,), by which of its ends change.
    Edges that are not submodular (``only_a + only_b < neither + both``) have the larger of the two raised until they are, so that the cost
    of no set is underestimated. Source: Rother, Kumar, Kolmogorov and Blake 2005, Digital tapestry, CVPR.
    """
    lack = np.maximum(neither + both - only_a - only_b, 0)
    only_a, only_b = only_a + lack * (only_a >= only_b), only_b + lack * (only_a < only_b)
    of_a, of_b = (both - neither + only_a - only_b) / 2, (both - neither + only_b - only_a) / 2
    total = taken + np.bincount(grid.a, of_a, len(taken)) + np.bincount(grid.b, of_b, len(taken))
    return cheapest(grid, total, np.maximum((only_a + only_b - neither - both) / 2, 0))


def cheapest(grid: Grid, taken: Array, parted: Array) -> Mask:
    """The set of pixels (P,) that minimises the sum of `taken` (P,) over its pixels and of `parted` (edges,) >= 0 over its boundary.

    By a maximum flow: Greig, Porteous and Seheult 1989, J. Royal Statistical Society B 51.
    """
    if run := kernel("cheapest_cut"):
        pixels, of_a, of_b = len(taken), np.where(grid.horizontal, 0, 2), np.where(grid.horizontal, 1, 3)
        beside, left = np.full((4, pixels), -1, np.int32), np.zeros((4, pixels))
        beside[of_a, grid.a], beside[of_b, grid.b] = grid.b, grid.a
        left[of_a, grid.a] = left[of_b, grid.b] = parted
        found = np.empty(pixels, bool)
        run(pixels, beside, left, np.array(taken, float), np.empty((4, pixels), np.int32), np.empty((2, pixels), np.bool_), found)
        return found
    from scipy import sparse
    from scipy.sparse.csgraph import breadth_first_order, maximum_flow

    pixels, every = len(taken), np.arange(len(taken))
    source, sink = np.full(pixels, pixels), np.full(pixels, pixels + 1)
    begin, end = np.concatenate([grid.a, grid.b, source, every]), np.concatenate([grid.b, grid.a, every, sink])
    cost = np.rint(CENTS * np.concatenate([parted, parted, np.maximum(-taken, 0), np.maximum(taken, 0)]))
    room = sparse.csr_array((np.minimum(cost, np.iinfo(np.int32).max).astype(np.int32), (begin, end)), shape=(pixels + 2, pixels + 2))
    left_over = room - maximum_flow(room, pixels, pixels + 1).flow
    left_over.eliminate_zeros()
    taken_too = np.zeros(pixels + 2, bool)
    taken_too[breadth_first_order(left_over, pixels, return_predecessors=False)] = True
    return taken_too[:pixels]
