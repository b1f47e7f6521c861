"""The four roles, each a script of examples/ of at most 25 lines: it runs, and what it finds is right."""

from __future__ import annotations

import runpy
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lpcal

REPOSITORY = Path(__file__).resolve().parents[2]
EXAMPLES = sorted((REPOSITORY / "examples").glob("*.py"))
MOST_LINES = 25


def run(name: str) -> dict[str, Any]:
    return runpy.run_path(str(REPOSITORY / "examples" / f"{name}.py"))


def test_all_roles_are_there() -> None:
    assert {path.stem for path in EXAMPLES} == {"add_a_mocap_format", "dome_to_normals", "handeye_from_arrays", "reconstruct_a_stack"}


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_is_short(path: Path) -> None:
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line.strip()]
    assert len(lines) <= MOST_LINES


def test_examples_are_clean() -> None:
    found = subprocess.run(
        [sys.executable, "-m", "ruff", "check", "--no-cache", "examples"], cwd=REPOSITORY, capture_output=True, text=True, check=False
    )
    assert found.returncode == 0, found.stdout


def test_handeye_from_arrays(capsys: pytest.CaptureFixture[str]) -> None:
    names = run("handeye_from_arrays")
    found, session = names["found"], names["session"]
    off = np.linalg.inv(session.H_PC) @ found.H_PC
    assert names["off_mm"] < 1.0
    assert np.degrees(np.arccos((np.trace(off[:3, :3]) - 1) / 2)) < 0.2
    assert "HandEye: the tracked body carries the camera" in capsys.readouterr().out


def test_dome_to_normals() -> None:
    names = run("dome_to_normals")
    found = lpcal.evaluate(names["surface"], names["normals"] * names["vase"][..., None])
    assert found.normal_p95_deg < 0.3
    directions_C = np.array([light.direction_C for light in names["dome"].lights])
    assert np.degrees(np.arccos(np.sum(directions_C * names["S"], axis=1).min())) < 0.3


def test_reconstruct_a_stack() -> None:
    names = run("reconstruct_a_stack")
    found = lpcal.evaluate(names["surface"], names["normals"] * names["ball"][..., None], depth=names["points"][..., 2])
    assert found.normal_mean_deg < 0.5
    assert found.depth_rms_m < 1e-4


def test_add_a_mocap_format(monkeypatch: pytest.MonkeyPatch) -> None:
    from lpcal.formats import mocap_added

    monkeypatch.setattr(mocap_added, "ADDED", {})
    names = run("add_a_mocap_format")
    stream = lpcal.read_mocap(names["path"])
    np.testing.assert_allclose(stream.H_OP[:, 0, 3], 0.001 * np.arange(200))
    assert list(mocap_added.ADDED) == ["our lab's"]
