"""Normal equations of block least squares: assembly, elimination of one block (Schur complement), solution and inversion.

Symbols as in `lpcal.geometry.least_squares`::

    N = [A B; B^T C],   g = sum J^T r,   S = A - B C^-1 B^T,   step = -S^-1 (g - B C^-1 g_e),   step_e = -C^-1 (g_e + B^T step)
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry.arrays import Array, Index
from lpcal.geometry.residual_terms import Block, Term

SINGULAR = 1e-13
"""Eigenvalue of the information matrix, scaled to a unit diagonal, below which it counts as singular."""

WELL = 1e-9
"""Least pivot of a scaled information above which it is solved by Cholesky's factors."""

FEW = 4
"""Observations a group, from which on a product a group is faster than one an observation."""


@dataclass
class System:
    """The linearised problem: the dense blocks of the normal equations, and each term's whitened residuals and Jacobians."""

    cost: float
    A: Array
    B: Array
    """(items, n, size) of the eliminated block."""
    C: Array
    """(items, size, size)."""
    gradient: Array
    gradient_e: Array
    residuals: list[Array]
    jacobians: list[Array]
    plain: list[Array]
    """Unweighted residuals of the model."""


class Layout:
    """Assignment of columns of the reduced system to parameters."""

    def __init__(self, blocks: dict[str, Block], eliminate: str | None) -> None:
        self.blocks, self.eliminate = blocks, eliminate
        kept = {name: block for name, block in blocks.items() if name != eliminate}
        ends = list(itertools.accumulate((block.count * block.size for block in kept.values()), initial=0))
        self.start = dict(zip(kept, ends, strict=False))
        self.total = ends[-1]
        self.items, self.size = (blocks[eliminate].count, blocks[eliminate].size) if eliminate else (0, 1)
        free = [np.broadcast_to(block.free, (block.count, block.size)).ravel() for block in kept.values()]
        self.free = np.concatenate([*free, np.zeros(0, dtype=bool)])

    def columns(self, name: str) -> Index:
        """Columns (count, size) of a block."""
        block = self.blocks[name]
        return self.start[name] + np.arange(block.count * block.size).reshape(block.count, block.size)

    def labels(self) -> list[str]:
        """A name for every column."""
        return [f"{name}[{i}].{c}" for name in self.start for i in range(self.blocks[name].count) for c in range(self.blocks[name].size)]

    def of_term(self, term: Term) -> tuple[Index, Index | None]:
        """Columns (N, k) of a term's blocks that are not eliminated, and the eliminated item (N,) of each observation."""
        kept = [self.columns(name)[term.items(place)] for place, name in enumerate(term.blocks) if name != self.eliminate]
        item = next((term.items(place) for place, name in enumerate(term.blocks) if name == self.eliminate), None)
        return np.concatenate([*kept, np.zeros((term.count, 0), dtype=np.intp)], axis=1), item

    def kept_items(self, term: Term) -> list[Index]:
        """Items (N,) of each block of a term that is not eliminated."""
        return [term.items(place) for place, name in enumerate(term.blocks) if name != self.eliminate]

    def eliminated_columns(self, term: Term) -> tuple[int, int]:
        """Range (start, end) of the eliminated block's columns in a term's Jacobian."""
        place = term.blocks.index(str(self.eliminate))
        start = sum(size or 6 for size in term.model.sizes[:place])
        return start, start + (term.model.sizes[place] or 6)

    def part(self, name: str, step: Array, step_e: Array) -> Array:
        """A block's part (count, size) of a step."""
        return step_e if name == self.eliminate else step[self.columns(name)]


def values_of(term: Term, blocks: Mapping[str, Block]) -> list[Array]:
    """The items that each observation uses, one array for each block."""
    return [blocks[name].value[term.items(place)] for place, name in enumerate(term.blocks)]


def linearise(layout: Layout, blocks: Mapping[str, Block], terms: Sequence[Term]) -> System:
    """The normal equations of all terms at the blocks' values."""
    n, items, size = layout.total, layout.items, layout.size
    system = System(
        0.0,
        np.zeros((n, n)),
        np.zeros((items, n, size)),
        np.zeros((items, size, size)),
        np.zeros(n),
        np.zeros((items, size)),
        [],
        [],
        [],
    )
    for term in terms:
        r, J = term.model.evaluate(values_of(term, blocks), term.data)
        cost, root = _loss(r, term)
        system.plain.append(r)
        r, J = r * root, J * root[:, None, :]
        system.cost += cost
        system.residuals.append(r)
        system.jacobians.append(J)
        _add(system, layout, term, r, J)
    return system


def _loss(r: Array, term: Term) -> tuple[float, Array]:
    """Cost of a term, and the square roots (N, rows) of its rows' weights."""
    weight = np.ones_like(r) if term.weight is None else term.weight
    squared = weight * r**2
    if term.robust is None:
        return 0.5 * float(squared.sum()), np.sqrt(weight)
    grouped = squared.reshape(len(r), -1, term.group).sum(axis=2) / term.robust**2
    return 0.5 * term.robust**2 * float(np.log1p(grouped).sum()), np.sqrt(weight * np.repeat(1 / (1 + grouped), term.group, axis=1))


