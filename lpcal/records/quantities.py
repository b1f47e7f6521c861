"""Quantities as people write them: a number and its unit (``25 mm``, ``30 deg``, ``12.5 ms``, ``0.8 %``), kept in SI.

A bare number for a length, an angle or a time is an error: it could mean 25 mm or 25 m.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from typing import Annotated, Literal

from pydantic import BeforeValidator

UNITS = {
    "length": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "in": 0.0254},
    "angle": {"rad": 1.0, "deg": math.pi / 180, "°": math.pi / 180},
    "time": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6},
    "share": {"%": 1e-2},
    "pixels": {"px": 1.0},
}
ARTICLE = {"length": "a length", "angle": "an angle", "time": "a time", "share": "a percentage", "pixels": "a number of pixels"}
EXAMPLE = {"length": "25 mm", "angle": "30 deg", "time": "20 ms", "share": "0.8 %", "pixels": "310 px"}
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
QUANTITY = re.compile(rf"\s*({NUMBER})\s*([^\W\d_]+|%|°)\s*")
BARE = re.compile(rf"\s*({NUMBER})\s*")
MICRO = str.maketrans({"\N{GREEK SMALL LETTER MU}": "\N{MICRO SIGN}"})


def parse(text: object, kind: str) -> float:
    """The value in metres, radians, seconds, pixels, or as a fraction of 1, of a quantity such as ``25 mm``.

    Raises
    ------
    ValueError
        A bare number, an unknown unit, or no quantity at all; the message says what was found; what was needed.
    """
    written = str(text).translate(MICRO)
    if BARE.fullmatch(written):
        msg = f"a bare number, {text}; {ARTICLE[kind]} with its unit, such as {EXAMPLE[kind]}"
        raise ValueError(msg)
    match = QUANTITY.fullmatch(written)
    if not match:
        msg = f"{text!r} is not {ARTICLE[kind]}; a number (with a decimal point) and its unit, such as {EXAMPLE[kind]}"
        raise ValueError(msg)
    number, unit = match.groups()
    if unit not in UNITS[kind]:
        msg = f"unknown unit {unit!r} of {ARTICLE[kind]}; one of: {', '.join(UNITS[kind])}"
        raise ValueError(msg)
    if not math.isfinite(float(number)):
        msg = f"{text} is beyond all bounds; {ARTICLE[kind]}, such as {EXAMPLE[kind]}"
        raise ValueError(msg)
    return float(Decimal(number) * Decimal(repr(UNITS[kind][unit])))  # decimal, so that 18 mm is 0.018 to the last digit


def _written(kind: str, *, positive: bool = False, least: float = -math.inf, most: float = math.inf) -> BeforeValidator:
    def read(text: object) -> float:
        value = parse(text, kind)
        if positive and value <= 0:
            msg = f"{text} is not more than 0; {ARTICLE[kind]}, such as {EXAMPLE[kind]}"
            raise ValueError(msg)
        if not least <= value <= most:
            msg = f"{text} is out of range; {100 * least:g} % to {100 * most:g} %"
            raise ValueError(msg)
        return value

    return BeforeValidator(read)


LEAST_GAMMA, MOST_GAMMA = 0.1, 10.0
"""Exponents between which a tone curve can be meant."""


def parse_gamma(text: object) -> float | Literal["srgb"]:
    """A tone curve: an exponent such as 2.2, or the word srgb.

    Raises
    ------
    ValueError
        It is neither; the message says what was found; what was needed.
    """
    written = str(text).strip()
    if written.lower().replace("-", "") == "srgb":
        return "srgb"
    needed = f"a number between {LEAST_GAMMA:g} and {MOST_GAMMA:g}, or srgb"
    if not re.fullmatch(NUMBER, written) or not LEAST_GAMMA < float(written) < MOST_GAMMA:
        msg = f"{written}; {needed}"
        raise ValueError(msg)
    return float(written)


type Curve = Annotated[float | Literal["srgb"], BeforeValidator(parse_gamma)]
type Length = Annotated[float, _written("length")]
type Size = Annotated[float, _written("length", positive=True)]
type Angle = Annotated[float, _written("angle")]
type Turn = Annotated[float, _written("angle", positive=True)]
type Duration = Annotated[float, _written("time", positive=True)]
type Share = Annotated[float, _written("share", least=0.0, most=1.0)]
type Pixels = Annotated[float, _written("pixels")]
