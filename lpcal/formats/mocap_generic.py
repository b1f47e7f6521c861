"""Poses in a plain csv: a time, a position, a quaternion, in columns named or not (ETH, EuRoC, one's own).

Without names the eight columns are ``t, x, y, z, qx, qy, qz, qw`` (seconds, metres). With names the columns may stand in any order:
``t|time|timestamp[_s|_ns]``, ``x|px|tx|p_x..``, ``qx|q_x..qw``; a unit may follow, ``x_mm`` or ``x [mm]``.
Names of ROS messages (``field.pose.position.x``) are known too; stamps too large for seconds are milli-, micro- or nanoseconds, and dates
and times of the day are read. Several bodies stand under a column that names them (``body``), or in columns that begin with their names
(``Wand_x, Wand_qx, ...``).
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.body_choice import choose_body
from lpcal.formats.number_table import COMMENTS, UNITS_S, is_number, read_numbers, unit_of_stamps
from lpcal.formats.pose_table import PoseTable
from lpcal.formats.time_stamps import with_seconds
from lpcal.geometry.arrays import Array

PLAIN = ["t", "x", "y", "z", "qx", "qy", "qz", "qw"]
LAYOUT = "t_s, x_m, y_m, z_m, qx, qy, qz, qw"


def read_generic(text: str, path: Path, quaternion: str | None = None, units: str | None = None, body: str | None = None) -> PoseTable:
    """The poses of a csv, its cells divided by commas or by blanks; `body` counts where the file tells bodies apart.

    Raises
    ------
    InputError
        Its columns cannot be identified, two are of one name, several bodies and none named, or a row cannot be read.
    DisagreementError
        The file tells bodies apart and holds none of that name.
    """
    lines = [line if "," in line else ",".join(line.split()) for line in text.split("\n")]
    start, cells = _first_row(lines, path)
    named = not is_number(cells[0])
    where, name = f"{path}:{start + 1}", ""
    first = start + 1 + named
    rows = lines[first - 1 :]
    if named:
        cells, name = _columns_of_body(cells, body, path)
        rows, name = _rows_of_body(rows, cells, body, path) or (rows, name)
        places, unit_of_time, unit_of_length = _named(cells, where)
    elif len(cells) >= len(PLAIN):
        _refuse_unlike(cells, where)
        places, unit_of_time, unit_of_length = list(range(8)), None, None
    else:
        raise InputError(f"{len(cells)} columns without names", where=where, needed=LAYOUT, todo="add a row of names")
    if quaternion == "wxyz" and not named:
        places = [*places[:4], *(places[i] for i in (5, 6, 7, 4))]
    rows, notes = with_seconds(rows, places[0])
    numbers = read_numbers("\n".join(rows), first, path, delimiter=",", columns=places)
    unit = unit_of_time if unit_of_time not in {None, "s"} else unit_of_stamps(float(np.nanmax(np.abs(numbers[:, 0]), initial=0)))
    t_s = _whole_ns(rows, ",", places[0], len(numbers)) if unit == "ns" else None
    t_s = numbers[:, 0] * UNITS_S[str(unit)] if t_s is None else t_s
    notes = (*notes, f"times are {unit}") if unit != "s" else notes
    return PoseTable(name, t_s, numbers[:, 1:4], None, numbers[:, 4:8], units or unit_of_length or "m", first_line=first, notes=notes)


def _first_row(lines: list[str], path: Path) -> tuple[int, list[str]]:
    """The place and the cells of the first row that is names or numbers; a comment is either names or nothing."""
    for place, line in enumerate(lines):
        if not line.strip(", \t"):
            continue
        cells = [cell.strip() for cell in line.lstrip("#%/ ").split(",")]
        if line.lstrip().startswith(COMMENTS) and not {"x", "y", "z"} <= {_key(_split(cell)[0]) for cell in cells}:
            continue
        return place, cells
    raise InputError("no rows of numbers", where=str(path), needed=f"a csv of {LAYOUT}", todo="export it again")


BODIES = {"body", "body_name", "rigid_body", "rigidbody", "rigid_body_name", "subject", "object", "object_name", "tracker", "name"}
"""Names of a column that tells bodies apart."""
OF_A_BODY = re.compile(r"(.+?)[\s._:/-]+(q?[xyz]|qw)((?:_|\s*[\[(]\s*)(?:m|cm|mm)\s*[\])]?)?$", re.IGNORECASE)
"""A column that begins with its body's name: ``Wand_qx``, ``Wand: x [mm]``."""


def _columns_of_body(cells: list[str], body: str | None, path: Path) -> tuple[list[str], str]:
    """The names of the columns with one body's as if it were alone and none for the others', and its name.

    They stay as they are where one body's columns have no name before them, or no body has all of position and quaternion.
    """
    if set(PLAIN) <= {_key(_split(cell)[0]) for cell in cells}:
        return cells, ""
    of: dict[str, set[str]] = {}
    parts = [OF_A_BODY.fullmatch(cell.strip()) for cell in cells]
    for match in parts:
        if match:
            of.setdefault(match[1], set()).add(match[2].lower())
    whole = [name for name, columns in of.items() if columns >= set(PLAIN[1:])]
    if not whole:
        return cells, ""
    chosen = choose_body(whole, body, path)
    return [
        cell if match is None else match[2] + (match[3] or "") if match[1] == chosen else ""
        for cell, match in zip(cells, parts, strict=True)
    ], chosen


