"""The solution of a capture in coarse pixels, interpolated to pixels in full size: depth, normals, indirect light, occlusion, breaks."""

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
class CoarseSolution:
    """Maps (h, w) of coarse pixels, extended beyond the object by nearest neighbours."""

    factor: int
    """Side of a coarse pixel, pixels in full size."""
    rays_C: Array
    u: Array
    """log depth; without a camera depth in coarse pixels."""
    n: Array
    """(h, w, 3)."""
    interreflected: Image | None
    """(h, w, L, 3) light vectors of the interreflected light; None where it was not solved for."""
    unseen: Image | None
    """Share of the light that comes from sides the camera does not see (shading.Illumination.unseen)."""
    share: Image
    """Interreflected light, as a share of the direct light."""
    hidden: Mask | None
    """(h, w, L) which lights the surface occludes; None where lights are distant."""
    near_break: Mask
    """Coarse pixels at a depth discontinuity or next to one, where the fine depth is not tied to the coarse one."""
    correction: Image | None
    """(h, w, 4) correction of the normals by their prior (surface.normal_prior), and its standard deviation, radians; None without it."""
    nearest: Indices
    """(2, h, w) row and column of the nearest pixel of the object."""

    @staticmethod
    def of(scene: Scene, state: State, rays_C: Array, normals_C: Image, factor: int) -> CoarseSolution:
        """From a scene and its state in coarse pixels, and the normals (h, w, 3) of the coarse surface."""
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
        near_break = raster.dilated(np.asarray(scene.seen.map(at, 0), bool))
        share = np.asarray(filled(interreflected_share(lit, state.found).astype(np.float32)), np.float32)
        other, sigma_rad = normal_prior.turned(scene, state)
        correction = None
        if sigma_rad is not None:
            correction = np.asarray(filled(np.column_stack([other.normals - state.normals, sigma_rad]).astype(np.float32)), np.float32)
        u, n = np.asarray(filled(other.u)), np.asarray(filled(normals_C[mask].astype(float)))
        return CoarseSolution(
            factor, rays_C[tuple(nearest)], u, n, interreflected, unseen, share, hidden, np.asarray(near_break), correction, nearest
        )

    def place(self, rows: slice, columns: slice) -> tuple[Indices, Indices]:
        """Rows (h,) and columns (w,) of the coarse pixels that pixels in full size lie in."""
        found = (np.arange(some.start, some.stop) // self.factor for some in (rows, columns))
        row, column = (np.minimum(at, most - 1) for at, most in zip(found, self.u.shape, strict=True))
        return row, column

    def at[T: np.generic](self, values: npt.NDArray[T], rows: slice, columns: slice) -> npt.NDArray[T]:
        """Values (h, w, ...) at pixels in full size, those of the object's nearest coarse pixel."""
        return values[tuple(self.nearest[:, *np.ix_(*self.place(rows, columns))])]

    def between(self, values: Image | Array, rows: slice, columns: slice) -> Image:
        """Values (h, w, ...) at pixels in full size, interpolated linearly between the coarse pixels."""
        return between(values, self.factor, rows, columns)

    def starting_depth(self, rows: slice, columns: slice, rays_C: Array) -> Array:
        """Starting depth u (h, w) of pixels in full size with rays (h, w, 3): each coarse pixel is a plane with its depth and normal.

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
    """Values (h, w, ...) at pixels in full size, interpolated linearly between coarse pixels of `factor` pixels a side."""
    found = np.asarray(values)
    for axis, some in enumerate((rows, columns)):
        t = np.clip((np.arange(some.start, some.stop) - (factor - 1) / 2) / factor, 0, values.shape[axis] - 1)
        first, last = int(t[0]), min(int(t[-1]) + 2, values.shape[axis])
        found = found.take(np.arange(first, last), axis)  # no more than is needed
        low = np.minimum(t.astype(int) - first, max(found.shape[axis] - 2, 0))
        share = (t - first - low).reshape(-1, *[1] * (found.ndim - axis - 1)).astype(np.float32)
        found = found.take(low, axis) * (1 - share) + found.take(np.minimum(low + 1, found.shape[axis] - 1), axis) * share
    return np.asarray(found)
