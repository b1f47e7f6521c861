"""Meshes as files, read by trimesh."""

from __future__ import annotations

import io
import json
import struct
from typing import Any

import numpy as np
import pytest
import trimesh

from lpcal.formats.mesh_files import glb, glb_of, ply

VERTICES = np.random.default_rng(1).standard_normal((7, 3)).astype(np.float32)
NORMALS = VERTICES / np.linalg.norm(VERTICES, axis=1, keepdims=True)
COLOURS = np.arange(28, dtype=np.uint8).reshape(7, 4)
FACES = np.array([[0, 1, 2], [2, 3, 4], [6, 5, 4]])


def load(data: Any, kind: Any) -> Any:
    return trimesh.load(io.BytesIO(data), file_type=kind, process=False)


def test_a_ply_is_read_as_it_was_written() -> None:
    bands = [(VERTICES[some], NORMALS[some], COLOURS[some]) for some in (slice(0, 3), slice(3, 3), slice(3, 7))]
    data = b"".join(ply((len(VERTICES), len(FACES)), bands, [FACES[:2], FACES[2:]], ["frame C, metres"]))
    assert b"\ncomment frame C, metres\n" in data[:200]
    found = load(data, "ply")
    assert np.array_equal(found.vertices, VERTICES)
    assert np.array_equal(found.faces, FACES)
    raw = found.metadata["_ply_raw"]["vertex"]["data"]
    assert np.array_equal(np.stack([raw[name] for name in ("nx", "ny", "nz")], axis=1), NORMALS)
    assert np.array_equal(found.visual.vertex_colors, COLOURS)


@pytest.mark.parametrize("faces", [FACES, FACES[:1]])
def test_a_glb_is_read_as_it_was_written(faces: Any) -> None:
    shown = {"POSITION": VERTICES, "NORMAL": NORMALS, "COLOR_0": COLOURS[:, :3] / 255}
    bands = {name: lambda values=values: iter((values[:2], values[2:2], values[2:])) for name, values in shown.items()}
    data = b"".join(glb((len(VERTICES), len(faces)), bands, lambda: [faces[:1], faces[1:]], {"frame": "C"}))
    assert struct.unpack("<I", data[8:12])[0] == len(data)
    assert len(data) % 4 == 0
    document = json.loads(data[20 : 20 + struct.unpack("<I", data[12:16])[0]])
    assert document["asset"]["extras"] == {"frame": "C"}
    lengths = [view["byteLength"] for view in document["bufferViews"]]
    assert sum(lengths) == document["buffers"][0]["byteLength"]
    (found,) = load(data, "glb").geometry.values()
    assert np.array_equal(found.vertices, VERTICES)
    assert np.array_equal(found.faces, faces)
    assert np.array_equal(found.vertex_normals, NORMALS)


def test_a_glb_without_numbers_is_its_document() -> None:
    data = glb_of({"asset": {"version": "2.0"}})
    assert json.loads(data[20:]) == {"asset": {"version": "2.0"}}


def test_a_mesh_of_nothing_is_written() -> None:
    nothing = np.zeros((0, 3), np.float32)
    assert b"element vertex 0\n" in b"".join(ply((0, 0), [(nothing, nothing, np.zeros((0, 4), np.uint8))], []))
    data = b"".join(glb((0, 0), {"POSITION": lambda: [nothing]}, lambda: [np.zeros((0, 3), int)], {}))
    assert data[:4] == b"glTF"
    assert struct.unpack("<I", data[8:12])[0] == len(data)
