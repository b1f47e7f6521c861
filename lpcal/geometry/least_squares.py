r"""Non-linear least squares over blocks of parameters, with exact derivatives; the one home of casadi.

Symbols: blocks x_b of parameters (vectors, or poses ``H`` with the left perturbation ``exp(xi) H``), observations k with residual
``r_k(x)`` already divided by its standard deviation, weights w_k, a robust loss rho::

    cost = 1/2 sum_k rho( |r_k|^2 )            information  N = sum_k J_k^T w_k J_k,  J_k = d r_k / d x
    N = [A B; B^T C],   S = A - B C^-1 B^T     C is block diagonal: one block of parameters (`eliminate`) that only meets itself
    covariance of what is left = S^-1,   of an eliminated item i = C_i^-1 + C_i^-1 B_i^T S^-1 B_i C_i^-1

A residual is a Python function of casadi matrices, written for one observation, compiled once and mapped over all::

    def reprojection(H_CB, K, seen): ...                      # casadi in, casadi column out
    model = compile_residual(reprojection, (POSE, 4), data=3 + 2)
    term = Term(model, ("H_CB", "K"), (view_of_k, zeros), data, robust=3.0)
    found = solve({"H_CB": Block(H_CB), "K": Block(K[None])}, [term], eliminate="H_CB")
    found["K"], found.covariance("K")

Sources: Levenberg-Marquardt as in Madsen, Nielsen, Tingleff, Methods for Non-linear Least Squares Problems (2004); Schur complement and
iteratively reweighted loss as in Triggs et al., Bundle Adjustment, a Modern Synthesis (2000).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.errors import ConvergenceError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.normal_equations import Index, Layout, System, inverse, linearise, reduced, step_of

POSE = 0
"""Stands for a pose among the sizes of a residual's blocks."""
NO_WAY_DOWN = 1e12
"""Damping at which the descent ends: no step, however short, lowers the cost."""


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
    import casadi as ca

    size = block.size

    def of_pose(H: Any, data: Any) -> Any:
        H_mean, whiten = matrix(data[:16], 4, 4), matrix(data[16:], 6, 6)
        R = H[:3, :3] @ H_mean[:3, :3].T
        return whiten @ ca.vertcat(small_rotation(R), H[:3, 3] - R @ H_mean[:3, 3])

    def of_vector(x: Any, data: Any) -> Any:
        return matrix(data[size:], size, size) @ (x - data[:size])

    whiten = np.linalg.inv(np.linalg.cholesky(covariance))
    data = np.concatenate([np.ravel(mean), np.ravel(whiten)])[None]
    model = compile_residual(of_pose if block.is_pose else of_vector, (POSE if block.is_pose else size,), data.shape[1])
    return Term(model, (name,), (item,), data)


def independent_prior(name: str, mean: Array, sd: Array) -> Term:
    """Gaussian priors of every item of a block of vectors: mean and standard deviation (count, n), or sd (n,) for all items."""
    count, size = mean.shape

    def residual(x: Any, data: Any) -> Any:
        return (x - data[:size]) / data[size:]

    data = np.hstack([mean, np.broadcast_to(sd, mean.shape)])
    return Term(compile_residual(residual, (size,), 2 * size), (name,), (np.arange(count),), data)


@dataclass(frozen=True)
class Options:
    """Knobs of the descent."""

    iterations: int = 60
    damping: float = 1e-6
    tolerance: float = 1e-9
    """Relative fall of the cost, twice in a row, that ends it."""
    strict: bool = True
    """Whether running out of iterations is an error; an outer loop may go on by itself."""


