"""What the readers of other systems' lights share: tables of numbers, and directions in other axes.

Axes: many systems write x right, y up, z to the camera; C is x right, y down, z forward, so ``v_C = (x, -y, -z)``.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
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
    try:
        return path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError("cannot be read as text", where=str(path), needed="a text file of lights") from error


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
