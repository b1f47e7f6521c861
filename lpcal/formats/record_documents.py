"""Frozen records as the plain documents that stand in a file, and back: the record is the schema.

A key is a field's name. A field without a default always stands there, as one marked `ALWAYS`; one with a default only where it is
not None or an empty tuple. NaN is written as null, and null is read as NaN where a number belongs. What a record does not know is left
out when it is read; a record with a default that lacks a key, as an earlier lpcal wrote it, is not known.
"""

from __future__ import annotations

import types
from collections.abc import Callable
from dataclasses import MISSING, Field, fields, is_dataclass
from typing import Any, Literal, TypeAliasType, Union, get_args, get_origin, get_type_hints

import numpy as np

from lpcal.geometry.arrays import Array, Image, Index, Labels, Mask
from lpcal.records.figures import ALWAYS

type Document = dict[str, Any]

ARRAYS: dict[Any, type] = {Array: np.float64, Image: np.float32, Mask: np.bool_, Labels: np.uint8, Index: np.intp}
"""The numbers of each kind of array that a record may hold."""


def document_of(record: Any) -> Document:
    """A record as it is written: mappings, lists and numbers.

    Parameters
    ----------
    record : dataclass instance, whose fields may hold records, tuples and dicts of them
    """
    values = ((field, getattr(record, field.name)) for field in fields(record))
    return {field.name: _plain(value) for field, value in values if _stands(field, value)}


def record_of[Record](kind: Callable[..., Record], document: Document) -> Record:
    """A record as it was written.

    Raises
    ------
    KeyError, TypeError, ValueError
        A key is lacking or holds something else; the message is the key's name.
    """
    hints = get_type_hints(kind)
    found = {}
    for field in fields(kind):  # type: ignore[arg-type]
        if document.get(field.name) is None and not _required(field):
            continue
        try:
            found[field.name] = _value(hints[field.name], document[field.name])
        except KeyError:
            if _required(field):
                raise
        except (TypeError, ValueError, AttributeError) as error:
            raise ValueError(field.name) from error
    return kind(**found)


def known_record_of[Record](kind: Callable[..., Record], document: Document | None) -> Record | None:
    """A record as it was written; None where there is none, or where it lacks a key.

    Raises
    ------
    TypeError, ValueError
        A key holds something else; the message is the key's name.
    """
    try:
        return record_of(kind, document) if document else None
    except KeyError:
        return None


def _required(field: Field[Any]) -> bool:
    return field.default is MISSING and field.default_factory is MISSING


def _stands(field: Field[Any], value: Any) -> bool:
    if _required(field) or field.metadata == ALWAYS:
        return True
    return value is not None and not (isinstance(value, tuple) and value == field.default)


def _plain(value: Any) -> Any:
    if is_dataclass(value):
        return document_of(value)
    if isinstance(value, dict):
        return {str(key): _plain(entry) for key, entry in value.items()}
    return [_plain(entry) for entry in value] if isinstance(value, tuple) else value


def _value(kind: Any, value: Any) -> Any:
    """A value of a type as it was written."""
    if kind in ARRAYS:
        return np.array(value, dtype=float).astype(ARRAYS[kind])
    if isinstance(kind, TypeAliasType):
        return _value(kind.__value__, value)
    origin, inner = get_origin(kind), get_args(kind)
    if origin in {Union, types.UnionType}:
        return None if value is None else _value(next(one for one in inner if one is not type(None)), value)
    if origin is tuple:
        return tuple(_value(inner[0], entry) for entry in value)
    if origin is dict:
        return {inner[0](key): _value(inner[1], entry) for key, entry in value.items()}
    if origin is Literal:
        return _one_of(inner, value)
    if is_dataclass(kind):
        return record_of(kind, value)  # type: ignore[arg-type]
    return float("nan") if kind is float and value is None else kind(value)


def _one_of(allowed: tuple[Any, ...], value: Any) -> Any:
    if value not in allowed:
        raise ValueError(value)
    return value
