"""From stored numbers to light: each thing the sensor does is undone, and its noise is known."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lpcal.detect.radiometry import Sensor, fit_flat_field, noise_model, to_radiance
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.records.observations import RawCapture
from lpcal.view.parallel import cores

SHAPE = (96, 128)


def ramp(low: float, high: float) -> np.ndarray:
    return np.linspace(low, high, SHAPE[1])[None, :] * np.ones((SHAPE[0], 1))


def capture(images: np.ndarray, ambient: np.ndarray | None = None, step: float = 1 / 255, **more: Any) -> RawCapture:
    names = tuple(f"L{k}" for k in range(len(images)))
    many = 0 if ambient is None else len(ambient)
    return RawCapture(
        "test",
        names,
        images.astype(np.float32),
        more.pop("exposure_s", np.ones(len(images))),
        None if ambient is None else ambient.astype(np.float32),
        more.pop("ambient_exposure_s", np.ones(many)),
        step=step,
        **more,
    )


def test_black_level_gamma_and_white_level_are_undone() -> None:
    linear = np.stack([ramp(0.1, 0.6), ramp(0.6, 0.2)])
    black, white, gamma = 0.05, 0.8, 2.2
    low, high = black**gamma, white**gamma
    stored = (low + linear * (high - low)) ** (1 / gamma)
    found = to_radiance(capture(stored, step=1e-4), Sensor(black, white, gamma))
    assert np.allclose(found.signal, linear, atol=1e-5)
    assert not found.saturated.any()


def test_twelve_bits_low_in_sixteen_saturate_at_their_own_white() -> None:
    stored = np.stack([ramp(0.01, 0.0625), ramp(0.05, 0.01)])
    found = to_radiance(capture(stored, step=1 / 65535), Sensor(white_level=4095 / 65535))
    assert found.saturated[0, :, -1].all()
    assert found.saturated.sum() == pytest.approx(SHAPE[0], abs=SHAPE[0])
    assert found.signal[0, 0, -2] == pytest.approx(1.0, abs=0.02)


def test_exposures_and_the_ambient_of_another_exposure() -> None:
    light, room = np.stack([ramp(2.0, 6.0), ramp(6.0, 2.0)]), 1.5
    exposure = np.array([0.05, 0.1])
    stored = (light + room) * exposure[:, None, None]
    ambient = np.stack([np.full(SHAPE, room * 0.2), np.full(SHAPE, room * 0.4)])
    found = to_radiance(capture(stored, ambient, exposure_s=exposure, ambient_exposure_s=np.array([0.2, 0.4]), step=1e-5), Sensor())
    assert np.allclose(found.signal, light, atol=1e-4)
    assert np.allclose(found.ambient, room, atol=1e-4)


def test_without_ambient_it_is_said() -> None:
    found = to_radiance(capture(np.stack([ramp(0.1, 0.5)] * 3)), Sensor())
    assert any("no ambient image" in note for note in found.notes)
    assert np.all(found.ambient == 0)


def vignette() -> np.ndarray:
    row, column = np.indices(SHAPE)
    r2 = ((row - 40) / SHAPE[0]) ** 2 + ((column - 70) / SHAPE[1]) ** 2
    return 1 / (1 + 0.5 * r2) ** 2


def test_the_flat_field_is_smooth_and_divides_out() -> None:
    rng = np.random.default_rng(0)
    flat = 0.5 * vignette() + 0.01 * rng.standard_normal(SHAPE)
    flat[10:14, 20:24] = 0.1  # dust
    field = fit_flat_field(flat.astype(np.float32), Sensor())
    response = field.response(SHAPE)
    assert np.abs(response / response.max() / (vignette() / vignette().max()) - 1).max() < 0.02
    light = np.stack([ramp(0.2, 0.5), ramp(0.5, 0.3)])
    with_field = to_radiance(capture(light * vignette(), step=1e-5), Sensor(flat_field=field))
    without = to_radiance(capture(light * vignette(), step=1e-5), Sensor())
    ratio = with_field.signal / light
    assert ratio.std() / ratio.mean() < 0.01 < (without.signal / light).std() / (without.signal / light).mean()


@pytest.mark.parametrize("level", [0.005, 0.99])
def test_a_flat_field_that_is_dark_or_saturated_is_refused(level: float) -> None:
    with pytest.raises(DegenerateError, match="flat_field"):
        fit_flat_field(np.full(SHAPE, level, np.float32), Sensor(white_level=0.95))


@pytest.mark.parametrize("seed", range(4))
def test_the_noise_is_read_off_the_images(seed: int) -> None:
    rng = np.random.default_rng(seed)
    read, shot = 2e-3**2, 1 / 8000
    shape = (6, 240, 320)
    texture = 1 + 0.3 * np.sin(np.indices(shape[1:])[1] / 3.0) * (np.indices(shape[1:])[0] < 80)
    level = np.linspace(0.02, 0.8, shape[2])[None, None, :] * texture * np.ones(shape)
    images = level + np.sqrt(read + shot * level) * rng.standard_normal(shape)
    a, c = noise_model(images.astype(np.float32), np.zeros(shape, bool), 1 / 4095)
    for at in (0.05, 0.3, 0.7):
        assert np.sqrt(a + c * at) == pytest.approx(np.sqrt(read + shot * at), rel=0.15)


def test_the_sigma_of_a_signal_is_its_scatter_and_the_ambients_noise_counts() -> None:
    rng = np.random.default_rng(5)
    light, room, shape = 0.3, 0.2, (6, 240, 320)
    noise = 0.01

    def shot(mean: float, count: int) -> np.ndarray:
        return mean + noise * rng.standard_normal((count, *shape[1:]))

    one = to_radiance(capture(shot(light + room, 6), shot(room, 1), step=1e-4), Sensor())
    four = to_radiance(capture(shot(light + room, 6), shot(room, 4), step=1e-4), Sensor())
    z = (one.signal - light) / one.sigma
    assert np.std(z) == pytest.approx(1.0, abs=0.1)
    assert np.median(one.sigma) == pytest.approx(noise * np.sqrt(2), rel=0.1)
    assert np.median(four.sigma) == pytest.approx(noise * np.sqrt(1.25), rel=0.1)


def test_colour_saturates_where_any_channel_does() -> None:
    images = np.full((3, *SHAPE, 3), 0.4)
    images[0, 5, 7, 1] = 1.0
    found = to_radiance(capture(images), Sensor())
    assert found.saturated.shape == (3, *SHAPE)
    assert found.saturated.sum() == 1


def test_a_short_exposure_is_put_on_the_long_ones_scale_where_it_is_stated() -> None:
    long = np.stack([ramp(0.1, 0.5), ramp(0.5, 0.1)])
    raw = capture(long, exposure_s=np.array([0.02, 0.02]), short={"L0": (long[0] / 40).astype(np.float32)}, step=1e-5)
    stated = to_radiance(replace(raw, short_exposure_s={"L0": 0.0005}), Sensor())
    assert np.allclose(stated.short["L0"], stated.signal[0], rtol=1e-4)
    unstated = to_radiance(replace(raw, short_exposure_s={"L0": None}), Sensor())
    assert np.allclose(unstated.short["L0"], long[0] / 40, atol=1e-6)


@pytest.mark.parametrize(("level", "words"), [(0.0, "all dark"), (1.0, "saturated")])
def test_all_dark_and_all_saturated_are_refused(level: float, words: str) -> None:
    rng = np.random.default_rng(1)
    images = np.clip(level + 0.002 * rng.standard_normal((6, *SHAPE)) * (level < 1), 0, 1)
    with pytest.raises(DegenerateError, match=words):
        to_radiance(capture(images), Sensor())


def ball(lights: int, bits: int, seed: int) -> np.ndarray:
    """Noisy images of a matte ball, the brightest number near full scale."""
    rng, full = np.random.default_rng(seed), 2**bits - 1
    y, x = np.mgrid[-1:1:96j, -1:1:96j]
    z = np.sqrt(np.maximum(1 - x**2 - y**2, 0))
    turn = 2 * np.pi * np.arange(lights) / lights
    lit = np.stack([np.maximum(0.4 * np.cos(a) * x + 0.4 * np.sin(a) * y + 0.82 * z, 0) * (z > 0) for a in turn])
    return np.rint(np.clip(0.85 * lit + 0.04 + 0.004 * rng.standard_normal(lit.shape), 0, 1) * full) / full


@pytest.mark.parametrize(("bits", "level"), [(8, 0.5), (8, 0.7), (12, 0.45), (16, 0.6)])
@pytest.mark.parametrize("channels", [1, 3])
def test_numbers_that_pile_up_below_white_are_saturated_and_said(bits: int, level: float, channels: int) -> None:
    images, step = ball(4, bits, 3), 1 / (2**bits - 1)
    images = images if channels == 1 else np.stack([0.6 * images, images, 0.5 * images], axis=-1)
    sound = to_radiance(capture(images, step=step), Sensor())
    assert not sound.saturated.any()
    assert not [note for note in sound.notes if "pile up" in note]
    clipped = np.minimum(images, np.rint(level / step) * step)
    found = to_radiance(capture(clipped, step=step), Sensor())
    assert [note for note in found.notes if f"pile up at {100 * np.rint(level / step) * step:.1f} %" in note]
    lost = images > level if channels == 1 else (images > level).any(axis=-1)
    assert np.array_equal(found.saturated | lost, found.saturated)
    assert found.saturated.sum() < lost.sum() + 0.02 * lost.size


def test_light_that_is_not_clipped_does_not_pile_up() -> None:
    flat = np.full(SHAPE, 0.6)[None] * np.array([0.9, 1.0])[:, None, None]
    for images in (flat, ball(3, 8, 5) * np.array([1.0, 0.6, 0.3])[:, None, None], np.stack([ramp(0.1, 0.7), ramp(0.7, 0.1)])):
        assert not to_radiance(capture(np.rint(255 * images) / 255), Sensor()).saturated.any()


@pytest.mark.parametrize("noise", [0.001, 0.02])
@pytest.mark.parametrize(("black", "stated"), [(0.008, 0.08), (0.02, 0.05), (0.05, 0.09)])
def test_a_black_level_over_the_darkest_pixels_is_refused(black: float, stated: float, noise: float) -> None:
    rng = np.random.default_rng(int(1000 * stated))
    light = np.concatenate([np.zeros(4000), np.linspace(0, 0.7, 6000)])
    images = np.clip(black + light + rng.normal(0, noise, (5, 10000)), 0, 1).astype(np.float32).reshape(5, 100, 100)
    with pytest.raises(DisagreementError, match="darker than black") as error:
        to_radiance(capture(images, step=1 / 65535), Sensor(black_level=stated))
    assert f"stated as {100 * stated:.3g} %" in error.value.found
    to_radiance(capture(images, step=1 / 65535), Sensor(black_level=black))
    to_radiance(capture(images, step=1 / 65535), Sensor(black_level=black + 0.003))


@pytest.mark.parametrize("channels", [(), (3,)])
def test_any_number_of_cores_finds_the_same(channels: tuple[int, ...]) -> None:
    rng = np.random.default_rng(5)
    images = rng.uniform(0.05, 1.0, (5, 96, 130, *channels)).astype(np.float32)
    raw = capture(images, 0.5 * images[:1], exposure_s=np.linspace(1, 2, 5))
    found = []
    for count in (1, 2, 5):
        with cores(count):
            found.append(to_radiance(raw, Sensor(black_level=0.02)))
    for one in found[1:]:
        assert np.array_equal(one.signal, found[0].signal)
        assert np.array_equal(one.sigma, found[0].sigma)


def test_the_noise_is_the_same_whether_pixels_are_known_not_to_saturate_or_looked_at() -> None:
    rng = np.random.default_rng(6)
    smooth = np.linspace(0.1, 0.8, 240, dtype=np.float32) + np.zeros((4, 200, 240), np.float32)
    linear = smooth + rng.normal(0, 0.01, smooth.shape).astype(np.float32)
    full = np.zeros(linear.shape, bool)
    full[:, 0, 0] = True  # of no block, as the finest detail has no rim
    assert noise_model(linear, full, 1e-5) == noise_model(linear, np.zeros_like(full), 1e-5)
    full[:, :, 120:] = True
    assert noise_model(linear, full, 1e-5) != noise_model(linear, np.zeros_like(full), 1e-5)
