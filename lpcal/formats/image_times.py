"""``mocap.images``: csv files of ``file,time_s``, image paths relative to the csv, times on the camera's clock.

Further columns are left alone. ``time_ns``, ``time_us`` and ``time_ms`` say their unit; a ``time_s`` that would be the year 30,000 and
later is taken in the unit that makes it a time of our century. Dates and times of the day are read as well.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.named_files import did_you_mean, resolve_named
from lpcal.formats.number_table import COMMENTS, is_number, seconds
from lpcal.formats.reading import reader
from lpcal.formats.text import read_text, with_commas
from lpcal.formats.time_stamps import with_seconds

FILES = ("file", "image", "filename", "name")
TIMES = {
    "time_s": "s",
    "time": "s",
    "t": "s",
    "t_s": "s",
    "timestamp": "s",
    "time_ms": "ms",
    "time_us": "us",
    "time_ns": "ns",
    "timestamp_ns": "ns",
}
"""The names of the column of times, and the unit that each states."""
LAYOUT = "file,time_s and a row an image"


@reader(LAYOUT)
def read_image_times(path: Path) -> list[tuple[Path, float]]:
    """Images and their times (s), as they stand.

    Raises
    ------
    InputError
        No columns file and time_s, a time that is no finite number, or an image that is not there.
    DisagreementError
        One image stands twice.
    """
    lines = [
        (number, [cell.strip() for cell in line.split(",")])
        for number, line in enumerate(with_commas(read_text(path, LAYOUT), path).split("\n"), start=1)
        if line.strip(", \t") and not line.lstrip().startswith(COMMENTS)
    ]
    if not lines:
        raise InputError("no rows", where=str(path), needed=LAYOUT)
    names = [cell.lower().lstrip("#").strip() for cell in lines[0][1]]
    file = next((names.index(name) for name in FILES if name in names), None)
    time = next((names.index(name) for name in TIMES if name in names), None)
    if file is None or time is None:
        raise InputError(f"columns {','.join(names)}", where=f"{path}:{lines[0][0]}", needed="file,time_s", todo="name the columns so")
    found: dict[Path, int] = {}
    stamps: list[str] = []
    texts, _ = with_seconds([cells[time] if len(cells) > time else "" for _, cells in lines[1:]], 0)
    for (number, cells), stamp in zip(lines[1:], texts, strict=True):
        where = f"{path}:{number}"
        if len(cells) <= max(file, time) or not is_number(stamp) or not np.isfinite(float(stamp)):
            raise InputError(f"{names[time]} {stamp!r}", where=where, needed="seconds", todo="is the file cut off?")
        image = resolve_named(path.parent, cells[file])
        if image is None or not image.is_file():
            todo = did_you_mean(path.parent / cells[file], "correct it")
            raise InputError(f"no such image: {cells[file]}", where=where, needed="a path relative to this csv", todo=todo)
        if image in found:
            raise DisagreementError(
                f"{cells[file]} stands in line {found[image]} already", where=where, needed="each image once", todo="remove one of them"
            )
        found[image] = number
        stamps.append(stamp)
    if not found:
        raise InputError("no rows", where=str(path), needed=LAYOUT)
    return list(zip(found, seconds(stamps, TIMES[names[time]]).tolist(), strict=True))
