"""POINTS.csv and FIELD.csv of the light field.

``x_m,y_m,z_m`` are points in C; the field has ``light,x_m,y_m,z_m,dx,dy,dz,irradiance``: a unit vector from the point to the light, and the
irradiance of a surface that faces it, relative, on one scale for all lights; of an RGB light the mean over the channels.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.named_files import did_you_mean
from lpcal.formats.number_table import COMMENTS, is_number
from lpcal.formats.outputs import marked, whole
from lpcal.formats.reading import reader
from lpcal.formats.text import read_text, with_commas
from lpcal.geometry.arrays import Array

COLUMNS = ("x_m", "y_m", "z_m")
HEADER = ("light", *COLUMNS, "dx", "dy", "dz", "irradiance")
FIELD = marked("a light field", ",".join(HEADER))


@reader(f"a csv with columns {', '.join(COLUMNS)}")
def read_points(path: Path) -> Array:
    """Points (N, 3) in metres.

    Raises
    ------
    InputError
        Not there, without the three columns, or a cell that is no finite number; with its line.
    """
    needed = f"a csv with columns {', '.join(COLUMNS)}"
    lines = [
        (number, [cell.strip() for cell in line.split(",")])
        for number, line in enumerate(with_commas(read_text(path, needed), path).split("\n"), start=1)
        if line.strip(", \t") and not line.lstrip().startswith(COMMENTS)
    ]
    names = [name.lower() for name in lines[0][1]] if lines else []
    lacking = [name for name in COLUMNS if name not in names]
    if lacking:
        raise InputError(f"no column {', '.join(lacking)}", where=f"{path}:1", needed=needed, todo="name the columns so")
    places = [names.index(name) for name in COLUMNS]
    points = []
    for number, cells in lines[1:]:
        row = [cells[place] if place < len(cells) else "" for place in places]
        if not all(is_number(cell) and np.isfinite(float(cell)) for cell in row):
            raise InputError(f"{', '.join(row)!r}", where=f"{path}:{number}", needed="three finite numbers in metres")
        points.append([float(cell) for cell in row])
    if not points:
        raise InputError("no points", where=str(path), needed="a line a point")
    return np.array(points)


def write_field(path: Path, x_C: Array, fields: Mapping[str, tuple[Array, Array]]) -> None:
    """Write the unit vectors (N, 3) and irradiances (N, C) of each light at the points x_C (N, 3)."""
    with whole(path, FIELD) as draft, draft.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream)
        writer.writerow(HEADER)
        for light, (d_C, irradiance) in fields.items():
            for point, d, level in zip(x_C, d_C, irradiance.mean(axis=1), strict=True):
                writer.writerow([light, *(f"{value:.9g}" for value in (*point, *d, level))])


@reader("a csv that lpcal field wrote")
def read_field(path: Path) -> tuple[Array, dict[str, tuple[Array, Array]]]:
    """The points (N, 3) of a FIELD.csv, and by light the unit vectors (N, 3) and irradiances (N,) there; every light at the same points.

    Raises
    ------
    InputError
        Not there, or lines that do not fit.
    """
    if not path.is_file():
        raise InputError("no such file", where=str(path), needed="a csv that lpcal field wrote", todo=did_you_mean(path))
    rows: dict[str, list[list[float]]] = {}
    with path.open(encoding="utf-8-sig", newline="") as stream:
        reader = csv.DictReader(stream)
        try:
            for row in reader:
                rows.setdefault(row["light"], []).append([float(row[name]) for name in (*COLUMNS, "dx", "dy", "dz", "irradiance")])
        except (KeyError, TypeError, ValueError) as error:
            raise InputError(
                "a cell is lacking or no number", where=f"{path}:{reader.line_num}", needed="the columns of lpcal field"
            ) from error
    tables = {light: np.array(table) for light, table in rows.items()}
    if not tables or len({len(table) for table in tables.values()}) > 1:
        raise InputError("holds no lights, or not all at the same points", where=str(path), needed="a csv that lpcal field wrote")
    points_C = next(iter(tables.values()))[:, :3]
    return points_C, {light: (table[:, 3:6], table[:, 6]) for light, table in tables.items()}
