"""``lpcal study``: what the two experiments must find."""

from __future__ import annotations

import json
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

import lpcal
from lpcal.api import studies
from lpcal.api.engines import Lost, engine_of
from lpcal.api.studies import AMBIENT, PAPER, trial
from lpcal.errors import InputError
from lpcal.simulate.captures import Conditions


def test_wide_enough_and_not_too_wide() -> None:
    at = {angle: trial(replace(PAPER, phase_deg=angle)).mean for angle in (8, 34, 80)}
    assert at[34] < 0.5 * min(at[8], at[80])


ANGLES = np.array([14.0, 18.0, 22.0, 26.0, 30.0, 34.0, 40.0, 48.0])


def best(conditions: Conditions, *, plain: bool) -> tuple[float, float, list[float]]:
    errors = [trial(replace(conditions, phase_deg=float(angle)), plain=plain).mean for angle in ANGLES]
    return ANGLES[int(np.argmin(errors))], min(errors), errors


def test_plain_least_squares_is_best_between_20_and_30_degrees_as_in_the_paper() -> None:
    for conditions in (PAPER, replace(PAPER, noise=0.01)):
        assert 20 <= best(conditions, plain=True)[0] <= 30


def test_without_shadows_lights_may_stand_wider() -> None:
    plain, own = best(PAPER, plain=True), best(PAPER, plain=False)
    assert own[0] > plain[0]
    assert own[2][-1] < 0.2 * plain[2][-1]


def test_the_best_angle_moves_with_noise_and_with_the_rim() -> None:
    assert best(replace(PAPER, noise=0.01), plain=True)[0] > best(PAPER, plain=True)[0] > best(replace(PAPER, rim=0.995), plain=True)[0]


def test_ambient_light_lifts_faint_light_over_what_a_sensor_needs() -> None:
    at = [trial(replace(AMBIENT, toe=0.05, ambient=level), plain=True).mean for level in (0.0, 0.2, 0.4)]
    assert at[1] < 0.2 * at[0]
    assert at[1] < 0.2 * at[2]
    plain = [trial(replace(AMBIENT, ambient=level), plain=True).mean for level in (0.0, 0.2)]
    assert plain[0] < 1.2 * plain[1]


def test_noise_costs_and_bits_help() -> None:
    assert trial(replace(PAPER, noise=0.02)).mean > 3 * trial(PAPER).mean > 9 * trial(replace(PAPER, bits=12)).mean


def test_ambient_light_ruins_once_pixels_saturate() -> None:
    dark, lit, burnt = (trial(replace(AMBIENT, ambient=level)).mean for level in (0.0, 0.2, 0.95))
    assert lit < 1.3 * dark
    assert not burnt < 10 * dark


def test_a_study_on_an_executor_finds_the_same_figures() -> None:
    plain = lpcal.study("ambient", at=[0, 97])
    with ThreadPoolExecutor(2) as pool:
        there = lpcal.study("ambient", at=[0, 97], executor=pool)
    for one, other in zip(plain.curves, there.curves, strict=True):
        assert one.name == other.name
        assert np.array_equal(one.mean_percent, other.mean_percent, equal_nan=True)
    assert there.says == plain.says


def test_a_trial_whose_workers_are_lost_ends_the_study(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(studies, "each", lambda work, items, engine: iter([(0, Lost("the worker was killed"))]))
    with pytest.raises(InputError, match="the worker was killed"):
        studies.study_on(engine_of("processes", 1), "ambient", [0.0])


@pytest.mark.slow
def test_the_command_writes_table_plot_and_a_sentence(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    code, told, wrong = lpcal("study", "ambient", "-o", tmp_path, "--json", "--jobs", "2", cwd=tmp_path)
    assert code == 0, wrong
    document = json.loads(told)
    assert "saturate" in document["says"]
    table = (tmp_path / "study_ambient.csv").read_text().splitlines()
    assert len(table) == 22
    assert cv2.imread(str(tmp_path / "study_ambient.png")).std() > 5