def _add(system: System, layout: Layout, term: Term, r: Array, J: Array) -> None:
    """Add a term to the normal equations; observations that share their items go together, as one matrix product."""
    columns, item = layout.of_term(term)
    kept = layout.kept_items(term)
    if item is not None:
        start, stop = layout.eliminated_columns(term)
        J_e, J = J[:, start:stop], np.delete(J, np.s_[start:stop], axis=1)
        groups = _groups([*kept, item], term.count)
        if len(groups) * FEW <= term.count:
            for group in groups:
                first, J_eT, r_g = group[0], _rows(J_e[group]), r[group].ravel()
                system.C[item[first]] += J_eT @ J_eT.T
                system.gradient_e[item[first]] += J_eT @ r_g
                _gather(system.B[item[first]], columns[first], _rows(J[group]) @ J_eT.T)
        else:
            J_eT = np.swapaxes(J_e, 1, 2)
            np.add.at(system.C, item, J_e @ J_eT)
            np.add.at(system.gradient_e, item, (J_e @ r[:, :, None])[:, :, 0])
            np.add.at(system.B, (item[:, None], columns), J @ J_eT)
    add_products(system.A, system.gradient, kept, columns, J, r)


def add_products(A: Array, gradient: Array, items: Sequence[Index], columns: Index, J: Array, r: Array) -> None:
    """Add J J^T and J r of observations, residuals r (N, rows) and Jacobians J (N, k, rows), at the columns (N, k) of their items (N,)."""
    for group in _groups(items, len(columns)):
        at, J_T = columns[group[0]], _rows(J[group])
        _gather(gradient, at, J_T @ r[group].ravel())
        _gather(A, np.ix_(at, at), J_T @ J_T.T)


def _gather(whole: Array, at: Index | tuple[Index, ...], part: Array) -> None:
    """Add a part to its rows and columns of the whole; indices may repeat, as an observation may use an item twice."""
    rows = at[0].ravel() if isinstance(at, tuple) else at
    if len(np.unique(rows)) == len(rows):
        whole[at] += part
    else:
        np.add.at(whole, at, part)


def _groups(items: Sequence[Index], count: int) -> list[Index]:
    """Observations grouped by the items they use."""
    key = np.zeros(count, dtype=np.intp)
    for each in items:
        key = key * (int(each.max(initial=0)) + 1) + each
    if count == 0 or np.all(key == key[0]):
        return [np.arange(count)] if count else []
    order = np.argsort(key, kind="stable")
    return list(np.split(order, np.flatnonzero(np.diff(key[order])) + 1))


def _rows(J: Array) -> Array:
    """Transposed Jacobians (N, n, rows) as one (n, N rows)."""
    return J.transpose(1, 0, 2).reshape(J.shape[1], len(J) * J.shape[2])


def reduced(system: System, damping: float) -> tuple[Array, Array, Array, Array]:
    """S, its right-hand side, and the damped C^-1 and C^-1 B^T as (items, size, n)."""
    A = system.A + damping * np.diag(np.diag(system.A))
    if not len(system.C):
        return A, -system.gradient, system.C, np.swapaxes(system.B, 1, 2)
    C = system.C + damping * system.C * np.eye(system.C.shape[1])
    C_inverse = np.linalg.inv(C)
    CB = C_inverse @ np.swapaxes(system.B, 1, 2)
    S = A - np.tensordot(system.B, CB, axes=([0, 2], [0, 1]))
    g = -system.gradient + np.einsum("isn,is->n", CB, system.gradient_e)
    return 0.5 * (S + S.T), g, C_inverse, CB


def step_of(system: System, layout: Layout, damping: float) -> tuple[Array, Array, float]:
    """Step of the remaining and of the eliminated parameters, and the predicted reduction of the cost."""
    try:
        S, g, C_inverse, CB = reduced(system, damping)
    except np.linalg.LinAlgError as error:
        raise DegenerateError(f"an item of {layout.eliminate} is not determined by its observations", needed="more of them") from error
    free = layout.free
    step = np.zeros(layout.total)
    scale = 1 / np.sqrt(np.maximum(np.diag(S)[free], 1e-300))
    scaled = S[np.ix_(free, free)] * np.outer(scale, scale)
    step[free] = scale * _solved(scaled, scale * g[free])
    step_e = -np.einsum("iab,ib->ia", C_inverse, system.gradient_e) - CB @ step if len(system.C) else system.gradient_e
    expected = -0.5 * float(system.gradient @ step + np.sum(system.gradient_e * step_e))
    return step, step_e, expected


def _solved(S: Array, g: Array) -> Array:
    """S^-1 g of a scaled information matrix; undetermined directions get no step."""
    try:
        root = np.linalg.cholesky(S)
    except np.linalg.LinAlgError:
        root = np.zeros((0, 0))
    if root.size and np.diag(root).min() ** 2 > WELL:
        from scipy.linalg import cho_solve

        return np.asarray(cho_solve((root, True), g))
    return np.linalg.lstsq(S, g, rcond=SINGULAR)[0]


def inverse(S: Array, labels: list[str]) -> Array:
    """Inverse of an information matrix; a singular one is refused, and its weakest direction named.

    Raises
    ------
    DegenerateError
        The matrix is singular.
    """
    diagonal = np.diag(S)
    if np.any(diagonal <= 0):
        raise DegenerateError(f"nothing determines {labels[int(np.argmin(diagonal))]}", needed="data that depend on it")
    scale = 1 / np.sqrt(diagonal)
    values, vectors = np.linalg.eigh(S * np.outer(scale, scale))
    if values[0] < SINGULAR:
        weak = vectors[:, 0]
        names = [labels[i] for i in np.argsort(-np.abs(weak))[:3] if abs(weak[i]) > 0.2]
        raise DegenerateError(f"the data leave a direction undetermined, mostly {', '.join(names)}", needed="data that turn with it")
    return np.asarray((vectors / values) @ vectors.T * np.outer(scale, scale))
