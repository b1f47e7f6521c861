"""Camera, hand-eye, wings and spheres together; the disc found from spheres; which sphere to add; lobes known beforehand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lights_scene import CAMERA, DISC_SIGMA, DRAWN, RADIUS_M, SETTING_SIGMA, Scene
from lpcal.chain.h_pl_wings import camera_in_disc, design_lights, share_correction
from lpcal.chain.refine_lights.free_camera import ray_slope, with_core
from lpcal.chain.refine_lights.geometry_fit import GeometryFit, fit_geometry
from lpcal.chain.refine_lights.measure import measure_centre
from lpcal.chain.refine_lights.refine import advise, mean_direction_std
from lpcal.chain.refine_lights.samples import Samples
from lpcal.chain.refine_lights.shading import fit_shading
from lpcal.geometry import se3
from lpcal.records.calibration import Camera, Light, Lobe

NAMES = [wing.name for wing in DRAWN]
CORE_SIGMA = np.array([4.0, 4.0, 3.0, 3.0])


def fitted(scene: Scene, camera: Camera = CAMERA, *, free_core: bool = False) -> GeometryFit:
    measured = [measure_centre(view, camera, free_core=free_core) for view in scene.views]
    return fit_geometry(NAMES, scene.views, measured, camera, scene.wings)


def across_nees(fit: GeometryFit, source_C: np.ndarray) -> float:
    """Of the sources across the camera's axis, a light: 2 expected."""
    gap = (fit.source_C - source_C)[:, :2]
    blocks = [fit.source_covariance[3 * k : 3 * k + 2, 3 * k : 3 * k + 2] for k in range(len(gap))]
    return float(np.mean([g @ np.linalg.solve(S, g) for g, S in zip(gap, blocks, strict=True)]))


def test_rays_move_with_the_cameras_parameters() -> None:
    parameters = ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3")
    camera = replace(CAMERA, parameters=parameters, covariance=np.diag([1, 1, 1, 1, 1e-4, 1e-4, 1e-6, 1e-6, 1e-4]))
    pixels = np.array([[90.0, 70.0], [400.0, 240.0], [700.0, 430.0]])
    change = np.array([0.3, -0.2, 0.1, 0.4, 1e-4, -2e-4, 1e-5, -1e-5, 1e-4])
    moved = with_core(camera, change).unproject(pixels) - camera.unproject(pixels)
    np.testing.assert_allclose(ray_slope(camera, pixels) @ change, moved, atol=3e-3 * np.abs(moved).max())


def test_a_camera_that_is_off_within_its_sigma_is_allowed_for() -> None:
    fixed, free, errors = [], [], []
    for seed in range(10):
        rng, scene = np.random.default_rng([seed, 3]), Scene(500 + seed)
        wrong = replace(CAMERA, parameters=("fx", "fy", "cx", "cy"), covariance=np.diag(CORE_SIGMA**2))
        wrong = with_core(wrong, rng.normal(size=4) * CORE_SIGMA)
        fits = [fitted(scene, wrong, free_core=each) for each in (False, True)]
        fixed.append(across_nees(fits[0], scene.source_C))
        free.append(across_nees(fits[1], scene.source_C))
        errors.append([np.sqrt(np.mean((fit.source_C - scene.source_C) ** 2)) for fit in fits])
    assert np.mean(free) < 3.5  # 2 expected
    assert np.mean(fixed) > 2 * np.mean(free)
    assert np.mean(errors, axis=0)[1] < np.mean(errors, axis=0)[0]


def test_the_disc_is_found_from_the_spheres_where_no_markers_say_it() -> None:
    sigma = np.array([np.radians(3.0)] * 3 + [0.005] * 3)
    nees, gained = [], []
    for seed in range(8):
        rng, scene = np.random.default_rng([seed, 4]), Scene(600 + seed)
        H_CD_true = se3.exp(np.array([0.006, -0.006, 0.004, -0.001, 0.001, 0.0035]))
        H_CD_drawn = se3.exp(rng.normal(size=6) * sigma) @ H_CD_true
        scene.wings = design_lights(DRAWN, H_CD_drawn, np.diag(sigma**2), SETTING_SIGMA, "test")
        fit = fitted(scene)
        assert fit.H_CD is not None
        assert fit.H_CD_covariance is not None
        error = se3.log(H_CD_true @ se3.inv(fit.H_CD))
        nees.append(error @ np.linalg.solve(fit.H_CD_covariance, error))
        gained.append(np.linalg.norm(error[:3]) / np.linalg.norm(se3.log(H_CD_drawn @ se3.inv(H_CD_true))[:3]))
    assert 2 < np.mean(nees) < 12  # 6 expected
    assert np.median(gained) < 0.25


