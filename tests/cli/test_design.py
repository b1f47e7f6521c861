"""Wing settings for a working distance."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from lpcal.geometry.wing import d_object
from lpcal.geometry.wing_design import settings_for

SIGMA = np.array([np.radians(0.5), np.radians(1.0), 5e-4, 5e-4])
LENGTHS = (0.060, 0.015, 0.030)
Run = Callable[..., tuple[int, str, str]]


def test_the_papers_setting_comes_out() -> None:
    found = settings_for(0.350, LENGTHS, [0.028923, 0.040], SIGMA)
    at_30 = next(s for s in found if round(float(np.degrees(s.joint_angle_rad))) == 30)
    assert (at_30.disc_spacer_m, at_30.blob_spacer_m) == (0.028923, 0.040)
    assert abs(at_30.d_object_m - 0.350) < 1e-5
    assert abs(np.degrees(at_30.light_angle_rad) - 30) < 0.01
    # 19 LEDs of 35 cd: the middle one and what the others add on the axis, over the distance squared
    assert 500 < at_30.lux < 800


def test_every_setting_meets_the_axis_within_the_slack() -> None:
    for setting in settings_for(0.400, LENGTHS, np.arange(0, 0.11, 0.005).tolist(), SIGMA, slack_m=0.003):
        again = d_object(np.array([0, setting.joint_angle_rad, 0.075 + setting.disc_spacer_m, 0.045 + setting.blob_spacer_m]))
        assert abs(again - 0.400) <= 0.003
        assert 0 < setting.evenness <= 1


def test_the_tolerance_of_the_direction_is_the_spread_of_wings_so_built() -> None:
    from lpcal.geometry.wing import wing_transform

    setting = settings_for(0.350, LENGTHS, [0.028923, 0.040], SIGMA)[0]
    drawn = np.array([0, setting.joint_angle_rad, 0.075 + setting.disc_spacer_m, 0.045 + setting.blob_spacer_m])
    rng = np.random.default_rng(1)
    away = wing_transform(drawn + rng.normal(size=(4000, 4)) * SIGMA)[:, :3, 3] - [0, 0, 0.350]
    d = away / np.linalg.norm(away, axis=1, keepdims=True)
    spread = np.sqrt(np.mean(np.sum((d - d.mean(axis=0)) ** 2, axis=1)) / 2)
    assert spread == pytest.approx(setting.direction_std_rad, rel=0.08)


def test_the_command_lists_them_and_refuses_a_bare_number(lpcal: Run) -> None:
    code, out, _ = lpcal("design", "--distance", "350mm", "--json")
    assert code == 0
    assert {round(np.degrees(s["joint_angle_rad"])) for s in json.loads(out)["settings"]} >= {20, 30}
    code, _, err = lpcal("design", "--distance", "350")
    assert code == 2
    assert "25 mm" in err
    code, _, err = lpcal("design", "--distance", "5 m")
    assert code == 4
    assert "--slack" in err


def test_the_distance_sensor_of_a_panel(lpcal: Run, tmp_path: Path) -> None:
    """Where its beam meets the working distance, and what it reads there; a panel without one is said."""
    panel = tmp_path / "panel.yaml"
    beam = "{position: [30 mm, 0 mm, 10 mm], direction: [-0.1, 0, 1], noise: 3 mm}"
    panel.write_text(f"lpcal: 1\npanel: {{disc_radius: 60 mm, joint: 15 mm, blob: 30 mm, distance_sensor: {beam}}}\n")
    code, out, _ = lpcal("design", "--distance", "350mm", "--rig", str(panel))
    assert code == 0
    assert "distance sensor: reads 341.7 mm at 350 mm, 4.0 mm from the axis, on the object" in out
    assert "to calibrate it: read it at 20 to 30 views" in out
    panel.write_text("lpcal: 1\npanel: {disc_radius: 60 mm, joint: 15 mm, blob: 30 mm}\n")
    assert lpcal("design", "--distance", "350mm", "--rig", str(panel))[0] == 3
