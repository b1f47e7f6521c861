r"""Several exposures of one capture: short ones where the long ones saturate.

Symbols: linear numbers l of an exposure t give the signal ``l / t - ambient`` (see detect.radiometry); a sample that is saturated at the
long exposure and not at the short one takes the short one's signal and noise.

What a sweep of exposures of a still scene says of the sensor: black level, gamma, noise, and whether it holds still at all.

Symbols: stored number s of a block of pixels with radiance L under exposure t, black b, gamma g::

    s^g = b^g + t L        b, g and every L by least squares over the blocks, for each g linear in the rest
    log mean(s) against log t has the slope 1 / g where little is black; none where the camera sets its exposure by itself

Source: EMVA 1288, linearity and photon transfer.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lpcal.detect.radiometry import noise_model, over_white
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry.arrays import Array, Image
from lpcal.geometry.tone_curve import exponent, worded
from lpcal.records.observations import Radiance, RawCapture
from lpcal.records.sensor import Sensor


def with_short_exposures(
    radiance: Radiance, raw: RawCapture, sensor: Sensor, response: Image | None = None, noise: tuple[float, float] | None = None
) -> Radiance:
    """The radiance with its saturated samples taken from shorter exposures, of those lights that have one whose exposure is stated.

    Of a part of a capture the response of lens and sensor, and the noise, are given.
    """
    stated = {light: t for light, t in raw.short_exposure_s.items() if t is not None}
    if not stated:
        return radiance
    signal, sigma, saturated = radiance.signal.copy(), radiance.sigma.copy(), radiance.saturated.copy()
    a, c = noise or noise_model(sensor.linear(raw.images), radiance.saturated, raw.step)
    response = sensor.response(radiance.signal.shape) if response is None else response
    taken = 0
    for k, light in enumerate(radiance.lights):
        if light not in stated:
            continue
        usable = radiance.saturated[k] & ~over_white(raw.short[light][None], sensor, raw.step)[0]
        std = np.sqrt(a + c * np.maximum(sensor.linear(raw.short[light]), 0)) / stated[light] / response
        signal[k][usable], sigma[k][usable], saturated[k][usable] = radiance.short[light][usable], std[usable], False
        taken += int(usable.sum())
    note = f"{taken} saturated samples taken from shorter exposures"
    return replace(radiance, signal=signal, sigma=sigma, saturated=saturated, notes=(*radiance.notes, note)) if taken else radiance


BLOCK_PX, MOST_BLOCKS = 8, 600
FEWEST_IMAGES, FEWEST_BLOCKS, LEAST_SPAN = 3, 50, 2.0
FOLLOWS = 0.3
"""Brightness that rises with a smaller power of the exposure than this does not follow it."""
GAMMA_OFF, BLACK_OFF, CURVE_OFF = 0.06, 0.004, 0.02
"""A gamma off by this share, a black level by this share of full scale, a curve that misses by this share of its level."""


@dataclass(frozen=True)
class SweepFit:
    """Black level as a fraction of full scale, gamma, rms misfit of the curve over its level, noise (a, c) of linear numbers."""

    black_level: float
    gamma: float
    misfit: float
    noise: tuple[float, float]


def fit_sweep(images: Image, exposure_s: Array, sensor: Sensor, step: float) -> SweepFit:
    """The sensor's curve from images (N, H, W) of one still scene under exposures (N,).

    Raises
    ------
    DegenerateError
        Too few images, exposures too much alike, or too little that is neither dark nor saturated.
    DisagreementError
        The brightness does not follow the exposure: the camera sets it by itself.
    """
    from scipy.optimize import minimize_scalar

    if len(images) < FEWEST_IMAGES or exposure_s.max() < LEAST_SPAN * exposure_s.min():
        raise DegenerateError(
            f"{len(images)} exposures from {1e3 * exposure_s.min():g} to {1e3 * exposure_s.max():g} ms",
            where="camera.exposure_sweep",
            needed=f"{FEWEST_IMAGES} or more over a factor of {LEAST_SPAN:g}",
            todo="take more",
        )
    level = _blocks(images, sensor.white_level - 1.5 * step)
    if level.shape[1] < FEWEST_BLOCKS:
        raise DegenerateError(
            f"only {level.shape[1]} blocks of {BLOCK_PX} px are unsaturated in all images",
            where="camera.exposure_sweep",
            needed=f"{FEWEST_BLOCKS}",
            todo="shorten the longest exposure",
        )
    bright = level[:, level.mean(axis=0) >= np.median(level.mean(axis=0))].mean(axis=1)
    slope = float(np.polyfit(np.log(exposure_s), np.log(np.maximum(bright, step)), 1)[0])
    if slope < FOLLOWS:
        raise DisagreementError(
            f"the images' brightness goes as the exposure to the power {slope:.2f}: it does not follow it",
            where="camera.exposure_sweep",
            needed="exposures as capture.yaml states them, gain and tone held",
            todo="switch auto-exposure and automatic gain off, and state each image's exposure",
        )
    best = minimize_scalar(lambda g: _fit(level, exposure_s, float(g))[1], bounds=(0.4, 3.0), method="bounded", options={"xatol": 1e-3})
    gamma = float(best.x)
    offset, misfit = _fit(level, exposure_s, gamma)
    linear = sensor.linear(images)
    noise = noise_model(linear, images >= sensor.white_level - 0.5 * step, step)
    return SweepFit(float(max(offset, 0.0) ** (1 / gamma)), gamma, misfit, noise)


def refuse_contradiction(found: SweepFit, sensor: Sensor) -> None:
    """Refuse a stated gamma or black level that the sweep contradicts, or a curve that is no gamma.

    Raises
    ------
    DisagreementError
        Which, and what it would be.
    """
    where = "camera.exposure_sweep"
    if found.misfit > CURVE_OFF:
        raise DisagreementError(
            f"no gamma makes the sweep linear: the best, {found.gamma:.2f}, misses by {100 * found.misfit:.1f} %",
            where=where,
            needed="stored numbers that are a power of the light",
            todo="switch the camera's tone curve off; did the scene or its light change during the sweep?",
        )
    if abs(found.gamma / exponent(sensor.gamma) - 1) > GAMMA_OFF:
        raise DisagreementError(
            f"the sweep says that the camera stores with gamma {found.gamma:.2f}, not {worded(sensor.gamma)}",
            where=where,
            needed="the camera's own gamma",
            todo=f"write gamma: {found.gamma:.2f} under camera: in panel.yaml, or switch the camera's gamma off",
        )
    if abs(found.black_level - sensor.black_level) > BLACK_OFF:
        raise DisagreementError(
            f"the sweep says that black is {100 * found.black_level:.2f} % of full scale, not {100 * sensor.black_level:g} %",
            where=where,
            needed="the number that a pixel without light has",
            todo=f"write black_level: {100 * found.black_level:.2f} % under camera: in panel.yaml",
        )


def _blocks(images: Image, white: float) -> Array:
    """Means (N, blocks) of the blocks that no image saturates, evenly taken from all."""
    grey = images if images.ndim == 3 else images.mean(axis=3)
    rows, columns = (side // BLOCK_PX for side in grey.shape[1:])
    cut = grey[:, : rows * BLOCK_PX, : columns * BLOCK_PX].reshape(-1, rows, BLOCK_PX, columns, BLOCK_PX)
    full = cut.max(axis=(0, 2, 4)).ravel() >= white
    level = cut.mean(axis=(2, 4)).reshape(len(grey), -1)[:, ~full].astype(float)
    return level[:, :: max(1, level.shape[1] // MOST_BLOCKS)]


def _fit(level: Array, exposure_s: Array, gamma: float) -> tuple[float, float]:
    """Offset b^g, and the rms misfit of the stored numbers over their mean, for one gamma."""
    t = exposure_s / exposure_s.mean()
    y = level**gamma
    # per block: y = offset + t L; the offset shared, L projected out
    along = t / (t @ t)
    apart = np.eye(len(t)) - np.outer(t, along)
    one, rest = apart.sum(axis=1), apart @ y
    offset = float((one @ rest).mean() / (one @ one))
    model = offset + np.outer(t, along @ (y - offset))
    back = np.maximum(model, 1e-9) ** (1 / gamma)
    return offset, float(np.sqrt(np.mean((back - level) ** 2)) / level.mean())
