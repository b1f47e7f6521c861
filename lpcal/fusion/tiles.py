"""Tiles of space in which the grid of a model is computed, and the merging of their triangles into one mesh.

The grid is never held as a whole. Boxes of BOX grid points an edge are computed where a view has a point in them or beside them; a tile is
a cube of boxes and the layer of grid points that it shares with the next tile each way, so that every cell of the grid lies in one tile,
and the vertices on a shared layer are the same in both.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Index, Mask

BOX = 4
"""Edge of a box of grid points that is computed as a whole, in grid steps."""
TILE = 40
"""Edge of a tile in boxes: 160 grid steps, whose 4 million points take 33 MB for distance and weight."""
MOST_BOXES = 1 << 18
"""Most boxes along an axis, so that a box or a vertex has one whole number as its key: a million grid steps."""
FINE = 1 << 10
"""Parts of a step to which the vertices of two tiles agree: marching cubes are of single precision, 1e-5 steps within a tile."""


@dataclass(frozen=True)
class VoxelGrid:
    """Points ``origin + step index``."""

    origin_A: Array
    step_m: float


@dataclass(frozen=True)
class SpaceTile:
    """A part of the grid."""

    first: Index
    """(3,) index of its first grid point."""
    boxes: Index
    """(B, 3) boxes that are computed, counted from its first; those of the next tile's shared layer among them."""
    size: tuple[int, int, int]
    """Grid points each way, the shared layer among them."""

    @classmethod
    def of(cls, at: Index, boxes: Index) -> SpaceTile:
        """The tile at (3,) of the tiles, with the boxes (B, 3) of the grid that it computes."""
        within = boxes - TILE * at
        extent = np.minimum(BOX * (within.max(axis=0) + 1), BOX * TILE + 1)
        return cls(BOX * TILE * at, within, (int(extent[0]), int(extent[1]), int(extent[2])))

    def points(self) -> Index:
        """Flat places, within the tile, of the grid points that are computed."""
        held: Mask = np.zeros(self.boxes.max(axis=0) + 1, bool)
        held[tuple(self.boxes.T)] = True
        for axis in range(3):
            held = np.repeat(held, BOX, axis=axis)
        size = self.size
        return np.flatnonzero(held[: size[0], : size[1], : size[2]])


def tiles_of(points_A: Iterable[Array], grid: VoxelGrid) -> list[SpaceTile]:
    """The tiles of a grid that views' points, (N, 3) of each, lie in or beside, in the order of their places."""
    keys = np.unique(np.concatenate([_keys(np.floor((x - grid.origin_A) / (BOX * grid.step_m)).astype(np.int64)) for x in points_A]))
    around = _keys(np.array(list(np.ndindex(3, 3, 3)), np.int64) - 1)
    keys = np.unique((keys[:, None] + around).ravel())
    boxes = np.stack([keys // MOST_BOXES**2, keys // MOST_BOXES % MOST_BOXES, keys % MOST_BOXES], axis=1)
    found: dict[tuple[int, int, int], list[Index]] = {}
    for back in np.ndindex(2, 2, 2):  # a box in a tile's first layer belongs to the one before it, too
        some = boxes[(boxes % TILE == 0)[:, np.array(back, bool)].all(axis=1)]
        if not len(some):
            continue
        tile, inverse = np.unique(some // TILE - np.array(back), axis=0, return_inverse=True)
        order = np.argsort(inverse.ravel(), kind="stable")
        ends = np.cumsum(np.bincount(inverse.ravel(), minlength=len(tile)))
        for one, part in zip(tile.tolist(), np.split(some[order], ends[:-1]), strict=True):
            at = (one[0], one[1], one[2])
            if back == (0, 0, 0) or at in found:  # one without boxes of its own has no cell
                found.setdefault(at, []).append(part)
    return [SpaceTile.of(np.array(at), np.concatenate(parts)) for at, parts in sorted(found.items())]


def _keys(boxes: Index) -> Index:
    """One whole number a box (N, 3)."""
    return np.asarray(boxes @ np.array([MOST_BOXES**2, MOST_BOXES, 1], np.int64))


@dataclass(frozen=True)
class TileFaces:
    """Triangles of a tile."""

    vertices: Index
    """(V, 3) in parts of a grid step, FINE of them to one, counted from the grid's origin."""
    faces: Index
    """(F, 3)."""


def joined(found: Sequence[TileFaces], grid: VoxelGrid) -> tuple[Array, Index]:
    """Vertices (V, 3) in A and faces (F, 3) of all tiles, those on shared layers once."""
    starts = np.cumsum([0, *(len(part.vertices) for part in found)])
    vertices = np.concatenate([part.vertices for part in found])
    faces = np.concatenate([part.faces + start for part, start in zip(found, starts[:-1], strict=True)])
    order = np.lexsort(vertices.T[::-1])
    new = np.ones(len(vertices), bool)
    new[1:] = (np.diff(vertices[order], axis=0) != 0).any(axis=1)
    number = np.empty(len(vertices), np.intp)
    number[order] = np.cumsum(new) - 1
    faces = number[faces]
    whole = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    return grid.origin_A + grid.step_m / FINE * vertices[order][new], faces[whole]


def parts_of(vertices: Array, tile: SpaceTile) -> Index:
    """Vertices (V, 3) in grid steps, counted from a tile's first point, as parts of a step counted from the grid's origin."""
    return np.asarray(np.rint(FINE * vertices).astype(np.int64) + FINE * tile.first)
