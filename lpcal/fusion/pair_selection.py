r"""Selection of the pairs of views that are compared: enough overlapping ones to determine every view's pose.

Of a few views every one is compared with every other. Of many, round one object, each overlaps with a third of all, and every further
comparison says less: a view has MOST partners, chosen evenly from the one that shows most of the same places to the one that shows least.
Those beside it tell its shape and normals, those from far round tell its distance. What is compared then grows as the views do.

Places are cells of space, each in eight by the way that the surface faces: a sparse matrix of views and cells, times itself, counts the
cells that two views both show.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from lpcal.fusion.views import PlacedView
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

MOST = 16
"""Views that each chooses to be compared with: of 64 views of a stone with 12 of them a model was as near the truth as with all 63."""
CELLS = 5
"""Cells along a view's object: a cell is larger than the distance's error, and small enough to grade what two views share."""
LOOKED_AT = 400
"""Points of a view whose cells are taken, about: each of its cells holds some."""
LEAST_SHARED = 2
"""Cells that two views must both show: one may be of two sides of an edge."""

type Partners = tuple[tuple[int, ...], ...]
"""Each view's others that it is compared with, in rising order; each is one of theirs."""


def everyone(count: int) -> Partners:
    """Every view with every other."""
    return tuple(tuple(other for other in range(count) if other != one) for one in range(count))


def among(partners: Partners, kept: Sequence[int]) -> Partners:
    """The partners of some views, by their places among these."""
    place = {one: at for at, one in enumerate(kept)}
    return tuple(tuple(place[other] for other in partners[one] if other in place) for one in kept)


def partners_of(views: Sequence[PlacedView]) -> Partners:
    """The partners of views where their placements put them."""
    if len(views) <= MOST + 1:
        return everyone(len(views))
    from scipy.sparse import csr_array

    faced = [_faced(view) for view in views]
    side_m = float(np.median([np.linalg.norm(np.ptp(x_A, axis=0)) for x_A, _ in faced])) / CELLS
    cells = [np.column_stack([np.floor(x_A / side_m), n_A > 0]).astype(np.int64) for x_A, n_A in faced]
    which, of = np.unique(np.concatenate(cells), axis=0, return_inverse=True)
    view = np.repeat(np.arange(len(views)), [len(some) for some in cells])
    shows = csr_array((np.ones(len(view)), (view, of.ravel())), shape=(len(views), len(which)))
    shows.data[:] = 1.0
    both = (shows @ shows.T).tocsr()
    chosen: list[set[int]] = [set() for _ in views]
    for one in range(len(views)):
        found = slice(both.indptr[one], both.indptr[one + 1])
        for other in _chosen(one, both.indices[found].tolist(), both.data[found].tolist()):
            chosen[one].add(other)
            chosen[other].add(one)
    return tuple(tuple(sorted(some)) for some in chosen)


def _chosen(one: int, others: Iterable[int], shared: Iterable[float]) -> list[int]:
    """MOST of the views that show so many cells of one, evenly from the most to the least."""
    row = sorted((-count, other) for other, count in zip(others, shared, strict=True) if other != one and count >= LEAST_SHARED)
    if len(row) <= MOST:
        return [other for _, other in row]
    return [row[int(at)][1] for at in np.linspace(0, len(row) - 1, MOST).round()]


def _faced(view: PlacedView) -> tuple[Array, Array]:
    """Some points of a view and their normals, (N, 3) in A."""
    row, column = np.nonzero(view.witness)
    some = np.unique(np.linspace(0, len(row) - 1, min(LOOKED_AT, len(row))).astype(int)) if len(row) else np.zeros(0, int)
    row, column = row[some], column[some]
    H_AC = view.placement.H_AC
    return se3.apply(H_AC, view.points_C(row, column)), se3.rotate(H_AC, view.normals_C[row, column].astype(float))
