"""Lobes that a file states and that no light has: each is named, with what it should be."""

from __future__ import annotations

import numpy as np
import pytest

from lpcal.errors import InputError
from lpcal.formats.light_tables import sane_lights
from lpcal.records.calibration import Calibration, Light, Lobe

UP = np.array([0.0, 0.0, -1.0])


def lit_by(lobe: Lobe) -> Calibration:
    return Calibration("rig", (Light("L0", UP, np.ones(1), None, 0.3 * UP, -UP, lobe),))


def table(*value: float) -> Lobe:
    return Lobe("table", angle_rad=np.linspace(0, np.pi / 2, len(value)), value=np.array(value))


@pytest.mark.parametrize(
    ("lobe", "found", "needed"),
    [
        (Lobe("flat-cosine", exponent=3.0), "'flat-cosine'", "cosine"),
        (Lobe("cosine", exponent=-1.0), "exponent -1", "0 to 5000"),
        (table(2.0, 2.0, 0.0), "2 on its axis", "intensity"),
        (table(1.0, 0.5, -0.1), "negative", "0 and more"),
        (table(1.0, np.nan, 0.1), "no number", "0 and more"),
    ],
)
def test_a_lobe_that_cannot_be_is_named_with_what_it_should_be(lobe: Lobe, found: str, needed: str) -> None:
    with pytest.raises(InputError) as raised:
        sane_lights(lit_by(lobe), "calibration.yaml")
    told = str(raised.value)
    assert found in told
    assert "light L0" in told
    assert needed in told


def test_a_lobe_that_can_be_is_taken() -> None:
    assert sane_lights(lit_by(table(1.0, 0.7, 0.0)), "calibration.yaml").lights[0].lobe.kind == "table"
