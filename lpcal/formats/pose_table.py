"""A table of poses as read from any file, made a `PoseStream`: lost rows out, in order of time, each time once, one direction.

The readers of all formats hand over what their file says; what had to be repaired is counted and said.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lpcal.errors import DegenerateError, InputError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.observations import PoseStream

METRES = {"m": 1.0, "cm": 1e-2, "mm": 1e-3}
QUATERNION_TOLERANCE = 0.02
"""How far from 1 the length of a quaternion may be."""
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
    R, whole = _rotations(table, path)
    seen = whole & np.isfinite(table.position).all(axis=1) & np.isfinite(table.t_s)
    lost = int(np.sum(np.isfinite(table.t_s) & ~seen))
    if not np.any(seen):
        raise DegenerateError(f"not one pose of {table.body or 'the body'}", where=str(path), needed="rows with position and rotation")
    keep, notes = in_order(table.t_s, seen)
    H = se3.transform(R[keep], METRES[table.units] * table.position[keep])
    return TimedPoses(table.t_s[keep], se3.inv(H) if inverse else H, keep, lost, (*table.notes, *notes))


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
