"""What a program or a package adds to lpcal: kinds of lobe, formats of motion capture, formats of other systems, methods.

`register_mocap` and `register_format` are names of lpcal itself; the records that they and your own code need stand here, as do lobes.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.exchange import ExchangeFormat
from lpcal.formats.mocap_added import MocapFormat, register
from lpcal.geometry.arrays import Array
from lpcal.geometry.light_field import TABLED
from lpcal.records import lobes
from lpcal.records.exchange import ExchangeContent
from lpcal.records.lobes import Lobe, LobeKind
from lpcal.records.observations import MarkerStream, PoseStream

__all__ = [
    "ExchangeContent",
    "ExchangeFormat",
    "Lobe",
    "LobeKind",
    "MarkerStream",
    "MocapFormat",
    "register_lobe",
    "register_mocap",
]

TRIED = 19
"""Angles from 0 to pi at which a formula is tried when it is added: one every ten degrees."""
ON_AXIS = 1e-6
"""Difference from 1 that a formula may have on the axis: rounding."""


def register_lobe(name: str, formula: Callable[[Array, float], Array]) -> LobeKind:
    r"""Add a kind of lobe of one parameter: files, light fields and the report of this process know it from then on.

    An installed package adds one for good, and for the command line too, by an entry point:

        [project.entry-points."lpcal.lobes"]
        ours = "our_package:LOBE"              # LOBE = lpcal.extend.register_lobe(...), or a LobeKind

    Parameters
    ----------
    name : str
        The word that stands as ``kind`` in a file; a kind of the same name is replaced.
    formula : callable
        ``formula(angle_rad, exponent)``: the intensity (...) relative to that on the axis at angles (...) from 0 to pi, for the file's
        ``exponent`` of 0 and more. It is 1 at the angle 0 and nowhere negative.

    Returns
    -------
    LobeKind
        The kind.

    Raises
    ------
    InputError
        A name that is empty or a table's, what cannot be called, or a formula that is not 1 on the axis, negative, or of another shape.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> kind = lpcal.extend.register_lobe("gaussian", lambda angle_rad, exponent: np.exp(-exponent * angle_rad**2))
    >>> float(lpcal.extend.Lobe("gaussian", exponent=3.0)(np.array([0.5]))[0].round(4))
    0.4724
    """
    where = f"register_lobe({name!r})"
    if not name or name in TABLED or not callable(formula):
        raise InputError(
            "is no kind of lobe", where=where, needed=f"a name other than {', '.join(TABLED)}, and formula(angle_rad, exponent)"
        )
    angle_rad = np.linspace(0.0, np.pi, TRIED)
    for exponent in (0.0, 1.0, 3.0):
        value = np.asarray(formula(angle_rad, exponent))
        if value.shape != angle_rad.shape or not np.isfinite(value).all() or np.any(value < 0) or abs(value[0] - 1) > ON_AXIS:
            found = f"gives {value.ravel()[:1]} on the axis, {value.shape} values for {angle_rad.shape} angles, at exponent {exponent:g}"
            raise InputError(
                found, where=where, needed="1 at the angle 0, a number of 0 or more at every other", todo="correct the formula"
            )
    kind = LobeKind(name, formula)
    lobes.register(kind)
    return kind


def register_mocap(
    name: str, recognise: Callable[[bytes], bool], read: Callable[[Path, str | None], PoseStream | MarkerStream]
) -> MocapFormat:
    r"""Add a motion-capture format: `read_mocap` and the commands of this process know it from then on, before their own.

    An installed package adds one for good, and for the command line too, by an entry point:

        [project.entry-points."lpcal.mocap"]
        ours = "our_package:FORMAT"            # FORMAT = lpcal.register_mocap(...), or a MocapFormat

    Parameters
    ----------
    name : str
        What it is called in messages; a format of the same name is replaced.
    recognise : callable
        ``recognise(head: bytes) -> bool``: whether a file that begins so (4096 bytes; b"" for a folder) is one.
    read : callable
        ``read(path: Path, body: str | None) -> PoseStream | MarkerStream``: H_OP (N, 4, 4) in metres at increasing times (N,) in seconds.
        What it raises is reported as an error of the file; what it returns is checked. `body` is None where none is asked for. Bare
        markers are a `MarkerStream` of `lpcal.extend`.

    Returns
    -------
    MocapFormat
        The format.

    Raises
    ------
    InputError
        A name that is empty, or what cannot be called.

    Examples
    --------
    >>> import lpcal, numpy as np, pathlib, tempfile
    >>> def read(path, body):
    ...     rows = np.loadtxt(path, skiprows=1)
    ...     H_OP = np.tile(np.eye(4), (len(rows), 1, 1))
    ...     H_OP[:, :3, 3] = rows[:, 1:] / 1000
    ...     return lpcal.PoseStream(body or "cart", rows[:, 0], H_OP, np.full(len(rows), np.nan))
    >>> _ = lpcal.register_mocap("our rail", lambda head: head.startswith(b"RAIL"), read)
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "run.txt"
    >>> _ = path.write_text("RAIL\n0.0 0 0 0\n0.1 5 0 0\n")
    >>> float(lpcal.read_mocap(path).H_OP[1, 0, 3])
    0.005
    """
    if not name or not callable(recognise) or not callable(read):
        raise InputError(
            "is no format", where=f"register_mocap({name!r})", needed="a name and two functions: recognise(head), read(path, body)"
        )
    added = MocapFormat(name, recognise, read)
    register(added)
    return added
