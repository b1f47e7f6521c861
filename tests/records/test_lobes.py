"""A kind of lobe is one function: files, light field and report follow it."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lpcal
from lpcal.geometry.light_field import FORMULAS
from lpcal.records.calibration import Lobe
from lpcal.report.page import lights_section
from lpcal.report.scene import half_angle
from report_rig import documents, report_of

LAMP = lpcal.Light("L0", np.array([0, 0, -1.0]), np.ones(1), source_C=np.zeros(3), axis_C=np.array([0, 0, 1.0]))


@pytest.fixture
def gaussian() -> Iterator[str]:
    lpcal.extend.register_lobe("gaussian", lambda angle_rad, exponent: np.exp(-exponent * np.square(angle_rad)))
    yield "gaussian"
    del FORMULAS["gaussian"]


def test_a_kind_of_ones_own_is_read_written_evaluated_and_drawn(gaussian: str, tmp_path: Path) -> None:
    lobe = Lobe(gaussian, exponent=3.0)
    calibration = lpcal.Calibration("own", (replace(LAMP, lobe=lobe),))
    lpcal.write_calibration(tmp_path / "calibration.yaml", calibration)
    found = lpcal.read_calibration(tmp_path / "calibration.yaml").lights[0]
    assert (found.lobe.kind, found.lobe.exponent) == (gaussian, 3.0)
    aside = np.array([0.3, 0, 0.4])
    assert found.field(aside)[1][0] == pytest.approx(np.exp(-3 * np.arctan2(0.3, 0.4) ** 2) / 0.25)
    assert half_angle(lobe) == pytest.approx(np.sqrt(np.log(2) / 3), abs=1e-3)
    whole = documents()
    for entry in whole["lights"]["lights"]:
        entry["lobe"] = {"kind": gaussian, "exponent": 3.0}
    section = lights_section(report_of(whole))
    assert section is not None
    assert section.lobe is not None


@pytest.mark.parametrize("kind", ["gaussian", "", "Cosine"])
def test_a_kind_that_is_none_is_refused(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "calibration.yaml"
    lpcal.write_calibration(path, lpcal.Calibration("own", (replace(LAMP, lobe=Lobe("cosine", exponent=2.0)),)))
    path.write_text(path.read_text(encoding="utf-8").replace("kind: cosine", f"kind: '{kind}'"), encoding="utf-8")
    with pytest.raises(lpcal.errors.InputError, match="a lobe"):
        lpcal.read_calibration(path)


@pytest.mark.parametrize(
    ("name", "formula"),
    [
        ("", np.cos),
        ("table", lambda angle_rad, exponent: np.ones_like(angle_rad)),
        ("mine", None),
        ("mine", lambda angle_rad, exponent: 2 * np.ones_like(angle_rad)),
        ("mine", lambda angle_rad, exponent: np.cos(angle_rad)),
        ("mine", lambda angle_rad, exponent: 1.0),
    ],
)
def test_what_is_no_lobe_is_not_registered(name: str, formula: Any) -> None:
    with pytest.raises(lpcal.errors.InputError, match="register_lobe"):
        lpcal.extend.register_lobe(name, formula)
    assert "mine" not in FORMULAS


@pytest.mark.parametrize(("keys", "todo"), [("flat: 1, ", "leave it out"), ("exponant: 1, ", "did you mean exponent")])
def test_a_key_that_the_kind_does_not_have_is_named(keys: str, todo: str, tmp_path: Path) -> None:
    path = tmp_path / "calibration.yaml"
    lpcal.write_calibration(path, lpcal.Calibration("own", (replace(LAMP, lobe=Lobe("cosine", exponent=2.0)),)))
    lines = path.read_text(encoding="utf-8").splitlines()
    at = next(k for k, line in enumerate(lines) if "kind: cosine" in line)
    lines[at] = lines[at].replace("kind: cosine", f"{keys}kind: cosine") if "{" in lines[at] else lines[at]
    if "{" not in lines[at]:
        lines.insert(at, " " * (len(lines[at]) - len(lines[at].lstrip())) + keys.strip(", "))
    path.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(lpcal.errors.InputError, match=todo) as found:
        lpcal.read_calibration(path)
    assert "light L0" in str(found.value)


PACKAGE = """
import numpy as np
from lpcal.extend import LobeKind

LOBE = LobeKind("bell", lambda angle_rad, exponent: np.exp(-exponent * np.square(angle_rad)))
"""


@pytest.mark.parametrize(("entry", "code"), [("our_lamps:LOBE", 0), ("our_lamps:np", 3), (None, 3)])
def test_the_command_line_knows_an_installed_lobe(tmp_path: Path, entry: str | None, code: int) -> None:
    packages = tmp_path / "packages"
    info = packages / "our_lamps-1.0.dist-info"
    info.mkdir(parents=True)
    (packages / "our_lamps.py").write_text(PACKAGE)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: our-lamps\nVersion: 1.0\n")
    if entry is not None:
        (info / "entry_points.txt").write_text(f"[lpcal.lobes]\nours = {entry}\n")
    path = tmp_path / "calibration.yaml"
    lpcal.write_calibration(path, lpcal.Calibration("own", (replace(LAMP, lobe=Lobe("cosine", exponent=3.0)),)))
    path.write_text(path.read_text(encoding="utf-8").replace("kind: cosine", "kind: bell"), encoding="utf-8")
    (tmp_path / "points.csv").write_text("x_m,y_m,z_m\n0.3,0,0.4\n")
    command = [sys.executable, "-m", "lpcal", "field", "calibration.yaml", "points.csv", "-o", "field.csv"]
    environment = os.environ | {"PYTHONPATH": str(packages)}
    found = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert found.returncode == code, found.stderr
    assert "Traceback" not in found.stderr
    if code:
        assert ("entry point ours of our-lamps" if entry else "a lobe of kind 'bell'") in found.stderr
    else:
        row = (tmp_path / "field.csv").read_text().splitlines()[1].split(",")
        assert float(row[-1]) == pytest.approx(np.exp(-3 * np.arctan2(0.3, 0.4) ** 2) / 0.25, rel=1e-4)
