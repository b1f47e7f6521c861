"""The four roles, each a script of examples/ of at most 25 lines: it runs, and what it finds is right."""

from __future__ import annotations

import os
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
CLEAN = """
import importlib.metadata, importlib.util, re, runpy, sys
wanted, allowed = ["lpcal"], set()
while wanted:
    name = re.match(r"[A-Za-z0-9._-]+", wanted.pop()).group().lower().replace("_", "-")
    if name in allowed:
        continue
    allowed.add(name)
    try:
        requirements = importlib.metadata.requires(name) or []
    except importlib.metadata.PackageNotFoundError:
        continue
    wanted += [each for each in requirements if "extra ==" not in each]
owners = importlib.metadata.packages_distributions()
class Refused:
    def find_spec(self, name, path=None, target=None):
        of = {each.lower().replace("_", "-") for each in owners.get(name, [])}
        if of and not of & allowed:
            raise ModuleNotFoundError(f"{name} is not among lpcal's dependencies", name=name)
sys.meta_path.insert(0, Refused())
try:
    import pytest
except ModuleNotFoundError:
    runpy.run_path(sys.argv[1])
"""
"""Runs a script with only the packages that lpcal's metadata require: those that the tests or an extra add are refused."""


def run(name: str) -> dict[str, Any]:
    return runpy.run_path(str(REPOSITORY / "examples" / f"{name}.py"))


def test_all_roles_are_there() -> None:
    assert {path.stem for path in EXAMPLES} == {"add_a_mocap_format", "dome_to_normals", "handeye_from_arrays", "reconstruct_a_stack"}


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_is_short(path: Path) -> None:
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line.strip()]
    assert len(lines) <= MOST_LINES


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs_in_a_clean_environment(path: Path, tmp_path: Path) -> None:
    """In an empty folder, with no variable of the environment but the path and the home, without the packages of the tests."""
    alone = {name: os.environ[name] for name in ("PATH", "SYSTEMROOT") if name in os.environ} | {"HOME": str(tmp_path)}
    found = subprocess.run(
        [sys.executable, "-I", "-c", CLEAN, str(path)], cwd=tmp_path, env=alone, capture_output=True, text=True, check=False
    )
    assert (found.returncode, found.stderr) == (0, ""), found.stderr
    assert len(found.stdout.splitlines()) > 1


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
