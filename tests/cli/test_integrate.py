"""``lpcal integrate``: depth from normals alone, against truth, against bilateral normal integration, and what its users do wrong."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import tifffile

from bilateral_twin import depth_of
from lit_scene import SIZE, K, Scene, calibration, truth
from lpcal.formats.calibration_yaml import write_calibration
from lpcal.formats.surface_files import read_surface
from lpcal.integration.of_normals import surface_of_normals
from lpcal.records.calibration import Camera
from lpcal.records.provenance import Provenance


def diligent(folder: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """K, mask, normals in C, depth in mm."""
    mask = cv2.imread(str(folder / "mask.png"), cv2.IMREAD_UNCHANGED).reshape(512, 612, -1).max(axis=2) > 0
    stored = cv2.imread(str(folder / "normal_map.png"), cv2.IMREAD_UNCHANGED)
    n = (stored[..., ::-1] / np.iinfo(stored.dtype).max * 2 - 1) * [1, -1, -1]
    with np.load(folder / "depth_gt.npz") as depth:
        return np.loadtxt(folder / "K.txt"), mask, n, depth[depth.files[0]]


def error_mm(found: np.ndarray, depth: np.ndarray, mask: np.ndarray) -> float:
    return float(np.mean(np.abs(found * np.median(depth[mask] / found[mask]) - depth)[mask]))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "published_mm"),
    [
        ("bear", 0.334),
        ("pot2", 0.220),
        pytest.param("goblet", 9.018, marks=pytest.mark.xfail(strict=True, reason="9.9 mm in four pieces that nothing holds together")),
    ],
)
def test_depth_from_true_normals_beats_what_is_published(data: Callable[[str], Path], name: str, published_mm: float) -> None:
    K_file, mask, n, depth = diligent(data(f"surface/diligent_depth/{name}"))
    camera = Camera((612, 512), "opencv4", K_file, np.zeros(4))
    assert error_mm(surface_of_normals(name, n, mask, camera, 1.5).depth, depth, mask) <= published_mm


@pytest.mark.slow
@pytest.mark.parametrize("name", ["buddha", "pot2"])
def test_depth_from_true_normals_beats_the_twin(data: Callable[[str], Path], name: str) -> None:
    K_file, mask, n, depth = diligent(data(f"surface/diligent_depth/{name}"))
    camera = Camera((612, 512), "opencv4", K_file, np.zeros(4))
    own = error_mm(surface_of_normals(name, n, mask, camera, 1.5).depth, depth, mask)
    twin = error_mm(depth_of(n, mask, K_file), depth, mask)
    assert twin < 1.5
    assert own <= twin


def sphere_normals() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    mask, depth, n = truth(Scene())
    return mask, depth, np.where(mask[..., None], n, np.nan)


def write(path: Path, n: np.ndarray) -> Path:
    """Normals in C, in whatever form the name's ending says; images hold x right, y up, z to the camera."""
    gl = n * [1, -1, -1]
    if path.suffix == ".npz":
        np.savez(path, normals=n)
    elif path.suffix == ".npy":
        np.save(path, gl)
    elif path.suffix == ".tif":
        tifffile.imwrite(path, np.nan_to_num(gl).astype(np.float32), photometric="rgb")
    else:
        coded = np.where(np.isfinite(gl), np.rint((gl + 1) / 2 * 65535), 0).astype(np.uint16)
        cv2.imwrite(str(path), coded[..., ::-1])
    return path


