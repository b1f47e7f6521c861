"""What the readers of other systems' lights share: tables of numbers, and directions in other axes.

Axes: many systems write x right, y up, z to the camera; C is x right, y down, z forward, so ``v_C = (x, -y, -z)``.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.text import read_text
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration, Light

C_FROM_UP = np.array([1.0, -1.0, -1.0])


def text_of(path: Path) -> str:
    """A text file's text.

    Raises
    ------
    InputError
        Not there, or not text.
    """
    return read_text(path, "a text file of lights")


def numbers(words: Sequence[str], where: str) -> Array:
    """Words as finite numbers.

    Raises
    ------
    InputError
        One is no finite number.
    """
    try:
        found = np.array([float(word) for word in words])
    except ValueError as error:
        raise InputError(
            f"{' '.join(words)[:60]!r} holds something that is no number", where=where, needed="numbers, decimal point"
        ) from error
    if not np.isfinite(found).all():
        raise InputError("a number that is not finite", where=where, needed="finite numbers")
    return found


def table(path: Path, columns: int | None = None) -> Array:
    """A text of rows of numbers (N, columns), comments (#, //, %) left out; every row alike.

    Raises
    ------
    InputError
        No numbers, rows of unlike lengths, or another count of columns.
    """
    rows: list[Array] = []
    for count, line in enumerate(text_of(path).splitlines(), 1):
        words = line.replace(",", " ").replace(";", " ").split()
        if not words or words[0].startswith(("#", "//", "%")):
            continue
        row = numbers(words, f"{path}:{count}")
        wanted = columns or (len(rows[0]) if rows else len(row))
        if len(row) != wanted:
            raise InputError(f"{len(row)} numbers in a row", where=f"{path}:{count}", needed=f"{wanted}")
        rows.append(row)
    if not rows:
        raise InputError("holds no numbers", where=str(path), needed="rows of numbers")
    return np.stack(rows)


def unit_rows(vectors: Array, where: str) -> Array:
    """Rows (N, 3) at length 1.

    Raises
    ------
    InputError
        One is zero.
    """
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    if np.any(length < 1e-9):
        raise InputError(f"light {int(np.argmin(length))} has no direction: 0 0 0", where=where, needed="a direction")
    return np.asarray(vectors / length)


def distant(name: str, names: Sequence[str], directions_C: Array, intensity: Array | None = None) -> Calibration:
    """A calibration of distant lights without a camera, intensities (N, 1) or (N, 3) scaled to the contract's mean of 1."""
    intensity = np.ones((len(names), 1)) if intensity is None else intensity / intensity.mean()
    return Calibration(name, tuple(Light(one, d, value) for one, d, value in zip(names, directions_C, intensity, strict=True)))


FARTHEST_M = 100.0
"""Metres beyond which no near light is believed."""
SHARPEST = 5000.0
"""The largest exponent of a cosine lobe that is believed: its half angle is one degree."""
KINDS = ("isotropic", "cosine", "table", "leds")


def sane_lights(calibration: Calibration, where: str) -> Calibration:
    """The calibration, whose lights can be lights.

    Raises
    ------
    InputError
        No light; a name twice, or none that a file could bear; a direction, an intensity, a place or a lobe that cannot be.
    """
    if not calibration.lights:
        raise InputError("holds no lights", where=where, needed="lights")
    names = [light.name for light in calibration.lights]
    for light in calibration.lights:
        found = _wrong(light) or ("two lights of one name" if names.count(light.name) > 1 else "")
        if found:
            raise InputError(found, where=f"{where}, light {light.name}", needed="a light as there can be", todo="correct it")
    return calibration


def _wrong(light: Light) -> str:
    """What is wrong with a light, in words; empty where nothing is."""
    if not light.name.strip() or set(light.name) & set("/\\\0") or light.name in {".", ".."}:
        return f"the name {light.name!r}, which no image can have"
    if not np.isfinite(light.direction_C).all() or not np.any(light.direction_C):
        return "a direction that is none"
    if not np.isfinite(light.intensity).all() or np.any(light.intensity < 0) or not np.any(light.intensity > 0):
        return f"an intensity of {', '.join(f'{value:g}' for value in light.intensity)}"
    if light.source_C is not None and not (np.abs(light.source_C) <= FARTHEST_M).all():
        return f"a source at {', '.join(f'{value:g}' for value in light.source_C)} m"
    if light.axis_C is not None and (not np.isfinite(light.axis_C).all() or not np.any(light.axis_C)):
        return "an emission axis that is none"
    lobe = light.lobe
    if lobe.kind not in KINDS or not 0 <= lobe.exponent <= SHARPEST:
        return f"a lobe {lobe.kind!r} of exponent {lobe.exponent:g}"
    if (
        len(lobe.value) != len(lobe.angle_rad)
        or np.any(np.diff(lobe.angle_rad) <= 0)
        or (lobe.kind in {"table", "leds"} and len(lobe.value) < 2)
    ):
        return "a lobe whose angles do not grow, or with unlike numbers of angles and values"
    return ""
