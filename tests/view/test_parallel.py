"""Bands of pixels: the same bytes from any number of cores, and a part of a picture solved as the whole is."""

from __future__ import annotations

import threading
from dataclasses import replace

import numpy as np
import pytest

import lpcal
from lit_scene import Scene, calibration, draw, truth
from lpcal.integration.integrate import Grid
from lpcal.records.calibration import LedCluster, Lobe
from lpcal.records.outcome import silent
from lpcal.surface import rounds
from lpcal.view import parallel
from lpcal.view.crop import MARGIN_PX, Crop
from lpcal.view.pixel_list import PixelList, light_vectors, ray_map

S = np.array([[0.5, 0, -1], [-0.25, 0.45, -1], [-0.25, -0.45, -1], [0.0, 0.0, -1], [0.3, 0.3, -1]])
S /= np.linalg.norm(S, axis=1, keepdims=True)
DOME = lpcal.Calibration("dome", tuple(lpcal.Light(f"L{k}", s, np.ones(1)) for k, s in enumerate(S)))


@pytest.mark.parametrize(("pixels", "lights"), [(1, 1), (100_000, 6), (3_000, 96), (5, 10 * parallel.SAMPLES)])
def test_bands_hold_every_pixel_once_and_no_more_samples_than_fit(pixels: int, lights: int) -> None:
    found = parallel.bands(pixels, lights)
    assert [pixel for one in found for pixel in range(pixels)[one]] == list(range(pixels))
    assert max(one.stop - one.start for one in found) * lights <= max(parallel.SAMPLES, lights)


def test_work_is_shared_by_no_more_threads_than_asked_and_kept_in_order() -> None:
    for count in (1, 2, 5):
        seen = set()

        def work(item: int, seen: set[int] = seen) -> int:
            seen.add(threading.get_ident())
            return parallel.run_all(lambda one: 2 * one, [item])[0]

        with parallel.cores(count):
            assert parallel.run_all(work, range(40)) == list(range(0, 80, 2))
        assert len(seen) <= count


@pytest.mark.parametrize("scene", [Scene()])
def test_any_number_of_cores_gives_the_same_bytes(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parallel, "SAMPLES", 5000)
    lights = calibration()
    mask = truth(scene)[0]
    found = []
    for count in (1, 3):
        with parallel.cores(count):
            surface = lpcal.reconstruct(draw(scene, lights), lights, mask=mask)
        found.append([getattr(surface, name).tobytes() for name in ("normals", "depth", "albedo", "normal_std_deg", "depth_std", "breaks")])
    assert found[0] == found[1]


@pytest.mark.parametrize("kind", ["point", "cluster", "distant"])
def test_a_light_taken_as_distant_is_everywhere_as_it_is_at_the_focus(kind: str) -> None:
    light = calibration().lights[0]
    if kind == "cluster":
        H_CL = np.eye(4)
        H_CL[:3, 2], H_CL[:3, 3] = light.axis_C, light.source_C
        H_CL[:3, 0] = np.cross([0, 1.0, 0], light.axis_C) / np.linalg.norm(np.cross([0, 1.0, 0], light.axis_C))
        H_CL[:3, 1] = np.cross(H_CL[:3, 2], H_CL[:3, 0])
        place = np.array([[0.004, 0, 0], [-0.004, 0, 0], [0, 0.004, 0]])
        cluster = LedCluster(place, np.tile([0, 0, 1.0], (3, 1)), np.full(3, 1 / 3), 4.0)
        light = replace(light, H_CL=H_CL, lobe=Lobe("leds", leds=cluster))
    if kind == "distant":
        light = DOME.lights[0]
    focus_C, places = np.array([0.0, 0.01, 0.35]), np.random.default_rng(0).normal([0, 0, 0.4], 0.02, (7, 3))
    d, E = light_vectors([light, light], places, focus_C)
    there, strength = light_vectors([light], focus_C[None])
    assert d.shape == (2, 7, 3)
    assert E.shape == (2, 7)
    np.testing.assert_allclose(d, np.broadcast_to(there, d.shape))
    np.testing.assert_allclose(E, np.broadcast_to(strength, E.shape))


def ball(size: int, middle: tuple[int, int], radius: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mask, normals and images of a ball somewhere in a picture."""
    y, x = (np.mgrid[:size, : size + 30] - np.reshape(middle, (2, 1, 1))) / radius
    inside = x**2 + y**2 < 0.9
    n = np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0.1))], axis=-1)
    noise = 1e-3 * np.random.default_rng(5).standard_normal((len(S), *inside.shape))
    return inside, n, np.where(inside, 0.7 * np.clip(np.einsum("lc,hwc->lhw", S, n), 0, 1), 0) + 0.02 + noise


@pytest.mark.parametrize("middle", [(30, 40), (70, 90), (100, 20)])
def test_a_part_about_the_mask_is_put_back_where_it_was(middle: tuple[int, int]) -> None:
    mask, n, images = ball(120, middle, 18.0)
    surface = lpcal.reconstruct(images, DOME, ambient=np.full(mask.shape, 0.02), mask=mask)
    assert surface.normals.shape == (*mask.shape, 3)
    assert surface.breaks.shape == (2, *mask.shape)
    assert np.array_equal(surface.mask, mask)
    assert np.array_equal(np.isfinite(surface.depth), mask)
    assert surface.breaks[:, ~mask].all()
    error = np.degrees(np.arccos(np.clip(np.sum(surface.normals * n, axis=-1)[mask], -1, 1)))
    assert np.median(error) < 1.5


@pytest.mark.parametrize("at", [(0, 0), (5, 60), (39, 79)])
def test_a_part_has_its_margin_within_the_picture(at: tuple[int, int]) -> None:
    mask = np.zeros((40, 80), bool)
    mask[at] = True
    part = Crop.about(mask)
    rows, columns = np.nonzero(part.of(np.pad(np.ones((1, 1), bool), [(at[0], 39 - at[0]), (at[1], 79 - at[1])])))
    assert (rows[0], columns[0]) == (min(at[0], MARGIN_PX), min(at[1], MARGIN_PX))
    assert part.of(mask).sum() == 1
    assert Crop.about(np.zeros((4, 5), bool)).of(np.ones((4, 5))).shape == (4, 5)


def test_the_rounds_give_the_same_however_much_is_empty_about_the_object(monkeypatch: pytest.MonkeyPatch) -> None:
    lights, about = calibration(), Scene(radius=0.018)
    mask = truth(about)[0]
    raw = draw(about, lights)
    signal = (raw.images - raw.ambient.mean(axis=0))[:, mask].astype(float)
    rays = ray_map(mask.shape, lights.camera)[mask]
    far = np.pad(mask, [(37, 21), (50, 11)])
    found = []
    for closely in (rounds.Scene.closely, lambda scene: scene):
        monkeypatch.setattr(rounds.Scene, "closely", closely)
        seen = PixelList(far, rays, signal, np.full(signal.shape, 2e-3), np.ones(signal.shape, bool), True)
        scene = rounds.Scene("ball", seen, Grid.of(far), lights.lights, None)
        found.append(rounds.run(scene, np.full(seen.pixels, np.log(0.35)), silent))
    cropped, whole = found
    assert rounds.Scene.closely(scene).seen.mask.shape == far.shape  # the second was not cropped
    np.testing.assert_allclose(cropped.u, whole.u, rtol=0, atol=1e-7)
    np.testing.assert_allclose(cropped.field.b, whole.field.b, rtol=0, atol=1e-7)
    assert np.array_equal(cropped.weight > 0.02, whole.weight > 0.02)
