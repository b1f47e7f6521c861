"""The report's page for rigs of six kinds, on a desk and in a hand, light and dark: it fits, and axe-core finds nothing."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from browser_pages import Opened, chromium, findings
from lpcal.records.body_course import BodyCourse, Lapse
from lpcal.records.calibration import Calibration
from lpcal.report.page import render
from lpcal.report.rig_report import PARTS, RigReport
from lpcal.report.scene import room_scene
from report_rig import documents, read, report_of, surface

SCREENS = {"desk": (1280, 800), "hand": (390, 844)}
SCHEMES = ("light", "dark")


def course() -> BodyCourse:
    t_s = np.delete(np.linspace(0, 60, 121), np.arange(40, 46))
    return BodyCourse(
        t_s, 0.2 * np.abs(np.sin(t_s / 5)), np.abs(np.cos(t_s / 7)), (Lapse(20, 22.5, tracked=False), Lapse(41, 41.4, tracked=True))
    )


def timed(report: RigReport) -> RigReport:
    return replace(report, course=course(), image_times_s={view.image: 5.0 + 9 * k for k, view in enumerate(report.handeye.views)})


def bad() -> RigReport:
    """A rig of which nothing can be relied on: few views, wide sigmas, pieces in doubt, warnings."""
    whole = documents(3)
    for view in whole["handeye"]["views"][:3]:
        view["used"], view["why"] = False, "flipped: its board is 180 degrees off"
    report = timed(report_of(whole, surface(0.09), name="a_rig_with_a_name_that_is_longer_than_a_phone_is_wide"))
    wide = replace(report.handeye, H_PC_covariance=1e4 * report.handeye.H_PC_covariance, warnings=("the panel turned about one axis only",))
    lights = tuple(replace(light, direction_std_rad=0.05, position_std_m=0.02) for light in report.lights.lights)
    found = replace(report.lights, lights=lights, warnings=("chrome_0: its outline is not round; is it the sphere's?",))
    return replace(report, handeye=wide, lights=found)


def rigs() -> dict[str, RigReport]:
    whole = documents()

    def of(*kinds: str, name: str) -> RigReport:
        return report_of({kind: whole[kind] for kind in kinds}, name=name)

    lacks = frozenset(PARTS)
    hand = of("camera", "H_CB", "H_OP", "handeye", name="robot")
    return {
        "panel": timed(report_of(whole, surface(), name="panel")),
        "dome": replace(of("camera", "H_CB", "lights", "calibration", name="dome"), lacks=lacks - {"camera", "lights", "spheres"}),
        "dome without camera": replace(of("lights", "calibration", name="dome"), lacks=lacks - {"lights", "spheres"}),
        "robot": replace(hand, lacks=lacks - {"camera", "handeye"}),
        "hand-eye only": replace(of("H_OP", "handeye", name="hand"), calibration=Calibration("hand", ()), lacks=lacks - {"handeye"}),
        "bad": bad(),
    }


SECTIONS = {
    "panel": {"camera", "handeye", "lights", "spheres", "surfaces"},
    "dome": {"camera", "lights", "spheres"},
    "dome without camera": {"lights", "spheres"},
    "robot": {"camera", "handeye"},
    "hand-eye only": {"handeye"},
    "bad": {"camera", "handeye", "lights", "spheres", "surfaces"},
}


@pytest.mark.parametrize("kind", SECTIONS)
def test_a_page_has_the_sections_of_its_rig(kind: str) -> None:
    found = read(render(rigs()[kind]))
    assert found.ids & set(PARTS) == SECTIONS[kind]
    assert {f"#{part}" for part in SECTIONS[kind]} <= set(found.references)
    assert ("rays are taken as parallel" in " ".join(found.words)) == (kind == "dome without camera"), "a hand-eye alone takes no rays"


def test_the_board_stands_in_the_room_of_a_hand_eye_alone() -> None:
    """Its corners are not known there, but its place is."""
    report = rigs()["hand-eye only"]
    scene = room_scene(report)
    assert scene is not None
    board = [item for item in scene.items if item.layer == "board"]
    assert [item.text for item in board if item.kind == "label"] == ["B"]
    assert any(np.allclose(item.points[0], report.handeye.H_OB[:3, 3]) for item in board)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as running:
        yield running


@pytest.mark.slow
@pytest.mark.parametrize("kind", SECTIONS)
def test_it_fits_every_screen_and_axe_finds_nothing(browser: Any, tmp_path: Path, kind: str) -> None:
    file = tmp_path / "report.html"
    file.write_text(render(rigs()[kind]), encoding="utf-8")
    page = browser.new_page()
    opened = Opened(page)
    page.goto(file.as_uri())
    for screen, (width, height) in SCREENS.items():
        for scheme in SCHEMES:
            page.set_viewport_size({"width": width, "height": height})
            page.emulate_media(color_scheme=scheme)
            assert page.evaluate("document.documentElement.scrollWidth") <= width, f"{screen}: wider than the screen"
            assert findings(page) == [], (screen, scheme)
            page.screenshot(path=tmp_path / f"{screen}_{scheme}.png", full_page=True)
    assert opened.said == []
    page.close()
