"""Short exposures, several ambient images, colour, subsets of bits, a flat card: each changes the result as it should."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from lit_scene import SIZE, Scene, calibration, draw, truth
from lpcal.detect.exposures import ambient_notes, with_short_exposures
from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.surface.flatness import flatness
from lpcal.surface.reconstruct import Options, reconstruct


def overexposed():
    """The scene at twice the exposure, with short images at a quarter of that."""
    raw = draw(Scene(), calibration(), noise=0.002 / 2.2)  # the read noise of the long images is 0.002 again
    longer = np.minimum(2.2 * raw.images, 1.0)
    return replace(
        raw,
        images=longer,
        ambient=np.minimum(2.2 * raw.ambient, 1.0),
        exposure_s=np.full(6, 2.2),
        ambient_exposure_s=np.array([2.2]),
        short=dict(zip(raw.lights, draw(Scene(), calibration(), seed=1).images, strict=True)),
        short_exposure_s=dict.fromkeys(raw.lights, 1.0),
    )


def test_saturated_samples_come_from_shorter_exposures():
    raw, mask = overexposed(), truth(Scene())[0]
    plain = to_radiance(raw, Sensor())
    merged = with_short_exposures(plain, raw, Sensor())
    reference = to_radiance(draw(Scene(), calibration(), noise=0.0, bits=16), Sensor()).signal
    lost = plain.saturated & mask
    assert lost.sum() > 500
    assert not (merged.saturated & mask).any()
    pull = (merged.signal - reference)[lost] / merged.sigma[lost]
    assert abs(pull.mean()) < 0.2
    assert pull.std() == pytest.approx(1.0, abs=0.35)
    assert np.abs(plain.signal - reference)[lost].mean() > 5 * np.abs(merged.signal - reference)[lost].mean()
    assert "shorter exposures" in merged.notes[-1]


def test_a_short_exposure_of_which_nothing_is_stated_is_not_merged():
    raw = overexposed()
    untold = replace(raw, short_exposure_s=dict.fromkeys(raw.lights))
    plain = to_radiance(untold, Sensor())
    assert with_short_exposures(plain, untold, Sensor()) is plain


def test_ambient_that_drifts_is_said_and_its_mean_taken():
    raw = draw(Scene(), calibration())
    drifted = replace(raw, ambient=np.concatenate([raw.ambient, raw.ambient * 1.6]), ambient_exposure_s=np.ones(2))
    steady = replace(raw, ambient=np.concatenate([raw.ambient, raw.ambient]), ambient_exposure_s=np.ones(2))
    assert "changed by 46 %" in ambient_notes(to_radiance(drifted, Sensor()), drifted, Sensor())[0]
    assert ambient_notes(to_radiance(steady, Sensor()), steady, Sensor()) == ()
    taken = to_radiance(drifted, Sensor()).ambient
    assert taken.mean() == pytest.approx(1.3 * raw.ambient.mean(), rel=1e-3)


def test_more_ambient_than_lamps_is_said():
    raw = draw(Scene(), calibration())
    bright = replace(raw, images=0.05 * raw.images + 0.7, ambient=0.05 * raw.ambient + 0.7)
    assert "more ambient light" in ambient_notes(to_radiance(bright, Sensor()), bright, Sensor())[0]


def test_a_cards_flatness_is_told_and_a_balls_is_not():
    card = to_radiance(draw(Scene(centre=None, wall_z=0.35, wall_albedo=0.7), calibration()), Sensor())
    middle = np.zeros(SIZE[::-1], bool)
    middle[30:82, 50:110] = True
    near, distant = (flatness(reconstruct(card, calibration(), Options(mask=middle, near=way))) for way in (True, False))
    assert near["plane_rms_mm"] < 0.3
    assert near["bowl_mm"] < 0.3
    assert distant["bowl_mm"] > 3.0
    assert near["extent_mm"] > 100
    ball = reconstruct(to_radiance(draw(Scene(), calibration()), Sensor()), calibration(), Options(mask=truth(Scene())[0]))
    assert flatness(ball) is None
    assert json.dumps(near)
