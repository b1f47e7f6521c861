"""Stored numbers that cannot be what they are taken for: one image under two names, numbers over the white level, a raw mosaic as grey.

A sensor's noise never comes twice: two images whose numbers are all equal are one image. Symbols: the noise's variance is a + c * (its
mean) of linear numbers (see detect.radiometry); where it is no more than rounding to whole numbers makes, the images may be computed ones.

A mosaic of colour filters lets each pixel of a square of 2x2 see another colour, so that their means over the image differ.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from lpcal.errors import DisagreementError
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.observations import RawCapture
from lpcal.records.sensor import Sensor

SAMPLED = (5, 7)
"""Every so many rows and columns are compared first; those that agree are compared whole."""
OVER_ROUNDING = 3.0
"""Variance of the noise, in those of rounding, from which images are a sensor's and no two can be equal."""
OVER_WHITE, OVER_SHARE = 1.05, 0.01
"""Numbers of more than this share of the white level, in more than this share of all pixels, are over it by more than a sensor's spread."""
MOSAIC, MOSAIC_IMAGES = 0.05, 8
"""Relative difference of the means of a mosaic's pixels from which images are one, and how many images must show it alike."""


def refuse_over_white(raw: RawCapture, sensor: Sensor, saturated: Mask) -> None:
    """Stop where many numbers lie far over the level at which the sensor is said to saturate; `saturated` (L, H, W) are all at or over it.

    Raises
    ------
    DisagreementError
        They do.
    """
    if sensor.white_level >= 1 / OVER_WHITE or saturated.mean() < OVER_SHARE:
        return
    over = float(np.mean(raw.images > OVER_WHITE * sensor.white_level))
    if over > OVER_SHARE:
        raise DisagreementError(
            f"{100 * over:.0f} % of the numbers are over the white level, stated as {100 * sensor.white_level:.3g} % of full scale: they "
            f"go up to {100 * float(raw.images.max()):.3g} %",
            where=raw.name,
            needed="the level at which these images saturate",
            todo="correct white_level (capture.yaml, --white-level, or camera: in panel.yaml), or leave it out",
        )


def refuse_mosaic(raw: RawCapture) -> None:
    """Stop where grey images are a mosaic of colours, as a camera's raw frames are.

    Raises
    ------
    DisagreementError
        They are.
    """
    if raw.images.ndim != 3 or min(raw.images.shape[1:]) < 4:
        return
    means = np.array([_of_the_four(image) for image in raw.images[:MOSAIC_IMAGES]])
    level = means.mean(axis=1, keepdims=True)
    if not np.all(level > 0):
        return
    apart = means / level - 1
    usual = np.median(apart, axis=0)
    if np.ptp(usual) > MOSAIC and np.all(np.abs(apart - usual) < 0.5 * np.ptp(usual)):
        raise DisagreementError(
            f"the grey images are a mosaic of colours: of each 2x2 pixels one is {100 * np.ptp(usual):.0f} % brighter than another",
            where=raw.name,
            needed="grey or RGB images",
            todo="make them colour images (OpenCV: cvtColor with COLOR_BayerRG2BGR, or the camera's own order)",
        )


def _of_the_four(image: Image) -> Array:
    """Means (4,) of the pixels in each place of a square of 2x2."""
    rows, columns = (side // 2 * 2 for side in image.shape)
    return np.array([image[i:rows:2, j:columns:2].mean(dtype=np.float64) for i in (0, 1) for j in (0, 1)])


def twins(raw: RawCapture, noise: tuple[float, float], linear: Image) -> tuple[str, ...]:
    """In words, two images that are one; `noise` (a, c) is that of the linear numbers.

    Raises
    ------
    DisagreementError
        There are two, and they are noisy as a sensor's.
    """
    names = [
        *raw.lights,
        *(f"ambient image {k}" if k else "the ambient image" for k in range(0 if raw.ambient is None else len(raw.ambient))),
    ]
    pairs = _equal([*raw.images, *([] if raw.ambient is None else raw.ambient)])
    found = [(one, other) for one, other in pairs if one < len(raw.lights)]  # the same ambient image twice does no harm
    if not found:
        return ()
    words = "; ".join(f"{names[one]} and {names[other]}" for one, other in found[:3]) + ("; ..." if len(found) > 3 else "")
    rounding = raw.step**2 / 12
    if noise[0] + noise[1] * float(linear.mean()) < OVER_ROUNDING * rounding:
        return (f"the same image twice, to the last digit: {words}",)
    raise DisagreementError(
        f"the same image twice, to the last digit: {words}",
        where=raw.name,
        needed="an image of each light, taken under it",
        todo="copy the right image, take it again, or leave that light out (--use, or lights: in capture.yaml)",
    )


def _equal(images: Sequence[Image]) -> Iterator[tuple[int, int]]:
    """Pairs of images whose numbers are all equal, each later one with the first of its kind; images of one number are none."""
    first: dict[bytes, list[int]] = {}
    for k, image in enumerate(images):
        some = np.ascontiguousarray(image[:: SAMPLED[0], :: SAMPLED[1]])
        alike = first.setdefault(some.tobytes(), [])
        twin = next((j for j in alike if np.array_equal(images[j], image)), None)
        if twin is None:
            alike.append(k)
        elif np.ptp(some) > 0:
            yield twin, k
