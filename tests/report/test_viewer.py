"""The surface's viewer: every control, driven in a browser by mouse, touch and keys."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from browser_pages import Opened, chromium, findings, opened, ready
from lpcal.report import relight_page
from lpcal.report.distant_shape import bend_of
from lpcal.report.relight_page import render
from page_kinds import SCALE_STD, whole_ball
from relight_ball import CENTRE, SIZE, ball, lights


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Headless Chromium, one for the module."""
    with chromium() as running:
        yield running


@pytest.fixture(scope="module")
def page(browser: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Opened]:
    """The ball's page; each test leaves it as it was by the key 0."""
    found = ready(opened(browser, tmp_path_factory.mktemp("viewer"), render(whole_ball(), lights(near=True))))
    yield found
    assert found.said == []


@pytest.fixture(autouse=True)
def as_it_was(request: pytest.FixtureRequest) -> None:
    """The page as it opens."""
    if "page" in request.fixturenames:
        found = request.getfixturevalue("page")
        found.page.click("[data-does=light]")
        found.page.click("[data-mode=lit]")
        found.page.click("#reset")


def state(found: Opened, key: str) -> Any:
    """One of the page's settings."""
    return found.page.evaluate(f"viewer.state.{key}")


def eye(found: Opened) -> np.ndarray:
    """Where the viewer's camera stands, in C."""
    return np.array(found.page.evaluate("viewer.camera.position.toArray()"))


def picture(found: Opened) -> np.ndarray:
    """Green of every fourth pixel, 0 where nothing is drawn."""
    green, alpha, _ = found.grey()
    return np.where(alpha > 0, green, 0).astype(float)


def box(found: Opened) -> tuple[float, float, float, float]:
    """The canvas: left, top, width, height."""
    place = found.page.locator("#view").bounding_box()
    return place["x"], place["y"], place["width"], place["height"]


def drag(found: Opened, start: tuple[float, float], end: tuple[float, float], **words: Any) -> None:
    """A drag between two places, in shares of the canvas."""
    x, y, w, h = box(found)
    mouse = found.page.mouse
    mouse.move(x + start[0] * w, y + start[1] * h)
    mouse.down(**words)
    mouse.move(x + end[0] * w, y + end[1] * h, steps=3)
    mouse.up(**words)


def screen_of(found: Opened, column: int, row: int) -> tuple[float, float]:
    """Where on the screen the surface's pixel is drawn."""
    whole = whole_ball()
    point = (whole.depth[row, column] * whole.rays_C[row, column]).tolist()
    told = found.page.evaluate("[viewer.camera.projectionMatrix.elements, viewer.camera.matrixWorldInverse.elements]")
    projection, view = (np.array(part).reshape(4, 4).T for part in told)
    seen = projection @ view @ [*point, 1]
    x, y, w, h = box(found)
    return x + (1 + seen[0] / seen[3]) / 2 * w, y + (1 - seen[1] / seen[3]) / 2 * h


@pytest.mark.slow
def test_the_light_follows_the_pointer_the_wheel_and_the_arrows(page: Opened) -> None:
    x, y, w, h = box(page)
    for side in (0.35, 0.65):
        page.page.mouse.move(x + side * w, y + 0.5 * h)
        page.settle()
        bright = picture(page) ** 2.2
        assert (((np.linspace(0, 1, bright.shape[1]) * bright).sum() / bright.sum()) > 0.5) == (side > 0.5)
    assert "6 lights" in page.page.inner_text("#readout")
    before = state(page, "distance")
    page.page.mouse.wheel(0, -200)
    page.page.wait_for_function(f"viewer.state.distance < {before}")
    page.page.focus("#view")
    at = state(page, "pointer")
    page.page.keyboard.press("ArrowLeft")
    assert state(page, "pointer")[0] == pytest.approx(at[0] - 0.03)


