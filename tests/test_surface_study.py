"""``lpcal study``: what the two experiments must find."""

from __future__ import annotations

import json
from dataclasses import replace

import cv2
import numpy as np

from lpcal.pipeline.study import AMBIENT_PEAK, PAPER, trial


def test_wide_enough_and_not_too_wide():
    at = {angle: trial(replace(PAPER, phase_deg=angle)).mean for angle in (8, 34, 80)}
    assert at[34] < 0.5 * min(at[8], at[80])


def test_plain_least_squares_wants_lights_nearer_to_the_axis():
    angles = np.array([17.0, 23.0, 30.0, 38.0, 48.0])
    plain = [trial(replace(PAPER, phase_deg=float(angle)), plain=True).mean for angle in angles]
    own = [trial(replace(PAPER, phase_deg=float(angle))).mean for angle in angles]
    assert angles[np.argmin(plain)] <= 30 <= angles[np.argmin(own)]
    assert own[-1] < 0.5 * plain[-1]


def test_noise_costs_and_bits_help():
    assert trial(replace(PAPER, noise=0.02)).mean > 3 * trial(PAPER).mean > 9 * trial(replace(PAPER, bits=12)).mean


def test_ambient_light_ruins_once_pixels_saturate():
    dark, lit, burnt = (trial(replace(PAPER, peak=AMBIENT_PEAK, ambient=level)).mean for level in (0.0, 0.2, 0.95))
    assert lit < 1.3 * dark
    assert not burnt < 10 * dark


def test_the_command_writes_table_plot_and_a_sentence(lpcal, tmp_path):
    code, told, wrong = lpcal("study", "ambient", "-o", tmp_path, "--json", cwd=tmp_path)
    assert code == 0, wrong
    document = json.loads(told)
    assert "saturate" in document["says"]
    table = (tmp_path / "study_ambient.csv").read_text().splitlines()
    assert len(table) == 22
    assert cv2.imread(str(tmp_path / "study_ambient.png")).std() > 5
