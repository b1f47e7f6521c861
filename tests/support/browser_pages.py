"""A browser for the tests of pages: headless Chromium that draws by software, pages opened from file:// with no network."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

WORDS = ("--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-background-networking", "--disable-component-update")
WAIT_MS = 90_000
"""Milliseconds after which a page that should have drawn has not: the machine may be busy."""
NO_WEBGL = """
const real = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
  return kind.startsWith("webgl") ? null : real.call(this, kind, ...rest);
};
"""
GREY = """(canvas) => {
  const copy = document.createElement("canvas"), rows = [], step = 4;
  copy.width = canvas.width; copy.height = canvas.height;
  const pen = copy.getContext("2d"); pen.drawImage(canvas, 0, 0);
  const every = pen.getImageData(0, 0, copy.width, copy.height).data;
  for (let y = 0; y < copy.height; y += step) {
    const row = [];
    for (let x = 0; x < copy.width; x += step) { const k = 4 * (y * copy.width + x); row.push(every[k + 1] + 1000 * every[k + 3]); }
    rows.push(row);
  }
  return JSON.stringify({ width: canvas.width, height: canvas.height, step, rows });
}"""


@contextmanager
def chromium() -> Iterator[Any]:
    """The browser; the test is skipped where there is none."""
    program = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if program is None:
        pytest.skip("chromium is not installed")
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as running:
        browser = running.chromium.launch(executable_path=program, args=list(WORDS))
        try:
            yield browser
        finally:
            browser.close()


class Opened:
    """A page, what it said, and what it asked of the network."""

    def __init__(self, page: Any) -> None:
        self.page = page
        self.said: list[str] = []
        page.on("pageerror", lambda error: self.said.append(str(error)))
        page.on("console", lambda line: self.said.append(line.text) if line.type == "error" else None)
        page.on("request", lambda asked: None if asked.url.startswith(("file:", "data:", "blob:")) else self.said.append(asked.url))

    def settle(self) -> None:
        """Wait until all is drawn as finely as it will be."""
        self.page.wait_for_function("document.documentElement.dataset.rest === 'true'", timeout=WAIT_MS)

    def grey(self, selector: str = "#view") -> tuple[np.ndarray, np.ndarray, dict[str, Any]]:
        """Green and alpha (h, w) of every fourth pixel of a canvas, and its size."""
        found = json.loads(self.page.evaluate(f"async () => {{ viewer.redraw(); return ({GREY})(document.querySelector('{selector}')); }}"))
        both = np.array(found.pop("rows"))
        return both % 1000, both // 1000, found


def opened(browser: Any, folder: Path, html: str, *, view: str = "", before: str = "", **context: Any) -> Opened:
    """A page of this text, opened from file://; it has drawn when this returns."""
    file = folder / "page.html"
    file.write_text(html, encoding="utf-8")
    page = browser.new_context(**({"viewport": {"width": 900, "height": 640}} | context)).new_page()
    found = Opened(page)
    if before:
        page.add_init_script(before)
    page.goto(file.as_uri() + view)
    return found


def ready(found: Opened) -> Opened:
    """Wait for a relighting page's first picture, and until it stands."""
    found.page.wait_for_function("document.documentElement.dataset.level || !document.getElementById('message').hidden", timeout=WAIT_MS)
    found.settle()
    return found


def findings(page: Any) -> list[tuple[str, str]]:
    """What axe-core finds wrong with a page as it stands: each rule, and the first element that breaks it."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright").Axe()
    return [(found["id"], found["nodes"][0]["html"][:300]) for found in axe.run(page).response["violations"]]
