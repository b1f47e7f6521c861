"""The room's light: whether its image can be one, whether it changed between images, whether it is stronger than the lights.

Symbols: linear numbers l of an exposure t give the light ``l / t`` (see detect.radiometry); in the shadow of a light its image less the
ambient one is nothing, so what is there in shares of the ambient light is how much the room changed.
"""

from __future__ import annotations

import numpy as np

from lpcal.errors import DisagreementError
from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.observations import Radiance, RawCapture
from lpcal.records.sensor import Sensor
from lpcal.view import parallel

BLOCK_PX, FEWEST_BLOCKS = 8, 40
ROOM_SHARE, ROOM_SIGMAS = 0.3, 30.0
"""Blocks with less ambient light than this share of its median, or than so many sigmas, say nothing about it."""
DARKEST = 0.02
"""This share of the blocks is taken to be in shadow."""
SHADOWS_DARKER, SHADOWS_BRIGHTER = 0.08, 0.12
"""Relative change of the ambient light in one light's shadows that is warned of; brighter pixels may in fact be lit, so more is needed."""
IN_SHADOW = 0.15
"""Share of the brightest lamp's light above which a light reaches a place, if aslant."""
ALIKE = 0.3
"""Blocks in shadow are brighter by about the same share of the room's light; where the next darkest differ by more, none are in shadow."""
SHADOWS_THROWN, BRIGHT = 0.05, 0.9
"""Share of a light's effect on bright places (their quantile) below which its shadows may be lit by what lit things throw."""
DRIFT_SHARE = 0.05
"""Change that is warned of, as a share of the ambient light or, where that is less, of the lamps' light."""
BRIGHTER = 0.98
"""Lit images under this share of the ambient one are darker, beyond noise."""
FAR_DARKER = 0.3
"""Share of the ambient light that lacks in the shadows of most lights from which its image cannot be one of theirs: a cloud takes less."""


type RoomChanges = dict[str, tuple[float, float]]
"""By light: how much more light there is than the ambient image says where the light does not reach, in shares of the ambient light there,
and of what the light does to bright places."""


def ambient_notes(radiance: Radiance, raw: RawCapture, sensor: Sensor, changes: RoomChanges) -> tuple[str, ...]:
    """Notes on the ambient light: that it changed, that it is stronger than the lights; `changes` are those of `room_changes`."""
    if raw.ambient is None:
        return ()
    level = float(np.mean(_ambient_levels(raw, sensor)))
    lamps = _lamps(radiance, sensor)
    found = ambient_changes(radiance, raw, sensor, changes)
    if level > lamps > 0:
        found += (f"more ambient light than lamp light (the brightest lamp adds {100 * lamps / level:.0f} % of it): shade the scene",)
    return found


def ambient_changes(radiance: Radiance, raw: RawCapture, sensor: Sensor, changes: RoomChanges) -> tuple[str, ...]:
    """Where the ambient light is not what its image says: between its images, or in a light's image by `changes` (see `room_changes`)."""
    if raw.ambient is None:
        return ()
    levels = _ambient_levels(raw, sensor)
    level = abs(float(np.mean(levels)))
    if len(levels) > 1 and np.ptp(levels) > DRIFT_SHARE * min(level, _lamps(radiance, sensor)):
        change = 100 * np.ptp(levels) / max(level, 1e-12)
        return (f"the ambient light changed by {change:.0f} % between its {len(levels)} images; their mean was taken away",)
    return tuple(_changes_in_frames(changes))


def _ambient_levels(raw: RawCapture, sensor: Sensor) -> list[float]:
    """Mean of each ambient image a unit of exposure."""
    if raw.ambient is None:
        return []
    return [float(image.mean()) / float(t) for image, t in zip(sensor.linear(raw.ambient), raw.ambient_exposure_s, strict=True)]


def _lamps(radiance: Radiance, sensor: Sensor) -> float:
    """What the brightest lamp adds to the middle pixel, before the flat field."""
    return float(np.median(radiance.signal.max(axis=0) * sensor.response(radiance.signal.shape)))


def refuse_bright_ambient(raw: RawCapture, sensor: Sensor) -> None:
    """Refuse an ambient image that is brighter than the images of all lights: they were not taken alike.

    Raises
    ------
    DisagreementError
        It is.
    """
    if raw.ambient is None:
        return
    images = ((raw.images, raw.exposure_s), (raw.ambient, raw.ambient_exposure_s))
    lit, ambient = (np.array([sensor.linear(image).mean() for image in some]) / exposure_s for some, exposure_s in images)
    if ambient.min() > 0 and lit.max() < BRIGHTER * ambient.min():
        raise DisagreementError(
            f"the ambient image is brighter than the lit ones: {100 * ambient.min() / lit.max():.0f} % of the brightest of them",
            where=raw.name,
            needed="an ambient image with all lights off, at the exposure of the others or with its own stated",
            todo="take it again, or state exposure: and exposures: in capture.yaml",
        )


