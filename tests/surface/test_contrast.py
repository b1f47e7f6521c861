"""A depth discontinuity costs the more the less of it the images show."""

from __future__ import annotations

import numpy as np
import pytest

from lpcal.geometry.arrays import Array
from lpcal.integration.integrate import Grid
from lpcal.surface.contrast import CONTRAST, break_costs
from lpcal.view.pixel_list import PixelList

ROWS, COLUMNS, LIGHTS = 20, 30, 6
MASK = np.ones((ROWS, COLUMNS), bool)
GRID = Grid.of(MASK)
AT_BORDER = GRID.horizontal & (GRID.columns[GRID.a] == COLUMNS // 2 - 1)


def costs(left: float, right: Array | float, noise: float = 0.0) -> Array:
    """Costs of a picture of two halves; `right` is one level, or one of each light."""
    half = GRID.columns >= COLUMNS // 2
    signal = np.where(half, np.broadcast_to(np.reshape(right, (-1, 1)), (LIGHTS, len(half))), left)
    signal = signal + noise * np.random.default_rng(0).standard_normal(signal.shape)
    rays = np.tile([0.0, 0.0, 1.0], (len(half), 1))
    return break_costs(PixelList(MASK, rays, signal, np.full(signal.shape, 0.01), np.ones(signal.shape, bool), central=True), GRID)


@pytest.mark.parametrize("contrast", [0.02, CONTRAST, 0.3])
def test_a_border_costs_what_its_contrast_says_at_any_exposure(contrast: float) -> None:
    low, high = 1 - contrast / 2, 1 + contrast / 2
    for exposure in (1.0, 1e-3):
        found = costs(exposure * low, exposure * high)
        assert found[AT_BORDER] == pytest.approx(1 + (CONTRAST / contrast) ** 2, rel=1e-6)
        assert found[~AT_BORDER].min() > 100


def test_a_change_under_one_light_counts_as_that_lights_share() -> None:
    right = np.ones(LIGHTS)
    right[2] = 0.5
    assert costs(1.0, right)[AT_BORDER] == pytest.approx(1 + CONTRAST**2 * (5 + 0.75**2) / 0.5**2, rel=1e-6)


def test_noise_makes_no_break_dear() -> None:
    assert np.median(costs(1.0, 1.0, noise=0.1)) < 1.3
    assert np.isfinite(costs(0.0, 0.0)).all()
