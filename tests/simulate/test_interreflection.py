"""Interreflected light of a simulated scene: known form factors, an integrating sphere, nothing where nothing is seen."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from lpcal.simulate import picture
from lpcal.simulate.leds import LedLight
from lpcal.simulate.lens import Lens
from lpcal.simulate.picture import ThrownLight, gather, render, thrown
from lpcal.simulate.scene import DrawnScene, Points, direct
from lpcal.simulate.shapes import SHAPES, Shape, grain, sphere

RADIUS_M = 0.05
DEPTH_M = 0.06
WIDTH_M = 0.08
LENS = Lens((120, 90), np.array([[130.0, 0, 60], [0, 130, 45], [0, 0, 1]]), np.zeros(5))


def lamp(position_C: tuple[float, float, float]) -> LedLight:
    """One LED that shines alike in every direction, intensity 1."""
    at = np.array([position_C])
    return LedLight("L0", np.eye(4), at, np.array([[0.0, 0, 1]]), np.ones(1), 0.0, 1.0, at[0])


def before_wall(shape: Shape, light: LedLight, wall: float = 0.0, z_m: float = 0.3) -> DrawnScene:
    H_CS = np.eye(4)
    H_CS[2, 3] = z_m
    return DrawnScene(shape, H_CS, np.array([0, 0, z_m + 1.3 * shape.bound_m]), np.array([0, 0, -1.0]), wall, (light,), 0.0)


def box(low: tuple[float, ...], high: tuple[float, ...]) -> Callable[[np.ndarray], np.ndarray]:
    """Signed distance of a box."""
    middle, half = (np.array(low) + high) / 2, (np.array(high) - low) / 2

    def whole(x_S: np.ndarray) -> np.ndarray:
        q = np.abs(x_S - middle[:, None]) - half[:, None]
        return np.linalg.norm(np.maximum(q, 0), axis=0) + np.minimum(q.max(axis=0), 0)

    return whole


def corner(albedo: float) -> Shape:
    """Two plates at right angles: one faces -z, the other, before it, faces -y; they meet in the x axis."""
    half, t = WIDTH_M / 2, 0.002
    back, below = box((-half, -DEPTH_M, 0), (half, 0, t)), box((-half, 0, -DEPTH_M), (half, t, 0))
    return Shape("corner", 0.085, (back, below), albedo=albedo, texture=0.0)


def on_back(scene: DrawnScene, y_m: np.ndarray, x_m: np.ndarray | float = 0.0) -> Points:
    """Points of the plate that faces the camera, y_m above the edge."""
    x_C = np.stack([np.broadcast_to(x_m, y_m.shape), -y_m, np.full(len(y_m), scene.H_CS[2, 3])], axis=1)
    return Points(x_C, np.tile([0.0, 0, -1], (len(y_m), 1)), np.full(len(y_m), scene.shape.albedo), np.ones(len(y_m), bool))


def test_the_share_of_rays_is_the_form_factor_of_a_rectangle() -> None:
    """Differential element to a rectangle at right angles to it, J. R. Howell's catalogue of configuration factors, B-5."""
    scene = before_wall(corner(0.5), lamp((0, 0, 0)))
    y_m = np.array([0.002, 0.005, 0.01, 0.02, 0.04])
    rays = 8192
    ends, owner = gather(scene, on_back(scene, y_m), rays)
    share = np.bincount(owner, minlength=len(y_m)) / rays
    slant = np.hypot(DEPTH_M, y_m)
    half = WIDTH_M / 2
    factor = (np.arctan(half / y_m) - y_m / slant * np.arctan(half / slant)) / np.pi
    np.testing.assert_allclose(share, factor, atol=0.004)
    np.testing.assert_allclose(ends.x_C[:, 1], 0, atol=1e-4)
    assert np.mean(ends.n_C[:, 1] < -0.9999) > 0.999  # but for ends on its very rim


def test_one_bounce_in_a_corner_is_the_integral_over_the_other_plate(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture, "BOUNCES", 1)
    scene = before_wall(corner(0.6), lamp((0.02, -0.03, 0.1)))
    y_m, x_m = (one.ravel() for one in np.meshgrid(np.linspace(0.008, 0.05, 12), np.linspace(-0.03, 0.03, 12)))
    nodes = on_back(scene, y_m, x_m)
    side = (np.arange(240) + 0.5) / 240
    x, z = (one.ravel() for one in np.meshgrid((side - 0.5) * WIDTH_M, scene.H_CS[2, 3] - side * DEPTH_M))
    x_C = np.stack([x, np.zeros_like(x), z], axis=1)
    plate = Points(x_C, np.tile([0.0, -1, 0], (len(x), 1)), np.full(len(x), 0.6), np.ones(len(x), bool))
    L = direct(scene, plate, scene.lights[0])
    to = x_C - nodes.x_C[:, None]
    r2 = np.sum(to**2, axis=-1)
    kernel = np.maximum(-to[..., 2], 0) * np.maximum(-(nodes.x_C[:, None, 1] - x_C[:, 1]), 0) / (np.pi * r2**2)
    expected = kernel @ L * WIDTH_M * DEPTH_M / len(x)
    found = thrown(scene, nodes).J[:, 0]
    assert found.mean() == pytest.approx(expected.mean(), rel=0.01)
    assert np.std(found / expected) < 0.16  # 64 rays each


