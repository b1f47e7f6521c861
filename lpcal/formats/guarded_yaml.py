"""YAML from anybody, loaded so that no file can crash the interpreter or fill the memory.

libyaml's Python binding builds nested sections by recursion in C, and aliases let a line stand for a billion. Both are counted in the text
before it is loaded, and on what was loaded.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from lpcal.errors import InputError

MOST_BYTES = 256 << 20
"""Bytes of the largest document that is loaded: the corners of ten thousand views take less."""
DEEPEST = 64
"""Sections within sections; lpcal's own documents have seven."""
MOST_VALUES = 20_000_000
"""Values of a document, each alias counted with all that it stands for."""
STEPS = re.compile(r"^ *(?:[-?:] +){24,}|^ {400,}", re.MULTILINE)
"""A line that opens two dozen sections at once, or stands four hundred blanks in."""


def load_yaml(text: str, path: Path, loader: Any = None) -> Any:
    """What a text holds.

    Raises
    ------
    InputError
        Too large, too deep, or an alias that stands for too much.
    yaml.YAMLError
        It is no YAML.
    """
    refuse_bombs(text, path)
    loaded = yaml.load(text, Loader=loader or getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    _size(loaded, {}, path)
    return loaded


def refuse_bombs(text: str, path: Path) -> None:
    """Refuse a text that would be too deep or too large.

    Raises
    ------
    InputError
        It would.
    """
    needed = f"a document of at most {MOST_BYTES >> 20} MB, {DEEPEST} sections deep"
    if len(text) > MOST_BYTES:
        raise InputError(f"{len(text) / 1e6:.0f} MB of YAML", where=str(path), needed=needed)
    signs = np.frombuffer(text.encode("utf-32-le", errors="replace"), np.uint32)
    turns = np.isin(signs, [ord("["), ord("{")]).astype(np.int8) - np.isin(signs, [ord("]"), ord("}")])
    deep = np.cumsum(turns, dtype=np.int64)
    steps = STEPS.search(text)
    if (deep.size and deep.max() > DEEPEST) or steps:
        at = steps.start() if steps else int(np.argmax(deep > DEEPEST))
        found = "sections within sections without end"
        raise InputError(found, where=f"{path}:{text.count('\n', 0, at) + 1}", needed=needed, todo="is it whole? export or copy it again")


def _size(value: Any, known: dict[int, int], path: Path) -> int:
    """How many values a value holds; an alias counts with all that it stands for."""
    if not isinstance(value, (dict, list)):
        return 1
    found = known.get(id(value))
    if found is None:
        known[id(value)] = MOST_VALUES + 1  # whoever comes here again is inside itself
        entries = value.values() if isinstance(value, dict) else value
        found = known[id(value)] = 1 + sum(_size(entry, known, path) for entry in entries)
    if found > MOST_VALUES:
        raise InputError("aliases that stand for too much", where=str(path), needed="a document without * and &", todo="write it out")
    return found
