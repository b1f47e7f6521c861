"""The model's page: what it is given, and what a browser draws and measures of it."""

from __future__ import annotations

import base64
import re
import zlib
from pathlib import Path

import numpy as np
import pytest

from browser_pages import WAIT_MS, chromium, findings, opened
from lpcal.report.model_page import model_html, pack
from page_kinds import quarter_ball


def test_the_mesh_comes_back() -> None:
    """Positions within a micrometre of what the model has, sigmas within a step of the logarithm."""
    model = quarter_ball()
    data = pack(model)
    stored = zlib.decompress(base64.b64decode(data["mesh"]))
    count = data["vertices"]
    code = np.frombuffer(stored, "<u2", 3 * count).reshape(-1, 3)
    found = np.array(data["low"]) + code / 65535 * np.array(data["span"])
    assert np.abs(found - model.vertices_A).max() < 1e-6
    faces = np.frombuffer(stored, "<u4", 3 * data["faces"], 6 * count).reshape(-1, 3)
    assert (faces == model.faces).all()
    at = 6 * count + 12 * data["faces"] + 6 * count
    sigma = data["least"] * 2 ** ((np.frombuffer(stored, np.uint8, count, at).astype(float) - 1) / data["steps"])
    assert np.abs(np.log(sigma / np.maximum(model.sigma_m, data["least"]))).max() < 0.03
    assert len(stored) == at + 3 * count


def test_the_page_says_what_is_missing() -> None:
    """The words stand in it, escaped; a model of too many triangles says that it is thinned."""
    text = model_html(quarter_ball())
    assert "missing, of 40.0\N{NO-BREAK SPACE}cm²" in text
    assert "stop_02 is left out" in text
    assert "next: the camera at 1000, 2000, 900\N{NO-BREAK SPACE}mm" in text
    assert not re.search(r"https?://(?!www.w3.org)", text.split('<script id="three"')[0])


@pytest.mark.slow
def test_a_browser_draws_and_measures_it(tmp_path: Path) -> None:
    """Every kind of picture is drawn; two picked points have a distance with its sigma, and a section; nothing is asked of the network."""
    with chromium() as browser:
        found = opened(browser, tmp_path, model_html(quarter_ball()), viewport={"width": 700, "height": 480})
        page = found.page
        page.wait_for_selector("html[data-drawn=yes]", timeout=WAIT_MS)
        for mode in ("shading", "normals", "sigma", "apart", "seen", "albedo"):
            page.click(f"[data-mode={mode}]")
        page.uncheck("[data-layer=views]")
        page.click("[data-does=measure]")
        box = page.locator("#view").bounding_box()
        for share in (0.46, 0.54):
            page.mouse.click(box["x"] + share * box["width"], box["y"] + 0.5 * box["height"])
        page.wait_for_selector("#section svg")
        said = page.locator("#found").inner_text()
        assert re.match(r"[\d.]+ ± [\d.]+ mm", said), said
        assert float(said.split()[0]) < 80
        assert findings(page) == []
        assert found.said == []
