"""Other minima of the field's energy: found where a field is at a wrong one, and taken where its normals make a surface."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.integration.integrate import Grid, Own, integrate, steps
from lpcal.shading import field, normals, search
from lpcal.shading.palette import Palette
from lpcal.surface import minima
from lpcal.view.sight import Lit, Sight

SIZE = 48
ALBEDO = 0.5


def waves(lights: int) -> tuple[Sight, Lit, Grid, Array, Array]:
    """A wavy surface a metre away under distant lights of 35 degrees, in pixels of a millimetre: sight, light, grid, b (P, 3), log z."""
    row, column = np.indices((SIZE, SIZE)).reshape(2, -1)
    rays = np.stack([(column - SIZE / 2) / 1000, (row - SIZE / 2) / 1000, np.ones(SIZE**2)], axis=1)
    x, y = rays[:, 0], rays[:, 1]
    z = 1 + 0.003 * np.sin(300 * x) * np.cos(260 * y)
    slope_x, slope_y = 0.9 * np.cos(300 * x) * np.cos(260 * y), -0.78 * np.sin(300 * x) * np.sin(260 * y)
    n = lambert.unit(np.stack([slope_x, slope_y, -np.ones(len(x))], axis=1))[0]
    angle, slant = 2 * np.pi * np.arange(lights) / lights + 0.2, np.radians(35)
    to = np.stack([np.sin(slant) * np.cos(angle), np.sin(slant) * np.sin(angle), np.full(lights, -np.cos(slant))], axis=1)
    d = np.repeat(to[:, None], len(n), axis=1)
    lit = Lit(d, np.ones((lights, len(n))))
    signal = ALBEDO * np.maximum(np.einsum("kpi,pi->kp", d, n), 0)
    signal = signal + 2e-3 * np.random.default_rng(3).standard_normal(signal.shape)
    seen = Sight(np.ones((SIZE, SIZE), bool), rays, signal, np.full(signal.shape, 2e-3), np.ones(signal.shape, bool), True)
    return seen, lit, Grid.of(seen.mask), ALBEDO * n, np.log(z)


def patch(low: int, high: int) -> Mask:
    row, column = np.indices((SIZE, SIZE)).reshape(2, -1)
    return (row >= low) & (row < high) & (column >= low) & (column < high)


def turned(b: Array, angle_deg: float) -> Array:
    """b (P, 3) turned about the columns' axis."""
    c, s = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
    return b @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]]).T


def errors_deg(b: Array, n: Array) -> Array:
    return np.degrees(np.arccos(np.clip(np.sum(lambert.unit(b)[0] * lambert.unit(n)[0], axis=1), -1, 1)))


def solved(seen: Sight, lit: Lit, grid: Grid) -> field.Field:
    """The field that starts from single pixels."""
    alone = normals.estimate(seen, lit.B, normals.candidates(seen, lit.E), normals.variances(seen))
    return field.solve(seen, grid, lit, None, alone)


def costs_of(seen: Sight, lit: Lit, b: Array) -> search.Costs:
    return search.Costs(seen, lit, None, None, Palette.of(b, np.zeros(len(b)), np.zeros(len(b)), 0.05))


@pytest.mark.parametrize("lights", [4, 8])
def test_a_wrong_minimum_is_left(lights: int) -> None:
    seen, lit, grid, b, _ = waves(lights)
    wrong = patch(14, 34)
    begin = np.where(wrong[:, None], 1.5 * turned(b, 50), b)
    costs = costs_of(seen, lit, b)
    found = search.propose(costs, grid, begin)
    before, after, truth = (search.energy(costs, grid, one).sum() for one in (begin, found, b))
    assert after - truth < 0.1 * (before - truth)
    assert np.median(errors_deg(found, b)[wrong]) < 5
    assert np.median(errors_deg(begin, b)[wrong]) > 40
    assert np.median(errors_deg(found, b)[~wrong]) < 1


def test_what_explains_its_samples_stays_to_the_last_bit() -> None:
    seen, lit, grid, b, _ = waves(6)
    assert np.array_equal(search.propose(costs_of(seen, lit, b), grid, b), b)


def test_a_region_is_taken_where_its_normals_make_a_surface(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of two regions that samples prefer, by decree, the one that turns towards the surface is taken, not the one that turns away."""
    seen, lit, grid, b, u = waves(6)
    right, wrong = patch(6, 18), patch(28, 40)
    before = np.where(right[:, None], turned(b, 40), b)
    proposal = np.where(wrong[:, None], turned(b, 40), b)
    own = Own(np.full(len(u), 1.0), u)
    depth, _ = integrate(grid, *steps(grid, lambert.unit(before)[0], seen.rays_C, central=True), own, u, graduated=False)
    start = replace(solved(seen, lit, grid), b=before)
    monkeypatch.setattr(search, "propose", lambda *_: proposal)
    monkeypatch.setattr(field, "solve", lambda *given, **_: given[4])
    monkeypatch.setattr(search, "energy", lambda _costs, _grid, at: errors_deg(at, proposal))
    taken = minima.another_minimum(grid, costs_of(seen, lit, b), own, depth, start)
    assert taken is not None
    assert np.mean(errors_deg(taken.b, b)[right] < 1) > 0.9
    assert np.mean(errors_deg(taken.b, b)[wrong] < 1) > 0.9


def test_nothing_to_take_is_said() -> None:
    seen, lit, grid, _, u = waves(6)
    start = solved(seen, lit, grid)
    assert minima.another_minimum(grid, costs_of(seen, lit, start.b), Own(np.ones(len(u)), u), u, start) is None
