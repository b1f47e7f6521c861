r"""The common surface of all views: a truncated signed distance on a grid, and its triangles.

Symbols: x a grid point, q what a view shows in its direction, n the view's normal there, T the truncation::

    d(x) = n . (x - q)                  signed distance to the view's tangent plane: the measured normal carries the detail
    D(x) = sum_i w_i clip(d_i, -T, T) / sum_i w_i          views for which x is not hidden: d_i > -T

w falls with the view's own doubt: the normal's standard deviation, the slant. Only boxes near points of any view are computed, tile by tile
of space (`tiles`), and triangles are made only where every corner was seen: what no view saw stays open. Source: B. Curless and M. Levoy, A
volumetric method for building complex models from range images (1996); marching cubes are scikit-image's.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.fusion.correspondences import Placed
from lpcal.fusion.tiles import BOX, MOST_BOXES, SpaceTile, TileFaces, VoxelGrid, joined, parts_of, tiles_of
from lpcal.fusion.views import look, may_see
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Image, Index, Mask
from lpcal.geometry.isosurface import isosurface

TRUNCATION = 3.0
"""Truncation in grid steps: further away than this a plane is no longer the surface."""
STEP_PX = 1.4
"""Grid step in footprints of a pixel: finer ones cost the cube and show only what the vertices get from the views afterwards."""
AT_ONCE = 1 << 18
"""Grid points that are looked up in a view at a time."""
CARVING = 0.1
"""Weight of a view that looks through a grid point at a surface far behind it, over that of one that shows a surface there."""


@dataclass(frozen=True)
class Triangles:
    """Vertices (V, 3) in A, outward normals (V, 3), faces (F, 3)."""

    vertices_A: Array
    normals_A: Array
    faces: Index


def in_turn(work: TileWork, tiles: Sequence[SpaceTile]) -> Iterable[TileFaces]:
    """Every tile, one after the other."""
    return map(work, tiles)


type Over = Callable[[TileWork, Sequence[SpaceTile]], Iterable[TileFaces]]
"""Has every tile worked on, somewhere; in the tiles' order."""


def surface_of(state: Sequence[Placed], step_m: float | None = None, over: Over = in_turn) -> Triangles:
    """Triangles of the surface that placed views share.

    Raises
    ------
    DegenerateError
        No two neighbouring grid points were seen.
    """
    points_A = [_all_points(one) for one in state]
    step_m = step_m or STEP_PX * float(np.median([one.view.footprint_m for one in state]))
    low, high = np.min([x.min(axis=0) for x in points_A], axis=0), np.max([x.max(axis=0) for x in points_A], axis=0)
    step_m = max(step_m, float((high - low).max()) / (BOX * (MOST_BOXES - 4)))
    grid = VoxelGrid(low - (TRUNCATION + 2 + BOX) * step_m, step_m)
    found = [part for part in over(TileWork(tuple(state), grid), tiles_of(points_A, grid)) if len(part.faces)]
    if not found:
        raise DegenerateError("the views show no surface in common", where="fuse", needed="surfaces of one object that overlap")
    return _clean(*joined(found, grid))


def _all_points(one: Placed) -> Array:
    """Every second point of a view that can be compared."""
    row, column = np.nonzero(one.view.witness)
    row, column = row[::2], column[::2]
    pixel = np.column_stack([column, row]).astype(float)
    delta = one.bending.at(one.field, pixel, one.view.component[row, column])
    return se3.apply(one.H_AC, one.view.points_C(row, column) * np.exp(delta)[:, None])


@dataclass(frozen=True)
class TileWork:
    """What is done of each tile."""

    state: tuple[Placed, ...]
    grid: VoxelGrid

    def __call__(self, tile: SpaceTile) -> TileFaces:
        """The triangles of a tile; none where no cell of it was seen from all corners, or where the surface does not pass."""
        none = TileFaces(np.zeros((0, 3), np.int64), np.zeros((0, 3), np.intp))
        distance, weight = self.distances(tile)
        seen = weight > 0
        if min(seen.shape) < 2:
            return none
        cells = seen[:-1, :-1, :-1].copy()
        for i, j, k in np.ndindex(2, 2, 2):
            cells &= seen[i : seen.shape[0] - 1 + i, j : seen.shape[1] - 1 + j, k : seen.shape[2] - 1 + k]
        if not cells.any() or not distance[seen].min() < 0 < distance[seen].max():
            return none
        distance[~seen] = TRUNCATION
        vertices, faces = isosurface(distance)
        middle = np.floor(vertices[faces].mean(axis=1)).astype(int)
        faces = faces[cells[tuple(middle.T)]]
        used, numbers = np.unique(faces, return_inverse=True)
        return TileFaces(parts_of(vertices[used], tile), numbers.reshape(-1, 3))

    def narrowed(self, tile: SpaceTile) -> TileWork:
        """The same with the views alone that may see a tile: what a worker needs of it."""
        ends = self.grid.origin_A + self.grid.step_m * (tile.first + np.array([np.zeros(3), tile.size]))
        return replace(self, state=tuple(one for one in self.state if may_see(one.view, one.H_AC, ends)))

    def distances(self, tile: SpaceTile) -> tuple[Image, Image]:
        """Mean signed distance and weight at every grid point of a tile, in steps."""
        near, size = tile.points(), tile.size
        total, weight = np.zeros(size, np.float32), np.zeros(size, np.float32)
        flat_total, flat_weight = total.reshape(-1), weight.reshape(-1)
        for start in range(0, len(near), AT_ONCE):
            some = near[start : start + AT_ONCE]
            x_A = self.grid.origin_A + self.grid.step_m * (np.stack(np.unravel_index(some, size), axis=1) + tile.first)
            for one in self.state:
                if may_see(one.view, one.H_AC, x_A):
                    at, d, w = _one_view(one, x_A, self.grid.step_m)
                    flat_total[some[at]] += (w * d).astype(np.float32)
                    flat_weight[some[at]] += w.astype(np.float32)
        np.divide(total, weight, out=total, where=weight > 0)
        return total, weight


