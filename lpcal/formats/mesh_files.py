"""Meshes as files: PLY (binary, little-endian), as mesh viewers take it, and GLB, the binary form of glTF 2.0.

Written here and not by trimesh: importing that takes longer than writing a mesh does. It reads both in the tests, point for point. Both are
written band by band, since the mesh of a large picture takes more memory than all its maps.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal import __version__

type Numbers = npt.NDArray[np.number]

GLB_MAGIC, GLB_VERSION = 0x46546C67, 2
"""What a GLB begins with, by the format: its sign and its version."""
GLB_MOST = 2**32 - 2**20
"""Bytes of numbers that a GLB can hold: its length is written in 32 bits, of which a megabyte is left to its document."""
JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942
"""Signs of the two parts of a GLB, by the format."""
ARRAY_BUFFER, ELEMENT_BUFFER = 34962, 34963
"""What a stretch of a glTF's numbers is for, by the format: values of vertices, or corners of faces."""
UINT32, FLOAT32 = 5125, 5126
"""Kinds of numbers in a glTF, by the format."""
VERTEX = np.dtype([("x y z", "<f4", 3), ("nx ny nz", "<f4", 3), ("red green blue alpha", "u1", 4)])
"""What a PLY of lpcal's holds of a vertex: place, normal, colour; each word is a property of the file."""
PLY_TYPES = {"<f4": "float", "|u1": "uchar"}
"""Words of PLY for numpy's types."""
TRIANGLE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
"""A triangle in a PLY: how many corners it has, and their numbers."""

type Bands = Iterable[Numbers]
"""Rows of a table, band after band, so that the whole of it need not be there at once."""


def ply(
    sizes: tuple[int, int], vertices: Iterable[tuple[Numbers, Numbers, Numbers]], faces: Bands, comments: Sequence[str] = ()
) -> Iterator[bytes]:
    """A PLY, part by part.

    Parameters
    ----------
    sizes : (int, int)
        How many vertices and triangles there are.
    vertices : iterable of (ndarray (V, 3), ndarray (V, 3), ndarray (V, 4))
        Bands of places, normals and colours with their opacity, 8 bits.
    faces : iterable of ndarray (F, 3)
        Bands of numbers of the triangles' corners.
    comments : sequence of str
        Lines for people, ASCII.
    """
    head = ["ply", "format binary_little_endian 1.0", *(f"comment {one}" for one in comments), f"element vertex {sizes[0]}"]
    for words in VERTEX.names or ():
        head += [f"property {PLY_TYPES[VERTEX[words].base.str]} {word}" for word in words.split()]
    head += [f"element face {sizes[1]}", "property list uchar int vertex_indices", "end_header", ""]
    yield "\n".join(head).encode("ascii")
    for band in vertices:
        table = np.empty(len(band[0]), VERTEX)
        for words, values in zip(VERTEX.names or (), band, strict=True):
            table[words] = values
        yield table.tobytes()
    for corners in faces:
        triangles = np.empty(len(corners), TRIANGLE)
        triangles["count"], triangles["corners"] = 3, corners
        yield triangles.tobytes()


def glb(
    sizes: tuple[int, int], attributes: Mapping[str, Callable[[], Bands]], faces: Callable[[], Bands], extras: Mapping[str, Any]
) -> Iterator[bytes]:
    """A GLB of one matte mesh, part by part.

    Parameters
    ----------
    sizes : (int, int)
        How many vertices and triangles there are.
    attributes : mapping of str to callable
        POSITION, NORMAL, COLOR_0 as glTF names them, each written as floats of 4 bytes: what gives bands of them (V, 3), and the same
        when it is called again.
    faces : callable
        What gives bands of numbers of the triangles' corners (F, 3), likewise.
    extras : mapping
        What the asset says of itself besides.
    """
    views, accessors, begin = [], [], 0
    parts = [(sizes[1] * 3, "SCALAR", "<u4", 1, faces), *((sizes[0], "VEC3", "<f4", 3, of) for of in attributes.values())]
    for number, (count, kind, _, columns, of) in enumerate(parts):
        view = {"buffer": 0, "byteOffset": begin, "byteLength": 4 * columns * count}
        views.append(view | {"target": ARRAY_BUFFER if number else ELEMENT_BUFFER})
        accessor = {"bufferView": number, "componentType": FLOAT32 if number else UINT32, "type": kind, "count": count}
        accessors.append(accessor | (_ends(of()) if of is attributes["POSITION"] and count else {}))  # as the format asks
        begin += 4 * columns * count
    matte = {"name": "matte", "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 1.0}}
    drawn = {"attributes": {name: 1 + k for k, name in enumerate(attributes)}, "indices": 0, "mode": 4, "material": 0}
    document = {
        "asset": {"version": "2.0", "generator": f"lpcal {__version__}", "extras": dict(extras)},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "surface", "mesh": 0}],
        "meshes": [{"name": "surface", "primitives": [drawn]}],
        "materials": [matte],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": begin}],
    }
    yield _head(document, begin)
    for _, _, stored, _, of in parts:
        for band in of():
            yield np.asarray(band, stored).tobytes()


def glb_holds(sizes: tuple[int, int]) -> bool:
    """Whether a GLB can hold so many vertices, with normals and colours, and triangles."""
    return 36 * sizes[0] + 12 * sizes[1] <= GLB_MOST


def _ends(bands: Bands) -> dict[str, list[float]]:
    """Least and largest numbers of each column, as a glTF states them."""
    least, largest = [], []
    for band in bands:
        if len(band):
            table = np.asarray(band, "<f4")
            least.append(table.min(axis=0))
            largest.append(table.max(axis=0))
    return {"min": np.min(least, axis=0).tolist(), "max": np.max(largest, axis=0).tolist()}


def _head(document: Mapping[str, Any], binary: int) -> bytes:
    """What of a GLB comes before its numbers, which take so many bytes: a multiple of four."""
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), JSON_CHUNK) + text
    if binary:
        chunks += struct.pack("<II", binary, BINARY_CHUNK)
    return struct.pack("<III", GLB_MAGIC, GLB_VERSION, 12 + len(chunks) + binary) + chunks


def glb_of(document: Mapping[str, Any]) -> bytes:
    """A GLB of a glTF's document alone, its numbers within it."""
    return _head(document, 0)
