"""What a sensor does to light, as people, files and calibrations say it. Levels are fractions of full scale."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any, TypedDict

import numpy as np

from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.geometry.tone_curve import Gamma, decode, worded


@dataclass(frozen=True)
class FlatField:
    """How lens and sensor weaken light over the image: exp of a polynomial of Chebyshev terms, 1 at the brightest place.

    ``coefficients`` (n, n), row i the power along rows; both axes run from -1 to 1 over the image.
    """

    coefficients: Array
    """(n, n) of the Chebyshev terms, row i the power along rows."""

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
        return self.part(shape, slice(None), slice(None))

    def part(self, shape: tuple[int, ...], rows: slice, columns: slice) -> Image:
        """Response (h, w) of a part of such an image."""
        axes = (np.linspace(-1, 1, side)[some] for side, some in zip(shape, (rows, columns), strict=True))
        down, across = (np.polynomial.chebyshev.chebvander(at, len(self.coefficients) - 1) for at in axes)
        return np.exp(down @ self.coefficients @ across.T).astype(np.float32)


@dataclass(frozen=True)
class StatedSensor:
    """What is said of a sensor in one place; None where nothing is.

    Parameters
    ----------
    gamma : float or "srgb", optional
        ``stored = linear^(1/gamma)``, or sRGB's curve.
    black_level, white_level : float, optional
        Stored numbers of no light and of saturation, as fractions of full scale.
    flat_field : FlatField, optional
        How lens and sensor weaken light over the image.

    Examples
    --------
    >>> import lpcal
    >>> lpcal.StatedSensor(gamma="srgb", black_level=0.01).said
    {'gamma': 'srgb', 'black_level': 0.01}
    """

    gamma: Gamma | None = None
    black_level: float | None = None
    """The stored number of no light, as a fraction of full scale."""
    white_level: float | None = None
    """The stored number of saturation, as a fraction of full scale."""
    flat_field: FlatField | None = None

    def over(self, other: StatedSensor) -> StatedSensor:
        """What is said here, and what the other says where nothing is."""
        return StatedSensor(
            gamma=other.gamma if self.gamma is None else self.gamma,
            black_level=other.black_level if self.black_level is None else self.black_level,
            white_level=other.white_level if self.white_level is None else self.white_level,
            flat_field=other.flat_field if self.flat_field is None else self.flat_field,
        )

    def onto(self, sensor: Sensor) -> Sensor:
        """The sensor with what is stated here in its place."""
        return Sensor(
            gamma=sensor.gamma if self.gamma is None else self.gamma,
            black_level=sensor.black_level if self.black_level is None else self.black_level,
            white_level=sensor.white_level if self.white_level is None else self.white_level,
            flat_field=sensor.flat_field if self.flat_field is None else self.flat_field,
        )

    @property
    def said(self) -> dict[str, Gamma | FlatField]:
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


@dataclass(frozen=True)
class Sensor:
    """What the sensor does to light: levels as fractions of full scale."""

    black_level: float = 0.0
    """The stored number of no light, as a fraction of full scale."""
    white_level: float = 1.0
    """The stored number of saturation, as a fraction of full scale."""
    gamma: Gamma = 1.0
    """``stored = linear^(1/gamma)``."""
    flat_field: FlatField | None = None
    """How lens and sensor weaken light over the image."""

    def linear(self, stored: Image) -> Image:
        """Linear numbers, 0 at black and 1 at white, the flat field not yet divided out."""
        low, high = decode(np.array([self.black_level, self.white_level]), self.gamma)
        return np.asarray((decode(stored, self.gamma) - np.float32(low)) / np.float32(high - low), dtype=np.float32)

    def response(self, shape: tuple[int, ...]) -> Image:
        """What lens and sensor make of even light, (H, W) or (H, W, 1), for images of a shape (L, H, W) or (L, H, W, 3)."""
        response = np.ones(shape[1:3], np.float32) if self.flat_field is None else self.flat_field.response(shape[1:3])
        return response[..., None] if len(shape) == 4 else response


PLAIN = Sensor()
"""A linear sensor that is black at 0 and white at full scale."""


class SensorDocument(TypedDict):
    """The sensor as summary.json states it; `in_words` names what is not plain."""

    gamma: Gamma
    black_level: float
    white_level: float
    flat_field: bool
    said_by: dict[str, str]
    in_words: str


@dataclass(frozen=True)
class SensorInUse:
    """A sensor and where each thing that is not plain comes from."""

    sensor: Sensor
    """Gamma, levels and flat field."""
    said_by: dict[str, str] = field(default_factory=dict)
    """Who says it, by what is said: gamma, black_level, white_level, flat_field."""

    def document(self) -> SensorDocument:
        """What summary.json says, and in words what is not plain."""
        found = [f"{text} ({who})" for key, who in self.said_by.items() if (text := self._worded(key))]
        return {
            "gamma": self.sensor.gamma,
            "black_level": self.sensor.black_level,
            "white_level": self.sensor.white_level,
            "flat_field": self.sensor.flat_field is not None,
            "said_by": self.said_by,
            "in_words": ", ".join(found),
        }

    def _worded(self, key: str) -> str:
        if key == "flat_field":
            return "flat field divided out"
        value = getattr(self.sensor, key)
        return "" if value == getattr(PLAIN, key) else worded_value(key, value)


def worded_value(key: str, value: Any) -> str:
    """A gamma or a level in words."""
    return f"gamma {worded(value)}" if key == "gamma" else f"{key.replace('_', ' ')} {100 * value:.4g} %"
