"""The relighting page: what is packed comes out again, and the browser lights the surface as the light did."""

from __future__ import annotations

import base64
import json
import re
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from browser_pages import NO_WEBGL, Opened, chromium, opened, ready
from lpcal.geometry.arrays import Array
from lpcal.records.surface import Surface
from lpcal.report import relight_page
from lpcal.report.relight_page import render
from relight_ball import SIZE, ball, lights
from report_rig import read


def unpacked(data: dict[str, Any]) -> dict[str, Any]:
    """What the browser makes of the planes, written a second time."""
    h, w = data["height"], data["width"]
    stored = np.frombuffer(zlib.decompress(base64.b64decode(data["planes"])), np.uint8)
    planes, at = [], 0
    for wide in [True, True, True, *[False] * (data["channels"] + 5)]:
        part = stored[at : at + (2 if wide else 1) * h * w].astype(int)
        difference = 256 * part[: h * w] + part[h * w :] if wide else part
        planes.append(np.cumsum(difference.reshape(h, w), axis=1) % (65536 if wide else 256))
        at += part.size
    assert at == stored.size
    u, v = (plane / 32767.5 - 1 for plane in planes[:2])
    z = np.abs(u) + np.abs(v) - 1
    x = np.where(z > 0, (1 - np.abs(v)) * np.where(u < 0, -1, 1), u)
    y = np.where(z > 0, (1 - np.abs(u)) * np.where(v < 0, -1, 1), v)
    n = np.stack([x, y, z], axis=-1)
    low, high = data["depth"]
    return {
        "normals": n / np.linalg.norm(n, axis=-1, keepdims=True),
        "depth": low + (planes[2] - 1) / 65534 * (high - low),
        "mask": planes[2] > 0,
        "albedo": np.stack([(plane / 255) ** 2 for plane in planes[3 : 3 + data["channels"]]], axis=-1),
        "sigma": 2 ** (planes[-5] / data["sigmaScale"]) - 1,
        "depth sigma": data["depthSigma"]["least"] * 2 ** ((planes[-4] - 1.0) / data["depthSigma"]["scale"]),
        "lights": planes[-3],
    }


@pytest.mark.parametrize("perspective", [True, False])
@pytest.mark.parametrize("colour", [True, False])
def test_what_is_packed_comes_out_again(perspective: bool, colour: bool) -> None:
    whole = ball(perspective=perspective, colour=colour)
    data, _ = relight_page.pack(whole, None)
    json.dumps(data, allow_nan=False)
    found, window = unpacked(data), np.s_[data["origin"][1] :, data["origin"][0] :]
    window = tuple(slice(part.start, part.start + size) for part, size in zip(window, found["mask"].shape, strict=True))
    mask = whole.mask[window]
    np.testing.assert_array_equal(found["mask"], mask)
    assert mask.sum() == whole.mask.sum()
    cross = np.linalg.norm(np.cross(found["normals"][mask], whole.normals[window][mask]), axis=-1)
    assert np.degrees(np.arcsin(cross.max())) < 0.01
    step = (data["depth"][1] - data["depth"][0]) / 65534
    np.testing.assert_allclose(found["depth"][mask], whole.depth[window][mask], atol=step)
    albedo = whole.albedo[window][mask].reshape(mask.sum(), -1)
    np.testing.assert_allclose(found["albedo"][mask], np.clip(albedo / np.percentile(albedo, 99.5), 0, 1), atol=0.006)
    np.testing.assert_allclose(found["sigma"][mask], whole.normal_std_deg[window][mask], rtol=0.05)
    np.testing.assert_allclose(found["depth sigma"][mask], whole.depth_std[window][mask], rtol=0.03)
    assert set(found["lights"][mask]) == {6}
    assert data["perspective"] == perspective


def test_normals_that_look_away_survive_the_packing() -> None:
    whole = ball(perspective=True)
    away = whole.normals * np.array([1, 1, -1], np.float32)
    data, _ = relight_page.pack(Surface(**{**vars(whole), "normals": away}), None)
    found = unpacked(data)
    window = tuple(slice(start, start + size) for start, size in zip(data["origin"][::-1], found["mask"].shape, strict=True))
    np.testing.assert_allclose(found["normals"][found["mask"]], away[window][found["mask"]], atol=2e-4)


