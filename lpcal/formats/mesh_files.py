"""Meshes as files: PLY (binary, little-endian), as mesh viewers take it, and GLB, the binary form of glTF 2.0.

Written here and not by trimesh: importing that takes longer than writing a mesh does. It reads both in the tests, point for point.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal import __version__

type Numbers = npt.NDArray[np.number]

GLB_MAGIC, GLB_VERSION = 0x46546C67, 2
"""What a GLB begins with, by the format: its sign and its version."""
JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942
"""Signs of the two parts of a GLB, by the format."""
ARRAY_BUFFER, ELEMENT_BUFFER = 34962, 34963
"""What a stretch of a glTF's numbers is for, by the format: values of vertices, or corners of faces."""
UINT32, FLOAT32 = 5125, 5126
"""Kinds of numbers in a glTF, by the format."""
PLY_TYPES = {"f4": "float", "u1": "uchar", "i4": "int"}
"""Words of PLY for numpy's types."""


def ply_bytes(vertices: Mapping[str, Numbers], faces: Numbers, comments: Sequence[str] = ()) -> bytes:
    """A PLY of V vertices and their triangles.

    Parameters
    ----------
    vertices : mapping of str to ndarray (V,)
        Property by property in the file's order: floats of 4 bytes or whole numbers of 1.
    faces : ndarray (F, 3)
        Numbers of the triangles' corners.
    comments : sequence of str
        Lines for people, ASCII.
    """
    types = [(name, f"<{values.dtype.str[1:]}") for name, values in vertices.items()]
    table = np.empty(len(next(iter(vertices.values()))), types)
    for name, values in vertices.items():
        table[name] = values
    triangles = np.empty(len(faces), [("count", "u1"), ("corners", "<i4", 3)])
    triangles["count"], triangles["corners"] = 3, faces
    head = ["ply", "format binary_little_endian 1.0", *(f"comment {one}" for one in comments), f"element vertex {len(table)}"]
    head += [f"property {PLY_TYPES[kind[1:]]} {name}" for name, kind in types]
    head += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", ""]
    return "\n".join(head).encode("ascii") + table.tobytes() + triangles.tobytes()


def named(names: str, values: Numbers) -> dict[str, Numbers]:
    """Columns (V,) of values (V, N) by their names, a word each."""
    return dict(zip(names.split(), values.T, strict=True))


def glb_bytes(attributes: Mapping[str, Numbers], faces: Numbers, extras: Mapping[str, Any]) -> bytes:
    """A GLB of one matte mesh.

    Parameters
    ----------
    attributes : mapping of str to ndarray (V, 3)
        POSITION, NORMAL, COLOR_0 as glTF names them, each written as floats of 4 bytes.
    faces : ndarray (F, 3)
        Numbers of the triangles' corners.
    extras : mapping
        What the asset says of itself besides.
    """
    parts = [np.asarray(faces, "<u4").reshape(-1, 1), *(np.asarray(values, "<f4") for values in attributes.values())]
    views, accessors, begin = [], [], 0
    for number, part in enumerate(parts):
        target = ARRAY_BUFFER if number else ELEMENT_BUFFER
        views.append({"buffer": 0, "byteOffset": begin, "byteLength": part.nbytes, "target": target})
        shape = {"componentType": FLOAT32 if number else UINT32, "type": "VEC3" if number else "SCALAR", "count": len(part)}
        ends = {"min": part.min(axis=0).tolist(), "max": part.max(axis=0).tolist()} if len(part) else {}
        accessors.append({"bufferView": number, **shape, **ends})
        begin += part.nbytes
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
    return packed_glb(document, b"".join(part.tobytes() for part in parts))


def packed_glb(document: Mapping[str, Any], binary: bytes = b"") -> bytes:
    """A GLB of a glTF's document and of its numbers, each part filled up to whole fours."""
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), JSON_CHUNK) + text
    if binary:
        binary += b"\0" * (-len(binary) % 4)
        chunks += struct.pack("<II", len(binary), BINARY_CHUNK) + binary
    return struct.pack("<III", GLB_MAGIC, GLB_VERSION, 12 + len(chunks)) + chunks
