"""Readings of the distance sensor: a column ``distance_m`` in the csv files of images, or a csv of its own.

Columns: ``file`` (an image's path, relative to the csv), ``time_s`` (the camera's clock) or both, and ``distance_m``, ``distance_mm`` or
``distance_cm``. A row whose distance is empty has no reading. Further columns are left alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.image_times import FILES, TIMES
from lpcal.formats.named_files import resolve_named
from lpcal.formats.number_table import COMMENTS, is_number, seconds
from lpcal.formats.reading import reader
from lpcal.formats.text import read_text, with_commas

DISTANCES = {"distance_m": 1.0, "distance_mm": 1e-3, "distance_cm": 1e-2}
"""Names of the column of readings, and the metres in its unit."""
LAYOUT = "columns file or time_s, and distance_m"


@dataclass(frozen=True)
class ReadingRow:
    """One reading: of an image, at a time on the camera's clock, or both."""

    name: str
    """Where it stands, in words."""
    image: Path | None
    t_camera_s: float | None
    distance_m: float


@reader(LAYOUT)
def read_distances(path: Path, *, needed: bool = True) -> list[ReadingRow]:
    """The readings of a csv; none where it has no such column and none is `needed`.

    Raises
    ------
    InputError
        No column of distances (where one is needed), neither file nor time, a distance or time that is no number, or no such image.
    """
    lines = [
        (number, [cell.strip() for cell in line.split(",")])
        for number, line in enumerate(with_commas(read_text(path, LAYOUT), path).split("\n"), start=1)
        if line.strip(", \t") and not line.lstrip().startswith(COMMENTS)
    ]
    names = [cell.lower().lstrip("#").strip() for cell in lines[0][1]] if lines else []
    column = next((names.index(name) for name in DISTANCES if name in names), None)
    if column is None:
        if not needed:
            return []
        raise InputError(f"columns {','.join(names)}", where=f"{path}:1", needed=LAYOUT, todo="name the columns so")
    file = next((names.index(name) for name in FILES if name in names), None)
    time = next((names.index(name) for name in TIMES if name in names), None)
    if file is None and time is None:
        raise InputError(f"columns {','.join(names)}", where=f"{path}:{lines[0][0]}", needed=LAYOUT, todo="name an image or a time each")
    unit = DISTANCES[names[column]]
    found: list[ReadingRow] = []
    for number, cells in lines[1:]:
        where = f"{path}:{number}"
        if len(cells) <= column or not cells[column]:
            continue
        if not is_number(cells[column]) or not np.isfinite(float(cells[column])):
            raise InputError(f"{names[column]} {cells[column]!r}", where=where, needed="a number, or nothing where there is no reading")
        image = None if file is None or not cells[file] else resolve_named(path.parent, cells[file])
        if file is not None and cells[file] and image is None:
            raise InputError(f"no such image: {cells[file]}", where=where, needed="a path relative to this csv", todo="correct it")
        if time is not None and not is_number(cells[time]):
            raise InputError(f"{names[time]} {cells[time]!r}", where=where, needed="seconds", todo="is the file cut off?")
        at = None if time is None else float(seconds([cells[time]], TIMES[names[time]])[0])
        name = f"{path.name}:{number}" if image is None else image.name
        found.append(ReadingRow(name, image, at, unit * float(cells[column])))
    return found
