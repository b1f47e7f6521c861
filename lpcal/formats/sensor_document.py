"""What lpcal's own files say of a sensor.

Keys: ``black_level``, ``white_level`` (fractions of full scale), ``gamma`` (an exponent, or srgb) and
``flat_field`` (Chebyshev coefficients of the logarithm of the response). They stand under ``camera:``, with or without a lens beside them.
"""

from __future__ import annotations

from typing import Any

from lpcal.formats.document_numbers import number, numbers
from lpcal.records.quantities import LEAST_GAMMA, MOST_GAMMA
from lpcal.records.sensor import FlatField, StatedSensor

KEYS = ("black_level", "white_level", "gamma", "flat_field")


def sensor_document(stated: StatedSensor) -> dict[str, Any]:
    """What is said of a sensor, as it is written."""
    found: dict[str, Any] = {**stated.said}
    if stated.flat_field is not None:
        found["flat_field"] = stated.flat_field.coefficients
    return found


def sensor_from_document(document: dict[str, Any]) -> StatedSensor:
    """What is said of a sensor, as it was written.

    Raises
    ------
    ValueError
        A level or a gamma that cannot be, or no number; the message is the key's name.
    """
    black, white = number(document, "black_level"), number(document, "white_level")
    gamma: Any = document.get("gamma")
    if gamma != "srgb":
        gamma = number(document, "gamma")
    if not 0 <= (black or 0.0) < (1.0 if white is None else white) <= 1:
        raise ValueError("black_level or white_level")
    if not (gamma is None or gamma == "srgb" or LEAST_GAMMA < gamma < MOST_GAMMA):
        raise ValueError("gamma")
    flat = None if document.get("flat_field") is None else FlatField(numbers(document, "flat_field", -1, -1))
    return StatedSensor(gamma, black, white, flat)
