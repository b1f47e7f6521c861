"""Arrays of numbers in files of other programs: .npy and .npz of numpy, lists in JSON or YAML."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from lpcal.errors import InputError
from lpcal.formats.guarded_yaml import load_yaml
from lpcal.formats.text import read_text
from lpcal.geometry.arrays import Array

ARRAYS = (".npy", ".npz", ".json", ".yaml", ".yml")
"""How names of files end that are read here."""
MOST_BYTES = 16 << 20
"""Bytes of the largest file that is read: a hundred thousand poses take less."""


def read_arrays(path: Path, needed: str) -> Any:
    """What a file holds: an array, or values by name; of a .npz that holds one array alone this one.

    Raises
    ------
    InputError
        Not readable, or too large.
    """
    try:
        if _size(path) > MOST_BYTES:
            raise InputError("too large", where=str(path), needed=needed, todo="is it the right file?")
        if path.suffix.lower() in {".npy", ".npz"}:
            held = np.load(path, allow_pickle=False)
            if isinstance(held, np.ndarray):
                return held
            with held:
                arrays = {name: held[name] for name in held.files}
            return next(iter(arrays.values())) if len(arrays) == 1 else arrays
        text = read_text(path, needed)
        return json.loads(text) if path.suffix.lower() == ".json" else load_yaml(text, path)
    except (OSError, ValueError, EOFError, zipfile.BadZipFile, yaml.YAMLError) as error:
        raise InputError("cannot be read as arrays of numbers", where=str(path), needed=needed, todo="is it cut off?") from error


def _size(path: Path) -> int:
    """Bytes of a file, unpacked."""
    if path.suffix.lower() == ".npz":
        with zipfile.ZipFile(path) as packed:
            return sum(one.file_size for one in packed.infolist())
    return path.stat().st_size


def matrix_rows(held: Any, path: Path) -> str:
    """Matrices as text, one a line: in their order, or each after its name and a comma.

    Raises
    ------
    InputError
        Something else.
    """
    if not isinstance(held, dict):
        return "\n".join(" ".join(map(repr, H.ravel().tolist())) for H in _matrices(held, str(path)))
    named = {str(name): _matrices(value, f"{path}, {name}")[0] for name, value in held.items() if np.ndim(value) == 2}
    if not named:
        raise InputError("no matrices by name", where=str(path), needed="a 4x4 matrix under each image's name, or a list of them")
    return "\n".join(f"{name}," + ",".join(map(repr, H.ravel().tolist())) for name, H in named.items())


def _matrices(held: Any, where: str) -> Array:
    """Matrices (N, 4, 4) or (N, 3, 4) of numbers, or one of them."""
    needed = "4x4 matrices: (N, 4, 4) or (N, 3, 4)"
    try:
        found = np.asarray(held, float)
    except (TypeError, ValueError) as error:
        raise InputError("no array of numbers", where=where, needed=needed) from error
    found = found[None] if found.ndim == 2 else found
    if found.ndim != 3 or found.shape[1:] not in {(4, 4), (3, 4)} or not len(found):
        raise InputError(f"an array of {found.shape}", where=where, needed=needed, todo="write the poses so, or a csv with names")
    return found
