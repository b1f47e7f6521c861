"""Laws that geometry holds whatever the numbers: groups, symmetries, scalings, closed forms and their inverses, on drawn seeds."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from lpcal.geometry import camera, lambert, led_cluster, light_field, park, pose_track, rigid_fit, se3, sphere, tone_curve, wing
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Light
from lpcal.records.lobes import LedCluster, Lobe

SEEDS = range(6)


def drawn(seed: int, count: int, spread: float = 0.6) -> Array:
    """Transforms (count, 4, 4), turned by about a radian and shifted by half a metre."""
    return se3.exp(np.random.default_rng(seed).normal(0, spread, (count, 6)))


@pytest.mark.parametrize("seed", SEEDS)
def test_transforms_are_a_group(seed: int) -> None:
    A, B, C = drawn(seed, 3)
    np.testing.assert_allclose((A @ B) @ C, A @ (B @ C), atol=1e-14)
    np.testing.assert_allclose(se3.inv(A @ B), se3.inv(B) @ se3.inv(A), atol=1e-14)
    np.testing.assert_allclose(se3.exp(np.zeros(6)), np.eye(4), atol=0)
    np.testing.assert_allclose(se3.adjoint(A @ B), se3.adjoint(A) @ se3.adjoint(B), atol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_transforms_act_on_points_and_directions(seed: int) -> None:
    rng = np.random.default_rng(seed)
    A, B = drawn(seed, 2)
    x, y = rng.normal(0, 1, (2, 7, 3))
    np.testing.assert_allclose(se3.apply(A @ B, x), se3.apply(A, se3.apply(B, x)), atol=1e-13)
    np.testing.assert_allclose(se3.apply(A, x) - se3.apply(A, y), se3.rotate(A, x - y), atol=1e-13)
    np.testing.assert_allclose(np.linalg.norm(se3.apply(A, x) - se3.apply(A, y), axis=1), np.linalg.norm(x - y, axis=1), atol=1e-13)


@pytest.mark.parametrize("seed", SEEDS)
def test_exp_along_one_twist_adds(seed: int) -> None:
    rng = np.random.default_rng(seed)
    xi = rng.normal(0, 0.7, 6)
    s, t = rng.uniform(-1, 1, 2)
    np.testing.assert_allclose(se3.exp((s + t) * xi), se3.exp(s * xi) @ se3.exp(t * xi), atol=1e-13)
    np.testing.assert_allclose(se3.inv(se3.exp(xi)), se3.exp(-xi), atol=1e-13)


@pytest.mark.parametrize("seed", SEEDS)
def test_either_sign_and_any_length_of_a_quaternion_is_one_rotation(seed: int) -> None:
    rng = np.random.default_rng(seed)
    q = rng.normal(0, 1, 4)
    np.testing.assert_allclose(se3.rotation_from_quaternion(-3.7 * q), se3.rotation_from_quaternion(q), atol=1e-13)
    R = se3.rotation_from_quaternion(q)
    np.testing.assert_allclose(se3.nearest_rotation(1.3 * R), R, atol=1e-13)


@pytest.mark.parametrize(("seed", "axes"), list(itertools.product(range(2), ["zyx", "xyz", "zyz"])))
def test_three_angles_are_three_turns(seed: int, axes: str) -> None:
    angles = np.random.default_rng(seed).uniform(-1.5, 1.5, (5, 3))
    each = [se3.rotation(np.eye(3)["xyz".index(axis)] * angles[:, [k]]) for k, axis in enumerate(axes)]
    np.testing.assert_allclose(se3.rotation_about_axes(angles, axes), each[0] @ each[1] @ each[2], atol=1e-13)
    if axes == "zyx":
        np.testing.assert_allclose(se3.angles_about_zyx(se3.rotation_about_axes(angles, axes)), angles, atol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_interpolated_poses_do_not_depend_on_the_rooms_axes(seed: int) -> None:
    H, W = drawn(seed, 5, 0.3), drawn(seed + 100, 1)[0]
    t_s, asked_s = np.arange(5.0), np.array([0.0, 0.4, 2.7, 4.0])
    between = se3.interpolate(H, t_s, asked_s)
    np.testing.assert_allclose(se3.interpolate(W @ H, t_s, asked_s), W @ between, atol=1e-12)
    np.testing.assert_allclose(between[[0, 3]], H[[0, 4]], atol=1e-12)
    backwards = se3.interpolate(H[::-1], t_s, 4.0 - asked_s)
    np.testing.assert_allclose(backwards, between, atol=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_a_body_that_turns_steadily_is_met_between_its_samples(seed: int) -> None:
    rng = np.random.default_rng(seed)
    phi, velocity = rng.normal(0, 0.5, 3), rng.normal(0, 0.3, 3)
    t_s = np.arange(60) / 100

    def pose(times_s: Array) -> Array:
        return se3.transform(se3.rotation(phi * times_s[:, None]), velocity * times_s[:, None])

    track = pose_track.clean(t_s, pose(t_s), np.full(60, np.nan))
    asked_s = np.array([0.1034, 0.2511, 0.4077])
    np.testing.assert_allclose(pose_track.poses_at(track, asked_s).H, pose(asked_s), atol=1e-9)


K = np.array([[712.4, 0, 385.1], [0, 713.1, 230.6], [0, 0, 1.0]])
LENSES = [np.zeros(5), np.array([-0.3, 0.12, 0.0007, -0.0005, 0.01]), np.array([-0.2, 0.05, 0.001, 0.0, 0.01, 0.01, 0.02, 0.003])]


@pytest.mark.parametrize("distortion", LENSES)
def test_projection_knows_no_scale_and_pixels_follow_k(distortion: Array) -> None:
    rng = np.random.default_rng(4)
    x_C = np.column_stack([rng.uniform(-0.4, 0.4, (40, 2)), np.ones(40)])
    pixels = camera.project(x_C, K, distortion)
    np.testing.assert_allclose(camera.project(x_C * rng.uniform(0.1, 9, (40, 1)), K, distortion), pixels, atol=1e-9)
    halved = np.diag([0.5, 0.5, 1.0]) @ K
    np.testing.assert_allclose(camera.project(x_C, halved, distortion), pixels / 2, atol=1e-9)
    rays = camera.unproject(pixels, K, distortion)
    np.testing.assert_allclose(np.linalg.norm(rays, axis=1), 1, atol=1e-14)
    assert (rays[:, 2] > 0).all()
    np.testing.assert_allclose(camera.project(rays, K, distortion), pixels, atol=1e-8)


def test_a_round_lens_without_tangential_terms_knows_no_roll() -> None:
    rng = np.random.default_rng(5)
    plane = rng.uniform(-0.4, 0.4, (40, 2))
    turn = se3.rotation(np.array([0, 0, 0.7]))[:2, :2]
    lens = np.array([-0.3, 0.12, 0.0, 0.0, 0.01])
    np.testing.assert_allclose(camera.distort(plane @ turn.T, lens), camera.distort(plane, lens) @ turn.T, atol=1e-14)


LOBES = [
    Lobe(),
    Lobe("cosine", exponent=2.7),
    Lobe("table", angle_rad=np.radians([0, 20, 40, 60, 90]), value=np.array([1, 0.97, 0.8, 0.4, 0.0])),
]


@pytest.mark.parametrize("lobe", LOBES, ids=lambda lobe: lobe.kind)
def test_a_lobe_is_one_on_its_axis_never_negative_and_even(lobe: Lobe) -> None:
    angle_rad = np.linspace(0, np.pi, 181)
    value = lobe(angle_rad)
    assert lobe(np.zeros(1))[0] == pytest.approx(1, abs=1e-12)
    assert (value >= 0).all()
    assert (value <= 1 + 1e-12).all()
    assert (np.diff(value) <= 1e-12).all()  # these three fall off, and a cubic through a table keeps that
    np.testing.assert_allclose(lobe(-angle_rad[:90]), value[:90], atol=1e-12)


@pytest.mark.parametrize("lobe", LOBES, ids=lambda lobe: lobe.kind)
@pytest.mark.parametrize("seed", range(3))
def test_irradiance_falls_with_the_square_and_knows_no_axes(lobe: Lobe, seed: int) -> None:
    rng = np.random.default_rng(seed)
    axis = rng.normal(0, 1, 3)
    axis /= np.linalg.norm(axis)
    source, intensity = rng.normal(0, 0.2, 3), rng.uniform(0.5, 2, 1)
    light = Light("L", -axis, intensity, source_C=source, axis_C=axis, lobe=lobe)
    away = axis + 0.4 * rng.normal(0, 1, (9, 3))
    x = source + 0.3 * away
    direction, irradiance = light.field(x)
    np.testing.assert_allclose(np.linalg.norm(direction, axis=-1), 1, atol=1e-12)
    np.testing.assert_allclose(light.field(source + 0.6 * away)[1], irradiance / 4, rtol=1e-9)
    H = drawn(seed, 1)[0]
    moved = Light(
        "L", -se3.rotate(H, axis), intensity, source_C=se3.apply(H, source[None])[0], axis_C=se3.rotate(H, axis[None])[0], lobe=lobe
    )
    there, as_much = moved.field(se3.apply(H, x))
    np.testing.assert_allclose(as_much, irradiance, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(there, se3.rotate(H, direction), atol=1e-9)


@pytest.mark.parametrize("leds", [1, 7, 19])
def test_a_cluster_far_away_is_its_mean_lobe_and_its_light_adds(leds: int) -> None:
    axes = led_cluster.led_axes(leds)
    np.testing.assert_allclose(np.linalg.norm(axes, axis=1), 1, atol=1e-12)
    m = led_cluster.exponent(led_cluster.HALF_POWER_RAD)
    cluster = LedCluster(0.01 * axes, axes, np.ones(leds), m)
    x_L = np.array([[0.02, 0.01, 0.3], [-0.1, 0.05, 0.4]])
    direction, irradiance = led_cluster.cluster_field(x_L, cluster.position_L, axes, np.ones(leds), m)
    each = [led_cluster.cluster_field(x_L, cluster.position_L[[k]], axes[[k]], np.ones(1), m) for k in range(leds)]
    total = sum(d * E[..., None] for d, E in each)
    np.testing.assert_allclose(direction * irradiance[..., None], total, atol=1e-9 * float(irradiance.max()))
    around = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    for angle in (0.0, 0.4, 0.9):
        far = 1e3 * np.stack([np.sin(angle) * np.cos(around), np.sin(angle) * np.sin(around), np.full_like(around, np.cos(angle))], axis=1)
        mean = led_cluster.cluster_field(far, cluster.position_L, axes, np.ones(leds), m)[1].mean()
        ahead = led_cluster.cluster_field(1e3 * np.array([[0, 0, 1.0]]), cluster.position_L, axes, np.ones(leds), m)[1][0]
        assert mean / ahead == pytest.approx(float(led_cluster.mean_lobe(np.array([angle]), leds)[0]), rel=2e-3)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_mirror_turns_back_what_it_turned_and_shows_the_light_where_it_reflects(seed: int) -> None:
    rng = np.random.default_rng(seed)
    u, n = rng.normal(0, 1, (2, 8, 3))
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    np.testing.assert_allclose(sphere.reflect(sphere.reflect(u, n), n), u, atol=1e-12)
    np.testing.assert_allclose(np.sum(sphere.reflect(u, n) * n, axis=1), -np.sum(u * n, axis=1), atol=1e-12)
    centre, radius = np.array([0.02, -0.03, 0.4]) + rng.normal(0, 0.02, 3), 0.03
    light = rng.normal([0, 0, -0.1], 0.1, (5, 3))
    P = sphere.mirror_point(centre, radius, light)
    normal = (P - centre) / radius
    np.testing.assert_allclose(np.linalg.norm(normal, axis=1), 1, atol=1e-9)
    to_light = light - P
    seen = sphere.reflect(P / np.linalg.norm(P, axis=1, keepdims=True), normal)
    np.testing.assert_allclose(seen, to_light / np.linalg.norm(to_light, axis=1, keepdims=True), atol=1e-8)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_spheres_outline_gives_its_centre_at_every_scale(seed: int) -> None:
    rng = np.random.default_rng(seed)
    centre, radius = np.array([0.05, -0.02, 0.5]) + rng.normal(0, 0.05, 3), 0.025
    rays = sphere.outline(centre, radius, np.linspace(0, 2 * np.pi, 12, endpoint=False))
    np.testing.assert_allclose(sphere.from_outline(rays, radius), centre, atol=1e-10)
    np.testing.assert_allclose(sphere.from_outline(rays, 3 * radius), 3 * centre, atol=1e-9)
    tangent, _ = sphere.meet(rays * (1 - 1e-12), centre, radius * (1 + 1e-9))
    np.testing.assert_allclose(np.linalg.norm(tangent - centre, axis=1), radius, rtol=1e-4)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_wings_axis_meets_the_discs_where_it_says(seed: int) -> None:
    rng = np.random.default_rng(seed)
    setting = np.column_stack([rng.uniform(0, 2 * np.pi, 4), rng.uniform(0.2, 1.2, 4), rng.uniform(0.05, 0.2, (4, 2))])
    H_DL, d = wing.wing_transform(setting), wing.d_object(setting)
    met = np.stack([np.zeros(4), np.zeros(4), d], axis=1) - H_DL[:, :3, 3]
    np.testing.assert_allclose(np.cross(met, H_DL[:, :3, 2]), 0, atol=1e-12)
    turned = setting + np.array([0.8, 0, 0, 0])
    np.testing.assert_allclose(wing.wing_transform(turned), se3.exp(np.array([0, 0, 0.8, 0, 0, 0])) @ H_DL, atol=1e-12)


@pytest.mark.parametrize("gamma", [1.0, 1.8, 2.2, "srgb"])
def test_a_tone_curve_is_undone_and_keeps_the_order(gamma: tone_curve.Gamma) -> None:
    linear = np.linspace(0, 1, 101)
    stored = tone_curve.encode(linear, gamma)
    np.testing.assert_allclose(tone_curve.decode(stored, gamma), linear, atol=1e-6)
    assert (np.diff(stored) > 0).all()
    assert (stored[0], stored[-1]) == (pytest.approx(0, abs=1e-9), pytest.approx(1, abs=1e-6))


@pytest.mark.parametrize("seed", SEEDS)
def test_the_closed_form_is_exact_and_follows_the_frames(seed: int) -> None:
    H_OP, (H_PC, H_OB, W, B) = drawn(seed, 8), drawn(seed + 50, 4)
    H_CB = se3.inv(H_OP @ H_PC) @ H_OB
    found_PC, found_OB = park.park(H_OP, H_CB)
    np.testing.assert_allclose(found_PC, H_PC, atol=1e-9)
    np.testing.assert_allclose(found_OB, H_OB, atol=1e-9)
    again_PC, again_OB = park.park(W @ H_OP, H_CB @ B)  # another room, another board frame
    np.testing.assert_allclose(again_PC, H_PC, atol=1e-9)
    np.testing.assert_allclose(again_OB, W @ H_OB @ B, atol=1e-9)
    angle, distance = park.residuals(H_OP, H_CB, H_PC, H_OB)
    np.testing.assert_allclose([*angle, *distance], 0, atol=1e-7)


@pytest.mark.parametrize("seed", SEEDS)
def test_points_in_two_frames_give_the_transform_and_their_sigma_scales(seed: int) -> None:
    rng = np.random.default_rng(seed)
    H_AB, x_B = drawn(seed, 1)[0], rng.normal(0, 0.1, (6, 3))
    found, _, rest = rigid_fit.fit(se3.apply(H_AB, x_B), x_B, 1e-3)
    np.testing.assert_allclose(found, H_AB, atol=1e-12)
    np.testing.assert_allclose(rest, 0, atol=1e-12)
    one, three = (rigid_fit.fit(se3.apply(H_AB, x_B), x_B, sigma)[1] for sigma in (1e-3, 3e-3))
    np.testing.assert_allclose(three, 9 * one, rtol=1e-9)
    assert (np.linalg.eigvalsh(one) > 0).all()


@pytest.mark.parametrize("seed", SEEDS)
def test_shading_is_linear_in_the_signal_and_inverse_in_the_light(seed: int) -> None:
    rng = np.random.default_rng(seed)
    B = rng.normal([0, 0, -2.0], 1, (5, 9, 3))
    b = rng.normal([0, 0, -1.0], 0.1, (9, 3))
    signal, weight = np.einsum("lpi,pi->lp", B, b), rng.uniform(0.5, 2, (5, 9))
    np.testing.assert_allclose(lambert.weighted(B, signal, weight)[0], b, atol=1e-9)
    np.testing.assert_allclose(lambert.weighted(B, 2.5 * signal, weight)[0], 2.5 * b, atol=1e-9)
    np.testing.assert_allclose(lambert.weighted(4 * B, signal, weight)[0], b / 4, atol=1e-9)
    covariance, tighter = (lambert.weighted(B, signal, factor * weight)[1] for factor in (1.0, 4.0))
    np.testing.assert_allclose(tighter, covariance / 4, rtol=1e-9)  # a quarter of the variance: sigmas half as large
    normals, albedo = lambert.unit(b)
    np.testing.assert_allclose(normals * albedo[:, None], b, atol=1e-12)


def test_a_distant_light_is_the_limit_of_near_ones() -> None:
    x = np.array([[0.0, 0.0, 0.0], [0.1, -0.05, 0.02]])
    toward = np.array([0.3, -0.2, -0.9])
    toward /= np.linalg.norm(toward)
    for far in (1e2, 1e4):
        d, r, _ = light_field.near_light(x, far * toward, -toward)
        np.testing.assert_allclose(d, np.broadcast_to(toward, d.shape), atol=0.3 / far)
        np.testing.assert_allclose(far**2 / r**2, 1, atol=0.5 / far)
