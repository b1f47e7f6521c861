"""What installed packages add to lpcal by entry points: formats of motion capture and of other systems, kinds of lobe; their versions."""

from __future__ import annotations

import re
from functools import cache
from importlib.metadata import distribution, entry_points

from lpcal.errors import InputError


@cache
def installed[T](group: str, kind: type[T], needed: str) -> tuple[T, ...]:
    """The objects of a kind that entry points of a group name, in the order of the packages; `needed` is the kind in words.

    Raises
    ------
    InputError
        One cannot be loaded, or is of another kind.
    """
    found = []
    for point in entry_points(group=group):
        where = f"entry point {point.name} of {point.dist.name if point.dist else 'a package'}"
        try:
            one = point.load()
        except Exception as error:
            raise InputError(f"cannot be loaded: {error}", where=where, needed=needed, todo="correct or uninstall it") from error
        if not isinstance(one, kind):
            raise InputError(f"is a {type(one).__name__}", where=where, needed=needed, todo="correct or uninstall it")
        found.append(one)
    return tuple(found)


def version_of(package: str) -> str:
    """The version of an installed package: `importlib.metadata.version` reads it with a parser of mail, which is longer to import."""
    stated = re.search(r"^Version: *(\S+)", distribution(package).read_text("METADATA") or "", re.MULTILINE)
    return stated[1] if stated else ""
