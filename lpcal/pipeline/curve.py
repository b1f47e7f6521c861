"""Whether a capture's stored numbers are linear, as its calibration or the user says they are."""

from __future__ import annotations

import numpy as np

from lpcal.detect.radiometry import Sensor, over_white
from lpcal.errors import DisagreementError
from lpcal.records.calibration import Calibration
from lpcal.records.observations import RawCapture, StatedSensor
from lpcal.surface.response import Curve, stored_curve
from lpcal.surface.sight import light_vectors, ray_map

PIXELS = 3000
"""Pixels that are looked at, spread over the brighter half of the picture."""
LIT = 0.25
"""Mean over the lights, of the brightest pixels' mean, over which a pixel counts as lit."""


def judge_curve(raw: RawCapture, sensor: Sensor, calibration: Calibration, stated: StatedSensor) -> list[str]:
    """What is to be said of the numbers' curve.

    Raises
    ------
    DisagreementError
        They are clearly not linear, and nobody has said by what curve they are stored.
    """
    curve = curve_of(raw, sensor, calibration)
    if curve is None or not curve.believed:
        return []
    gamma = sensor.gamma * curve.gamma
    found = (
        f"the stored numbers are not linear: taken so they miss the lights by {100 * curve.misfit_linear:.1f} %, "
        f"with gamma {gamma:.1f} by {100 * curve.misfit:.1f} %"
    )
    if stated.gamma is not None:
        return [f"{found}; gamma {stated.gamma:g} is stated"]
    raise DisagreementError(
        found,
        where=raw.name,
        needed="linear images, or their gamma",
        todo=f"state gamma: {gamma:.1f} in capture.yaml, or --gamma {gamma:.1f} (2.2 for sRGB photographs), or develop raw files linearly",
    )


def curve_of(raw: RawCapture, sensor: Sensor, calibration: Calibration) -> Curve | None:
    """The curve that explains a capture's numbers best; None where too few lights or pixels tell it."""
    lights = [light for name in raw.lights for light in calibration.lights if light.name == name]
    grey = raw.images.mean(axis=3) if raw.images.ndim == 4 else raw.images
    mean = grey.mean(axis=0)
    lit = mean > LIT * np.quantile(mean, 0.99)
    lit &= raw.mask if raw.mask is not None else True
    places = np.flatnonzero(lit)
    if len(places) == 0:
        return None
    places = places[np.unique(np.linspace(0, len(places) - 1, PIXELS).astype(int))]
    linear = sensor.linear(grey.reshape(len(grey), -1)[:, places])
    if raw.ambient is not None:
        room = raw.ambient.mean(axis=0)
        linear = linear - sensor.linear((room.mean(axis=2) if room.ndim == 3 else room).ravel()[places])
    usable = ~over_white(raw.images, sensor, raw.step).reshape(len(grey), -1)[:, places]
    rays_C = ray_map(mean.shape, calibration.camera).reshape(-1, 3)[places]
    distance_m = calibration.d_object_m or 0.35
    direction, irradiance = light_vectors(lights, distance_m * rays_C)
    strength = irradiance * np.array([[light.intensity.mean()] for light in lights])
    exposure = raw.exposure_s.reshape(-1, 1)
    return stored_curve(np.clip(linear, 0, None) / exposure, usable, direction * strength[..., None])
