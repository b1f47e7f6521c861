"""Wings, spheres and the lights' geometry: laws, and errors within the stated sigma on scenes that know more than the solver."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import minimize

from lights_scene import CAMERA, DISC_SIGMA, DRAWN, RADIUS_M, SETTING_SIGMA, Scene
from lpcal.chain.h_pl_wings import camera_in_disc, design_lights
from lpcal.chain.refine_lights import as_designed, refine
from lpcal.chain.refine_lights.geometry_fit import BIAS_PX, fit_geometry
from lpcal.chain.refine_lights.measure import measure_centre, outline_errors
from lpcal.chain.refine_lights.swaps import fit_with_clicks
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import led_cluster, se3, sphere
from lpcal.geometry.wing import d_object, wing_jacobian, wing_transform
from lpcal.records.observations import SphereView


def test_wing_kinematics_are_the_contracts() -> None:
    a, g, d1, d2 = np.radians(40), np.radians(30), 0.104, 0.085
    H_DL = wing_transform(np.array([a, g, d1, d2]))
    turn = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
    np.testing.assert_allclose(H_DL[:3, 3], turn @ [d1 + d2 * np.cos(g), 0, d2 * np.sin(g)], atol=1e-12)
    np.testing.assert_allclose(H_DL[:3, 2], turn @ [-np.sin(g), 0, np.cos(g)], atol=1e-12)
    reach = d_object(np.array([a, g, d1, d2]))
    along = H_DL[:3, 3] + H_DL[:3, 2] * (np.hypot(*H_DL[:2, 3]) / np.sin(g))
    np.testing.assert_allclose(along, [0, 0, reach], atol=1e-12)
    assert np.isinf(d_object(np.array([a, 0.0, d1, d2])))


def test_wing_jacobian_is_the_derivative_of_the_left_perturbation() -> None:
    setting, step = np.array([0.7, 0.5, 0.104, 0.085]), np.array([1e-4, -2e-4, 1e-5, 3e-5])
    H_DL = wing_transform(setting)
    np.testing.assert_allclose(se3.log(wing_transform(setting + step) @ se3.inv(H_DL)), wing_jacobian(setting) @ step, atol=2e-8)


def test_the_mocap_pose_cancels() -> None:
    rng = np.random.default_rng(3)
    H_OP, H_PC, H_PD = (se3.exp(rng.normal(size=6) * 0.5) for _ in range(3))
    H_DL = wing_transform(np.array([0.3, 0.5, 0.1, 0.08]))
    H_PL = H_PD @ H_DL
    H_OL = H_OP @ H_PL
    np.testing.assert_allclose(se3.inv(H_OP @ H_PC) @ H_OL, se3.inv(H_PC) @ H_PL, atol=1e-12)
    H_CD, _ = camera_in_disc(H_PC, np.eye(6) * 1e-8, H_PD, np.eye(6) * 1e-8)
    np.testing.assert_allclose(H_CD @ H_DL, se3.inv(H_PC) @ H_PL, atol=1e-12)


def test_design_covariance_is_the_spread_of_wings_built_within_tolerance() -> None:
    rng = np.random.default_rng(4)
    H_CD = se3.exp(np.array([0.02, -0.01, 0.03, 0.001, 0.002, -0.004]))
    wings = design_lights(DRAWN, H_CD, np.diag(DISC_SIGMA**2), SETTING_SIGMA, "test")
    settings = np.array([[w.azimuth_rad, w.joint_angle_rad, w.d1_m, w.d2_m] for w in DRAWN])
    errors = []
    for _ in range(3000):
        moved = se3.exp(rng.normal(size=6) * DISC_SIGMA) @ H_CD @ wing_transform(settings + rng.normal(size=settings.shape) * SETTING_SIGMA)
        errors.append(se3.log(moved @ se3.inv(wings.H_CL)).ravel())
    spread = np.cov(np.array(errors).T)
    np.testing.assert_allclose(np.sqrt(np.diag(spread)), np.sqrt(np.diag(wings.covariance)), rtol=0.06)
    std = np.sqrt(np.diag(spread))
    shared, stated = spread / np.outer(std, std), wings.covariance / np.outer(std, std)
    np.testing.assert_allclose(shared, stated, atol=5 / np.sqrt(3000))


def test_sphere_outline_and_mirror_agree_with_brute_force() -> None:
    centre_C, light_C = np.array([0.03, -0.02, 0.35]), np.array([0.17, 0.01, 0.02])
    rays = sphere.outline(centre_C, RADIUS_M, np.linspace(0, 6, 40))
    gap = np.linalg.norm(np.cross(rays, centre_C), axis=1)
    np.testing.assert_allclose(gap, RADIUS_M, atol=1e-12)
    np.testing.assert_allclose(sphere.from_outline(rays, RADIUS_M), centre_C, atol=1e-10)
    P = sphere.mirror_point(centre_C, RADIUS_M, light_C)

    def path(angles: np.ndarray) -> float:  # Fermat: the light's way by the mirror is stationary
        toward = -centre_C / np.linalg.norm(centre_C)
        e1 = np.cross(toward, [0, 1, 0])
        e1 /= np.linalg.norm(e1)
        n = toward + angles[0] * e1 + angles[1] * np.cross(toward, e1)
        at = centre_C + RADIUS_M * n / np.linalg.norm(n)
        return float(np.linalg.norm(at) + np.linalg.norm(light_C - at))

    best = minimize(path, np.zeros(2), method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-14})
    assert np.isclose(best.fun, np.linalg.norm(P) + np.linalg.norm(light_C - P), atol=1e-9)


def test_led_sum_reaches_the_papers_half_power_angles() -> None:
    for leds, full_deg in ((7, 30.0), (19, 52.5)):
        angle = np.radians(np.linspace(0, 50, 2001))
        half = 2 * np.degrees(angle[np.argmin(np.abs(led_cluster.mean_lobe(angle, leds) - 0.5))])
        assert abs(half - full_deg) < 5.0


def test_sources_and_frames_lie_within_their_sigma() -> None:
    nees, axes_deg, stated_deg = [], [], []
    for seed in range(24):
        scene = Scene(seed)
        fit = fit_geometry([w.name for w in DRAWN], scene.views, [measure_centre(v, CAMERA) for v in scene.views], CAMERA, scene.wings)
        error = (fit.source_C - scene.source_C)[:, :2]  # across: along the axis the LEDs' tilts move what a point can be
        for k in range(6):
            block = fit.source_covariance[3 * k : 3 * k + 2, 3 * k : 3 * k + 2]
            nees.append(error[k] @ np.linalg.solve(block, error[k]))
            stated_deg.append(np.degrees(np.sqrt(np.trace(fit.frame_covariance[k][:2, :2]))))
        axes_deg += np.degrees(np.arccos(np.clip(np.sum(fit.H_CL[:, :3, 2] * scene.H_CL[:, :3, 2], axis=1), -1, 1))).tolist()
    assert 0.7 < np.mean(nees) < 3.2  # 2 expected; the LEDs' scatter is in the scene and not in the model
    ratio = np.sqrt(np.mean(np.square(axes_deg)) / np.mean(np.square(stated_deg)))
    assert 0.8 < ratio < 1.25
    assert np.sqrt(np.mean(np.square(axes_deg))) < 0.85  # the drawing alone leaves 1 deg


def test_more_spheres_do_not_make_it_worse() -> None:
    rms, scenes = [], [Scene(100 + seed, 4) for seed in range(16)]
    for count in (1, 2, 4):
        errors = []
        for scene in scenes:
            views = scene.views[:count]
            fit = fit_geometry([w.name for w in DRAWN], views, [measure_centre(v, CAMERA) for v in views], CAMERA, scene.wings)
            errors.append(np.sqrt(np.mean((fit.source_C - scene.source_C) ** 2)))
        rms.append(np.sqrt(np.mean(np.square(errors))))
    assert rms[1] < 1.05 * rms[0]
    assert rms[2] < 1.05 * rms[1]


@pytest.mark.parametrize("seen_deg", [360, 240, 150])
def test_how_sure_a_centre_is_follows_how_much_of_its_outline_is_seen(seen_deg: int) -> None:
    rng, scatter_px, centre_C = np.random.default_rng(1), 0.1, np.array([0.03, -0.02, 0.40])
    around = np.radians(np.arange(0, seen_deg))
    points = CAMERA.project(sphere.outline(centre_C, RADIUS_M, around))
    middle = CAMERA.project(centre_C[None])[0]
    outward = (points - middle) / np.linalg.norm(points - middle, axis=1, keepdims=True)
    known_px = outline_errors("chrome", float(np.linalg.norm(points - middle, axis=1).mean()), scatter_px).bias_px
    apart = np.abs((around[:, None] - around + np.pi) % (2 * np.pi) - np.pi)
    root = np.linalg.cholesky(np.exp(-apart / np.radians(6)) + 1e-9 * np.eye(len(around)))
    squares = []
    for _ in range(100):
        moved = points + (known_px + scatter_px * root @ rng.normal(size=len(around)))[:, None] * outward
        found = measure_centre(SphereView("ball", "chrome", RADIUS_M, moved, scatter_px), CAMERA)
        error = found.centre_C - centre_C
        squares.append(error @ np.linalg.solve(found.covariance, error) / 3)
    assert 0.4 < np.mean(squares) < 1.5


@pytest.mark.parametrize("radius_px", [16.0, 24.0, 36.0])
def test_a_small_chrome_outline_is_smaller_by_the_same_share(radius_px: float) -> None:
    large = BIAS_PX["chrome"][0] + outline_errors("chrome", 47.0, 0.1).bias_px
    seen = BIAS_PX["chrome"][0] + outline_errors("chrome", radius_px, 0.1).bias_px
    assert seen / radius_px == pytest.approx(large / 47.0, rel=1e-6)


def test_free_lights_are_found_from_spheres_alone() -> None:
    scene = Scene(7)
    found = refine(scene.views, [w.name for w in DRAWN], CAMERA, None)
    error = np.array([light.source_C for light in found.lights]) - scene.source_C
    sigma = np.array([light.position_std_m for light in found.lights])
    assert np.sqrt(np.mean(error**2)) < 3 * np.sqrt(np.mean(sigma**2))
    assert np.linalg.norm(error, axis=1).max() < 0.03


def test_a_light_that_no_sphere_shows_is_named() -> None:
    with pytest.raises(DegenerateError, match="L9"):
        refine(Scene(8).views, ["L0", "L9"], CAMERA, None)


def test_a_sphere_of_another_radius_is_named_and_left_out() -> None:
    scene = Scene(9)
    odd = scene.views[2]
    views = [
        *scene.views[:2],
        SphereView(odd.name, odd.kind, 0.030, odd.outline_px, odd.outline_sigma_px, odd.highlights_px, odd.highlight_sigma_px),
        scene.views[3],
    ]
    found = refine(views, [w.name for w in DRAWN], CAMERA, scene.wings)
    assert [s.name for s in found.spheres if not s.used] == ["chrome_2"]
    assert "radius" in str(next(s.why for s in found.spheres if not s.used))


def test_without_spheres_the_lights_are_as_designed() -> None:
    scene = Scene(10)
    found = as_designed(scene.wings, ["L0", "L1", "L2", "L3", "L4", "L5"], 0.1)
    truth = scene.source_C - found.focus_C
    truth /= np.linalg.norm(truth, axis=1, keepdims=True)
    error = np.array([np.arccos(np.clip(light.direction_C @ d, -1, 1)) for light, d in zip(found.lights, truth, strict=True)])
    assert np.sqrt(np.mean(error**2)) < 2.5 * np.sqrt(2) * np.mean([light.direction_std_rad for light in found.lights])


@pytest.mark.slow
@pytest.mark.parametrize("spheres", [2, 4])
def test_a_joint_one_click_off_is_named_and_none_falsely(spheres: int) -> None:
    named = [w.name for w in DRAWN]
    for seed in range(6):
        row, step = seed % 6, 1 if seed % 2 else -1
        scene = Scene(200 + seed, spheres, {row: step} if seed % 3 else None)
        measured = [measure_centre(v, CAMERA) for v in scene.views]
        _, wings, clicks = fit_with_clicks(named, scene.views, measured, CAMERA, scene.wings)
        expected = [(f"L{row}", 30 + 10 * step)] if seed % 3 else []
        assert [(c.name, round(float(np.degrees(c.found_rad)))) for c in clicks] == expected
        sure = [c for c in clicks if c.sure]
        assert sure == clicks or spheres == 2
        assert [round(float(np.degrees(w.joint_angle_rad))) for w in wings.wings] == [
            30 + (10 * step if sure and k == row else 0) for k in range(6)
        ]


@pytest.mark.parametrize("noise_px", [0.06, pytest.param(0.09, marks=pytest.mark.slow), pytest.param(0.12, marks=pytest.mark.slow)])
@pytest.mark.parametrize("seeds", [range(20, 26), pytest.param(range(26, 32), marks=pytest.mark.slow)])
def test_highlights_that_hardly_tell_a_click_find_none(noise_px: float, seeds: range) -> None:
    for seed in seeds:
        scene, rng = Scene(seed, 2), np.random.default_rng(seed)
        views = [
            replace(
                view,
                highlights_px={light: pixel + noise_px * rng.normal(size=2) for light, pixel in view.highlights_px.items()},
                highlight_sigma_px=dict.fromkeys(view.highlights_px, noise_px),
            )
            for view in scene.views
        ]
        measured = [measure_centre(view, CAMERA) for view in views]
        _, wings, clicks = fit_with_clicks([w.name for w in DRAWN], views, measured, CAMERA, scene.wings)
        assert wings is scene.wings
        assert not any(click.sure for click in clicks)


@pytest.mark.slow
def test_a_clicked_wing_does_not_pull_the_others() -> None:
    errors = []
    for seed in range(3):
        scene = Scene(300 + seed, 3, {2: 1})
        found = refine(scene.views, [w.name for w in DRAWN], CAMERA, scene.wings)
        assert any("L2: joint at 40 deg, not 30" in warning for warning in found.warnings)
        errors.append(np.array([light.source_C for light in found.lights]) - scene.source_C)
    assert np.sqrt(np.mean(np.square(errors))) < 2.5e-3


def test_swapped_images_are_refused_and_named() -> None:
    scene = Scene(400, 2)
    names = {"L1": "L4", "L4": "L1"}
    views = [
        SphereView(
            v.name, v.kind, v.radius_m, v.outline_px, v.outline_sigma_px,
            {names.get(light, light): px for light, px in v.highlights_px.items()}, v.highlight_sigma_px,
        )
        for v in scene.views
    ]  # fmt: skip
    with pytest.raises(DisagreementError, match="L1 where L4 should be, L4 where L1 should be"):
        refine(views, [w.name for w in DRAWN], CAMERA, scene.wings)
