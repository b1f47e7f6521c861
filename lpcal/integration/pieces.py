"""Connected components (pieces) of a surface between its depth discontinuities, gap filling, and the flatness of the largest."""

from __future__ import annotations

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.integration import multigrid
from lpcal.integration.integrate import Grid
from lpcal.integration.multigrid import Matrix, Pyramid
from lpcal.kernels.library import kernel
from lpcal.records.figures import Flatness
from lpcal.records.surface import Surface
from lpcal.view import parallel
from lpcal.view.constants import FEWEST_PIXELS, REGULARISATION, RIM_PX, SMALLEST_SHARE
from lpcal.view.pixel_list import Indices

BREAK_WEIGHT = 0.02
"""Weight below which an edge is a depth discontinuity (break): its residual exceeds two and a half times C (integration.integrate)."""
SLIVER_PX = 2 * RIM_PX
"""Width, pixels, up to which a strip between two breaks is not a piece: all of its pixels lie at a rim."""
NEARLY = 0.2
"""Deviation from a plane, as a share of the extent, above which a piece is not meant to be flat."""


def fill(grid: Grid, values: Array, known: Mask) -> Array:
    """Values (P, C) with those not `known` (P,) filled by harmonic interpolation (Laplace); 0 in components without a known value."""
    if known.all() or not known.any():
        return np.nan_to_num(values)
    unknown = np.flatnonzero(~known)
    number = np.full(len(values), -1, np.int64)
    number[unknown] = np.arange(len(unknown))
    pyramid = Pyramid.of(grid.rows[unknown], grid.columns[unknown])
    here, there = np.concatenate([grid.a, grid.b]), np.concatenate([grid.b, grid.a])
    rim = ~known[here] & known[there]
    here, there = number[here[rim]], there[rim]
    hold = np.asarray(np.bincount(here, minlength=len(unknown)) + REGULARISATION, float)
    A = Matrix(pyramid, hold, np.ones(len(pyramid.levels[0].a)))
    found = np.where(known[:, None], values, 0.0)
    for channel in range(values.shape[1]):
        right = np.bincount(here, values[there, channel], len(unknown))
        start = np.full(len(unknown), values[known, channel].mean())
        found[unknown, channel] = multigrid.solve(A, right, start)
    return found


def break_map(grid: Grid, weight: Array, mask: Mask) -> Mask:
    """Break map (2, H, W), towards the right and downwards, from the weights of a mask's edges."""
    holds = np.zeros((2, *mask.shape), bool)
    number_of_first = np.flatnonzero(mask.ravel())[grid.a]
    whole = weight > BREAK_WEIGHT
    for axis, edges in enumerate((grid.horizontal, ~grid.horizontal)):
        holds[axis].ravel()[number_of_first[edges & whole]] = True
    return ~holds


def pieces(grid: Grid, weight: Array, mask: Mask) -> Labels:
    """Labels (P,) from 1, the largest first, of the components connected by unbroken edges; small ones join the nearest piece.

    A bridge of one or two pixels between the ends of a break does not connect two pieces.
    """
    label = connected(grid, (weight > BREAK_WEIGHT) & ~_beside_breaks(grid, weight, mask))
    size = np.bincount(label)
    smallest = max(FEWEST_PIXELS, SMALLEST_SHARE * len(label))
    return _joined(label, np.flatnonzero(size >= smallest), mask)


