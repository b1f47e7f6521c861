"""Grids of corners from saddle points, whatever their count: saddles are linked to their neighbours, and a grid grows from the links.

Symbols: saddle i with edges a_i, b_i and bright quarters along e_i. Its neighbour along +a is the nearest saddle j in that direction whose
edges are parallel to its own and whose bright quarters are turned by a quarter, as they are from one corner to the next of a chessboard; a
link counts where it is mutual. What is linked together has whole-numbered places (column, row); lines that continue it are looked for
beyond its rim, where three corners' parabola says, so that holes close and no corner count needs to be known.
"""

from __future__ import annotations

from collections import deque

import numpy as np

from lpcal.detect.board_grid import extended
from lpcal.detect.saddle import SaddlePoints, likeness, saddle_points
from lpcal.geometry.arrays import Array, Labels, Mask

NEIGHBOURS = 14
"""Nearest saddles among which a neighbour is looked for: the eight about a corner, and some that are no corners."""
ALONG_COS, PARALLEL_COS, TURNED_COS = 0.955, 0.9, 0.6
"""A neighbour lies within 17 degrees of an edge's direction, its edges within 26 degrees of parallel, its bright quarters within 37
degrees of crosswise: what a lens and a tilted board bend from one square to the next."""
FEWEST = 9
"""Linked saddles that make a grid, 3x3: noise and foliage link three or four."""
COMPONENTS = 3
"""Connected components that are laid out: boards that stand side by side are a few."""
RING_SHARE = 0.3
"""Radius of the ring about a place where a corner is looked for, in units of the spacing."""
LIKE = 0.7
"""Likeness of a corner at a place where a grid says that one should be."""
QUARTER_SHARE, CONTRAST = 0.25, 0.4
"""Where a quarter's light is read, in units of the spacing along both axes; and the least contrast of its quarters, of the grid's own: a
square cut at the rim, or its end against a table, has light and dark on the wrong side."""
RIM_SHARE = 0.08
"""The same share for corners that were linked: squares cut to a tenth of their width are squares, a thinner line is a frame."""
STRAY = 0.22
"""A corner looked for lies this near to where it should be, in units of the spacing."""
FULL = 0.6
"""Share of a line's places that must hold a corner, for the line to belong to the grid."""
LARGE_PX, SMALL_PX = 2000, 1000
"""Images of a longer side than the one are searched at half size and less, of a shorter side than the other at twice their size last."""
MOST_LINES = 100
"""Lines of a grid along a side, at most."""


def seen_grid(grey: Labels, corners: tuple[int, int] | None = None) -> Array | None:
    """The largest grid of corners (rows, columns, 2) of an 8 bit image, columns the more, NaN where one was not seen; None: none.

    `corners` is the count hoped for: the search ends where it is found.
    """
    import cv2

    best: Array | None = None
    sizes = [1.0, 0.5, 0.25] if max(grey.shape) <= LARGE_PX else [0.5, 0.25, 0.125]
    if max(grey.shape) < SMALL_PX:
        sizes.append(2.0)
    for size in sizes:
        smooth = cv2.INTER_AREA if size < 1 else cv2.INTER_CUBIC
        small = grey if size == 1 else np.asarray(cv2.resize(grey, None, fx=size, fy=size, interpolation=smooth), dtype=np.uint8)
        grid = linked_grid(saddle_points(small))
        if grid is None:
            continue
        grid = grown(small, _crossed(np.asarray(small, dtype=float), grid))
        grid = (grid + 0.5) / size - 0.5
        if best is None or np.isfinite(grid).sum() > np.isfinite(best).sum():
            best = grid
        if corners is not None and sorted(grid.shape[:2]) == sorted(corners) and np.isfinite(grid).all():
            break
    return best


def linked_grid(found: SaddlePoints) -> Array | None:
    """The largest set of linked saddles as a grid (rows, columns, 2), columns the more, NaN where there is none; None: too small."""
    count = len(found.places_px)
    if count < FEWEST:
        return None
    links = _mutual(found)
    place = np.zeros((count, 2), dtype=int)
    seen = np.zeros(count, dtype=bool)
    best: list[int] = []
    for first in _firsts(links):
        members = _spread_from(first, found.edges, links, place, seen)
        if len(members) > len(best):
            best = members
    if len(best) < FEWEST:
        return None
    rows = np.array(best)
    low, high = place[rows].min(axis=0), place[rows].max(axis=0)
    columns, lines = high - low + 1
    if max(columns, lines) > MOST_LINES or min(columns, lines) < 2:
        return None
    grid = np.full((lines, columns, 2), np.nan)
    grid[place[rows, 1] - low[1], place[rows, 0] - low[0]] = found.places_px[rows]
    grid = _trimmed(grid)
    return None if min(grid.shape[:2]) < 3 else _wide(grid)


