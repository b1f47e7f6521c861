"""``lpcal reconstruct`` from a folder of images to all its files, and what its users do wrong."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import tifffile
import trimesh

from lit_scene import SIZE, Scene, calibration, draw, truth
from lpcal.formats.calibration_yaml import write_calibration
from lpcal.formats.surface_files import read_surface
from lpcal.kernels.library import kernel
from lpcal.records.calibration import Calibration
from lpcal.records.observations import RawCapture
from lpcal.records.provenance import Provenance

FILES = {"surface.npz", "normals_gl.png", "depth.tif", "albedo.png", "mask.png", "mesh.ply", "mesh.glb", "relight.html", "summary.json"}
PANEL = "lpcal: 1\nlights: {L0: {}, L1: {}, L2: {}, L3: {}, L4: {}, L5: {}}\nobjects: {ball: objects/first}\n"


def write_capture(folder: Path, raw: RawCapture) -> Path:
    folder.mkdir(parents=True)
    for name, image in zip(raw.lights, raw.images, strict=True):
        cv2.imwrite(str(folder / f"{name}.png"), np.rint(65535 * image).astype(np.uint16))
    cv2.imwrite(str(folder / "ambient.png"), np.rint(65535 * raw.ambient[0]).astype(np.uint16))
    return folder


@pytest.fixture(scope="module")
def drawn() -> RawCapture:
    return draw(Scene(), calibration())


@pytest.fixture
def rig(tmp_path: Path, drawn: RawCapture) -> Path:
    (tmp_path / "panel.yaml").write_text(PANEL)
    write_calibration(tmp_path / "calib/calibration.yaml", calibration(), Provenance())
    write_capture(tmp_path / "objects/first", drawn)
    return tmp_path


@pytest.fixture
def quick(tmp_path: Path) -> Path:
    """A mask of the ball, which spares the search for it."""
    path = tmp_path / "ball_mask.png"
    cv2.imwrite(str(path), 255 * truth(Scene())[0].astype(np.uint8))
    return path


def test_every_file_of_the_contract(lpcal: Callable[..., tuple[int, str, str]], rig: Path) -> None:
    code, told, _ = lpcal("reconstruct", cwd=rig)
    assert code == 0, told
    assert "ball: " in told
    folder = rig / "surfaces/ball"
    assert {path.name for path in folder.iterdir()} == FILES
    surface = read_surface(folder)
    mask, depth, _ = truth(Scene())
    assert np.median(np.abs(surface.depth - depth)[mask & surface.mask]) < 0.0025

    gl = cv2.imread(str(folder / "normals_gl.png"), cv2.IMREAD_UNCHANGED)[..., ::-1]
    assert gl.dtype == np.uint16
    n = gl[surface.mask] / 65535 * 2 - 1
    assert np.allclose(n * [1, -1, -1], surface.normals[surface.mask], atol=1e-4)
    assert np.all(gl[~surface.mask] == 0)
    assert np.array_equal(tifffile.imread(folder / "depth.tif"), surface.depth, equal_nan=True)
    assert np.array_equal(cv2.imread(str(folder / "mask.png"), 0) > 0, surface.mask)

    ply, glb = trimesh.load(folder / "mesh.ply"), trimesh.load(folder / "mesh.glb", force="mesh")
    assert ply.vertices[:, 2].min() == pytest.approx(0.32, abs=0.003)  # metres, z forward
    assert np.allclose(glb.vertices, ply.vertices * [1, -1, -1], atol=1e-6)
    assert len(ply.visual.vertex_colors) == len(ply.vertices)
    assert np.all(np.sum(ply.vertex_normals * ply.vertices, axis=1) < 0)

    summary = json.loads((folder / "summary.json").read_text())
    assert {"label", "pixels", "mean_depth_m", "scale_std", "alternatives"} == set(summary["components"][0])
    assert {"times_s", "peak_memory_mb", "counts_and_residuals", "versions", "inputs"} <= set(summary)
    assert len(summary["inputs"]["L0.png"]) == 64


@pytest.mark.slow
def test_it_imports_only_what_it_uses(rig: Path, quick: Path) -> None:
    words = ["reconstruct", "--mask", str(quick)]
    program = (
        f"import sys\nfrom lpcal.cli.main import main\nassert main({words!r}) == 0\nprint('imported:', *{{name for name in sys.modules}})"
    )
    ended = subprocess.run([sys.executable, "-c", program], cwd=rig, capture_output=True, text=True, check=True)
    imported = ended.stdout.rpartition("imported: ")[2].split()
    assert "numpy" in imported
    unused = {"matplotlib", "tifffile", "casadi", "pycolmap", "mrcal", "reportlab", "ezc3d", "rosbags", "trimesh", "networkx"}
    unused |= {"scipy"} if kernel("joined") else set()  # it does what no kernel does
    assert not unused & set(imported)


@pytest.mark.slow
def test_a_capture_by_its_folder_takes_the_objects_key_or_its_own_name(
    lpcal: Callable[..., tuple[int, str, str]], rig: Path, drawn: RawCapture, quick: Path
) -> None:
    write_capture(rig / "elsewhere", drawn)
    code, _, told = lpcal("reconstruct", "objects/first", "elsewhere", "--mask", quick, "--lights", "distant", cwd=rig)
    assert code == 0, told
    assert (rig / "surfaces/ball/surface.npz").is_file()
    assert (rig / "surfaces/elsewhere/surface.npz").is_file()


def test_without_a_rig_a_calibration_will_do_and_an_image_that_is_no_lights_is_named(
    lpcal: Callable[..., tuple[int, str, str]], rig: Path, quick: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    away = tmp_path_factory.mktemp("away")
    cv2.imwrite(str(rig / "objects/first/lamp9.png"), np.full((SIZE[1], SIZE[0]), 90, np.uint8))
    code, told, warned = lpcal(
        "reconstruct", rig / "objects/first", "-c", rig / "calib/calibration.yaml", "-o", away / "out", "--mask", quick, "--json", cwd=away
    )
    assert code == 0
    assert json.loads(told)["surfaces"][0]["units"] == "metres"
    assert (away / "out/surface.npz").is_file()
    assert "left out: lamp9.png is no light's" in told + warned


def test_a_mask_in_the_capture_wins_and_a_subset_of_lights_is_taken(
    lpcal: Callable[..., tuple[int, str, str]], rig: Path, quick: Path
) -> None:
    quick.rename(rig / "objects/first/mask.png")
    code, _, told = lpcal("reconstruct", "--use", "L0,L2,L4,L5", "--box", "0,0,160,60", cwd=rig)
    assert code == 0, told
    surface = read_surface(rig / "surfaces/ball")
    row, _ = np.indices(surface.mask.shape)
    assert np.array_equal(surface.mask, truth(Scene())[0] & (row < 60))
    assert np.array_equal(surface.layer, surface.mask.astype(np.uint8))
    assert surface.lights_used.max() == 4


@pytest.mark.slow
def test_one_bad_capture_does_not_stop_the_other(
    lpcal: Callable[..., tuple[int, str, str]], rig: Path, drawn: RawCapture, quick: Path
) -> None:
    noise = 0.002 * np.random.default_rng(1).standard_normal((6, *drawn.ambient.shape[1:]))
    dark = replace(drawn, images=np.clip(drawn.ambient + noise, 0, 1).astype(np.float32))
    write_capture(rig / "objects/dark", dark)
    (rig / "panel.yaml").write_text(PANEL.replace("{ball: objects/first}", "{dark: objects/dark, ball: objects/first}"))
    code, _, told = lpcal("reconstruct", "--mask", quick, "--lights", "distant", cwd=rig)
    assert code == 4
    assert "dark" in told
    assert not (rig / "surfaces/dark").exists()
    assert (rig / "surfaces/ball/surface.npz").is_file()


@pytest.mark.slow
def test_without_an_ambient_image_the_rooms_light_is_estimated_and_said(
    lpcal: Callable[..., tuple[int, str, str]], rig: Path, quick: Path
) -> None:
    lit = draw(Scene(room=0.25), calibration())
    write_capture(rig / "objects/lit", lit)
    (rig / "objects/lit/ambient.png").unlink()
    code, _, told = lpcal("reconstruct", "objects/lit", "--mask", quick, cwd=rig)
    assert code == 0, told
    assert "no ambient image: the room's light was estimated" in told
    assert "not taken away" not in told
    summary = json.loads((rig / "surfaces/lit/summary.json").read_text())
    assert summary["counts_and_residuals"]["ambient"]["estimated"] is True
    depth = truth(Scene())[1]
    surface = read_surface(rig / "surfaces/lit")
    assert abs(np.nanmedian(surface.depth - depth)) < 0.004


def spoil_distance(rig: Path) -> None:
    far = Scene(centre=(0.01, -0.01, 1.2), radius=0.16, wall_z=1.7)
    shutil.rmtree(rig / "objects/first")
    write_capture(rig / "objects/first", draw(far, calibration()))
    cv2.imwrite(str(rig / "objects/first/mask.png"), 255 * truth(far)[0].astype(np.uint8))


def spoil_ambient(rig: Path) -> None:
    cv2.imwrite(str(rig / "objects/first/ambient.png"), np.full((SIZE[1], SIZE[0]), 60000, np.uint16))


def spoil_mask_size(rig: Path) -> None:
    cv2.imwrite(str(rig / "objects/first/mask.png"), np.full((20, 30), 255, np.uint8))


def spoil_mask_empty(rig: Path) -> None:
    cv2.imwrite(str(rig / "objects/first/mask.png"), np.zeros((SIZE[1], SIZE[0]), np.uint8))


def spoil_image_missing(rig: Path) -> None:
    (rig / "objects/first/L3.png").rename(rig / "objects/first/lamp3.png")


def spoil_image_size(rig: Path) -> None:
    for path in (rig / "objects/first").iterdir():
        cv2.imwrite(str(path), cv2.imread(str(path), cv2.IMREAD_UNCHANGED)[:-8])


def spoil_one_images_size(rig: Path) -> None:
    path = rig / "objects/first/L2.png"
    cv2.imwrite(str(path), cv2.imread(str(path), cv2.IMREAD_UNCHANGED)[:, :-4])


def spoil_saturated(rig: Path) -> None:
    for path in (rig / "objects/first").iterdir():
        cv2.imwrite(str(path), np.full((SIZE[1], SIZE[0]), 65535, np.uint16))


def spoil_calibration_nan(rig: Path) -> None:
    path = rig / "calib/calibration.yaml"
    lines = path.read_text().splitlines()
    at = next(k for k, line in enumerate(lines) if "source_m" in line)
    path.write_text("\n".join([*lines[:at], "  source_m: [.nan, 0.0, 0.0]", *lines[at + 1 :]]))


def spoil_calibration_cut(rig: Path) -> None:
    path = rig / "calib/calibration.yaml"
    path.write_text(path.read_text()[: len(path.read_text()) // 2])


def spoil_calibration_gone(rig: Path) -> None:
    (rig / "calib/calibration.yaml").unlink()


def spoil_lights_in_a_row(rig: Path) -> None:
    slopes = np.linspace(-0.5, 0.5, 6)
    lights = tuple(
        replace(light, direction_C=np.array([slope, 0, -1.0]) / np.hypot(slope, 1))
        for slope, light in zip(slopes, calibration().lights, strict=True)
    )
    row: Calibration = replace(calibration(), lights=lights)
    write_calibration(rig / "calib/calibration.yaml", row, Provenance())


@pytest.mark.parametrize(
    ("spoil", "code", "words"),
    [
        (spoil_mask_size, 6, "the mask is 30x20"),
        (spoil_mask_empty, 4, "the mask holds 0 pixels"),
        (spoil_image_missing, 6, "no image of L3"),
        (spoil_image_size, 6, "images of 160x104"),
        (spoil_one_images_size, 6, "L2.png: 156x112 grey, but L0.png is 160x112 grey"),
        (spoil_saturated, 4, "saturated"),
        pytest.param(spoil_distance, 4, "outside the working volume", marks=pytest.mark.slow),
        (spoil_ambient, 6, "the ambient image is brighter than the lit ones"),
        (spoil_calibration_nan, 3, "light L0"),
        (spoil_calibration_cut, 3, "calibration.yaml"),
        (spoil_calibration_gone, 3, "lpcal run"),
        (spoil_lights_in_a_row, 4, "one plane"),
    ],
)
def test_what_is_wrong_is_said_and_nothing_written(
    lpcal: Callable[..., Any], rig: Path, spoil: Callable[..., Any], code: int, words: str
) -> None:
    spoil(rig)
    found, _, told = lpcal("reconstruct", cwd=rig)
    assert found == code, told
    assert words in told
    assert "Traceback" not in told
    assert not list((rig / "surfaces").iterdir() if (rig / "surfaces").exists() else [])


@pytest.mark.parametrize(
    ("words", "files"),
    [
        (("--no-pages",), FILES - {"relight.html"}),
        (("--outputs", "normals, depth"), {"normals_gl.png", "depth.tif"}),
        (("--outputs", "ply,page,maps", "--no-pages"), {"mesh.ply", "surface.npz"}),
        (("--outputs", "page,glb,mask,albedo"), {"relight.html", "mesh.glb", "mask.png", "albedo.png"}),
    ],
)
def test_only_the_files_that_are_asked_for_are_written(
    lpcal: Callable[..., tuple[int, str, str]], rig: Path, quick: Path, words: tuple[Any, ...], files: set[str]
) -> None:
    code, told, _ = lpcal("reconstruct", "--mask", str(quick), "--lights", "distant", "--jobs", "2", *words, cwd=rig)
    assert code == 0, told
    assert {path.name for path in (rig / "surfaces/ball").iterdir()} == files | {"summary.json"}


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        (("--use", "L0,L1"), 4, "2 lights"),
        (("--use", "L0,L1,L9"), 6, "L9"),
        (("--distance", "352"), 2, "bare number"),
        (("--distance", "0mm"), 2, "--distance: 0mm is not over zero"),
        (("--mask", "nowhere.png"), 3, "nowhere.png"),
        (("--box", "10,10,80"), 2, "10,10,80 is not 4 whole numbers"),
        (("--box", "10,10,0,20"), 2, "holds no pixel"),
        (("--box", "10,10,800,20"), 6, "goes beyond the images"),
        (("--point", "a,b"), 2, "a,b is not 2 whole numbers"),
        (("--point", "400,20"), 6, "outside the images of 160x112"),
        (("--box", "0,0,40,40", "--point", "60,20"), 6, "outside the box"),
        (("objects/nothing",), 3, "no such folder"),
        (("--outputs", "normals,dept"), 2, "no output is called dept"),
        (("--outputs", ","), 2, "no word"),
        (("--outputs", "summary"), 2, "some of maps,normals,depth"),
        (("--jobs", "0"), 2, "'0' is no number of cores"),
        (("--jobs", "two"), 2, "'two' is no number of cores"),
        (("--jobs", "-3"), 2, "is no number of cores"),
    ],
)
def test_words_that_are_off(lpcal: Callable[..., tuple[int, str, str]], rig: Path, words: tuple[Any, ...], code: int, message: str) -> None:
    found, _, told = lpcal("reconstruct", *words, cwd=rig)
    assert found == code, told
    assert message in told
