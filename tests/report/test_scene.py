"""The report's drawings in space: what they hold, and that a browser draws them and obeys each control."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from browser_pages import WAIT_MS, Opened, chromium, findings, opened
from lpcal.report.page import render
from lpcal.report.scene import DEPTHS, FIELD_CELLS, ellipsoids, field_plane, rig_scene, working_volume
from report_rig import documents, report_of, surface


def test_an_ellipsoid_is_one_standard_deviation() -> None:
    report = report_of(documents())
    found = ellipsoids(report)
    lights = report.shown_lights
    assert len(found) == len(lights)
    for item, light in zip(found, lights, strict=True):
        assert np.linalg.norm(item.axes, axis=1) == pytest.approx(np.full(3, light.position_std_m))
    wings = report.wings
    assert wings is not None
    drawn = ellipsoids(replace(report, lights=None, calibration=None))
    sizes = [np.sqrt((item.axes**2).sum() / 3) for item in drawn]
    assert sizes == pytest.approx(list(wings.position_std_m))


def test_the_volume_is_what_the_camera_sees_about_the_focus() -> None:
    report = report_of(documents())
    assert report.placed is not None
    depths = {round(float(z), 9) for item in working_volume(report) for z in item.points[:, 2]}
    assert depths == {round(float(share * report.placed.focus_C[2]), 9) for share in DEPTHS}
    assert working_volume(replace(report, camera=None, calibration=None)) == []


def test_the_field_over_the_plane_is_the_lights_own() -> None:
    report = report_of(documents())
    plane = field_plane(report)
    assert plane is not None
    light = next(light for light in report.shown_lights if light.name in plane.values)
    middle = plane.corners.mean(axis=0)
    value = plane.values[light.name]
    corner = plane.corners[0] + (plane.corners[2] - plane.corners[0]) * 0.5 / FIELD_CELLS
    expected = light.field(corner)[1].mean() / light.field(middle)[1].mean()
    half = FIELD_CELLS // 2
    assert value[0, 0] / value[half - 1 : half + 1, half - 1 : half + 1].mean() == pytest.approx(expected, rel=0.02)
    assert value.max() == pytest.approx(1)
    scene = rig_scene(report)
    assert scene is not None
    assert scene.field is not None


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Headless Chromium, one for the module."""
    with chromium() as running:
        yield running


def ink(found: Opened, k: int) -> np.ndarray:
    """A drawing's pixels as numbers, by a screenshot."""
    from PIL import Image

    canvas = found.page.locator(".scene canvas").nth(k)
    path = Path(found.page.evaluate("location.pathname")).with_name(f"shot{k}.png")
    canvas.screenshot(path=path)
    return np.asarray(Image.open(path).convert("RGB")).astype(int)


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_browser_draws_the_rig_and_obeys_each_control(browser: Any, tmp_path: Path, scheme: str) -> None:
    found = opened(browser, tmp_path, render(report_of(documents(), surface())), color_scheme=scheme)
    page = found.page
    page.wait_for_function("document.documentElement.dataset.drawn", timeout=WAIT_MS)
    count = page.locator(".scene").count()
    assert count == 2
    for k in range(count):
        assert len(np.unique(ink(found, k).reshape(-1, 3), axis=0)) > 8
    rig = page.locator("[data-scene=rig]")
    seen = ink(found, 1)
    for layer in rig.locator("[data-layer]").all():
        layer.click()
        now = ink(found, 1)
        assert np.any(now != seen), layer.get_attribute("data-layer")
        seen = now
        layer.click()
        seen = ink(found, 1)
    acts = [lambda view=view: rig.locator(f"[data-view={view}]").click() for view in ("front", "side", "top", "first")]
    acts += [lambda k=k: rig.locator("[data-zoom]").nth(k).click() for k in (0, 1)]
    acts += [lambda: rig.locator("[data-exaggerate]").fill("25"), lambda: rig.locator("[data-field]").select_option("0")]
    keys = ("ArrowLeft", "ArrowUp", "Shift+ArrowRight", "+", "-", "0")
    acts += [lambda key=key: rig.locator("canvas").press(key) for key in keys]
    for act in acts:
        act()
        now = ink(found, 1)
        assert np.any(now != seen)
        seen = now
    assert page.evaluate("getComputedStyle(document.activeElement).outlineStyle") != "none"
    assert findings(page) == []
    assert found.said == []
