"""A drawn scene, made with more detail than the solver's model, through the whole reconstruction."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lit_scene import SIZE, Scene, calibration, draw, truth
from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.formats.capture import read_capture
from lpcal.formats.import_lights import read_lights
from lpcal.integration import mesh
from lpcal.records.surface import Surface
from lpcal.surface.reconstruct import Options, reconstruct
from relight_ball import ball


def angle_deg(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.degrees(2 * np.arcsin(np.clip(np.linalg.norm(a - b, axis=-1) / 2, 0, 1)))


@pytest.fixture(scope="module")
def sphere() -> Surface:
    return reconstruct(to_radiance(draw(Scene(), calibration()), Sensor()), calibration(), Options())


def test_the_sphere_is_found_before_the_wall(sphere: Surface) -> None:
    mask = truth(Scene())[0]
    assert (sphere.mask & mask).sum() / (sphere.mask | mask).sum() > 0.95


def test_normals_depth_and_their_sigmas(sphere: Surface) -> None:
    mask, depth, n = truth(Scene())
    both = mask & sphere.mask
    error = angle_deg(sphere.normals, n)[both]
    assert np.median(error) < 1.5
    assert np.median(np.abs(sphere.depth - depth)[both]) < 0.0025
    sigma = sphere.normal_std_deg[both]
    assert np.mean(error <= 2 * sigma) > 0.7
    assert np.median(error) > 0.2 * np.median(sigma)  # a clean sphere has none of what a sigma counts besides noise, but is no exact one
    (piece,) = sphere.components
    scale = np.sum(sphere.depth[both] * depth[both]) / np.sum(sphere.depth[both].astype(float) ** 2)
    assert abs(scale - 1) < 2.5 * piece.scale_std < 0.05


def test_every_map_is_nan_outside_and_normals_face_the_camera(sphere: Surface) -> None:
    for values in (sphere.normals, sphere.depth, sphere.albedo, sphere.normal_std_deg, sphere.depth_std):
        assert np.isnan(values[~sphere.mask]).all()
        assert np.isfinite(values[sphere.mask]).all()
    assert np.all(np.sum(sphere.normals * sphere.rays_C, axis=-1)[sphere.mask] < 0)
    assert np.allclose(np.linalg.norm(sphere.normals[sphere.mask], axis=1), 1, atol=1e-5)
    assert set(np.unique(sphere.component[sphere.mask])) == {1}
    assert np.all(sphere.component[~sphere.mask] == 0)


def test_the_mesh_faces_the_camera_and_is_cut_at_the_outline(sphere: Surface) -> None:
    made = mesh.build(sphere)
    a, b, c = (made.vertices_C[made.faces[:, k]].astype(float) for k in range(3))
    normal = np.cross(b - a, c - a)
    assert np.all(np.sum(normal * a, axis=1) < 0)
    assert np.linalg.norm(b - a, axis=1).max() < 0.02
    assert len(made.vertices_C) == len(made.normals_C) == len(made.colours)
    assert len(made.vertices_C) > 0.97 * sphere.mask.sum()


def test_a_surface_that_states_no_breaks_is_cut_where_its_mask_ends() -> None:
    whole = ball(perspective=True)
    assert whole.breaks.size == 0
    made = mesh.build(whole)
    stated = mesh.build(replace(whole, breaks=mesh.ends_of(whole.mask)))
    np.testing.assert_array_equal(made.faces, stated.faces)
    sides = made.vertices_C[made.faces].astype(float)
    assert np.linalg.norm(np.diff(sides, axis=1), axis=-1).max() < 0.03
    assert len(made.vertices_C) > 0.97 * whole.mask.sum()


@pytest.mark.slow
def test_colour_gives_the_same_shape_and_the_colours() -> None:
    scene = Scene(albedo=(0.8, 0.5, 0.2))
    mask, _, n = truth(scene)
    found = reconstruct(to_radiance(draw(scene, calibration()), Sensor()), calibration(), Options(mask=mask))
    both = mask & found.mask
    assert np.median(angle_deg(found.normals, n)[both]) < 1.5
    colour = np.median(found.albedo[both], axis=0)
    assert colour / colour[0] == pytest.approx([1, 0.625, 0.25], rel=0.03)


@pytest.mark.slow
def test_gloss_is_told_from_shading() -> None:
    scene = Scene(gloss=0.6)
    radiance = to_radiance(draw(scene, calibration()), Sensor())
    mask, _, n = truth(scene)
    found = reconstruct(radiance, calibration(), Options(mask=mask))
    both = mask & found.mask
    assert np.median(angle_deg(found.normals, n)[both]) < 2.0
    assert np.mean(angle_deg(found.normals, n)[both] > 10) < 0.12


def card() -> Scene:
    return Scene(centre=None, wall_z=0.35, wall_albedo=0.7)


def sag_mm(found: Surface) -> float:
    """How far a flat card's points stray from a plane, rms."""
    points = (found.rays_C * found.depth[..., None])[found.mask]
    centred = points - points.mean(axis=0)
    return float(1e3 * np.std(centred @ np.linalg.svd(centred, full_matrices=False)[2][2]))


