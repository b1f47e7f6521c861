"""Whether lights' errors are what their standard deviations say, on drawn rigs without wings; `tools/light_sigmas.py` draws a hundred."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import light_sigmas


def mean_nees(seeds: list[int], *measures: str) -> list[float]:
    """Of the rigs of these seeds, solved without wings."""
    found = []
    for seed in seeds:
        judged = light_sigmas.judged(light_sigmas.drawn_as(light_sigmas.plan(seed)), with_wings=False)
        assert judged is not None
        found.append([judged[1].nees[measure] for measure in measures])
    return list(np.mean(found, axis=0))


@pytest.fixture(autouse=True)
def drawn_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What was drawn before the detection changed is not taken."""
    monkeypatch.setattr(light_sigmas, "CACHE", tmp_path)


@pytest.mark.parametrize("seeds", [[20], pytest.param([7, 10, 20], marks=pytest.mark.slow)])
def test_one_chrome_sphere_alone_says_how_little_it_knows_of_distances(seeds: list[int]) -> None:
    assert 0.3 < mean_nees(seeds, "direction")[0] < 3


@pytest.mark.parametrize("seeds", [[17], pytest.param([6, 8, 17, 22], marks=pytest.mark.slow)])
def test_a_dome_from_chrome_spheres_is_as_sure_as_it_says(seeds: list[int]) -> None:
    direction, position = mean_nees(seeds, "direction", "position")
    assert 0.3 < direction < 2
    assert 0.3 < position < 2
