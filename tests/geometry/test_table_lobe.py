"""The cubic through a lobe's table, by scipy's."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from lpcal.geometry.light_field import table_lobe


@pytest.mark.parametrize("knots", [2, 3, 4, 12])
@pytest.mark.parametrize("kind", ["any", "falling", "steps"])
def test_it_is_that_of_scipy(knots: int, kind: str) -> None:
    rng = np.random.default_rng(knots)
    for _ in range(50):
        at, value = np.cumsum(0.01 + rng.random(knots)), rng.standard_normal(knots)
        value = np.sort(np.abs(value))[::-1] if kind == "falling" else np.round(value) if kind == "steps" else value
        angles = np.concatenate([at, -at, rng.uniform(0, 1.2 * at[-1], 100)])
        theirs = PchipInterpolator(at, value, extrapolate=False)(np.clip(np.abs(angles), at[0], None))
        np.testing.assert_allclose(table_lobe(angles, at, value), np.maximum(np.nan_to_num(theirs), 0.0), atol=1e-12)


def test_it_is_dark_beyond_its_last_angle_and_even_about_the_axis() -> None:
    knots, value = np.array([0.0, 0.5, 1.0]), np.array([1.0, 0.7, 0.2])
    assert table_lobe(np.array([1.0 + 1e-9, 2.0]), knots, value).tolist() == [0.0, 0.0]
    assert table_lobe(np.array([-0.3]), knots, value) == table_lobe(np.array([0.3]), knots, value)
