"""From stored numbers to light.

Symbols: stored number s (fraction of full scale), black b, white w, gamma g (stored = linear^(1/gamma), or sRGB's curve), flat field
F(u, v), exposure t (times gain)::

    linear(s) = (s^g - b^g) / (w^g - b^g) / F / t            signal = linear(lit) - linear(ambient)

Noise: variance of the linear number = a + c * (its mean), read off the images themselves (read and shot noise); the ambient
image's own noise is propagated. Source: EMVA 1288, linear camera model.

Where a sensor saturates below the stated white level: the brightest numbers pile up on one.

Light that falls off smoothly, with noise on it, leaves fewer pixels the brighter the number, and a single one or a few at the top. A sensor
(or a raw converter) that saturates at a number puts all that is brighter there: a spike at the very top, above numbers that are all in use.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.detect.stored_checks import refuse_mosaic, refuse_over_white, twins
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.geometry.clipping import clipping_level, clipping_words
from lpcal.records.observations import Radiance, RawCapture
from lpcal.records.sensor import FlatField, Sensor, StatedSensor
from lpcal.view import parallel

NO_AMBIENT = "no ambient image: what lights the scene beside the lights is not taken away"
"""The note of a capture whose ambient light nothing shows; it no longer holds once that light is estimated."""

FLAT_DEGREE = 6
FLAT_BLOCK_PX = 8
NOISE_BINS = 24
NOISE_BLOCK_PX = 12
LOWER_QUARTER = 0.842
"""The lower quarter of the variances of such blocks of white noise, as a fraction of the true one."""
BLACK_BLOCK = 8
"""Side of the blocks of pixels whose mean is held against black: it scatters by an eighth of a pixel's noise."""
BLACK_OFF, BLACK_SIGMAS, BLACK_SHARE = 0.005, 4.0, 0.01
"""Share of full scale, beside standard deviations of its own mean, by which a block is darker than black, and the share of such blocks from
which the black level is wrong: half a percent of full scale is what a sensor's own pattern makes."""
DARK_SIGMAS, DARK_PIXELS = 10.0, 8
"""A light that lifts fewer pixels than this by so many sigmas is off."""


def sensor_with(sensor: Sensor, stated: StatedSensor, where: str) -> Sensor:
    """The sensor, with what is stated in its place.

    Raises
    ------
    DisagreementError
        Black is not below white.
    """
    found = stated.onto(sensor)
    if found.black_level >= found.white_level:
        raise DisagreementError(
            f"black level {100 * found.black_level:g} %, white level {100 * found.white_level:g} %", where=where, needed="black below white"
        )
    return found


def to_radiance(raw: RawCapture, sensor: Sensor) -> Radiance:
    """A capture made linear, its noise and its saturated pixels known.

    Raises
    ------
    DegenerateError
        All dark (no light lifts any part of the image over its noise), or all saturated.
    DisagreementError
        Numbers that contradict the black or the white level, a raw mosaic, or one image under two names.
    """
    saturated = over_white(raw.images, sensor, raw.step)
    if saturated.all():
        raise DegenerateError(
            "every pixel of every image is saturated", where=raw.name, needed="images below the white level", todo="shorten the exposure"
        )
    refuse_over_white(raw, sensor, saturated)
    refuse_mosaic(raw)
    clipped_at = clipping_level(raw.images, sensor.white_level, raw.step)
    if clipped_at is not None:
        saturated |= over_white(raw.images, replace(sensor, white_level=clipped_at), raw.step)
    signal = _linear(raw, sensor)
    noise = noise_model(signal, saturated, raw.step)
    _refuse_black(raw, sensor, signal)
    same = twins(raw, noise, signal)
    response = sensor.response(signal.shape)
    notes = [*raw.notes, *(f"left out: {name} is no light's" for name in raw.left_out)]
    notes += [] if clipped_at is None else [clipping_words(clipped_at)]
    notes += [NO_AMBIENT] if raw.ambient is None else []
    sigma, ambient = _unit_exposure(raw, sensor, signal, noise, response)
    dark = _dark(raw, signal, sigma)
    short = {light: _short(sensor.linear(image), raw.short_exposure_s.get(light), ambient, response) for light, image in raw.short.items()}
    notes += [*(f"{light} lights nothing: is it off in its image?" for light in dark), *same]
    return Radiance(raw.name, raw.lights, signal, sigma, saturated, ambient / response, short, raw.mask, tuple(notes), dark)


