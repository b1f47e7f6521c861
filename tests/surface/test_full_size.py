"""Captures that are too large to be held: coarse pixels first, then tile by tile, with next to nothing in memory."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

import lpcal
from lit_scene import Scene, calibration, draw, truth
from lpcal.api.full_size import BinnedCamera
from lpcal.errors import UsageError
from lpcal.formats import full_size
from lpcal.formats.capture import read_capture
from lpcal.formats.full_size import Scratch
from lpcal.records.full_images import PART
from lpcal.surface.coarse_solution import between
from lpcal.surface.full_size import _ramp, tiles
from lpcal.view.parallel import cores

S = np.array([[0.5, 0, -1], [-0.25, 0.45, -1], [-0.25, -0.45, -1], [0.0, 0.0, -1], [0.3, 0.3, -1]])
S /= np.linalg.norm(S, axis=1, keepdims=True)
DOME = lpcal.Calibration("dome", tuple(lpcal.Light(f"L{k}", s, np.ones(1)) for k, s in enumerate(S)))


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Captures count as large from 50,000 samples, coarse pictures are of 4,000 pixels."""
    monkeypatch.setattr(full_size, "HELD", 50_000)
    monkeypatch.setattr(full_size, "COARSE_PIXELS", 4_000)


@pytest.mark.parametrize("colours", [(), (3,)])
def test_parts_of_images_come_back_as_they_were_kept(colours: tuple[Any, ...]) -> None:
    images = np.random.default_rng(1).integers(0, 60000, (3, 2 * PART + 17, PART + 90, *colours)).astype(np.uint16)
    store = Scratch(images.shape, images.dtype)
    for k in (2, 0, 1):
        store.keep(k, images[k])
    for rows, columns in ((slice(0, 5), slice(0, 5)), (slice(100, 260), slice(120, 218)), (slice(PART, 2 * PART), slice(0, PART))):
        assert np.array_equal(store.read(slice(None), rows, columns), images[:, rows, columns])
        assert np.array_equal(store.read(slice(1, 3), rows, columns), images[1:, rows, columns])


@pytest.mark.parametrize(("size", "side", "margin"), [((50, 70), 20, 4), ((9, 9), 20, 4), ((300, 130), 64, 10)])
def test_tiles_hold_every_pixel_once_and_their_ramps_add_up_to_one(size: tuple[int, int], side: int, margin: int) -> None:
    count, total = np.zeros(size), np.zeros(size)
    for row in tiles(size, side, margin):
        for tile in row:
            count[tile.core] += 1
            total[tile.outer] += _ramp(tile, size, margin)
            assert np.zeros(size)[tile.outer][tile.within].shape == count[tile.core].shape
    assert np.all(count == 1)
    np.testing.assert_allclose(total, 1, atol=1e-6)


@pytest.mark.parametrize("factor", [2, 3, 7])
def test_between_coarse_pixels_a_slope_stays_a_slope(factor: int) -> None:
    row, column = np.mgrid[: 9 * factor, : 12 * factor]
    whole = 3.0 * row - 2.0 * column
    coarse = full_size.blocks(whole, factor).mean(axis=(1, 3))
    rows, columns = slice(2 * factor, 5 * factor + 1), slice(factor, 9 * factor)
    np.testing.assert_allclose(between(coarse, factor, rows, columns), whole[rows, columns], atol=1e-5)


