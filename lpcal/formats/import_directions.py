"""Distant lights as directions: RTI's ``.lp`` and plain tables. x right, y up, z to the camera, from the object to the light.

``.lp``: the count, then ``file name x y z`` a line; the name may hold spaces, with or without quotes. A light is named after its image's
file, without its ending. A table has a row x y z a light, or three rows of N; a first row with the count alone is left out; lights are
named L0, L1, ... Vectors are apart by blanks, tabs, semicolons or commas. Vectors of one length that is not 1 are places on a dome about
the object: their directions are taken and that is said; so are those of unlike lengths, where most are not 1. Where most are 1 and some are
not, the file is damaged: refused, unless they are stated to be one or the other. A comment of lpcal's after the last light says from which
point of C positions are counted, and makes them near lights again. Source of .lp: RTIBuilder's documentation, RelightLab's reader, which
takes as many lines as the first one says.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path, PureWindowsPath

import numpy as np

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.light_tables import C_FROM_UP, distant, lines_of, near_lights, numbers, text_of, unit_rows, whole_number, words_of
from lpcal.formats.named_files import PICTURES, RAWS
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration

UNLIKE_LENGTHS = 0.02
"""Share of their mean by which lengths of rounded unit vectors, two decimals each, may differ."""
MOSTLY = 0.5
"""Share of vectors of length 1 from which the others are damaged directions, not positions."""
STATED = ("directions", "positions")
"""What a user may state the vectors to be."""
LEAST_OF_ANGLES = 4
"""Number of lights from which columns can be told to be angles: of three places two columns are often positive by chance."""
SAME_RAD = 1e-3
"""Radians within which two lights are of one direction: a line that is there twice, not two lamps."""
NUMBER = re.compile(r"[-+]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][-+]?\d+)?")
SPLIT = re.compile(r"[\s;]+")
COUNTED_FROM = "# lpcal: positions in mm, counted from the point of the camera's frame (x right, y down, z forward) "
"""How the comment begins after which the point stands, three numbers in mm."""
M_FROM_MM = 1e-3


def is_lp(path: Path) -> bool:
    """Whether a path is an .lp file."""
    return path.is_file() and path.suffix.lower() == ".lp"


def read_lp(path: Path, stated: str | None = None) -> tuple[Calibration, list[str]]:
    """Read an .lp file, its vectors `stated` to be directions or positions, or neither; and notes on it.

    Raises
    ------
    InputError
        No count, a line without three numbers, or a direction 0 0 0.
    DisagreementError
        Another count of lines than the first line says, two lights of one name, or vectors of unlike lengths.
    """
    lines = lines_of(path)
    if not lines or not re.fullmatch(r"\d{1,9}[,;]*", lines[0][1]):
        raise InputError("does not begin with the number of lights", where=f"{path}:1", needed="a whole number, then a line a light")
    count = int(lines[0][1].rstrip(",;"))
    if count != len(lines) - 1 or not count:
        raise DisagreementError(
            f"{len(lines) - 1} lights, but the first line says {count}",
            where=f"{path}:{lines[0][0]}",
            needed="one line a light",
            todo="correct the count or add the lines",
        )
    names: list[str] = []
    rows: list[Array] = []
    first: dict[str, int] = {}
    for at, line in lines[1:]:
        name, vector = _light(line, f"{path}:{at}")
        if name in first:
            raise DisagreementError(f"two lights are called {name}", where=f"{path}:{at} and {first[name]}", needed="each image once")
        first[name] = at
        names.append(name)
        rows.append(vector)
    point_C = counted_from(text_of(path), str(path)) if stated != "directions" else None
    if point_C is not None:
        found = near_lights(path.stem, names, point_C + np.stack(rows) * C_FROM_UP * M_FROM_MM, point_C)
        where = ", ".join(f"{value:.1f}" for value in point_C / M_FROM_MM)
        return found, [f"positions about the point {where} mm of the camera's frame, as its comment says: near lights, alike on all sides"]
    vectors, notes = _directions(np.stack(rows), path, stated)
    return distant(path.stem, names, vectors * C_FROM_UP), [*notes, *_of_one_direction(names, vectors)]


def counted_from(text: str, where: str) -> Array | None:
    """The point (3,) in C from which positions are counted, where a line of lpcal's in a text says it, metres.

    Raises
    ------
    InputError
        The line holds no such point.
    """
    said = [line for line in text.splitlines() if line.startswith(COUNTED_FROM)]
    if not said:
        return None
    point = numbers(said[-1].removeprefix(COUNTED_FROM).split(), where)
    if point.size != 3 or not point[2] > 0:
        raise InputError(f"{said[-1][:160]!r}", where=where, needed="three numbers in mm, the last above 0")
    return point * M_FROM_MM


def _light(line: str, where: str) -> tuple[str, Array]:
    """Name and vector of a line of an .lp."""
    quoted = re.match(r"\s*([\"'])(.+?)\1[\s,;]*", line)
    if quoted:
        name, words = quoted[2], words_of(line[quoted.end() :])
    else:
        words = [word for word in SPLIT.split(line) if word]
        if len(words) < 4 or any(word.endswith(",") for word in words[-3:-1]):  # commas between the values
            words = [word for word in re.split(r"[\s;,]+", line) if word]
        _refuse_more(words, where)
        name, words = " ".join(words[:-3]).rstrip(","), words[-3:]
    stem = PureWindowsPath(name).stem.strip()
    if len(words) != 3 or not stem:
        raise InputError(f"{line[:80]!r}", where=where, needed="file name and x y z")
    return stem, numbers(words, where)


def _refuse_more(words: list[str], where: str) -> None:
    """Stop where more than three numbers follow an image's name: the last three would be taken, and the first be part of the name."""
    at = next((k for k, word in enumerate(words) if PureWindowsPath(word.rstrip(",")).suffix.lower() in PICTURES + RAWS), len(words))
    more = words[at + 1 :]
    if len(more) > 3 and all(NUMBER.fullmatch(word.strip(",")) for word in more):
        raise InputError(
            f"{len(more)} numbers after {words[at]}",
            where=where,
            needed="file name and x y z",
            todo="leave the others out: an .lp states no intensities, angles or places beside directions",
        )


