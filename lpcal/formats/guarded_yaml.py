"""YAML from anybody, loaded so that no file can crash the interpreter or fill the memory.

libyaml's Python binding builds nested sections by recursion in C, and aliases let a line stand for a billion. Both are counted in the text
before it is parsed, and on its nodes before values are made of them: so are keys that stand twice, of which YAML takes the last.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from lpcal.errors import InputError

MOST_BYTES = 256 << 20
"""Bytes of the largest document that is loaded: the corners of ten thousand views take less."""
DEEPEST = 64
"""Sections within sections; lpcal's own documents have seven."""
MOST_ALIASED = 100_000
"""Values that aliases may stand for, beyond those that are written."""
LONGEST_NUMBER = 1000
"""Characters of the longest number; the longest that Python writes has 767 digits."""
STEPS = re.compile(r"^ *(?:[-?:] +){24,}|^ {400,}", re.MULTILINE)
"""A line that opens two dozen sections at once, or stands four hundred blanks in."""


def load_yaml(text: str, path: Path, loader: Any = None, look: Callable[[yaml.Node], None] = lambda _: None) -> Any:
    """What a text holds; `look` sees its nodes before anything is made of them.

    Raises
    ------
    InputError
        Too large, too deep, a key twice, a number without end, or aliases that stand for too much; with its line.
    yaml.YAMLError
        It is no YAML.
    """
    refuse_bombs(text, path)
    loading = (loader or getattr(yaml, "CSafeLoader", yaml.SafeLoader))(text)
    try:
        node = loading.get_single_node()
        if node is None:
            return None
        _Judge(path).size(node, "", 0)
        look(node)
        return loading.construct_document(node)
    finally:
        loading.dispose()


def refuse_bombs(text: str, path: Path, opaque: re.Pattern[str] | None = None) -> None:
    """Refuse a text that would be too deep or too large; what `opaque` matches (strings, comments, within a line) opens no section.

    Raises
    ------
    InputError
        It would.
    """
    needed = f"a document of at most {MOST_BYTES >> 20} MB, {DEEPEST} sections deep"
    if len(text) > MOST_BYTES:
        raise InputError(f"{len(text) / 1e6:.0f} MB of YAML", where=str(path), needed=needed)
    text = opaque.sub("", text) if opaque else text
    signs = np.frombuffer(text.encode("utf-32-le", errors="replace"), np.uint32)
    turns = np.isin(signs, [ord("["), ord("{")]).astype(np.int8) - np.isin(signs, [ord("]"), ord("}")])
    deep = np.cumsum(turns, dtype=np.int64)
    steps = STEPS.search(text)
    if (deep.size and deep.max() > DEEPEST) or steps:
        at = steps.start() if steps else int(np.argmax(deep > DEEPEST))
        found = "sections within sections without end"
        raise InputError(found, where=f"{path}:{text.count('\n', 0, at) + 1}", needed=needed, todo="is it whole? export or copy it again")


@dataclass
class _Judge:
    """Looks at a document's nodes before values are made of them."""

    path: Path
    sizes: dict[int, int] = field(default_factory=dict)
    """How many values each section holds, by its identity; 0 while it is being looked at."""
    aliased: int = 0
    """Values that aliases stood for so far."""

    def size(self, node: yaml.Node, name: str, depth: int) -> int:
        """How many values a node called `name` holds; an alias counts with all that it stands for."""
        if isinstance(node, yaml.ScalarNode):
            if len(node.value) > LONGEST_NUMBER and node.tag.endswith((":int", ":float")):
                raise self.error(f"{name}: a number of {len(node.value)} characters", node, "numbers")
            return 1
        known = self.sizes.get(id(node))
        if known is not None:
            self.aliased += known
            if known == 0 or self.aliased > MOST_ALIASED:
                found = "a section that contains itself" if known == 0 else "aliases that stand for too much"
                raise self.error(found, node, "sections that end, without * and &", "write it out")
            return known
        if depth > DEEPEST:
            raise self.error(
                "sections within sections without end", node, f"sections at most {DEEPEST} deep", "is it whole? export it again"
            )
        self.sizes[id(node)] = 0
        entries = self.keyed(node, name) if isinstance(node, yaml.MappingNode) else enumerate(node.value)
        count = 1 + sum(self.size(value, f"{name}{'.' if name else ''}{key}", depth + 1) for key, value in entries)
        self.sizes[id(node)] = count
        return count

    def keyed(self, node: yaml.MappingNode, name: str) -> Iterator[tuple[str, yaml.Node]]:
        """A mapping's keys and values, each key once."""
        lines: dict[str, int] = {}
        for key, value in node.value:
            if not isinstance(key, yaml.ScalarNode):
                raise self.error("a section in a key's place", key, "key: value lines")
            full = f"{name}{'.' if name else ''}{key.value}"
            if key.value in lines:
                found = f"the key {full} stands twice, first in line {lines[key.value]}"
                raise self.error(found, key, "each key once", "remove one of them")
            lines[key.value] = key.start_mark.line + 1
            yield key.value, value

    def error(self, found: str, node: yaml.Node, needed: str, todo: str = "") -> InputError:
        """What is wrong with a node, with its line."""
        return InputError(found, where=f"{self.path}:{node.start_mark.line + 1}", needed=needed, todo=todo)
