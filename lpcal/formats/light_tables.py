"""What the readers of other systems' lights share: text and tables of numbers, checks of lights, and directions in other axes.

Axes: many systems write x right, y up, z to the camera; C is x right, y down, z forward, so ``v_C = (x, -y, -z)``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.text import read_text
from lpcal.geometry.arrays import Array
from lpcal.geometry.light_field import FORMULAS, TABLED
from lpcal.records import lobes
from lpcal.records.calibration import Calibration, Light, Lobe
from lpcal.records.names import reserved

C_FROM_UP = np.array([1.0, -1.0, -1.0])
MOST_BYTES = 32_000_000
"""Bytes of a text of lights beyond which it is refused: ten thousand lights need a thirtieth of it."""
LARGEST = 1e12
"""Numbers beyond this, in any unit, are damage: no light stands or shines so, and their squares would overflow."""
DECIMAL_COMMA = re.compile(r"[-+]?\d+,\d+(?:[eE][-+]?\d+)?")
"""A number with a comma for its point."""
FARTHEST_M = 100.0
"""Metres beyond which no near light is believed."""
SHARPEST = 5000.0
"""The largest exponent of a cosine lobe that is believed: its half angle is one degree."""
ON_AXIS = 0.02
"""Difference from 1 that a lobe's table may have on the axis: more than rounding and smoothing leave."""


def text_of(path: Path) -> str:
    """A text file's text, in any encoding, NFC.

    Raises
    ------
    InputError
        Not there, too large, or not text.
    """
    if path.is_file() and path.stat().st_size > MOST_BYTES:
        megabytes = path.stat().st_size / 1e6
        raise InputError(f"holds {megabytes:.0f} MB", where=str(path), needed="a text file of lights", todo="is it the right file?")
    return read_text(path, "a text file of lights")


def lines_of(path: Path) -> list[tuple[int, str]]:
    """The lines of a text with their numbers from 1, without empty ones and comments (#, //, %)."""
    lines = ((count, line.strip()) for count, line in enumerate(text_of(path).splitlines(), 1))
    return [(count, line) for count, line in lines if line and not line.startswith(("#", "//", "%"))]


def words_of(line: str) -> list[str]:
    """The words of a line: apart by semicolons, tabs or blanks, commas too where they are not a decimal's."""
    words = [word for word in re.split(r"[;\s]+", line.strip()) if word]
    if any("," in word and not DECIMAL_COMMA.fullmatch(word) for word in words) or (len(words) == 1 and "," in line):
        words = [word for word in re.split(r"[,;\s]+", line.strip()) if word]
    return words


def numbers(words: Sequence[str], where: str) -> Array:
    """Words as finite numbers, with decimal point or comma.

    Raises
    ------
    InputError
        One is no finite number, or too large to be one of a light.
    """
    try:
        found = np.array([float(word.replace(",", ".", 1) if DECIMAL_COMMA.fullmatch(word) else word) for word in words])
    except ValueError as error:
        raise InputError(f"{' '.join(words)[:60]!r} holds something that is no number", where=where, needed="numbers") from error
    if not np.isfinite(found).all():
        raise InputError("a number that is not finite", where=where, needed="finite numbers")
    if found.size and np.abs(found).max() > LARGEST:
        raise InputError(f"a number of {np.abs(found).max():.3g}", where=where, needed="numbers of lights", todo="is the file damaged?")
    return found


def whole_number(value: float, where: str, what: str) -> int:
    """A count as a whole number of 1 or more.

    Raises
    ------
    InputError
        It is none.
    """
    if not (1 <= value <= LARGEST and value == int(value)):
        raise InputError(f"{what} is {value:g}", where=where, needed="a whole number of 1 or more")
    return int(value)


def table(path: Path, columns: int | None = None) -> Array:
    """A text of rows of numbers (N, columns), comments (#, //, %) left out; every row alike.

    Raises
    ------
    InputError
        No numbers, rows of unlike lengths, or another count of columns.
    """
    rows: list[Array] = []
    for count, line in lines_of(path):
        row = numbers(words_of(line), f"{path}:{count}")
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
    return np.stack([of_light(row, f"{where}, light {k + 1}") for k, row in enumerate(vectors)]) if len(vectors) else vectors


def of_light(vector: Array, where: str) -> Array:
    """A light's direction (3,) at length 1.

    Raises
    ------
    InputError
        It is zero.
    """
    length = float(np.linalg.norm(vector))
    if not length > 1e-9:
        raise InputError("no direction: 0 0 0", where=where, needed="a direction from the object to the light")
    return np.asarray(vector / length)