def grown(grey: Labels, grid: Array) -> Array:
    """The grid (rows, columns, 2) with its holes filled and the lines that go on beyond it, as far as an 8 bit image shows them."""
    light = np.asarray(grey, dtype=float)
    grid = _filled(light, grid)
    for _ in range(MOST_LINES):
        wider = extended(without_holes(grid), 1)
        inner = np.zeros(wider.shape[:2], dtype=bool)
        inner[1:-1, 1:-1] = True
        corners = _corners_near(light, wider, inner)
        sides = (corners[1:-1, 0], corners[1:-1, -1], corners[0, 1:-1], corners[-1, 1:-1])
        more = [np.isfinite(side[:, 0]).mean() >= FULL for side in sides]
        if not any(more):
            return grid
        corners[1:-1, 1:-1] = grid
        rows, columns = slice(not more[2], corners.shape[0] - (not more[3])), slice(not more[0], corners.shape[1] - (not more[1]))
        grid = _filled(light, corners[rows, columns])
    return grid


def _mutual(found: SaddlePoints) -> Array:
    """Neighbours (N, 4) along +a, -a, +b, -b, -1 where there is none that agrees."""
    from scipy.spatial import cKDTree

    places, edges, bright = found.places_px, found.edges, found.bright
    count = len(places)
    near = min(NEIGHBOURS + 1, count)
    distance, other = cKDTree(places).query(places, k=near)
    distance, other = distance[:, 1:], other[:, 1:]
    way = (places[other] - places[:, None]) / np.maximum(distance[..., None], 1e-9)
    crosswise = np.abs(np.einsum("nd,nkd->nk", bright, bright[other])) < TURNED_COS
    alike = np.abs(np.einsum("nad,nkbd->nkab", edges, edges[other]))
    straight = np.minimum(alike[..., 0, 0], alike[..., 1, 1]) > PARALLEL_COS
    swapped = np.minimum(alike[..., 0, 1], alike[..., 1, 0]) > PARALLEL_COS
    fits = crosswise & (straight | swapped)
    links = np.full((count, 4), -1)
    for side, direction in enumerate((edges[:, 0], -edges[:, 0], edges[:, 1], -edges[:, 1])):
        ahead = fits & (np.einsum("nd,nkd->nk", direction, way) > ALONG_COS)
        length = np.where(ahead, distance, np.inf)
        nearest = length.argmin(axis=1)
        links[:, side] = np.where(np.isfinite(length.min(axis=1)), other[np.arange(count), nearest], -1)
    back = np.any(links[links] == np.arange(count)[:, None, None], axis=-1)
    return np.asarray(np.where((links >= 0) & back, links, -1))


def _firsts(links: Array) -> list[int]:
    """A saddle of each of the largest connected components, the one with most links."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    at, side = np.nonzero(links >= 0)
    graph = coo_array((np.ones(len(at), dtype=bool), (at, links[at, side])), shape=(len(links), len(links)))
    label = connected_components(graph, directed=False)[1]
    size = np.bincount(label)
    largest = [one for one in np.argsort(-size)[:COMPONENTS] if size[one] >= FEWEST]
    degree = np.count_nonzero(links >= 0, axis=1)
    return [int(np.where(label == one, degree, -1).argmax()) for one in largest]


def _spread_from(first: int, edges: Array, links: Array, place: Array, seen: Array) -> list[int]:
    """What is linked to the first saddle, each given its column and row; one that would get a place that is taken stays out."""
    way = edges.tolist()
    axes = {first: way[first]}
    spots = {first: (0, 0)}
    taken, members, queue = {(0, 0)}, [first], deque([first])
    seen[first] = True
    while queue:
        at = queue.popleft()
        (column, row), axis = spots[at], axes[at]
        for side, other in enumerate(links[at].tolist()):
            if other < 0 or seen[other]:
                continue
            ahead = -1 if side % 2 else 1
            x, y = (ahead * _dot(way[at][side // 2], each) for each in axis)
            spot = (column + (1 if x > 0 else -1), row) if abs(x) >= abs(y) else (column, row + (1 if y > 0 else -1))
            if spot in taken:
                continue
            first_is_x = abs(_dot(way[other][0], axis[0])) > abs(_dot(way[other][0], axis[1]))
            own = way[other] if first_is_x else way[other][::-1]
            axes[other] = [own[k] if _dot(own[k], axis[k]) >= 0 else [-own[k][0], -own[k][1]] for k in (0, 1)]
            spots[other], seen[other] = spot, True
            taken.add(spot)
            members.append(other)
            queue.append(other)
    place[members] = [spots[one] for one in members]
    return members


def _dot(a: list[float], b: list[float]) -> float:
    return a[0] * b[0] + a[1] * b[1]


def _trimmed(grid: Array) -> Array:
    """Without the outer lines that hold a corner at few of their places."""
    while min(grid.shape[:2]) >= 3:
        there = np.isfinite(grid[..., 0])
        shares = [there[0].mean(), there[-1].mean(), there[:, 0].mean(), there[:, -1].mean()]
        worst = int(np.argmin(shares))
        if shares[worst] >= FULL:
            break
        grid = (grid[1:], grid[:-1], grid[:, 1:], grid[:, :-1])[worst]
    return grid


def _wide(grid: Array) -> Array:
    return grid if grid.shape[1] >= grid.shape[0] else np.swapaxes(grid, 0, 1)


def _steps(grid: Array) -> Array:
    """The shorter of the mean distances (rows, columns) to a place's neighbours along either axis."""
    lengths = []
    for axis in (0, 1):
        step = np.linalg.norm(np.diff(grid, axis=axis), axis=-1)
        first, last = np.take(step, [0], axis=axis), np.take(step, [-1], axis=axis)
        padded = np.concatenate([first, step, last], axis=axis)
        lengths.append(
            np.take(padded, range(padded.shape[axis] - 1), axis=axis) / 2 + np.take(padded, range(1, padded.shape[axis]), axis=axis) / 2
        )
    return np.asarray(np.minimum(*lengths))


