"""``mocap.images``: csv files of ``file,time_s``, image paths relative to the csv, times on the camera's clock."""

from __future__ import annotations

import csv
from pathlib import Path

from lpcal.errors import InputError
from lpcal.formats.number_table import read_text


def read_image_times(path: Path) -> list[tuple[Path, float]]:
    """Images and their times (s), as they stand.

    Raises
    ------
    InputError
        No columns file and time_s, a time that is no number, or an image that is not there.
    """
    reader = csv.DictReader(read_text(path).splitlines(), skipinitialspace=True)
    if not {"file", "time_s"} <= set(reader.fieldnames or ()):
        found = ",".join(reader.fieldnames or ()) or "nothing"
        raise InputError(f"columns {found}", where=f"{path}:1", needed="file,time_s", todo="name the columns so")
    rows = []
    for row in reader:
        where = f"{path}:{reader.line_num}"
        try:
            time = float(row["time_s"])
        except (TypeError, ValueError) as error:
            raise InputError(f"time_s {row['time_s']!r}", where=where, needed="seconds", todo="is the file cut off?") from error
        image = path.parent / row["file"].strip()
        if not image.is_file():
            raise InputError(f"no such image: {row['file']}", where=where, needed="a path relative to this csv", todo="correct it")
        rows.append((image, time))
    if not rows:
        raise InputError("no rows", where=str(path), needed="file,time_s and a row an image")
    return rows
