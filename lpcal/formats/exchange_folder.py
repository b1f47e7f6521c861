"""A folder of exports: files of many systems side by side, and which of them lpcal wrote.

``lpcal-export.json`` names each file with its format, its sha256 and what was said of it. A file or folder is replaced only where it is
still as lpcal wrote it; one that somebody changed is left alone and named.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lpcal.formats.documents import plain, sha256
from lpcal.formats.outputs import Kind, marked, refuse_place, whole, write_text
from lpcal.records.provenance import Provenance

LIST = "lpcal-export.json"
KIND = marked("a list of exports", '"kind": "export"')


@dataclass(frozen=True)
class Draft:
    """What one format wrote, beside the place it is for."""

    format: str
    folder: Path
    notes: tuple[str, ...]

    @property
    def entries(self) -> list[Path]:
        """Its files and folders, by name."""
        return sorted(self.folder.iterdir())


def place(drafts: Iterable[Draft], folder: Path, provenance: Provenance, inputs: Iterable[Path] = ()) -> list[Path]:
    """Put what the formats wrote into a folder, each file or folder whole or not at all; where they stand.

    Raises
    ------
    UsageError, InputError
        Something stands there that lpcal did not write or that was changed since, or nothing can be written; before anything is written.
    """
    drafts, inputs, before = list(drafts), list(inputs), read_list(folder)
    for draft in drafts:
        for entry in draft.entries:
            refuse_place(folder / entry.name, _kind(entry.name, before), inputs)
    refuse_place(folder / LIST, KIND, inputs)
    listed, placed = dict(before), list[Path]()
    for draft in drafts:
        for entry in draft.entries:
            with whole(folder / entry.name, _kind(entry.name, before), inputs) as target:
                shutil.move(entry, target)
            placed.append(folder / entry.name)
            listed[entry.name] = {"format": draft.format, "sha256": _digests(placed[-1]), "notes": list(draft.notes)}
    document = {"lpcal": 1, "kind": "export", "files": listed, "provenance": plain(provenance.__dict__)}
    write_text(folder / LIST, json.dumps(document, indent=1) + "\n", KIND)
    return placed


def read_list(folder: Path) -> dict[str, dict[str, Any]]:
    """What the folder's list says, by file or folder; nothing where there is no list, or none that can be read."""
    try:
        found = json.loads((folder / LIST).read_text(encoding="utf-8"))["files"]
        return {str(name): entry for name, entry in found.items() if isinstance(entry, dict)}
    except (OSError, ValueError, KeyError, AttributeError, TypeError):
        return {}


def _kind(name: str, listed: dict[str, dict[str, Any]]) -> Kind:
    """The entry as an output: known by what the list says that it held."""
    return Kind(f"{name} as", lambda path: _digests(path) == listed.get(name, {}).get("sha256"))


def _digests(path: Path) -> dict[str, str]:
    """sha256 of a file, or of every file in a folder, by its path in the folder."""
    if path.is_file():
        return {"": sha256(path)}
    return {each.relative_to(path).as_posix(): sha256(each) for each in sorted(path.rglob("*")) if each.is_file()}
