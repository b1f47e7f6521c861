"""Robust fits of a few unknowns: the same place as scipy's, whatever lies far off."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import optimize

from lpcal.geometry import cauchy_fit
from lpcal.geometry.arrays import Array
from lpcal.geometry.cauchy_fit import Equations


def problem(rng: np.random.Generator) -> tuple[Array, Array]:
    x = rng.uniform(-2, 2, 300)
    y = 5 * np.exp(-0.7 * x) + np.sin(1.3 * x) + 0.3 * rng.normal(size=300)
    y[::5] += 30 * rng.random(60)  # one in five is of something else
    return x, y


def residual(q: Array, x: Array, y: Array) -> Array:
    return np.asarray(q[0] * np.exp(-q[1] * x) + np.sin(q[2] * x) - y)


def equations(q: Array, x: Array, y: Array) -> Equations:
    derivative = [np.exp(-q[1] * x), -q[0] * x * np.exp(-q[1] * x), x * np.cos(q[2] * x)]
    return Equations.of(residual(q, x, y), np.stack(derivative))


@pytest.mark.parametrize("begin", [[4.0, 0.5, 1.0], [1.0, 1.5, 1.2]])
def test_a_fit_ends_where_scipys_does(begin: list[float]) -> None:
    x, y = problem(np.random.default_rng(0))
    found = cauchy_fit.fitted(lambda q: equations(q, x, y), np.array(begin), 2.0, 100)
    theirs = optimize.least_squares(residual, begin, loss="cauchy", args=(x, y), xtol=1e-12, ftol=1e-12, gtol=1e-12)
    np.testing.assert_allclose(found, theirs.x, atol=1e-5)
    assert np.abs(found - [5.0, 0.7, 1.3]).max() < 0.15


def test_a_fit_asks_no_oftener_than_it_may() -> None:
    x, y = problem(np.random.default_rng(1))
    asked = []

    def counted(q: Array) -> Equations:
        asked.append(q)
        return equations(q, x, y)

    begin = np.array([1.0, 1.5, 1.2])
    found = cauchy_fit.fitted(counted, begin, 2.0, 4)
    assert len(asked) == 4
    assert equations(found, x, y).loss < equations(begin, x, y).loss


def test_a_step_that_leads_to_no_number_is_taken_back() -> None:
    def of(q: Array) -> Equations:
        if q[0] < 0:
            return Equations(float("nan"), np.full(1, np.nan), np.full((1, 1), np.nan))
        return Equations.of(np.array([np.sqrt(q[0]) - 0.1]), np.array([[0.5 / max(np.sqrt(q[0]), 1e-9)]]))

    assert cauchy_fit.fitted(of, np.array([4.0]), 4.0, 60)[0] == pytest.approx(0.01, rel=1e-3)
