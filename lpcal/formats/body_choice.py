"""Which of a recording's bodies is meant: the one named, or the only one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from lpcal.errors import DisagreementError, InputError


def choose_body(
    names: Sequence[str], body: str | None, path: Path, parts: Callable[[str], Sequence[str]] = lambda name: name.split(":")
) -> str:
    """The name, as the file has it, of the body that is meant; capitals do not matter where no name is exactly so.

    Parameters
    ----------
    names : of the bodies in the file, one at least
    body : the one wanted; None: the only one
    path : of the file, for the message
    parts : names that a body may go by beside its whole name

    Raises
    ------
    InputError
        Several and none named.
    DisagreementError
        None, or several, of that name; those that are there are listed.
    """
    listed = ", ".join(names)
    if body is None:
        if len(names) > 1:
            raise InputError(f"{len(names)} bodies: {listed}", where=str(path), needed="one", todo="name it in panel.yaml: mocap.body")
        return names[0]
    whole = [name for name in names if name == body] or [name for name in names if name.lower() == body.lower()]
    found = whole or [name for name in names if body.lower() in {part.lower() for part in parts(name)}]
    if len(found) == 1 or whole:
        return found[0]
    raise DisagreementError(
        f"several bodies {body}" if found else f"no body {body}",
        where=str(path),
        needed=f"one of those it holds: {listed}",
        todo="correct mocap.body in panel.yaml",
    )