def _of_one_direction(names: Sequence[str], directions: Array) -> list[str]:
    """In words, lights that stand in one direction, as a line that was copied."""
    apart = np.linalg.norm(directions[:, None] - directions[None], axis=2) + 2 * np.tri(len(directions))
    pairs = [f"{names[i]} and {names[j]}" for i, j in np.argwhere(apart < SAME_RAD)]
    more = f" and {len(pairs) - 3} pairs more" if len(pairs) > 3 else ""
    return [f"{', '.join(pairs[:3])}{more} are of one direction: is a line there twice?"] if pairs else []


def is_table(path: Path) -> bool:
    """Whether a path is a text of rows of numbers, three a light."""
    return path.is_file() and path.suffix.lower() in {".txt", ".csv", ".dat"}


def read_table(path: Path, stated: str | None = None) -> tuple[Calibration, list[str]]:
    """Read a table of directions, and notes on it.

    Raises
    ------
    InputError
        Not N x 3 or 3 x N, or a direction 0 0 0.
    DisagreementError
        Another count than the first row says, or vectors of unlike lengths.
    """
    rows = [numbers(words_of(line), f"{path}:{count}") for count, line in lines_of(path)]
    count = whole_number(float(rows[0][0]), f"{path}:1", "the number of lights") if len(rows) > 1 and len(rows[0]) == 1 else None
    body = rows if count is None else rows[1:]
    if not body or len({len(row) for row in body}) != 1 or 3 not in (len(body), len(body[0])):
        raise InputError("no table of directions", where=str(path), needed="x y z a row, or three rows of x, y and z")
    stored = np.stack(body)
    ways = [way for way in (stored, stored.T) if way.shape[1] == 3]
    found = min(ways, key=lambda way: float(np.ptp(np.linalg.norm(way, axis=1)) / max(np.linalg.norm(way, axis=1).mean(), 1e-12)))
    if count not in {None, len(found)}:
        raise DisagreementError(f"{len(found)} lights, but the first row says {count}", where=str(path), needed="one row a light")
    vectors, notes = _directions(found, path, stated)
    names = [f"L{k}" for k in range(len(found))]
    return distant(path.stem, names, vectors * C_FROM_UP), [*notes, *_of_one_direction(names, vectors)]


