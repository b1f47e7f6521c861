"""Motive CSV (OptiTrack), format versions 1.2 to 1.25: quaternion or Euler angles, any of its units, gaps, marker tracks.

Line 1 holds key,value pairs. Above the row that starts with ``Frame`` stand rows of labels, a cell a column: type, name, ID, possibly
parent, and category (Rotation, Position, Mean Marker Error). Up to 1.23 their first two cells are blank, from 1.24 the second says
which row it is; a column TimeCode may follow the time. Quaternions are x, y, z, w; Euler angles are degrees about moving axes in the
order that Rotation Type names: R = R_x R_y R_z for XYZ. The clock is the column Time, from the take's start.
Source: real files of versions 1.21 to 1.24.

Motive's CSV export, version 1.23, written: one rigid body with its markers. For simulated recordings.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.body_choice import choose_body
from lpcal.formats.marker_table import MarkerTable
from lpcal.formats.number_table import read_numbers
from lpcal.formats.outputs import whole
from lpcal.formats.pose_table import PoseTable, unit_of
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

BODY_TYPES = ("rigid body", "bone")
ERRORS = ("mean marker error", "error per marker")
HEADER_ROWS = 30


@dataclass(frozen=True)
class _Column:
    """One column's labels."""

    place: int
    kind: str
    name: str
    category: str
    axis: str


@dataclass(frozen=True)
class _Header:
    keys: dict[str, str]
    columns: list[_Column]
    time: int
    first_line: int
    """Line of the first row of numbers."""


def is_motive(text: str) -> bool:
    """Whether a text starts as Motive's CSV does."""
    return text.lstrip('"').startswith("Format Version")


def read_motive(
    text: str, path: Path, body: str | None, quaternion: str | None = None, units: str | None = None
) -> PoseTable | MarkerTable:
    """The poses of one body, or the tracks of all markers where the file has no body.

    Raises
    ------
    InputError
        Not the layout, no rigid body, or several and none named; units that nothing states; a row cut off.
    DisagreementError
        The named body is not in the file; those that are there are listed.
    """
    header = _header(text, path)
    bodies = list(dict.fromkeys(c.name for c in header.columns if c.kind in BODY_TYPES and c.category == "rotation"))
    if not bodies:
        return _marker_table(text, header, units, path)
    name = choose_body(bodies, body, path)
    of_body = [column for column in header.columns if column.name == name and column.kind in BODY_TYPES]
    axes = [c.axis for c in of_body if c.category == "position"]
    if sorted(axes) != list("XYZ"):
        found = f"position columns {', '.join(axes) or 'none'} of {name}"
        raise InputError(found, where=f"{path}:{header.first_line - 1}", needed="X, Y, Z", todo="export the take again")
    rotation = [column for column in of_body if column.category == "rotation"]
    position = sorted((column for column in of_body if column.category == "position"), key=lambda column: column.axis)
    error = [column for column in of_body if column.category in ERRORS]
    markers = _markers(header, name)
    if len(position) != 3 or len(rotation) not in {3, 4}:
        found = f"{len(rotation)} rotation and {len(position)} position columns of {name}"
        raise InputError(found, where=f"{path}:{header.first_line - 1}", needed="3 or 4, and 3", todo="export it with rotations")
    wanted = [header.time, *(c.place for c in (*rotation, *position, *error[:1])), *(c.place for track in markers.values() for c in track)]
    numbers = iter(_numbers(text, header, wanted, path).T)

    def take(count: int) -> Array:
        return np.stack([next(numbers) for _ in range(count)], axis=1)

    t_s = next(numbers)
    R, q, notes = _rotation(take(len(rotation)), rotation, header, quaternion, path)
    unit, unit_notes = _units(header, units, path)
    return PoseTable(
        name,
        t_s,
        take(3),
        R,
        q,
        unit,
        error=next(numbers) if error else None,
        markers={marker: take(3) for marker in markers},
        first_line=header.first_line,
        notes=(*notes, *unit_notes),
    )


