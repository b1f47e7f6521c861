"""Distant lights as directions: RTI's ``.lp`` and plain tables. x right, y up, z to the camera, from the object to the light.

``.lp``: the count, then ``file name x y z`` a line; the name may hold spaces. A light is named after its image's file, without its ending.
A table has a row x y z a light, or three rows of N; a first row with the count alone is left out; lights are named L0, L1, ...
Source of .lp: RTIBuilder's and RelightLab's documentation.
"""

from __future__ import annotations

from pathlib import Path, PureWindowsPath

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.light_tables import C_FROM_UP, distant, numbers, text_of, unit_rows
from lpcal.formats.text import decimal_points
from lpcal.records.calibration import Calibration

UNLIKE_LENGTHS = 0.02
"""How far from each other, and from 1, the lengths of directions may be: files keep two digits and more."""


def is_lp(path: Path) -> bool:
    """Whether a path is an .lp file."""
    return path.suffix.lower() == ".lp"


def read_lp(path: Path) -> Calibration:
    """Read an .lp file.

    Raises
    ------
    InputError
        Another count of lines than the first line says, a line without three numbers, a direction 0 0 0, or two lights of one name.
    """
    text = decimal_points(text_of(path)).replace(";", " ").replace(",", " ")
    lines = [(count, line.split()) for count, line in enumerate(text.split("\n"), 1) if line.strip() and not line.startswith("#")]
    if not lines or len(lines[0][1]) != 1 or not lines[0][1][0].isdigit():
        raise InputError("does not begin with the number of lights", where=f"{path}:1", needed="a whole number, then a line a light")
    stated = int(lines[0][1][0])
    if stated != len(lines) - 1:
        found = f"{len(lines) - 1} lights, but the first line says {stated}"
        raise InputError(found, where=f"{path}:1", needed="one line a light", todo="is the file cut off?")
    names, rows = [], []
    for count, words in lines[1:]:
        if len(words) < 4:
            raise InputError(f"{' '.join(words)!r}", where=f"{path}:{count}", needed="file name and x y z")
        rows.append(numbers(words[-3:], f"{path}:{count}"))
        names.append(PureWindowsPath(" ".join(words[:-3]).strip("\"'")).stem)
    if len(set(names)) < len(names):
        double = next(name for name in names if names.count(name) > 1)
        raise InputError(f"two lights are called {double}", where=str(path), needed="each image once")
    vectors = np.stack(rows) if rows else np.zeros((0, 3))
    length = np.linalg.norm(vectors, axis=1)
    if rows and (np.abs(length - 1) > UNLIKE_LENGTHS).any() and np.ptp(length) > UNLIKE_LENGTHS * length.max():
        raise InputError(
            f"vectors of lengths {length.min():.3g} to {length.max():.3g}: positions, not directions",
            where=str(path),
            needed="unit vectors from the object to the lights",
            todo="divide each by its length if the lights are far away; else give them as LUCES' led_params or near_ps' light.mat",
        )
    return distant(path.stem, names, unit_rows(vectors, str(path)) * C_FROM_UP)


def is_table(path: Path) -> bool:
    """Whether a path is a text of rows of numbers, three a light."""
    return path.is_file() and path.suffix.lower() in {".txt", ".csv", ".dat"}


def read_table(path: Path) -> Calibration:
    """Read a table of directions.

    Raises
    ------
    InputError
        Not N x 3 or 3 x N, not directions of length 1, or another count than the first row says.
    """
    rows = [
        (count, numbers(line.replace(",", " ").replace(";", " ").split(), f"{path}:{count}"))
        for count, line in enumerate(decimal_points(text_of(path)).split("\n"), 1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    stated = int(rows[0][1][0]) if rows and len(rows[0][1]) == 1 else None
    body = [row for _, row in (rows if stated is None else rows[1:])]
    if not body or len({len(row) for row in body}) != 1 or 3 not in (len(body), len(body[0])):
        raise InputError("no table of directions", where=str(path), needed="x y z a row, or three rows of x, y and z")
    stored = np.stack(body)
    ways = [way for way in (stored, stored.T) if way.shape[1] == 3]
    found = min(ways, key=lambda way: float(np.ptp(np.linalg.norm(way, axis=1))))
    if stated not in {None, len(found)}:
        raise InputError(f"{len(found)} lights, but the first row says {stated}", where=str(path), needed="one row a light")
    if np.ptp(np.linalg.norm(found, axis=1)) > UNLIKE_LENGTHS:
        raise InputError(
            "vectors of unlike lengths: positions, not directions", where=str(path), needed="unit vectors from the object to the lights"
        )
    return distant(path.stem, [f"L{k}" for k in range(len(found))], unit_rows(found, str(path)) * C_FROM_UP)


LP = (is_lp, read_lp)
TABLE = (is_table, read_table)