@pytest.mark.slow
def test_a_flat_card_is_a_bowl_under_distant_lights_and_flat_under_near_ones() -> None:
    radiance = to_radiance(draw(card(), calibration()), Sensor())
    middle = np.zeros((SIZE[1], SIZE[0]), bool)
    middle[30:82, 50:110] = True  # about 120 x 105 mm
    near = reconstruct(radiance, calibration(), Options(mask=middle))
    distant = reconstruct(radiance, calibration(), Options(mask=middle, near=False))
    assert sag_mm(near) < 0.3
    assert sag_mm(distant) > 1.0
    assert np.median(near.depth[middle]) == pytest.approx(0.35, abs=0.002)


@pytest.mark.slow
def test_a_card_that_fills_the_image_is_the_object() -> None:
    found = reconstruct(to_radiance(draw(card(), calibration()), Sensor()), calibration(), Options())
    assert found.mask.mean() > 0.8
    assert "one plane" in str(found.figures.mask)


def test_without_a_camera_there_are_normals_and_a_depth_in_pixels() -> None:
    scene = Scene(centre=(0, 0, 4.0), radius=0.8, wall_z=6.0)
    lights = calibration()
    far = replace(lights, camera=None, lights=tuple(replace(light, source_C=None, axis_C=None) for light in lights.lights))
    rng = np.random.default_rng(0)
    row, column = np.indices((100, 100))
    x, y = (column - 49.5) / 40, (row - 49.5) / 40
    mask = x**2 + y**2 < 0.9
    n = np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0.05))], axis=-1)
    signal = np.stack([0.6 * np.maximum(n @ light.direction_C, 0) * light.intensity[0] for light in far.lights]) * mask
    raw = replace(draw(scene, lights), images=(signal + 0.002 * rng.standard_normal(signal.shape)).astype(np.float32), ambient=None)
    found = reconstruct(to_radiance(replace(raw, mask=mask), Sensor()), far, Options())
    assert np.median(angle_deg(found.normals, n)[mask]) < 1.0
    expected = -40 * np.sqrt(np.maximum(1 - x**2 - y**2, 0))
    error = (found.depth - expected)[mask]
    assert np.std(error) < 0.8  # pixels, of a dome 27 pixels high


@pytest.mark.slow
def test_a_known_distance_is_kept() -> None:
    radiance = to_radiance(draw(Scene(), calibration()), Sensor())
    found = reconstruct(radiance, calibration(), Options(mask=truth(Scene())[0], distance_m=0.5))
    assert np.median(found.depth[found.component == 1]) == pytest.approx(0.5, rel=1e-3)


def test_what_cannot_be_reconstructed_says_why() -> None:
    radiance = to_radiance(draw(Scene(), calibration()), Sensor())
    few = replace(radiance, lights=("L0", "L1"), signal=radiance.signal[:2], sigma=radiance.sigma[:2], saturated=radiance.saturated[:2])
    with pytest.raises(DegenerateError, match="2 lights"):
        reconstruct(few, calibration(), Options())
    with pytest.raises(DegenerateError, match="mask holds 0 pixels"):
        reconstruct(radiance, calibration(), Options(mask=np.zeros((SIZE[1], SIZE[0]), bool)))
    small = replace(calibration(), camera=replace(calibration().camera, image_size=(640, 480)))
    with pytest.raises(DisagreementError, match="160x112"):
        reconstruct(radiance, small, Options())
    slopes = np.linspace(-1, 1, 6)
    row = tuple(
        replace(light, direction_C=np.array([slope, 0, -1.0]) / np.hypot(slope, 1))
        for slope, light in zip(slopes, calibration().lights, strict=True)
    )
    with pytest.raises(DegenerateError, match="one plane"):
        reconstruct(radiance, replace(calibration(), lights=row), Options())


@pytest.mark.slow
@pytest.mark.parametrize(("name", "use", "most"), [("ball", range(1, 97), 2.0), ("bear", range(21, 97), 6.5)])
def test_diligent(data: Callable[[str], Path], name: str, use: Any, most: float) -> None:
    folder = data(f"surface/diligent_{name}")
    _, lights = read_lights(folder)
    raw = read_capture(folder, [light.name for light in lights.lights], use=[f"{k:03d}" for k in use])
    found = reconstruct(to_radiance(raw, Sensor()), lights, Options())
    with np.load(folder / "normal_gt.npz") as stored:
        n = stored[stored.files[0]] * [1, -1, -1]
    both = found.mask & (np.linalg.norm(n, axis=-1) > 0.5)
    assert angle_deg(found.normals, n)[both].mean() <= most