def part_to_radiance(part: RawCapture, sensor: Sensor, noise: tuple[float, float], white: float, response: Image) -> Radiance:
    """The same of a part of a capture's images, of which the noise (see `noise_model`) and where the numbers end are known.

    `response` (h, w) is that of lens and sensor there.
    """
    saturated = over_white(part.images, replace(sensor, white_level=white), part.step)
    signal = _linear(part, sensor)
    response = response[..., None] if signal.ndim == 4 else response
    sigma, ambient = _unit_exposure(part, sensor, signal, noise, response)
    short = {
        light: _short(sensor.linear(image), part.short_exposure_s.get(light), ambient, response) for light, image in part.short.items()
    }
    return Radiance(part.name, part.lights, signal, sigma, saturated, ambient / response, short)


def _linear(raw: RawCapture, sensor: Sensor) -> Image:
    """The linear numbers of the lights' images."""
    signal = np.empty(raw.images.shape, np.float32)

    def fill(k: int) -> None:
        signal[k] = sensor.linear(raw.images[k])

    parallel.run_all(fill, range(len(signal)))
    return signal


def _unit_exposure(raw: RawCapture, sensor: Sensor, linear: Image, noise: tuple[float, float], response: Image) -> tuple[Image, Image]:
    """Sigma of the signals, and the ambient light; the linear numbers are made signals in their place."""
    ambient = ambient_variance = np.zeros(linear.shape[1:], np.float32)
    if raw.ambient is not None:
        ambient_linear = sensor.linear(raw.ambient)
        times = raw.ambient_exposure_s.astype(np.float32).reshape(-1, *[1] * (linear.ndim - 1))
        ambient = np.asarray(np.mean(ambient_linear / times, axis=0), np.float32)
        ambient_variance = np.asarray(np.mean(_variance(ambient_linear, noise) / times**2, axis=0) / len(ambient_linear), np.float32)
    sigma = np.empty(linear.shape, np.float32)
    uneven = None if np.all(response == 1) else response
    exposures = raw.exposure_s.astype(np.float32)

    def of(k: int) -> None:
        _unit_exposure_of(linear[k], sigma[k], exposures[k], noise, (ambient, ambient_variance), uneven)

    parallel.run_all(of, range(len(linear)))
    return sigma, ambient


def _unit_exposure_of(
    lit: Image, std: Image, exposure: np.float32, noise: tuple[float, float], room: tuple[Image, Image], response: Image | None
) -> None:
    """One light's linear numbers made a signal, and its sigma, each in its place: an image fills a core's cache.

    Of an exposure of 1 and without a `response` nothing is divided: of a hundred images that is half of the work.
    """
    np.maximum(lit, 0.0, out=std)
    std *= np.float32(noise[1])
    std += np.float32(noise[0])
    if exposure != 1:
        std /= exposure**2
        lit /= exposure
    std += room[1]
    np.sqrt(std, out=std)
    lit -= room[0]
    if response is not None:
        std /= response
        lit /= response


def _refuse_black(raw: RawCapture, sensor: Sensor, linear: Image) -> None:
    """Stop where blocks of pixels are darker than no light at all, by more than their noise makes them; images without light show none."""
    if raw.images.max() <= BLACK_OFF:
        return
    mean, scatter = _blocks(linear)
    below = mean < -(BLACK_OFF + BLACK_SIGMAS * scatter / BLACK_BLOCK)
    if below.size == 0 or below.mean() < BLACK_SHARE:
        return
    darkest = 100 * float(np.percentile(_blocks(raw.images)[0], 100 * BLACK_SHARE))
    raise DisagreementError(
        f"{100 * below.mean():.0f} % of the image is darker than black: the black level is stated as {100 * sensor.black_level:.3g} % of "
        f"full scale, the darkest places are at {darkest:.2g} %",
        where=raw.name,
        needed="the black level of these images, what they hold with the lens cap on",
        todo="correct black_level (capture.yaml, --black-level, or camera: in panel.yaml)",
    )


