r"""Block normal equations of many views and their sparse Cholesky factorisation: views without overlap share no block.

Symbols: A symmetric and positive definite, in blocks: the first of what all views share, one of each view; L lower triangular::

    A = L L^T,      A x = b  ->  x = L^-T L^-1 b,      r^T A^-1 r = |L^-1 r|^2

Blocks are eliminated in the order of least degree, the shared one last. Of each step the rows that it touches form a dense matrix, its
front; what is left of the front goes to the step that eliminates the next of its blocks. Blocks that touch the same others go in one step,
so where all views overlap the factor is one dense matrix. Source: J. W. H. Liu, The multifrontal method for sparse matrix solution (1992).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from lpcal.geometry.arrays import Array, Index

AT_ONCE = 512
"""Linear forms whose variance is computed at a time, and rows of a front that are worked on: of 5000 parameters they take 20 MB."""


@dataclass(frozen=True)
class BlockMatrix:
    """A symmetric matrix (n, n), of which the blocks on and below the diagonal are held that are not zero."""

    starts: Index
    """(B + 1,) the first row of each block, and n."""
    held: dict[tuple[int, int], Array] = field(default_factory=dict)
    """By block row and block column, row >= column."""

    @property
    def size(self) -> int:
        """n."""
        return int(self.starts[-1])

    def rows(self, block: int) -> Index:
        """The rows of a block."""
        return np.arange(self.starts[block], self.starts[block + 1])

    def add(self, used: Index, part: Array) -> None:
        """Add a symmetric matrix (k, k) to the rows and columns `used` (k,), in rising order."""
        block = np.searchsorted(self.starts, used, side="right") - 1
        ends = [0, *(np.flatnonzero(np.diff(block)) + 1).tolist(), len(used)]
        runs = [slice(a, b) for a, b in pairwise(ends) if b > a]
        for at, first in enumerate(runs):
            for second in runs[: at + 1]:
                i, j = int(block[first.start]), int(block[second.start])
                some = np.ix_(used[first] - self.starts[i], used[second] - self.starts[j])
                self._of(i, j)[some] += part[first, second]

    def _of(self, row: int, column: int) -> Array:
        size = np.diff(self.starts)
        return self.held.setdefault((row, column), np.zeros((int(size[row]), int(size[column]))))

    def dense(self) -> Array:
        """The whole (n, n)."""
        found = np.zeros((self.size, self.size))
        for (i, j), block in self.held.items():
            found[np.ix_(self.rows(i), self.rows(j))] = block
            found[np.ix_(self.rows(j), self.rows(i))] = block.T
        return found


@dataclass(frozen=True)
class Front:
    """A step of the elimination: L of the rows that it eliminates, and what stands below in those that it touches."""

    own: Index
    later: Index
    L: Array
    below: Array
    """(later, own)."""


@dataclass(frozen=True)
class Factor:
    """The Cholesky factor of a matrix in blocks."""

    size: int
    fronts: tuple[Front, ...]

    @classmethod
    def of(cls, matrix: BlockMatrix) -> Factor:
        """Factor it.

        Raises
        ------
        numpy.linalg.LinAlgError
            It is not positive definite.
        """
        from scipy.linalg import cholesky, solve_triangular

        steps = list(elimination(matrix))
        step_of = {block: number for number, (own, _) in enumerate(steps) for block in own}
        waiting: dict[int, list[tuple[Index, Array]]] = {}
        place, fronts = np.zeros(matrix.size, np.intp), []
        columns: dict[int, list[int]] = {}
        for i, j in matrix.held:
            columns.setdefault(j, []).append(i)
            if i != j:
                columns.setdefault(i, []).append(j)
        for number, (own, later) in enumerate(steps):
            index = np.concatenate([matrix.rows(block) for block in (*own, *later)])
            place[index] = np.arange(len(index))
            front = np.zeros((len(index), len(index)), order="F")
            for j in own:
                for i in columns[j]:
                    if step_of[i] >= number:
                        block = matrix.held[i, j] if i >= j else matrix.held[j, i].T
                        front[np.ix_(place[matrix.rows(i)], place[matrix.rows(j)])] = block
            for rows, left in waiting.pop(number, []):
                for first in range(0, len(rows), AT_ONCE):
                    some = slice(first, first + AT_ONCE)
                    front[np.ix_(place[rows[some]], place[rows])] += left[some]
            split = sum(len(matrix.rows(block)) for block in own)
            right, left = front[split:, :split], front[split:, split:]
            L = cholesky(front[:split, :split], lower=True, overwrite_a=not later, check_finite=False)
            below = solve_triangular(L, right.T, lower=True, check_finite=False).T
            fronts.append(Front(index[:split], index[split:], L, below))
            if later:
                for first in range(0, len(left), AT_ONCE):
                    left[first : first + AT_ONCE] -= below[first : first + AT_ONCE] @ below.T
                waiting.setdefault(min(step_of[block] for block in later), []).append((index[split:], left))
        return cls(matrix.size, tuple(fronts))

    def half(self, b: Array) -> Array:
        """L^-1 b of columns (n, k)."""
        from scipy.linalg import solve_triangular

        found = np.array(b, dtype=float)
        for front in self.fronts:
            if found[front.own].any():
                found[front.own] = solve_triangular(front.L, found[front.own], lower=True, check_finite=False)
                found[front.later] -= front.below @ found[front.own]
        return found

    def solve(self, b: Array) -> Array:
        """x (n,) of A x = b."""
        from scipy.linalg import solve_triangular

        found = self.half(b[:, None])
        for front in reversed(self.fronts):
            right = found[front.own] - front.below.T @ found[front.later]
            found[front.own] = solve_triangular(front.L, right, lower=True, trans="T", check_finite=False)
        return np.asarray(found[:, 0])

    def covariance(self, some: Index) -> Array:
        """The part (k, k) of A's inverse at some rows."""
        unit = np.zeros((self.size, len(some)))
        unit[some, np.arange(len(some))] = 1.0
        half = self.half(unit)
        return np.asarray(half.T @ half)

    def variances(self, rows: Sequence[tuple[Index, Array]]) -> Array:
        """Variance (K,) of linear forms of x, each as the rows that it takes, in rising order, and their factors."""
        found = np.zeros(len(rows))
        for first in range(0, len(rows), AT_ONCE):
            some = rows[first : first + AT_ONCE]
            used = np.unique(np.concatenate([taken for taken, _ in some]))
            if len(used) < len(some):  # many forms of few rows: of the vertices that one view alone sees, say
                R = columns_of([(np.searchsorted(used, taken), factors) for taken, factors in some], len(used))
                found[first : first + AT_ONCE] = np.einsum("nk,nk->k", R, self.covariance(used) @ R)
            else:
                found[first : first + AT_ONCE] = (self.half(columns_of(some, self.size)) ** 2).sum(axis=0)
        return found


