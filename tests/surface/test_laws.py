"""Laws of normals and depth: known surfaces come back, symmetries of the picture are symmetries of the surface, scales scale."""

from __future__ import annotations

import numpy as np
import pytest

import lpcal
from lpcal import methods
from lpcal.geometry.arrays import Array, Mask

SIZE = (40, 48)


def bump(seed: int) -> tuple[Array, Array, Mask]:
    """Depth (H, W) in pixels of a smooth surface, its normals in C, and a round mask."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[: SIZE[0], : SIZE[1]].astype(float)
    centre, width = rng.uniform(0.35, 0.65, 2) * SIZE[::-1], rng.uniform(9, 14)
    tilt = rng.uniform(-0.3, 0.3, 2)
    u, v = x - centre[0], y - centre[1]
    hill = rng.uniform(3, 6) * np.exp(-(u**2 + v**2) / (2 * width**2))
    depth = tilt[0] * x + tilt[1] * y - hill
    slope = np.stack([tilt[0] + hill * u / width**2, tilt[1] + hill * v / width**2], axis=-1)
    n = np.concatenate([slope, -np.ones((*SIZE, 1))], axis=-1)
    mask = (x - SIZE[1] / 2) ** 2 + (y - SIZE[0] / 2) ** 2 < 17**2
    return depth, n / np.linalg.norm(n, axis=-1, keepdims=True), mask


def shape(depth: Array, mask: Mask) -> Array:
    return depth[mask] - depth[mask].mean()


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("integrator", ["lpcal", "poisson"])
def test_gradients_of_a_known_surface_integrate_to_it(seed: int, integrator: str) -> None:
    depth, normals, mask = bump(seed)
    found = lpcal.integrate(normals, mask=mask, integrator=integrator)
    np.testing.assert_allclose(shape(found.depth, mask), shape(depth, mask), atol=0.02 * np.ptp(depth[mask]))
    assert np.isnan(found.depth[~mask]).all()


@pytest.mark.parametrize("seed", range(2))
def test_a_mirrored_picture_is_a_mirrored_surface(seed: int) -> None:
    _, normals, mask = bump(seed)
    found = lpcal.integrate(normals, mask=mask)
    mirrored = lpcal.integrate(normals[:, ::-1] * [-1, 1, 1], mask=mask[:, ::-1])
    np.testing.assert_allclose(shape(mirrored.depth[:, ::-1], mask), shape(found.depth, mask), atol=2e-3 * np.nanstd(found.depth))


def test_depth_scales_with_the_distance_and_its_points_face_the_camera() -> None:
    _, normals, mask = bump(3)
    K = np.array([[60.0, 0, 23.5], [0, 60, 19.5], [0, 0, 1]])
    camera = lpcal.Camera(SIZE[::-1], "opencv5", K, np.zeros(5))
    near, far = (lpcal.integrate(normals, camera, mask, distance_m=distance) for distance in (0.3, 0.9))
    inside = np.isfinite(near.depth) & np.isfinite(far.depth)
    np.testing.assert_allclose(far.depth[inside], 3 * near.depth[inside], rtol=1e-4)
    points = near.depth[..., None] * near.rays_C
    assert (np.sum(near.normals * points, axis=-1)[inside] < 0).mean() > 0.99


def shading(seed: int) -> tuple[methods.Shading, Array]:
    rng = np.random.default_rng(seed)
    lights = rng.normal([0, 0, -1.5], 0.5, (9, 1, 3))
    B = np.broadcast_to(lights / np.linalg.norm(lights, axis=-1, keepdims=True), (9, 50, 3))
    b = rng.normal([0, 0, -1], 0.15, (50, 3)) * rng.uniform(0.2, 0.9, (50, 1))
    signal = np.einsum("lpi,pi->lp", B, b)
    return methods.Shading(signal, np.full_like(signal, 1e-3), np.ones_like(signal, bool), B), b


@pytest.mark.parametrize("name", ["least-squares", "l1", "ranks"])
@pytest.mark.parametrize("seed", range(2))
def test_every_method_is_exact_without_noise_and_scales_with_the_light(name: str, seed: int) -> None:
    seen, b = shading(seed)
    found = methods.NORMALS[name](seen)
    np.testing.assert_allclose(found, b, atol=1e-6)
    brighter = methods.Shading(3 * seen.signal, 3 * seen.sigma, seen.usable, seen.B)
    np.testing.assert_allclose(methods.NORMALS[name](brighter), 3 * b, atol=1e-5)
    order = np.random.default_rng(seed).permutation(9)
    shuffled = methods.Shading(seen.signal[order], seen.sigma[order], seen.usable[order], seen.B[order])
    np.testing.assert_allclose(methods.NORMALS[name](shuffled), found, atol=1e-6)


def test_a_surface_agrees_with_itself_and_a_turn_is_measured() -> None:
    _, normals, mask = bump(1)
    surface = lpcal.integrate(normals, mask=mask)
    same = lpcal.evaluate(surface, np.where(mask[..., None], surface.normals, np.nan))
    assert np.nanmax(same.angle_deg) < 0.05
    angle = np.radians(3.0)
    turn = np.array([[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]])
    turned = lpcal.evaluate(surface, np.where(mask[..., None], surface.normals @ turn.T, np.nan))
    assert 0 < np.nanmax(turned.angle_deg) <= 3.05


def test_a_mesh_stands_on_the_depth_and_faces_the_camera() -> None:
    depth, normals, mask = bump(2)
    mesh = lpcal.mesh(lpcal.integrate(normals, mask=mask))
    assert len(mesh.vertices_C) == mask.sum()
    corners = np.asarray(mesh.vertices_C)[np.asarray(mesh.faces)]
    outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (outward[:, 2] < 0).all()
    assert np.ptp(np.asarray(mesh.vertices_C)[:, 2]) == pytest.approx(np.ptp(depth[mask]), rel=0.05)