def without_slivers(grid: Grid, weight: Array, mask: Mask) -> Array:
    """The weights (edges,) with each sliver's pixels joined to the nearest piece.

    A jump may have been split into two, which leaves a strip of a few pixels in between that belongs to neither piece.
    """
    label = connected(grid, weight > BREAK_WEIGHT)
    kept = []
    for one in np.flatnonzero(np.bincount(label) > SLIVER_PX**2):
        place = np.zeros(mask.shape, bool)
        place[mask] = label == one
        rows, columns = np.nonzero(place)
        close = place[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1]
        if raster.eroded(close, SLIVER_PX // 2).any():
            kept.append(one)
    if not kept:
        return weight
    joined = _joined(label, np.array(kept), mask)
    sliver = ~np.isin(label, kept)
    touched = sliver[grid.a] | sliver[grid.b]
    same = joined[grid.a] == joined[grid.b]
    return np.where(touched, np.where(same, 1.0, REGULARISATION), weight)


def _beside_breaks(grid: Grid, weight: Array, mask: Mask) -> Mask:
    """Mask (edges,) of edges that touch a pixel at a break or next to one."""
    broken = weight <= BREAK_WEIGHT
    at = np.zeros(int(mask.sum()), bool)
    at[grid.a[broken]] = at[grid.b[broken]] = True
    place = np.zeros(mask.shape, bool)
    place[mask] = at
    near = raster.dilated(place)[mask]
    return np.asarray(near[grid.a] | near[grid.b])


def connected(grid: Grid, whole: Mask) -> Indices:
    """Labels (P,) of the components connected by the unbroken edges `whole` (edges,)."""
    pixels = len(grid.rows)
    if run := kernel("connected"):
        label = np.empty(pixels, np.int64)
        run(pixels, len(whole), grid.a, grid.b, np.ascontiguousarray(whole), label)
        return label
    from scipy import sparse
    from scipy.sparse.csgraph import connected_components

    links = sparse.coo_array((np.ones(whole.sum()), (grid.a[whole], grid.b[whole])), shape=(pixels, pixels))
    return np.asarray(connected_components(links, directed=False)[1], np.int64)


def _joined(label: Indices, kept: Indices, mask: Mask) -> Labels:
    """Labels (P,) from 1, the largest of `kept` first; pixels of the others take that of the nearest kept pixel."""
    size = np.bincount(label)
    order = sorted(kept, key=lambda one: -size[one])[:255] or [int(np.argmax(size))]
    rank = np.zeros(len(size), np.uint8)
    rank[order] = np.arange(1, len(order) + 1)
    labels = np.zeros(mask.shape, np.uint8)
    labels[mask] = rank[label]
    return np.asarray(labels.ravel()[raster.nearest(labels > 0)[mask]])


def flatness(surface: Surface) -> Flatness | None:
    """Deviation of the largest piece from a plane, mm, its bowl and extent; None if it is not nearly flat, or depth is in pixels.

    The plane is fitted by total least squares to the piece without its outermost pixels; deviations w are along its normal. The bowl is the
    sag of the best paraboloid ``w = a + k (x^2 + y^2)`` over the extent, ``k (extent / 2)^2``.
    """
    inside = raster.eroded(surface.component == 1, RIM_PX)
    if not surface.rays_C[..., :2].any() or inside.sum() < FEWEST_PIXELS:
        return None
    places = np.flatnonzero(inside)
    places = places[:: max(1, len(places) // parallel.SAMPLES)]
    points = (surface.rays_C.reshape(-1, 3)[places] * surface.depth.ravel()[places, None]).astype(float)
    centred = points - points.mean(axis=0)
    along = np.linalg.svd(centred.T @ centred)[0]
    deviation = centred @ along[:, 2]
    extent = float(np.ptp(centred @ along[:, 0]))
    low, high = np.percentile(deviation, [0.5, 99.5])
    if high - low > NEARLY * extent:
        return None
    round_C = np.sum((centred @ along[:, :2]) ** 2, axis=1)
    k = np.linalg.lstsq(np.stack([np.ones_like(round_C), round_C], axis=1), deviation, rcond=None)[0][1]
    return Flatness(
        bowl_mm=float(1e3 * abs(k) * (extent / 2) ** 2),
        plane_rms_mm=float(1e3 * deviation.std()),
        plane_peak_to_valley_mm=float(1e3 * (high - low)),
        extent_mm=1e3 * extent,
    )
