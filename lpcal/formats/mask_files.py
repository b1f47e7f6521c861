"""Masks as images: what is not zero; of an image that is not opaque everywhere, what is not transparent."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lpcal.errors import DisagreementError
from lpcal.formats.images import read_numbers
from lpcal.geometry.arrays import Mask

LOSSY, LOSSY_MASK = (".jpg", ".jpeg", ".jpe", ".webp"), 0.5
"""Endings of images that do not keep numbers, and the share of its brightest pixel from which such a mask counts: zero comes back as 3."""


def read_mask(path: Path, shape: tuple[int, ...]) -> Mask:
    """A mask (H, W) of images of a shape (H, W[, 3]).

    Raises
    ------
    InputError
        It is not there, or no image that can be read.
    DisagreementError
        It has another size.
    """
    found = read_numbers(path)
    pixels, alpha = found.image.pixels, found.alpha
    if pixels.shape[:2] != tuple(shape[:2]):
        raise DisagreementError(
            f"the mask is {pixels.shape[1]}x{pixels.shape[0]}, the images {shape[1]}x{shape[0]}",
            where=str(path),
            needed="a mask of the images' size",
        )
    if alpha is not None and alpha.min() != alpha.max():
        return np.asarray(alpha > 0)
    value = pixels.reshape(*pixels.shape[:2], -1).max(axis=2)
    return np.asarray(value > (LOSSY_MASK * value.max() if path.suffix.lower() in LOSSY else 0))
