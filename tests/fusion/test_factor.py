"""Normal equations in blocks against the dense matrix."""

from __future__ import annotations

import numpy as np
import pytest

from lpcal.fusion.factor import BlockMatrix, Factor, columns_of, elimination


def _drawn(views: int, reach: int, seed: int) -> BlockMatrix:
    """Views in a ring, each tied to those within reach, and to what all share."""
    rng = np.random.default_rng(seed)
    sizes = np.concatenate([[5], rng.integers(3, 9, views)])
    starts = np.concatenate([[0], np.cumsum(sizes)])
    found = BlockMatrix(starts)
    for block in range(views + 1):
        found.add(found.rows(block), np.diag(rng.uniform(0.5, 2.0, sizes[block])))
    for k in range(views):
        for away in range(1, reach + 1):
            both = sorted([1 + k, 1 + (k + away) % views])
            used = np.concatenate([found.rows(0), *(found.rows(block)[::2] for block in both)])
            J = rng.standard_normal((6, len(used)))
            found.add(used, J.T @ J)
    return found


@pytest.mark.parametrize(("views", "reach"), [(3, 1), (12, 1), (12, 5), (40, 2), (40, 19)])
def test_solutions_and_variances_are_those_of_the_dense_matrix(views: int, reach: int) -> None:
    """Where few overlap and where all do."""
    matrix = _drawn(views, reach, views + reach)
    A, rng = matrix.dense(), np.random.default_rng(1)
    assert np.array_equal(A, A.T)
    factor, b = Factor.of(matrix), rng.standard_normal(matrix.size)
    inverse = np.linalg.inv(A)
    assert np.allclose(factor.solve(b), inverse @ b)
    some = np.array([0, 3, matrix.size - 1, 7])
    assert np.allclose(factor.covariance(some), inverse[np.ix_(some, some)])
    rows = [(np.sort(rng.choice(matrix.size, 6, replace=False)), rng.standard_normal(6)) for _ in range(700)]
    rows += [(np.array([1, 4, 9]), rng.standard_normal(3)) for _ in range(600)]
    R = columns_of(rows, matrix.size)
    assert np.allclose(factor.variances(rows), np.einsum("nk,nm,mk->k", R, inverse, R))


def test_blocks_add_up_to_the_sum_of_their_parts() -> None:
    """Also such as are of two views without anything of what all share."""
    rng, found = np.random.default_rng(2), BlockMatrix(np.array([0, 3, 5, 9]))
    whole = np.zeros((9, 9))
    for used in ([0, 2, 4, 8], [3, 5, 6], [1], [5, 7, 8]):
        J = rng.standard_normal((3, len(used)))
        found.add(np.array(used), J.T @ J)
        whole[np.ix_(used, used)] += J.T @ J
    assert np.allclose(found.dense(), whole)


def test_a_ring_of_views_takes_memory_in_proportion_to_them() -> None:
    """And where all overlap it is one dense step."""
    held = []
    for views in (50, 400):
        matrix = _drawn(views, 2, 3)
        held.append(sum(front.L.size + front.below.size for front in Factor.of(matrix).fronts) / matrix.size)
    assert held[1] < 1.3 * held[0]
    assert [len(own) for own, _ in elimination(_drawn(9, 4, 0))] == [10]


def test_every_block_is_eliminated_once_and_what_all_share_last() -> None:
    steps = list(elimination(_drawn(30, 3, 5)))
    assert sorted(block for own, _ in steps for block in own) == list(range(31))
    assert steps[-1][0][-1] == 0
    assert not steps[-1][1]
    done: set[int] = set()
    for own, later in steps:
        assert not done & {*own, *later}
        done |= set(own)
