"""Files as people name them in files: with slashes or backslashes, in any Unicode form, and of the kinds that are no pictures yet.

A name that is there as it is written is taken so, before anything else is made of it.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from difflib import get_close_matches
from functools import cache
from importlib.util import find_spec
from itertools import islice
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
RESERVED = {"mask", "ambient", "short", "dark", "gt"}
"""Words of a name, apart by _ - or blanks, that say that an image is no light's: `photometric_sample_mask_raw`, `Normal_gt`."""
OTHERS = (".heic", ".heif", ".gif", ".psd", ".exr", ".hdr", ".svg", ".pdf")
RELIGHTABLE = (".ptm", ".rti")
"""What names of relightable images end in: polynomials or harmonics that were fitted to photographs."""
INTO_PICTURES = "turn it into PNG or TIFF first"


@cache
def raw_is_read() -> bool:
    """Whether cameras' raw files are read: rawpy is installed."""
    return find_spec("rawpy") is not None


def image_endings() -> tuple[str, ...]:
    """What names of images end in that are read here."""
    return PICTURES + (RAWS if raw_is_read() else ())


def natural_stem(stem: str) -> list[tuple[bool, int, str]]:
    """A key that sorts IMG_9 before IMG_10."""
    return [(part.isdigit(), int(part) if part.isdigit() else 0, part) for part in re.split(r"(\d+)", stem)]


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


MOST_NAMES = 20_000
"""Names of a folder among which near ones are looked for: listing more takes longer than a message should."""


def did_you_mean(path: Path, otherwise: str = "") -> str:
    """What to do about a file or folder that is not there: the near names where its path first goes wrong, else `otherwise`."""
    parts = path.parts
    for count in range(1, len(parts) + 1):
        if not exists(Path(*parts[:count])):
            return nearest(parts[count - 1], _names_in(Path(*parts[: count - 1])), otherwise, within=Path(*parts[: count - 1]))
    return otherwise


def nearest(name: str, names: Iterable[str], otherwise: str = "", *, within: Path = Path()) -> str:
    """The names most like one that is not known, as a question; `otherwise` where none is, or where it is a pattern."""
    known = {one.casefold(): one for one in names if one != name}
    near = [] if set("*?") & set(name) else get_close_matches(name.casefold(), known, n=2, cutoff=0.7)
    return f"did you mean {' or '.join(str(within / known[one]) for one in near)}?" if near else otherwise


def _names_in(folder: Path) -> list[str]:
    try:
        return [one.name for one in islice(folder.iterdir(), MOST_NAMES) if not hidden(one)]
    except OSError:
        return []


def hidden(path: Path) -> bool:
    """Whether a file is one that the system hides: ``._x.png`` beside x.png, ``.DS_Store``."""
    return path.name.startswith(".")


def kind_of_other(paths: Iterable[Path]) -> str:
    """What files are that cannot be read as pictures, in words; empty where there is nothing to say of them."""
    endings = {path.suffix.lower() for path in paths}
    kinds = (
        (VIDEOS, "a video", INTO_PICTURES),
        (() if raw_is_read() else RAWS, "a camera's raw file", f"install lpcal[raw], or {INTO_PICTURES}"),
        (RELIGHTABLE, "a relightable image, which holds no photographs", "give the photographs that it was made of"),
        (OTHERS, "of a kind that is not read", INTO_PICTURES),
    )
    for known, what, todo in kinds:
        found = sorted(endings & set(known))
        if found:
            return f"{found[0]} is {what}: {todo}"
    return ""
