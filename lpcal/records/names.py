"""Names of lights, spheres and objects, which become names of files and folders."""

from __future__ import annotations

import unicodedata

MOST_NAME_BYTES = 200
"""Bytes of a name: a file system takes 255, and an ending and what comes before it must fit too."""
RESERVED = ("mask", "ambient", "capture")
"""Names of files in a capture folder that are no light's."""


def reserved(name: str) -> bool:
    """Whether a file of this name in a capture folder is no light's image."""
    return name.lower() in RESERVED or name.lower().startswith(("short_", "ambient_"))


def plain_name(name: str, what: str) -> str:
    """The name of a light, sphere or object, which becomes that of a file or folder.

    Raises
    ------
    ValueError
        It is empty, too long, leads elsewhere, or holds what no file's name can; the message says what was found; what was needed.
    """
    wrong = (
        "is empty"
        if not name.strip()
        else "begins or ends with a blank"
        if name != name.strip()
        else "leads elsewhere"
        if set(name) & set("/\\") or name in {".", ".."} or ".." in name or name[1:2] == ":"
        else "is hidden"
        if name.startswith(".")
        else "holds a control character"
        if not name.isprintable()
        else f"is {len(name.encode(errors='replace'))} bytes long"
        if len(name.encode(errors="replace")) > MOST_NAME_BYTES
        else ""
    )
    if wrong:
        shown = name if len(name) < 40 else f"{name[:36]}..."
        msg = f"the name {shown!r} of {what} {wrong}; a plain name of at most {MOST_NAME_BYTES} bytes, without / \\ and .."
        raise ValueError(msg)
    return name


def plain_names[Value](named: dict[str, Value], what: str) -> dict[str, Value]:
    """A section whose keys are names of files or folders, no two alike but for capitals or accents' form.

    Raises
    ------
    ValueError
        As `plain_name`; or two names that some systems take for one.
    """
    known: dict[str, str] = {}
    for name in named:
        key = unicodedata.normalize("NFC", plain_name(name, what)).casefold()
        if key in known:
            msg = f"the names {known[key]!r} and {name!r} of {what}s are one on some systems; names that differ by more than capitals"
            raise ValueError(msg)
        known[key] = name
    return named
