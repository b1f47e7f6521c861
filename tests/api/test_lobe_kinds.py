"""A kind of lobe is one function: files, light field and report follow it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

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
    FORMULAS["gaussian"] = lambda angle_rad, exponent: np.exp(-exponent * np.square(angle_rad))
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
