"""A table of poses as read from any file, made a `PoseStream`: lost rows out, in order of time, each time once, one direction.

The readers of all formats hand over what their file says; what had to be repaired is counted and said.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lpcal.errors import DegenerateError, InputError
from lpcal.formats.number_table import UNITS_S, unit_of_stamps
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.observations import PoseStream

METRES = {"m": 1.0, "cm": 1e-2, "mm": 1e-3}
QUATERNION_TOLERANCE = 0.02
"""How far from 1 the length of a quaternion may be."""
FARTHEST_M = 1e5
"""Metres beyond which no position is believed: a hundred kilometres."""
LATEST_S = 1e10
"""Seconds beyond which no time is believed: three hundred years from whatever a clock counts from."""
EXACT = 1e-12
"""How far from the identity a rotation may be that was written as one."""
FROZEN_ROWS, FROZEN_S, JUMP_STEPS = 5, 0.1, 5.0
"""A pose held for so many rows and seconds, after which the body stands so many of its usual steps away, was held by the system."""
SUPERFLUOUS = 1e-6
"""Seconds within which two samples count as one."""


@dataclass(frozen=True)
class PoseTable:
    """Rows of a file. NaN where a cell is empty."""

    body: str
    t_s: Array
    """(N,)."""
    position: Array
    """(N, 3) in `units`."""
    R: Array | None = None
    """(N, 3, 3), or else `quaternion`."""
    quaternion_xyzw: Array | None = None
    """(N, 4)."""
    units: str = "m"
    error: Array | None = None
    """(N,) the system's mean marker error, in `units`."""
    markers: dict[str, Array] = field(default_factory=dict)
    """(N, 3) each, in `units`."""
    first_line: int = 1
    """The line of the file in which the first row stands."""
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class TimedPoses:
    """Poses in order of time, and the rows of the table that they come from."""

    t_s: Array
    H: Array
    """(N, 4, 4)."""
    rows: npt.NDArray[np.intp]
    lost: int
    notes: tuple[str, ...]


def timed_poses(table: PoseTable, path: Path, *, inverse: bool = False) -> TimedPoses:
    """The poses of a table, or their inverses.

    Raises
    ------
    InputError
        A quaternion that is none (its line is named).
    DegenerateError
        No row holds a pose.
    """
    _refuse_beyond(table, path)
    R, whole = _rotations(table, path)
    seen = whole & np.isfinite(table.position).all(axis=1) & np.isfinite(table.t_s)
    t_s, stamped = _seconds(table.t_s)
    seen, losses = without_losses(t_s, table.position, R, seen)
    lost = int(np.sum(np.isfinite(table.t_s) & ~seen))
    if not np.any(seen):
        found = f"not one pose of {table.body or 'the body'}"
        raise DegenerateError(f"{found}{': ' * bool(losses)}{', '.join(losses)}", where=str(path), needed="rows with position and rotation")
    keep, notes = in_order(t_s, seen)
    notes = [*stamped, *losses, *notes]
    H = se3.transform(R[keep], METRES[table.units] * table.position[keep])
    return TimedPoses(t_s[keep], se3.inv(H) if inverse else H, keep, lost, (*table.notes, *notes))


def _refuse_beyond(table: PoseTable, path: Path) -> None:
    """Refuse numbers that no recording holds; an empty cell is NaN and a loss."""
    turn = np.asarray(table.quaternion_xyzw) if table.R is None else table.R.reshape(len(table.R), 9)
    x = METRES[table.units] * table.position
    beyond = np.isinf(turn).any(axis=1) | (np.abs(_seconds(table.t_s)[0]) > LATEST_S) | (np.abs(x) > FARTHEST_M).any(axis=1)
    if beyond.any():
        row = int(np.flatnonzero(beyond)[0])
        found = f"t {table.t_s[row]:g} s, position {', '.join(f'{value:g}' for value in x[row])} m"
        where = f"{path}:{table.first_line + row}"
        raise InputError(
            found, where=where, needed="numbers that a recording can hold", todo="is it cut off, or in other units? mocap.units"
        )


def _seconds(t_s: Array) -> tuple[Array, list[str]]:
    """Times in seconds: stamps too large to be seconds are milli-, micro- or nanoseconds."""
    largest = float(np.nanmax(np.abs(t_s), initial=0.0))
    unit = unit_of_stamps(largest)
    return (t_s, []) if unit == "s" else (t_s * UNITS_S[unit], [f"times are {unit}"])


