"""The relighting page: what is packed comes out again, and both pages run in a browser from file://."""

from __future__ import annotations

import base64
import json
import re
import shutil
import subprocess
import zlib
from typing import Any

import numpy as np
import pytest

from lpcal.geometry import camera as central
from lpcal.records.calibration import Calibration, Light, Lobe
from lpcal.records.surface import Surface
from lpcal.report import relight_page
from lpcal.report.page import render as render_report
from lpcal.report.relight_page import render
from report_rig import documents, read, report_of, surface

SIZE = (150, 200)
K = np.array([[260.0, 0, 101], [0, 261.0, 73], [0, 0, 1]])
DISTORTION = np.array([-0.25, 0.08, 1e-3, -5e-4])
CENTRE, RADIUS = np.array([0.01, -0.005, 0.4]), 0.09

WATCH = """<script>
window.said = [];
window.addEventListener("error", (event) => window.said.push(String(event.message)));
window.addEventListener("unhandledrejection", (event) => window.said.push(String(event.reason)));
window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
console.error = (...words) => window.said.push(words.join(" "));
for (const name of ["fetch", "XMLHttpRequest", "WebSocket"]) window[name] = function () { window.said.push(name + " was used"); };
</script>"""
NO_WEBGL = """<script>
const real = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
  return kind.startsWith("webgl") ? null : real.call(this, kind, ...rest);
};
</script>"""
TELL = """<script>
function tell() {
  const canvases = [...document.querySelectorAll("canvas")].map((canvas) => {
    const copy = document.createElement("canvas"), rows = [], step = 4;
    copy.width = canvas.width; copy.height = canvas.height;
    const pen = copy.getContext("2d");
    pen.drawImage(canvas, 0, 0);
    const all = pen.getImageData(0, 0, copy.width, copy.height).data;
    for (let y = 0; y < copy.height; y += step) {
      const row = [];
      for (let x = 0; x < copy.width; x += step) { const k = 4 * (y * copy.width + x); row.push(all[k + 1] + 1000 * all[k + 3]); }
      rows.push(row);
    }
    return { width: canvas.width, height: canvas.height, step, rows };
  });
  const told = document.createElement("pre");
  told.id = "told";
  told.textContent = JSON.stringify({ said: window.said, ready: document.documentElement.dataset.ready || null, canvases,
    readout: (document.getElementById("readout") || {}).textContent, apart: (document.getElementById("distance-out") || {}).textContent });
  document.body.append(told);
}
(function wait() {
  const ready = !document.getElementById("view") || document.documentElement.dataset.ready || window.said.length;
  if (!ready) { setTimeout(wait, 50); return; }
  if (window.act) window.act();
  setTimeout(tell, 400);
})();
</script>"""


def ball(*, perspective: bool, colour: bool = False) -> Surface:
    """A ball as a camera sees it, or an orthographic one in pixels."""
    h, w = SIZE
    x, y = np.meshgrid(np.arange(w, dtype=float), np.arange(h, dtype=float))
    if perspective:
        rays = central.unproject(np.stack([x, y], axis=-1), K, DISTORTION)
        along = rays @ CENTRE
        inside = along**2 - CENTRE @ CENTRE + RADIUS**2
        mask = inside > (0.2 * RADIUS) ** 2
        points = (along - np.sqrt(np.where(mask, inside, 0)))[..., None] * rays
        normals, depth, rays = (points - CENTRE) / RADIUS, points[..., 2], rays / rays[..., 2:]
    else:
        normals = np.stack([(x - 95) / 60, (y - 70) / 60, np.zeros_like(x)], axis=-1)
        mask = (normals**2).sum(axis=-1) < 0.95
        normals[..., 2] = -np.sqrt(np.where(mask, 1 - (normals**2).sum(axis=-1), 1))
        depth, rays = 60 * normals[..., 2], np.broadcast_to([0.0, 0.0, 1.0], (h, w, 3))
    albedo = 0.6 + 0.3 * np.sin(x / 7) * np.cos(y / 9)
    albedo = np.stack([albedo, 0.8 * albedo, 0.5 * albedo], axis=-1) if colour else albedo
    sigma = 1 + x / w

    def outside_nan(value: Any) -> Any:
        return np.where(mask.reshape(mask.shape + (1,) * (value.ndim - 2)), value, np.nan).astype(np.float32)

    return Surface(
        name="ball",
        normals=outside_nan(normals),
        depth=outside_nan(depth),
        albedo=outside_nan(albedo),
        mask=mask,
        normal_std_deg=outside_nan(sigma),
        depth_std=outside_nan(0 * sigma),
        lights_used=np.where(mask, 6, 0).astype(np.uint8),
        component=mask.astype(np.uint8),
        rays_C=np.asarray(rays),
    )