def refuse_auto_exposure(radiance: Radiance, raw: RawCapture, sensor: Sensor, changes: RoomChanges) -> None:
    """Refuse a capture whose lit images were exposed less than its ambient image: the room in the shadows is darker under most lights.

    Raises
    ------
    DisagreementError
        The camera set its exposure, gain or tone by itself.
    """
    levels = _ambient_levels(raw, sensor)
    if levels and np.ptp(levels) > DRIFT_SHARE * abs(np.mean(levels)):
        return  # the room's own light changed: its mean is no measure
    _refuse_darker(radiance, changes, SHADOWS_DARKER)


def refuse_foreign_ambient(radiance: Radiance, changes: RoomChanges) -> None:
    """Refuse an ambient image that holds far more light than the shadows of most lights: one of another exposure, or with a lamp on.

    Raises
    ------
    DisagreementError
        It does.
    """
    _refuse_darker(radiance, changes, FAR_DARKER)


def _refuse_darker(radiance: Radiance, changes: RoomChanges, by: float) -> None:
    """Stop where under most lights what they do not reach is darker than in the ambient image by more than a share."""
    darker = [light for light, (change, _) in changes.items() if change < -by]
    if len(darker) > 2 and 2 * len(darker) > len(radiance.lights):
        raise DisagreementError(
            f"under {', '.join(darker)} the places that no light reaches are darker than in the ambient image",
            where=radiance.name,
            needed="exposure, gain and tone held for all images of a capture, or stated in capture.yaml",
            todo="switch auto-exposure and automatic gain off and take it again, all lights off; or state exposures: {ambient: 40 ms, ...}",
        )


def _changes_in_frames(changes: RoomChanges) -> list[str]:
    usual = float(np.median([change for change, _ in changes.values()])) if changes else 0.0
    darker = {light: change for light, (change, _) in changes.items() if change < -SHADOWS_DARKER}
    brighter = {
        light: change
        for light, (change, thrown) in changes.items()
        if change > 3 * max(usual, 0.0) + SHADOWS_BRIGHTER and thrown > SHADOWS_THROWN
    }
    return [
        f"under {', '.join(some)} what no light reaches is {100 * max(map(abs, some.values())):.0f} % {word} than in the ambient "
        "image: did the room's light change, or is auto-exposure on?"
        for some, word in ((darker, "darker"), (brighter, "brighter"))
        if some
    ]


def room_changes(radiance: Radiance) -> RoomChanges:
    """How far the ambient light is from what its image says, by the darkest blocks of each light's image; those without are left out."""
    signal = radiance.signal if radiance.signal.ndim == 3 else radiance.signal.mean(axis=3)
    ambient = radiance.ambient if radiance.ambient.ndim == 2 else radiance.ambient.mean(axis=2)
    room = _block_mean(ambient)
    bright = room > max(ROOM_SHARE * float(np.median(room)), 0.0)
    lamps = np.stack(parallel.run_all(_block_mean, signal))
    dark = IN_SHADOW * np.maximum(lamps.max(axis=0), 0.0)

    def clear_of(k: int) -> Mask:
        """Blocks where the room's light is bright and that of light k does not reach."""
        sigma = radiance.sigma[k] if radiance.sigma.ndim == 3 else radiance.sigma[k].mean(axis=-1)
        clear = bright & (room > ROOM_SIGMAS * _block_mean(sigma) / BLOCK_PX) & (lamps[k] < dark)
        return clear & (_block_mean(radiance.saturated[k].astype(np.float32)) == 0) if radiance.saturated[k].any() else clear

    found = {}
    for light, lit, clear in zip(radiance.lights, lamps, parallel.run_all(clear_of, range(len(lamps))), strict=True):
        if clear.sum() > FEWEST_BLOCKS:
            change, further = (float(np.quantile(lit[clear] / room[clear], share)) for share in (DARKEST, 2 * DARKEST))
            if further - change < ALIKE * max(change, 1.0):
                found[light] = change, change * float(np.median(room[clear])) / max(float(np.quantile(lit, BRIGHT)), 1e-12)
    return found


def _block_mean(image: Image) -> Array:
    """Means (h, w) of blocks of an image (H, W)."""
    return raster.block_means(image, BLOCK_PX)
