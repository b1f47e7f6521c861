"""Short exposures, several ambient images, colour, subsets of bits, a flat card: each changes the result as it should."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from lit_scene import SIZE, Scene, calibration, draw, truth
from lpcal.detect.ambient import ambient_notes, room_changes
from lpcal.detect.exposures import with_short_exposures
from lpcal.detect.radiometry import Sensor, fit_flat_field, to_radiance
from lpcal.formats.documents import plain
from lpcal.integration.pieces import flatness
from lpcal.pipeline.reconstruct import _flat_said
from lpcal.records.observations import RawCapture
from lpcal.surface.reconstruct import Options, reconstruct


def overexposed() -> RawCapture:
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


@pytest.mark.slow
def test_saturated_samples_come_from_shorter_exposures() -> None:
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


def test_a_short_exposure_of_which_nothing_is_stated_is_not_merged() -> None:
    raw = overexposed()
    untold = replace(raw, short_exposure_s=dict.fromkeys(raw.lights))
    plain = to_radiance(untold, Sensor())
    assert with_short_exposures(plain, untold, Sensor()) is plain


def notes(raw: RawCapture) -> tuple[str, ...]:
    """What is said of a capture's ambient light."""
    radiance = to_radiance(raw, Sensor())
    return ambient_notes(radiance, raw, Sensor(), room_changes(radiance))


def test_ambient_that_drifts_is_said_and_its_mean_taken() -> None:
    raw = draw(Scene(), calibration())
    drifted = replace(raw, ambient=np.concatenate([raw.ambient, raw.ambient * 1.6]), ambient_exposure_s=np.ones(2))
    steady = replace(raw, ambient=np.concatenate([raw.ambient, raw.ambient]), ambient_exposure_s=np.ones(2))
    assert "changed by 46 %" in notes(drifted)[0]
    assert notes(steady) == ()
    taken = to_radiance(drifted, Sensor()).ambient
    assert taken.mean() == pytest.approx(1.3 * raw.ambient.mean(), rel=1e-3)


def test_more_ambient_than_lamps_is_said() -> None:
    raw = draw(Scene(), calibration())
    bright = replace(raw, images=0.05 * raw.images + 0.7, ambient=0.05 * raw.ambient + 0.7)
    assert "more ambient light" in notes(bright)[0]


@pytest.mark.slow
def test_lights_of_different_colours_are_told_from_the_objects_colour() -> None:
    scene = Scene(albedo=(0.8, 0.5, 0.2))
    raw, lights, mask = draw(scene, calibration()), calibration().lights, truth(scene)[0]
    tint = (1 + 0.35 * np.sin(np.arange(18).reshape(6, 3) * 1.7)) * [0.8, 1.0, 1.2]
    ambient = raw.ambient[0]
    tinted = replace(raw, images=(raw.images - ambient) * tint[:, None, None].astype(np.float32) + ambient)
    told = tuple(replace(light, intensity=light.intensity * tint[k]) for k, light in enumerate(lights))
    grey = tuple(replace(light, intensity=light.intensity.mean(keepdims=True)) for light in told)
    colour = {}
    for name, known in (("told", told), ("grey", grey)):
        found = reconstruct(to_radiance(tinted, Sensor()), replace(calibration(), lights=known), Options(mask=mask))
        middle = np.nanmedian(found.albedo[found.mask], axis=0)
        colour[name] = middle / middle[0] / [1, 0.625, 0.25] - 1
    assert np.abs(colour["told"]).max() < 0.03
    assert np.abs(colour["grey"]).max() > 0.1


@pytest.mark.slow
def test_twelve_bits_low_in_sixteen_are_cut_off_where_they_pile_up() -> None:
    raw, mask = overexposed(), truth(Scene())[0]
    low = replace(raw, images=raw.images / 16, ambient=raw.ambient / 16, short={}, short_exposure_s={}, step=1 / 65535)
    full, told, untold = to_radiance(raw, Sensor()), to_radiance(low, Sensor(white_level=0.0625)), to_radiance(low, Sensor())
    assert (full.saturated & mask).sum() > 500
    assert np.array_equal(told.saturated, full.saturated)
    assert np.allclose(told.signal, full.signal, atol=1e-3)
    assert (untold.saturated & full.saturated).sum() > 0.9 * full.saturated.sum()  # nobody states the level; their pile shows it


def test_more_ambient_images_mean_less_noise() -> None:
    raw = draw(Scene(), calibration(), noise=0.01)
    rng = np.random.default_rng(3)
    eight = np.float32(0.05) + 0.01 * rng.standard_normal((8, *raw.ambient.shape[1:])).astype(np.float32)
    true = to_radiance(draw(Scene(), calibration(), noise=0.0, bits=16), Sensor()).signal
    one = to_radiance(raw, Sensor())
    many = to_radiance(replace(raw, ambient=eight, ambient_exposure_s=np.ones(8)), Sensor())
    assert np.median(many.sigma) < 0.85 * np.median(one.sigma)
    assert np.std(many.signal - true) < 0.85 * np.std(one.signal - true)
    assert np.std(many.signal - true) == pytest.approx(np.median(many.sigma), rel=0.2)


@pytest.mark.slow
def test_without_a_flat_field_the_lens_is_taken_for_the_objects_brightness() -> None:
    row, column = np.indices(SIZE[::-1])
    fall = (1 - 0.55 * (((row - 56) ** 2 + (column - 80) ** 2) / 97**2)).astype(np.float32)
    raw = draw(Scene(centre=None, wall_z=0.35, wall_albedo=0.7), calibration())
    dimmed = replace(raw, images=raw.images * fall, ambient=raw.ambient * fall)
    flat = fit_flat_field(0.6 * fall, Sensor())
    middle = np.zeros(SIZE[::-1], bool)
    middle[20:92, 30:130] = True
    spread = {}
    for name, sensor in (("flat", Sensor(flat_field=flat)), ("none", Sensor())):
        found = reconstruct(to_radiance(dimmed, sensor), calibration(), Options(mask=middle))
        spread[name] = float(np.nanstd(found.albedo[middle]) / np.nanmean(found.albedo[middle]))
    assert spread["flat"] < 0.02
    assert spread["none"] > 0.04


@pytest.mark.slow
def test_a_cards_flatness_is_told_and_a_balls_is_not() -> None:
    card = to_radiance(draw(Scene(centre=None, wall_z=0.35, wall_albedo=0.7), calibration()), Sensor())
    middle = np.zeros(SIZE[::-1], bool)
    middle[30:82, 50:110] = True
    near, distant = (flatness(reconstruct(card, calibration(), Options(mask=middle, near=way))) for way in (True, False))
    assert near is not None
    assert distant is not None
    assert near.plane_rms_mm < 0.3
    assert near.bowl_mm < 0.3
    assert distant.bowl_mm > 3.0
    assert near.extent_mm > 100
    document = {"flatness": near, "flatness_distant": distant}
    assert _flat_said(document) == _flat_said(json.loads(json.dumps(plain(document)))), "of a surface that is up to date"
    assert "a bowl of" in _flat_said(document)
    ball = reconstruct(to_radiance(draw(Scene(), calibration()), Sensor()), calibration(), Options(mask=truth(Scene())[0]))
    assert flatness(ball) is None
