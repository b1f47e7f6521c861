"""Whether lights' errors are what their standard deviations say, on drawn rigs without wings; `tools/light_sigmas.py` draws a hundred."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import light_sigmas
from lpcal.chain.refine_lights import FarLight
from lpcal.chain.refine_lights.volume import level_by_source, shading_by_source, volume_points
from lpcal.errors import DegenerateError


def mean_nees(seeds: list[int], *measures: str) -> list[float]:
    """Of the rigs of these seeds, solved without wings."""
    found = []
    for seed in seeds:
        _, errors = light_sigmas.judged(light_sigmas.drawn_as(light_sigmas.plan(seed)), with_wings=False)
        found.append([errors.nees[measure] for measure in measures])
    return list(np.mean(found, axis=0))


@pytest.fixture(autouse=True)
def drawn_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What was drawn before the detection changed is not taken."""
    monkeypatch.setattr(light_sigmas, "CACHE", tmp_path)


@pytest.mark.parametrize("seeds", [[20], pytest.param([7, 10], marks=pytest.mark.slow)])
def test_one_chrome_sphere_alone_says_how_little_it_knows_of_distances(seeds: list[int]) -> None:
    assert 0.3 < mean_nees(seeds, "direction")[0] < 3


@pytest.mark.parametrize("seeds", [[17], pytest.param([6, 8, 22], marks=pytest.mark.slow)])
def test_a_dome_from_chrome_spheres_is_as_sure_as_it_says(seeds: list[int]) -> None:
    direction, position = mean_nees(seeds, "direction", "position")
    assert 0.3 < direction < 2
    assert 0.3 < position < 2


@pytest.mark.parametrize("seeds", [[16], pytest.param([26, 48], marks=pytest.mark.slow)])
def test_free_lights_say_how_well_matte_spheres_tell_their_irradiance(seeds: list[int]) -> None:
    assert 0.2 < mean_nees(seeds, "irradiance")[0] < 2.5


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_what_a_sources_place_changes(seed: int) -> None:
    rng, step = np.random.default_rng(seed), 1e-6
    source, place = rng.normal(size=3) * 0.1 + [0, 0, 0.1], rng.normal(size=3) * 0.02 + [0, 0, 0.4]
    normal = source - place + rng.normal(size=3) * 0.1
    normal /= np.linalg.norm(normal)

    def level(x: np.ndarray) -> float:
        return float(-2 * np.log(np.linalg.norm(x - place)))

    def shading(x: np.ndarray) -> float:
        return float(np.log(normal @ (x - place)) - 3 * np.log(np.linalg.norm(x - place)))

    slopes = [[(f(source + d) - f(source - d)) / (2 * step) for d in step * np.eye(3)] for f in (level, shading)]
    np.testing.assert_allclose(level_by_source(source, place), slopes[0], rtol=1e-6)
    np.testing.assert_allclose(shading_by_source(source, place, normal), slopes[1], rtol=1e-6)


@pytest.mark.parametrize("focus_m", [0.3, 0.5, 1.2])
def test_a_light_of_unknown_distance_says_what_that_leaves_over_the_volume(focus_m: float) -> None:
    """Against lights drawn at every distance, the spheres anywhere in a volume like that of the points."""
    rng = np.random.default_rng(3)
    d, points_C = np.array([0.3, 0.4, -np.sqrt(0.75)]), volume_points(np.array([0, 0, focus_m]))
    stated = FarLight(d, 0.0, None, points_C.mean(axis=0), 0.02 / focus_m, 1)
    turned, level = [], []
    for nearness in rng.normal(size=400) * 0.02 / focus_m:
        seen_from = points_C[rng.integers(len(points_C))]
        away = points_C - seen_from
        ray = d - nearness * away
        turned.append(np.sum(np.cross(ray, d) ** 2, axis=1) / np.sum(ray**2, axis=1) / 2)
        level.append((2 * np.log(np.linalg.norm(ray, axis=1))) ** 2)
    assert stated.std_over(points_C) == pytest.approx(np.sqrt(np.mean(turned)), rel=0.15)
    assert stated.level_std_over(points_C) == pytest.approx(np.sqrt(np.mean(level)), rel=0.15)


def test_a_rig_that_is_refused_does_not_end_the_others(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def refused(plan: light_sigmas.Plan) -> light_sigmas.Drawn:
        raise DegenerateError("1.25 m away", where=f"rig {plan.seed}")

    monkeypatch.setattr(light_sigmas, "drawn_as", refused)
    light_sigmas.main(3, 5)
    said = capsys.readouterr().out
    assert "refused: 3" in said
    assert "rig 7" in said
