"""Arrays and records that others have made, checked before anything is made of them: programs and added formats hand them over."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.geometry.arrays import Array
from lpcal.records.observations import MarkerStream, PoseStream

RIGID = 0.02
"""How far the product of a rotation with its transpose may be from the identity: numbers of two digits are taken for a rotation."""


def transforms(values: npt.ArrayLike, name: str) -> Array:
    """Rigid transforms (N, 4, 4) of whatever a caller gives for them.

    Raises
    ------
    InputError
        Another shape, a number that is not finite, or a matrix that turns and shifts nothing rigid; its row is named.
    """
    found = numbers(values, name)
    if found.ndim != 3 or found.shape[1:] != (4, 4):
        raise InputError(f"an array of {shape_of(found)}", where=name, needed="transforms (N, 4, 4)")
    R = found[:, :3, :3]
    off = np.abs(R @ np.swapaxes(R, 1, 2) - np.eye(3)).max(axis=(1, 2), initial=0.0) > RIGID
    off |= (np.linalg.det(R) < 0) | (np.abs(found[:, 3] - [0, 0, 0, 1]) > RIGID).any(axis=1)
    if off.any():
        row = int(np.flatnonzero(off)[0])
        raise InputError("is no rigid transform", where=f"{name}[{row}]", needed="a rotation, a shift in metres, and 0 0 0 1 below")
    return found


def numbers(values: npt.ArrayLike, name: str, *, finite: bool = True) -> Array:
    """Numbers in double precision of whatever a caller gives for them.

    Raises
    ------
    InputError
        They are none, or one is not finite.
    """
    stored = array(values, name)
    if stored.dtype.kind == "c":
        raise InputError("holds complex numbers", where=name, needed="an array of real numbers")
    try:
        found = np.asarray(stored, dtype=float)
    except (TypeError, ValueError) as error:
        raise InputError(f"holds no numbers ({error})", where=name, needed="an array of numbers") from error
    if finite and not np.isfinite(found).all():
        raise InputError(f"{int((~np.isfinite(found)).sum())} numbers that are not finite", where=name, needed="finite numbers")
    return found


def array(values: npt.ArrayLike, name: str) -> npt.NDArray[Any]:
    """An array of whatever a caller gives for one.

    Raises
    ------
    InputError
        Its rows are not of one length.
    """
    try:
        return np.asarray(values)
    except ValueError as error:
        raise InputError("its rows or images are not of one shape", where=name, needed="an array of numbers") from error


def shaped(values: npt.ArrayLike, shape: tuple[int, ...], name: str) -> Array:
    """Numbers of one shape.

    Raises
    ------
    InputError
        They are none, or of another shape.
    """
    found = numbers(values, name)
    if found.shape != shape:
        raise InputError(f"an array of {shape_of(found)}", where=name, needed=shape_of(np.empty(shape)))
    return found


def times(values: npt.ArrayLike, count: int, name: str, of: str) -> Array:
    """Seconds (N,), as many as there are of something.

    Raises
    ------
    InputError, DisagreementError
        They are no numbers; there are more or fewer.
    """
    found = numbers(values, name)
    if found.shape != (count,):
        raise DisagreementError(f"an array of {shape_of(found)}", where=name, needed=f"({count},): one time for each of {of}")
    return found


def stream(given: PoseStream, name: str) -> PoseStream:
    """A recording that somebody else has made, where it is one; `name` is its place in messages.

    Raises
    ------
    InputError, DisagreementError
        A transform is not rigid, times do not increase, or there are more or fewer of them.
    DegenerateError
        It is empty.
    """
    poses = transforms(given.H_OP, f"{name}, H_OP")
    if not len(poses):
        raise DegenerateError("no pose", where=f"{name}, H_OP", needed="a recording of some seconds")
    t_s = _increasing(times(given.t_s, len(poses), f"{name}, t_s", "H_OP"), name)
    error_m = numbers(given.error_m, f"{name}, error_m", finite=False)
    if error_m.shape != t_s.shape:
        needed = f"({len(t_s)},): one marker error for each of H_OP, NaN where there is none"
        raise DisagreementError(f"an array of {shape_of(error_m)}", where=f"{name}, error_m", needed=needed)
    return replace(given, t_s=t_s, H_OP=poses, error_m=error_m, rate_hz=_rate_hz(given.rate_hz, t_s))


def markers(given: MarkerStream, name: str) -> MarkerStream:
    """Markers that somebody else has recorded, where they are some; `name` is their place in messages.

    Raises
    ------
    InputError, DisagreementError
        Places that are no numbers (N, M, 3), times that do not increase, or more or fewer times or names than places.
    DegenerateError
        They are empty.
    """
    x_O = numbers(given.x_O, f"{name}, x_O", finite=False)
    if x_O.ndim != 3 or x_O.shape[2] != 3:
        raise InputError(f"an array of {shape_of(x_O)}", where=f"{name}, x_O", needed="markers (N, M, 3) in metres")
    if len(given.names) != x_O.shape[1]:
        raise DisagreementError(f"{len(given.names)} names", where=f"{name}, names", needed=f"{x_O.shape[1]}: one for each marker of x_O")
    if not np.isfinite(x_O).any():
        raise DegenerateError("no marker", where=f"{name}, x_O", needed="a recording of some seconds")
    t_s = _increasing(times(given.t_s, len(x_O), f"{name}, t_s", "x_O"), name)
    return replace(given, t_s=t_s, x_O=x_O, rate_hz=_rate_hz(given.rate_hz, t_s))


def _increasing(t_s: Array, name: str) -> Array:
    if np.any(np.diff(t_s) <= 0):
        row = int(np.flatnonzero(np.diff(t_s) <= 0)[0]) + 1
        found = f"{t_s[row]:g} s after {t_s[row - 1]:g} s"
        raise InputError(found, where=f"{name}, t_s[{row}]", needed="times that increase", todo="sort the samples")
    return t_s


def _rate_hz(stated: float, t_s: Array) -> float:
    """Samples a second, from the times where it is not stated."""
    if not np.isnan(stated):
        return stated
    return 1 / float(np.median(np.diff(t_s))) if len(t_s) > 1 else float("nan")


def shape_of(values: npt.NDArray[Any]) -> str:
    """The shape of an array, for a message."""
    return f"({', '.join(map(str, values.shape))})"
