"""The model's page: what it is given, and what a browser draws and measures of it."""

from __future__ import annotations

import base64
import re
import zlib
from pathlib import Path

import numpy as np
import pytest

from browser_pages import WAIT_MS, chromium, findings, opened
from lpcal.records.model import Missing, ModelFigures, NextStop, ObjectModel, ViewInModel
from lpcal.report.model_page import model_html, pack


def ball() -> ObjectModel:
    """A quarter of a ball of 40 mm radius about (1, 2, 0.5) m, as two views might have it."""
    azimuth, height = np.meshgrid(np.linspace(-0.8, 0.8, 24), np.linspace(-0.8, 0.8, 24))
    n = np.stack([np.cos(height) * np.sin(azimuth), np.sin(height), np.cos(height) * np.cos(azimuth)], axis=-1).reshape(-1, 3)
    at = np.arange(23 * 24).reshape(23, 24)[:, :-1].ravel()
    faces = np.concatenate([np.stack([at, at + 1, at + 25], axis=1), np.stack([at, at + 25, at + 24], axis=1)])
    H = np.eye(4)
    H[:3, :3], H[:3, 3] = np.diag([1.0, -1.0, -1.0]), [1.0, 2.0, 0.9]
    views = tuple(ViewInModel(f"stop_0{k}", True, None, 0.9, 1e-4, 1e-3, 1e-3, 5e-5, H) for k in range(2))
    figures = ModelFigures(1e-3, 5e-5, 1, 4e-3, 2e-3, 2e-4, 0.9, 0.0, 0.1, 0.0, 0.002)
    missing = Missing(4e-3, 1e-3, 4e-4, 0.0, (NextStop(H, None, "stop_00", 0.8, 0.35, 5e-4, 1e-4, False),))
    sigma, one = np.linspace(1e-4, 1e-3, len(n)), np.ones(len(n))
    centre = np.array([1.0, 2.0, 0.5])
    return ObjectModel(
        "ball", "the room", centre + 0.04 * n, n, faces, 0.5 * np.ones_like(n), sigma, 0.01 * one, 0 * one, one.astype(int), views, figures,
        ("stop_02 is left out: of something else",), missing,
    )  # fmt: skip


def test_the_mesh_comes_back() -> None:
    """Positions within a micrometre of what the model has, sigmas within a step of the logarithm."""
    model = ball()
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
    text = model_html(ball())
    assert "missing, of 40.0 cm2" in text
    assert "stop_02 is left out" in text
    assert "next: the camera at 1000, 2000, 900 mm" in text
    assert not re.search(r"https?://(?!www.w3.org)", text.split('<script id="three"')[0])


@pytest.mark.slow
def test_a_browser_draws_and_measures_it(tmp_path: Path) -> None:
    """Every kind of picture is drawn; two picked points have a distance with its sigma, and a section; nothing is asked of the network."""
    with chromium() as browser:
        found = opened(browser, tmp_path, model_html(ball()), viewport={"width": 700, "height": 480})
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