@pytest.mark.parametrize("factor", [2, 5])
def test_a_coarse_pixel_looks_where_the_middle_of_its_pixels_looks(factor: int) -> None:
    camera = lpcal.Camera((100, 60), "opencv4", np.array([[90.0, 0, 49], [0, 91, 31], [0, 0, 1]]), np.array([0.1, -0.05, 1e-3, 0]))
    binned = BinnedCamera.of(camera, factor)
    middle = (factor - 1) / 2
    for at in ([0, 0], [7, 3], [100 // factor - 1, 60 // factor - 1]):
        ray = binned.unproject(np.array([at], float))
        np.testing.assert_allclose(ray, camera.unproject(factor * np.array([at], float) + middle), atol=1e-12)
        np.testing.assert_allclose(binned.project(ray), [at], atol=1e-6)
    assert binned.image_size == (100 // factor, 60 // factor)


def ball(shape: tuple[int, int], colours: bool = False) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mask, normals and linear images of a ball under the dome's lights."""
    y, x = (np.mgrid[: shape[0], : shape[1]] - np.reshape(shape, (2, 1, 1)) / 2) / (0.4 * min(shape))
    inside = x**2 + y**2 < 0.9
    n = np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0.1))], axis=-1)
    noise = 1e-3 * np.random.default_rng(5).standard_normal((len(S), *inside.shape))
    images = np.where(inside, 0.7 * np.clip(np.einsum("lc,hwc->lhw", S, n), 0, 1), 0) + 0.02 + noise
    return inside, n, images[..., None] * [0.9, 0.7, 0.5] if colours else images


def written(folder: Path, images: np.ndarray, ambient: np.ndarray | None, mask: np.ndarray | None, names: list[str]) -> Path:
    """A capture folder of 16 bit images."""
    folder.mkdir()
    shown = [*zip(names, images, strict=True), *([] if ambient is None else [("ambient", ambient)])]
    for name, image in shown:
        stored = np.rint(65535 * np.clip(image, 0, 1)).astype(np.uint16)
        cv2.imwrite(str(folder / f"{name}.png"), stored[..., ::-1] if stored.ndim == 3 else stored)
    if mask is not None:
        cv2.imwrite(str(folder / "mask.png"), 255 * mask.astype(np.uint8))
    return folder


