r"""Non-linear least squares over blocks of parameters, with exact derivatives; over `residual_terms`.

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

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lpcal.errors import ConvergenceError
from lpcal.geometry.arrays import Array, Index, Mask
from lpcal.geometry.normal_equations import Layout, System, add_products, inverse, linearise, reduced, step_of
from lpcal.geometry.residual_terms import POSE, Block, Model, Term, compile_residual, independent_prior, matrix, prior, small_rotation

__all__ = [
    "POSE",
    "Block",
    "Model",
    "Solution",
    "SolverOptions",
    "Term",
    "compile_residual",
    "independent_prior",
    "matrix",
    "prior",
    "small_rotation",
    "solve",
]

SETTLED = 0.05
"""If the cost, in whitened units, fell by less than this over the last quarter of all steps, the solve counts as converged."""
NO_WAY_DOWN = 1e12
"""Damping at which the descent ends: no step, however short, lowers the cost."""


@dataclass(frozen=True)
class SolverOptions:
    """Options of the descent."""

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
    def _reduced(self) -> tuple[Array, Array, Array, Array]:
        """The undamped normal equations without the eliminated block."""
        return reduced(self._system, 0.0)

    @cached_property
    def _S(self) -> Array:
        """Inverse of the reduced information, zero where fixed."""
        system, free = self._system, self._layout.free
        S = self._reduced[0][np.ix_(free, free)]
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

    def without(self, left_out: Sequence[Mask]) -> Array:
        """Gauss-Newton step (n,) of all that is not eliminated, once some observations of each term (N,) are left out.

        An eliminated item loses all of its observations or none.

        Raises
        ------
        DegenerateError
            What is left leaves a direction undetermined.
        """
        system, free = self._system, self._layout.free
        N, _, _, CB = self._reduced
        lost, g = np.zeros_like(N), np.zeros(len(N))
        gone: set[int] = set()
        for place, (term, out) in enumerate(zip(self.terms, left_out, strict=True)):
            columns, item = self._layout.of_term(term)
            J, r = system.jacobians[place][out], system.residuals[place][out]
            if item is not None:
                start, stop = self._layout.eliminated_columns(term)
                J = np.delete(J, np.s_[start:stop], axis=1)
                gone |= set(item[out].tolist())
            add_products(lost, g, [one[out] for one in self._layout.kept_items(term)], columns[out], J, r)
        if gone:
            at = np.array(sorted(gone))
            g -= np.einsum("isn,is->n", CB[at], system.gradient_e[at])
            lost -= np.tensordot(system.B[at], CB[at], axes=([0, 2], [0, 1]))
        N = N - lost
        step = np.zeros_like(g)
        labels = [name for name, f in zip(self._layout.labels(), free, strict=True) if f]
        step[free] = inverse(N[np.ix_(free, free)], labels) @ g[free]
        return step

    def columns(self, *names: str) -> Index:
        """Places of blocks in `scores`."""
        return np.concatenate([self._layout.columns(name).ravel() for name in names])


def solve(
    blocks: Mapping[str, Block], terms: Sequence[Term], *, eliminate: str | None = None, options: SolverOptions | None = None
) -> Solution:
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
        The cost still falls after the last iteration, noticeably, or is not finite.
    """
    options = options or SolverOptions()
    layout = Layout(dict(blocks), eliminate)
    system = linearise(layout, blocks, terms)
    if not np.isfinite(system.cost):
        raise ConvergenceError("the residuals are not finite at the start", needed="a start in front of the camera, finite data")
    now, damping, small, iteration, costs = dict(blocks), options.damping, 0, 0, [system.cost]
    while small < 2 and damping < NO_WAY_DOWN:
        if iteration == options.iterations and (not options.strict or costs[len(costs) * 3 // 4] - system.cost < SETTLED):
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
            costs.append(system.cost)
        else:
            small = small + 1 if abs(expected) <= options.tolerance * system.cost + 1e-12 else 0
            damping *= 10
    return Solution(now, tuple(terms), system.cost, iteration, eliminate, tuple(system.plain), system, layout)
