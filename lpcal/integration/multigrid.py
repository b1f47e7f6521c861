"""Sparse symmetric positive systems on the pixels of a mask, by conjugate gradients with a multigrid preconditioner.

Unknowns sit on pixels, weights between neighbours; a coarse unknown is the sum of those in 2x2 pixels (aggregation, Galerkin products),
which again are linked to their neighbours alone: the mask's outline and weak links between pixels are known on every level, and no matrix
is ever stored. Sources: Notay 2010, Electronic Transactions on Numerical Analysis 37 (aggregation multigrid); Braess 1995, Computing 55
(over-correction).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.geometry.arrays import Array
from lpcal.geometry.lambert import SINGULAR
from lpcal.kernels.library import kernel
from lpcal.view.sight import Indices

COARSEST = 200
"""Unknowns from which on a level is not made coarser, but solved directly."""
LARGEST = 4 * COARSEST
"""Unknowns of a level that cannot be made coarser, as nothing in it touches, beyond which it is not solved directly."""
SMOOTHING = (1.39, 0.562)
"""Shares of the two Jacobi steps that smooth: reciprocal roots of the polynomial that is least over the matrix's upper eigenvalues, .5 to 2
relative to its diagonal (Chebyshev). Two equal steps of .7 take a sixth more cycles."""
PRECISION, MOST = 1e-8, 1000
"""Relative residual that a solve ends at, and steps of the conjugate gradients at most, which systems of many breaks take. The slope and
the bend of a whole object weigh next to nothing in a residual: one of 1e-4 leaves them to where the solve began, and to rounding."""
OVER_CORRECTION = 1.6
"""Factor of what a coarser level says: sums over pixels see steps between them too steep."""


@dataclass(frozen=True)
class PixelLevel:
    """Pixels of one level, numbered row by row, and their neighbours."""

    a: Indices
    """Left and upper pixels of the edges: those to the right first, then those downwards."""
    b: Indices
    """Their right and lower pixels."""
    to_the_right: int
    """How many edges lead to the right."""
    parent: npt.NDArray[np.int32]
    """Number of each pixel's own on the next coarser level; at the coarsest 0."""

    @property
    def pixels(self) -> int:
        """How many there are."""
        return len(self.parent)

    @cached_property
    def stretches(self) -> npt.NDArray[np.int32]:
        """(N, 4) stretches of pixels side by side, and so those above and below: the first, how many, the first above and the first below.

        Where there are none above or below, the stretch's own first stands for them.
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
        """Weights of the edges (edges,) at the left and at the upper pixel (P,) of each; 0 where there is none."""
        across, down = np.zeros(self.pixels), np.zeros(self.pixels)
        right_of, below = slice(None, self.to_the_right), slice(self.to_the_right, None)
        across[self.a[right_of]], down[self.a[below]] = weight[right_of], weight[below]
        return across, down


@dataclass(frozen=True)
class Pyramid:
    """Pixels, and those that 2x2 of them make, down to COARSEST."""

    levels: tuple[PixelLevel, ...]

    @staticmethod
    def of(rows: Indices, columns: Indices) -> Pyramid:
        """From pixels at rows and columns (P,), in reading order."""
        found: list[PixelLevel] = []
        rows, columns = rows - rows.min(), columns - columns.min()
        while True:
            number = np.full((rows.max() + 1, columns.max() + 1), -1, np.int64)
            number[rows, columns] = np.arange(len(rows))
            half = np.zeros((rows.max() // 2 + 1, columns.max() // 2 + 1), bool)
            half[rows // 2, columns // 2] = True
            coarse = np.nonzero(half)
            last = len(rows) <= COARSEST or len(coarse[0]) == len(rows)
            numbered = np.cumsum(half).reshape(half.shape) - 1
            parent = np.zeros(len(rows), np.int32) if last else numbered[rows // 2, columns // 2].astype(np.int32)
            left, right, upper, lower = number[:, :-1], number[:, 1:], number[:-1], number[1:]
            across, down = (left >= 0) & (right >= 0), (upper >= 0) & (lower >= 0)
            a, b = np.concatenate([left[across], upper[down]]), np.concatenate([right[across], lower[down]])
            found.append(PixelLevel(a, b, int(across.sum()), parent))
            if last:
                return Pyramid(tuple(found))
            rows, columns = coarse

    @cached_property
    def laid_out(self) -> tuple[Indices, npt.NDArray[np.int32], npt.NDArray[np.int32], int]:
        """The levels one behind the other: sizes, parents, stretches, and how far apart neighbours of the coarsest are numbered."""
        levels, last = self.levels, self.levels[-1]
        sizes = np.array([(one.pixels, len(one.stretches)) for one in levels], np.int64)
        parents, stretches = (np.concatenate([getattr(one, name) for one in levels]) for name in ("parent", "stretches"))
        return sizes, parents, stretches, int(np.max(last.b - last.a, initial=0)) if last.pixels <= LARGEST else -1

    def work_space(self, more: int = 0) -> tuple[Array, npt.NDArray[np.float32]]:
        """Zeros in which the kernels solve a matrix, and `more` times the pixels plus two of them."""
        sizes, *_, band = self.laid_out
        work = np.zeros((8 + more) * (sizes[0, 0] + 2) + (max(band, 0) + 2) * sizes[-1, 0])
        return work, np.zeros(9 * np.sum(sizes[:, 0] + 2), np.float32)


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
        """As a matrix of scipy in compressed rows."""
        from scipy import sparse

        a, b = self.pyramid.levels[0].a, self.pyramid.levels[0].b
        count, every = len(self.hold), np.arange(len(self.hold))
        diagonal = self.hold + np.bincount(a, self.weight, count) + np.bincount(b, self.weight, count)
        places = (np.concatenate([every, a, b]), np.concatenate([every, b, a]))
        return sparse.csr_array((np.concatenate([diagonal, -self.weight, -self.weight]), places), shape=(count, count))


def solve(A: Matrix, right: Array, start: Array, *, precision: float = PRECISION, most: int = MOST) -> Array:
    """x (P,) with ``A x = right``, from `start`, to a residual of `precision` times that of the start's mean everywhere."""
    enough = precision * float(np.linalg.norm(right - start.mean() * A.hold) + 1e-300)
    if run := kernel("multigrid"):
        sizes, parents, stretches, band = A.pyramid.laid_out
        across, down = A.pyramid.levels[0].by_pixel(A.weight)
        x, work, singles = np.array(start, float), *A.pyramid.work_space()
        given = (np.ascontiguousarray(one, float) for one in (A.hold, across, down, right))
        run(len(sizes), sizes, parents, stretches, *given, x, work, singles, band, enough, most, *SMOOTHING, OVER_CORRECTION, SINGULAR)
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
    """Matrix, inverse of its diagonal and prolongation from the next coarser level, of each; None is the coarsest's prolongation."""
    from scipy import sparse

    levels, now = [], A.sparse()
    for fine, coarse in zip(A.pyramid.levels, A.pyramid.levels[1:], strict=False):
        P = sparse.csr_array((np.ones(fine.pixels), (np.arange(fine.pixels), fine.parent)), shape=(fine.pixels, coarse.pixels))
        levels.append((now, 1 / now.diagonal(), P))
        now = (P.T @ (now @ P)).tocsr()
    return [*levels, (now, 1 / now.diagonal(), None)]


def _factor(A: Any) -> Any:
    """The Cholesky factor of a small matrix; None where it is singular to rounding."""
    from scipy import linalg

    dense = A.toarray()
    dense[np.diag_indices_from(dense)] *= 1 + SINGULAR  # rounding leaves it positive
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