def _rows_of_body(rows: list[str], cells: list[str], body: str | None, path: Path) -> tuple[list[str], str] | None:
    """The rows of one body, with empty lines for the others', and its name; None where no column tells bodies apart."""
    place = next((place for place, cell in enumerate(cells) if _split(cell)[0] in BODIES), None)
    if place is None:
        return None
    names = [parts[place].strip() if place < len(parts := row.split(",")) else "" for row in rows]
    found = sorted({name for name in names if name and not is_number(name)})
    if not found:
        return None
    chosen = choose_body(found, body, path)
    return [row if name == chosen else "" for row, name in zip(rows, names, strict=True)], chosen


def _refuse_unlike(cells: list[str], where: str) -> None:
    """Without names the fifth to eighth numbers must be a quaternion where there are more than eight."""
    if len(cells) == len(PLAIN):
        return
    numbers = [float(cell) if is_number(cell) else np.nan for cell in cells[4:8]]
    if not abs(np.linalg.norm(numbers) - 1) < 0.02:
        raise InputError(f"{len(cells)} columns without names", where=where, needed=LAYOUT, todo="add a row of names")


def _whole_ns(lines: list[str], delimiter: str, place: int, count: int) -> Array | None:
    """Times (N,) of whole nanoseconds, which a float of nanoseconds would round to 256; None where they are not whole."""
    rows = (line.split(delimiter) for line in lines if line.strip(", \t") and not line.lstrip().startswith(COMMENTS))
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
        if key in found and cell.strip().lower() == cells[found[key]].strip().lower():
            both = f"{cell.strip()} in columns {found[key] + 1} and {place + 1}"
            raise InputError(both, where=where, needed="each name once", todo="put the body's name before each column's, or keep one body")
        if key and (key not in found or (key == "t" and "stamp" in name and "stamp" not in _split(cells[found["t"]])[0])):
            found[key] = place
            units[key] = unit
    lacking = [key for key in PLAIN if key not in found]
    if lacking:
        raise InputError(f"no column for {', '.join(lacking)}", where=where, needed=LAYOUT, todo=_other_names(cells))
    time = units["t"] if units["t"] in UNITS_S else None
    return [found[key] for key in PLAIN], time, units["x"] if units["x"] in {"m", "cm", "mm"} else None


OTHER_TURNS = {
    (
        "roll",
        "pitch",
        "yaw",
    ): "turn the angles into quaternions (scipy: Rotation.from_euler), in the order in which the system defines them",
    ("rx", "ry", "rz"): "turn the rotations into quaternions (scipy: Rotation.from_rotvec, or from_euler if they are angles)",
    ("q0", "q1", "q2", "q3"): "name the quaternion's columns qx, qy, qz and qw: which of the four is w the names do not say",
    ("q1", "q2", "q3", "q4"): "name the quaternion's columns qx, qy, qz and qw: which of the four is w the names do not say",
}
"""Names of rotations that are no quaternion, or of unknown order, and what to do."""


def _other_names(cells: list[str]) -> str:
    """What to do where columns lack, by the names that are there."""
    names = {_split(re.sub(r"[\s_\[(]*(deg|rad|degrees|radians)[\])]?$", "", cell.strip().lower()))[0] for cell in cells}
    turned = next((todo for triple, todo in OTHER_TURNS.items() if names >= set(triple)), None)
    if turned is None and not any(_key(name) == "t" for name in names) and names & {"frame", "frames", "index", "sample"}:
        return "add a column t_s: the frame's number over the rate in Hz"
    return turned or "name the columns so"


def _split(cell: str) -> tuple[str, str]:
    """A column's name, its words joined by _, and its unit: ``p_RS_R_x [m]``, ``x_mm``, ``field.pose.position.x``."""
    text = cell.strip().lower().lstrip("%#")
    match = re.fullmatch(r"(.*?)\s*[\[(]\s*([^\])]*)\s*[\])]", text) or re.fullmatch(r"(.*)_(mm|cm|m|s|ms|us|ns)", text)
    name, unit = (match.group(1).strip(), match.group(2).strip()) if match else (text, "")
    return re.sub(r"[^a-z0-9]+", "_", name).strip("_"), unit


TIMES = {"t", "time", "timestamp", "stamp", "sec", "seconds", "secs"}
TURNS = ("orientation", "rotation", "rot", "quat", "quaternion", "q")
PLACES = ("p", "t", "pos", "position", "translation", "trans", "pose", "field", "transform", "loc", "location")
"""How a column of positions may begin beside its axis."""
STRANGERS = {
    "v",
    "b",
    "w",
    "r",
    "vel",
    "velocity",
    "twist",
    "linear",
    "angular",
    "acc",
    "accel",
    "bias",
    "cov",
    "covariance",
    "omega",
    "force",
}
"""Words of columns that are neither positions nor orientations."""


def _key(name: str) -> str | None:
    """t, x, y, z, qx, qy, qz or qw, by the words of a column's name; None for another column."""
    words = name.split("_")
    if words[-1] in TIMES and len(words) <= 3:
        return "t"
    if words[0] in STRANGERS or set(words) & (STRANGERS - {"r", "w", "b", "v"}):
        return None
    turn = re.fullmatch(r"(?:q|quat|rot|orientation)([xyzw])", words[-1])
    if turn:
        return f"q{turn.group(1)}"
    if words[-1] in {"x", "y", "z", "w"} and any(word in TURNS for word in words[:-1]):
        return f"q{words[-1]}"
    place = re.fullmatch(r"(?:p|t|pos)?([xyz])", words[-1])
    return place.group(1) if place and (len(words) == 1 or words[0] in PLACES) else None
