"""Which albedos an object has, and what they say where samples leave a pixel's albedo open."""

from __future__ import annotations

import numpy as np

from lpcal.geometry import lambert
from lpcal.shading import palette
from lpcal.shading.palette import Palette

RNG = np.random.default_rng(11)


def fields(level: np.ndarray) -> np.ndarray:
    """b (P, 3) of log albedos (P,), turned any way."""
    return np.exp(level)[:, None] * lambert.unit(RNG.normal(size=(len(level), 3)))[0]


def of_two_colours(width: float) -> Palette:
    """1 and .6, with a texture of a hundredth; a third of the pixels lie in folds and are anything."""
    known = np.where(np.arange(4000) % 3 < 2, 0.0, np.log(0.6)) + 0.01 * RNG.normal(size=4000)
    folds = RNG.uniform(-1.5, 0.5, 2000)
    tilt = np.concatenate([np.full(4000, 0.02), np.full(2000, 0.1)])
    other = np.concatenate([np.zeros(4000), np.full(2000, 0.3)])
    return Palette.of(fields(np.concatenate([known, folds])), tilt, other, width)


def test_a_pixel_is_drawn_to_the_colour_next_to_it_and_harder_the_fewer_there_are() -> None:
    found = of_two_colours(palette.NARROWEST)
    level = np.array([-0.04, 0.0, 0.05, np.log(0.6) + 0.04, np.log(0.6) - 0.03])
    pull = found.pull(fields(level))
    right = np.array([0.0, 0.0, 0.0, np.log(0.6), np.log(0.6)])
    assert np.allclose(np.log(pull.albedo), right, atol=0.01)
    precise = pull.weight * pull.albedo**2
    assert np.all(precise > 0.4 / palette.SIGMA**2)
    far = found.pull(fields(np.array([-1.2])))
    assert far.weight[0] * far.albedo[0] ** 2 < 0.01 * precise[1]  # of neither colour: it may be another


def test_a_wide_window_reaches_what_is_far_off() -> None:
    pull = of_two_colours(palette.width(0)).pull(fields(np.array([-1.2])))
    assert pull.albedo[0] > 1.3 * np.exp(-1.2)
    assert pull.weight[0] > 0


def test_albedos_spread_evenly_draw_nowhere() -> None:
    level = RNG.uniform(-1.0, 0.3, 60_000)
    found = Palette.of(fields(level), np.full(len(level), 0.02), np.zeros(len(level)), palette.NARROWEST)
    asked = np.linspace(-0.8, 0.1, 30)
    pull = found.pull(fields(asked))
    assert np.abs(np.log(pull.albedo) - asked).max() < 0.01
    assert np.median(pull.weight * pull.albedo**2) < 0.25 / palette.SIGMA**2


def test_a_palette_of_nothing_that_is_known_says_nothing() -> None:
    level = 0.01 * RNG.normal(size=500)
    none = Palette.of(fields(level), np.full(500, 0.02), np.full(500, 1.0), palette.NARROWEST)
    assert np.all(none.pull(fields(level)).weight == 0)


def test_the_window_halves_from_round_to_round() -> None:
    found = [palette.width(k) for k in range(6)]
    assert found[: palette.ROUNDS + 1] == [palette.NARROWEST * 2.0 ** (palette.ROUNDS - k) for k in range(palette.ROUNDS + 1)]
    assert found[-1] == palette.NARROWEST
