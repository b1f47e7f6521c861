"""The YAML documents that lpcal writes: versioned, of a kind, with their provenance.

``lpcal: 1``, ``kind: ...``, the body, then ``provenance`` (inputs with their sha256, lpcal's version, options, time).
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Mapping
from copy import deepcopy
from dataclasses import asdict, fields, is_dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from lpcal.errors import InputError
from lpcal.formats.guarded_yaml import load_yaml
from lpcal.formats.named_files import did_you_mean
from lpcal.formats.outputs import Kind, marked, refuse_place, write_text
from lpcal.formats.reading import reader, reading
from lpcal.formats.record_documents import document_of
from lpcal.records.provenance import Provenance

VERSION = 1
MOST_HELD = 4_000_000
"""Characters of the largest document that is held once it is parsed: those of the stages have a tenth of it."""


def sha256(path: Path) -> str:
    """Hex digest of a file's content."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def document_kind(kind: str) -> Kind:
    """Documents of a kind, as outputs: one may replace another."""
    return marked(f"a {kind} file", f"lpcal: {VERSION}\nkind: {kind}\n")


def write_document(path: Path, kind: str, body: Mapping[str, Any], provenance: Provenance, inputs: Iterable[Path] = ()) -> None:
    """Write a YAML document of a kind; arrays become nested lists, paths and tuples plain values.

    A document that would say the same but for its time is left as it is, so that nothing made from it goes out of date.

    Raises
    ------
    UsageError, InputError
        As `whole`; the place is one of `inputs`, or holds something else than a document of this kind.
    """
    document = {"lpcal": VERSION, "kind": kind, **body, "provenance": asdict(provenance)}
    text = yaml.dump(plain(document), Dumper=_Dumper, sort_keys=False, width=140, default_flow_style=None, allow_unicode=True)
    refuse_place(path, document_kind(kind), inputs)
    if path.is_file() and _without_time(path.read_bytes()) == _without_time(text.encode()):
        return
    write_text(path, text, document_kind(kind))


def _without_time(document: bytes) -> bytes:
    """A document without its last entry, the time in its provenance."""
    return document.rpartition(b"\n  time:")[0]


@lru_cache(maxsize=8)
def _held(text: str, path: Path) -> Any:
    """What a document's text holds, to be copied: `lpcal run` reads each some four times, and parsing takes ten times as long as a copy."""
    return load_yaml(text, path)


@reader("a document that lpcal wrote")
def read_document(path: Path, kind: str) -> dict[str, Any]:
    """Read a YAML document of a kind.

    Raises
    ------
    InputError
        It is not there, cut off, of another kind or of another version.
    """
    todo = "write it again with lpcal export" if kind == "calibration" else "write it again with the command that makes it"
    elsewhere = f"name {kind}.yaml, or make one of another system's lights: lpcal import {path.name} -o calibration.yaml"
    if path.is_dir():
        made = path / "calib" / f"{kind}.yaml"
        raise InputError("a folder", where=str(path), needed=f"a {kind} file", todo=f"name {made}" if made.is_file() else "name the file")
    if not path.is_file():
        todo = did_you_mean(path, "run lpcal run: it makes it" if kind == "calibration" else todo)
        raise InputError("no such file", where=str(path), needed=f"a {kind} file that lpcal wrote", todo=todo)
    try:
        text = path.read_text(encoding="utf-8")
        document = deepcopy(_held(text, path)) if len(text) <= MOST_HELD else load_yaml(text, path)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", where=str(path), needed=f"a {kind} file that lpcal wrote") from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        mark = getattr(error, "problem_mark", None)
        place = f"{path}:{mark.line + 1}" if mark else str(path)
        raise InputError(
            "cannot be read as YAML; is the file cut off?",
            where=place,
            needed=f"a whole {kind} file",
            todo=elsewhere if _of_others(kind, path) else todo,
        ) from error
    if not isinstance(document, dict) or document.get("kind") != kind:
        found = document.get("kind") if isinstance(document, dict) else None
        mends = todo if kind != "calibration" else "give the calibration that lpcal export writes" if found else elsewhere
        raise InputError(f"of kind {found!r}" if found else "says no kind", where=str(path), needed=f"kind: {kind}", todo=mends)
    if document.get("lpcal") != VERSION:
        raise InputError(
            f"version {document.get('lpcal')!r}", where=str(path), needed=f"lpcal: {VERSION}", todo="use the lpcal that wrote it"
        )
    provenance = document.get("provenance")
    if not isinstance(provenance, dict) or any(provenance.get(entry.name) is None for entry in fields(Provenance)):
        raise InputError("ends before its provenance does: the file is cut off", where=str(path), needed=f"a whole {kind} file", todo=todo)
    return document


def _of_others(kind: str, path: Path) -> bool:
    """Whether what is to be a calibration does not even begin as a document of lpcal's."""
    return kind == "calibration" and not path.read_bytes()[:9].startswith(f"lpcal: {VERSION}\n".encode())


def read_provenance(path: Path, kind: str) -> Provenance:
    """What a document of a kind was made from.

    Raises
    ------
    InputError
        As `read_document`.
    """
    stated = read_document(path, kind)["provenance"]
    inputs = {str(name): str(digest) for name, digest in stated["inputs"].items()}
    return Provenance(inputs, dict(stated["options"]), str(stated["lpcal_version"]), str(stated["time"]))


def read_record[Record](path: Path, kind: str, command: str, record_of: Callable[[dict[str, Any]], Record]) -> Record:
    """What a document of a kind holds, by `record_of`; `command` writes it again.

    Raises
    ------
    InputError
        Not there, cut off, of another kind, or a key that is lacking or holds something else.
    """
    document = read_document(path, kind)
    try:
        with reading(path, f"a whole {kind} file"):
            return record_of(document)
    except InputError as error:
        if isinstance(error.__cause__, (KeyError, TypeError, ValueError, IndexError)):
            found = f"{error.__cause__} is lacking or garbled"
            raise InputError(found, where=str(path), needed=f"a whole {kind} file", todo=f"write it again with {command}") from error
        raise


def plain(value: Any) -> Any:
    """The value in types that YAML and JSON know; NaN becomes null."""
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if is_dataclass(value):
        return plain(document_of(value))
    if isinstance(value, Mapping):
        return {str(key): plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(entry) for entry in value]
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    if isinstance(value, (float, np.floating)):
        return float(value) if np.isfinite(value) else None
    if isinstance(value, np.integer):
        return int(value)
    return str(value) if isinstance(value, (Path, str)) else value


class _Dumper(getattr(yaml, "CSafeDumper", yaml.SafeDumper)):  # type: ignore[misc]
    """Never an alias, and floats with all the digits they need and no more."""

    def ignore_aliases(self, data: Any) -> bool:  # noqa: ARG002
        return True


def _float(dumper: yaml.SafeDumper, value: float) -> yaml.ScalarNode:
    text = repr(value)
    return dumper.represent_scalar("tag:yaml.org,2002:float", text if "e" not in text or "." in text else text.replace("e", ".0e"))


_Dumper.add_representer(float, _float)
