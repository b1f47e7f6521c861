"""What a surface states of its pieces: a small one that stands apart may touch what it borders on instead."""

from __future__ import annotations

import numpy as np
import pytest

from lpcal.records.surface import Component
from lpcal.surface import components
from lpcal.surface.integrate import Grid

MASK = np.ones((40, 60), bool)
GRID = Grid.of(MASK)


def pieces(apart: float) -> tuple[np.ndarray, np.ndarray]:
    """Log depths and labels of a flat front with a small piece in it that stands `apart` from it."""
    label = np.ones(MASK.shape, int)
    label[10:20, 20:32] = 2
    return np.where(label == 2, apart, 0.0)[MASK] + np.log(0.4), label[MASK]


def touching(apart: float, std: float) -> tuple[tuple[float, float], ...]:
    u, label = pieces(apart)
    small = Component(2, int((label == 2).sum()), float(0.4 * np.exp(apart)), std)
    whole = Component(1, int((label == 1).sum()), 0.4, 0.012)
    return tuple((one.mean_depth_m, one.scale_std) for one in components._touching(GRID, u, label, small, [whole]))


@pytest.mark.parametrize("apart", [-0.3, 0.25])
def test_a_small_piece_that_stands_apart_may_touch_the_rest(apart: float) -> None:
    ((depth_m, std),) = touching(apart, 0.05)
    assert depth_m == pytest.approx(0.4)
    assert std == pytest.approx(np.hypot(0.012, components.TOUCH_STD)), "no surer than what it touches"


def test_no_second_answer_where_it_would_be_the_first_again() -> None:
    assert touching(0.02, 0.05) == ()
    assert touching(0.25, 0.3) == (), "its own standard deviation holds it already"


def test_a_piece_of_which_nothing_is_beside_touches_nothing() -> None:
    u, label = pieces(0.3)
    far = Component(3, 10, 0.5, 0.05)
    assert components._touching(GRID, u, label, far, [Component(1, 2000, 0.4, 0.012)]) == ()


def test_steps_are_those_from_the_larger_pieces_across_the_border() -> None:
    u, label = pieces(0.3)
    step, beside = components.steps_to_larger(GRID.a, GRID.b, u, label, 2)
    assert len(step) == 2 * (10 + 12)
    assert np.allclose(step, 0.3)
    assert set(beside) == {1}
    assert len(components.steps_to_larger(GRID.a, GRID.b, u, label, 1)[0]) == 0
