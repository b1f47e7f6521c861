"""Several exposures of one capture: short ones where the long ones saturate.

Symbols: linear numbers l of an exposure t give the signal ``l / t - ambient`` (see detect.radiometry); a sample that is saturated at the
long exposure and not at the short one takes the short one's signal and noise.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.detect.radiometry import noise_model, over_white
from lpcal.records.observations import Radiance, RawCapture
from lpcal.records.sensor import Sensor


def with_short_exposures(radiance: Radiance, raw: RawCapture, sensor: Sensor) -> Radiance:
    """The radiance with its saturated samples taken from shorter exposures, of those lights that have one whose exposure is stated."""
    stated = {light: t for light, t in raw.short_exposure_s.items() if t is not None}
    if not stated:
        return radiance
    signal, sigma, saturated = radiance.signal.copy(), radiance.sigma.copy(), radiance.saturated.copy()
    a, c = noise_model(sensor.linear(raw.images), radiance.saturated, raw.step)
    response = sensor.response(radiance.signal.shape)
    taken = 0
    for k, light in enumerate(radiance.lights):
        if light not in stated:
            continue
        usable = radiance.saturated[k] & ~over_white(raw.short[light][None], sensor, raw.step)[0]
        noise = np.sqrt(a + c * np.maximum(sensor.linear(raw.short[light]), 0)) / stated[light] / response
        signal[k][usable], sigma[k][usable], saturated[k][usable] = radiance.short[light][usable], noise[usable], False
        taken += int(usable.sum())
    note = f"{taken} saturated samples taken from shorter exposures"
    return replace(radiance, signal=signal, sigma=sigma, saturated=saturated, notes=(*radiance.notes, note)) if taken else radiance
