"""Vicon's CSV: Nexus trajectories (markers), Nexus segments and Tracker objects (poses).

A file holds sections, blank lines between: name of the section; rate in Hz; names of subjects and what they have, a name over its first
column; ``Frame, Sub Frame, RX, RY, RZ[, RW], TX, TY, TZ`` or ``..., X, Y, Z``; a row of units; numbers. RX, RY, RZ is a rotation vector,
RX, RY, RZ, RW a quaternion. There is no column of time: t = (frame - 1 + sub frame / sub frames) / rate. An empty cell is a loss.
Source: a real Nexus file; the layout of poses from several programs that read it.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.body_choice import choose_body
from lpcal.formats.marker_table import MarkerTable
from lpcal.formats.number_table import is_rate, read_numbers
from lpcal.formats.pose_table import PoseTable, unit_of
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

SECTIONS = ("Objects", "Segments", "Trajectories")
"""Those that are read, the first that is there."""
TITLES = {*SECTIONS, "Joints", "Model Outputs", "Devices", "Events", "Forces", "Gait Cycle Parameters"}
HEADER_ROWS = 5


@dataclass(frozen=True)
class _Section:
    rate: float
    columns: dict[str, list[int]]
    """Places of each name's columns."""
    axes: list[str]
    units: list[str]
    body: str
    """The lines of numbers."""
    first_line: int


def is_vicon(text: str) -> bool:
    """Whether a text starts as a section of Vicon's CSV does."""
    return _title(text.split("\n", 1)[0]) in TITLES


def read_vicon(text: str, path: Path, body: str | None, units: str | None = None) -> PoseTable | MarkerTable:
    """The poses of one body, or the tracks of all markers where the file has no poses.

    Raises
    ------
    InputError
        Not the layout, several bodies and none named, a row cut off.
    DisagreementError
        The named body is not in the file.
    """
    lines = text.splitlines(keepends=True)
    starts = {_title(line): k for k, line in enumerate(lines) if _title(line) in TITLES}
    name = next((name for name in SECTIONS if name in starts), None)
    if name is None:
        raise InputError(f"only {', '.join(starts)}", where=str(path), needed="Objects, Segments or Trajectories", todo="export them too")
    section = _section(lines, starts[name], path)
    if name == "Trajectories":
        return _markers(section, path, units)
    return _poses(section, body, path, units)


def _title(line: str) -> str:
    return line.lstrip("\ufeff").strip().strip(",").strip('"').strip()


def _section(lines: list[str], start: int, path: Path) -> _Section:
    rows = list(csv.reader(lines[start : start + HEADER_ROWS]))
    if len(rows) < HEADER_ROWS or not all(rows) or not is_rate(rows[1][0]) or rows[3][0].strip() != "Frame":
        raise InputError(
            "not the rows rate, names, Frame.., units", where=f"{path}:{start + 2}", needed="Vicon's CSV", todo="export the file again"
        )
    axes, units = [cell.strip().upper() for cell in rows[3]], [cell.strip().lower() for cell in rows[4]]
    columns: dict[str, list[int]] = {}
    current = ""
    for place in range(2, len(axes)):
        current = (rows[2][place].strip() if place < len(rows[2]) else "") or current
        if current and axes[place]:
            columns.setdefault(current, []).append(place)
    first = start + HEADER_ROWS
    end = next((k for k in range(first, len(lines)) if not lines[k].strip().strip(",")), len(lines))
    return _Section(float(rows[1][0]), columns, axes, units, "".join(lines[first:end]), first + 1)


def _numbers(section: _Section, places: list[int], path: Path) -> tuple[Array, Array]:
    """Times (N,) and the numbers (N, places)."""
    wanted = [0, 1, *places]
    numbers = read_numbers(section.body, section.first_line, path, delimiter=",", columns=wanted)
    sub = np.nan_to_num(numbers[:, 1])
    return (numbers[:, 0] - 1 + sub / (1 + sub.max(initial=0.0))) / section.rate, numbers[:, 2:]


def _unit(section: _Section, place: int, units: str | None, path: Path) -> str:
    stated = section.units[place] if place < len(section.units) else ""
    unit = units or unit_of(stated)
    if unit is None:
        raise InputError(
            f"{stated!r} as unit of length", where=f"{path}:{section.first_line - 1}", needed="m, cm or mm", todo="state mocap.units"
        )
    return unit


def _markers(section: _Section, path: Path, units: str | None) -> MarkerTable:
    own = {name: places for name, places in section.columns.items() if [section.axes[p] for p in places] == ["X", "Y", "Z"]}
    t_s, numbers = _numbers(section, [place for places in own.values() for place in places], path)
    if not own:
        raise InputError("no columns X, Y, Z", where=f"{path}:{section.first_line - 2}", needed="trajectories", todo="export them")
    tracks = {name: numbers[:, 3 * k : 3 * k + 3] for k, name in enumerate(own)}
    return MarkerTable(t_s, tracks, _unit(section, next(iter(own.values()))[0], units, path))


def _poses(section: _Section, body: str | None, path: Path, units: str | None) -> PoseTable:
    wanted = {"TX", "TY", "TZ", "RX", "RY", "RZ"}
    bodies = {_body_name(name): p for name, p in section.columns.items() if wanted <= {section.axes[k] for k in p}}
    if not bodies:
        raise InputError("no body with RX, RY, RZ, TX, TY, TZ", where=str(path), needed="segments or objects", todo="export global poses")
    name = choose_body(list(bodies), body, path, lambda name: name.split(":"))
    place = {section.axes[k]: k for k in bodies[name]}
    turn = ["RX", "RY", "RZ", *(["RW"] if "RW" in place else [])]
    t_s, numbers = _numbers(section, [place[axis] for axis in (*turn, "TX", "TY", "TZ")], path)
    rotation, position = numbers[:, : len(turn)], numbers[:, len(turn) :]
    unit = _unit(section, place["TX"], units, path)
    if len(turn) == 4:
        return PoseTable(name, t_s, position, None, rotation, unit, first_line=section.first_line)
    degrees = section.units[place["RX"]] if place["RX"] < len(section.units) else ""
    if degrees not in {"rad", "deg"}:
        raise InputError(
            f"{degrees!r} as unit of turn", where=f"{path}:{section.first_line - 1}", needed="rad or deg", todo="export it again"
        )
    vector = np.deg2rad(rotation) if degrees == "deg" else rotation
    R = np.full((len(vector), 3, 3), np.nan)
    seen = np.isfinite(vector).all(axis=1)
    R[seen] = se3.rotation(vector[seen])
    return PoseTable(name, t_s, position, R, None, unit, first_line=section.first_line)


def _body_name(label: str) -> str:
    """``Subject:Segment`` of ``Global Angle Subject:Segment``, ``Subject`` where both are called alike."""
    name = label.removeprefix("Global Angle ").strip()
    subject, _, segment = name.partition(":")
    return subject if not segment or subject == segment else name