def lights(*, near: bool) -> Calibration:
    """Three lights about the camera, all near or all distant."""
    found = []
    for k in range(3):
        source = np.array([0.2 * np.cos(2.1 * k), 0.2 * np.sin(2.1 * k), 0.02])
        axis = (CENTRE - source) / np.linalg.norm(CENTRE - source)
        place = {"source_C": source, "axis_C": axis, "lobe": Lobe("cosine", exponent=3.0)} if near else {}
        found.append(Light(name=f"L{k}", direction_C=-axis, intensity=np.array([1.0 + 0.1 * k]), **place))
    return Calibration("three", tuple(found))


def unpacked(data: dict[str, Any]) -> dict[str, Any]:
    """What the browser makes of the planes, written a second time."""
    h, w = data["height"], data["width"]
    stored = np.frombuffer(zlib.decompress(base64.b64decode(data["planes"])), np.uint8)
    planes, at = [], 0
    for wide in [True, True, True, *[False] * (data["channels"] + 3)]:
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
        "sigma": 2 ** (planes[-3] / data["sigmaScale"]) - 1,
        "lights": planes[-2],
    }


@pytest.mark.parametrize("perspective", [True, False])
@pytest.mark.parametrize("colour", [True, False])
def test_what_is_packed_comes_out_again(perspective: bool, colour: bool) -> None:
    whole = ball(perspective=perspective, colour=colour)
    data = relight_page.pack(whole, None)
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
    assert set(found["lights"][mask]) == {6}
    assert data["perspective"] == perspective


def test_normals_that_look_away_survive_the_packing() -> None:
    whole = ball(perspective=True)
    away = whole.normals * np.array([1, 1, -1], np.float32)
    data = relight_page.pack(Surface(**{**vars(whole), "normals": away}), None)
    found = unpacked(data)
    window = tuple(slice(start, start + size) for start, size in zip(data["origin"][::-1], found["mask"].shape, strict=True))
    np.testing.assert_allclose(found["normals"][found["mask"]], away[window][found["mask"]], atol=2e-4)