@dataclass(frozen=True)
class Solution:
    """The least-squares estimate: blocks, cost, and through its methods covariances and leverages."""

    blocks: dict[str, Block]
    terms: tuple[Term, ...]
    cost: float
    iterations: int
    eliminated: str | None
    residuals: tuple[Array, ...]
    """A term each, (N, rows), divided by their standard deviation, not weighted by the loss."""
    _system: System
    _layout: Layout

    def __getitem__(self, name: str) -> Array:
        """The value of a block: (count, n) or (count, 4, 4)."""
        return self.blocks[name].value

    @cached_property
    def _S(self) -> Array:
        """Inverse of the reduced information, zero where fixed."""
        system, free = self._system, self._layout.free
        S = reduced(system, 0.0)[0][np.ix_(free, free)]
        covariance = np.zeros_like(system.A)
        covariance[np.ix_(free, free)] = inverse(S, [name for name, f in zip(self._layout.labels(), free, strict=True) if f])
        return covariance

    def covariance(self, *names: str) -> Array:
        """Joint covariance (n, n) of whole blocks, in the order named; zero for what is fixed.

        One name may be the eliminated block: then (count, size, size), an item each.

        Raises
        ------
        DegenerateError
            The data leave a direction undetermined.
        """
        if names == (self.eliminated,):
            system = self._system
            C_inverse = np.linalg.inv(system.C)
            G = system.B @ C_inverse
            return np.asarray(C_inverse + np.einsum("ina,nm,imb->iab", G, self._S, G, optimize=True))
        at = np.concatenate([self._layout.columns(name).ravel() for name in names])
        return self._S[np.ix_(at, at)]

    @property
    def parameters(self) -> int:
        """Number of free parameters, the eliminated ones too."""
        return int(self._layout.free.sum()) + self._layout.items * self._layout.size * bool(self._layout.items)

    def covariance_of_all(self) -> Array:
        """Covariance (n, n) of all that is not eliminated, in the order of `columns`; zero for what is fixed."""
        return self._S

    def leverage(self, term: int) -> Array:
        """Share (N, rows) of each residual that the fit absorbs: diag(J cov J^T); a residual's variance is 1 - leverage."""
        J = self._system.jacobians[term]
        columns, item = self._layout.of_term(self.terms[term])
        Sigma = self._S[columns[:, :, None], columns[:, None, :]]
        if item is not None:
            start, stop = self._layout.eliminated_columns(self.terms[term])
            system = self._system
            C_inverse = np.linalg.inv(system.C)
            G = (system.B @ C_inverse)[item]
            cross = -np.einsum("knm,kms->kns", self._S[columns], G, optimize=True)
            keep = np.r_[0:start, stop : J.shape[1]]
            whole = np.zeros((len(J), J.shape[1], J.shape[1]))
            whole[:, keep[:, None], keep] = Sigma
            whole[:, keep, start:stop] = cross
            whole[:, start:stop, keep] = np.swapaxes(cross, 1, 2)
            whole[:, start:stop, start:stop] = self.covariance(str(self.eliminated))[item]
            Sigma = whole
        return np.asarray(np.einsum("kar,kar->kr", J, Sigma @ J))

    def scores(self, term: int) -> Array:
        """Gradient (N, n) that each observation of a term gives the blocks that are not eliminated: for block-robust covariances."""
        J, r = self._system.jacobians[term], self._system.residuals[term]
        columns, item = self._layout.of_term(self.terms[term])
        scores = np.zeros((len(J), len(self._system.A)))
        g = np.einsum("kar,kr->ka", J, r)
        if item is not None:
            start, stop = self._layout.eliminated_columns(self.terms[term])
            G = (self._system.B @ np.linalg.inv(self._system.C))[item]
            scores -= np.einsum("kns,ks->kn", G, g[:, start:stop])
            g = np.delete(g, np.s_[start:stop], axis=1)
        np.add.at(scores, (np.arange(len(J))[:, None], columns), g)
        return scores

    def columns(self, *names: str) -> Index:
        """Places of blocks in `scores`."""
        return np.concatenate([self._layout.columns(name).ravel() for name in names])


def solve(blocks: Mapping[str, Block], terms: Sequence[Term], *, eliminate: str | None = None, options: Options | None = None) -> Solution:
    """The blocks that make the terms' cost least, from where they stand, by Levenberg-Marquardt.

    Parameters
    ----------
    blocks : by name
    terms : observations; one may meet at most one item of the eliminated block
    eliminate : a block of many items, all free, that only meet themselves; its size costs little

    Raises
    ------
    DegenerateError
        The information is singular: the data leave a direction undetermined; it is named.
    ConvergenceError
        The cost still falls after the last iteration, or is not finite.
    """
    options = options or Options()
    layout = Layout(dict(blocks), eliminate)
    system = linearise(layout, blocks, terms)
    if not np.isfinite(system.cost):
        raise ConvergenceError("the residuals are not finite at the start", needed="a start in front of the camera, finite data")
    now, damping, small, iteration = dict(blocks), options.damping, 0, 0
    while small < 2 and damping < NO_WAY_DOWN:
        if iteration == options.iterations and not options.strict:
            break
        if iteration == options.iterations:
            raise ConvergenceError(
                f"the cost still falls after {iteration} iterations", needed="a solve that settles", todo="look at the data's residuals"
            )
        iteration += 1
        step, step_e, expected = step_of(system, layout, damping)
        trial = {name: block.moved(layout.part(name, step, step_e)) for name, block in now.items()}
        system_new = linearise(layout, trial, terms)
        fall = system.cost - system_new.cost
        if np.isfinite(system_new.cost) and fall >= 0:
            small = small + 1 if fall <= options.tolerance * system.cost + 1e-12 else 0
            now, system, damping = trial, system_new, max(damping / 10, 1e-12)
        else:
            small = small + 1 if abs(expected) <= options.tolerance * system.cost + 1e-12 else 0
            damping *= 10
    return Solution(now, tuple(terms), system.cost, iteration, eliminate, tuple(system.plain), system, layout)