@pytest.mark.parametrize("name", ["ball.npz", "ball.npy", "ball.png", "ball.tif"])
def test_every_form_gives_the_same_surface(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, name: str) -> None:
    mask, depth, n = sphere_normals()
    write_calibration(tmp_path / "calibration.yaml", calibration(), Provenance())
    code, told, wrong = lpcal("integrate", write(tmp_path / name, n), "-c", "calibration.yaml", "--distance", "330mm", cwd=tmp_path)
    assert code == 0, wrong
    assert told.strip().endswith("-> surfaces/ball")
    surface = read_surface(tmp_path / "surfaces/ball")
    both = mask & surface.mask
    assert both.sum() > 0.99 * mask.sum()
    assert np.median(surface.depth[both]) == pytest.approx(0.33, rel=1e-5)
    scaled = surface.depth * np.median(depth[both] / surface.depth[both])
    assert np.median(np.abs(scaled - depth)[both]) < 3e-4  # of 40 mm
    for file in ("mesh.ply", "mesh.glb", "depth.tif", "normals_gl.png", "summary.json"):
        assert (tmp_path / "surfaces/ball" / file).is_file()


def test_without_a_camera_depth_is_in_pixels_and_up_is_up(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    row, column = np.indices((60, 80), dtype=float)
    z = 0.3 * column - 0.2 * row
    n = np.tile(np.array([0.3, -0.2, -1.0]) / np.sqrt(1.13), (60, 80, 1))
    code, told, wrong = lpcal("integrate", write(tmp_path / "slope.png", n), "-o", tmp_path / "out", "--json", cwd=tmp_path)
    assert code == 0, wrong
    assert json.loads(told)["surfaces"][0]["units"] == "pixels"
    surface = read_surface(tmp_path / "out")
    assert np.std((surface.depth - z)[surface.mask]) < 0.01


def test_a_jump_is_kept_and_cuts_the_mesh() -> None:
    camera = replace(calibration().camera, distortion=np.zeros(4))
    row, column = np.indices(SIZE[::-1], dtype=float)
    rays = np.stack([(column - K[0, 2]) / K[0, 0], (row - K[1, 2]) / K[1, 1], np.ones_like(row)], axis=-1)
    ball, ball_depth, n = truth(Scene())
    floor = np.array([0.0, -0.6, -0.8])  # a slope behind the ball: it joins the ball nowhere but in the picture
    back = 0.8 * -0.45 / (rays @ floor)
    n = np.where(ball[..., None], n, floor)
    surface = surface_of_normals("both", n, np.ones(SIZE[::-1], bool), camera, 0.4)
    for part, depth in ((ball, ball_depth), (~ball, back)):
        scale = np.median(depth[part] / surface.depth[part])
        assert np.median(np.abs(scale * surface.depth - depth)[part]) < 1e-3


def spoil_form(folder: Path) -> Path:
    np.save(folder / "n.npy", np.zeros((20, 30)))
    return folder / "n.npy"


def spoil_zeros(folder: Path) -> Path:
    np.save(folder / "n.npy", np.full((40, 40, 3), np.nan))
    return folder / "n.npy"


def spoil_cut(folder: Path) -> Path:
    np.savez(folder / "n.npz", normals=np.ones((40, 40, 3)))
    (folder / "n.npz").write_bytes((folder / "n.npz").read_bytes()[:200])
    return folder / "n.npz"


def spoil_size(folder: Path) -> Path:
    return write(folder / "n.npz", np.tile([0.0, 0.0, -1.0], (40, 40, 1)))


@pytest.mark.parametrize(
    ("spoil", "code", "words"),
    [
        (spoil_form, 3, "20x30"),
        (spoil_zeros, 3, "no normals"),
        (spoil_cut, 3, "needed: a whole .npz or .npy file"),
        (spoil_size, 6, "40x40"),
        (lambda folder: folder / "nowhere.npz", 3, "nowhere.npz"),
    ],
)
def test_what_is_wrong_is_said_and_nothing_written(
    lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, spoil: Callable[..., Any], code: int, words: str
) -> None:
    write_calibration(tmp_path / "calibration.yaml", calibration(), Provenance())
    found, _, told = lpcal("integrate", spoil(tmp_path), "-c", "calibration.yaml", "-o", "out", cwd=tmp_path)
    assert found == code, told
    assert words in told
    assert not (tmp_path / "out").exists()
