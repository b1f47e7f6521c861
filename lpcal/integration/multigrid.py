"""Sparse symmetric positive definite systems on a mask's pixels: conjugate gradients with an aggregation multigrid preconditioner.

Unknowns are at pixels, weights on edges between neighbours. A coarse unknown aggregates strongly coupled unknowns within 2x2 pixels
(Galerkin products) and is again coupled to its neighbours only, so every level respects the mask's outline and the breaks. Aggregates
across breaks would couple two depths: with them 200 to 350 cycles were needed where these take 35. Sources: Notay 2010, Electronic
Transactions on Numerical Analysis 37 (aggregation multigrid); Stüben 2001, J. Computational and Applied Mathematics 128 (strength of
coupling); Braess 1995, Computing 55 (over-correction).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.geometry.arrays import Array
from lpcal.geometry.lambert import SINGULAR
from lpcal.kernels.library import LINKS, kernel
from lpcal.view.pixel_list import Indices

COARSEST = 200
"""Number of unknowns up to which a level is solved directly and not coarsened."""
LARGEST = 4 * COARSEST
"""Number of unknowns up to which a level that cannot be coarsened (no edges) is solved directly."""
FEWEST = COARSEST // 12
"""Number of coarse pixels below which no coarser level is made: each may contain several unknowns separated by breaks."""
STRONG = 0.2
"""Strength threshold: least weight of an edge within an aggregate, as a share of the largest weight at either end; .06 takes a tenth more
cycles."""
SMOOTHING = (1.39, 0.562)
"""Damping factors of the two Jacobi smoothing steps: Chebyshev's for the upper eigenvalues, .5 to 2 relative to the diagonal. Two equal
steps of .7 take a sixth more cycles."""
PRECISION = 1e-8
"""Relative residual at which a solve ends. Slope and curvature of a whole object contribute almost nothing to a residual: at 1e-4 they
would depend on the initial value and on rounding."""
MOST = 5 * COARSEST
"""Largest number of conjugate gradient steps; captures take 12 to 60, and the field of normals (shading.field), which has no coarser
levels, hundreds."""
OVER_CORRECTION = 1.6
"""Factor of the coarse-grid correction: with piecewise constant prolongation the coarse level overestimates slopes (Braess)."""


@dataclass(frozen=True)
class PixelLevel:
    """Pixels of one level, numbered row by row, and their edges."""

    a: Indices
    """Left and upper pixels of the edges: those to the right first, then those downwards."""
    b: Indices
    """Their right and lower pixels."""
    to_the_right: int
    """Number of edges to the right."""
    cell: npt.NDArray[np.int32]
    """(P,) index on the next level of the coarse pixel that contains each pixel; 0 on the coarsest."""

    @property
    def pixels(self) -> int:
        """Number of pixels."""
        return len(self.cell)

    @cached_property
    def stretches(self) -> npt.NDArray[np.int32]:
        """(N, 4) runs of consecutive pixels whose upper and lower neighbours are consecutive too: first, count, first above, first below.

        Where there are none above or below, the run's own first pixel is given instead.
        """
        every = np.arange(self.pixels)
        linked = np.zeros(self.pixels, bool)
        linked[self.a[: self.to_the_right]] = True
        above, below = every.copy(), every.copy()
        upper, lower = self.a[self.to_the_right :], self.b[self.to_the_right :]
        above[lower], below[upper] = upper, lower
        one_row = np.diff(every - above, prepend=-1) == 0
        one_row &= np.diff(below - every, prepend=-1) == 0
        first = np.flatnonzero(~(one_row & np.r_[False, linked[:-1]]))
        return np.stack([first, np.diff(np.r_[first, self.pixels]), above[first], below[first]], axis=1).astype(np.int32)

    def by_pixel(self, weight: Array) -> tuple[Array, Array]:
        """Edge weights (edges,) stored at each edge's left or upper pixel, (P,) each; 0 where there is no edge."""
        across, down = np.zeros(self.pixels), np.zeros(self.pixels)
        right_of, below = slice(None, self.to_the_right), slice(self.to_the_right, None)
        across[self.a[right_of]], down[self.a[below]] = weight[right_of], weight[below]
        return across, down


