"""What many views tell of their calibration: lights that are wrong turn normals alike in C, and are found by what views differ by."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import lpcal
from fusion_views import scene
from lpcal.fusion.rig_evidence import normal_turns, surprise
from lpcal.records.model import LightEvidence, RigEvidence
from lpcal.records.surface import Surface

pytest.importorskip("skimage")
COUNT = 6


def lights(position_std_m: float = 0.001, intensity_std: float = 0.01) -> tuple[lpcal.Light, ...]:
    """Six lights on a ring about the camera."""
    made = []
    for k in range(COUNT):
        angle = 2 * np.pi * k / COUNT + 0.2
        source = np.array([0.15 * np.cos(angle), 0.15 * np.sin(angle), 0.02])
        axis = (np.array([0, 0, 0.35]) - source) / np.linalg.norm(np.array([0, 0, 0.35]) - source)
        made.append(
            lpcal.Light(
                f"L{k}", -axis, np.ones(1), source_C=source, axis_C=axis, position_std_m=position_std_m, intensity_std=intensity_std
            )
        )
    return tuple(made)


def test_a_surprise_is_one_sigma_on_the_mean() -> None:
    """For changes as their prior lets expect; one far beyond the prior is a large surprise even where the data are weak."""
    rng = np.random.default_rng(0)
    prior = np.diag([3e-3, 5e-4, 5e-4, 5e-4]) ** 2
    J, noise = rng.standard_normal((3, 4)) * [1, 8, 8, 8], 0.011
    gain = prior @ J.T @ np.linalg.inv(J @ prior @ J.T + noise**2 * np.eye(3))
    posterior = prior - gain @ J @ prior
    true = np.sqrt(np.diag(prior)) * rng.standard_normal((1000, 4))
    seen = true @ J.T + noise * rng.standard_normal((1000, 3))
    squared = [surprise(gain @ y, prior, posterior) ** 2 for y in seen]
    assert np.mean(squared) == pytest.approx(1.0, abs=0.15)
    assert surprise(gain @ J @ np.array([0.18, 0, 0, 0]), prior, posterior) > 5


def test_the_turn_of_normals_is_that_of_least_squares() -> None:
    """Normals solved from images of slightly other lights turn by as much as the derivative says."""
    rng = np.random.default_rng(1)
    x_C = np.column_stack([rng.uniform(-0.03, 0.03, (20, 2)), rng.uniform(0.32, 0.38, 20)])
    n_C = np.column_stack([rng.uniform(-0.3, 0.3, (20, 2)), -np.ones(20)])
    n_C /= np.linalg.norm(n_C, axis=1, keepdims=True)
    off = 1e-4 * rng.standard_normal((COUNT, 4))
    off[:, 1:] *= 0.1
    to = np.array([light.source_C for light in lights()])[None] - x_C[:, None]
    r = np.linalg.norm(to, axis=2)
    said_d = to / r[..., None]
    moved = to + off[None, :, 1:]
    moved_r = np.linalg.norm(moved, axis=2)
    image = (1 + off[:, 0]) * np.einsum("nlk,nk->nl", moved / moved_r[..., None], n_C) * (r / moved_r) ** 2
    b = np.stack([np.linalg.lstsq(d, i, rcond=None)[0] for d, i in zip(said_d, image, strict=True)])
    found = b / np.linalg.norm(b, axis=1, keepdims=True) - n_C
    said = normal_turns(x_C, n_C, lights()) @ off.ravel()
    np.testing.assert_allclose(said, found, atol=0.02 * np.abs(found).max())


OFF = np.zeros((COUNT, 4))
OFF[1, 0], OFF[4, 2] = 0.06, 0.008


def turned(times: float) -> tuple[Surface, ...]:
    """Views of a stone, their normals as a light that is 6 % too strong, and another 8 mm beside its place, would turn them."""
    found = []
    for surface in scene().surfaces:
        inside = surface.mask
        x_C = (surface.rays_C * surface.depth[..., None])[inside].astype(float)
        n_C = surface.normals[inside].astype(float)
        normals = surface.normals.copy()
        bent = n_C + np.nan_to_num(normal_turns(x_C, n_C, lights()) @ (times * OFF).ravel())
        normals[inside] = bent / np.linalg.norm(bent, axis=1, keepdims=True)
        found.append(replace(surface, normals=normals))
    return tuple(found)


def said_of(times: float, position_std_m: float, intensity_std: float) -> RigEvidence:
    """What these views say of lights that the calibration knows so well."""
    calibration = lpcal.Calibration("rig", lights(position_std_m, intensity_std), H_PC=np.eye(4))
    found = lpcal.fuse(turned(times), step_m=0.004, calibration=calibration).rig
    assert found is not None
    return found


def test_wrong_lights_are_found() -> None:
    """Intensity and distance of a light do much the same, so what counts is by how much less they turn the normals afterwards."""
    found = said_of(1.0, 0.003, 0.02)
    x = np.array([[light.intensity_change, *light.source_change_C] for light in found.lights])
    rng = np.random.default_rng(4)
    x_C = np.column_stack([rng.uniform(-0.03, 0.03, (100, 2)), rng.uniform(0.32, 0.38, 100)])
    n_C = np.column_stack([rng.uniform(-0.4, 0.4, (100, 2)), -np.ones(100)])
    turns = normal_turns(x_C, n_C / np.linalg.norm(n_C, axis=1, keepdims=True), lights())
    before, after = (float(np.sqrt(np.nanmean((turns @ off.ravel()) ** 2))) for off in (OFF, OFF - x))
    assert after < 0.6 * before
    assert found.normals_after_rad < found.normals_before_rad
    assert not found.moved


def test_a_rig_that_moved_is_said() -> None:
    """Thrice the errors, where the calibration knew its lights to 0.5 mm and 0.3 %."""
    found = said_of(3.0, 0.0005, 0.003)
    assert any(line.startswith(("L1", "L4")) for line in found.moved), [light.sigmas for light in found.lights]


def test_the_refined_calibration() -> None:
    """Sources and intensities are changed, their mean stays 1; a model without evidence is refused."""
    calibration = lpcal.Calibration("rig", lights(), H_PC=np.eye(4))
    still = LightEvidence("L0", 0.03, 0.002, np.array([0.001, 0, 0]), np.full(3, 2e-4), 3.0)
    rig = RigEvidence(np.zeros(6), np.zeros((6, 6)), 0.0, 0.0, 0.003, (still,), 0.02, 0.015)
    model = replace(lpcal.fuse(scene().surfaces[:3], step_m=0.006), rig=rig)
    refined = lpcal.refine_rig(calibration, model)
    assert np.mean([light.intensity for light in refined.lights]) == pytest.approx(1.0)
    assert refined.lights[0].intensity / refined.lights[1].intensity == pytest.approx(1.03)
    assert refined.lights[0].source_C[0] - calibration.lights[0].source_C[0] == pytest.approx(0.001)
    with pytest.raises(lpcal.errors.InputError, match="nothing of its rig"):
        lpcal.refine_rig(calibration, replace(model, rig=None))
