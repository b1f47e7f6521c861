"""The report's page for rigs of six kinds, and for a calibration without one: each has the sections that fit it."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from lpcal.report.chain_sections import _short
from lpcal.report.page import render
from lpcal.report.rig_report import PARTS
from lpcal.report.scene import room_scene
from lpcal.report.wording import typeset
from page_kinds import collection_page, diff_page, rigs
from report_rig import read, text_of

SECTIONS = {
    "panel": {"camera", "handeye", "lights", "spheres", "surfaces"},
    "dome": {"camera", "lights", "spheres"},
    "dome without camera": {"lights", "spheres"},
    "robot": {"camera", "handeye"},
    "hand-eye only": {"handeye"},
    "bad": {"camera", "handeye", "lights", "spheres", "surfaces"},
    "calibration alone": {"lights"},
}

WITHOUT_RAYS = {"dome without camera", "calibration alone"}
"""Rigs whose lights are known and whose camera is not."""


@pytest.mark.parametrize("kind", SECTIONS)
def test_a_page_has_the_sections_of_its_rig(kind: str) -> None:
    found = read(render(rigs()[kind]))
    assert found.ids & set(PARTS) == SECTIONS[kind]
    assert {f"#{part}" for part in SECTIONS[kind]} <= set(found.references)
    assert ("rays are taken as parallel" in " ".join(found.words)) == (kind in WITHOUT_RAYS), "a hand-eye alone takes none"


def test_the_board_stands_in_the_room_of_a_hand_eye_alone() -> None:
    """Its corners are not known there, but its place is."""
    report = rigs()["hand-eye only"]
    scene = room_scene(report)
    assert scene is not None
    board = [item for item in scene.items if item.layer == "board"]
    assert [item.text for item in board if item.kind == "label"] == ["B"]
    assert any(np.allclose(item.points[0], report.handeye.H_OB[:3, 3]) for item in board)


def test_directions_meet_nowhere() -> None:
    """Lights without places have no focus, whatever point stands in the file; spheres without places have no columns for them."""
    report = rigs()["dome without camera"]
    far = tuple(replace(light, source_C=None, axis_C=None, H_CL=None) for light in report.lights.lights)
    unplaced = tuple(replace(one, centre_C=None, radius_m=None, residual=float("nan")) for one in report.lights.spheres)
    found = read(render(replace(report, lights=replace(report.lights, lights=far, focus_C=np.zeros(3), d_object_m=None, spheres=unplaced))))
    said = " ".join(found.words)
    assert "axes meet" not in said
    assert "focus, 0 mm" not in said
    assert "centre, mm" not in said


def test_what_is_wrong_is_said_once() -> None:
    """A warning stands with the verdict alone, and a pose that has no image under its bar by its time."""
    said = " ".join(read(render(rigs()["bad"])).words)
    for warning in ("the panel turned about one axis only", "chrome_0: its outline is not round"):
        assert said.count(warning) == 1
    assert _short("H_CB.csv at 22.9951 s") == "22.9951 s"
    assert _short("stations/07.png") == "07"


@pytest.mark.parametrize("kind", [*SECTIONS, "collection", "diff"])
def test_no_line_breaks_between_a_number_and_its_unit(kind: str) -> None:
    """Nor before its sigma; and degrees and areas are not said in the letters of the commands."""
    made = {"collection": collection_page, "diff": diff_page}
    page = made[kind]() if kind in made else render(rigs()[kind])
    told = re.sub(r"<(script|style|pre)\b.*?</\1>", "", page, flags=re.DOTALL)
    for _ in range(2):  # a drawing may hold another
        told = re.sub(r"<svg\b(?:(?!<svg\b).)*?</svg>", "", told, flags=re.DOTALL)
    for words in read(told).words:
        assert words == typeset(words), words


@pytest.mark.parametrize(
    ("plain", "set_so"),
    [
        ("worst along z, 0.16 mm, and 0.014 deg; 8 more", "worst along z, 0.16_mm, and 0.014°; 8 more"),
        ("0.000 (0.041) deg, distances +0.00 %", "0.000 (0.041)°, distances +0.00_%"),
        ("position ≤ 0.8 mm, clock ≤ 0.5 ms", "position ≤_0.8_mm, clock ≤_0.5_ms"),
        ("some 10.0 cm2 of 3 sides", "some 10.0_cm² of 3 sides"),
        ("worst along (-0.47, 0.65) of stop-2, 10-20", "worst along (−0.47, 0.65) of stop-2, 10-20"),
        ("343.8 ± 5.5 mm", "343.8_±_5.5_mm"),
        ("480 × 320 px, 49.7° × 34.3°", "480_×_320_px, 49.7° ×_34.3°"),
        ("sigma of depth, 0 to 0.95 mm", "sigma of depth, 0_to_0.95_mm"),
        ("3 moved, 2 mm2 and 5 decisions", "3 moved, 2 mm2 and 5 decisions"),
    ],
)
def test_words_as_a_page_sets_them(plain: str, set_so: str) -> None:
    assert typeset(plain) == set_so.replace("_", "\N{NO-BREAK SPACE}")


def test_every_residual_of_a_hand_eye_alone_has_its_rms() -> None:
    """Its corners have none, as it took no images; the two others say theirs, each its own."""
    said = " ".join(text_of(render(rigs()["hand-eye only"])).split())
    for measure in ("The board misses its place", "The board is turned"):
        assert re.search(rf"{measure} [\d.]+( mm|°) rms", said), measure