def _header(text: str, path: Path) -> _Header:
    rows = list(csv.reader(text.splitlines()[:HEADER_ROWS]))
    at = next((i for i, row in enumerate(rows) if row and row[0].strip() == "Frame"), None)
    if at is None:
        raise InputError(
            "no row that starts with Frame", where=f"{path}:1", needed="Motive's CSV with its header", todo="export it again, header on"
        )
    labels = [row for row in rows[1:at] if any(cell.strip() for cell in row)]
    if len(labels) < 3:
        raise InputError(
            f"{len(labels)} rows of labels above Frame", where=f"{path}:{at + 1}", needed="type, name, ID, category", todo="export it again"
        )
    named = {row[1].strip().lower(): row for row in labels if len(row) > 1 and row[1].strip()}
    kinds, names, categories = named.get("type", labels[0]), named.get("name", labels[1]), labels[-1]
    axes = rows[at]
    time = next((i for i, cell in enumerate(axes) if cell.strip().lower().startswith("time") and cell.strip().lower() != "timecode"), None)
    if time is None:
        raise InputError("no column Time", where=f"{path}:{at + 1}", needed="Time (Seconds)", todo="export it again")

    def cell(row: list[str], place: int) -> str:
        return row[place].strip() if place < len(row) else ""

    columns = [
        _Column(i, cell(kinds, i).lower(), cell(names, i), cell(categories, i).lower(), cell(axes, i).upper())
        for i in range(2, len(axes))
        if cell(kinds, i) and cell(kinds, i).lower() != "type"
    ]
    first = rows[0]
    keys = {key.strip().lower(): value.strip() for key, value in zip(first[::2], first[1::2], strict=False)}
    return _Header(keys, columns, time, at + 2)


def _numbers(text: str, header: _Header, places: list[int], path: Path) -> Array:
    lines = text.splitlines(keepends=True)[header.first_line - 1 :]
    return read_numbers("".join(lines), header.first_line, path, delimiter=",", columns=places)


def _marker_table(text: str, header: _Header, units: str | None, path: Path) -> MarkerTable:
    """The tracks of a file without a body."""
    tracks: dict[str, list[_Column]] = {}
    for column in header.columns:
        if "marker" in column.kind and column.category == "position":
            tracks.setdefault(column.name, []).append(column)
    whole = {name: sorted(track, key=lambda column: column.axis) for name, track in tracks.items() if len(track) == 3}
    if not whole:
        kinds = ", ".join(sorted({c.kind for c in header.columns})) or "nothing"
        raise InputError(
            f"no rigid body and no markers, only {kinds}",
            where=str(path),
            needed="a Rigid Body",
            todo="export the take with Rigid Bodies ticked",
        )
    numbers = _numbers(text, header, [header.time, *(c.place for track in whole.values() for c in track)], path)
    unit, notes = _units(header, units, path)
    return MarkerTable(numbers[:, 0], {name: numbers[:, 3 * k + 1 : 3 * k + 4] for k, name in enumerate(whole)}, unit, tuple(notes))


def _markers(header: _Header, body: str) -> dict[str, list[_Column]]:
    """Position columns x, y, z of each of a body's markers, by the name without the body's; what the body's solve gives comes first."""
    for kind in ("rigid body marker", "bone marker", "marker"):
        tracks: dict[str, list[_Column]] = {}
        for column in header.columns:
            if column.kind == kind and column.category == "position" and column.name.startswith((f"{body}:", f"{body}_")):
                tracks.setdefault(column.name.removeprefix(f"{body}:"), []).append(column)
        whole = {name: sorted(track, key=lambda column: column.axis) for name, track in tracks.items() if len(track) == 3}
        if whole:
            return whole
    return {}