@pytest.mark.slow
def test_orbit_pan_zoom_and_reset(page: Opened) -> None:
    assert eye(page) == pytest.approx([0, 0, 0], abs=1e-9)
    page.page.click("[data-does=turn]")
    drag(page, (0.5, 0.5), (0.6, 0.45))
    turned = eye(page)
    target = np.array(page.page.evaluate("viewer.surface.centre"))
    assert np.linalg.norm(turned) > 0.02
    assert np.linalg.norm(turned - target) == pytest.approx(np.linalg.norm(target), rel=1e-6)
    drag(page, (0.5, 0.5), (0.55, 0.5), button="right")
    panned = eye(page)
    assert np.linalg.norm(panned - turned) > 1e-3
    page.page.mouse.wheel(0, -300)
    page.page.wait_for_function(f"Math.abs(viewer.camera.position.x - {panned[0]}) > 1e-4")
    assert np.linalg.norm(eye(page) - CENTRE) < np.linalg.norm(panned - CENTRE)
    page.page.focus("#view")
    for key in ("ArrowLeft", "Shift+ArrowUp", "+", "-"):
        before = eye(page)
        page.page.keyboard.press(key)
        assert np.linalg.norm(eye(page) - before) > 1e-4
    page.page.click("#nearer")
    page.page.click("#further")
    page.page.keyboard.press("0")
    assert eye(page) == pytest.approx([0, 0, 0], abs=1e-9)


@pytest.mark.slow
def test_every_map_light_and_switch_changes_the_picture(page: Opened) -> None:
    seen = [picture(page)]
    for selector in (
        *(f"[data-mode={mode}]" for mode in ("shading", "albedo", "normals", "depth", "sigma", "depthSigma", "apart", "lit")),
        *(f'#names [data-light="{light}"]' for light in ("0", "all", "raking")),
        '#map [data-light="2"]',
        "[data-shape='1']",
        "[data-normals=depth]",
    ):
        page.page.click(selector)
        page.page.wait_for_function("!viewer.state.bentGoal || viewer.state.bent === viewer.state.bentGoal")
        page.settle()
        seen.append(picture(page))
        assert np.abs(seen[-1] - seen[-2]).mean() > 0.02, selector
        assert page.page.get_attribute(selector, "aria-pressed") == "true"
    page.page.click("#names [data-light=raking]")
    for slider, value in (("azimuth", "20"), ("elevation", "30"), ("exposure", "0.5"), ("gloss", "0.8"), ("distance", "0.8")):
        if slider == "distance":
            page.page.click("#names [data-light=pointer]")
        before = picture(page)
        page.page.fill(f"#{slider}", value)
        assert np.abs(picture(page) - before).mean() > 0.02, slider
    page.page.uncheck("#shadows")
    assert state(page, "shadows") is False
    page.page.check("#shadows")
    assert page.page.is_visible("#legend") is False
    with page.page.expect_download() as saved:
        page.page.click("#save")
    assert saved.value.suggested_filename == "ball.png"


@pytest.mark.slow
def test_a_distance_comes_with_its_sigma_and_a_section(page: Opened, tmp_path: Path) -> None:
    whole, (a, b) = whole_ball(), ((75, 60), (125, 90))
    page.page.click("[data-does=measure]")
    for column, row in (a, b):
        page.page.mouse.click(*screen_of(page, column, row))
    found = page.page.evaluate("viewer.measured")
    A, B = (whole.depth[r, c] * whole.rays_C[r, c].astype(float) for c, r in (a, b))
    d = np.linalg.norm(B - A)
    u = (B - A) / d
    shape = np.hypot(*(u @ whole.rays_C[r, c] * whole.depth_std[r, c] for c, r in (a, b)))
    assert found["d"] == pytest.approx(d, rel=1e-4)
    assert found["shape"] == pytest.approx(shape, rel=0.06)
    assert found["scale"] == pytest.approx(d * SCALE_STD, rel=1e-4)
    said = re.match(r"([\d.]+) ± ([\d.]+) mm", page.page.inner_text("#found"))
    assert said is not None
    assert [float(number) for number in said.groups()] == pytest.approx([1000 * d, 1000 * np.hypot(shape, d * SCALE_STD)], abs=0.011)
    with page.page.expect_download() as saved:
        page.page.click("#save-section")
    saved.value.save_as(tmp_path / "section.csv")
    along, above, sigma = np.loadtxt(tmp_path / "section.csv", delimiter=",", skiprows=1).T
    assert along[-1] == pytest.approx(1000 * d, rel=1e-3)
    assert above[[0, -1]] == pytest.approx([0, 0], abs=0.05)
    assert above.max() > 3
    assert np.all(sigma > 0)
    page.page.keyboard.press("Escape")
    page.page.focus("#view")
    page.page.keyboard.press("Escape")
    assert page.page.evaluate("viewer.measured") is None


