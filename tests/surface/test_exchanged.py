"""Two images of a capture, or two lines of its light list, in each other's place: said, and never of the right ones."""

from __future__ import annotations

import numpy as np
import pytest

from lpcal.surface.self_calibration import exchanged

NAMES = pytest.mark.parametrize("seed", range(4))
USUAL = [(0, 0.0), (1, 0.3), (2, 1.0), (3, 0.3)]
FURTHER = [(seed, gloss) for seed in range(4) for gloss in (0.0, 0.3, 1.0) if (seed, gloss) not in USUAL]


def drawn(seed: int, lights: int = 12, *, near: bool = False, gloss: float = 0.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Signals (L, P) with noise, shadows and a share of gloss, light vectors (L, P, 3), b (P, 3) of a ball's cap."""
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(-0.8, 0.8, (2, 2500))
    n = np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0))], axis=1)
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    angle, slant = rng.uniform(0, 2 * np.pi) + 2 * np.pi * np.arange(lights) / lights, rng.uniform(0.35, 0.8, lights)
    S = np.stack([np.sin(slant) * np.cos(angle), np.sin(slant) * np.sin(angle), -np.cos(slant)], axis=1)
    B = np.repeat(S[:, None], len(n), axis=1)
    if near:
        to = 4 * S[:, None] - n
        B = 16 * to / np.linalg.norm(to, axis=2, keepdims=True) ** 3
    b = rng.uniform(0.3, 0.9, (len(n), 1)) * n
    half = S - np.array([0, 0, 1.0])
    shine = np.maximum(n @ (half / np.linalg.norm(half, axis=1, keepdims=True)).T, 0).T ** 40
    signal = np.maximum(np.einsum("lpi,pi->lp", B, b), 0) + gloss * shine
    signal[rng.random(signal.shape) < 0.1] = 0
    return signal * (1 + rng.normal(0, 0.01, signal.shape)), B, b


@NAMES
@pytest.mark.parametrize("near", [False, True])
def test_two_exchanged_images_are_named(seed: int, near: bool) -> None:
    signal, B, b = drawn(seed, near=near)
    one, other = np.random.default_rng(seed).choice(12, 2, replace=False)
    signal[[one, other]] = signal[[other, one]]
    assert exchanged(signal, B, b, np.ones(signal.shape, dtype=bool)) == {int(one): int(other), int(other): int(one)}


@NAMES
def test_three_that_went_round_are_named_whatever_their_powers(seed: int) -> None:
    signal, B, b = drawn(seed)
    signal[[1, 5, 8]] = signal[[5, 8, 1]] * np.array([0.5, 1.7, 1.0])[:, None]
    assert exchanged(signal, B, b, np.ones(signal.shape, dtype=bool)) == {1: 5, 5: 8, 8: 1}


@pytest.mark.parametrize(("seed", "gloss"), [*USUAL, *(pytest.param(*one, marks=pytest.mark.slow) for one in FURTHER)])
def test_images_in_their_places_are_left_alone(seed: int, gloss: float) -> None:
    for lights in (6, 12, 40):
        signal, B, b = drawn(seed, lights, gloss=gloss)
        b = b + np.random.default_rng(seed).normal(0, 0.05, b.shape)
        assert exchanged(signal, B, b, np.ones(signal.shape, dtype=bool)) == {}


def test_few_lights_or_pixels_say_nothing() -> None:
    signal, B, b = drawn(0, 5)
    assert exchanged(signal[::-1], B, b, np.ones(signal.shape, dtype=bool)) == {}
    signal, B, b = drawn(0)
    assert exchanged(signal[::-1, :60], B[:, :60], b[:60], np.ones((12, 60), dtype=bool)) == {}
    assert exchanged(signal, B, np.full(b.shape, np.nan), np.ones(signal.shape, dtype=bool)) == {}
