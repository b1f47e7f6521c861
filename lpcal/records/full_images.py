"""Images that are too many or too large to be held: they lie elsewhere, and a part is read at a time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from lpcal.geometry.arrays import Image, Mask

PART = 128
"""Pixels along the side of a part: of 48 images of 16 bit it holds 1.5 MB, which a disk reads in one go."""


class Store(Protocol):
    """Where images (N, H, W[, 3]) lie, of which parts are read."""

    shape: tuple[int, ...]

    def read(self, images: slice, rows: slice, columns: slice) -> npt.NDArray[Any]:
        """Part (N, h, w[, 3]) of some of the images, as stored."""
        ...


@dataclass(frozen=True)
class FullImages:
    """The images of a capture in full size, beside the coarse ones that stand for them in memory: L of lights, K ambient, S short ones."""

    store: Store
    counts: tuple[int, int, int]
    """L, K, S."""
    short: tuple[str, ...]
    """The lights of the short exposures, in their order."""
    full_scale: float
    """What the stored numbers are divided by."""
    factor: int
    """Pixels a coarse pixel, along a side."""
    mask: Mask | None = None
    """(H, W), as given by the user."""
    saturated_from: float = 1.0
    """Fraction of full scale at which the numbers end."""

    @property
    def size(self) -> tuple[int, int]:
        """Height, width."""
        return self.store.shape[1], self.store.shape[2]

    def read(self, rows: slice, columns: slice) -> tuple[Image, Image, dict[str, Image]]:
        """Images of the lights (L, h, w[, 3]), ambient ones (K, h, w[, 3]) and short ones by light, as fractions of full scale."""
        L, K, _ = self.counts
        stored = self.store.read(slice(None), rows, columns)
        shares = (stored / np.float32(self.full_scale)).astype(np.float32)
        return shares[:L], shares[L : L + K], dict(zip(self.short, shares[L + K :], strict=True))

    def sampled(self, parts: int) -> Image:
        """Parts of the lights' images from all over, one beside the other (L, parts PART, parts PART[, 3])."""
        rows, columns = (
            [slice(low, low + min(PART, side)) for low in np.unique(np.linspace(0, max(side - PART, 0), parts).astype(int)).tolist()]
            for side in self.size
        )
        lights = slice(0, self.counts[0])
        stored = np.concatenate(
            [np.concatenate([self.store.read(lights, row, column) for column in columns], axis=2) for row in rows], axis=1
        )
        return (stored / np.float32(self.full_scale)).astype(np.float32)
