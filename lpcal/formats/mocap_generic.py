"""Poses in a plain csv: a time, a position, a quaternion, in columns named or not (ETH, EuRoC, one's own).

Without names the eight columns are ``t, x, y, z, qx, qy, qz, qw`` (seconds, metres). With names the columns may stand in any order:
``t|time|timestamp[_s|_ns]``, ``x|px|tx|p_x..``, ``qx|q_x..qw``; a unit may follow, ``x_mm`` or ``x [mm]``.
Times over 1e14 are nanoseconds.
"""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.number_table import is_number, read_numbers, read_text
from lpcal.formats.pose_table import PoseTable
from lpcal.geometry.arrays import Array

PLAIN = ["t", "x", "y", "z", "qx", "qy", "qz", "qw"]
LAYOUT = "t_s, x_m, y_m, z_m, qx, qy, qz, qw"
NANOSECONDS = 1e14
"""Times over this are nanoseconds: as seconds they would be three million years."""
TIMES = {"s": 1.0, "sec": 1.0, "seconds": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}


def read_generic(path: Path, quaternion: str | None = None, units: str | None = None) -> PoseTable:
    """The poses of a csv; it knows no bodies.

    Raises
    ------
    InputError
        Its columns cannot be told, or a row cannot be read.
    """
    text = read_text(path)
    lines = text.splitlines()
    start = next((i for i, line in enumerate(lines) if line.strip()), None)
    if start is None:
        raise InputError("empty", where=str(path), needed=f"a csv of {LAYOUT}", todo="export it again")
    delimiter = max(",;\t", key=lines[start].count)
    cells = next(csv.reader([lines[start].lstrip("# ")], delimiter=delimiter))
    named = not is_number(cells[0])
    if named:
        places, unit_of_time, unit_of_length = _named(cells, f"{path}:{start + 1}")
    elif len(cells) == len(PLAIN):
        places, unit_of_time, unit_of_length = list(range(8)), None, None
    else:
        raise InputError(f"{len(cells)} columns without names", where=f"{path}:{start + 1}", needed=LAYOUT, todo="add a row of names")
    if quaternion == "wxyz" and not named:
        places = [*places[:4], *(places[i] for i in (5, 6, 7, 4))]
    first = start + 1 + named
    numbers = read_numbers("\n".join(lines[first - 1 :]), first, path, delimiter=delimiter, columns=places)
    unit = unit_of_time or ("ns" if np.nanmax(np.abs(numbers[:, 0]), initial=0) > NANOSECONDS else "s")
    t_s = _whole_ns(lines[first - 1 :], delimiter, places[0], len(numbers)) if unit == "ns" else None
    t_s = numbers[:, 0] * TIMES[unit] if t_s is None else t_s
    return PoseTable("", t_s, numbers[:, 1:4], None, numbers[:, 4:8], units or unit_of_length or "m", first_line=first)


def _whole_ns(lines: list[str], delimiter: str, place: int, count: int) -> Array | None:
    """Times (N,) of whole nanoseconds, which a float of nanoseconds would round to 256; None where they are not whole."""
    rows = (line.split(delimiter) for line in lines if line.strip() and not line.startswith("#"))
    stamps = [row[place].strip() for row in rows if place < len(row)]
    if len(stamps) != count or not all(stamp.isdigit() for stamp in stamps):
        return None
    return np.array([int(stamp) // 10**9 + (int(stamp) % 10**9) * 1e-9 for stamp in stamps])


def _named(cells: list[str], where: str) -> tuple[list[int], str | None, str | None]:
    """Places of t, x, y, z, qx, qy, qz, qw among named columns, the unit of time and that of length where the names say them."""
    found: dict[str, int] = {}
    units: dict[str, str] = {}
    for place, cell in enumerate(cells):
        name, unit = _split(cell)
        key = _key(name)
        if key and key not in found:
            found[key] = place
            units[key] = unit
    lacking = [key for key in PLAIN if key not in found]
    if lacking:
        raise InputError(f"no column for {', '.join(lacking)}", where=where, needed=LAYOUT, todo="name the columns so")
    time = units["t"] if units["t"] in TIMES else None
    return [found[key] for key in PLAIN], time, units["x"] if units["x"] in {"m", "cm", "mm"} else None


def _split(cell: str) -> tuple[str, str]:
    """A column's name and unit: ``p_RS_R_x [m]``, ``x_mm``."""
    text = cell.strip().lower()
    match = re.fullmatch(r"(.*?)\s*[\[(]\s*([^\])]*)\s*[\])]", text) or re.fullmatch(r"(.*)_(mm|cm|m|s|ms|us|ns)", text)
    return (match.group(1).strip(), match.group(2).strip()) if match else (text, "")


def _key(name: str) -> str | None:
    if name in {"t", "time", "timestamp", "stamp", "#timestamp", "sec", "seconds"}:
        return "t"
    match = re.fullmatch(r"q(?:uat(?:ernion)?)?_?(?:.*_)?([xyzw])", name)
    if match:
        return f"q{match.group(1)}"
    match = re.fullmatch(r"(?:p|t|pos(?:ition)?|translation)?_?(?:[a-z0-9_]*_)?([xyz])", name)
    return match.group(1) if match and not name.startswith(("v", "b_", "r", "w")) else None
