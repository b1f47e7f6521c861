"""Least squares over blocks: exact derivatives, Schur elimination, covariance, leverage, refusal of what is singular."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lpcal.errors import ConvergenceError, DegenerateError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.least_squares import POSE, Block, SolverOptions, Term, compile_residual, matrix, prior, small_rotation, solve

SIGMA = 0.01


def _point_residual(H: Any, scale: Any, x: Any, data: Any) -> Any:
    """(H (scale x) - seen) / sigma."""
    return (H[:3, :3] @ (scale * x) + H[:3, 3] - data) / SIGMA


def _problem(rng: np.random.Generator, views: int = 8, points: int = 12) -> tuple[dict[str, Block], Term, Array, Array]:
    H_true = se3.exp(rng.normal(0, 0.5, (views, 6)))
    x_true = rng.normal(0, 1, (points, 3))
    view, point = (a.ravel() for a in np.meshgrid(np.arange(views), np.arange(points), indexing="ij"))
    seen = np.einsum("kij,kj->ki", H_true[view, :3, :3], 1.1 * x_true[point]) + H_true[view, :3, 3]
    data = seen + rng.normal(0, SIGMA, seen.shape)
    term = Term(compile_residual(_point_residual, (POSE, 1, 3), 3), ("H", "scale", "x"), (view, 0, point), data)
    H_fixed = np.zeros((views, 6), dtype=bool)
    H_fixed[1:] = True  # view 0 holds the gauge
    blocks = {
        "H": Block(se3.exp(rng.normal(0, 0.02, (views, 6)) * H_fixed) @ H_true, free=H_fixed),
        "scale": Block(np.full((1, 1), 1.1), free=False),
        "x": Block(x_true + rng.normal(0, 0.02, x_true.shape)),
    }
    return blocks, term, H_true, x_true


def test_elimination_changes_nothing() -> None:
    blocks, term, _, _ = _problem(np.random.default_rng(1))
    plain = solve(blocks, [term])
    schur = solve(blocks, [term], eliminate="x")
    assert np.allclose(plain["H"], schur["H"], atol=1e-9)
    assert np.allclose(plain["x"], schur["x"], atol=1e-9)
    assert np.allclose(plain.covariance("H"), schur.covariance("H"), atol=1e-12)
    whole, items = plain.covariance("x"), schur.covariance("x")
    assert np.allclose([whole[3 * i : 3 * i + 3, 3 * i : 3 * i + 3] for i in range(12)], items, atol=1e-12)
    assert np.allclose(plain.leverage(0), schur.leverage(0), atol=1e-9)
    assert np.sum(plain.leverage(0)) == pytest.approx(7 * 6 + 12 * 3)
    assert np.allclose(plain.scores(0)[:, plain.columns("H")].sum(axis=0), 0, atol=1e-4)


def test_what_is_left_out_moves_the_rest_as_a_new_solve_would() -> None:
    blocks, term, _, _ = _problem(np.random.default_rng(6))
    found = solve(blocks, [term], eliminate="x")
    out, kept = np.isin(term.items(2), [2, 7]), np.setdiff1d(np.arange(12), [2, 7])
    index = (term.items(0)[~out], 0, np.searchsorted(kept, term.items(2)[~out]))
    rest = replace(term, index=index, data=term.data[~out])
    again = solve(found.blocks | {"x": Block(found["x"][kept])}, [rest], eliminate="x")
    step = found.without([out])[found.columns("H")].reshape(-1, 6)
    moved = se3.exp(step) @ found["H"]
    sigma = np.sqrt(np.diag(found.covariance("H"))).max()
    assert np.abs(again["H"] - found["H"]).max() > 0.05 * sigma
    assert np.abs(moved - again["H"]).max() < 1e-2 * sigma


def test_covariance_is_the_spread() -> None:
    nees = []
    for seed in range(60):
        blocks, term, H_true, _x_true = _problem(np.random.default_rng(seed))
        found = solve(blocks, [term], eliminate="x")
        error = se3.log(H_true @ se3.inv(found["H"]))[1:].ravel()
        covariance = found.covariance("H")[6:, 6:]
        nees.append(error @ np.linalg.solve(covariance, error) / error.size)
    assert np.mean(nees) == pytest.approx(1.0, abs=4 * np.sqrt(2 / (60 * 42)))


def test_jacobian_is_the_derivative() -> None:
    def residual(H: Any, K: Any, data: Any) -> Any:
        return small_rotation(H[:3, :3] @ matrix(data[:9], 3, 3)) * K[0] + H[:3, 3] * K[1] ** 2

    rng = np.random.default_rng(2)
    model = compile_residual(residual, (POSE, 2), 9)
    H, K, data = se3.exp(rng.normal(0, 0.3, (1, 6))), rng.normal(0, 1, (1, 2)), se3.rotation(rng.normal(0, 0.3, 3)).reshape(1, 9)
    _, J = model.evaluate([H, K], data)
    for column in range(8):
        step = np.zeros(8)
        step[column] = 1e-6
        up, down = (model.evaluate([se3.exp(s * step[None, :6]) @ H, K + s * step[None, 6:]], data)[0] for s in (1, -1))
        assert np.allclose((up - down) / 2e-6, J[:, column], atol=1e-8)


def test_robust_loss_ignores_a_gross_error_and_weight_zero_hides_one() -> None:
    blocks, term, _, x_true = _problem(np.random.default_rng(3))
    term.data[5] += 50
    weight = np.ones_like(term.data)
    weight[5] = 0
    hidden = solve(blocks, [Term(term.model, term.blocks, term.index, term.data, weight=weight)], eliminate="x")
    robust = solve(blocks, [Term(term.model, term.blocks, term.index, term.data, robust=3.0, group=3)], eliminate="x")
    assert np.abs(hidden["x"] - x_true).max() < 5 * SIGMA
    assert np.abs(robust["x"] - hidden["x"]).max() < 2 * SIGMA


def test_prior_alone_is_returned() -> None:
    rng = np.random.default_rng(4)
    root = rng.normal(0, 0.01, (6, 6))
    covariance, mean = root @ root.T + 1e-6 * np.eye(6), se3.exp(rng.normal(0, 0.3, 6))
    block = Block(se3.exp(rng.normal(0, 0.05, (1, 6))) @ mean)
    found = solve({"H": block}, [prior("H", block, mean, covariance)])
    assert np.allclose(found["H"][0], mean, atol=1e-9)
    assert np.allclose(found.covariance("H"), covariance, rtol=1e-6, atol=1e-12)


def test_a_free_gauge_is_refused_by_name() -> None:
    blocks, term, _, _ = _problem(np.random.default_rng(5))
    blocks["H"] = Block(blocks["H"].value)
    found = solve(blocks, [term], eliminate="x")
    with pytest.raises(DegenerateError, match="undetermined, mostly H"):
        found.covariance("H")


@pytest.mark.parametrize(("height", "settles"), [(0.1, True), (1e3, False)])
def test_a_valley_that_no_datum_notices_is_an_end_and_a_slope_is_not(height: float, settles: bool) -> None:
    """The residual falls for ever, by a factor e a step: what is left of it counts, not that it falls."""

    def slope(x: Any, data: Any) -> Any:
        return data * 2.718281828 ** (-x)

    term = Term(compile_residual(slope, (1,), 1), ("x",), (np.zeros(1, int),), np.full((1, 1), height))
    options = SolverOptions(iterations=6, tolerance=0.0)
    if settles:
        assert solve({"x": Block(np.zeros((1, 1)))}, [term], options=options).cost < 1e-4
    else:
        with pytest.raises(ConvergenceError, match="still falls"):
            solve({"x": Block(np.zeros((1, 1)))}, [term], options=options)
