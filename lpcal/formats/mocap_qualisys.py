"""Qualisys Track Manager's TSV, 6D (bodies) and 3D (markers).

Rows ``KEY value`` first, then possibly a row of column names, then numbers; Frame and Time may be lacking. A body's block is
``X Y Z Roll Pitch Yaw Residual Rot[0]..Rot[8]`` with ``Rot`` the rotation by columns: R = [Rot[0] Rot[3] Rot[6]; ...]; the angles follow
whatever convention QTM was set to and are not used. Millimetres. A body or marker that was lost is empty, or all zeros.
Source: real files; Rot was checked against the angles of one.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.body_choice import choose_body
from lpcal.formats.marker_table import MarkerTable
from lpcal.formats.number_table import is_number, is_rate, read_numbers
from lpcal.formats.pose_table import PoseTable
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

BODY_COLUMNS = 16
HEADER_ROWS = 40
KEY = re.compile(r"[A-Z][A-Z_]+")
RIGID = 0.02
"""How far Rot may be from a rotation."""


@dataclass(frozen=True)
class _Header:
    keys: dict[str, list[str]]
    lead: int
    """Columns before the first block: Frame, Time."""
    timed: bool
    first_line: int
    turned: bool = True
    """Whether the row of labels, if there is one, has a rotation matrix."""


def is_qualisys(text: str) -> bool:
    """Whether a text starts as QTM's TSV does."""
    return text.startswith("NO_OF_FRAMES")


def read_qualisys(text: str, path: Path, body: str | None, units: str | None = None) -> PoseTable | MarkerTable:
    """The poses of one body, or the tracks of all markers.

    Raises
    ------
    InputError
        Not the layout, several bodies and none named, a row cut off.
    DisagreementError
        The named body is not in the file.
    """
    lines = text.splitlines()
    bodies = "BODY_NAMES" in "\n".join(lines[:30])
    names_key, width = ("BODY_NAMES", BODY_COLUMNS) if bodies else ("MARKER_NAMES", 3)
    header = _header(lines, names_key, width, path)
    names = header.keys[names_key]
    numbers = read_numbers("\n".join(lines[header.first_line - 1 :]) + "\n" * text.endswith("\n"), header.first_line, path, delimiter="\t")
    least = header.lead + width * len(names)
    if bodies and numbers.shape[1] < least and not header.turned:
        raise InputError(
            "rotations as Roll, Pitch and Yaw alone, whose axes and order each QTM sets for itself",
            where=f"{path}:{header.first_line - 1}",
            needed="the columns Rot[0] to Rot[8]",
            todo="export the 6D data anew with the rotation matrix",
        )
    if numbers.shape[1] < least:
        raise InputError(f"{numbers.shape[1]} columns", where=f"{path}:{header.first_line}", needed=f"{least}", todo="export it again")
    rate = float(header.keys["FREQUENCY"][0])
    t_s = numbers[:, header.lead - 1] if header.timed else np.arange(len(numbers)) / rate
    notes = _notes(header, len(numbers))
    blocks = numbers[:, header.lead : least].reshape(len(numbers), len(names), width)
    if not bodies:
        tracks = {name: _without_zeros(blocks[:, k]) for k, name in enumerate(names)}
        return MarkerTable(t_s, tracks, units or "mm", notes)
    place = names.index(choose_body(names, body, path))
    return _body(names[place], t_s, blocks[:, place], units or "mm", header.first_line, notes, path)


def _body(name: str, t_s: Array, block: Array, units: str, first_line: int, notes: tuple[str, ...], path: Path) -> PoseTable:
    R = np.swapaxes(block[:, 7:].reshape(-1, 3, 3), 1, 2).copy()
    seen = np.isfinite(block[:, :3]).all(axis=1) & np.isfinite(R).all(axis=(1, 2)) & (np.abs(R).sum(axis=(1, 2)) > 0)
    R[~seen] = np.nan
    off = np.abs(R[seen] @ np.swapaxes(R[seen], 1, 2) - np.eye(3)).max(axis=(1, 2), initial=0.0)
    wrong = np.flatnonzero(off > RIGID)
    if wrong.size:
        line = first_line + int(np.flatnonzero(seen)[wrong[0]])
        raise InputError(
            "Rot[0..8] is no rotation", where=f"{path}:{line}", needed="nine numbers of a rotation", todo="is the row cut off?"
        )
    R[seen] = se3.nearest_rotation(R[seen])
    return PoseTable(name, t_s, block[:, :3], R, None, units, error=block[:, 6], first_line=first_line, notes=notes)


def _header(lines: list[str], names_key: str, width: int, path: Path) -> _Header:
    rows = [[cell.strip() for cell in line.split("\t")] for line in lines[:HEADER_ROWS]]
    at = next((k for k, row in enumerate(rows) if not KEY.fullmatch(row[0])), len(rows))
    keys = {row[0]: [cell for cell in row[1:] if cell] for row in rows[:at]}
    lacking = [key for key in ("FREQUENCY", names_key) if not keys.get(key)]
    if lacking or not is_rate(keys["FREQUENCY"][0]):
        raise InputError(
            f"no {' and no '.join(lacking) or 'number for FREQUENCY'}", where=f"{path}:1", needed="QTM's header", todo="export it again"
        )
    cells = [cell.strip() for cell in (lines[at] if at < len(lines) else "").rstrip().split("\t")]
    labelled = not is_number(cells[0]) and bool(cells[0])
    if labelled:
        lead = [cell.lower() for cell in cells[:2] if cell.lower() in {"frame", "time"}]
        return _Header(keys, len(lead), "time" in lead, at + 2, any(cell.lower().startswith("rot[") for cell in cells))
    lead_columns = min(max(len(cells) - width * len(keys[names_key]), 0), 2)
    return _Header(keys, lead_columns, lead_columns == 2, at + 1)


def _without_zeros(track: Array) -> Array:
    return np.where(np.any(track != 0, axis=1)[:, None], track, np.nan)


def _notes(header: _Header, rows: int) -> tuple[str, ...]:
    stated = header.keys.get("NO_OF_FRAMES", [""])[0]
    return (f"the header says {stated} frames, {rows} are there",) if stated.isdigit() and int(stated) != rows else ()
