"""The pieces of a surface: where it breaks, what hangs together, and the filling of gaps in between."""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.surface import multigrid
from lpcal.surface.integrate import Grid

BREAK_WEIGHT = 0.02
SMALLEST_SHARE = 0.02
SMALLEST_PIXELS = 60
KNOWN = 1e3


def fill(grid: Grid, values: Array, known: Mask) -> Array:
    """Values (P, C), those not known (P,) taken from their neighbours in the mask as a soap film would."""
    from scipy import sparse

    if known.all() or not known.any():
        return np.nan_to_num(values)
    a, b, count = grid.a, grid.b, len(values)
    ones = np.ones(len(a))
    hold = np.where(known, KNOWN, 1e-6)
    diagonal = hold + np.bincount(a, ones, count) + np.bincount(b, ones, count)
    every = np.arange(count)
    A = sparse.csr_array(
        (np.concatenate([diagonal, -ones, -ones]), (np.concatenate([every, a, b]), np.concatenate([every, b, a]))), shape=(count, count)
    )
    clean = np.where(known[:, None], values, values[known].mean(axis=0))
    found = [multigrid.solve(A, hold * column, column, grid.prolongations, precision=1e-3) for column in clean.T]
    return np.where(known[:, None], values, np.stack(found, axis=1))


def break_map(grid: Grid, weight: Array, mask: Mask) -> Mask:
    """Breaks (2, H, W) of a mask, from the weights of its edges."""
    holds = np.zeros((2, *mask.shape), bool)
    number_of_first = np.flatnonzero(mask.ravel())[grid.a]
    whole = weight > BREAK_WEIGHT
    for axis, edges in enumerate((grid.horizontal, ~grid.horizontal)):
        holds[axis].ravel()[number_of_first[edges & whole]] = True
    return ~holds


def pieces(grid: Grid, weight: Array, mask: Mask) -> Labels:
    """Labels (P,) from 1, the largest first, of what hangs together over edges that are no breaks; crumbs join the nearest piece."""
    from scipy import ndimage, sparse
    from scipy.sparse.csgraph import connected_components

    count = int(mask.sum())
    whole = weight > BREAK_WEIGHT
    links = sparse.coo_array((np.ones(whole.sum()), (grid.a[whole], grid.b[whole])), shape=(count, count))
    _, label = connected_components(links, directed=False)
    size = np.bincount(label)
    order = np.argsort(-size)
    kept = [one for one in order[:255] if size[one] >= max(SMALLEST_PIXELS, SMALLEST_SHARE * count)] or [order[0]]
    rank = np.zeros(len(size), np.uint8)
    rank[kept] = np.arange(1, len(kept) + 1)
    labels = np.zeros(mask.shape, np.uint8)
    labels[mask] = rank[label]
    nearest = ndimage.distance_transform_edt(labels == 0, return_distances=False, return_indices=True)
    return np.asarray(labels[tuple(nearest)][mask])
