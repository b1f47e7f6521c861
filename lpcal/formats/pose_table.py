"""A table of poses as read from any file, made a `PoseStream`: lost rows out, in order of time, each time once, one direction.

The readers of all formats hand over what their file says; what had to be repaired is counted and said.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.formats.number_table import UNITS_S, unit_of_stamps
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.observations import PoseStream

METRES = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "in": 0.0254, "ft": 0.3048}
SPELLED = {
    "metre": "m",
    "meter": "m",
    "centimetre": "cm",
    "centimeter": "cm",
    "millimetre": "mm",
    "millimeter": "mm",
    "inch": "in",
    "inches": "in",
    "foot": "ft",
    "feet": "ft",
}
"""Units of length as systems spell them out, in lower case; unit_of takes off a plural's s."""
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
DAY_S = 86400.0
SLOW_S, SLOW_ROWS, EVEN = 2.0, 200, 0.2
"""A recording of so many rows that are evenly spaced, within this share, by so many seconds and more has its times in a finer unit."""
TWO_STEPS, TWO_M, TWO_SHARE = 10.0, 0.005, 0.1
"""Two poses of one time, or neighbours in time, that are so many usual steps and metres apart, are of two bodies or recordings; of the
repeated times it takes this share of all rows, for one stray row is no recording."""

STEPS_M = (0.1, 0.05, 0.02, 0.01, 0.005)
"""Steps of positions, metres, that are looked for: rounded to the last of them, each coordinate errs by 1.4 mm, as rms."""
STEPS_DEG, STEPS_RAD, STEPS_QUATERNION = (10.0, 5.0, 1.0, 0.5), (0.1, 0.05, 0.01), 0.01
"""Steps of angles and of a quaternion's numbers that are looked for: rounded so, rotations err by an eighth of a degree or more, as rms."""
FEWEST_ROUNDED, FEWEST_UNLIKE, MOST_ROUNDED = 5, 8, 200
"""Poses, and numbers that differ among theirs, from which their all being round is no chance; and poses that are asked, spread over all."""
ON_STEP = 1e-5
"""How far, in steps, a number may be from a whole number of them."""