@dataclass(frozen=True)
class Pyramid:
    """The hierarchy of pixels, each level joining 2x2 of the finer one, down to COARSEST, or FEWEST where there are several levels."""

    levels: tuple[PixelLevel, ...]

    @staticmethod
    def of(rows: Indices, columns: Indices) -> Pyramid:
        """The pyramid of pixels at rows and columns (P,), sorted row by row."""
        found: list[PixelLevel] = []
        rows, columns = rows - rows.min(), columns - columns.min()
        while True:
            number = np.full((rows.max() + 1, columns.max() + 1), -1, np.int64)
            number[rows, columns] = np.arange(len(rows))
            half = np.zeros((rows.max() // 2 + 1, columns.max() // 2 + 1), bool)
            half[rows // 2, columns // 2] = True
            coarse = np.nonzero(half)
            last = len(rows) <= (FEWEST if found else COARSEST) or len(coarse[0]) == len(rows)
            numbered = np.cumsum(half).reshape(half.shape) - 1
            cell = np.zeros(len(rows), np.int32) if last else numbered[rows // 2, columns // 2].astype(np.int32)
            left, right, upper, lower = number[:, :-1], number[:, 1:], number[:-1], number[1:]
            across, down = (left >= 0) & (right >= 0), (upper >= 0) & (lower >= 0)
            a, b = np.concatenate([left[across], upper[down]]), np.concatenate([right[across], lower[down]])
            found.append(PixelLevel(a, b, int(across.sum()), cell))
            if last:
                return Pyramid(tuple(found))
            rows, columns = coarse

    @cached_property
    def laid_out(self) -> tuple[Indices, npt.NDArray[np.int32], npt.NDArray[np.int32]]:
        """All levels concatenated, for the kernels: sizes, cells, runs."""
        sizes = np.array([(one.pixels, len(one.stretches)) for one in self.levels], np.int64)
        cells, stretches = (np.concatenate([getattr(one, name) for one in self.levels]) for name in ("cell", "stretches"))
        return sizes, cells, stretches

    @cached_property
    def room(self) -> int:
        """Capacity for unknowns beyond the coarse pixels that the kernels reserve on each level."""
        return self.levels[1].pixels if len(self.levels) > 1 else 0

    @cached_property
    def way(self) -> Array:
        """The solver's parameters for the kernels (7,)."""
        largest = min(LARGEST, self.levels[0].pixels + self.room)
        return np.array([*SMOOTHING, OVER_CORRECTION, STRONG, SINGULAR, COARSEST, largest])

    def work_space(self, more: int = 0) -> tuple[Array, npt.NDArray[np.float32], npt.NDArray[np.int32]]:
        """Work arrays of the kernels, with `more` times (pixels + 2) extra; untouched pages cost no memory."""
        pixels, coarser, largest = self.levels[0].pixels, len(self.levels) - 1, int(self.way[-1])
        parts = sum(one.pixels for one in self.levels) + coarser * self.room
        doubles = (8 + more) * (pixels + 2) + largest + largest * (largest + 1) // 2
        whole = parts + coarser + 1 + (1 + 3 * LINKS) * coarser * self.room + 3 * largest + 1 + 3 * (pixels + self.room)
        table = 4 * LINKS * self.room
        return np.empty(doubles), np.empty(9 * (parts + 2 * coarser + 2), np.float32), np.empty(whole + table, np.int32)


@dataclass(frozen=True)
class Matrix:
    """A symmetric positive matrix on pixels: ``sum hold x^2 + sum_ab weight (x_a - x_b)^2 = x . A x``."""

    pyramid: Pyramid
    hold: Array
    """(P,)."""
    weight: Array
    """(edges,)."""

    def times(self, x: Array) -> Array:
        """A x (P,)."""
        finest = self.pyramid.levels[0]
        flow = self.weight * (x[finest.a] - x[finest.b])
        return np.asarray(self.hold * x + np.bincount(finest.a, flow, len(x)) - np.bincount(finest.b, flow, len(x)))

    def sparse(self) -> Any:
        """The matrix in scipy's CSR format."""
        from scipy import sparse

        a, b = self.pyramid.levels[0].a, self.pyramid.levels[0].b
        count, every = len(self.hold), np.arange(len(self.hold))
        diagonal = self.hold + np.bincount(a, self.weight, count) + np.bincount(b, self.weight, count)
        places = (np.concatenate([every, a, b]), np.concatenate([every, b, a]))
        return sparse.csr_array((np.concatenate([diagonal, -self.weight, -self.weight]), places), shape=(count, count))


def solve(A: Matrix, right: Array, start: Array, *, precision: float = PRECISION, most: int = MOST) -> Array:
    """Solve ``A x = right`` for x (P,) from `start`, to `precision` times the residual of a constant, the mean of `start`."""
    enough = precision * float(np.linalg.norm(right - start.mean() * A.hold) + 1e-300)
    if run := kernel("multigrid"):
        sizes, cells, stretches = A.pyramid.laid_out
        across, down = A.pyramid.levels[0].by_pixel(A.weight)
        x, given = np.array(start, float), (np.ascontiguousarray(one, float) for one in (A.hold, across, down, right))
        run(len(sizes), sizes, cells, stretches, *given, x, *A.pyramid.work_space(), enough, most, A.pyramid.way)
        return x
    levels = _levels(A)
    coarsest = _factor(levels[-1][0]) if levels[-1][0].shape[0] <= LARGEST else None
    x = start.copy()
    residual = right - levels[0][0] @ x
    direction, before = np.zeros_like(x), 1.0
    for step in range(most):
        if np.linalg.norm(residual) <= enough:
            break
        z = _cycle(levels, 0, residual, coarsest)
        now = float(residual @ z)
        direction = z + (now / before if step else 0.0) * direction
        image = levels[0][0] @ direction
        length = now / float(direction @ image)
        x += length * direction
        residual -= length * image
        before = now
    return x


def _levels(A: Matrix) -> list[tuple[Any, Array, Any]]:
    """Matrix, inverse diagonal, and prolongation from the next coarser level (None on the coarsest), for each level."""
    from scipy import sparse

    levels, now, home = [], A.sparse(), np.arange(len(A.hold))
    for fine in A.pyramid.levels[:-1]:
        if len(home) <= COARSEST:
            break
        cell = fine.cell[home]
        part, count = _held_together(now, cell)
        P = sparse.csr_array((np.ones(len(home)), (np.arange(len(home)), part)), shape=(len(home), count))
        levels.append((now, 1 / now.diagonal(), P))
        now = (P.T @ (now @ P)).tocsr()
        home = np.zeros(count, np.int64)
        home[part] = cell
    return [*levels, (now, 1 / now.diagonal(), None)]


def _held_together(A: Any, cell: npt.NDArray[np.int32]) -> tuple[npt.NDArray[np.int32], int]:
    """Index of each unknown's aggregate, and their number: the components of strong edges within a cell."""
    from scipy import sparse
    from scipy.sparse.csgraph import connected_components

    edges = A.tocoo()
    off = edges.row != edges.col
    a, b, weight = edges.row[off], edges.col[off], -edges.data[off]
    most = np.zeros(len(cell))
    np.maximum.at(most, a, weight)
    within = (cell[a] == cell[b]) & (weight > 0)
    strong = within & (weight >= STRONG * np.maximum(most[a], most[b]))
    _, part = connected_components(sparse.coo_array((weight[strong], (a[strong], b[strong])), shape=A.shape), directed=False)
    lone = (np.bincount(part) == 1)[part]
    strong |= within & ((lone[a] & (weight >= most[a])) | (lone[b] & (weight >= most[b])))
    count, part = connected_components(sparse.coo_array((weight[strong], (a[strong], b[strong])), shape=A.shape), directed=False)
    return part, int(count)


def _factor(A: Any) -> Any:
    """The Cholesky factor of a small matrix; None if it is singular to rounding."""
    from scipy import linalg

    dense = A.toarray()
    dense[np.diag_indices_from(dense)] *= 1 + SINGULAR  # keeps it positive definite under rounding
    try:
        return linalg.cho_factor(dense, check_finite=False, overwrite_a=True)
    except linalg.LinAlgError:
        return None


def _cycle(levels: list[tuple[Any, Array, Any]], depth: int, right: Array, coarsest: Any) -> Array:
    """One symmetric V-cycle from zero."""
    A, inverse, P = levels[depth]
    if P is None:
        from scipy import linalg

        return np.asarray(linalg.cho_solve(coarsest, right, check_finite=False) if coarsest is not None else inverse * right)
    first, second = SMOOTHING
    x = first * inverse * right
    x = x + second * inverse * (right - A @ x)
    x = x + OVER_CORRECTION * (P @ _cycle(levels, depth + 1, P.T @ (right - A @ x), coarsest))
    x = x + second * inverse * (right - A @ x)
    return np.asarray(x + first * inverse * (right - A @ x))
