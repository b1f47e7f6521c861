"""Measures the relighting page of a synthetic surface of eight megapixels in headless Chromium, drawn by software.

Says the page's size, the time to pack it and to its first picture, frames a second while it turns and while the light moves, processor
seconds a frame, and the memory of the browser's processes. `--pixels N` for other sizes.
"""

from __future__ import annotations

import argparse
import os
import resource
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

TURN = """async ([what, seconds]) => {
  const canvas = document.getElementById("view"), first = viewer.frames, start = performance.now();
  const send = (kind, x, y, buttons) => canvas.dispatchEvent(new PointerEvent(kind, { clientX: x, clientY: y, pointerId: 1, buttons, bubbles: true, pointerType: "mouse" }));
  document.querySelector(`[data-does=${what}]`).click();
  send("pointerdown", 500, 360, 1);
  for (;;) {
    const t = (performance.now() - start) / 1000;
    if (t > seconds) break;
    send("pointermove", 500 + 200 * Math.sin(2 * t), 360 + 100 * Math.sin(1.3 * t), 1);
    await new Promise((go) => requestAnimationFrame(go));
  }
  send("pointerup", 500, 360, 0);
  return [viewer.frames - first, (performance.now() - start) / 1000, viewer.drawn.triangles, viewer.pace.level];
}"""  # noqa: E501


def surface(pixels: int) -> Any:
    """A bumpy relief of about so many pixels, 4 to 3, at 400 mm."""
    from lpcal.records.surface import Component, Surface

    h, w = round((pixels * 3 / 4) ** 0.5), round((pixels * 4 / 3) ** 0.5)
    x, y = np.meshgrid(np.linspace(-1, 1, w, dtype=np.float32), np.linspace(-0.75, 0.75, h, dtype=np.float32))
    rng = np.random.default_rng(0)
    relief = sum(
        a * np.sin(k * x + p) * np.cos(k * y + q)
        for a, k, p, q in zip(0.02 / np.arange(1, 9), 5 * np.arange(1, 9), *rng.random((2, 8)), strict=True)
    )
    mask = (x**2 + (y / 0.75) ** 2) < 0.96
    depth = (0.4 + 0.2 * relief).astype(np.float32)
    rays = np.stack([0.3 * x, 0.3 * y, np.ones_like(x)], axis=-1)
    points = depth[..., None] * rays
    n = np.cross(np.gradient(points, axis=0), np.gradient(points, axis=1))
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    n += rng.normal(0, 0.005, n.shape)
    n = (-n * np.sign((n * rays).sum(axis=-1, keepdims=True))).astype(np.float32)
    albedo = (0.5 + 0.3 * np.sin(40 * x) * np.cos(33 * y) + rng.normal(0, 0.01, x.shape)).astype(np.float32)
    nan = np.float32(np.nan)
    return Surface(
        "relief",
        np.where(mask[..., None], n, nan),
        np.where(mask, depth, nan),
        np.where(mask, albedo, nan),
        mask,
        np.where(mask, np.float32(0.5), nan),
        np.where(mask, np.float32(2e-5), nan),
        np.where(mask, 8, 0).astype(np.uint8),
        mask.astype(np.uint8),
        rays,
        components=(Component(1, int(mask.sum()), 0.4, 0.003),),
    )


def processes(root: int) -> dict[int, tuple[float, float]]:
    """Processor seconds and resident megabytes of each process below `root`, by its id."""
    tick, parents, found = os.sysconf("SC_CLK_TCK"), {}, {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                fields = (entry / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            parents[int(entry.name)] = int(fields[1])
            found[int(entry.name)] = ((int(fields[11]) + int(fields[12])) / tick, int(fields[21]) * os.sysconf("SC_PAGE_SIZE") / 1e6)

    def below(one: int) -> bool:
        while one in parents and one != root:
            one = parents[one]
        return one == root

    return {one: value for one, value in found.items() if one != root and below(one)}


def used_s() -> float:
    """Processor seconds of all processes below this one."""
    return sum(seconds for seconds, _ in processes(os.getpid()).values())


def main() -> int:
    from browser_pages import WAIT_MS, chromium
    from lpcal.report.relight_page import render
    from relight_ball import lights

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pixels", type=int, default=8_000_000)
    parser.add_argument("--seconds", type=float, default=8)
    options = parser.parse_args()
    whole = surface(options.pixels)
    begun = time.process_time()
    page = render(whole, lights(near=True))
    packing_s, peak_mb = time.process_time() - begun, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{whole.mask.size / 1e6:.1f} megapixels: page {len(page) / 1e6:.1f} MB, packed in {packing_s:.1f} s, peak {peak_mb:.0f} MB")
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        file = Path(folder) / "relight.html"
        file.write_text(page, encoding="utf-8")
        shown = browser.new_page(viewport={"width": 1280, "height": 720})
        shown.goto(file.as_uri(), wait_until="commit")
        shown.wait_for_function("document.documentElement.dataset.ready", timeout=WAIT_MS)
        print(f"first picture after {shown.evaluate('viewer.first') / 1000:.2f} s, {used_s():.1f} s of processor time with the start")
        shown.wait_for_function("document.documentElement.dataset.level === 'whole'", timeout=4 * WAIT_MS)
        print(f"whole after {shown.evaluate('performance.now()') / 1000:.1f} s")
        for what in ("turn", "light", "turn", "light"):
            before = used_s()
            frames, seconds, triangles, level = shown.evaluate(TURN, [what, options.seconds])
            frame_ms = 1000 * (used_s() - before) / max(frames, 1)
            pace = f"{frames / seconds:.1f} frames/s, {frame_ms:.0f} ms of processor time a frame"
            print(f"{what}: {pace}, {triangles} triangles, thinning {level}")
        held_mb, scripts_mb = (
            sum(size for _, size in processes(os.getpid()).values()),
            shown.evaluate("performance.memory.usedJSHeapSize") / 1e6,
        )
        print(f"memory {held_mb:.0f} MB in all processes, {scripts_mb:.0f} MB of scripts")
    return 0


if __name__ == "__main__":
    sys.exit(main())
