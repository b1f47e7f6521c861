"""Rows of numbers in a text file, read fast; an empty cell is NaN, and a row that cannot be read is named by its line."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.geometry.arrays import Array

MOST_HZ = 1e6
"""Hz of the fastest recording that is believed."""
COMMENTS = ("#", "//", "%")
"""What a line begins with that holds no numbers."""
NOTHING = re.compile(
    r"(?i)(?<![^,;\t\n])[ ]*(?:null|none|n/?a|#n/?a|-+|nil|missing|-?1\.#(?:ind|inf|qnan)\d*|-?nan\((?:ind|snan)\))[ ]*(?![^,;\t\n])"
)
"""What programs write into a cell that holds no number: databases, Excel, pandas, R, old Windows."""
BLANK_ROW = re.compile(r"(?:nan|[\s,;])*")


def read_numbers(text: str, first_line: int, path: Path, *, delimiter: str | None, columns: Sequence[int] | None = None) -> Array:
    """Numbers (N, columns) of a text whose first line is line `first_line` of the file; blank and ``#`` lines are left out.

    Raises
    ------
    InputError
        A cell that is no number, or a row with too few of them: its line is named.
    """
    filled = text if delimiter is None else _filled(text, delimiter)
    lines = [line for line in filled.splitlines() if not BLANK_ROW.fullmatch(line)]
    if not lines:
        return np.zeros((0, len(columns or ())))
    if delimiter is not None and not text.endswith("\n") and len(lines) > 1:
        _refuse_cut(text, first_line, path, delimiter)
    try:
        return np.loadtxt(io.StringIO("\n".join(lines)), delimiter=delimiter, usecols=columns, ndmin=2, comments=COMMENTS)
    except ValueError as error:
        if delimiter is not None and NOTHING.search(text):
            return read_numbers(NOTHING.sub("nan", text), first_line, path, delimiter=delimiter, columns=columns)
        raise _complaint(text, first_line, path, delimiter, columns) from error


def _refuse_cut(text: str, first_line: int, path: Path, delimiter: str) -> None:
    """Stop where the last line has no end and fewer cells than the one before."""
    lines = text.splitlines()
    last, before = lines[-1].count(delimiter), lines[-2].count(delimiter)
    if last < before:
        where = f"{path}:{first_line + len(lines) - 1}"
        raise InputError(f"{last + 1} cells", where=where, needed=f"{before + 1}", todo="is the file cut off? export it again")


def _filled(text: str, delimiter: str) -> str:
    """The text with nan in every empty cell."""
    text = f"\n{text.replace('\r', '')}\n"
    if f"{delimiter} " in text:
        text = re.sub(rf" +(?=[{delimiter}\n])", "", text)
    for _ in range(2):  # neighbouring empty cells share a delimiter
        text = text.replace(delimiter * 2, f"{delimiter}nan{delimiter}")
    return text.replace(f"{delimiter}\n", f"{delimiter}nan\n").replace(f"\n{delimiter}", f"\nnan{delimiter}")


def _complaint(text: str, first_line: int, path: Path, delimiter: str | None, columns: Sequence[int] | None) -> InputError:
    """The first line that cannot be read."""
    needed = 0
    for number, line in enumerate(text.splitlines(), start=first_line):
        cells = [cell.strip() for cell in line.split(delimiter)]
        if not any(cells) or line.lstrip().startswith(COMMENTS):
            continue
        needed = needed or (1 + max(columns) if columns else len(cells))
        if len(cells) < needed:
            todo = _joined(text, number - first_line, delimiter) or "is the file cut off? export it again"
            return InputError(f"{len(cells)} cells", where=f"{path}:{number}", needed=f"{needed}", todo=todo)
        for place in columns or range(needed):
            if cells[place] and not is_number(cells[place]):
                found = f"{cells[place]!r} in column {place + 1}"
                return InputError(found, where=f"{path}:{number}", needed="a number", todo=_joined(text, number - first_line, delimiter))
    return InputError("rows of unlike length", where=f"{path}:{first_line}", needed="as many numbers in every row")


def _joined(text: str, row: int, delimiter: str | None) -> str:
    """What to do about a row without numbers that has rows of numbers before and behind it."""
    numbers = [is_number(line.split(delimiter)[0].strip()) for line in text.splitlines()]
    both = any(numbers[:row]) and any(numbers[row + 1 :]) and not numbers[row]
    return "is it the header of a second recording, joined to the first? keep one recording a file" if both else ""


def is_number(cell: str) -> bool:
    """Whether a cell holds a number."""
    try:
        float(cell)
    except ValueError:
        return False
    return True


def is_rate(cell: str) -> bool:
    """Whether a cell holds a rate in Hz: a number over zero that a camera can have."""
    return is_number(cell) and 0 < float(cell) < MOST_HZ


UNITS_S = {"s": 1.0, "sec": 1.0, "seconds": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
"""Seconds in a unit of time."""
LATEST_S = 1e11
"""Seconds since any epoch that are believed: the year 5138 in Unix time. Larger stamps count milli-, micro- or nanoseconds."""


def unit_of_stamps(largest: float) -> str:
    """The unit of stamps that do not state one: the coarsest in which the largest is a time of this age."""
    return next((unit for unit in ("s", "ms", "us") if abs(largest) * UNITS_S[unit] <= LATEST_S), "ns")


def seconds(stamps: Sequence[str], unit: str | None = None) -> Array:
    """Stamps (N,) as seconds; whole numbers keep all their digits. Without a unit, or as too late seconds, it is found from their size."""
    values = np.array([float(stamp) for stamp in stamps])
    if unit in {None, "s"}:
        unit = unit_of_stamps(float(np.abs(values).max(initial=0.0)))
    if unit == "s" or not all(stamp.strip().lstrip("-").isdigit() for stamp in stamps):
        return np.asarray(values * UNITS_S[str(unit)])
    ticks = round(1 / UNITS_S[str(unit)])
    return np.array([int(stamp) // ticks + (int(stamp) % ticks) / ticks for stamp in stamps])
