"""Meshes and pages of large pictures, made band by band: the same as in one, and little held at a time."""

from __future__ import annotations

import json
import tracemalloc
from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

import lpcal
from lpcal.formats import mesh_files
from lpcal.formats.surface_files import write_meshes
from lpcal.integration import mesh
from lpcal.records.surface import Surface
from lpcal.report import packing, pictures
from lpcal.report.pictures import bounds, shaded, shrink, shrunk
from lpcal.view import parallel

CAMERA = lpcal.Camera((90, 70), "opencv4", np.array([[100.0, 0, 44], [0, 100, 34], [0, 0, 1]]), np.zeros(4))


def broken(height: int = 70, width: int = 90, camera: lpcal.Camera | None = CAMERA, colours: bool = False) -> Surface:
    """A wavy surface with a hole, a bare border, and breaks here and there."""
    y, x = np.mgrid[:height, :width] / 9.0
    n = np.stack([0.3 * np.sin(x) + 0.2 * np.cos(y + x), 0.2 * np.cos(y + x), -np.ones_like(x)], axis=-1)
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    inside = np.ones((height, width), bool)
    inside[: height // 8] = inside[:, : width // 9] = False
    inside[height // 2 : height // 2 + 6, width // 3 : width // 3 + 9] = False
    made = lpcal.integrate(n, camera, inside)
    rng = np.random.default_rng(4)
    albedo = rng.uniform(0.1, 1, (height, width, 3) if colours else (height, width)).astype(np.float32)
    breaks = made.breaks | (rng.uniform(size=made.breaks.shape) < 0.05)
    return lpcal.Surface(**{one.name: getattr(made, one.name) for one in fields(Surface)} | {"albedo": albedo, "breaks": breaks})


@pytest.mark.parametrize(("camera", "colours"), [(CAMERA, False), (None, True)])
@pytest.mark.parametrize("pixels", [1, 90 * 7, 90 * 69])
def test_a_mesh_is_the_same_in_bands_of_any_height(
    camera: lpcal.Camera | None, colours: bool, pixels: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    surface = broken(camera=camera, colours=colours)
    whole = mesh.build(surface)
    monkeypatch.setattr(parallel, "SAMPLES", pixels)
    found = mesh.build(surface)
    for one in fields(mesh.Mesh):
        assert np.array_equal(getattr(found, one.name), getattr(whole, one.name)), one.name


def test_a_mesh_holds_the_triangles_of_unbroken_corners_and_their_pixels_alone() -> None:
    surface = broken()
    found = mesh.build(surface)
    triangles = {frozenset(map(tuple, found.pixels[corners].tolist())) for corners in found.faces}
    across, down = ~surface.breaks
    expected = set()
    for y, x in np.argwhere(surface.mask[:-1, :-1] & surface.mask[1:, 1:]):
        a, b, c, d = (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)
        legs = {"top": across[y, x], "bottom": across[y + 1, x], "left": down[y, x], "right": down[y, x + 1]}
        corners = [
            (("left", "bottom"), (a, c, d)),
            (("top", "right"), (a, b, d)),
            (("top", "left"), (a, b, c)),
            (("right", "bottom"), (b, c, d)),
        ]
        if sum(legs.values()) == 2:
            expected |= {frozenset(three) for pair, three in corners if all(legs[leg] for leg in pair)}
    assert expected <= triangles
    assert set(np.unique(found.faces)) == set(range(len(found.vertices_C)))
    at = tuple(found.pixels.T[::-1])
    assert surface.mask[at].all()
    np.testing.assert_allclose(found.vertices_C, surface.depth[at][:, None] * surface.rays_C[at], rtol=1e-6)
    assert np.array_equal(found.normals_C, surface.normals[at])


def test_the_files_of_a_mesh_in_bands_hold_the_mesh(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    surface = broken()
    whole = mesh.build(surface)
    monkeypatch.setattr(parallel, "SAMPLES", 90 * 5)
    write_meshes(tmp_path, surface, {"ply", "glb"})
    for name, turn in (("mesh.ply", [1, 1, 1]), ("mesh.glb", [1, -1, -1])):
        found: Any = trimesh.load(tmp_path / name, process=False, force="mesh")
        assert np.array_equal(found.vertices, whole.vertices_C * turn)
        assert np.array_equal(found.faces, whole.faces)


def test_a_mesh_is_written_in_less_memory_than_a_fifth_of_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parallel, "SAMPLES", 4000)
    surface = broken(500, 700, None)
    taken = most_held(lambda: write_meshes(tmp_path, surface, {"ply", "glb"}))
    assert taken < 0.2 * sum(path.stat().st_size for path in tmp_path.iterdir())


def test_a_mesh_that_no_glb_holds_is_left_out_and_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    surface = broken()
    made = mesh.build(surface)
    monkeypatch.setattr(mesh_files, "GLB_MOST", 36 * len(made.vertices_C) + 12 * len(made.faces) - 1)
    lpcal.write_surface(tmp_path / "large", surface)
    assert {path.name for path in (tmp_path / "large").glob("mesh.*")} == {"mesh.ply"}
    (said,) = (note for note in json.loads((tmp_path / "large/summary.json").read_text())["notes"] if "mesh.glb" in note)
    assert f"{len(made.vertices_C)} vertices" in said
    monkeypatch.setattr(mesh_files, "GLB_MOST", 36 * len(made.vertices_C) + 12 * len(made.faces))
    lpcal.write_surface(tmp_path / "just", surface)
    assert (tmp_path / "just/mesh.glb").is_file()


@pytest.mark.parametrize("step", [1, 3])
def test_a_page_is_the_same_in_bands_and_shows_breaks_between_them(step: int, monkeypatch: pytest.MonkeyPatch) -> None:
    surface = broken()
    window = bounds(surface.mask)
    whole = packing.reduced(surface, window, step)
    cut = packing.breaks_of(surface, window)
    monkeypatch.setattr(packing, "BAND_PIXELS", 90 * 2)
    found = packing.reduced(surface, window, step)
    for one in fields(packing.Reduced):
        assert np.array_equal(getattr(found, one.name), getattr(whole, one.name)), one.name
    if step == 1:
        assert np.array_equal(found.breaks, cut[..., 0] + 2 * cut[..., 1])
        scales = packing.Scales.of(found, surface.depth[surface.mask])
        assert sum(rows for rows, _ in packing.bands(surface, window, 1, scales)) == len(whole.mask)


def test_a_small_picture_is_the_same_in_bands(monkeypatch: pytest.MonkeyPatch) -> None:
    surface = broken()
    whole = shrink(shaded(surface.normals), surface.mask, 30)
    monkeypatch.setattr(pictures, "BAND_BLOCKS", 2)
    assert np.array_equal(shrunk(lambda rows, columns: shaded(surface.normals[rows, columns]), surface.mask, 30), whole)


def most_held(work: Callable[[], object]) -> int:
    """Bytes that work holds at the most, beyond what is held before."""
    tracemalloc.start()
    try:
        work()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
