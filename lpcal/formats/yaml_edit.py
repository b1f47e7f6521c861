"""One value set in a YAML file that a person wrote: all else stays as it is, comments, order and spaces too."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import yaml

from lpcal.errors import InputError


def with_value(text: str, keys: Sequence[str], value: str, where: str) -> str:
    """The text with `value`, YAML on one line, at the place that the keys lead to; sections that lack on the way are made.

    Raises
    ------
    InputError
        The text is no YAML of sections, or it holds anchors, tags or the like by which the change would touch something else.
    """
    try:
        before = yaml.safe_load(text)
        node = yaml.compose(text, Loader=yaml.SafeLoader)
        edited = _edited(text, node, keys, value)
        after = yaml.safe_load(edited)
        wanted = _set(before, keys, yaml.safe_load(value))
    except (yaml.YAMLError, TypeError, ValueError) as error:
        raise _by_hand(keys, value, where) from error
    if after != wanted:
        raise _by_hand(keys, value, where)
    return edited


def _by_hand(keys: Sequence[str], value: str, where: str) -> InputError:
    return InputError(
        f"{'.'.join(keys)} cannot be set without touching the rest",
        where=where,
        needed="plain YAML",
        todo=f"write by hand {keys[-1]}: {value}",
    )


def _edited(text: str, node: Any, keys: Sequence[str], value: str) -> str:
    if node is None:
        return text + ("" if not text or text.endswith("\n") else "\n") + _line(keys, value) + "\n"
    if not isinstance(node, yaml.MappingNode):
        raise TypeError(type(node).__name__)
    found = next((below for key, below in node.value if key.value == keys[0]), None)
    if found is None:
        return _inserted(text, node, _line(keys, value))
    if len(keys) > 1 and not (isinstance(found, yaml.ScalarNode) and not found.value):
        return _edited(text, found, keys[1:], value)
    content = value if len(keys) == 1 else "{" + _line(keys[1:], value) + "}"
    start, end = found.start_mark.index, found.end_mark.index
    kept = text[start:end]
    blank = kept[len(kept.rstrip()) :]
    return text[:start] + ("" if start and text[start - 1] in " \t" else " ") + content + blank + text[end:]


def _line(keys: Sequence[str], value: str) -> str:
    """``a: {b: value}`` for the keys a and b."""
    inner = value
    for key in reversed(keys[1:]):
        inner = f"{{{key}: {inner}}}"
    return f"{keys[0]}: {inner}"


def _inserted(text: str, node: yaml.MappingNode, line: str) -> str:
    """The line as the mapping's first one, or as its first part where it stands in braces."""
    if node.flow_style:
        at = node.start_mark.index + 1
        return text[:at] + line + (", " if node.value else "") + text[at:]
    first = node.value[0][0].start_mark
    return text[: first.index] + line + "\n" + " " * first.column + text[first.index :]


def _set(document: Any, keys: Sequence[str], value: Any) -> Any:
    document = dict(document or {})
    document[keys[0]] = value if len(keys) == 1 else _set(document.get(keys[0]), keys[1:], value)
    return document
