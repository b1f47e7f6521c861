"""Surfaces and the rig as other programs' files, read by those programs' own readers."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest
import tifffile
import trimesh

import lpcal
from exchange_readers import H_PC, calibration, lights, reader
from lpcal.formats.export_rig_glb import spot_of
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration, Camera
from lpcal.records.surface import Surface

SIZE = (48, 36)


@pytest.fixture(scope="module")
def surface() -> Surface:
    """A bump under a perspective camera, 48 x 36 pixels, its albedo a ramp of colours."""
    from dataclasses import replace

    x, y = np.meshgrid(np.linspace(-1, 1, SIZE[0]), np.linspace(-0.75, 0.75, SIZE[1]))
    normals = np.stack([x, y, -np.ones_like(x) * 1.5], axis=-1)
    lens = Camera(SIZE, "opencv4", np.array([[60.0, 0, 23.2], [0, 61.0, 17.9], [0, 0, 1]]), np.zeros(4))
    found = lpcal.integrate(normals, lens, mask=np.hypot(x, y) < 0.7, name="bump")
    albedo = np.stack([0.2 + 0.3 * (x + 1), 0.5 + 0 * x, 0.2 + 0.3 * (y + 1)], axis=-1)
    return replace(found, albedo=np.where(found.mask[..., None], albedo, np.nan), depth_std=np.where(found.mask, 1e-4, np.nan))


@pytest.fixture(scope="module")
def folder(surface: Surface, tmp_path_factory: pytest.TempPathFactory) -> Path:
    target = tmp_path_factory.mktemp("surface")
    names = ["ply", "glb", "obj", "stl", "depth-tiff", "points", "normals"]
    lpcal.export_calibration(target, Calibration("bump", ()), names, surface=surface)
    return target


def points(surface: Surface) -> Array:
    return (surface.rays_C * surface.depth[..., None])[surface.mask]


@pytest.mark.parametrize(
    ("name", "turn", "unit"), [("mesh.ply", 1, 1.0), ("mesh.glb", -1, 1.0), ("obj/mesh.obj", -1, 1.0), ("mesh.stl", -1, 1e3)]
)
def test_trimesh_reads_the_meshes(folder: Path, surface: Surface, name: str, turn: int, unit: float) -> None:
    found = trimesh.load(folder / name, process=False, force="mesh")
    wanted = points(surface) * [1, turn, turn] * unit
    assert np.abs(found.bounds - [wanted.min(axis=0), wanted.max(axis=0)]).max() < 1e-6 * unit
    assert len(found.faces) == len(lpcal.mesh(surface).faces)
    towards = -1 if turn == 1 else 1
    assert (found.face_normals[:, 2] * towards > 0).all(), "every face looks at the camera"


def test_the_texture_lies_on_its_pixels(folder: Path, surface: Surface) -> None:
    found = trimesh.load(folder / "obj" / "mesh.obj", process=False, force="mesh")
    image = cv2.imread(str(folder / "obj" / "albedo.png"))[..., ::-1]
    column = np.rint(found.visual.uv[:, 0] * SIZE[0] - 0.5).astype(int)
    row = np.rint((1 - found.visual.uv[:, 1]) * SIZE[1] - 0.5).astype(int)
    wanted = surface.rays_C[row, column] * surface.depth[row, column][:, None] * [1, -1, -1]
    assert np.abs(found.vertices - wanted).max() < 1e-7
    assert (image[row, column] == lpcal.mesh(surface).colours).all()
    assert found.visual.material.image.size == SIZE


def test_numpy_stl_reads_the_stl_in_millimetres(folder: Path, surface: Surface) -> None:
    stl = reader("stl.mesh")
    found = stl.Mesh.from_file(str(folder / "mesh.stl"))
    size = np.ptp(points(surface), axis=0) * 1e3
    assert np.abs((found.max_ - found.min_) - size).max() < 1e-3
    assert b"mm" in (folder / "mesh.stl").read_bytes()[:80]
    assert not (folder / "mesh.stl").read_bytes().startswith(b"solid"), "it would be read as text"


def test_plyfile_reads_points_with_their_sigma(folder: Path, surface: Surface) -> None:
    plyfile = reader("plyfile")
    found = plyfile.PlyData.read(str(folder / "points.ply"))
    vertex = found["vertex"]
    assert np.abs(np.stack([vertex[axis] for axis in "xyz"], axis=1) - points(surface)).max() < 1e-7
    along = 1e-4 * np.linalg.norm(surface.rays_C, axis=-1)[surface.mask]
    assert np.abs(vertex["sigma"] - along).max() < 1e-9
    assert any("metres" in comment for comment in found.comments)


def test_the_depth_says_its_unit(folder: Path, surface: Surface) -> None:
    with tifffile.TiffFile(folder / "depth_m.tif") as stored:
        pages = [page.asarray() for page in stored.pages]
        said = json.loads(stored.pages[0].description)
    assert said["unit"] == "m"
    np.testing.assert_array_equal(pages[0], surface.depth.astype(np.float32))
    np.testing.assert_array_equal(pages[1], surface.depth_std.astype(np.float32))
    assert np.array_equal(cv2.imread(str(folder / "depth_m.tif"), cv2.IMREAD_UNCHANGED), pages[0], equal_nan=True)


def test_openexr_reads_the_depth(surface: Surface, tmp_path: Path) -> None:
    OpenEXR = reader("OpenEXR")
    lpcal.export_calibration(tmp_path, Calibration("bump", ()), ["depth-exr"], surface=surface)
    with OpenEXR.File(str(tmp_path / "depth_m.exr"), separate_channels=True) as stored:
        channels = {name: one.pixels for name, one in stored.channels().items()}
        said = json.loads(stored.header()["comments"])
    np.testing.assert_array_equal(channels["Z"], surface.depth.astype(np.float32))
    np.testing.assert_array_equal(channels["N.Y"], -surface.normals[..., 1].astype(np.float32))
    assert channels["R"].shape == SIZE[::-1]
    assert said["unit"] == "m"


def test_normal_maps_of_both_greens(folder: Path, surface: Surface) -> None:
    gl, dx = (cv2.imread(str(folder / f"normals_{way}.png"), cv2.IMREAD_UNCHANGED)[..., ::-1] for way in ("gl", "dx"))
    up = gl[surface.mask][:, 1] / 65535 * 2 - 1
    assert np.abs(up + surface.normals[surface.mask][:, 1]).max() < 1e-4
    assert np.abs(gl[surface.mask][:, 1].astype(int) + dx[surface.mask][:, 1] - 65535).max() == 0
    assert (gl[..., [0, 2]] == dx[..., [0, 2]]).all()


def test_a_surface_folder_is_a_source(surface: Surface, tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    from lpcal import write_surface

    write_surface(tmp_path / "bump", surface)
    code, out, err = lpcal("export", "bump", "--format", "stl,points", "-o", "out", cwd=tmp_path)
    assert code == 0, err
    assert "stl: mesh.stl" in out
    assert "a printer needs it closed" in err


@pytest.fixture(scope="module")
def rig(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, tuple[str, str]]:
    target = tmp_path_factory.mktemp("rig")
    (one,) = lpcal.export_calibration(target, calibration(), ["rig-glb"])
    return one.files[0], one.notes


def test_pygltflib_finds_lights_and_camera_where_they_are(rig: tuple[Path, tuple[str, str]]) -> None:
    gltf = reader("pygltflib")
    found = gltf.GLTF2().load(str(rig[0]))
    spots = found.extensions["KHR_lights_punctual"]["lights"]
    placed = {node.name: node for node in found.nodes}
    root = np.diag([1.0, -1, -1])
    for light, spot in zip(lights(), spots, strict=True):
        node = placed[light.name]
        assert np.abs(np.array(node.translation) - light.source_C).max() < 1e-9, "in C, below the node that turns C"
        x, y, z, w = node.rotation
        backward = np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
        assert np.abs(-backward - light.axis_C).max() < 1e-9, "a spot shines along its -z"
        assert np.allclose(np.array(spot["color"]) * spot["intensity"], light.intensity)
        assert 0 < spot["spot"]["innerConeAngle"] < spot["spot"]["outerConeAngle"] <= np.pi / 2
    body = placed["P: the tracked body"]
    assert np.abs(np.array(body.translation) - np.linalg.inv(H_PC)[:3, 3]).max() < 1e-9
    assert found.nodes[0].rotation == pytest.approx([1, 0, 0, 0])
    lens = found.cameras[0].perspective
    assert np.tan(lens.yfov / 2) == pytest.approx(240 / 460.152)
    assert root @ root == pytest.approx(np.eye(3))


def test_a_cone_is_as_near_to_the_lobe_as_it_says(rig: tuple[Path, tuple[str, str]]) -> None:
    said = next(note for note in rig[1] if "cones" in note)
    worst = max(spot_of(light)[1] for light in lights())
    assert f"up to {100 * worst:.2g} %" in said
    assert 0.005 < worst < 0.1


def test_the_validator_of_khronos_finds_nothing(rig: tuple[Path, tuple[str, str]], folder: Path) -> None:
    """npm install gltf-validator in a folder that NODE_PATH names."""
    if shutil.which("node") is None:
        pytest.skip("node is not installed")
    program = (
        "const v = require('gltf-validator'), fs = require('fs');"
        "Promise.all(process.argv.slice(1).map(f => v.validateBytes(new Uint8Array(fs.readFileSync(f)))))"
        ".then(r => console.log(JSON.stringify(r.map(x => x.issues))))"
    )
    found = subprocess.run(["node", "-e", program, str(rig[0]), str(folder / "mesh.glb")], capture_output=True, text=True, check=False)
    if found.returncode:
        pytest.skip("gltf-validator is not installed")
    for issues in json.loads(found.stdout):
        assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


def test_images_go_with_the_lights(tmp_path: Path) -> None:
    """A drawn capture through a bent lens: LUCES' images are those of the pinhole camera, linear, in one scale."""
    from dataclasses import replace

    from lit_scene import Scene, draw
    from lit_scene import calibration as scene_lights

    plain = scene_lights()
    bent = replace(plain, camera=replace(plain.camera, distortion=np.array([-0.2, 0.05, 0.0, 0.0])))
    capture = draw(Scene(), plain)
    for name, pattern in (("luces", "{:02d}.png"), ("near_ps", "photometric_sample_raw_{:04d}.png")):
        (flat,) = lpcal.export_calibration(tmp_path / "flat", plain, [name], capture=capture)
        (one,) = lpcal.export_calibration(tmp_path / "bent", bent, [name], capture=capture)
        assert any("made free of it" in note for note in one.notes)
        images = [cv2.imread(str(Path(each.files[0]) / pattern.format(3)), cv2.IMREAD_UNCHANGED).astype(float) for each in (flat, one)]
        row, column = 20, 30
        u = plain.camera.unproject(np.array([[column, row]], float))
        x, y = bent.camera.project(u)[0]  # where the bent camera saw that ray
        i, j = int(y), int(x)
        corners = images[0][i : i + 2, j : j + 2]
        wanted = np.array([1 - (y - i), y - i]) @ corners @ np.array([1 - (x - j), x - j])
        scale = images[0].max() / images[1].max()
        assert images[1][row, column] * scale == pytest.approx(wanted, rel=0.03)
    (one,) = lpcal.export_calibration(tmp_path / "set", plain, ["diligent"], capture=capture)
    raw = cv2.imread(str(one.files[0] / "L2.png"), cv2.IMREAD_UNCHANGED).astype(float)
    other = cv2.imread(str(one.files[0] / "L4.png"), cv2.IMREAD_UNCHANGED).astype(float)
    stored = capture.images - (capture.ambient.mean(axis=0) if capture.ambient is not None else 0)
    bright = (raw > 20000) & (other > 20000)
    ratio = stored[2][bright] / stored[4][bright]
    assert np.abs(np.median(raw[bright] / other[bright] / ratio) - 1) < 2e-3, "one scale for all images"
