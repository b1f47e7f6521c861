"""The sensor that a capture is made linear by: what is stated, what its files claim of it, and whether the object bears that out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.api.sensor import sensor_of_capture
from lpcal.detect.radiometry import over_white
from lpcal.detect.response import Curve, ShownResponse, stored_curve
from lpcal.errors import DisagreementError
from lpcal.geometry.arrays import Array
from lpcal.geometry.tone_curve import Gamma, decode, worded
from lpcal.records.calibration import Calibration
from lpcal.records.observations import RawCapture
from lpcal.records.sensor import Sensor, SensorInUse, StatedSensor, ToneClaim
from lpcal.surface.self_calibration import unmeasured
from lpcal.view.pixel_list import light_vectors, rays_at

PIXELS = 1500
"""Pixels that are looked at, spread over the brighter half of the picture."""
LIGHTS = 24
"""Lights of which as many are looked at, spread over all: more show no curve that these do not."""
LIT = 0.25
"""Mean over the lights, less the room's, of the brightest pixels' mean, over which a pixel counts as lit."""
BY_CLAIM = "the images' own tag"
CURE = "state gamma: srgb in capture.yaml, or --gamma srgb"
SRGB_AS_GOOD = 1.1
"""sRGB is named as the cure where it misses by less than this many times what the best power does."""


@dataclass(frozen=True)
class Settled:
    """A sensor, and what the object says against it."""

    used: SensorInUse
    notes: tuple[str, ...] = ()
    linear: bool = True
    """Whether the numbers so made are linear by the object, as far as it shows that."""


def settle_sensor(raw: RawCapture, calibration: Calibration, saying: Sequence[tuple[str, StatedSensor]]) -> Settled:
    """The sensor of a capture and notes on it.

    `saying` is what is said of it and who says it, what counts more first; capture.yaml's flat field and what the images themselves show
    are added here.

    Raises
    ------
    DisagreementError
        Black is not below white; or the numbers are clearly not linear, and the curve by which they are stored is not stated.
    DegenerateError
        The flat field is dark or saturated.
    """
    used = sensor_of_capture(raw, saying)
    if "gamma" in used.said_by:
        return _stated_gamma_judged(raw, used, calibration)
    return _claim_judged(raw, used, calibration)


def _stated_gamma_judged(raw: RawCapture, used: SensorInUse, calibration: Calibration) -> Settled:
    """With a warning where the object contradicts the gamma that is stated."""
    gamma = used.sensor.gamma
    curve = curve_of(raw, used.sensor, calibration, "srgb" if gamma == 1.0 else 1.0)
    if curve is None or not curve.believed:
        return Settled(used)
    note = (
        f"gamma {worded(gamma)} ({used.said_by['gamma']}) does not suit the images: with it they miss the lights by "
        f"{100 * curve.misfit_taken:.1f} %, with gamma {curve.gamma:.1f} by {100 * curve.misfit:.1f} %; is it right?"
    )
    return Settled(used, (note,), linear=False)


def _claim_judged(raw: RawCapture, used: SensorInUse, calibration: Calibration) -> Settled:
    """With the gamma that the images claim where the object bears it out, and notes where none is stated."""
    claim = raw.claim if raw.claim is not None and raw.claim.gamma != 1.0 else None
    claimed = "srgb" if claim is None or claim.gamma is None else claim.gamma
    curve = curve_of(raw, used.sensor, calibration, claimed)
    if curve is None:
        return Settled(used) if claim is None else _undecided(used, claim)
    figures = f"taken as linear they miss the lights by {100 * curve.misfit_taken:.1f} %"
    if claim is not None and claim.gamma is not None and curve.claim_explains and (curve.believed or curve.doubtful):
        note = f"the images {claim.said}; {figures}, so by {100 * curve.misfit_claimed:.1f} %: it is undone"
        return Settled(_by_claim(used, claim.gamma), (note,))
    if curve.believed:
        raise _not_linear(raw, curve)
    if not curve.doubtful and (claim is None or not curve.claim_is_better):
        return Settled(used)
    who = f"the images {claim.said}" if claim is not None else "the stored numbers may not be linear"
    as_what = worded(claimed) if curve.misfit_claimed <= curve.misfit else f"{curve.gamma:.1f}"
    better = f"with gamma {as_what} by {100 * min(curve.misfit, curve.misfit_claimed):.1f} %"
    return Settled(used, (f"{who}: {figures}, {better}: if they are photographs, {CURE}",), linear=False)


def _undecided(used: SensorInUse, claim: ToneClaim) -> Settled:
    """Where the object does not decide, a camera's photographs are taken as such, other images as linear; both are reported."""
    undecided = f"the images {claim.said}, and too few lights or pixels show whether their numbers are linear"
    if claim.photograph and claim.gamma is not None:
        remark = f"{undecided}; sRGB's curve is undone: if they are linear, state gamma: 1 in capture.yaml, or --gamma 1"
        return Settled(_by_claim(used, claim.gamma), (remark,), linear=False)
    return Settled(used, (f"{undecided}; they are taken so: if they are photographs, {CURE}",), linear=False)


