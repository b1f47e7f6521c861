"""Where a sensor saturates below the stated white level: the brightest numbers pile up on one.

Light that falls off smoothly, with noise on it, leaves fewer pixels the brighter the number, and a single one or a few at the top. A sensor
(or a raw converter) that saturates at a number puts all that is brighter there: a spike at the very top, above numbers that are all in use.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from lpcal.geometry.arrays import Array, Image

NEAR_TOP = 0.8
"""Numbers above this share of the largest are looked at; a dozen are in use there in any 8 bit image that is worth clipping."""
BELOW = 8
"""How many of the numbers in use just below the largest it is held against."""
FEWEST_PX = 50
"""Pixels at the largest number, of all images together, from which they can be a pile: a highlight of noise has a few."""
TIMES = 8.0
"""Times as many pixels as at any of the numbers below: an image that is not clipped has about as many, or fewer."""
WIDEST = 0.15
"""Share of the largest number over which the numbers below may lie: on a flat surface without noise there is none for long."""


def clipping_level(images: Image, white_level: float, step: float) -> float | None:
    """The number, a fraction of full scale, at which images (L, H, W[, 3]) are clipped below the white level; None where they are not."""
    top = float(images.max())
    if top <= 0 or top >= white_level - 1.5 * step:
        return None
    values, counts = np.unique(np.concatenate([image[image > NEAR_TOP * top] for image in images]), return_counts=True)
    return clipped_at(values, counts, white_level, step)


def clipped_at(values: Array | Image, counts: npt.NDArray[np.integer], white_level: float, step: float) -> float | None:
    """The same by the numbers that occur, from the least, and how often each does."""
    top = float(values[-1]) if len(values) else 0.0
    if top <= 0 or top >= white_level - 1.5 * step:
        return None
    values, counts = values[values > NEAR_TOP * top], counts[values > NEAR_TOP * top]
    if len(values) <= BELOW or counts[-1] < max(FEWEST_PX, TIMES * counts[-1 - BELOW : -1].max()):
        return None
    return top if values[-1 - BELOW] > (1 - WIDEST) * top else None


def clipping_words(level: float) -> str:
    """What is said of it."""
    percent = f"{100 * level:.1f} %"
    return f"the brightest numbers pile up at {percent} of full scale: taken as saturated there; state white_level: {percent}"
