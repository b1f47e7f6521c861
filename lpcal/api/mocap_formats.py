"""Formats of motion-capture recordings that a program adds."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from lpcal.errors import InputError
from lpcal.formats.mocap_added import MocapFormat, register
from lpcal.records.observations import MarkerStream, PoseStream


def register_mocap(
    name: str, recognise: Callable[[bytes], bool], read: Callable[[Path, str | None], PoseStream | MarkerStream]
) -> MocapFormat:
    r"""Add a motion-capture format: `read_mocap` and the commands of this process know it from then on, before their own.

    An installed package adds one for good, and for the command line too, by an entry point::

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
        What it raises is reported as an error of the file; what it returns is checked. `body` is None where nobody asks for one. Bare
        markers are a `lpcal.records.observations.MarkerStream`.

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