def test_a_large_surface_is_averaged_down(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(relight_page, "MOST_PIXELS", 4000)
    whole = ball(perspective=True)
    data = relight_page.pack(whole, None)
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
    packed = relight_page.pack(ball(perspective=False), lights(near=True))["lights"]
    assert [light["source"] for light in packed] == [None] * 3
    packed = relight_page.pack(ball(perspective=True), lights(near=True))["lights"]
    assert all(light["source"] is not None and light["lobe"][0] == pytest.approx(1) for light in packed)


def test_the_page_stands_alone() -> None:
    page = render(ball(perspective=True), lights(near=True))
    assert [ref for ref in read(page).references if not ref.startswith("data:")] == []
    assert not re.search(r"https?://(?!www\.w3\.org)", page)
    assert "url(" not in page


@pytest.fixture(scope="session")
def browse(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Open a page from file:// in headless Chromium: what it said, and what its canvases show."""
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if chromium is None:
        pytest.skip("chromium is not installed")

    def browse(page: str, *, view: str = "", before: str = "", size: str = "900,640") -> dict[str, Any]:
        folder = tmp_path_factory.mktemp("browser")
        file = folder / "page.html"
        file.write_text(page.replace("<head>", "<head>" + WATCH + before, 1).replace("</body>", TELL + "</body>"), encoding="utf-8")
        quiet = "--no-first-run --disable-background-networking --disable-component-update --disable-sync --disable-quic --disable-gpu"
        gl = "--use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader"
        words = [chromium, "--headless", "--no-sandbox", *quiet.split(), *gl.split(), f"--user-data-dir={folder / 'profile'}"]
        words += ["--virtual-time-budget=20000", f"--window-size={size}", "--dump-dom", file.as_uri() + view]
        dom = subprocess.run(words, capture_output=True, text=True, timeout=120, check=True).stdout
        told = re.search(r'<pre id="told">(.*?)</pre>', dom, re.DOTALL)
        assert told is not None, "the page never drew"
        return json.loads(told[1].replace("&amp;", "&").replace("&lt;", "<").replace("&gt;", ">"))

    return browse


def shown(canvas: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Green and alpha of every fourth pixel of a canvas."""
    both = np.array(canvas["rows"])
    return both % 1000, both // 1000


def lambert(whole: Surface, canvas: dict[str, Any], light: Light) -> np.ndarray:
    """What a canvas should show of a surface under one light, up to a factor: albedo E n.d at its own pixels; NaN outside."""
    data = relight_page.pack(whole, None)
    scale = min(0.84 * canvas["width"] / data["width"], 0.84 * canvas["height"] / data["height"])
    left, top = (canvas["width"] - scale * data["width"]) / 2, (canvas["height"] - scale * data["height"]) / 2
    rows, columns = (np.arange(0, canvas[key], canvas["step"]) + 0.5 for key in ("height", "width"))
    x, y = np.meshgrid(np.floor((columns - left) / scale) + data["origin"][0], np.floor((rows - top) / scale) + data["origin"][1])
    x, y = np.clip(x, 0, SIZE[1] - 1).astype(int), np.clip(y, 0, SIZE[0] - 1).astype(int)
    points = whole.depth[..., None] * whole.rays_C
    d, irradiance = light.field(points)
    shade = whole.albedo * irradiance[..., 0] * np.maximum((whole.normals * d).sum(axis=-1), 0)
    return np.asarray(np.where(whole.mask, shade, np.nan)[y, x])


@pytest.mark.parametrize(("before", "ready"), [("", "webgl2"), (NO_WEBGL, "canvas")])
def test_the_browser_lights_the_surface_as_the_light_did(browse: Any, before: str, ready: str) -> None:
    whole, calibration = ball(perspective=True), lights(near=True)
    found = browse(render(whole, calibration), view="#light=L1&exposure=-1", before=before)
    assert found["said"] == []
    assert found["ready"] == ready
    green, alpha = shown(found["canvases"][0])
    expected = lambert(whole, found["canvases"][0], calibration.lights[1])
    inner = (np.nan_to_num(expected) > 0) & (alpha == 255) & (green > 30) & (green < 215)
    assert inner.sum() > 1500
    ratio = (green[inner] / 255.0) ** 2.2 / expected[inner]
    spread = np.median(np.abs(ratio / np.median(ratio) - 1))
    assert spread < 0.04
    assert np.corrcoef((green[inner] / 255.0) ** 2.2, expected[inner])[0, 1] > 0.98


@pytest.mark.slow
def test_the_browser_turns_an_orthographic_surface(browse: Any) -> None:
    found = browse(
        render(ball(perspective=False, colour=True), lights(near=False)), view="#does=turn&yaw=0.7&pitch=0.2&gloss=0.6&light=all"
    )
    assert found["said"] == []
    assert found["ready"] == "webgl2"
    green, alpha = shown(found["canvases"][0])
    assert 0.05 < (alpha > 0).mean() < 0.9
    assert green[alpha > 0].std() > 10


def test_the_browser_draws_the_report(browse: Any) -> None:
    found = browse(render_report(report_of(documents(), surface())))
    assert found["said"] == []
    assert len(found["canvases"]) == 2
    for canvas in found["canvases"]:
        assert 0.005 < (shown(canvas)[1] > 0).mean() < 0.9


@pytest.mark.parametrize("side", [0.35, pytest.param(0.65, marks=pytest.mark.slow)])
def test_the_light_follows_the_pointer_and_the_wheel(browse: Any, side: float) -> None:
    act = f"""<script>
    window.act = () => {{
      const view = document.getElementById("view"), box = view.getBoundingClientRect();
      const at = {{ clientX: box.left + {side} * box.width, clientY: box.top + 0.5 * box.height, pointerType: "mouse", bubbles: true }};
      view.dispatchEvent(new PointerEvent("pointermove", at));
      view.dispatchEvent(new WheelEvent("wheel", {{ deltaY: -400, cancelable: true }}));
    }};
    </script>"""
    found = browse(render(ball(perspective=True), lights(near=True)), before=act)
    assert found["said"] == []
    green, alpha = shown(found["canvases"][0])
    columns = np.broadcast_to(np.linspace(0, 1, green.shape[1]), green.shape)
    bright = np.where(alpha == 255, green.astype(float) ** 2.2, 0)
    brightest = (columns * bright).sum() / bright.sum()
    assert (brightest < 0.47) == (side < 0.5)
    assert (brightest > 0.53) == (side > 0.5)
    assert re.search(r"depth 3\d\d\.\d mm .* 6 lights", found["readout"])
    apart_mm = float(found["apart"].split()[0])
    assert 0 < apart_mm < 1000 * RADIUS * 0.6
