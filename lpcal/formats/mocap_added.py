"""Motion-capture formats that others add: registered by a program, or found as entry points of installed packages.

An entry point of the group ``lpcal.mocap`` names a `MocapFormat`. Formats that were added are asked before lpcal's own, the last added
first, so that a lab's own format is never taken for another one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from lpcal.errors import InputError
from lpcal.records.installed import installed
from lpcal.records.observations import MarkerStream, PoseStream

GROUP = "lpcal.mocap"
"""The entry points of installed packages among which formats are looked for."""


@dataclass(frozen=True)
class MocapFormat:
    """A format of motion-capture recordings.

    Parameters
    ----------
    name : str
        What it is called in messages.
    recognise : callable
        ``recognise(head: bytes) -> bool``: whether the first 4096 bytes of a file are those of one of its files; b"" for a folder.
    read : callable
        ``read(path: Path, body: str | None) -> PoseStream | MarkerStream``: the recorded body, or its markers; metres, seconds.

    Examples
    --------
    >>> import lpcal
    >>> def read(path, body):
    ...     raise ValueError("holds no poses yet")
    >>> lpcal.extend.MocapFormat("our lab's", lambda head: head.startswith(b"OURS"), read).recognise(b"OURS 1")
    True
    """

    name: str
    recognise: Callable[[bytes], bool]
    read: Callable[[Path, str | None], PoseStream | MarkerStream]


ADDED: dict[str, MocapFormat] = {}
"""Formats that this program has registered, by name."""


def register(added: MocapFormat) -> None:
    """Add a format, or another one under its name."""
    ADDED.pop(added.name, None)
    ADDED[added.name] = added


def added_formats() -> Iterator[MocapFormat]:
    """All formats that were added, the last one first.

    Raises
    ------
    InputError
        An installed package names what is no format.
    """
    yield from reversed(ADDED.values())
    yield from (one for one in of_packages() if one.name not in ADDED)


def of_packages() -> tuple[MocapFormat, ...]:
    """The formats of installed packages."""
    return installed(GROUP, MocapFormat, "a MocapFormat")


def format_of(head: bytes, path: Path) -> MocapFormat | None:
    """The added format that knows a file by its head; None where none does.

    Raises
    ------
    InputError
        A format fails at the head.
    """
    for one in added_formats():
        try:
            if one.recognise(head):
                return one
        except Exception as error:
            raise InputError(f"the format {one.name} fails at it: {error!r}", where=str(path), needed="recognise(head: bytes)") from error
    return None
