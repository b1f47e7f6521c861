"""The breaks of a depth lie where they cost least: sets of pixels jump, found as the cheapest cut."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from lpcal.geometry.arrays import Array
from lpcal.integration import cuts
from lpcal.integration.integrate import Grid, Own, Steps, integrate, settle, weights_of
from lpcal.integration.jumps import jumped
from lpcal.integration.pieces import BREAK_WEIGHT

ROWS, COLUMNS, JUMP = 60, 80, 0.1
OWN = 100.0


@pytest.mark.parametrize("seed", range(6))
def test_no_set_of_pixels_is_cheaper(seed: int) -> None:
    rng = np.random.default_rng(seed)
    grid = Grid.of(rng.random((3, 5)) < 0.85)
    taken, parted = rng.standard_normal(len(grid.rows)), rng.exponential(0.5, len(grid.a))

    def cost(some: Array) -> float:
        return float(taken[some].sum() + parted[some[grid.a] != some[grid.b]].sum())

    every = (np.array(some) for some in product((False, True), repeat=len(taken)))
    assert cost(cuts.cheapest(grid, taken, parted)) == pytest.approx(min(map(cost, every)), abs=1e-4)


def two_halves(seed: int) -> tuple[Grid, Steps, Own, Array]:
    """Two flat halves, the right one JUMP further away; steps and distances of pixels with noise."""
    rng = np.random.default_rng(seed)
    grid = Grid.of(np.ones((ROWS, COLUMNS), bool))
    u = JUMP * (grid.columns >= COLUMNS // 2)
    step = Steps(0.002 * rng.standard_normal(len(grid.a)), np.full(len(grid.a), 0.003), np.ones(len(grid.a)))
    return grid, step, Own(np.full(len(u), OWN), u + rng.standard_normal(len(u)) / np.sqrt(OWN)), u


def settled(grid: Grid, step: Steps, own: Own, u: Array) -> Array:
    for _ in range(30):
        u = settle(grid, step, own, u, weights_of(grid, u, step))
    return u


@pytest.mark.parametrize("seed", range(4))
def test_a_break_that_runs_half_way_and_then_astray_is_put_where_it_belongs(seed: int) -> None:
    grid, step, own, truth = two_halves(seed)
    down = grid.rows >= ROWS // 2
    astray = JUMP * np.where(down, grid.columns >= COLUMNS // 4, grid.columns >= COLUMNS // 2)
    stuck = settled(grid, step, own, astray)
    assert np.abs(stuck - truth)[down].max() > JUMP / 2  # weights that follow residuals stay where they begin
    found, weight = jumped(grid, step, own, stuck)
    assert np.sqrt(np.mean((found - truth) ** 2)) < 0.1 * JUMP
    crosses = grid.horizontal & (grid.columns[grid.a] == COLUMNS // 2 - 1)
    assert np.mean((weight <= BREAK_WEIGHT) == crosses) > 0.999


@pytest.mark.parametrize("seed", range(4))
def test_what_is_whole_stays_whole(seed: int) -> None:
    grid, step, own, truth = two_halves(seed)
    whole = Own(own.curvature, own.optimum - truth)
    u = settled(grid, step, whole, np.zeros(len(truth)))
    found, weight = jumped(grid, step, whole, u)
    assert np.array_equal(found, u)
    assert weight.min() > BREAK_WEIGHT


def test_a_part_that_only_its_distances_hold_apart_returns_where_the_break_costs_more() -> None:
    grid, step, _, _ = two_halves(0)
    small = (np.abs(grid.rows - 30) < 4) & (np.abs(grid.columns - 20) < 4)
    flat = Own(np.full(len(small), OWN), np.random.default_rng(1).standard_normal(len(small)) / np.sqrt(OWN))
    found, weight = jumped(grid, step, flat, settled(grid, step, flat, 0.04 * small))
    assert np.abs(found).max() < 0.02
    assert weight.min() > BREAK_WEIGHT


@pytest.mark.parametrize(("break_cost", "whole"), [(1.0, False), (26.0, True)])
def test_distances_that_err_alike_break_a_surface_only_where_breaks_are_cheap(break_cost: float, whole: bool) -> None:
    """Pixels of a square share an error of their distances, as under interreflection that is not modelled."""
    grid, step, _, _ = two_halves(0)
    square = (np.abs(grid.rows - 30) < 10) & (np.abs(grid.columns - 20) < 10)
    noise = np.random.default_rng(2).standard_normal(len(square))
    own = Own(np.full(len(square), OWN), 0.15 * square + noise / np.sqrt(OWN))
    step = replace(step, break_cost=np.full(len(grid.a), break_cost))
    u, _ = integrate(grid, step, own, np.zeros(len(square)), graduated=True)
    _, weight = jumped(grid, step, own, u)
    assert (weight.min() > BREAK_WEIGHT) == whole