def _refuse_angles(vectors: Array, path: Path) -> None:
    """Stop where two columns range as azimuths and elevations do and the third is constant: as places they would lie in one quadrant."""
    constant = np.flatnonzero(np.ptp(vectors, axis=0) == 0)
    if len(constant) != 1 or len(vectors) < LEAST_OF_ANGLES:
        return
    angles = np.delete(vectors, constant[0], axis=1)
    least, most = angles.min(axis=0), angles.max(axis=0)
    for unit, quarter in (("degrees", 90.0), ("radians", np.pi / 2)):
        if np.all(least >= 0) and most.min() <= quarter < most.max() <= 4 * quarter:
            ranges = " and ".join(f"{low:.4g} to {high:.4g}" for low, high in zip(least, most, strict=True))
            raise DisagreementError(
                f"two columns look like azimuth and elevation in {unit} ({ranges}), the other is {vectors[0, constant[0]]:.4g} throughout",
                where=str(path),
                needed="x y z of each light: x right, y up, z to the camera",
                todo="write cos(el) cos(az), cos(el) sin(az), sin(el), or state --vectors positions",
            )


def _directions(vectors: Array, path: Path, stated: str | None) -> tuple[Array, list[str]]:
    """Unit vectors (N, 3) to the lights, x right, y up, z to the camera; notes on how they came about."""
    if stated is None:
        _refuse_angles(vectors, path)
    unit = unit_rows(vectors, str(path))
    length = np.linalg.norm(vectors, axis=1)
    mean, notes = float(length.mean()), []
    alike = np.ptp(length) <= UNLIKE_LENGTHS * mean
    ones = float(np.mean(np.abs(length - 1) <= UNLIKE_LENGTHS))
    if not alike and stated is None and ones >= MOSTLY:
        k = int(np.argmax(np.abs(length - 1)))
        raise DisagreementError(
            f"vectors of unlike lengths, {length.min():.4g} to {length.max():.4g}, though {100 * ones:.0f} % of them are of length 1",
            where=f"{path}, light {k + 1}",
            needed="unit vectors from the object to the lights",
            todo="state --vectors positions (from the object's middle; distant lights are made of them) or --vectors directions",
        )
    if stated == "positions" or (stated is None and (not alike or abs(mean - 1) > UNLIKE_LENGTHS)):
        which = f"{mean:.4g}" if alike else f"{length.min():.4g} to {length.max():.4g}"
        notes.append(f"vectors of length {which} are taken as positions about the object's middle: distant lights in their directions")
    elif not alike:
        notes.append(f"vectors of length {length.min():.4g} to {length.max():.4g} are taken as directions, as stated")
    below = [k + 1 for k in np.flatnonzero(unit[:, 2] <= 0)]
    if below:
        listed = ", ".join(map(str, below[:8])) + (", ..." if len(below) > 8 else "")
        notes.append(f"{len(below)} of {len(unit)} lights stand behind the object or at its horizon (z of 0 or less): light {listed}")
    if len(below) == len(unit):
        raise DisagreementError(
            "every light stands behind the object (z of 0 or less)",
            where=str(path),
            needed="x right, y up, z to the camera",
            todo="turn the sign of z",
        )
    return unit, notes


LP = (is_lp, read_lp)
TABLE = (is_table, read_table)
