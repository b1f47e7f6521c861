"""A scene binned into blocks of pixels, and the prolongation of its solution back to the pixels (a two-level scheme).

What the rounds determine jointly from many pixels (distance, occlusion, gloss and interreflection) is the same in blocks and takes
a quarter of the time. Normals, albedo and steps of each pixel are then found at full size.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array
from lpcal.integration.integrate import Grid, Own
from lpcal.shading.normals import Estimate
from lpcal.view import parallel
from lpcal.view.constants import LEAST_COSINE, REGULARISATION
from lpcal.view.pixel_list import Illumination, Indices, PixelList

PIXELS = 8000
"""Approximate number of blocks of an object: enough for distance and gloss, and for 2000 patches of interreflection."""


@dataclass(frozen=True)
class Blocks:
    """The P pixels of an object in Q blocks."""

    seen: PixelList
    """The pixels, with a mask that is cut to them."""
    grid: Grid
    coarse: PixelList
    """The blocks as pixels, each with the noise of one pixel: their distances have the same weight against the steps as at full size."""
    coarse_grid: Grid
    side: int
    """Pixels of a block along its side."""
    of_pixel: Indices
    """(P,) the block that each pixel lies in."""
    around: Indices
    """(P, 4) the blocks that a value at a pixel is linear between; those outside the object are given no share."""
    share: Array
    """(P, 4), of sum 1."""

    @staticmethod
    def of(seen: PixelList, grid: Grid) -> Blocks | None:
        """The blocks of an object: each holds those of its pixels that are the object's, one at least; None where pixels are few."""
        side = round(np.sqrt(seen.pixels / PIXELS))
        if side < 2:
            return None
        height, width = (-(-length // side) for length in seen.mask.shape)
        row, column = np.nonzero(seen.mask)
        key, of_pixel = np.unique(row // side * width + column // side, return_inverse=True)
        mask = np.zeros(height * width, bool)
        mask[key] = True
        count = np.bincount(of_pixel).astype(float)

        def means(values: npt.NDArray[np.generic]) -> Array:
            """Means (N, Q) of values (N, P)."""
            return np.stack([np.bincount(of_pixel, one) for one in values]) / count

        coarse = PixelList(
            mask.reshape(height, width),
            means(seen.rays_C.T).T.copy(),
            means(seen.signal),
            np.sqrt(means(seen.sigma**2)),
            means(~seen.usable) == 0,
            seen.central,
        )
        number = np.full((height + 2) * (width + 2), -1, np.int64)
        number[(key // width + 1) * (width + 2) + key % width + 1] = np.arange(len(key))
        (low_row, off_row), (low_column, off_column) = (_between(at, side) for at in (row, column))
        corner = (low_row + 1) * (width + 2) + low_column + 1
        around = number[np.stack([corner, corner + 1, corner + width + 2, corner + width + 3], axis=1)]
        share = np.stack(
            [(1 - off_row) * (1 - off_column), (1 - off_row) * off_column, off_row * (1 - off_column), off_row * off_column], axis=1
        )
        share = np.where(around >= 0, share, 0.0)
        share /= share.sum(axis=1, keepdims=True)
        return Blocks(seen, grid, coarse, Grid.of(coarse.mask), side, of_pixel, np.maximum(around, 0), share)

    def means(self, values: Array) -> Array:
        """Means (Q,) of values (P,)."""
        return np.asarray(np.bincount(self.of_pixel, values) / np.bincount(self.of_pixel))

    def between(self, values: Array) -> Array:
        """Values (P, ...) of the pixels, linear between those of the blocks (Q, ...)."""
        found = np.zeros((len(self.of_pixel), *values.shape[1:]))
        for k in range(self.around.shape[1]):
            found += self.share[:, k].reshape(-1, *[1] * (values.ndim - 1)) * values[self.around[:, k]]
        return found

    def front(self, u: Array, n: Array) -> Array:
        """log depth (P,), each block taken for a flat piece: by its u (Q,) and its normal n (Q, 3)."""
        n = n[self.of_pixel]
        here = np.minimum(lambert.dot(n, self.coarse.rays_C[self.of_pixel]), -LEAST_COSINE)
        return np.asarray(u[self.of_pixel] + np.log(here / np.minimum(lambert.dot(n, self.seen.rays_C), -LEAST_COSINE)))

    def edges(self, weight: Array) -> Array:
        """Weights (edges,) of the pixels' edges, by those of the blocks': 1 within a block."""
        first, last = self.of_pixel[self.grid.a], self.of_pixel[self.grid.b]
        count = len(self.coarse.rays_C)
        known = self.coarse_grid.a * count + self.coarse_grid.b
        order = np.argsort(known)
        asked = first * count + last
        place = order[np.minimum(np.searchsorted(known, asked, sorter=order), len(known) - 1)]
        found = np.where(known[place] == asked, weight[place], REGULARISATION) if len(known) else np.full(len(asked), REGULARISATION)
        return np.asarray(np.where(first == last, 1.0, found))

    def lit(self, lights: Illumination, lit: Illumination) -> Illumination:
        """The light at the pixels: of the `lights` there, and of other surfaces linear between that of the blocks."""
        interreflected = None if lit.interreflected is None else np.stack(parallel.run_all(self.between, lit.interreflected))
        unseen = None if lit.unseen is None else self.between(lit.unseen)
        return replace(lights, interreflected=interreflected, unseen=unseen)

    def estimate(self, found: Estimate) -> Estimate:
        """The estimate of each pixel's block from its shading."""
        return found.at(self.of_pixel)

    def own(self, own: Own) -> Own:
        """Each pixel's own distance, that of its block."""
        return Own(own.curvature[self.of_pixel], own.optimum[self.of_pixel])


def _between(at: Indices, side: int) -> tuple[Indices, Array]:
    """The lower of the two blocks of a side (N,) that places (N,) lie between, and how far they are on the way to the next (0..1)."""
    t = (at - (side - 1) / 2) / side
    low = np.floor(t).astype(np.int64)
    return low, t - low