def _blocks(images: Image) -> tuple[Image, Image]:
    """Mean and standard deviation (L, h, w) of square blocks of images (L, H, W) or (L, H, W, 3), the channels joined."""
    h, w = images.shape[1] // BLACK_BLOCK, images.shape[2] // BLACK_BLOCK
    mean, std = np.empty((len(images), h, w), np.float32), np.empty((len(images), h, w), np.float32)
    for k, image in enumerate(images):
        grey = image if image.ndim == 2 else image.mean(axis=2)
        mean[k] = middle = raster.block_means(grey, BLACK_BLOCK)
        std[k] = np.sqrt(np.maximum(raster.block_means(np.square(grey, dtype=np.float64), BLACK_BLOCK) - middle**2, 0.0))
    return mean, std


def noise_model(linear: Image, saturated: Mask, step: float) -> tuple[float, float]:
    """(a, c) of variance = a + c * mean, from the finest detail of images linear (L, H, W[, 3]).

    The second difference along both axes (kernel of Immerkaer 1996) leaves noise where an image is smooth. Of the blocks of one
    brightness those in the lower quarter of its variance count, so that texture and edges do not.
    """
    found = parallel.run_all(lambda k: _levels_of(linear[k], saturated[k]), range(len(linear)))
    level, variance = (np.concatenate(parts).astype(float) for parts in zip(*found, strict=True))
    quantisation = (step**2) / 12
    if level.size < 20 * NOISE_BINS:
        return quantisation, 0.0
    which = np.argsort(np.argsort(level)) * NOISE_BINS // level.size
    middle = np.array([level[which == k].mean() for k in range(NOISE_BINS)])
    lower = np.array([max(np.quantile(variance[which == k], 0.25), 0.25 * quantisation) for k in range(NOISE_BINS)]) / LOWER_QUARTER
    c, a = _line_through_lower(middle, lower)
    return max(a, quantisation), max(c, 0.0)


def _levels_of(linear: Image, saturated: Mask) -> tuple[Image, Image]:
    """Levels and variances of the finest detail of the unsaturated blocks of an image (H, W) or (H, W, 3)."""
    stack = linear[None] if linear.ndim == 2 else np.moveaxis(linear, 2, 0)
    kernel_rows = stack[:, :-2] - 2 * stack[:, 1:-1] + stack[:, 2:]
    detail = (kernel_rows[:, :, :-2] - 2 * kernel_rows[:, :, 1:-1] + kernel_rows[:, :, 2:]) / 6.0
    level, variance = _block_mean(stack[:, 1:-1, 1:-1]), _block_mean(detail**2)
    if not saturated.any():
        return level.ravel(), variance.ravel()
    fine = np.broadcast_to(_block_mean(saturated[None, 1:-1, 1:-1].astype(np.float32)) == 0, level.shape)
    return level[fine], variance[fine]