def positive(powers: Array, where: str) -> Array:
    """Powers (N, 1) or (N, 3) as they are.

    Raises
    ------
    InputError
        One is negative, or all of a light are zero.
    """
    bad = np.any(powers < 0, axis=1) | ~np.any(powers > 0, axis=1) | ~np.isfinite(powers).all(axis=1)
    if bad.any():
        k = int(np.argmax(bad))
        stated = " ".join(f"{value:g}" for value in powers[k])
        raise InputError(
            f"light {k + 1} has the intensity {stated}", where=where, needed="intensities above 0", todo="leave that light out"
        )
    return powers


def scaled(powers: Array) -> Array:
    """Powers scaled to a mean of 1."""
    return np.asarray(powers / powers.mean())


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
        found, needed = _wrong(light)
        if not found and names.count(light.name) > 1:
            found, needed = "two lights of one name", "a name of its own for each light"
        if found:
            raise InputError(found, where=f"{where}, light {light.name}", needed=needed, todo="correct it")
    return calibration


def _wrong(light: Light) -> tuple[str, str]:
    """What is wrong with a light, and what it should be, in words; empty where nothing is."""
    if not light.name.strip() or set(light.name) & set("/\\\0") or light.name in {".", ".."}:
        return f"the name {light.name!r}, which no image can have", "a name that a file can have"
    if reserved(light.name):
        return f"the name {light.name!r}: an image of that name is no light's", "another name"
    if not np.isfinite(light.direction_C).all() or not np.any(light.direction_C):
        return "a direction that is none", "three numbers, not all zero"
    if not np.isfinite(light.intensity).all() or np.any(light.intensity < 0) or not np.any(light.intensity > 0):
        return f"an intensity of {', '.join(f'{value:g}' for value in light.intensity)}", "a number above 0, or three"
    if light.source_C is not None and not (np.abs(light.source_C) <= FARTHEST_M).all():
        return f"a source at {', '.join(f'{value:g}' for value in light.source_C)} m", f"a place within {FARTHEST_M:g} m"
    if light.axis_C is not None and (not np.isfinite(light.axis_C).all() or not np.any(light.axis_C)):
        return "an emission axis that is none", "three numbers, not all zero"
    return _wrong_lobe(light.lobe)


def _wrong_lobe(lobe: Lobe) -> tuple[str, str]:
    """What is wrong with a lobe, and what it should be, in words; empty where nothing is."""
    if lobe.kind not in FORMULAS and lobe.kind not in (known := lobes.known()):
        return f"a lobe of kind {lobe.kind!r}", f"one of {', '.join(known)}, or a kind that is registered or installed"
    if not 0 <= lobe.exponent <= SHARPEST:
        return f"a lobe {lobe.kind!r} of exponent {lobe.exponent:g}", f"an exponent of 0 to {SHARPEST:g}"
    if len(lobe.value) != len(lobe.angle_rad) or np.any(np.diff(lobe.angle_rad) <= 0) or (lobe.kind in TABLED and len(lobe.value) < 2):
        return "a lobe whose angles do not grow, or with unlike numbers of angles and values", "two or more angles that grow, a value each"
    if not np.isfinite(lobe.value).all() or np.any(lobe.value < 0):
        return "a lobe with a value that is negative or no number", "values of 0 and more"
    if lobe.kind == "table" and lobe.angle_rad[0] == 0 and abs(lobe.value[0] - 1) > ON_AXIS:
        return f"a lobe of {lobe.value[0]:g} on its axis", "1 on the axis: how strong a light is stands in its intensity"
    return "", ""


def distant(name: str, names: Sequence[str], directions_C: Array, intensity: Array | None = None) -> Calibration:
    """A calibration of distant lights without a camera, intensities (N, 1) or (N, 3) scaled to a mean of 1."""
    intensity = np.ones((len(names), 1)) if intensity is None else scaled(intensity)
    return Calibration(name, tuple(Light(one, d, value) for one, d, value in zip(names, directions_C, intensity, strict=True)))


def near_lights(name: str, names: Sequence[str], sources_C: Array, point_C: Array, intensity: Array | None = None) -> Calibration:
    """A calibration of near lights (N, 3) without a camera that shine alike to all sides, aimed at the working point (3,) in C."""
    intensity = np.ones((len(names), 1)) if intensity is None else scaled(intensity)
    lights = []
    for one, source_C, value in zip(names, sources_C, intensity, strict=True):
        towards = of_light(source_C - point_C, f"{name}, light {one}")
        lights.append(Light(one, towards, value, None, source_C, -towards))
    return Calibration(name, tuple(lights), d_object_m=float(np.linalg.norm(point_C)), focus_C=point_C)