def _one_view(one: Placed, x_A: Array, step_m: float) -> tuple[Index, Array, Array]:
    """Which points a view says something of, their distance to its surface in steps, and its weight."""
    x_C = se3.apply(se3.inv(one.H_AC), x_A)
    seen = look(one.view, x_C)
    at = np.flatnonzero(seen.ok)
    x_C, n_C = x_C[at], seen.normal_C[at]
    z = seen.depth[at] * np.exp(one.bending.at(one.field, seen.pixel[at], seen.component[at]))
    behind = z / x_C[:, 2] - 1
    along = np.einsum("ij,ij->i", n_C, x_C)
    d = -along * behind / step_m
    gap = behind * np.linalg.norm(x_C, axis=1) / step_m
    column, row = (np.rint(seen.pixel[at, k]).astype(int) for k in range(2))
    w = weight_of(one, row, column, -along / np.linalg.norm(x_C, axis=1))
    through = d > TRUNCATION
    keep = (d > -TRUNCATION) & (gap > -2 * TRUNCATION)
    w = np.where(through, CARVING * w, w)
    return at[keep], np.clip(d, -TRUNCATION, TRUNCATION)[keep], w[keep]


def weight_of(one: Placed, row: Index, column: Index, cosine: Array) -> Array:
    """How much a view's pixels count: by the normal's doubt, the slant and the footprint."""
    sigma = np.maximum(one.view.normal_std_rad[row, column], np.radians(0.5)) * one.view.footprint_m
    return np.asarray((1e-5 * np.maximum(cosine, 0.05) / sigma) ** 2)


def _clean(vertices_A: Array, faces: Index) -> Triangles:
    """Without crumbs, with area-weighted normals."""
    faces = faces[_large(len(vertices_A), faces)]
    used, faces = np.unique(faces, return_inverse=True)
    vertices_A, faces = vertices_A[used], faces.reshape(-1, 3)
    return Triangles(vertices_A, normals_of(vertices_A, faces), faces)


def _large(count: int, faces: Index) -> Mask:
    """Faces of connected parts that are more than a crumb: a hundredth of the largest."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    edges = np.concatenate([faces[:, :2], faces[:, 1:]])
    _, part = connected_components(coo_array((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(count, count)), directed=False)
    size = np.bincount(part[faces[:, 0]], minlength=part.max() + 1)
    return np.asarray(size[part[faces[:, 0]]] >= CRUMB * size.max())


CRUMB = 0.01
"""Least share of the faces of the largest part that a part must have: what is smaller is noise at an outline."""


def normals_of(vertices_A: Array, faces: Index) -> Array:
    """Area-weighted unit normals (V, 3)."""
    a, b, c = (vertices_A[faces[:, k]] for k in range(3))
    flat = np.cross(b - a, c - a)
    found = np.zeros_like(vertices_A)
    for k in range(3):
        for axis in range(3):
            found[:, axis] += np.bincount(faces[:, k], flat[:, axis], len(vertices_A))
    return np.asarray(found / np.maximum(np.linalg.norm(found, axis=1, keepdims=True), 1e-30))


def held_together(faces: Index, loose: Mask) -> tuple[Index, Index]:
    """The vertices that stay, and the faces between them by their new numbers: faces with a loose corner go.

    Raises
    ------
    DegenerateError
        None would stay.
    """
    stays = faces[~loose[faces].any(axis=1)]
    if not len(stays):
        raise DegenerateError(
            "every part is seen by one view alone and its distance is not known",
            where="fuse",
            needed="surfaces that overlap, or distances that are known better",
            todo="take more captures round the object",
        )
    kept, numbers = np.unique(stays, return_inverse=True)
    return kept, numbers.reshape(stays.shape)


def area_of(v: Array, faces: Index) -> float:
    """The area of faces (F, 3) of vertices (V, 3)."""
    a, b, c = (v[faces[:, k]] for k in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def rested(rests: Mask, faces: Index) -> tuple[Index, Index]:
    """The vertices that stay, and the faces between them by their new numbers: a patch that no view puts there goes.

    Between two views that contradict each other, both seen by no third, the volume's zero lies where neither sees a surface. A face with
    two corners at least that a view sees stays, so that no pinholes open where a surface turns sharply.
    """
    stays = faces[rests[faces].sum(axis=1) >= 2]
    kept, numbers = np.unique(stays, return_inverse=True)
    return kept, numbers.reshape(stays.shape)
