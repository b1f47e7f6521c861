"""A mesh of a surface's pixels, cut where it breaks.

A corner of each 2x2 pixels makes a triangle when its two legs do not break; the square takes the diagonal whose depths differ less.
Winding is such that a face looks at the camera.

The mesh of a large picture takes several times the memory of its maps: `MeshBands` gives it band by band, as often as it is asked.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.shown import Shown
from lpcal.records.surface import Surface
from lpcal.view import parallel
from lpcal.view.crop import Crop

DISPLAY_GAMMA = 2.2
"""Exponent between display numbers and light: sRGB's curve within two of 255 steps, but for the darkest."""
CORNERS = (((0, 0), (1, 0), (1, 1)), ((0, 0), (1, 1), (0, 1)), ((0, 0), (1, 0), (0, 1)), ((0, 1), (1, 0), (1, 1)))
"""Rows and columns, in a square of 2x2 pixels, of the corners of the four triangles that it may be cut into: lower left, upper right,
upper left, lower right."""

type Faces = npt.NDArray[np.int32]
"""(F, 3) numbers of vertices."""


@dataclass(frozen=True, repr=False)
class Mesh(Shown):
    """Vertices in C; metres, or pixels without a camera."""

    vertices_C: Image
    """(V, 3)."""
    normals_C: Image
    """(V, 3) the measured ones."""
    colours: npt.NDArray[np.uint8]
    """(V, 3) albedo, display-encoded."""
    faces: Faces
    """(F, 3)."""
    pixels: npt.NDArray[np.int32] = field(default_factory=lambda: np.zeros((0, 2), np.int32))
    """(V, 2) column and row of each vertex."""


@dataclass(frozen=True)
class MeshBands:
    """The mesh of a surface, in bands of rows: what each method gives, one after the other, is what `Mesh` holds."""

    surface: Surface
    """Its maps within the box (h, w) about its mask."""
    box: Crop
    number: npt.NDArray[np.int32]
    """(h, w) which vertex a pixel is; -1: none."""
    vertices: int
    """How many there are."""
    triangles: tuple[int, ...]
    """How many of each kind of CORNERS there are."""

    @staticmethod
    def of(surface: Surface) -> MeshBands:
        """Number the pixels that a triangle uses, in reading order; a surface that states no breaks is cut where its mask ends."""
        box = Crop.about(surface.mask)
        surface = box.surface(surface)
        if not surface.breaks.size:
            surface = replace(surface, breaks=ends_of(surface.mask))
        used, counts = np.zeros(surface.mask.shape, bool), np.zeros(len(CORNERS), int)
        for rows in parallel.bands(*_squares(surface)):
            for kind in range(len(CORNERS)):
                kept = _kept(surface, rows, kind)
                counts[kind] += np.count_nonzero(kept)
                for corner in CORNERS[kind]:
                    _corner(used, rows, corner)[...] |= kept
        number = np.full(used.shape, -1, np.int32)
        vertices = int(np.count_nonzero(used))
        number[used] = np.arange(vertices, dtype=np.int32)
        return MeshBands(surface, box, number, vertices, tuple(counts.tolist()))

    def points_C(self) -> Iterator[Image]:
        """Vertices (V, 3)."""
        first, shape = (self.box.rows.start, self.box.columns.start), self.box.shape
        for rows, used in self._used():
            yield _points(self.surface, rows, first, shape)[used].astype(np.float32)

    def normals_C(self) -> Iterator[Image]:
        """Their measured normals (V, 3)."""
        for rows, used in self._used():
            yield self.surface.normals[rows][used].astype(np.float32)

    def colours(self) -> Iterator[npt.NDArray[np.uint8]]:
        """Their albedo (V, 3), display-encoded."""
        white = _white(self.surface)
        for rows, used in self._used():
            yield _displayed(self.surface.albedo[rows], white)[used]

    def pixels(self) -> Iterator[npt.NDArray[np.int32]]:
        """Their columns and rows (V, 2)."""
        for rows, used in self._used():
            first = np.array([self.box.columns.start, self.box.rows.start + rows.start])
            yield (np.argwhere(used)[:, ::-1] + first).astype(np.int32)

    def faces(self) -> Iterator[Faces]:
        """Triangles (F, 3), kind by kind."""
        for kind, corners in enumerate(CORNERS):
            for rows in parallel.bands(*_squares(self.surface)):
                kept = _kept(self.surface, rows, kind)
                yield np.stack([_corner(self.number, rows, corner)[kept] for corner in corners], axis=1)

    def _used(self) -> Iterator[tuple[slice, Mask]]:
        """Bands of rows, and which pixels (h, W) of them are vertices."""
        for rows in parallel.bands(*self.number.shape):
            yield rows, self.number[rows] >= 0