def without_losses(t_s: Array, position: Array, R: Array, seen: Mask) -> tuple[Mask, list[str]]:
    """The seen rows without those in which the system wrote a number for a loss, and in words what these were.

    A lost body may be written as zeros, as the identity, or as its last pose. A pose that repeats the one before to the last digit is a
    loss where the body was on its way before and has moved on at its end by far more than it moves between two rows; at rest a robot, or
    a file of few digits, repeats its pose by right.
    """
    nothing = seen & (position == 0).all(axis=1) & (np.abs(R - np.eye(3)).max(axis=(1, 2)) < EXACT)
    found = [f"{int(nothing.sum())} samples are zeros or the identity: lost"] * bool(nothing.any())
    seen = seen & ~nothing
    rows = np.flatnonzero(seen)
    if len(rows) < FROZEN_ROWS:
        return seen, found
    x, turn = position[rows], R[rows].reshape(-1, 9)
    step = np.linalg.norm(np.diff(x, axis=0), axis=1)
    repeats = (step == 0) & (np.diff(turn, axis=0) == 0).all(axis=1)
    if not repeats.any() or repeats.all():
        return seen, found
    usual = float(np.median(step[~repeats]))
    edges = np.flatnonzero(np.diff(np.concatenate([[False], repeats, [False]])))
    frozen = np.zeros(len(rows), dtype=bool)
    for start, end in zip(edges[::2], edges[1::2], strict=True):  # rows start .. end are equal
        if end - start + 1 < FROZEN_ROWS or t_s[rows[end]] - t_s[rows[start]] < FROZEN_S:
            continue
        jump, around = step[end] if end < len(step) else np.inf, step[max(start - 3, 0) : start]
        passed = (end - start) * float(around.min(initial=np.inf, where=around > 0)) if around.size else 0.0
        if jump > JUMP_STEPS * usual and 0 < passed < JUMP_STEPS * jump and (around > 0).all():
            frozen[start + 1 : end + 1] = True
    seen[rows[frozen]] = False
    return seen, [*found, *[f"{int(frozen.sum())} samples repeat the pose before them to the last digit: lost"] * bool(frozen.any())]


def in_order(t_s: Array, seen: Mask) -> tuple[npt.NDArray[np.intp], list[str]]:
    """The seen rows in order of time, each time once, and in words what that took."""
    order = np.flatnonzero(seen)[np.argsort(t_s[seen], kind="stable")]
    unsorted = int(np.sum(np.diff(t_s[seen]) < 0))
    repeated = np.concatenate([[False], np.diff(t_s[order]) < SUPERFLUOUS])
    notes = [f"{unsorted} rows stood out of order of time: sorted"] * bool(unsorted)
    notes += [f"{int(repeated.sum())} repeated times: the first of each kept"] * bool(repeated.any())
    return order[~repeated], notes


def stream_of(table: PoseTable, path: Path, direction: str = "H_OP") -> PoseStream:
    """The stream of a table whose poses are H_OP, or H_PO. Raises as `timed_poses`."""
    poses = timed_poses(table, path, inverse=direction == "H_PO")
    scale = METRES[table.units]
    return PoseStream(
        body=table.body,
        t_s=poses.t_s,
        H_OP=poses.H,
        error_m=np.full(len(poses.rows), np.nan) if table.error is None else scale * table.error[poses.rows],
        markers_O={name: scale * track[poses.rows] for name, track in table.markers.items()},
        lost=poses.lost,
        rate_hz=1 / float(np.median(np.diff(poses.t_s))) if len(poses.t_s) > 1 else float("nan"),
        notes=poses.notes,
    )


def _rotations(table: PoseTable, path: Path) -> tuple[Array, Mask]:
    """Rotations (N, 3, 3), and (N,) whether a row has one."""
    if table.R is not None:
        return table.R, np.isfinite(table.R).all(axis=(1, 2))
    q = np.asarray(table.quaternion_xyzw, dtype=float)
    length = np.linalg.norm(q, axis=1)
    whole = np.isfinite(q).all(axis=1) & (length > 0)
    wrong = np.flatnonzero(whole & (np.abs(length - 1) > QUATERNION_TOLERANCE))
    if wrong.size:
        raise InputError(
            f"a quaternion of length {length[wrong[0]]:.3g}",
            where=f"{path}:{table.first_line + wrong[0]}",
            needed="length 1",
            todo="are the columns t, x, y, z, qx, qy, qz, qw?",
        )
    R = np.full((len(q), 3, 3), np.nan)
    R[whole] = se3.rotation_from_quaternion(q[whole])
    return R, whole