@pytest.mark.parametrize("colours", [False, True])
def test_a_large_capture_gives_the_ball_that_a_small_one_gives(small: None, tmp_path: Path, colours: bool) -> None:
    mask, n, images = ball((203, 251), colours)
    ambient = np.full(mask.shape, 0.02)[..., None] * [0.9, 0.7, 0.5] if colours else np.full(mask.shape, 0.02)
    folder = written(tmp_path / "ball", images, ambient, mask, ["L0", "L1", "L2", "L3", "L4"])
    raw = read_capture(folder, [light.name for light in DOME.lights])
    assert raw.full is not None
    assert raw.size == (251, 203)
    assert raw.images.shape[1:3] == (203 // raw.full.factor, 251 // raw.full.factor)
    found = []
    for count in (1, 3):
        with cores(count):
            found.append(lpcal.reconstruct(raw, DOME, method="distant"))
    surface, again = found
    for name in ("normals", "depth", "albedo", "normal_std_deg", "depth_std", "breaks"):
        assert getattr(surface, name).tobytes() == getattr(again, name).tobytes()
    assert np.array_equal(surface.mask, mask)
    assert np.array_equal(np.isfinite(surface.depth), mask)
    error = np.degrees(np.arccos(np.clip(np.sum(surface.normals * n, axis=-1)[mask], -1, 1)))
    assert np.median(error) < 0.6
    assert np.mean(error < 2 * surface.normal_std_deg[mask]) > 0.8
    z = -0.4 * 203 * np.sqrt(np.maximum(1 - ((n[..., 0]) ** 2 + n[..., 1] ** 2), 0.1))
    inner = mask & (n[..., 2] < -0.5)
    apart = surface.depth[inner] - z[inner]
    assert np.std(apart - np.median(apart)) < 0.02 * np.ptp(z[inner])
    albedo = surface.albedo[inner]
    assert np.allclose(np.median(albedo, axis=0), np.array([0.9, 0.7, 0.5]) * 0.7 if colours else 0.7, rtol=0.03)


def test_near_lights_put_a_large_capture_where_they_put_a_small_one(small: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(full_size, "COARSE_PIXELS", 6_000)
    lights, scene = calibration(), Scene(radius=0.045)
    raw = draw(scene, lights)
    names = [light.name for light in lights.lights]
    on, depth, n = truth(scene)
    folder = written(tmp_path / "ball", raw.images, raw.ambient[0], on, names)
    large = read_capture(folder, names)
    assert large.full is not None
    surface = lpcal.reconstruct(large, lights, distance_m=float(np.median(depth[on])))
    inner = on & (n[..., 2] < -0.4)
    assert abs(np.median(surface.depth[inner] / depth[inner]) - 1) < 0.006
    error = np.degrees(np.arccos(np.clip(np.sum(surface.normals * n, axis=-1)[inner], -1, 1)))
    assert np.median(error) < 1.0


def test_where_the_numbers_end_a_coarse_pixel_is_saturated(small: None, tmp_path: Path) -> None:
    _, _, images = ball((203, 251))
    images[1, 100:103, 120:123] = 1.0
    folder = written(tmp_path / "ball", images, None, None, ["L0", "L1", "L2", "L3", "L4"])
    raw = read_capture(folder, [light.name for light in DOME.lights])
    assert raw.full is not None
    factor = raw.full.factor
    assert raw.images[1, 101 // factor, 121 // factor] == 1.0
    assert np.sum(raw.images >= 1.0 - 1e-6) <= 9


def test_a_method_to_compare_with_is_refused_for_a_large_capture(small: None, tmp_path: Path) -> None:
    mask, _, images = ball((203, 251))
    folder = written(tmp_path / "ball", images, None, mask, ["L0", "L1", "L2", "L3", "L4"])
    with pytest.raises(UsageError, match="too large"):
        lpcal.reconstruct(read_capture(folder, ["L0", "L1", "L2", "L3", "L4"]), DOME, method="l1")


@pytest.mark.parametrize("given", ["argument", "capture", "found"])
def test_an_object_of_many_samples_is_solved_as_a_large_capture_is(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, given: str) -> None:
    monkeypatch.setattr(full_size, "COARSE_PIXELS", 4_000)
    mask, n, images = ball((203, 251))
    names = [light.name for light in DOME.lights]
    folder = written(tmp_path / "ball", images, np.full(mask.shape, 0.02), mask if given == "capture" else None, names)
    held = read_capture(folder, names)
    assert held.full is None
    monkeypatch.setattr(full_size, "HELD", 50_000)
    by = {"mask": mask} if given == "argument" else {}
    large = lpcal.reconstruct(read_capture(folder, names), DOME, method="distant", **by)
    monkeypatch.setattr("lpcal.api.surfaces.SOLVED", 50_000)
    surface = lpcal.reconstruct(held, DOME, method="distant", **by)
    for name, most in {"normals": 1e-3, "depth": 5e-3, "albedo": 1e-3, "normal_std_deg": 1e-2, "mask": 0}.items():
        np.testing.assert_allclose(getattr(surface, name), getattr(large, name), rtol=0, atol=most, err_msg=name)
    monkeypatch.setattr("lpcal.api.surfaces.SOLVED", 10**9)
    at_once = lpcal.reconstruct(held, DOME, method="distant", **by)
    assert not np.array_equal(at_once.normals[mask], surface.normals[mask])
    both = mask & at_once.mask & surface.mask & (n[..., 2] < -0.4)
    assert np.median(np.degrees(np.arccos(np.clip(np.sum(at_once.normals * surface.normals, axis=-1)[both], -1, 1)))) < 0.3


def test_a_method_to_compare_with_takes_what_is_held(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("lpcal.api.surfaces.SOLVED", 50_000)
    mask, _, images = ball((203, 251))
    surface = lpcal.reconstruct(np.clip(images, 0, 1), DOME, ambient=np.full(mask.shape, 0.02), mask=mask, method="l1")
    assert np.isfinite(surface.normals[mask]).mean() > 0.5
