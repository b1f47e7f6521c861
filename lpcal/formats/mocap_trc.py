"""TRC: markers as OpenSim and Cortex write them, tabs between.

Five rows of head: ``PathFileType``; names (DataRate, NumMarkers, Units, ...) and their values; ``Frame#, Time`` and each marker's name over
its first column; X1, Y1, Z1, X2, ... Then numbers; a marker that was not seen is empty.
Source: OpenSim's documentation, "Marker (.trc) files".
"""

from __future__ import annotations

from pathlib import Path

from lpcal.errors import InputError
from lpcal.formats.marker_table import MarkerTable
from lpcal.formats.number_table import read_numbers
from lpcal.formats.pose_table import METRES

HEAD = 5
"""Rows before the first numbers."""


def is_trc(text: str) -> bool:
    """Whether a text starts as a .trc does."""
    return text.startswith("PathFileType")


def read_trc(text: str, path: Path, units: str | None = None) -> MarkerTable:
    """The tracks of all markers.

    Raises
    ------
    InputError
        Not the layout, a unit that nothing states, or a row that cannot be read.
    """
    lines = text.split("\n")
    if len(lines) <= HEAD:
        raise InputError("no rows of numbers", where=str(path), needed="a whole .trc", todo="export it again")
    stated = dict(zip(lines[1].split("\t"), lines[2].split("\t"), strict=False))
    unit = units or stated.get("Units", "").strip().lower()
    if unit not in METRES:
        raise InputError(f"{unit!r} as unit of length", where=f"{path}:3", needed="m, cm or mm", todo="state mocap.units in panel.yaml")
    names = [cell.strip() for cell in lines[3].rstrip("\t").split("\t")]
    places = {name: place for place, name in enumerate(names) if place > 1 and name}
    if names[:2] != ["Frame#", "Time"] or not places:
        raise InputError("no row Frame#, Time and markers", where=f"{path}:4", needed="a whole .trc", todo="export it again")
    columns = [1, *(place + axis for place in places.values() for axis in range(3))]
    numbers = read_numbers("\n".join(lines[HEAD:]), HEAD + 1, path, delimiter="\t", columns=columns)
    return MarkerTable(numbers[:, 0], {name: numbers[:, 3 * k + 1 : 3 * k + 4] for k, name in enumerate(places)}, unit)
