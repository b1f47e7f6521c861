"""The surface's solvers against what is known exactly: shading, multigrid, integration, normals with outliers."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse.linalg import spsolve

from lpcal.geometry import lambert
from lpcal.integration import multigrid, pieces
from lpcal.integration.integrate import Grid, Own, integrate, settle, steps, system
from lpcal.integration.multigrid import Matrix
from lpcal.kernels.library import SWITCH
from lpcal.records.calibration import Light
from lpcal.shading import normals
from lpcal.surface import self_calibration
from lpcal.view.pixel_list import PixelList


@given(st.integers(0, 10_000))
@settings(max_examples=25, deadline=None)
def test_exact_signals_give_b_back(seed: int) -> None:
    rng = np.random.default_rng(seed)
    B, b = rng.normal(size=(5, 7, 3)), rng.normal(size=(7, 3))
    signal = np.einsum("kpi,pi->kp", B, b)
    found, inverse = lambert.weighted(B, signal, rng.uniform(0.5, 2, (5, 7)))
    assert np.allclose(found, b, atol=1e-6)
    assert np.allclose(inverse, np.swapaxes(inverse, 1, 2))
    assert np.allclose(lambert.three_lights(B, signal, lambert.crosses(B), (0, 2, 4)), b, atol=1e-5)


def test_lights_in_a_plane_give_no_normal() -> None:
    B = np.array([[[1.0, 0, 0]], [[0, 1.0, 0]], [[1.0, 1.0, 0]]])
    assert np.isnan(lambert.weighted(B, np.ones((3, 1)), np.ones((3, 1)))[0]).all()
    assert np.isnan(lambert.three_lights(B, np.ones((3, 1)), lambert.crosses(B), (0, 1, 2))).all()


def disc(size: int) -> np.ndarray:
    row, column = np.indices((size, size))
    mask = (row - size / 2) ** 2 + (column - size / 2) ** 2 < (0.45 * size) ** 2
    mask[size // 3 : size // 3 + 6, size // 3 : size // 3 + 9] = False
    return mask


def test_multigrid_solves_what_a_direct_solver_does() -> None:
    mask = disc(90)
    rng = np.random.default_rng(1)
    grid = Grid.of(mask)
    count = int(mask.sum())
    weight = np.exp(rng.normal(0, 2, len(grid.a)))
    A = Matrix(grid.pyramid, np.full(count, 1e-4), weight)
    right, start = rng.normal(size=(2, count))
    exact = spsolve(A.sparse().tocsc(), right)
    assert np.allclose(A.times(exact), right, atol=1e-6)
    found = multigrid.solve(A, right, start, precision=1e-10, most=400)
    assert np.linalg.norm(found - exact) < 1e-5 * np.linalg.norm(exact)


@pytest.mark.parametrize("by", ["compiled", "numpy"])
def test_breaks_cost_no_cycles(by: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Aggregates that lie over a break tie both of its sides together: that takes 100 cycles and more, and these 20."""
    if by == "numpy":
        monkeypatch.setenv(SWITCH, "numpy")
    row, column = np.indices((120, 120))
    side = (column > 60 + 12 * np.sin(row / 9)).astype(int) + 2 * (row > 60 + 12 * np.sin(column / 7))
    grid = Grid.of(np.ones((120, 120), bool))
    weight = np.where(side[grid.rows[grid.a], grid.columns[grid.a]] == side[grid.rows[grid.b], grid.columns[grid.b]], 1.0, 1e-7)
    right = np.random.default_rng(5).normal(size=len(grid.rows))
    A = Matrix(grid.pyramid, np.full(len(right), 1e-6), weight)
    found = multigrid.solve(A, right, np.zeros(len(right)), most=40)
    assert np.linalg.norm(right - A.times(found)) < 2 * multigrid.PRECISION * np.linalg.norm(right)