@pytest.mark.slow
def test_keys_choose_what_dragging_does_and_the_focus_is_seen(page: Opened) -> None:
    page.page.focus("#view")
    for key, does in (("t", "turn"), ("m", "measure"), ("l", "light")):
        page.page.keyboard.press(key)
        assert state(page, "does") == does
    page.page.keyboard.press("Shift+Tab")
    page.page.keyboard.press("Tab")
    assert page.page.evaluate("document.activeElement.id") == "view"
    assert page.page.evaluate("getComputedStyle(document.activeElement).outlineStyle") == "solid"


@pytest.mark.slow
def test_two_fingers_zoom_on_a_phone(browser: Any, tmp_path: Path) -> None:
    phone = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True, "device_scale_factor": 2}
    found = ready(opened(browser, tmp_path, render(whole_ball(), lights(near=True)), **phone))
    session = found.page.context.new_cdp_session(found.page)
    before = eye(found)

    def touch(kind: str, apart: float) -> None:
        points = [{"x": 195 - apart, "y": 240, "id": 1}, {"x": 195 + apart, "y": 240, "id": 2}] if apart else []
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    touch("touchStart", 40)
    for apart in (60, 90, 120):
        touch("touchMove", apart)
    touch("touchEnd", 0)
    assert np.linalg.norm(eye(found) - CENTRE) < np.linalg.norm(before - CENTRE) - 0.05
    assert found.said == []
    assert found.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


@pytest.mark.slow
def test_a_large_surface_comes_whole_after_its_first_picture(browser: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(relight_page, "MOST_PIXELS", 2000)
    whole = whole_ball()
    data, bands = relight_page.pack(whole, lights(near=True))
    assert data["full"]["step"] == 1
    assert data["full"]["height"] == sum(rows for rows, _ in bands)
    found = ready(opened(browser, tmp_path, render(whole, lights(near=True))))
    assert found.page.evaluate("viewer.surface.w") == data["full"]["width"]
    codes = np.array(found.page.evaluate("Array.from(viewer.surface.code)")).reshape(data["full"]["height"], -1)
    rows, columns = (slice(start, start + size) for start, size in zip(data["origin"][::-1], codes.shape, strict=True))
    np.testing.assert_array_equal(codes > 0, whole.mask[rows, columns])
    low, high = data["depth"]
    depth = low + (codes - 1) / 65534 * (high - low)
    inside = codes > 0
    np.testing.assert_allclose(depth[inside], whole.depth[rows, columns][inside], atol=(high - low) / 65534)
    assert found.said == []


@pytest.mark.slow
def test_an_orthographic_surface_turns(browser: Any, tmp_path: Path) -> None:
    flat = ball(perspective=False, colour=True)
    found = ready(opened(browser, tmp_path, render(flat, lights(near=False)), view="#does=turn&yaw=0.7&pitch=0.2&gloss=0.6&light=all"))
    green, alpha, _ = found.grey()
    assert 0.05 < (alpha > 0).mean() < 0.9
    assert green[alpha > 0].std() > 10
    assert found.page.is_hidden("#shapes")
    assert found.said == []


@pytest.mark.slow
def test_axe_finds_nothing(page: Opened) -> None:
    for does in ("light", "measure"):
        page.page.click(f"[data-does={does}]")
        assert findings(page.page) == []


def test_lights_taken_as_distant_make_a_bowl_of_a_plane() -> None:
    whole = ball(perspective=True)
    n = np.array([0.0, 0.0, -1.0], np.float32)
    rays, mask = whole.rays_C, np.zeros(SIZE, bool)
    mask[20:130, 30:170] = True
    plane = replace(
        whole,
        normals=np.where(mask[..., None], n, np.nan).astype(np.float32),
        depth=np.where(mask, 0.35, np.nan).astype(np.float32),
        mask=mask,
        component=mask.astype(np.uint8),
        rays_C=rays,
    )
    found = bend_of(plane, lights(near=True))
    assert found is not None
    assert not found.solved
    rows, columns = found.factor.shape
    inner = found.factor[rows // 2 - 3 : rows // 2 + 3, columns // 2 - 3 : columns // 2 + 3].mean()
    rim = found.factor[[2, -3]].mean()
    assert abs(inner - rim) * 0.35 > 1e-3
    assert bend_of(plane, lights(near=False)) is None
    same = bend_of(plane, lights(near=True), plane)
    assert same is not None
    assert same.solved
    assert same.bowl == pytest.approx(0, abs=1e-7)