def _block_mean(images: Image) -> Image:
    """Mean (L, h, w) over blocks of images (L, H, W)."""
    rows, columns = (side // NOISE_BLOCK_PX for side in images.shape[1:])
    cut = images[:, : rows * NOISE_BLOCK_PX, : columns * NOISE_BLOCK_PX]
    return np.asarray(cut.reshape(-1, rows, NOISE_BLOCK_PX, columns, NOISE_BLOCK_PX).mean(axis=(2, 4)))


def fit_flat_field(stored: Image, sensor: Sensor) -> FlatField:
    """The smooth response of lens and sensor from an image of an evenly lit target, (H, W) or (H, W, 3).

    A polynomial in the logarithm of block medians: the image's own noise and dust do not enter.

    Raises
    ------
    DegenerateError
        The image is dark or saturated.
    """
    grey = stored.mean(axis=2) if stored.ndim == 3 else stored
    linear = sensor.linear(grey)
    height, width = (side // FLAT_BLOCK_PX * FLAT_BLOCK_PX for side in linear.shape)
    blocks = linear[:height, :width].reshape(height // FLAT_BLOCK_PX, FLAT_BLOCK_PX, width // FLAT_BLOCK_PX, FLAT_BLOCK_PX)
    median = np.median(blocks, axis=(1, 3)).astype(float)
    saturated = np.mean(grey >= sensor.white_level - 1e-6)
    if np.median(median) < 0.02 or saturated > 0.05:
        raise DegenerateError(
            "dark" if np.median(median) < 0.02 else f"{100 * saturated:.0f} % of the pixels are saturated",
            where="camera.flat_field",
            needed="an evenly lit target at half of full scale",
            todo="take it again, or leave the key out",
        )
    rows = np.arange(median.shape[0]) * FLAT_BLOCK_PX + (FLAT_BLOCK_PX - 1) / 2.0
    columns = np.arange(median.shape[1]) * FLAT_BLOCK_PX + (FLAT_BLOCK_PX - 1) / 2.0
    terms = FlatField.terms(rows.astype(float), columns.astype(float), linear.shape, FLAT_DEGREE).reshape(-1, (FLAT_DEGREE + 1) ** 2)
    kept = FlatField.kept(FLAT_DEGREE)
    log_median, weight = np.log(np.maximum(median.ravel(), 1e-4)), np.ones(median.size)
    found = np.zeros(kept.sum())
    for _ in range(5):
        found = np.linalg.lstsq(terms[:, kept] * weight[:, None], log_median * weight, rcond=None)[0]
        residual = np.abs(log_median - terms[:, kept] @ found)
        weight = np.minimum(1.0, 2 * np.median(residual) / np.maximum(residual, 1e-12))
    coefficients = np.zeros((FLAT_DEGREE + 1) ** 2)
    coefficients[kept] = found
    flat = FlatField(coefficients.reshape(FLAT_DEGREE + 1, FLAT_DEGREE + 1))
    coefficients[0] -= np.log(flat.response(linear.shape).max())
    return FlatField(coefficients.reshape(FLAT_DEGREE + 1, FLAT_DEGREE + 1))


def _short(linear: Image, exposure_s: float | None, ambient: Image, response: Image) -> Image:
    """A shorter exposure (H, W[, 3]) on the long ones' scale; where its exposure is not stated, on a scale of its own."""
    signal = linear if exposure_s is None else linear / np.float32(exposure_s) - ambient
    return np.asarray(signal / response, np.float32)


def over_white(images: Image, sensor: Sensor, step: float) -> Mask:
    """Saturated pixels (L, H, W) of stored images, in any channel."""
    over = images >= sensor.white_level - 0.5 * step
    return np.asarray(over.any(axis=3) if over.ndim == 4 else over)


def _variance(linear: Image, noise: tuple[float, float]) -> Image:
    return np.asarray(noise[0] + noise[1] * np.maximum(linear, 0.0), dtype=np.float32)


def _line_through_lower(x: Array, y: Array) -> tuple[float, float]:
    """Slope and offset of a line with noise-like (never negative) values, points above it (texture) weighing less."""
    weight = 1 / np.maximum(y, np.median(y) * 0.1)
    slope = offset = 0.0
    for _ in range(10):
        A = np.stack([x, np.ones_like(x)], axis=1)
        slope, offset = np.linalg.lstsq(A * weight[:, None], y * weight, rcond=None)[0]
        if slope < 0:  # a clipped one alone would leave the other's line
            slope, offset = 0.0, np.average(y, weights=weight**2)
        elif offset < 0:
            slope, offset = np.sum(weight**2 * x * y) / np.sum(weight**2 * x**2), 0.0
        line = np.maximum(slope * x + offset, 1e-12)
        weight = np.where(y > line, (line / y) ** 2, 1.0) / line
    return float(slope), float(offset)


def _dark(raw: RawCapture, signal: Image, sigma: Image) -> tuple[str, ...]:
    """Lights that lift only a few pixels well over their noise: they are off. All of them: the capture is dark, and refused."""
    reached = [np.sum(lit > DARK_SIGMAS * std) for lit, std in zip(signal, sigma, strict=True)]
    dark = tuple(light for light, pixels in zip(raw.lights, reached, strict=True) if pixels < DARK_PIXELS)
    if len(dark) == len(raw.lights):
        raise DegenerateError(
            "all dark: no light lifts the image over its noise" + (" and the ambient light" if raw.ambient is not None else ""),
            where=raw.name,
            needed="images lit by one light each",
            todo="check the lights, the exposure and the ambient image",
        )
    return dark