def sphere_cap(mask: np.ndarray, focal: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rays, depth and normals of a sphere that fills the mask."""
    row, column = np.nonzero(mask)
    middle = (mask.shape[0] - 1) / 2
    rays = np.stack([(column - middle) / focal, (row - middle) / focal, np.ones(len(row))], axis=1)
    centre, radius = np.array([0, 0, 0.4]), 0.1
    a, b = np.sum(rays**2, axis=1), rays @ centre
    t = (b - np.sqrt(b**2 - a * (centre @ centre - radius**2))) / a
    return rays, t, (t[:, None] * rays - centre) / radius


def test_integration_of_a_spheres_normals_in_a_mask_with_a_hole() -> None:
    mask = disc(100)
    rays, depth, n = sphere_cap(mask, 260.0)
    grid = Grid.of(mask)
    step = steps(grid, n, rays, central=True)
    hold = Own(np.full(len(depth), 1e-6), np.log(depth))
    u, weight = integrate(grid, step, hold, np.full(len(depth), np.log(0.35)), graduated=False)
    error = np.exp(u) - depth
    assert np.abs(error - np.median(error)).max() < 1e-4  # of depths from 0.30 to 0.39 m
    assert weight.min() > 0.3


def test_parallel_rays_give_depth_in_pixels() -> None:
    mask = disc(60)
    row, column = np.nonzero(mask)
    slope_x, slope_y = 0.3, -0.2  # z = 0.3 x - 0.2 y
    n = np.tile(np.array([slope_x, slope_y, -1.0]) / np.sqrt(1 + slope_x**2 + slope_y**2), (len(row), 1))
    grid = Grid.of(mask)
    step = steps(grid, n, np.tile([0.0, 0, 1], (len(row), 1)), central=False)
    u, _ = integrate(grid, step, Own(np.full(len(row), 1e-6), np.zeros(len(row))), np.zeros(len(row)), graduated=False)
    plane = slope_x * column + slope_y * row
    assert np.abs((u - u.mean()) - (plane - plane.mean())).max() < 1e-3


@pytest.mark.parametrize("seed", [0, 1, 2, 3])
def test_a_jump_is_kept_and_parts_the_pieces(seed: int) -> None:
    mask = np.ones((60, 80), bool)
    row, column = np.nonzero(mask)
    rays = np.stack([(column - 39.5) / 300, (row - 29.5) / 300, np.ones(len(row))], axis=1)
    depth = np.where(column < 40, 0.33, 0.36)
    n = np.tile([0.0, 0.0, -1.0], (len(row), 1))
    rng = np.random.default_rng(seed)
    own = Own(np.full(len(row), 1 / 0.1**2), np.log(depth) + rng.normal(0, 0.1, len(row)))  # a tenth a pixel
    grid = Grid.of(mask)
    step = steps(grid, n, rays, central=True)
    u, weight = integrate(grid, step, own, np.full(len(row), np.log(0.345)), graduated=True)
    assert np.median(np.abs(np.exp(u) - depth)) < 0.0015
    weight = pieces.without_slivers(grid, weight, mask)
    u = settle(grid, step, own, u, weight)
    assert np.mean(np.abs(np.exp(u) - depth) > 0.003) < 0.05
    label = pieces.pieces(grid, weight, mask)
    assert set(label) == {1, 2}
    assert (label == 1).sum() == pytest.approx(2400, abs=121)
    assert pieces.break_map(grid, weight, mask)[0][:, 37:42].any(axis=1).all()


def random_sight(rng: np.random.Generator, lights: int, pixels: int, noise: float) -> tuple[PixelList, np.ndarray, np.ndarray]:
    angle = 2 * np.pi * np.arange(lights) / lights
    tilt = 0.5 if lights < 10 else rng.uniform(0.15, 0.7, lights)
    d = np.stack([np.sin(tilt) * np.cos(angle), np.sin(tilt) * np.sin(angle), -np.cos(tilt) * np.ones(lights)], axis=1)
    n = np.concatenate([rng.uniform(-0.35, 0.35, (pixels, 2)), -np.ones((pixels, 1))], axis=1)
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    B = np.repeat(d[:, None], pixels, axis=1)
    signal = np.maximum(np.einsum("kpi,pi->kp", B, n), 0) * rng.uniform(0.3, 0.9, pixels)
    signal = signal + noise * rng.standard_normal(signal.shape)
    rays = np.tile([0.0, 0, 1], (pixels, 1))
    seen = PixelList(np.ones((1, pixels), bool), rays, signal, np.full(signal.shape, noise), np.ones(signal.shape, bool), False)
    return seen, B, n


def angle_deg(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.degrees(2 * np.arcsin(np.clip(np.linalg.norm(a - b, axis=1) / 2, 0, 1)))


@pytest.mark.parametrize("lights", [6, 40])
def test_shadows_and_highlights_do_not_turn_the_normals(lights: int) -> None:
    rng = np.random.default_rng(lights)
    seen, B, n = random_sight(rng, lights, 800, 0.001)
    worst = lights // 6
    shadowed = np.argsort(rng.random(seen.signal.shape), axis=0)
    seen.signal[shadowed < worst] *= 0.02
    seen.signal[(shadowed >= worst) & (shadowed < 2 * worst)] *= 1.6
    E = np.linalg.norm(B, axis=2)
    variance = normals.variances(seen)
    robust = normals.estimate(seen, B, normals.candidates(seen, E), variance)
    plain = lambert.weighted(B, seen.signal, 1 / variance)[0]
    error = angle_deg(lambert.unit(robust.b)[0], n)
    assert np.nanmedian(error) < 1.0
    assert np.nanmean(error) < 0.3 * angle_deg(lambert.unit(plain)[0], n).mean()


def test_the_covariance_of_b_is_honest() -> None:
    rng = np.random.default_rng(7)
    seen, B, n = random_sight(rng, 6, 4000, 0.01)
    albedo = np.sum(seen.signal * np.einsum("kpi,pi->kp", B, n), axis=0) / np.sum(np.einsum("kpi,pi->kp", B, n) ** 2, axis=0)
    truth = np.linalg.norm(n, axis=1)[:, None] * n * albedo[:, None]
    found, covariance = lambert.weighted(B, seen.signal, 1 / seen.sigma**2)
    across = np.cross(n, [0.3, 0.5, 0.8])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    z = np.einsum("pi,pi->p", across, found - truth) / np.sqrt(np.einsum("pi,pij,pj->p", across, covariance, across))
    assert np.mean(z**2) == pytest.approx(1.0, abs=0.1)


def test_filling_is_smooth_and_keeps_what_is_known() -> None:
    mask = np.ones((30, 30), bool)
    grid = Grid.of(mask)
    row, column = np.nonzero(mask)
    values = np.stack([row, column], axis=1).astype(float)
    known = ~((row > 10) & (row < 16) & (column > 10) & (column < 18))
    found = pieces.fill(grid, np.where(known[:, None], values, np.nan), known)
    assert np.array_equal(found[known], values[known])
    assert np.abs(found - values).max() < 0.5


def test_intensities_that_nobody_measured_are_found_from_the_object() -> None:
    rng = np.random.default_rng(11)
    seen, B, _ = random_sight(rng, 12, 3000, 0.002)
    true = rng.uniform(0.6, 1.5, 12)
    true /= true.mean()
    seen.signal[:] *= true[:, None]
    seen.signal[0, :400] *= 0.01  # shadows
    lights = [Light(f"L{k}", direction, np.ones(1)) for k, direction in enumerate(B[:, 0])]
    assert self_calibration.unmeasured(lights)
    assert self_calibration.intensities(seen, lights) == pytest.approx(true, rel=0.01)
    assert self_calibration.intensities(seen, lights[:4]) is None


@pytest.mark.parametrize("seed", [0, 3])
def test_depths_of_much_that_is_broken_do_not_hang_on_rounding(seed: int) -> None:
    """Weights follow from depths, and depths from weights: what a solve leaves of its error chooses which edges break."""
    rng, size = np.random.default_rng(seed), 72
    mask = np.ones((size, size), bool)
    row, column = np.nonzero(mask)
    rays = np.stack([(column - size / 2) / 300, (row - size / 2) / 300, np.ones(len(row))], axis=1)
    true = np.log(0.35) + rng.choice([0.0, 0.1], (size // 12) ** 2)[row // 12 * (size // 12) + column // 12]
    n = lambert.unit(np.array([0.0, 0.0, -1.0]) + rng.normal(0, 0.05, (len(row), 3)))[0]
    own = Own(np.where(rng.uniform(size=len(row)) < 0.3, 2500.0, 1e-6), true + rng.normal(0, 0.02, len(row)))
    grid = Grid.of(mask)
    step = steps(grid, n, rays, central=True)
    begin, found = np.full(len(row), np.log(0.36)), []
    for off in (0.0, 1e-12):
        u, weight = integrate(grid, step, own, begin + off * rng.standard_normal(len(row)), graduated=True)
        found.append(settle(grid, step, own, u, weight))
    assert np.mean(weight < pieces.BREAK_WEIGHT) > 0.01
    assert np.abs(found[1] - found[0]).max() < 1e-6
    A, right = system(grid, weight / step.sigma**2, step.value, own.curvature, own.optimum)
    assert np.abs(found[1] - spsolve(A.sparse().tocsc(), right)).max() < 1e-6
