"""Quantities as people write them: a number and its unit (``25 mm``, ``30 deg``, ``12.5 ms``, ``0.8 %``), kept in SI.

A bare number for a length, an angle or a time is an error: nobody can tell 25 mm from 25 m.
"""

from __future__ import annotations

import math
import re
from typing import Annotated

from pydantic import BeforeValidator

UNITS = {
    "length": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 0.0254},
    "angle": {"rad": 1.0, "deg": math.pi / 180},
    "time": {"s": 1.0, "ms": 1e-3, "us": 1e-6},
    "share": {"%": 1e-2},
    "pixels": {"px": 1.0},
}
EXAMPLE = {"length": "25 mm", "angle": "30 deg", "time": "20 ms", "share": "0.8 %", "pixels": "310 px"}
QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([A-Za-z%]+)\s*")


def parse(text: object, kind: str) -> float:
    """The value in metres, radians, seconds, pixels, or as a fraction of 1, of a quantity such as ``25 mm``.

    Raises
    ------
    ValueError
        A bare number, an unknown unit, or no quantity at all; the message says which and gives an example.
    """
    if isinstance(text, (int, float)) and not isinstance(text, bool):
        msg = f"a bare number, {text!r}; a {kind} needs its unit, for example {EXAMPLE[kind]}"
        raise ValueError(msg)
    match = QUANTITY.fullmatch(str(text))
    if not match:
        msg = f"{text!r} is not a {kind}; write a number and its unit, for example {EXAMPLE[kind]}"
        raise ValueError(msg)
    number, unit = match.groups()
    if unit not in UNITS[kind]:
        msg = f"unknown unit {unit!r} of a {kind}; known are {', '.join(UNITS[kind])}"
        raise ValueError(msg)
    return float(number) * UNITS[kind][unit]


def _written(kind: str) -> BeforeValidator:
    return BeforeValidator(lambda text: parse(text, kind))


type Length = Annotated[float, _written("length")]
type Angle = Annotated[float, _written("angle")]
type Time = Annotated[float, _written("time")]
type Share = Annotated[float, _written("share")]
type Pixels = Annotated[float, _written("pixels")]
