"""What a least-squares problem is made of: blocks of parameters, compiled residuals, observations and priors; casadi's home.

Symbols and equations as in `lpcal.geometry.least_squares`. A residual is a Python function of casadi matrices, written for one
observation; it is compiled once, with its exact derivative by the blocks' tangent (a pose moves by ``exp(xi) H``), and mapped over all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Index

POSE = 0
"""Stands for a pose among the sizes of a residual's blocks."""
MOST_MAPS = 16
"""Counts of observations for which a mapped function is kept."""


@dataclass(frozen=True)
class Block:
    """Parameters of one kind: `value` (count, n) vectors, or (count, 4, 4) poses; `free` (count, size) or one bool for all."""

    value: Array
    free: bool | npt.NDArray[np.bool_] = True

    @property
    def is_pose(self) -> bool:
        """Whether the items are rigid transforms."""
        return self.value.ndim == 3

    @property
    def count(self) -> int:
        """Number of items."""
        return len(self.value)

    @property
    def size(self) -> int:
        """Degrees of freedom of one item: 6 for a pose."""
        return 6 if self.is_pose else self.value.shape[1]

    def moved(self, step: Array) -> Block:
        """The block after a step (count, size) in its tangent space."""
        return replace(self, value=se3.exp(step) @ self.value if self.is_pose else self.value + step)


@dataclass(frozen=True)
class Model:
    """A compiled residual of one observation: blocks' sizes (POSE for a pose), data's length, and its number of rows."""

    sizes: tuple[int, ...]
    data: int
    rows: int
    function: Any
    mapped: dict[int, Any] = field(default_factory=dict)

    @property
    def tangent(self) -> int:
        """Columns of its Jacobian."""
        return sum(size or 6 for size in self.sizes)

    def evaluate(self, values: Sequence[Array], data: Array) -> tuple[Array, Array]:
        """Residuals (N, rows) and Jacobians (N, tangent, rows), transposed, of N observations."""
        count = len(data)
        if count not in self.mapped:
            if len(self.mapped) >= MOST_MAPS:
                self.mapped.clear()
            self.mapped[count] = self.function.map(count).buffer()
        buffer, run = self.mapped[count]
        residual, jacobian = np.zeros((count, self.rows)), np.zeros((count, self.tangent, self.rows))
        inputs = [np.ascontiguousarray(value, dtype=float).reshape(count, -1) for value in (*values, data)]
        for place, array in enumerate(inputs):
            buffer.set_arg(place, memoryview(array))
        buffer.set_res(0, memoryview(residual))
        buffer.set_res(1, memoryview(jacobian))
        run()
        return residual, jacobian


@lru_cache(maxsize=64)
def compile_residual(residual: Callable[..., Any], sizes: tuple[int, ...], data: int) -> Model:
    """Compile a residual and its exact derivative.

    Parameters
    ----------
    residual : takes one casadi matrix a block (4x4 for POSE, else a column) and a column of data; returns a column
    sizes : of the blocks, in the residual's order; POSE for a rigid transform
    data : length of an observation's data
    """
    import casadi as ca

    values = [ca.SX.sym(f"x{i}", size or 16) for i, size in enumerate(sizes)]
    steps = [ca.SX.sym(f"d{i}", size or 6) for i, size in enumerate(sizes)]
    seen = ca.SX.sym("data", data)
    moved = [_moved(x, d) if size == POSE else x + d for x, d, size in zip(values, steps, sizes, strict=True)]
    r = ca.densify(residual(*moved, seen))
    d = ca.vertcat(*steps)
    at = [ca.densify(found) for found in ca.substitute([r, ca.jacobian(r, d)], [d], [ca.SX.zeros(d.shape)])]
    function = ca.Function("residual", [*values, seen], at, {"cse": True})
    return Model(sizes, data, int(r.numel()), function)


def matrix(column: Any, rows: int, columns: int) -> Any:
    """A casadi column (as numpy flattens a matrix) as a casadi matrix."""
    import casadi as ca

    return ca.reshape(column, columns, rows).T


def small_rotation(R: Any) -> Any:
    """2 tan(angle/2) times the axis of a casadi rotation R (3x3): its rotation vector where small, smooth at zero."""
    import casadi as ca

    return 2 * ca.vertcat(R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]) / (1 + ca.trace(R))


def _moved(x: Any, d: Any) -> Any:
    """exp(d) H to first order, which is exact for the derivative at d = 0."""
    import casadi as ca

    H = matrix(x, 4, 4)
    twist = ca.vertcat(ca.horzcat(ca.skew(d[:3]), d[3:]), ca.SX.zeros(1, 4))
    return H + twist @ H


@dataclass(frozen=True)
class Term:
    """N observations of one model.

    ``blocks`` names the model's blocks in its order, ``index`` says for each which item each observation takes: (N,) or one number
    for all. ``weight`` (N, rows) multiplies the squared residuals (0: not seen). ``robust``: the Cauchy loss's scale, in standard
    deviations, of every `group` rows together.
    """

    model: Model
    blocks: tuple[str, ...]
    index: tuple[Index | int, ...]
    data: Array
    weight: Array | None = None
    robust: float | None = None
    group: int = 1

    @property
    def count(self) -> int:
        """Number of observations."""
        return len(self.data)

    def items(self, place: int) -> Index:
        """The item (N,) of the block at a place that each observation takes."""
        return np.broadcast_to(np.asarray(self.index[place], dtype=np.intp), (self.count,))


def prior(name: str, block: Block, mean: Array, covariance: Array, item: int = 0) -> Term:
    """A Gaussian prior of one item of a block: mean (n,) or H (4, 4), covariance (size, size) of it or of its left perturbation."""
    whiten = np.linalg.inv(np.linalg.cholesky(covariance))
    data = np.concatenate([np.ravel(mean), np.ravel(whiten)])[None]
    return Term(_pose_prior() if block.is_pose else _vector_prior(block.size), (name,), (item,), data)


@cache
def _pose_prior() -> Model:
    import casadi as ca

    def residual(H: Any, data: Any) -> Any:
        H_mean, whiten = matrix(data[:16], 4, 4), matrix(data[16:], 6, 6)
        R = H[:3, :3] @ H_mean[:3, :3].T
        return whiten @ ca.vertcat(small_rotation(R), H[:3, 3] - R @ H_mean[:3, 3])

    return compile_residual(residual, (POSE,), 16 + 36)


@cache
def _vector_prior(size: int) -> Model:
    def residual(x: Any, data: Any) -> Any:
        return matrix(data[size:], size, size) @ (x - data[:size])

    return compile_residual(residual, (size,), size + size**2)


def independent_prior(name: str, mean: Array, sd: Array) -> Term:
    """Gaussian priors of every item of a block of vectors: mean and standard deviation (count, n), or sd (n,) for all items."""
    count, size = mean.shape

    def residual(x: Any, data: Any) -> Any:
        return (x - data[:size]) / data[size:]

    data = np.hstack([mean, np.broadcast_to(sd, mean.shape)])
    return Term(compile_residual(residual, (size,), 2 * size), (name,), (np.arange(count),), data)
