"""Images of a capture that do not lie on each other are named, with their shifts."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest

import lpcal as library
from lit_scene import Scene, calibration, draw
from lpcal.detect.image_shifts import Shift, shifted
from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array
from lpcal.shading.normals import Estimate
from lpcal.view.pixel_list import Illumination, PixelList

SIDE, LIGHTS, NOISE = 90, 6, 0.004
NAMES = [f"L{k}" for k in range(LIGHTS)]


def found(seed: int, d: Array, *, lights: int = LIGHTS) -> tuple[Shift, ...]:
    """The shifts found of a painted, bumpy sheet whose images are shifted by d (L, 2): drawn from functions, not by interpolation."""
    rng = np.random.default_rng(seed)
    angle = 2 * np.pi * np.arange(lights) / lights
    S = lambert.unit(np.stack([0.5 * np.cos(angle), 0.5 * np.sin(angle), -np.ones(lights)], axis=1))[0]
    waves = [(rng.uniform(0.1, 0.7, 2) * rng.choice([-1, 1], 2), rng.uniform(0, 7), amplitude) for amplitude in (0.2, 0.15, 0.1, 0.1)]
    row, column = (index.ravel().astype(float) for index in np.indices((SIDE, SIDE)))

    def b(x: Array, y: Array) -> Array:
        albedo = 0.6 + sum(size * np.sin(f[0] * x + f[1] * y + phase) for f, phase, size in waves)
        n = np.stack([0.2 * np.sin(x / 9), 0.2 * np.cos(y / 7), -np.ones_like(x)], axis=1)
        return np.asarray(albedo[:, None] * lambert.unit(n)[0])

    signal = np.stack([b(column - d_k[0], row - d_k[1]) @ s for s, d_k in zip(S, d, strict=True)])
    signal += NOISE * rng.standard_normal(signal.shape)
    every = np.ones(signal.shape, bool)
    rays = np.tile([0.0, 0.0, 1.0], (SIDE**2, 1))
    seen = PixelList(np.ones((SIDE, SIDE), bool), rays, signal, np.full(signal.shape, NOISE), every, central=True)
    lit = Illumination(np.repeat(S[:, None], SIDE**2, axis=1), np.ones(signal.shape))
    estimate = replace(Estimate.nothing(), inliers=every, gloss=None)
    return shifted(seen, lit, estimate, [f"L{k}" for k in range(lights)])


@pytest.mark.parametrize("lights", [4, 6, 40])
def test_images_that_lie_on_each_other_are_not_spoken_of(lights: int) -> None:
    for seed in range(8):
        assert found(seed, np.zeros((lights, 2)), lights=lights) == ()


def test_the_shift_of_one_image_is_found() -> None:
    """To two fifths of itself: noise in the gradients shrinks it along directions that the lights hardly determine."""
    for seed in range(6):
        d = np.zeros((LIGHTS, 2))
        d[seed % LIGHTS] = (0.6, -0.4)
        shift = found(seed, d)[0]
        assert shift.image == f"L{seed % LIGHTS}"
        true = d[seed % LIGHTS]
        assert np.hypot(*(shift.px - true)) < 0.4 * np.hypot(*true)


def test_a_drift_over_all_images_is_found() -> None:
    d = np.linspace(-1, 1, LIGHTS)[:, None] * [0.5, 1.0]
    assert {"L0", "L5"} <= {shift.image for shift in found(3, d)}


def test_one_of_forty_images() -> None:
    d = np.zeros((40, 2))
    d[23] = (-0.9, 0.3)
    assert [shift.image for shift in found(0, d, lights=40)] == ["L23"]


@pytest.mark.parametrize("moved", [None, 4])
def test_a_capture_says_so(moved: int | None) -> None:
    raw = draw(Scene(), calibration())
    if moved is not None:
        images = raw.images.copy()
        shift = np.array([[1, 0, 1.2], [0, 1, 0.5]])
        images[moved] = cv2.warpAffine(
            images[moved], shift, images[moved].shape[::-1], flags=cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE
        )
        raw = replace(raw, images=images)
    said = [note for note in library.reconstruct(raw, calibration()).warnings if "do not lie on the others" in note]
    assert len(said) == (moved is not None)
    assert all("L4 by (+" in note for note in said)
