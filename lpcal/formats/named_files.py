"""Files as people name them in files: with slashes or backslashes, in any Unicode form, and of the kinds that are no pictures yet.

A name that is there as it is written is taken so, before anything else is made of it.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from functools import cache
from importlib.util import find_spec
from pathlib import Path, PureWindowsPath

VIDEOS = (".avi", ".mp4", ".mov", ".mkv", ".m4v", ".mpg", ".mpeg", ".webm", ".wmv")
RAWS = (
    ".cr2",
    ".cr3",
    ".nef",
    ".nrw",
    ".arw",
    ".srf",
    ".sr2",
    ".dng",
    ".raf",
    ".orf",
    ".rw2",
    ".pef",
    ".srw",
    ".x3f",
    ".3fr",
    ".iiq",
    ".raw",
)
PICTURES = (".png", ".tif", ".tiff", ".jpg", ".jpeg", ".bmp", ".pgm", ".ppm", ".webp")
"""What names of images end in that are read."""
OTHERS = (".heic", ".heif", ".gif", ".psd", ".exr", ".hdr", ".svg", ".pdf")


@cache
def raw_is_read() -> bool:
    """Whether cameras' raw files are read: rawpy is installed."""
    return find_spec("rawpy") is not None


def image_endings() -> tuple[str, ...]:
    """What names of images end in that are read here."""
    return PICTURES + (RAWS if raw_is_read() else ())


def exists(path: Path) -> bool:
    """Whether something is there; a name that no system takes is not there."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False


def spellings(name: str) -> list[str]:
    """A name as it is written, with its accents composed, and with them apart, as macOS writes them."""
    return list(dict.fromkeys((name, unicodedata.normalize("NFC", name), unicodedata.normalize("NFD", name))))


def resolve_named(folder: Path, name: str) -> Path | None:
    """The file or folder that a name in a file means, relative to a folder; None where it is not there."""
    for spelled in spellings(name):
        if exists(folder / spelled):
            return folder / spelled
    if "\\" in name:
        windows = PureWindowsPath(name)
        if exists(folder / windows.as_posix()):
            return folder / windows.as_posix()
    return None


def hidden(path: Path) -> bool:
    """Whether a file is one that the system hides: ``._x.png`` beside x.png, ``.DS_Store``."""
    return path.name.startswith(".")


def kind_of_other(paths: Iterable[Path]) -> str:
    """What files are that cannot be read as pictures, in words; empty where there is nothing to say of them."""
    endings = {path.suffix.lower() for path in paths}
    raws = () if raw_is_read() else RAWS
    for known, what in ((VIDEOS, "a video"), (raws, "a camera's raw file"), (OTHERS, "of a kind that is not read")):
        found = sorted(endings & set(known))
        if found:
            first = "install lpcal[raw], or " if known is raws else ""
            return f"{found[0]} is {what}: {first}turn it into PNG or TIFF first"
    return ""
