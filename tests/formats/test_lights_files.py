"""wings.yaml and lights.yaml: read back as written; garbled ones refused in one message."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lpcal.chain.h_pl_wings import design_lights
from lpcal.chain.refine_lights import as_designed
from lpcal.errors import InputError
from lpcal.formats.lights_yaml import read_lights, write_lights
from lpcal.formats.wings_yaml import read_wings, write_wings
from lpcal.records.calibration import SphereFinding, Wing, Wings
from lpcal.records.provenance import Provenance


@pytest.fixture
def wings() -> Wings:
    drawn = [Wing(f"L{k}", k * 1.0, 0.5236, 0.104, 0.085, 19 if k else None) for k in range(3)]
    return design_lights(drawn, np.eye(4), np.diag([1e-6] * 6), np.array([0.01, 0.02, 5e-4, 5e-4]), "a test")


def test_wings_survive_their_file(wings: Wings, tmp_path: Path) -> None:
    write_wings(tmp_path / "wings.yaml", wings, Provenance())
    again = read_wings(tmp_path / "wings.yaml")
    assert [w.name for w in again.wings] == ["L0", "L1", "L2"]
    assert [w.leds for w in again.wings] == [None, 19, 19]
    np.testing.assert_allclose(again.H_CL, wings.H_CL, atol=1e-12)
    np.testing.assert_allclose(again.covariance, wings.covariance, rtol=1e-9)
    np.testing.assert_allclose([w.joint_angle_rad for w in again.wings], 0.5236)


def test_lights_survive_their_file(wings: Wings, tmp_path: Path) -> None:
    solution = as_designed(wings, ["L0", "L2"], 0.1)
    write_lights(tmp_path / "lights.yaml", solution, Provenance())
    again = read_lights(tmp_path / "lights.yaml")
    points_C = np.array([[0.0, 0.01, 0.33]])
    for before, after in zip(solution.lights, again.lights, strict=True):
        np.testing.assert_allclose(after.field(points_C)[1], before.field(points_C)[1], rtol=1e-4)
    assert again.warnings == solution.warnings


def test_what_was_seen_of_spheres_survives_the_file(wings: Wings, tmp_path: Path) -> None:
    outline_px, highlight_px = np.array([[10.0, 20.0], [30.0, 22.0], [19.0, 41.5]]), np.array([21.25, 27.5])
    seen = SphereFinding("a", "chrome", np.array([0, 0, 0.3]), 0.025, True, None, {}, 0.02, outline_px, {"L0": highlight_px}, (640, 480))
    unseen = SphereFinding("b", "matte", None, 0.025, False, "black")
    write_lights(tmp_path / "lights.yaml", replace(as_designed(wings, ["L0"], 0.1), spheres=(seen, unseen)), Provenance())
    first, second = read_lights(tmp_path / "lights.yaml").spheres
    np.testing.assert_allclose(first.outline_px, outline_px)
    np.testing.assert_allclose(first.highlights_px["L0"], highlight_px)
    assert first.image_size == (640, 480)
    assert second.outline_px.shape == (0, 2)
    assert second.image_size is None


@pytest.mark.parametrize(("name", "key", "command"), [("wings", "setting_std", "lpcal wings"), ("lights", "focus_m", "lpcal refine")])
def test_a_garbled_file_is_one_message(wings: Wings, tmp_path: Path, name: str, key: str, command: str) -> None:
    path = tmp_path / f"{name}.yaml"
    if name == "wings":
        write_wings(path, wings, Provenance())
    else:
        write_lights(path, as_designed(wings, ["L0", "L1"], 0.1), Provenance())
    path.write_text(path.read_text().replace(f"{key}:", "other:"))
    with pytest.raises(InputError, match=key) as refused:
        (read_wings if name == "wings" else read_lights)(path)
    assert command in str(refused.value)
