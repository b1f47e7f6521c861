"""Matrices of numbers in a MATLAB file of version 5 to 7.2, every size checked against the bytes that are there.

Read here and not by scipy, whose compiled reader ends the interpreter on some damaged files. Variables of other kinds (text, cells,
structures, sparse or complex matrices) are passed over. Source: MathWorks, MAT-File Format, level 5.
"""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lpcal.errors import InputError
from lpcal.geometry.arrays import Array

MOST_BYTES = 32_000_000
"""Bytes of a file, and of one variable unpacked, beyond which it is refused: a thousand lights need less than a hundredth of it."""
HEADER = 128
"""Bytes before the first element, by the format."""
MATRIX, COMPRESSED = 14, 15
"""The format's numbers for a variable and for a packed one."""
TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
"""The format's numbers of stored types, as numpy names them."""
NUMERIC = range(6, 16)
"""The format's classes of full matrices of numbers: double, single, and whole numbers of 8 to 64 bit."""
COMPLEX = 0x0800
"""The flag of a variable with an imaginary part."""
KNOWN_FLAGS = 0x0FFF
"""The class, and the bits that the format uses: complex, global, logical, and one that some writers leave set."""
HEAD = (6, 5, 1)
"""The types of what a variable begins with: its flags, its shape, its name."""

type Element = tuple[int, bytes]


def read_matrices(path: Path, dimensions: int = 2, most_bytes: int = MOST_BYTES) -> dict[str, Array]:
    """Matrices (rows, columns), or arrays of so many dimensions, by name.

    Raises
    ------
    InputError
        Not there, too large, of another version, or cut off.
    """
    try:
        size = path.stat().st_size
        stored = path.read_bytes() if size <= most_bytes else b""
    except OSError as error:
        raise InputError("cannot be read", where=str(path), needed="a MATLAB file") from error
    if size > most_bytes:
        needed = f"a MATLAB file of at most {most_bytes / 1e6:.0f} MB"
        raise InputError(f"holds {size / 1e6:.0f} MB", where=str(path), needed=needed, todo="is it the right file?")
    if stored.startswith(b"MATLAB 7.3") or b"\x89HDF\r\n\x1a\n" in stored[:1024]:
        raise InputError("a MATLAB file of version 7.3 (HDF5)", where=str(path), needed="version 7 or older", todo="save it with -v7")
    order = {b"IM": "<", b"MI": ">"}.get(stored[HEADER - 2 : HEADER])
    if order is None:
        raise InputError("is no MATLAB file of version 5 to 7", where=str(path), needed="one of these", todo="save it with -v7")
    found: dict[str, Array] = {}
    try:
        for kind, data in _elements(stored[HEADER:], order):
            unpacked = next(_elements(_inflated(data, most_bytes), order)) if kind == COMPRESSED else (kind, data)
            if unpacked[0] == MATRIX:
                _keep(found, unpacked[1], order, dimensions)
    except (ValueError, StopIteration, struct.error, zlib.error, UnicodeDecodeError) as error:
        raise InputError("a MATLAB file that is cut off or damaged", where=str(path), needed="a whole one", todo="copy it again") from error
    return found


def _elements(stored: bytes, order: str) -> Iterator[Element]:
    """Type and data of each element; small ones hold their data in the tag."""
    at = 0
    while at + 8 <= len(stored):
        kind, length = struct.unpack_from(f"{order}II", stored, at)
        if kind >> 16:
            length, kind, begin, step = kind >> 16, kind & 0xFFFF, at + 4, 8
            if length > 4:
                raise ValueError("a small element of more than 4 bytes")
        else:
            begin, step = at + 8, 8 + (length if kind == COMPRESSED else -(-length // 8) * 8)
        if begin + length > len(stored):
            raise ValueError("an element that goes beyond the end")
        yield kind, stored[begin : begin + length]
        at += step


def _inflated(packed: bytes, most_bytes: int) -> bytes:
    unpacking = zlib.decompressobj()
    found = unpacking.decompress(packed, most_bytes)
    if unpacking.unconsumed_tail or not unpacking.eof:
        raise ValueError("a variable that is too large or cut off")
    return found


def _keep(found: dict[str, Array], variable: bytes, order: str, dimensions: int) -> None:
    """Add a variable if it is a full real array of numbers of so many dimensions."""
    parts = _elements(variable, order)
    (flag_kind, flags), (shape_kind, shape_bytes), (name_kind, name_bytes) = next(parts), next(parts), next(parts)
    if (flag_kind, shape_kind, name_kind) != HEAD or len(flags) != 8 or len(shape_bytes) % 4:
        raise ValueError("a variable without its kind, size and name")
    flag = int(np.frombuffer(flags, f"{order}u4")[0])
    shape = np.frombuffer(shape_bytes, f"{order}i4")
    if flag & ~KNOWN_FLAGS:
        raise ValueError("flags that the format does not have")
    name = name_bytes.decode("latin-1")
    if flag & 0xFF not in NUMERIC or flag & COMPLEX or shape.size != dimensions:
        return
    sides = tuple(int(side) for side in shape)
    kind, data = next(parts)
    if kind not in TYPES or min(sides) < 0:
        raise ValueError("numbers of no known type")
    values: npt.NDArray[np.generic] = np.frombuffer(data, order + TYPES[kind])
    if values.size != math.prod(sides):
        raise ValueError("another count of numbers than the array has")
    found[name] = values.astype(float).reshape(sides, order="F")
