"""TUM trajectories: ``timestamp tx ty tz qx qy qz qw`` a line, blanks between, seconds and metres, ``#`` starts a comment.

Source: TUM RGB-D benchmark, file formats.
"""

from __future__ import annotations

from pathlib import Path

from lpcal.errors import InputError
from lpcal.formats.number_table import COMMENTS, is_number, read_numbers
from lpcal.formats.pose_table import PoseTable
from lpcal.formats.text import decimal_points


def is_tum(text: str) -> bool:
    """Whether the first line of numbers is eight numbers with blanks between."""
    line = next((line for line in text.splitlines() if line.strip() and not line.lstrip().startswith(COMMENTS)), "")
    cells = line.split()
    return "," not in decimal_points(line) and ";" not in line and len(cells) == 8 and is_number(decimal_points(cells[0]))


def read_tum(text: str, path: Path, quaternion: str | None = None, units: str | None = None) -> PoseTable:
    """The poses of a TUM file; it knows no bodies.

    Raises
    ------
    InputError
        A line without eight numbers.
    """
    numbers = read_numbers(text, 1, path, delimiter=None)
    if numbers.shape[1] != 8:
        raise InputError(f"{numbers.shape[1]} numbers a line", where=str(path), needed="timestamp tx ty tz qx qy qz qw")
    first = next(i for i, line in enumerate(text.splitlines(), start=1) if line.strip() and not line.lstrip().startswith(COMMENTS))
    q = numbers[:, [5, 6, 7, 4]] if quaternion == "wxyz" else numbers[:, 4:]
    return PoseTable("", numbers[:, 0], numbers[:, 1:4], None, q, units or "m", first_line=first)
