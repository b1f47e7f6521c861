"""Sparse symmetric positive systems on the pixels of a mask, by conjugate gradients with a multigrid preconditioner.

Unknowns sit on pixels; a coarse unknown is the sum of those in 2x2 pixels (aggregation, Galerkin products), so that the mask's outline and
weak links between pixels are known on every level. Sources: Notay 2010, Electronic Transactions on Numerical Analysis 37 (aggregation
multigrid); Braess 1995, Computing 55 (over-correction).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.kernels.library import kernel
from lpcal.surface.sight import Indices

COARSEST = 200
ROUNDING = 1e-12
"""Share by which the diagonal of the coarsest matrix is raised, so that rounding leaves it positive."""
DAMPING = 0.7
OVER_CORRECTION = 1.6


@dataclass(frozen=True)
class Level:
    """One level: its matrix, the inverse of its diagonal, and the prolongation from the next coarser one (None at the coarsest)."""

    A: Any
    inverse_diagonal: Array
    P: Any


def aggregates(rows: Indices, columns: Indices) -> list[Any]:
    """Prolongations from coarse to fine, of pixels at rows and columns (P,), down to COARSEST unknowns."""
    from scipy import sparse

    found = []
    while len(rows) > COARSEST:
        width = int(columns.max()) // 2 + 1
        key, parent = np.unique(rows // 2 * width + columns // 2, return_inverse=True)
        if len(key) == len(rows):
            break
        found.append(sparse.csr_array((np.ones(len(rows)), (np.arange(len(rows)), parent)), shape=(len(rows), len(key))))
        rows, columns = key // width, key % width
    return found


def solve(A: Any, right: Array, start: Array, prolongations: list[Any], *, precision: float = 1e-6, most: int = 200) -> Array:
    """x (P,) with ``A x = right``, from `start`, to a relative residual of `precision`."""
    if run := kernel("multigrid"):
        return _solve_compiled(run, A, right, start, prolongations, precision, most)
    levels = _levels(A, prolongations)
    coarsest = _factor(levels[-1].A) if levels[-1].A.shape[0] <= 4 * COARSEST else None
    x = start.copy()
    residual = right - A @ x
    size = _size(A, right, x)
    direction, before = np.zeros_like(x), 1.0
    for step in range(most):
        if np.linalg.norm(residual) <= precision * size:
            break
        z = _cycle(levels, 0, residual, coarsest)
        now = float(residual @ z)
        direction = z + (now / before if step else 0.0) * direction
        image = A @ direction
        length = now / float(direction @ image)
        x += length * direction
        residual -= length * image
        before = now
    return x


def _size(A: Any, right: Array, x: Array) -> float:
    """What a residual is measured by: that of the mean of x everywhere."""
    return float(np.linalg.norm(right - A @ np.full_like(x, x.mean())) + 1e-300)


def _solve_compiled(
    run: Callable[..., None], A: Any, right: Array, start: Array, prolongations: list[Any], precision: float, most: int
) -> Array:
    """The same by the kernels, on the levels' arrays laid one behind the other."""
    from scipy import sparse

    set_up = kernel("hierarchy")
    assert set_up is not None
    sizes = np.array([A.shape[0], *(P.shape[1] for P in prolongations)], np.int64)
    parents = np.concatenate([np.zeros(0, np.int64), *(P.indices for P in prolongations)]).astype(np.int64)
    slot, rows = len(A.data), int(sizes.sum())
    starts, columns = np.empty(rows + len(sizes), np.int64), np.empty(slot * len(sizes), np.int64)
    values, inverse = np.empty(slot * len(sizes)), np.empty(rows)
    starts[: len(A.indptr)], columns[:slot], values[:slot] = A.indptr, A.indices, A.data
    set_up(len(sizes), slot, sizes, parents, starts, columns, values, inverse, np.empty(3 * sizes[0], np.int64))
    coarsest = None
    if sizes[-1] <= 4 * COARSEST:
        indptr, first = starts[-sizes[-1] - 1 :], slot * len(prolongations)
        some = slice(first, first + indptr[-1])
        coarsest = _factor(sparse.csr_array((values[some], columns[some], indptr), shape=(sizes[-1], sizes[-1])))
    factor = np.zeros(0) if coarsest is None else np.ascontiguousarray(coarsest[0])
    x, enough = np.array(start, float), precision * _size(A, right, start)
    levels = (len(sizes), slot, sizes, parents, starts, columns, values, inverse)
    work = np.empty(3 * rows + 4 * int(sizes[0]))
    run(*levels, coarsest is not None, factor, np.ascontiguousarray(right, float), x, work, enough, most, DAMPING, OVER_CORRECTION)
    return x


def _levels(A: Any, prolongations: list[Any]) -> list[Level]:
    levels = []
    for P in prolongations:
        levels.append(Level(A, 1 / A.diagonal(), P))
        A = (P.T @ (A @ P)).tocsr()
    return [*levels, Level(A, 1 / A.diagonal(), None)]


def _factor(A: Any) -> Any:
    """The Cholesky factor of a small matrix; None where it is singular to rounding."""
    from scipy import linalg

    dense = A.toarray()
    dense[np.diag_indices_from(dense)] *= 1 + ROUNDING
    try:
        return linalg.cho_factor(dense, check_finite=False, overwrite_a=True)
    except linalg.LinAlgError:
        return None


def _cycle(levels: list[Level], depth: int, right: Array, coarsest: Any) -> Array:
    """One symmetric V-cycle from zero."""
    level = levels[depth]
    if level.P is None:
        from scipy import linalg

        return linalg.cho_solve(coarsest, right, check_finite=False) if coarsest is not None else level.inverse_diagonal * right
    x = DAMPING * level.inverse_diagonal * right
    x = x + DAMPING * level.inverse_diagonal * (right - level.A @ x)
    x = x + OVER_CORRECTION * (level.P @ _cycle(levels, depth + 1, level.P.T @ (right - level.A @ x), coarsest))
    x = x + DAMPING * level.inverse_diagonal * (right - level.A @ x)
    return x + DAMPING * level.inverse_diagonal * (right - level.A @ x)
