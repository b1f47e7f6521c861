"""Detection of sensor saturation below the stated white level, as a spike at the top of the histogram.

Without clipping, noise and smooth shading leave fewer and fewer pixels towards the largest value. A sensor (or raw converter) that
saturates at a value maps everything brighter to it: a spike at the very top, above values that are all in use.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from lpcal.geometry.arrays import Array, Image

NEAR_TOP = 0.8
"""Share of the largest value above which values are examined; a dozen are in use there in any 8 bit image where clipping matters."""
BELOW = 8
"""Number of occurring values just below the largest with which its count is compared."""
FEWEST_PX = 50
"""Least number of pixels at the largest value, over all images, for a spike: a highlight with noise has a few."""
TIMES = 8.0
"""Least ratio of the count at the largest value to the counts of the values below: without clipping it is about 1 or less."""
WIDEST = 0.15
"""Largest gap, as a share of the largest value, that the compared values below may span: a flat noiseless surface has gaps."""


def clipping_level(images: Image, white_level: float, step: float) -> float | None:
    """The value, a fraction of full scale, at which images (L, H, W[, 3]) are clipped below the white level; None if they are not."""
    top = float(images.max())
    if top <= 0 or top >= white_level - 1.5 * step:
        return None
    values, counts = np.unique(np.concatenate([image[image > NEAR_TOP * top] for image in images]), return_counts=True)
    return clipped_at(values, counts, white_level, step)


def clipped_at(values: Array | Image, counts: npt.NDArray[np.integer], white_level: float, step: float) -> float | None:
    """`clipping_level` from the occurring values in increasing order and their counts."""
    top = float(values[-1]) if len(values) else 0.0
    if top <= 0 or top >= white_level - 1.5 * step:
        return None
    values, counts = values[values > NEAR_TOP * top], counts[values > NEAR_TOP * top]
    if len(values) <= BELOW or counts[-1] < max(FEWEST_PX, TIMES * counts[-1 - BELOW : -1].max()):
        return None
    return top if values[-1 - BELOW] > (1 - WIDEST) * top else None


def clipping_words(level: float) -> str:
    """The warning about it."""
    percent = f"{100 * level:.1f} %"
    return f"the brightest numbers pile up at {percent} of full scale: taken as saturated there; state white_level: {percent}"
