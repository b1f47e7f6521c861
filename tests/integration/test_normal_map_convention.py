"""Which way a normal map reads: the curl of surfaces that are known, with noise, jumps and every convention that people export."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt
import pytest

from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.formats.normal_map import read_normals
from lpcal.formats.surface_files import read_surface
from lpcal.geometry.arrays import Array
from lpcal.integration.convention import settled
from lpcal.records.calibration import Camera
from lpcal.view.pixel_list import ray_map

SHAPE = (120, 160)
ROW, COLUMN = np.indices(SHAPE).astype(float)
EVERYWHERE = np.ones(SHAPE, bool)


def spheres() -> Array:
    z = np.zeros(SHAPE)
    for x, y, radius in ((45, 45, 30), (110, 60, 40), (60, 95, 20)):
        z = np.minimum(z, -np.sqrt(np.maximum(radius**2 - (COLUMN - x) ** 2 - (ROW - y) ** 2, 0)))
    return z


def rough() -> Array:
    return 4 * cv2.GaussianBlur(np.random.default_rng(1).standard_normal(SHAPE), (0, 0), 2)


def step() -> Array:
    return spheres() - 30.0 * (COLUMN + ROW / 2 > 120)


def bump() -> Array:
    return -20 * np.exp(-((COLUMN - 80) ** 2 + (ROW - 60) ** 2) / 800)


def normals_of(z: Array, noise: float = 0.0) -> npt.NDArray[Any]:
    """Normals in C of a depth in pixels seen by parallel rays."""
    q, p = np.gradient(z)
    n = np.stack([p, q, -np.ones_like(z)], axis=-1)
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    n += noise * np.random.default_rng(0).standard_normal(n.shape)
    return (n / np.linalg.norm(n, axis=-1, keepdims=True)).astype(np.float32)


@pytest.mark.parametrize("surface", [spheres, rough, step, bump])
@pytest.mark.parametrize("noise", [0.0, 0.02])
def test_green_is_turned_over_where_it_points_down(surface: Callable[..., Any], noise: float) -> None:
    n = normals_of(surface(), noise)
    assert not settled("map", n, EVERYWHERE, None).flipped
    found = settled("map", n * np.array([1, -1, 1], np.float32), EVERYWHERE, None)
    assert found.flipped
    assert "green points down" in (found.note or "")
    assert np.allclose(found.normals_C, n)


def test_a_camera_s_normals_are_judged_along_its_rays() -> None:
    """A sphere seen by a wide lens: normals across the image, of which parallel rays would judge otherwise."""
    camera = Camera((SHAPE[1], SHAPE[0]), "opencv4", np.array([[90.0, 0, 79.5], [0, 90, 59.5], [0, 0, 1]]), np.zeros(4))
    rays, centre, radius = ray_map(SHAPE, camera), np.array([0.1, 0.05, 1.0]), 0.45
    b, c = rays @ centre, centre @ centre - radius**2
    square = b**2 - np.sum(rays**2, axis=-1) * c
    depth = (b - np.sqrt(np.maximum(square, 0))) / np.sum(rays**2, axis=-1)
    n = ((depth[..., None] * rays - centre) / radius).astype(np.float32)
    assert not settled("ball", n, square > 0.01, camera).flipped
    assert settled("ball", n * np.array([1, -1, 1], np.float32), square > 0.01, camera).flipped


@pytest.mark.parametrize("z", [0.2 * COLUMN, -np.sqrt(np.maximum(100.0**2 - (COLUMN - 80) ** 2, 1)), np.zeros(SHAPE)])
def test_a_surface_without_twist_is_taken_as_it_is_and_that_is_said(z: Array) -> None:
    found = settled("flat", normals_of(z, 0.02), EVERYWHERE, None)
    assert not found.flipped
    assert "do not show" in (found.note or "")


@pytest.mark.parametrize("surface", [spheres, rough, bump])
def test_swapped_channels_are_refused(surface: Callable[..., Any]) -> None:
    gl = normals_of(surface()) * np.array([1, -1, -1], np.float32)
    with pytest.raises(DisagreementError, match="red channel has one sign"):
        settled("map", gl[..., ::-1], EVERYWHERE, None)


@pytest.mark.parametrize("blur", [0.0, 2.0, 5.0])
def test_what_is_no_surface_is_refused(blur: float) -> None:
    rng = np.random.default_rng(2)
    n = np.stack([rng.standard_normal(SHAPE) for _ in range(3)], axis=-1)
    n = 2 * blur * cv2.GaussianBlur(n, (0, 0), blur) if blur else n
    n[..., 2] = -1.0 if blur else -np.abs(n[..., 2])
    with pytest.raises(DegenerateError, match="no surface"):
        settled("map", n / np.linalg.norm(n, axis=-1, keepdims=True), EVERYWHERE, None)


@pytest.mark.parametrize("name", ["diligent_ball", "diligent_bear"])
def test_real_normals_are_read_as_they_are(data: Callable[[str], Path], name: str) -> None:
    n, good = read_normals(data("surface") / name / "normal_gt.npz")
    assert not settled(name, n, good, None).flipped
    assert settled(name, n * np.array([1, -1, 1], np.float32), good, None).flipped


@pytest.mark.parametrize("bits", [8, 16])
def test_a_directx_map_gives_the_surface_of_the_opengl_one(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]], bits: int) -> None:
    full = 2**bits - 1
    gl = normals_of(bump()) * np.array([1, -1, -1], np.float32)
    for name, turn in (("gl", 1), ("dx", -1)):
        stored = np.rint((gl * [1, turn, 1] + 1) / 2 * full).astype(f"uint{bits}")
        cv2.imwrite(str(tmp_path / f"{name}.png"), stored[..., ::-1])
        code, told, wrong = lpcal("integrate", tmp_path / f"{name}.png", "-o", tmp_path / name, cwd=tmp_path)
        assert code == 0, wrong
        assert ("green points down" in told) == (name == "dx")
    summary = json.loads((tmp_path / "dx" / "summary.json").read_text())
    assert summary["convention"]["green_turned_over"]
    depth = [read_surface(tmp_path / name).depth for name in ("gl", "dx")]
    assert np.nanmax(np.abs(depth[0] - depth[1])) < 0.3
    assert np.corrcoef(depth[1].ravel(), bump().ravel())[0, 1] > 0.999
    assert lpcal("integrate", tmp_path / "dx.png", "--green", "as-is", "-o", tmp_path / "as_is", cwd=tmp_path)[0] == 0
    assert not json.loads((tmp_path / "as_is" / "summary.json").read_text())["convention"]["green_turned_over"]


CAMERAS = {
    "ros.yaml": "image_width: 160\nimage_height: 120\ncamera_matrix: {rows: 3, cols: 3, data: [300, 0, 79.5, 0, 300, 59.5, 0, 0, 1]}\n"
    "distortion_model: plumb_bob\ndistortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n",
    "cameras.txt": "1 PINHOLE 160 120 300 300 80 60\n",
    "camera.yaml": "lpcal: 1\nkind: camera\nimage_size: [160, 120]\nmodel: opencv4\ndistortion: [0, 0, 0, 0]\n"
    "K: [[300.0, 0, 79.5], [0, 300.0, 59.5], [0, 0, 1]]\nprovenance: {inputs: {}, options: {}, lpcal_version: '1', time: now}\n",
}


@pytest.mark.parametrize("name", list(CAMERAS))
def test_a_camera_alone_makes_metres(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]], name: str) -> None:
    np.save(tmp_path / "n.npy", normals_of(bump()))
    (tmp_path / name).write_text(CAMERAS[name])
    words = ("integrate", tmp_path / "n.npy", "-c", tmp_path / name, "--distance", "200mm", "-o", tmp_path / "out")
    code, told, wrong = lpcal(*words, cwd=tmp_path)
    assert code == 0, wrong
    assert "metres" in told
    assert np.nanmedian(read_surface(tmp_path / "out").depth) == pytest.approx(0.2, rel=1e-3)


def test_what_is_transparent_or_not_finite_holds_no_normal(tmp_path: Path) -> None:
    n = normals_of(bump())
    n[:10] = np.nan
    np.savez(tmp_path / "n.npz", normals=n)
    assert not read_normals(tmp_path / "n.npz")[1][:10].any()
    stored = np.rint((normals_of(bump()) * [1, -1, -1] + 1) / 2 * 255).astype(np.uint8)[..., ::-1]
    alpha = np.where(ROW < 10, 0, 255).astype(np.uint8)
    cv2.imwrite(str(tmp_path / "n.png"), np.dstack([stored, alpha]))
    good = read_normals(tmp_path / "n.png")[1]
    assert not good[:10].any()
    assert good[10:].all()


@pytest.mark.parametrize("shape", [(10**6, 10**6, 3), (4, 4, 3), (4, 4, 3000)])
def test_an_array_that_says_more_than_it_holds_is_refused(tmp_path: Path, shape: tuple[int, int, int]) -> None:
    head = f"{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}".ljust(117) + "\n"
    (tmp_path / "n.npy").write_bytes(b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head.encode() + b"\0" * 20)
    with pytest.raises(InputError, match=r"cut off|an array"):
        read_normals(tmp_path / "n.npy")


def test_a_mask_of_another_size_is_said(tmp_path: Path) -> None:
    np.savez(tmp_path / "n.npz", normals=normals_of(bump()), mask=np.ones((5, 5)))
    with pytest.raises(DisagreementError, match="a mask of 5x5"):
        read_normals(tmp_path / "n.npz")


def test_meshes_say_their_frame_and_glb_is_matte_with_linear_colours(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    import trimesh

    np.save(tmp_path / "n.npy", normals_of(bump()))
    assert lpcal("integrate", tmp_path / "n.npy", "-o", tmp_path / "out", cwd=tmp_path)[0] == 0
    assert b"comment frame C: x right, y down, z forward, pixels" in (tmp_path / "out" / "mesh.ply").read_bytes()[:400]
    glb = (tmp_path / "out" / "mesh.glb").read_bytes()
    length = int.from_bytes(glb[12:16], "little")
    tree = json.loads(glb[20 : 20 + length])
    assert tree["materials"][0]["pbrMetallicRoughness"] == {"metallicFactor": 0.0, "roughnessFactor": 1.0}
    assert "y up" in tree["asset"]["extras"]["frame"]
    primitive = tree["meshes"][0]["primitives"][0]
    assert primitive["material"] == 0
    accessor = tree["accessors"][primitive["attributes"]["COLOR_0"]]
    view = tree["bufferViews"][accessor["bufferView"]]
    begin = 28 + length + view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    colour = np.frombuffer(glb[begin : begin + 12], "<f4")
    assert colour == pytest.approx(0.9, abs=0.01)  # albedo 1 at nine tenths of the light, not of the display
    ply = trimesh.load(tmp_path / "out" / "mesh.ply", process=False)
    assert len(ply.vertices) == accessor["count"]