def _rotation(
    values: Array, columns: list[_Column], header: _Header, quaternion: str | None, path: Path
) -> tuple[Array | None, Array | None, list[str]]:
    """Rotations (N, 3, 3) of Euler angles, or quaternions (N, 4) as x, y, z, w."""
    if len(columns) == 4:
        if quaternion == "wxyz":
            return None, values[:, [1, 2, 3, 0]], ["quaternion read as w, x, y, z, as panel.yaml says, against the file's labels"]
        axes = [column.axis for column in columns]
        if sorted(axes) != list("WXYZ"):
            found = f"rotation columns {', '.join(axes)}"
            raise InputError(found, where=f"{path}:{header.first_line - 1}", needed="X, Y, Z, W", todo="export the take again")
        return None, values[:, [axes.index(axis) for axis in "XYZW"]], []
    order = header.keys.get("rotation type", "").upper()
    notes = [] if sorted(order) == list("XYZ") else ["the file does not say the order of its Euler angles: XYZ taken"]
    order = "XYZ" if notes else order
    angle = {column.axis: np.deg2rad(values[:, place]) for place, column in enumerate(columns)}
    first, second, third = (se3.rotation(np.eye(3)["XYZ".index(axis)] * angle[axis][:, None]) for axis in order)
    return first @ second @ third, None, notes


def _units(header: _Header, units: str | None, path: Path) -> tuple[str, list[str]]:
    said = header.keys.get("length units", "")
    stated = unit_of(said)
    if units is None and stated is None:
        found = f"Length Units {said[:40]!r}" if said else "the header does not say the unit of length"
        raise InputError(found, where=f"{path}:1", needed="Length Units: Meters, for example", todo="state mocap.units in panel.yaml")
    notes = [f"lengths read as {units}, as panel.yaml says, against the header's {stated}"] if units and stated not in {None, units} else []
    return units or str(stated), notes


TAKE = "2026-01-05 10.00.00.000 AM"


def write_motive(path: Path, body: str, t_s: Array, H_OP: Array, error_m: Array, markers_O: dict[str, Array], rate_hz: float) -> None:
    """Write poses H_OP (N, 4, 4) at t_s (N,), the mean marker error (N,) and the markers (N, 3) by name; NaN rows become empty cells."""
    head = {
        "Format Version": "1.23",
        "Take Name": "Take 2026-01-05 10.00.00 AM",
        "Take Notes": "",
        "Capture Frame Rate": f"{rate_hz:.6f}",
        "Export Frame Rate": f"{rate_hz:.6f}",
        "Capture Start Time": TAKE,
        "Capture Start Frame": "0",
        "Total Frames in Take": str(len(t_s)),
        "Total Exported Frames": str(len(t_s)),
        "Rotation Type": "Quaternion",
        "Length Units": "Meters",
        "Coordinate Space": "Global",
    }
    names = list(markers_O)
    kinds = ["Rigid Body"] * 8 + ["Rigid Body Marker"] * 4 * len(names)
    bodies = [body] * 8 + [f"{body}:{name}" for name in names for _ in range(4)]
    identities = [f'"{1:032X}"'] * 8 + [f'"{k + 2:032X}"' for k in range(len(names)) for _ in range(4)]
    quantities = ["Rotation"] * 4 + ["Position"] * 3 + ["Mean Marker Error"] + (["Position"] * 3 + ["Marker Quality"]) * len(names)
    axes = ["X", "Y", "Z", "W", "X", "Y", "Z", ""] + ["X", "Y", "Z", ""] * len(names)
    lines = [",".join(f"{key},{value}" for key, value in head.items()), ""]
    lines += [",".join(["", "", *row]) for row in (kinds, bodies, identities, quantities)]
    lines.append(",".join(["Frame", "Time (Seconds)", *axes]))
    seen = np.isfinite(error_m)
    quaternion = np.full((len(t_s), 4), np.nan)
    quaternion[seen] = se3.quaternion(H_OP[seen, :3, :3])
    quality = np.clip(1 - 40 * error_m, 0.1, 0.999)
    table = np.column_stack([quaternion, H_OP[:, :3, 3], error_m, *(column for m in markers_O.values() for column in (m, quality))])
    cells = ["%.6f"] * 8 + ["%.6f", "%.6f", "%.6f", "%.3f"] * len(names)
    form, empty = ",".join(cells), "," * (len(cells) - 1)
    for frame, (time, row) in enumerate(zip(t_s, table, strict=True)):
        lines.append(f"{frame},{time:.6f}," + (form % tuple(row) if seen[frame] else empty))
    with whole(path) as draft:
        draft.write_text("\r\n".join(lines) + "\r\n", encoding="utf-8", newline="")