@pytest.mark.parametrize("albedo", [0.8, pytest.param(0.3, marks=pytest.mark.slow)])
def test_an_integrating_sphere_keeps_its_energy(albedo: float) -> None:
    """Whatever the lamp's place, the walls get 4 pi I / (4 pi R^2) on the mean, and rho of it again with every bounce, all over alike."""

    def hollow(x_S: np.ndarray) -> np.ndarray:
        return np.asarray(RADIUS_M - np.linalg.norm(x_S, axis=0))

    shape = Shape("hollow", 1.05 * RADIUS_M, (hollow,), albedo=albedo, texture=0.0)
    scene = before_wall(shape, lamp((0.02, 0.01, 0.29)))
    n = np.random.default_rng(0).standard_normal((800, 3))
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    walls = Points(RADIUS_M * n + scene.H_CS[:3, 3], -n, np.full(len(n), albedo), np.ones(len(n), bool))
    found = thrown(scene, walls).J[:, 0]
    once = albedo / np.pi / RADIUS_M**2
    assert found.mean() == pytest.approx(once * (1 - albedo**picture.BOUNCES) / (1 - albedo), rel=0.01)
    assert found.mean() < 1.005 * once / (1 - albedo)
    assert found.std() / found.mean() < 0.03


@pytest.mark.parametrize("shape", [sphere(0.04), SHAPES["card"](0.05)], ids=["sphere", "card"])
def test_a_convex_object_alone_throws_nothing_on_itself(shape: Shape) -> None:
    scene = before_wall(shape, lamp((0.1, 0, 0)))
    picture = render(LENS, scene)
    dark = render_direct(scene)
    np.testing.assert_array_equal(picture.light, dark)
    assert picture.light.max() > 0


def test_a_wall_lights_the_rim_of_a_ball_and_not_its_middle() -> None:
    scene = before_wall(sphere(0.04), lamp((0.1, 0, 0)), wall=0.5)
    picture = render(LENS, scene)
    more = (picture.light - render_direct(scene))[0]
    facing = -picture.normals[..., 2]
    assert more.min() > -1e-12
    assert np.all(more[facing > 0.999] < 1e-4 * picture.light.max())
    assert np.median(more[facing < 0.4]) > 0.002 * picture.light.max()


@pytest.mark.parametrize("name", sorted(SHAPES))
def test_no_surface_gives_back_more_than_it_gets(name: str) -> None:
    shape = SHAPES[name](0.05)
    waves = grain(shape.texture_length_m, np.random.default_rng(1))
    textured = Shape(shape.note, shape.bound_m, shape.pieces, shape.albedo, shape.texture, shape.texture_length_m, waves)
    reflectance = textured.reflectance(np.random.default_rng(2).uniform(-0.05, 0.05, (20000, 3)))
    assert 0.3 < reflectance.min() <= reflectance.max() < 0.95


def test_hollows_of_a_relief_gain_light_by_a_share_of_what_the_rest_has() -> None:
    scene = before_wall(SHAPES["relief"](0.06), lamp((0.12, 0.02, 0.0)), wall=0.3)
    before, after = render_direct(scene)[0], render(LENS, scene)
    more, on = after.light[0] - before, after.mask
    assert more[on].sum() > 0.01 * before[on].sum()
    assert more[on].sum() < 0.75 * before[on].sum()
    flat = on & (after.normals[..., 2] < -0.999) & (before > 0.5 * before.max())
    assert np.median(more[flat] / before[flat]) < 0.1


def test_means_over_nodes_keep_to_their_side() -> None:
    rng = np.random.default_rng(5)
    x = rng.uniform(-0.02, 0.02, (400, 3)) * [1, 1, 0] + [0, 0, 0.3]
    on = np.arange(400) < 200
    nodes = Points(x, np.tile([0.0, 0, -1], (400, 1)), np.full(400, 0.7), on)
    J = np.where(on, 2.0, 5.0)[:, None]
    found = ThrownLight(nodes, J, 0.002).at(nodes)
    np.testing.assert_allclose(found, J.T, rtol=1e-12)
    linear = ThrownLight(nodes, x[:, :1] * np.where(on, 1, -1)[:, None], 0.002).at(nodes)
    assert np.abs(linear[0] - x[:, 0] * np.where(on, 1, -1)).max() < 0.006


def render_direct(scene: DrawnScene) -> np.ndarray:
    """The images without interreflected light."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("lpcal.simulate.picture.thrown", lambda scene, nodes: None)
        return render(LENS, scene).light