def columns_of(rows: Sequence[tuple[Index, Array]], size: int) -> Array:
    """Linear forms as the columns (n, K) of a matrix."""
    found = np.zeros((size, len(rows)))
    for k, (used, values) in enumerate(rows):
        found[used, k] = values
    return found


def elimination(matrix: BlockMatrix) -> Iterator[tuple[list[int], list[int]]]:
    """Steps: the blocks that one eliminates, and those that it touches, which are eliminated later; the last ends with the first block.

    Each step takes the block with the fewest rows beside it, and with it those that touch the same.
    """
    size = np.diff(matrix.starts)
    beside: list[set[int]] = [set() for _ in size]
    for i, j in matrix.held:
        if i != j:
            beside[i].add(j)
            beside[j].add(i)
    degree = {block: sum(int(size[other]) for other in beside[block]) for block in range(1, len(size))}
    while degree:
        one = min(degree, key=lambda block: (degree[block], block))
        touched = beside[one]
        alike = [other for other in touched if other and beside[other] | {other} == touched | {one}]
        own, gone = sorted([one, *alike]), {one, *alike}
        later = touched - gone
        if len(gone) == len(degree):
            yield [*own, 0], []
            return
        yield own, sorted(later)
        for block in gone:
            del degree[block]
        for block in later:
            beside[block] = (beside[block] | later) - gone - {block}
            if block:
                degree[block] = sum(int(size[other]) for other in beside[block])