def test_hand_eye_and_disc_take_their_shares() -> None:
    rng = np.random.default_rng(5)
    H_PC, H_PD = (se3.exp(rng.normal(size=6) * [0.2, 0.2, 0.2, 0.02, 0.02, 0.02]) for _ in range(2))
    S_PC, S_PD = np.diag(DISC_SIGMA**2), np.diag(np.array([np.radians(0.5)] * 3 + [0.002] * 3) ** 2)
    S_CD = np.diag(np.array([np.radians(0.02)] * 3 + [0.0001] * 3) ** 2)
    scores = []
    for _ in range(300):
        H_PC_true = se3.exp(rng.normal(size=6) * np.sqrt(np.diag(S_PC))) @ H_PC
        H_PD_true = se3.exp(rng.normal(size=6) * np.sqrt(np.diag(S_PD))) @ H_PD
        H_CD_prior, S_prior = camera_in_disc(H_PC, S_PC, H_PD, S_PD)
        seen = se3.log(se3.exp(rng.normal(size=6) * np.sqrt(np.diag(S_CD))) @ se3.inv(H_PC_true) @ H_PD_true @ se3.inv(H_CD_prior))
        S_post = np.linalg.inv(np.linalg.inv(S_prior) + np.linalg.inv(S_CD))
        H_CD = se3.exp(S_post @ np.linalg.solve(S_CD, seen)) @ H_CD_prior
        (H_PC_found, S_PC_found), (H_PD_found, S_PD_found) = share_correction(H_PC, S_PC, H_PD, S_PD, H_CD, S_post)
        np.testing.assert_allclose(se3.inv(H_PC_found) @ H_PD_found, H_CD, atol=2e-4)
        both = [(H_PC_true @ se3.inv(H_PC_found), S_PC_found), (H_PD_true @ se3.inv(H_PD_found), S_PD_found)]
        scores.append([se3.log(gap) @ np.linalg.solve(S, se3.log(gap)) for gap, S in both])
    np.testing.assert_allclose(np.mean(scores, axis=0), 6.0, rtol=0.15)


def test_the_advised_sphere_gains_what_it_promised() -> None:
    scene = Scene(700, 2)
    fit = fitted(scene)
    focus_C = np.array([0.0, 0.0, 0.35])
    advice = advise(fit.source_C, fit.source_covariance, focus_C, RADIUS_M, CAMERA)
    assert advice is not None
    assert np.isclose(advice.before_rad, mean_direction_std(fit.source_C, fit.source_covariance, focus_C))
    scene.views.append(scene._view(9, advice.centre_C, -0.25, np.random.default_rng(1)))
    more = fitted(scene)
    after = mean_direction_std(more.source_C, more.source_covariance, focus_C)
    assert advice.after_rad < 0.9 * advice.before_rad
    assert np.isclose(after, advice.after_rad, rtol=0.2)


def test_a_lobe_known_beforehand_carries_beyond_what_was_seen() -> None:
    rng = np.random.default_rng(6)
    light, block = np.repeat(np.arange(2), 300), np.tile(np.arange(300), 2)
    angle, around = np.radians(rng.uniform(0, 18, 600)), rng.uniform(0, 2 * np.pi, 600)
    true = Lobe(
        "table",
        angle_rad=np.radians(np.arange(91)),
        value=np.cos(np.radians(np.arange(91))) ** 10 * np.exp(-0.4 * np.radians(np.arange(91))),
    )
    log_data = np.log(true(angle)) + np.log([1.1, 0.9])[light] + rng.normal(size=300)[block] * 0.01 + rng.normal(size=600) * 0.003
    samples = Samples(
        light, np.zeros(600, int), block, log_data, np.full(600, 0.002), np.zeros(600), angle, around,
        np.zeros((600, 3)), np.zeros(600), np.ones((600, 1)),
    )  # fmt: skip
    far = np.radians(np.array([28.0, 35.0]))
    off = {}
    for name, known in (("known", true), ("unknown", None)):
        found = fit_shading(samples, [known, known], ["matte_0"], 0.1)
        off[name] = np.max(np.abs(found.lobes[0](far) / true(far) - 1))
        assert np.isclose(found.intensity[0, 0] / found.intensity[1, 0], 1.1 / 0.9, rtol=5e-3)
        np.testing.assert_allclose(found.seen_rad, [angle[:300].max(), angle[300:].max()])
    assert off["known"] < 0.02
    assert off["known"] < off["unknown"]


def test_a_light_says_where_its_lobe_is_extrapolated() -> None:
    light = Light("L0", np.array([0, 0, -1.0]), np.ones(1), np.eye(4), np.zeros(3), np.array([0, 0, 1.0]), Lobe(seen_rad=np.radians(20)))
    np.testing.assert_array_equal(light.extrapolated(np.array([[0, 0, 1.0], [0.3, 0, 1.0], [0.4, 0, 1.0]])), [False, False, True])
    assert not replace(light, lobe=Lobe()).extrapolated(np.array([[5.0, 0, 1.0]])).any()
