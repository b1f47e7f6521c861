"""Several exposures of one capture: short ones where the long ones saturate, ambient images before and after.

Symbols: linear numbers l of an exposure t give the signal ``l / t - ambient`` (see detect.radiometry); a sample that is saturated at the
long exposure and not at the short one takes the short one's signal and noise.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.detect.radiometry import Sensor, noise_model
from lpcal.errors import DisagreementError
from lpcal.geometry.arrays import Image, Mask
from lpcal.records.observations import Radiance, RawCapture

DRIFT_SHARE = 0.05
"""Of the ambient light, or of the light of the lamps where that is less: a change that is worth a word."""
BRIGHTER = 0.98
"""Lit images under this share of the ambient one are darker, beyond noise."""


def with_short_exposures(radiance: Radiance, raw: RawCapture, sensor: Sensor) -> Radiance:
    """The radiance with its saturated samples taken from shorter exposures, of those lights that have one whose exposure is stated."""
    stated = {light: t for light, t in raw.short_exposure_s.items() if t is not None}
    if not stated:
        return radiance
    signal, sigma, saturated = radiance.signal.copy(), radiance.sigma.copy(), radiance.saturated.copy()
    a, c = noise_model(sensor.linear(raw.images), radiance.saturated, raw.step)
    response = _response(sensor, radiance.signal.shape)
    taken = 0
    for k, light in enumerate(radiance.lights):
        if light not in stated:
            continue
        usable = radiance.saturated[k] & ~_saturated(raw.short[light], sensor, raw.step)
        noise = np.sqrt(a + c * np.maximum(sensor.linear(raw.short[light]), 0)) / stated[light] / response
        signal[k][usable], sigma[k][usable], saturated[k][usable] = radiance.short[light][usable], noise[usable], False
        taken += int(usable.sum())
    note = f"{taken} saturated samples taken from shorter exposures"
    return replace(radiance, signal=signal, sigma=sigma, saturated=saturated, notes=(*radiance.notes, note)) if taken else radiance


def ambient_notes(radiance: Radiance, raw: RawCapture, sensor: Sensor) -> tuple[str, ...]:
    """What is to be said of the ambient light: that it changed between its images, that it is stronger than the lights."""
    if raw.ambient is None:
        return ()
    found = []
    times = raw.ambient_exposure_s.reshape(-1, *[1] * (raw.ambient.ndim - 1))
    ambient = sensor.linear(raw.ambient) / times
    level = float(ambient.mean())
    lamps = float(np.median(radiance.signal.max(axis=0) * _response(sensor, radiance.signal.shape)))
    each = ambient.reshape(len(ambient), -1).mean(axis=1)
    if np.ptp(each) > DRIFT_SHARE * min(abs(level), lamps):
        change = 100 * np.ptp(each) / max(abs(level), 1e-12)
        found.append(f"the ambient light changed by {change:.0f} % between its {len(each)} images; their mean was taken away")
    if level > lamps > 0:
        found.append(f"more ambient light than lamp light (the brightest lamp adds {100 * lamps / level:.0f} % of it): shade the scene")
    return tuple(found)


def refuse_bright_ambient(raw: RawCapture, sensor: Sensor) -> None:
    """Refuse an ambient image that is brighter than the images of all lights: they were not taken alike.

    Raises
    ------
    DisagreementError
        It is.
    """
    if raw.ambient is None:
        return
    axes = tuple(range(1, raw.images.ndim))
    lit = sensor.linear(raw.images).mean(axis=axes) / raw.exposure_s
    ambient = sensor.linear(raw.ambient).mean(axis=axes) / raw.ambient_exposure_s
    if ambient.min() > 0 and lit.max() < BRIGHTER * ambient.min():
        raise DisagreementError(
            f"the ambient image is brighter than the lit ones: {100 * ambient.min() / lit.max():.0f} % of the brightest of them",
            where=raw.name,
            needed="an ambient image with all lights off, at the exposure of the others or with its own stated",
            todo="take it anew, or state exposure: and exposures: in capture.yaml",
        )


def _saturated(image: Image, sensor: Sensor, step: float) -> Mask:
    over = image >= sensor.white_level - 0.5 * step
    return np.asarray(over.any(axis=-1) if over.ndim == 3 else over)


def _response(sensor: Sensor, shape: tuple[int, ...]) -> Image:
    if sensor.flat_field is None:
        return np.ones((1, 1, 1)[: len(shape) - 1], np.float32)
    response = sensor.flat_field.response(shape[1:3])
    return response[..., None] if len(shape) == 4 else response
