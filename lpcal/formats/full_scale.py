"""What an image's stored numbers are fractions of: floats not scaled to 1, and cameras' 10 to 14 bit stored in 16."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.errors import InputError
from lpcal.geometry.arrays import Image

OVER_ONE = 1.25
"""Largest number of a float image whose full scale is 1: averaging and flat-fielding lift some pixels over it."""
FULL_SCALES = (255.0, 1023.0, 4095.0, 16383.0, 65535.0)
"""Full scales of cameras' counts of 8 to 16 bit."""
NEGATIVE = 0.05
"""Share of full scale by which floats may lie under 0: the noise of a dark frame that was taken away, not a number that means something."""
IN_SIXTEEN = 65535
BITS = (10, 12, 14)
"""Depths of cameras' numbers that are stored in 16 bit, low or high."""


@dataclass(frozen=True)
class FullScale:
    """What numbers are divided by, and what they show of the sensor."""

    divisor: float = 1.0
    step: float | None = None
    """One step of the numbers as a fraction of full scale, where it is not that of the file's own bits."""
    white_level: float | None = None
    """Where the sensor saturates, as a fraction of full scale, where the numbers show it."""
    notes: tuple[str, ...] = ()


def full_scale(images: Image, step: float) -> FullScale:
    """The full scale of the images (L, H, W[, 3]) of lights, as they were read in steps of `step`."""
    if abs(step * IN_SIXTEEN - 1) < 1e-6:
        return _in_sixteen_bits(images)
    return _of_floats(float(images.max())) if step < 1 / IN_SIXTEEN else FullScale()


def refuse_odd_floats(pixels: npt.NDArray[Any], path: Path) -> None:
    """Refuse pixels that are no finite numbers.

    Raises
    ------
    InputError
        There are some; their count is said.
    """
    odd = pixels.size - int(np.isfinite(pixels).sum()) if pixels.dtype.kind == "f" else 0
    if odd:
        raise InputError(f"{odd} pixels that are no finite numbers", where=str(path), needed="finite numbers", todo="write them again")


def negatives(least: dict[Path, float], divisor: float) -> tuple[str, ...]:
    """Notes on the images' least numbers, by path.

    Raises
    ------
    InputError
        Some are far under 0.
    """
    path, value = min(least.items(), key=lambda pair: pair[1])
    share = value / divisor
    if share < -NEGATIVE:
        raise InputError(
            f"numbers down to {value:g}, {-100 * share:.0f} % of full scale under 0",
            where=str(path),
            needed="light, which is never negative",
            todo="was an ambient image taken away already, or an offset? store the images as they were taken",
        )
    if share >= 0:
        return ()
    return (f"float images down to {value:g} ({path.name}): a dark frame taken away? the negative numbers are kept",)


def _of_floats(most: float) -> FullScale:
    if most <= OVER_ONE:
        return FullScale()
    full = next((full for full in FULL_SCALES if full >= most), most)
    note = f"float images up to {most:g}: {full:g} is taken as full scale; divide them by it, or store 16 bit"
    return FullScale(full, notes=(note,))


def _in_sixteen_bits(images: Image) -> FullScale:
    """The white level of images whose largest number is just the largest of 10, 12 or 14 bit, low in 16 or shifted to the top."""
    most = round(IN_SIXTEEN * float(images.max()))
    for bits in BITS:
        count, shift = 2**bits - 1, 2 ** (16 - bits)
        if most == count:
            return FullScale(white_level=count / IN_SIXTEEN)
        if most == count * shift and not np.any(np.rint(IN_SIXTEEN * images).astype(np.uint16) % shift):
            return FullScale(step=shift / IN_SIXTEEN, white_level=most / IN_SIXTEEN)
    return FullScale()
