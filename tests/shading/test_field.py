"""Normals of all pixels together, against a sphere whose samples are hidden, few or glossy by construction."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.integration.integrate import Grid
from lpcal.kernels.library import SWITCH, kernel
from lpcal.shading import field, gloss, normals
from lpcal.view.pixel_list import Illumination, PixelList

SIZE = 70
ALBEDO = 0.5
VIEW = np.array([0.0, 0.0, -3.0])


def ball(lights: int, *, seed: int = 0, shine: tuple[float, float] | None = None) -> tuple[PixelList, Illumination, Array, Array]:
    """A sphere far away under distant lights of 35 degrees: what is seen, the light, normals (P, 3) and signals without noise (L, P)."""
    row, column = np.indices((SIZE, SIZE)).reshape(2, -1)
    x, y = (column - SIZE / 2) / (0.45 * SIZE), (row - SIZE / 2) / (0.45 * SIZE)
    inside = x**2 + y**2 < 0.95
    n = np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0))], axis=1)[inside]
    angle, slant = 2 * np.pi * np.arange(lights) / lights + 0.2, np.radians(35)
    to = np.stack([np.sin(slant) * np.cos(angle), np.sin(slant) * np.sin(angle), np.full(lights, -np.cos(slant))], axis=1)
    d = np.repeat(to[:, None], len(n), axis=1)
    lit = Illumination(d, np.ones((lights, len(n))))
    clean = ALBEDO * np.maximum(np.einsum("kpi,pi->kp", d, n), 0)
    if shine is not None:
        clean = clean + shine[0] * gloss.lobe(d, n, np.tile([0.0, 0.0, -1.0], (len(n), 1)), shine[1])
    signal = clean + 2e-3 * np.random.default_rng(seed).standard_normal(clean.shape)
    rays = np.tile([0.0, 0.0, 1.0], (len(n), 1))
    mask = inside.reshape(SIZE, SIZE)
    return PixelList(mask, rays, signal, np.full(signal.shape, 2e-3), np.ones(signal.shape, bool), True), lit, n, clean


def found(
    seen: PixelList, lit: Illumination, *, hidden: Mask | None = None, glossy: float | None = None
) -> tuple[field.Field, normals.Estimate]:
    alone = normals.estimate(seen, lit.B, normals.candidates(seen, lit.E), normals.variances(seen))
    return field.solve(seen, Grid.of(seen.mask), lit, hidden, alone, glossy), alone


def errors_deg(b: Array, n: Array) -> Array:
    return np.degrees(np.arccos(np.clip(np.sum(lambert.unit(b)[0] * n, axis=1), -1, 1)))


@pytest.mark.parametrize("lights", [4, 6, 12])
def test_a_pixel_that_many_lights_reach_stays_as_it_is(lights: int) -> None:
    seen, lit, n, clean = ball(lights)
    whole, alone = found(seen, lit)
    many = np.sum(clean > 0.02, axis=0) == lights
    assert np.median(errors_deg(whole.b, n)[many]) <= 1.02 * np.nanmedian(errors_deg(alone.b, n)[many])
    bias = np.mean(lambert.unit(whole.b)[0] - n, axis=0)
    assert np.linalg.norm(bias) < np.radians(0.3)


@pytest.mark.parametrize("shine", [None, (0.2, 0.15)])
def test_rounds_end_where_the_rest_would_change_nothing(shine: tuple[float, float] | None, monkeypatch: pytest.MonkeyPatch) -> None:
    seen, lit, _, _ = ball(6, shine=shine)
    count, gathered = [0], field._gathered

    def counted(*given: Any) -> tuple[Array, Array]:
        count[0] += 1
        return gathered(*given)

    monkeypatch.setattr(field, "_gathered", counted)
    early = found(seen, lit, glossy=0.5)[0]
    taken = count[0]
    monkeypatch.setattr(field, "STILL", -1.0)
    late = found(seen, lit, glossy=0.5)[0]
    assert count[0] - taken == field.FIRST_ROUNDS + field.GLOSS_ROUNDS
    assert taken <= field.FIRST_ROUNDS + field.GLOSS_ROUNDS
    np.testing.assert_allclose(early.b, late.b, atol=5e-2 * np.median(np.linalg.norm(late.b, axis=1)))
    assert (early.gloss is None) == (late.gloss is None) == (shine is None)
    if early.gloss is not None and late.gloss is not None:
        assert [early.gloss.ks, early.gloss.roughness] == pytest.approx([late.gloss.ks, late.gloss.roughness], rel=1e-3)
    if shine is None:
        assert taken < 12


@pytest.mark.parametrize("left", [(0, 1), (0, 3), (2, 4)])
def test_a_strip_that_two_lights_reach_is_told_by_its_neighbours(left: tuple[int, int]) -> None:
    seen, lit, n, _ = ball(6)
    strip = np.abs(n[:, 0] - 0.2) < 0.1
    signal = seen.signal.copy()
    dark = np.setdiff1d(np.arange(6), left)
    signal[np.ix_(dark, np.flatnonzero(strip))] *= 0.02
    whole, _ = found(replace(seen, signal=signal), lit)
    assert np.median(errors_deg(whole.b, n)[strip]) < 4
    assert np.median(errors_deg(whole.b, n)[~strip]) < 0.5


def half_shadowed(monkeypatch: pytest.MonkeyPatch, friends: float) -> float:
    """Mean error, degrees, in a line of two pixels where a shadow of four of six lights begins and each sample keeps what it happens to."""
    monkeypatch.setattr(field, "FRIENDS", friends)
    seen, lit, n, clean = ball(6)
    row = np.nonzero(seen.mask)[0]
    line, beyond = (row == 40) | (row == 41), row > 41
    kept = np.where(beyond, 0.0, np.where(line, np.random.default_rng(3).uniform(0.2, 0.9, (6, len(n))), 1.0))
    kept[:2] = 1.0
    whole, _ = found(replace(seen, signal=seen.signal - clean * (1 - kept)), lit)
    return float(errors_deg(whole.b, n)[line].mean())


def test_where_a_shadow_ends_the_neighbours_begin(monkeypatch: pytest.MonkeyPatch) -> None:
    assert half_shadowed(monkeypatch, field.FRIENDS) < 0.7 * half_shadowed(monkeypatch, 0.0)


def test_a_shadow_lit_from_around_is_no_dark_matter() -> None:
    """Inside a dark patch a tenth of the light is left, as if all lights reached matter of a tenth of the albedo turned elsewhere."""
    seen, lit, n, _ = ball(6)
    patch = (np.abs(n[:, 0]) < 0.25) & (np.abs(n[:, 1] - 0.3) < 0.2)
    around = np.array([0.0, 0.9, -0.43])
    signal = seen.signal.copy()
    signal[:, patch] = 0.08 * ALBEDO * np.maximum(n[patch] @ around, 0) + 0.002 * np.random.default_rng(1).standard_normal((6, patch.sum()))
    whole, alone = found(replace(seen, signal=signal), lit)
    ours, theirs = (np.mean(np.nan_to_num(errors_deg(b, n)[patch], nan=90.0)) for b in (whole.b, alone.b))
    assert ours < 8
    assert ours < 0.5 * theirs


def test_gloss_is_found_and_taken_off() -> None:
    seen, lit, n, _ = ball(6, shine=(0.15, 0.19))
    whole, alone = found(seen, lit, glossy=0.5)
    assert whole.gloss is not None
    assert whole.gloss.clear
    assert np.mean(errors_deg(whole.b, n)) < 0.8 * np.mean(errors_deg(alone.b, n))


@pytest.mark.parametrize(("lights", "F0", "roughness"), [(6, 0.03, 0.12), (6, 0.06, 0.3), (8, 0.045, 0.2), (12, 0.045, 0.35)])
def test_strength_and_roughness_of_the_gloss_are_those_drawn(lights: int, F0: float, roughness: float) -> None:
    seen, lit, _, _ = ball(lights, shine=(F0 * np.pi * ALBEDO / 0.5, roughness))
    whole, _ = found(seen, lit, glossy=0.5)
    assert whole.gloss is not None
    assert abs(np.log(whole.gloss.ks / (F0 * np.pi * ALBEDO / 0.5))) < 0.25
    assert abs(np.log(whole.gloss.roughness / roughness)) < 0.1


@pytest.mark.parametrize("roughness", [0.1, 0.3])
def test_how_a_lobe_turns_with_the_normal_is_its_derivative(roughness: float) -> None:
    rng, step = np.random.default_rng(0), 1e-5
    n, d, v = (
        lambert.unit(rng.normal(size=shape) + toward)[0] for shape, toward in (((50, 3), VIEW), ((4, 50, 3), VIEW), ((50, 3), 2 * VIEW))
    )
    along = lambert.unit(np.cross(n, rng.normal(size=(50, 3))))[0]
    more, less = (gloss.lobe(d, lambert.unit(n + sign * step * along)[0], v, roughness) for sign in (1, -1))
    found = np.einsum("kpi,pi->kp", gloss.turned(d, n, v, roughness), along)
    facing = (np.einsum("kpi,pi->kp", d, n) > 0.02) & (np.sum(v * n, axis=1) > 0.07)
    assert np.allclose(found[facing], ((more - less) / (2 * step))[facing], rtol=1e-4, atol=1e-5)
    assert np.abs(found).max() > 1


def test_where_there_is_no_gloss_next_to_none_is_taken_off() -> None:
    seen, lit, _, _ = ball(6)
    whole, _ = found(seen, lit, glossy=0.5)
    assert whole.gloss is None or not whole.gloss.clear
    assert whole.estimate.gloss is None or np.abs(whole.estimate.gloss).max() < 0.02 * ALBEDO


def test_a_tenth_of_the_noise_moves_no_normal_far() -> None:
    seen, lit, _, clean = ball(4)
    shake = 2e-4 * np.random.default_rng(9).standard_normal(clean.shape)
    one, _ = found(seen, lit)
    other, _ = found(replace(seen, signal=seen.signal + shake), lit)
    moved = errors_deg(one.b, lambert.unit(other.b)[0])
    assert np.quantile(moved, 0.99) < 0.5


def test_a_normal_is_as_sure_as_its_samples() -> None:
    """`tilt_rad`: the scatter of normals over many draws of the noise where many lights reach; in the dark next to nothing is known."""
    seen, lit, _, clean = ball(6)
    many, none = np.sum(clean > 0.02, axis=0) == 6, np.zeros(seen.pixels, bool)
    none[np.flatnonzero(many)[:40]] = True
    signal = np.where(none, 0.0, clean)

    def drawn(seed: int) -> field.Field:
        noisy = signal + 2e-3 * np.random.default_rng(seed).standard_normal(clean.shape)
        return found(replace(seen, signal=noisy), lit)[0]

    fields = [drawn(seed) for seed in range(12)]
    bright = many & ~none
    unit = np.stack([lambert.unit(one.b)[0] for one in fields])
    scatter = np.sqrt(np.sum(np.var(unit, axis=0, ddof=1), axis=1) / 2)[bright]
    tilt = fields[0].tilt_rad
    assert tilt is not None
    assert np.all(tilt[bright] < 0.06)
    assert 0.5 * np.median(scatter) < np.median(tilt[bright])
    assert np.percentile(scatter / tilt[bright], 90) < 1.2
    assert np.median(tilt[none]) > 3 * np.median(tilt[bright])


def test_a_normal_that_one_strong_sample_holds_is_open_across_it_and_no_more_than_the_prior() -> None:
    """However strong the sample is: of the two axes across the normal it says nothing of one, and all of the other."""
    n = np.array([0.0, 0.6, -0.8])
    light = np.array([0.0, -0.8, -0.6])  # square to the normal: it turns the normal about one axis alone
    for albedo in (1.0, 1e4, 1e8):
        own = np.einsum("i,j->ij", light, light)[None] / 1e-6
        tilt = field._tilt_rad(albedo * n[None], own)
        assert tilt[0] == pytest.approx(field.ANY_RAD / np.sqrt(2), rel=1e-3), albedo


@pytest.mark.parametrize("by", ["kernels", "numpy"])
def test_pixels_whose_albedo_has_run_away_leave_the_others_their_solution(by: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The matrices of an albedo of 1e-10 are 1e20 times those of others: against a direct solve of every pixel in units of its own."""
    if by == "kernels" and kernel("coupled") is None:
        pytest.skip("kernels not compiled")
    monkeypatch.setenv(SWITCH, by)
    rng = np.random.default_rng(0)
    grid = Grid.of(np.ones((30, 40), bool))
    scale = np.where((grid.rows < 10) & (grid.columns < 10), 1e-10, 1.0)
    b = scale[:, None] * (np.array([0.1, 0.2, -0.9]) + 0.05 * rng.normal(size=(len(scale), 3)))
    B = rng.normal(size=(len(scale), 2, 3)) / scale[:, None, None]  # two samples a pixel leave the third direction to its neighbours
    system = field._System.at(grid, b, np.einsum("pki,pkj->pij", B, B))
    right = system.times(b)
    found = system.solved(right, b * rng.uniform(0.5, 1.5, size=b.shape))
    assert np.abs((found - b) / scale[:, None]).max() < 1e-5