def unit_of(text: str) -> str | None:
    """The unit of METRES that a file names: mm, Millimeters, inch, Feet; None for another."""
    name = text.strip().lower()
    return name if name in METRES else SPELLED.get(name) or SPELLED.get(name.removesuffix("s"))


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
    DisagreementError
        Times that are not in seconds, or the poses of two recordings or bodies in one.
    """
    _refuse_beyond(table, path)
    R, whole = _rotations(table, path)
    seen = whole & np.isfinite(table.position).all(axis=1) & np.isfinite(table.t_s)
    t_s, stamped = _seconds(table.t_s)
    t_s, past = _past_midnight(t_s)
    seen, losses = without_losses(t_s, table.position, R, seen)
    lost = int(np.sum(np.isfinite(table.t_s) & ~seen))
    if not np.any(seen):
        found = f"not one pose of {table.body or 'the body'}"
        raise DegenerateError(f"{found}{': ' * bool(losses)}{', '.join(losses)}", where=str(path), needed="rows with position and rotation")
    keep, notes = in_order(t_s, seen)
    _refuse_slow(t_s[keep], path)
    _refuse_two(t_s, METRES[table.units] * table.position, seen, keep, path)
    notes = [*stamped, *past, *losses, *notes]
    H = se3.transform(R[keep], METRES[table.units] * table.position[keep])
    notes += rounded_notes(H)
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


def _past_midnight(t_s: Array) -> tuple[Array, list[str]]:
    """Times of the day that begin anew once, as times that go on."""
    given = np.flatnonzero(np.isfinite(t_s))
    falls = np.flatnonzero(np.diff(t_s[given]) < -DAY_S / 2)
    if len(falls) != 1 or t_s[given].min() < 0 or t_s[given].max() > DAY_S:
        return t_s, []
    later = np.arange(len(t_s)) > given[falls[0]]
    return np.where(later, t_s + DAY_S, t_s), ["times pass midnight"]


def _refuse_slow(t_s: Array, path: Path) -> None:
    """Stop where a recording's rows are so far apart, and so evenly, that their times cannot be seconds."""
    steps = np.diff(t_s)
    usual = float(np.median(steps)) if len(t_s) >= SLOW_ROWS else 0.0
    if usual < SLOW_S or np.mean(np.abs(steps / usual - 1) < EVEN) < 1 - EVEN / 2:
        return
    unit = next(name for name, size in (("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9)) if usual * size < 1.0)
    raise DisagreementError(
        f"{len(t_s)} poses, one every {usual:.4g} s: the times look like {unit} ({1 / (usual * UNITS_S[unit]):.4g} Hz)",
        where=str(path),
        needed="times in seconds, or a column that names its unit",
        todo=f"name the column t_{unit}",
    )


def _refuse_two(t_s: Array, x_m: Array, seen: Mask, keep: npt.NDArray[np.intp], path: Path) -> None:
    """Stop where the rows are of two bodies, or of two recordings whose times overlap: in order of time the poses leap to and fro."""
    rows = np.flatnonzero(seen)
    order = rows[np.argsort(t_s[rows], kind="stable")]
    if len(keep) < 3 or (len(order) == len(keep) and np.array_equal(rows, order)):
        return
    apart = np.linalg.norm(np.diff(x_m[order], axis=0), axis=1)
    same = np.diff(t_s[order]) < SUPERFLUOUS
    if np.array_equal(rows, order) and same.sum() > len(order) / 2:
        _refuse_coarse(t_s[keep], x_m[keep], apart[same], len(order), path)
    of_time, of_file = (np.linalg.norm(np.diff(x_m[some], axis=0), axis=1) for some in (keep, rows))
    twice = float(np.median(apart[same])) if same.sum() > TWO_SHARE * len(order) else 0.0
    pairs = ((twice, float(np.median(of_time))), (float(np.median(of_time)), float(np.median(of_file))))
    leaps = max((leap for leap, usual in pairs if leap > max(TWO_M, TWO_STEPS * usual)), default=0.0)
    if leaps == 0:
        return
    raise DisagreementError(
        f"the poses of one time are {1e3 * leaps:.0f} mm apart: two recordings, or two bodies, in one file",
        where=str(path),
        needed="one body's recording, its times in one row",
        todo="keep one of them, or add a column that names the body",
    )


def _refuse_coarse(t_s: Array, x_m: Array, within_m: Array, count: int, path: Path) -> None:
    """Stop where many poses bear one time, rounded so far that the body goes on its way between two times."""
    leap = float(np.median(np.linalg.norm(np.diff(x_m, axis=0), axis=1)))
    if leap <= max(TWO_M, TWO_STEPS * float(np.median(within_m))):
        return
    step = float(np.median(np.diff(t_s)))
    raise DisagreementError(
        f"{count} poses at {len(t_s)} times, {step:.4g} s from one to the next, between which the body moves by {1e3 * leap:.0f} mm: "
        "the times are rounded",
        where=str(path),
        needed="a time of its own for each pose",
        todo="export the times with more digits, or write the frame's number over the rate",
    )


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


def rounded_notes(H: Array) -> list[str]:
    """Notes on poses (N, 4, 4), as a file holds them, whose numbers were rounded too far to calibrate by."""
    if len(H) < FEWEST_ROUNDED:
        return []
    some = H[:: max(1, len(H) // MOST_ROUNDED)]
    step_m, R = _step_of(some[:, :3, 3], STEPS_M), some[:, :3, :3]
    zyz = np.stack([np.arctan2(R[:, 1, 2], R[:, 0, 2]), np.arccos(np.clip(R[:, 2, 2], -1, 1)), np.arctan2(R[:, 2, 1], -R[:, 2, 0])], axis=1)
    turns = (se3.angles_about_zyx(R), se3.angles_about_zyx(np.swapaxes(R, 1, 2)), zyz, se3.rotation_vector(R))
    step_deg = max(_step_of(np.rad2deg(angles), STEPS_DEG) for angles in turns)
    step_rad = max(_step_of(angles, STEPS_RAD) for angles in turns)
    found = [("positions are multiples of {} mm", 1e3 * step_m, 1e3 * step_m, "mm")] if step_m else []
    if step_deg:
        found.append(("angles are multiples of {} deg", step_deg, step_deg, "deg"))
    elif step_rad:
        found.append(("angles are multiples of {} rad", step_rad, np.rad2deg(step_rad), "deg"))
    elif _of_two_digits(R):
        off_deg = np.rad2deg(2 * STEPS_QUATERNION)  # a rotation's angle is twice that whose sine the quaternion holds
        found.append(("numbers of quaternions are multiples of {}", STEPS_QUATERNION, off_deg, "deg"))
    return [
        f"all {what.format(f'{step:g}')}: if they were rounded to that, each pose is off by {off / np.sqrt(12):.2g} {unit} an axis (rms); "
        "write all digits, unless the body was sent to just these places"
        for what, step, off, unit in found
    ]


def _step_of(values: Array, steps: tuple[float, ...]) -> float:
    """The largest of some steps that all values are whole multiples of, where that is no chance; else 0."""
    for step in steps:
        whole = np.rint(values / step)
        if np.abs(values / step - whole).max() < ON_STEP:
            return step if len(np.unique(whole)) >= FEWEST_UNLIKE else 0.0
    return 0.0


def _of_two_digits(R: Array) -> bool:
    """Whether all rotations (N, 3, 3) are those of quaternions written with two digits, of whatever length these had."""
    square = np.arange(*(int(((1 + off * QUATERNION_TOLERANCE) / STEPS_QUATERNION) ** 2) for off in (-1, 1)))
    numbers = se3.quaternion(R)[:, None, :] * np.sqrt(square)[:, None]
    whole = np.rint(numbers)
    round_ones = np.abs(numbers - whole).max(axis=2) < ON_STEP
    return bool(round_ones.any(axis=1).all() and len(np.unique(np.round(numbers[:, 0], 3))) >= FEWEST_UNLIKE)