def build(surface: Surface) -> Mesh:
    """The mesh of a surface."""
    made = MeshBands.of(surface)
    return Mesh(
        vertices_C=_filled(made.points_C(), made.vertices, np.float32),
        normals_C=_filled(made.normals_C(), made.vertices, np.float32),
        colours=_filled(made.colours(), made.vertices, np.uint8),
        faces=_filled(made.faces(), sum(made.triangles), np.int32),
        pixels=_filled(made.pixels(), made.vertices, np.int32, 2),
    )


def points_C(surface: Surface) -> Array:
    """Points (H, W, 3); without a camera x and y are pixels from the middle of the image."""
    return _points(surface, slice(0, surface.mask.shape[0]), (0, 0), surface.mask.shape)


def colours(surface: Surface) -> npt.NDArray[np.uint8]:
    """Albedo (H, W, 3) as 8 bit display numbers (sRGB's gamma), its 99th percentile at nine tenths."""
    return _displayed(surface.albedo, _white(surface))


def ends_of(mask: Mask) -> Mask:
    """Where (2, H, W) a mask (H, W) ends towards the right [0] and below [1]: the breaks of a surface that states none."""
    ends = np.ones((2, *mask.shape), bool)
    ends[0, :, :-1], ends[1, :-1] = ~(mask[:, :-1] & mask[:, 1:]), ~(mask[:-1] & mask[1:])
    return ends


def _points(surface: Surface, rows: slice, first: tuple[int, int], shape: tuple[int, ...]) -> Array:
    """Points (h, W, 3) of some rows of a surface whose first pixel is that of row and column `first` in a picture of a shape (H, W)."""
    depth = surface.depth[rows].astype(float)
    if not surface.metric:
        row, column = np.indices(depth.shape, dtype=float)
        return np.stack([column + first[1] - (shape[1] - 1) / 2, row + rows.start + first[0] - (shape[0] - 1) / 2, depth], axis=-1)
    return surface.rays_C[rows].astype(float) * depth[..., None]


def _white(surface: Surface) -> float:
    """The albedo's 99th percentile."""
    albedo = surface.albedo[surface.mask]
    known = np.isfinite(albedo)
    inside = albedo[known if known.ndim == 1 else known.all(axis=1)]
    return float(np.percentile(inside, 99)) if inside.size else 1.0


def _displayed(albedo: Image, white: float) -> npt.NDArray[np.uint8]:
    """Albedo (h, W[, 3]) as display numbers (h, W, 3)."""
    linear = np.clip(np.nan_to_num(albedo) / max(white, 1e-12) * 0.9, 0, 1)
    shown = np.asarray(np.rint(255 * linear ** (1 / DISPLAY_GAMMA)), np.uint8)
    return shown if shown.ndim == 3 else np.repeat(shown[..., None], 3, axis=2)


def _squares(surface: Surface) -> tuple[int, int]:
    """Rows and columns of squares of 2x2 pixels."""
    rows, columns = surface.mask.shape
    return max(rows - 1, 0), max(columns - 1, 0)


def _corner[T: np.generic](values: npt.NDArray[T], rows: slice, corner: tuple[int, int]) -> npt.NDArray[T]:
    """Values (h, W - 1) at one corner of each square in some rows of squares."""
    down, right = corner
    return values[rows.start + down : rows.stop + down, right : values.shape[1] - 1 + right]


def _kept(surface: Surface, rows: slice, kind: int) -> Mask:
    """Whether each square (h, W - 1) in some rows of squares has a triangle of a kind of CORNERS."""
    wide = slice(rows.start, rows.stop + 1)
    depth, breaks = surface.depth[wide], surface.breaks[:, wide]
    inside = surface.mask[wide] & np.isfinite(depth)
    top, bottom = ~breaks[0, :-1, :-1], ~breaks[0, 1:, :-1]
    left, right = ~breaks[1, :-1, :-1], ~breaks[1, :-1, 1:]
    z = np.nan_to_num(depth)
    falling = np.abs(z[:-1, :-1] - z[1:, 1:]) <= np.abs(z[:-1, 1:] - z[1:, :-1])  # whether the diagonal to the lower right is flatter
    lone = top.astype(np.uint8) + bottom + left + right == 2
    legs = ((left, bottom), (top, right), (top, left), (right, bottom))[kind]
    kept = legs[0] & legs[1] & (lone | (falling if kind < 2 else ~falling))  # the first two share that diagonal
    for corner in CORNERS[kind]:
        kept &= _corner(inside, slice(0, len(kept)), corner)
    return np.asarray(kept)


def _filled[T: np.generic](parts: Iterable[npt.NDArray[T]], count: int, kind: type[T], columns: int = 3) -> npt.NDArray[T]:
    """Parts (n, columns), one after the other."""
    found, first = np.empty((count, columns), kind), 0
    for part in parts:
        found[first : first + len(part)] = part
        first += len(part)
    return found