def test_a_large_surface_is_averaged_down(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(relight_page, "MOST_PIXELS", 4000)
    whole = ball(perspective=True)
    data, _ = relight_page.pack(whole, None)
    assert data["step"] > 1
    assert data["width"] * data["height"] <= 4000 * 1.1
    found, step = unpacked(data), data["step"]
    rows, columns = np.nonzero(found["mask"])
    middle = np.stack([data["origin"][1] + (rows + 0.5) * step - 0.5, data["origin"][0] + (columns + 0.5) * step - 0.5]).round().astype(int)
    inside = whole.mask[tuple(middle)]
    assert inside.mean() > 0.9
    error = found["depth"][rows, columns][inside] - whole.depth[tuple(middle)][inside]
    assert np.abs(np.median(error)) < 1e-3


def test_a_surface_without_pixels_makes_a_page() -> None:
    whole = ball(perspective=True)
    nothing = np.zeros_like(whole.mask)
    read(render(Surface(**{**vars(whole), "mask": nothing}), None))


def test_near_lights_are_distant_where_there_is_no_camera() -> None:
    packed = relight_page.pack(ball(perspective=False), lights(near=True))[0]["lights"]
    assert [light["source"] for light in packed] == [None] * 3
    packed = relight_page.pack(ball(perspective=True), lights(near=True))[0]["lights"]
    assert all(light["source"] is not None and light["lobe"][0] == pytest.approx(1) for light in packed)


def test_the_page_stands_alone() -> None:
    page = render(ball(perspective=True), lights(near=True))
    assert [ref for ref in read(page).references if not ref.startswith("data:")] == []
    assert not re.search(r"https?://(?!www\.w3\.org)", page)
    assert "url(" not in page


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Headless Chromium, one for the module."""
    with chromium() as running:
        yield running


def on_screen(found: Opened, points: Array, canvas: dict[str, Any]) -> Array:
    """Where in a canvas, in its pixels, points (..., 3) in C are drawn."""
    told = found.page.evaluate("[viewer.camera.projectionMatrix.elements, viewer.camera.matrixWorldInverse.elements]")
    projection, view = (np.array(part).reshape(4, 4).T for part in told)
    seen = np.concatenate([points, np.ones((*points.shape[:-1], 1))], axis=-1) @ (projection @ view).T
    return np.stack(
        [(seen[..., 0] / seen[..., 3] + 1) / 2 * canvas["width"], (1 - seen[..., 1] / seen[..., 3]) / 2 * canvas["height"]], axis=-1
    )


def pictured(whole: Surface, canvas: dict[str, Any]) -> Array:
    """Where in a plain canvas the surface's pixels are drawn."""
    data, _ = relight_page.pack(whole, None)
    scale = min(0.84 * canvas["width"] / data["width"], 0.84 * canvas["height"] / data["height"])
    x, y = np.meshgrid(np.arange(SIZE[1]) - data["origin"][0] + 0.5, np.arange(SIZE[0]) - data["origin"][1] + 0.5)
    corner = [(canvas["width"] - scale * data["width"]) / 2, (canvas["height"] - scale * data["height"]) / 2]
    return np.stack([x, y], axis=-1) * scale + corner


@pytest.mark.parametrize(("before", "drawn"), [("", "webgl2"), pytest.param(NO_WEBGL, "canvas", marks=pytest.mark.slow)])
def test_the_browser_lights_the_surface_as_the_light_did(browser: Any, tmp_path: Path, before: str, drawn: str) -> None:
    whole, calibration = ball(perspective=True), lights(near=True)
    found = ready(opened(browser, tmp_path, render(whole, calibration), view="#light=L1&exposure=-1", before=before))
    assert found.said == []
    assert found.page.evaluate("document.documentElement.dataset.ready") == drawn
    green, alpha, canvas = found.grey()
    points = np.nan_to_num(whole.depth[..., None] * whole.rays_C, nan=1.0)
    at = on_screen(found, points, canvas) if drawn == "webgl2" else pictured(whole, canvas)
    d, irradiance = calibration.lights[1].field(points)
    expected = np.where(whole.mask, whole.albedo * irradiance[..., 0] * np.maximum((whole.normals * d).sum(axis=-1), 0), np.nan)
    column, row = (
        np.clip(np.round(at[..., k] / canvas["step"] - 0.5), 0, size - 1).astype(int) for k, size in enumerate(green.shape[::-1])
    )
    green, alpha = green[row, column], alpha[row, column]
    inner = (np.nan_to_num(expected) > 0) & (alpha == 255) & (green > 30) & (green < 215)
    assert inner.sum() > 1500
    ratio = (green[inner] / 255.0) ** 2.2 / expected[inner]
    assert np.median(np.abs(ratio / np.median(ratio) - 1)) < 0.04
    assert np.corrcoef((green[inner] / 255.0) ** 2.2, expected[inner])[0, 1] > 0.98
