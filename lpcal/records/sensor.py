"""What a sensor does to light, as people, files and calibrations say it. Levels are fractions of full scale."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.geometry.tone_curve import Gamma


@dataclass(frozen=True)
class FlatField:
    """How lens and sensor weaken light over the image: exp of a polynomial of Chebyshev terms, 1 at the brightest place.

    ``coefficients`` (n, n), row i the power along rows; both axes run from -1 to 1 over the image.
    """

    coefficients: Array

    @staticmethod
    def terms(rows: Array, columns: Array, shape: tuple[int, ...], degree: int) -> Array:
        """Products of Chebyshev polynomials (R, C, n, n) at rows (R,) and columns (C,)."""
        y = np.polynomial.chebyshev.chebvander(2 * np.asarray(rows) / max(shape[0] - 1, 1) - 1, degree)
        x = np.polynomial.chebyshev.chebvander(2 * np.asarray(columns) / max(shape[1] - 1, 1) - 1, degree)
        return np.asarray(y[:, None, :, None] * x[None, :, None, :])

    @staticmethod
    def kept(degree: int) -> Mask:
        """Terms (n*n,) whose degrees add up to at most `degree`."""
        i, j = np.indices((degree + 1, degree + 1))
        return np.asarray((i + j <= degree).ravel())

    def response(self, shape: tuple[int, ...]) -> Image:
        """Response (H, W) of an image of shape (H, W)."""
        y, x = np.linspace(-1, 1, shape[0]), np.linspace(-1, 1, shape[1])
        return np.exp(np.polynomial.chebyshev.chebgrid2d(y, x, self.coefficients)).astype(np.float32)


@dataclass(frozen=True)
class StatedSensor:
    """What is said of a sensor in one place; None where nothing is."""

    gamma: Gamma | None = None
    black_level: float | None = None
    white_level: float | None = None
    flat_field: FlatField | None = None

    def over(self, other: StatedSensor) -> StatedSensor:
        """What is said here, and what the other says where nothing is."""
        return replace(other, **self.said)

    @property
    def said(self) -> dict[str, Any]:
        """What is said, by its key."""
        found = {each.name: getattr(self, each.name) for each in fields(self)}
        return {key: value for key, value in found.items() if value is not None}


@dataclass(frozen=True)
class ToneClaim:
    """A tone curve as image files claim it."""

    said: str
    """What images do, in words: ``carry an ICC profile of gamma 2.2``."""
    gamma: Gamma | None
    """None: a photograph of a curve that the files do not say."""
    photograph: bool = False
    """Whether a camera wrote the files as photographs, which are curved; programs write tags to linear numbers too."""
