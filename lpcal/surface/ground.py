"""What a capture in coarse pixels says about each pixel in full size: where it lies, what light reaches it, what it is part of."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.integration.pieces import BREAK_WEIGHT
from lpcal.shading.normals import interreflected_share
from lpcal.surface import normal_prior, rounds
from lpcal.surface.rounds import Scene, State
from lpcal.view.constants import LEAST_COSINE
from lpcal.view.pixel_list import Illumination, Indices


@dataclass(frozen=True)
class Ground:
    """Maps (h, w) of coarse pixels, filled beyond the object from what is nearest."""

    factor: int
    rays_C: Array
    u: Array
    """log depth; without a camera depth in coarse pixels."""
    n: Array
    """(h, w, 3)."""
    interreflected: Image | None
    """(h, w, L, 3) light vectors of what surfaces throw there."""
    unseen: Image | None
    share: Image
    """Light that is reflected there, as a share of the direct light."""
    hidden: Mask | None
    """(h, w, L) which lights the surface hides."""
    loose: Mask
    """Where the surface breaks, or next to it: there the coarse depth does not hold the fine one."""
    turn: Image | None
    """(h, w, 4) what is added to normals for what is expected of them (surface.normal_prior), and their standard deviation, radians.

    None where they are not asked.
    """
    nearest: Indices
    """(2, h, w) row and column of the nearest pixel of the object."""

    @staticmethod
    def of(scene: Scene, state: State, rays_C: Array, normals_C: Image, factor: int) -> Ground:
        """From a solved scene in coarse pixels, the normals (h, w, 3) as they came out."""
        mask = scene.seen.mask
        nearest = np.stack(np.divmod(raster.nearest(mask), mask.shape[1]))

        def filled(values: npt.NDArray[np.generic]) -> npt.NDArray[np.generic]:
            whole = np.zeros((*mask.shape, *values.shape[1:]), values.dtype)
            whole[mask] = values
            return whole[tuple(nearest)]

        lit, hidden = state.lit, None
        if scene.near:
            hidden = np.asarray(filled(rounds.hidden_lights(scene, np.exp(state.u), state, Illumination(lit.d, lit.E))[1].T), bool)
        interreflected = (
            None if lit.interreflected is None else np.asarray(filled(np.moveaxis(lit.interreflected, 0, 1).astype(np.float32)), np.float32)
        )
        unseen = None if lit.unseen is None else np.asarray(filled(lit.unseen.astype(np.float32)), np.float32)
        broken = state.weight <= BREAK_WEIGHT
        at = np.zeros(scene.seen.pixels, bool)
        at[scene.grid.a[broken]] = at[scene.grid.b[broken]] = True
        loose = raster.dilated(np.asarray(scene.seen.map(at, 0), bool))
        share = np.asarray(filled(interreflected_share(lit, state.found).astype(np.float32)), np.float32)
        other, sigma_rad = normal_prior.turned(scene, state)
        turn = None
        if sigma_rad is not None:
            turn = np.asarray(filled(np.column_stack([other.normals - state.normals, sigma_rad]).astype(np.float32)), np.float32)
        u, n = np.asarray(filled(other.u)), np.asarray(filled(normals_C[mask].astype(float)))
        return Ground(factor, rays_C[tuple(nearest)], u, n, interreflected, unseen, share, hidden, np.asarray(loose), turn, nearest)

    def place(self, rows: slice, columns: slice) -> tuple[Indices, Indices]:
        """Rows (h,) and columns (w,) of the coarse pixels that pixels in full size lie in."""
        found = (np.arange(some.start, some.stop) // self.factor for some in (rows, columns))
        row, column = (np.minimum(at, most - 1) for at, most in zip(found, self.u.shape, strict=True))
        return row, column

    def at[T: np.generic](self, values: npt.NDArray[T], rows: slice, columns: slice) -> npt.NDArray[T]:
        """Values (h, w, ...) of the object's nearest coarse pixel, at pixels in full size."""
        return values[tuple(self.nearest[:, *np.ix_(*self.place(rows, columns))])]

    def between(self, values: Image | Array, rows: slice, columns: slice) -> Image:
        """Values (h, w, ...), linear between the coarse pixels, at pixels in full size."""
        return between(values, self.factor, rows, columns)

    def front(self, rows: slice, columns: slice, rays_C: Array) -> Array:
        """u (h, w) of pixels in full size with their rays (h, w, 3), each coarse pixel taken for a flat piece of its normal.

        Without a camera u is in pixels of full size.
        """
        n, u = self.at(self.n, rows, columns), self.at(self.u, rows, columns)
        if self.rays_C[..., :2].any():
            there = self.at(self.rays_C, rows, columns)
            towards = (np.minimum(np.einsum("hwi,hwi->hw", n, ray), -LEAST_COSINE) for ray in (there, rays_C))
            first, last = towards
            return np.asarray(u + np.log(first / last))
        row, column = np.meshgrid(np.arange(rows.start, rows.stop), np.arange(columns.start, columns.stop), indexing="ij")
        middle = self.factor * self.nearest[:, *np.ix_(*self.place(rows, columns))] + (self.factor - 1) / 2
        slope = np.minimum(n[..., 2], -LEAST_COSINE)
        return np.asarray(self.factor * u - (n[..., 0] * (column - middle[1]) + n[..., 1] * (row - middle[0])) / slope)


def between(values: Image | Array, factor: int, rows: slice, columns: slice) -> Image:
    """Values (h, w, ...) of coarse pixels of `factor` pixels a side, linear between them, at pixels in full size."""
    found = np.asarray(values)
    for axis, some in enumerate((rows, columns)):
        t = np.clip((np.arange(some.start, some.stop) - (factor - 1) / 2) / factor, 0, values.shape[axis] - 1)
        first, last = int(t[0]), min(int(t[-1]) + 2, values.shape[axis])
        found = found.take(np.arange(first, last), axis)  # no more than is needed
        low = np.minimum(t.astype(int) - first, max(found.shape[axis] - 2, 0))
        share = (t - first - low).reshape(-1, *[1] * (found.ndim - axis - 1)).astype(np.float32)
        found = found.take(low, axis) * (1 - share) + found.take(np.minimum(low + 1, found.shape[axis] - 1), axis) * share
    return np.asarray(found)
