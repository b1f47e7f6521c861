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
from lpcal.formats.outputs import marked, whole
from lpcal.geometry.arrays import Array

COLUMNS = ("x_m", "y_m", "z_m")
HEADER = ("light", *COLUMNS, "dx", "dy", "dz", "irradiance")
FIELD = marked("a light field", ",".join(HEADER))


def read_points(path: Path) -> Array:
    """Points (N, 3) in metres.

    Raises
    ------
    InputError
        Not there, without the three columns, or a cell that is no number; with its line.
    """
    if not path.is_file():
        raise InputError("no such file", where=str(path), needed=f"a csv with columns {', '.join(COLUMNS)}")
    with path.open(encoding="utf-8-sig", newline="") as stream:
        reader = csv.DictReader(stream)
        lacking = [name for name in COLUMNS if name not in (reader.fieldnames or [])]
        if lacking:
            raise InputError(f"no column {', '.join(lacking)}", where=f"{path}:1", needed=f"columns {', '.join(COLUMNS)}")
        points = []
        for row in reader:
            try:
                points.append([float(row[name]) for name in COLUMNS])
            except (TypeError, ValueError) as error:
                raise InputError("a cell is no number", where=f"{path}:{reader.line_num}", needed="three numbers in metres") from error
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


def read_field(path: Path) -> tuple[Array, dict[str, tuple[Array, Array]]]:
    """The points (N, 3) of a FIELD.csv, and by light the unit vectors (N, 3) and irradiances (N,) there; every light at the same points.

    Raises
    ------
    InputError
        Not there, or lines that do not fit.
    """
    if not path.is_file():
        raise InputError("no such file", where=str(path), needed="a csv that lpcal field wrote")
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
