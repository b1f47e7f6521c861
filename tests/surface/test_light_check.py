"""A capture whose own images contradict its calibration: the light is named; right lights are left alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import lpcal as library
from lit_scene import K, Scene, calibration, draw, truth
from lpcal.api.surface_notes import contradicting, deviations
from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.records.figures import GlossFound, SurfaceFigures
from lpcal.records.observations import RawCapture
from lpcal.records.surface import Component, Surface


def with_light(raw: RawCapture, k: int, factor: float) -> RawCapture:
    """The capture as a lamp of another power gives it, dimmed so that nothing saturates."""
    powers = np.where(np.arange(len(raw.lights)) == k, factor, 1.0)[:, None, None] / 1.4
    return replace(raw, images=(raw.ambient[0] + (raw.images - raw.ambient[0]) * powers).astype(np.float32))


def true_surface(scene: Scene) -> Surface:
    """The scene's own shape, with the albedo that all lights together tell."""
    mask, depth, n = truth(scene)
    zero = np.zeros(mask.shape, np.float32)
    rays = draw_rays(mask.shape)
    albedo = np.where(mask, scene.albedo[0], np.nan)
    label = mask.astype(np.uint8)
    return Surface("ball", n, depth, albedo, mask, zero, zero, label, label, rays, (Component(1, int(mask.sum()), 0.35, 0.01),))


def draw_rays(shape: tuple[int, int]) -> np.ndarray:
    column, row = np.meshgrid(np.arange(shape[1], dtype=float), np.arange(shape[0], dtype=float))
    return np.stack([(column - K[0, 2]) / K[0, 0], (row - K[1, 2]) / K[1, 1], np.ones(shape)], axis=-1)


@pytest.mark.parametrize("k", [0, 2, 5])
@pytest.mark.parametrize("factor", [0.85, 1.0, 1.12])
def test_a_lamp_of_another_power_shows_on_the_true_surface(k: int, factor: float) -> None:
    surface, raw = true_surface(Scene()), with_light(draw(Scene(), calibration()), k, factor)
    radiance = to_radiance(raw, Sensor())
    found = deviations(surface, radiance, calibration())
    assert found[f"L{k}"] == pytest.approx(np.log(factor), abs=0.01)
    said = contradicting(surface, radiance, calibration())
    assert [word.split()[0] for word in said] == ([] if factor == 1.0 else [f"L{k}"])


@pytest.mark.parametrize("factor", [1.0, 0.7])
def test_a_light_whose_shadow_covers_most_of_the_object(factor: float) -> None:
    """Three quarters of the object lie in another thing's shadow under L1: its lamp is judged by the rest."""
    raw = with_light(draw(Scene(), calibration()), 1, factor)
    images, mask = raw.images.copy(), truth(Scene())[0]
    columns = np.nonzero(mask)[1]
    shaded = mask & (np.arange(mask.shape[1]) < np.quantile(columns, 0.75))
    images[1] = np.where(shaded, raw.ambient[0] + 0.01 * (images[1] - raw.ambient[0]), images[1])
    radiance = to_radiance(replace(raw, images=images.astype(np.float32)), Sensor())
    assert deviations(true_surface(Scene()), radiance, calibration())["L1"] == pytest.approx(np.log(factor), abs=0.03)


def test_an_error_of_one_side_of_the_object_is_no_lamps() -> None:
    """Light that something beside the object throws onto its right side, under one light."""
    surface, raw = true_surface(Scene()), draw(Scene(), calibration())
    images, side = raw.images / 1.4, np.arange(surface.mask.shape[1]) > np.quantile(np.nonzero(surface.mask)[1], 0.4)
    images[2] = np.where(side, 1.3 * images[2], images[2])
    radiance = to_radiance(replace(raw, images=images.astype(np.float32), ambient=raw.ambient / 1.4), Sensor())
    assert deviations(surface, radiance, calibration())["L2"] > 0.1
    assert contradicting(surface, radiance, calibration()) == ()


def test_what_is_spoken_for_already_is_not_said_again() -> None:
    radiance = to_radiance(with_light(draw(Scene(), calibration()), 1, 1.3), Sensor())
    for figures in (
        SurfaceFigures(gloss=GlossFound(ks=0.1, roughness=0.2, gain=0.9)),
        SurfaceFigures(images_exchanged={"L1": "L2"}),
        SurfaceFigures(intensities_found={"L1": 1.2}),
    ):
        assert contradicting(replace(true_surface(Scene()), figures=figures), radiance, calibration()) == ()


@pytest.mark.slow
def test_a_whole_reconstruction_names_the_lamp() -> None:
    mask = truth(Scene())[0]
    for k, factor in ((2, 1.12), (4, 0.85)):
        said = library.reconstruct(with_light(draw(Scene(), calibration()), k, factor), calibration(), mask=mask).warnings
        assert [word for word in said if word.startswith(f"L{k} shines otherwise")], (k, factor, said)
    assert not library.reconstruct(draw(Scene(), calibration()), calibration(), mask=mask).warnings