def _by_claim(used: SensorInUse, gamma: Gamma) -> SensorInUse:
    return SensorInUse(replace(used.sensor, gamma=gamma), used.said_by | {"gamma": BY_CLAIM})


def _not_linear(raw: RawCapture, curve: Curve) -> DisagreementError:
    srgb = curve.misfit_claimed < SRGB_AS_GOOD * curve.misfit
    cure = "srgb" if srgb else f"{curve.gamma:.1f}"
    return DisagreementError(
        f"the stored numbers are not linear: taken so they miss the lights by {100 * curve.misfit_taken:.1f} %, "
        f"with gamma {curve.gamma:.1f} by {100 * curve.misfit:.1f} %",
        where=raw.name,
        needed="linear images, or their gamma",
        todo=f"state gamma: {cure} in capture.yaml, or --gamma {cure}"
        + ("" if srgb else " (srgb for photographs)")
        + ", or develop raw files linearly",
    )


def curve_of(raw: RawCapture, sensor: Sensor, calibration: Calibration, claimed: Gamma) -> Curve | None:
    """The curve that explains a capture's numbers best; None where too few lights or pixels show it."""
    some = np.unique(np.linspace(0, len(raw.lights) - 1, min(LIGHTS, len(raw.lights))).astype(int))
    lights = [light for k in some for light in calibration.lights if light.name == raw.lights[k]]
    images = raw.images if len(some) == len(raw.lights) else raw.images[some]
    channels = images if images.ndim == 4 else images[..., None]
    mean = channels.mean(axis=(0, 3))
    if raw.ambient is not None:
        mean = mean - raw.ambient.reshape(len(raw.ambient), *mean.shape, -1).mean(axis=(0, 3))
    lit = mean > LIT * np.quantile(mean, 0.99)
    lit &= raw.mask if raw.mask is not None else True
    places = np.flatnonzero(lit)
    if len(places) == 0:
        return None
    places = places[np.unique(np.linspace(0, len(places) - 1, PIXELS).astype(int))]
    stored = channels.reshape(len(channels), -1, channels.shape[3])[:, places].astype(float)
    room = None if raw.ambient is None else raw.ambient.reshape(len(raw.ambient), -1, channels.shape[3])[:, places].astype(float)

    def light(curve: Gamma) -> Array:
        dark = decode(np.array([sensor.black_level]), curve)
        linear = (decode(stored, curve) - dark) / raw.exposure_s[some, None, None]
        if room is not None:
            linear = linear - np.mean((decode(room, curve) - dark) / raw.ambient_exposure_s[:, None, None], axis=0)
        return np.clip(linear.mean(axis=2), 0, None)

    shown = channels.reshape(len(channels), 1, -1, channels.shape[3])[:, :, places]
    usable = ~over_white(shown, sensor, raw.step)[:, 0]
    rays_C = rays_at(np.stack(np.unravel_index(places, mean.shape)[::-1], axis=1), calibration.camera)
    direction, irradiance = light_vectors(lights, (calibration.d_object_m or 0.35) * rays_C)
    strength = irradiance * np.array([[one.intensity.mean()] for one in lights])
    B = direction * strength[..., None]
    B = B if room is not None else np.concatenate([B, np.ones((*B.shape[:2], 1))], axis=2)
    return stored_curve(ShownResponse(light, usable, B, unmeasured(lights)), sensor.gamma, claimed)