def without_holes(grid: Array) -> Array:
    """The grid with a place for every corner: those not seen by a polynomial of third order over the nearest ones' lines."""
    hole = np.isnan(grid[..., 0])
    if not hole.any():
        return grid
    rows, columns = grid.shape[:2]
    v, u = (axis / max(1, size - 1) for axis, size in zip(np.indices((rows, columns)), (rows, columns), strict=True))
    powers = [(p, q) for p in range(4) for q in range(4 - p) if p < columns and q < rows]
    terms = np.stack([u**p * v**q for p, q in powers], axis=-1)
    numbers = np.linalg.lstsq(terms[~hole], grid[~hole], rcond=None)[0]
    return np.where(hole[..., None], terms @ numbers, grid)


def _filled(light: Array, grid: Array) -> Array:
    """The grid with those of its missing corners that the image shows."""
    hole = np.isnan(grid[..., 0])
    if not hole.any():
        return grid
    whole = without_holes(grid)
    return np.where(hole[..., None], _corners_near(light, whole, ~hole), grid)


def _corners_near(light: Array, places: Array, inner: Mask) -> Array:
    """The likeliest corner (rows, columns, 2) near each place, NaN where none is likely; `inner`: known before."""
    steps = _steps(places)[~inner]
    offsets = np.stack(np.meshgrid(*2 * [np.linspace(-STRAY, STRAY, 5)]), axis=-1).reshape(-1, 2)
    tried = places[~inner][:, None] + steps[:, None, None] * offsets
    radius = np.repeat(np.maximum(RING_SHARE * steps, 1.5)[:, None], len(offsets), axis=-1)
    like = likeness(light, tried.reshape(-1, 2), radius.ravel())[0].reshape(radius.shape)
    best = like.argmax(axis=-1)
    found = places.copy()
    found[~inner] = tried[np.arange(len(best)), best]
    contrast = _crossing(light, found)
    usual = np.median(contrast[inner])
    fits = contrast > CONTRAST * usual if usual > 0 else contrast < CONTRAST * usual
    fits[~inner] &= like.max(axis=-1) > LIKE
    return np.where(fits[..., None], found, np.nan)


def _crossed(light: Array, grid: Array) -> Array:
    """The grid without what is no crossing of squares over a share of the spacing: joints of a thin frame, prints."""
    whole = without_holes(grid)
    contrast = np.where(np.isnan(grid[..., 0]), np.nan, _crossing(light, whole, RIM_SHARE))
    usual = np.nanmedian(contrast)
    good = np.sign(usual) * contrast > CONTRAST * abs(usual)
    trimmed = _trimmed(np.where(good[..., None], grid, np.nan))
    return trimmed if min(trimmed.shape[:2]) >= 3 and np.isfinite(trimmed[..., 0]).sum() >= FEWEST else grid


def _crossing(light: Array, grid: Array, share: float = QUARTER_SHARE) -> Array:
    """Signed contrast (rows, columns) about each place, the least of its quarters': of one sign over a board."""
    import cv2

    wide = extended(grid, 1)
    along, across = (wide[1:-1, 2:] - wide[1:-1, :-2]) / 2, (wide[2:, 1:-1] - wide[:-2, 1:-1]) / 2
    quarters = []
    for x, y in ((1, 1), (-1, -1), (1, -1), (-1, 1)):
        at = np.nan_to_num(grid + share * (x * along + y * across), nan=-9.0).astype(np.float32)
        quarters.append(cv2.remap(light, at[..., 0], at[..., 1], cv2.INTER_LINEAR))
    parity = np.where(np.indices(grid.shape[:2]).sum(axis=0) % 2, -1.0, 1.0)
    first, second = np.stack(quarters[:2]), np.stack(quarters[2:])
    bright = np.where(parity > 0, first.min(axis=0), second.min(axis=0)) - np.where(parity > 0, second.max(axis=0), first.max(axis=0))
    dark = np.where(parity > 0, second.min(axis=0), first.min(axis=0)) - np.where(parity > 0, first.max(axis=0), second.max(axis=0))
    return np.asarray(np.where(bright > 0, bright, np.where(dark > 0, -dark, 0.0)))
