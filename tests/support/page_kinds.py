"""Every kind of page that lpcal makes, each of a small rig or surface, as its text; pages that ask a server are served."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np

from lpcal.api.comparison import compare_calibrations
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.pipeline.diff import remarks_of, verdict
from lpcal.pipeline.watch_page import served
from lpcal.records.body_course import BodyCourse, Lapse
from lpcal.records.calibration import Calibration, Light
from lpcal.records.model import Missing, ModelFigures, NextStop, ObjectModel, ViewInModel
from lpcal.records.pictures import data_uri
from lpcal.records.surface import Component, Surface
from lpcal.report.model_page import model_html
from lpcal.report.page import render
from lpcal.report.page_data import ImageVerdictData, WatchData
from lpcal.report.relight_page import render as relight
from lpcal.report.rig_report import PARTS, RigReport
from lpcal.report.side_pages import Row, collection_html, diff_html
from marking import Served, capture_folder
from relight_ball import ball, lights
from report_rig import documents, report_of, surface

SCREENS = {"desk": (1280, 800), "hand": (390, 844)}
"""Sizes of window, in CSS pixels: a laptop's and a phone's."""
SCHEMES = ("light", "dark")
SCALE_STD = 0.004
"""Relative standard deviation of the distance of the ball that the relighting page shows."""


def course() -> BodyCourse:
    """A minute of a tracked body, with a stretch in which it was lost and one in which it jumped."""
    t_s = np.delete(np.linspace(0, 60, 121), np.arange(40, 46))
    lapses = (Lapse(20, 22.5, tracked=False), Lapse(41, 41.4, tracked=True))
    return BodyCourse(t_s, 0.2 * np.abs(np.sin(t_s / 5)), np.abs(np.cos(t_s / 7)), lapses)


def timed(report: RigReport) -> RigReport:
    """The report with the course of the body and the views' times."""
    assert report.handeye is not None
    return replace(report, course=course(), image_times_s={view.image: 5.0 + 9 * k for k, view in enumerate(report.handeye.views)})


def bad() -> RigReport:
    """A rig of which nothing can be relied on: few views, wide sigmas, pieces in doubt, warnings."""
    whole = documents(3)
    for view in whole["handeye"]["views"][:3]:
        view["used"], view["why"] = False, "flipped: its board is 180 degrees off"
    report = timed(report_of(whole, surface(0.09), name="a_rig_with_a_name_that_is_longer_than_a_phone_is_wide"))
    assert report.handeye is not None
    assert report.lights is not None
    wide = replace(report.handeye, H_PC_covariance=1e4 * report.handeye.H_PC_covariance, warnings=("the panel turned about one axis only",))
    unsure = tuple(replace(light, direction_std_rad=0.05, position_std_m=0.02) for light in report.lights.lights)
    found = replace(report.lights, lights=unsure, warnings=("chrome_0: its outline is not round; is it the sphere's?",))
    return replace(report, handeye=wide, lights=found)


def rigs() -> dict[str, RigReport]:
    """The reports of six rigs, and of a calibration without any."""
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
        "calibration alone": replace(of("calibration", name="imported"), lacks=lacks),
    }


def whole_ball() -> Surface:
    """The ball as one piece whose distance is known to some parts in a thousand."""
    whole = ball(perspective=True, colour=True)
    return replace(whole, components=(Component(1, int(whole.mask.sum()), 0.33, SCALE_STD),))


def quarter_ball() -> ObjectModel:
    """A quarter of a ball of 40 mm radius about (1, 2, 0.5) m, as two views might have it."""
    azimuth, height = np.meshgrid(np.linspace(-0.8, 0.8, 24), np.linspace(-0.8, 0.8, 24))
    n = np.stack([np.cos(height) * np.sin(azimuth), np.sin(height), np.cos(height) * np.cos(azimuth)], axis=-1).reshape(-1, 3)
    at = np.arange(23 * 24).reshape(23, 24)[:, :-1].ravel()
    faces = np.concatenate([np.stack([at, at + 1, at + 25], axis=1), np.stack([at, at + 25, at + 24], axis=1)])
    H = np.eye(4)
    H[:3, :3], H[:3, 3] = np.diag([1.0, -1.0, -1.0]), [1.0, 2.0, 0.9]
    aside = [H + np.pad([[x], [0], [0]], ((0, 1), (3, 0))) for x in (-0.08, 0.08)]
    views = tuple(ViewInModel(f"stop_0{k}", True, None, 0.9, 1e-4, 1e-3, 1e-3, 5e-5, pose) for k, pose in enumerate(aside))
    figures = ModelFigures(1e-3, 5e-5, 1, 4e-3, 2e-3, 2e-4, 0.9, 0.0, 0.1, 0.0, 0.002)
    missing = Missing(4e-3, 1e-3, 4e-4, 0.0, (NextStop(H, None, "stop_00", 0.8, 0.35, 5e-4, 1e-4, False),))
    sigma, one = np.linspace(1e-4, 1e-3, len(n)), np.ones(len(n))
    centre = np.array([1.0, 2.0, 0.5])
    return ObjectModel(
        "ball", "the room", centre + 0.04 * n, n, faces, 0.5 * np.ones_like(n), sigma, 0.01 * one, 0 * one, one.astype(int), views, figures,
        ("stop_02 is left out: of something else",), missing,
    )  # fmt: skip


def two_calibrations() -> tuple[Calibration, Calibration]:
    """Of one rig of six lights in a ring, of which L1 moved by 3 mm between the two."""
    before = report_of(documents()).calibration
    assert before is not None
    first = before.lights[0]

    def light(k: int, by_m: Array) -> Light:
        H = se3.exp(np.array([0, 0, k * np.pi / 3, 0, 0, 0]))
        assert first.source_C is not None
        assert first.axis_C is not None
        assert first.H_CL is not None
        return replace(
            first,
            name=f"L{k}",
            H_CL=H @ first.H_CL,
            source_C=H[:3, :3] @ first.source_C + by_m,
            axis_C=H[:3, :3] @ first.axis_C,
            direction_C=H[:3, :3] @ first.direction_C,
            position_std_m=3e-4,
            direction_std_rad=5e-4,
        )

    still = [light(k, np.zeros(3)) for k in range(6)]
    moved = [light(k, np.array([0, 3e-3, 0]) * (k == 1)) for k in range(6)]
    return replace(before, lights=tuple(still)), replace(before, name="after", lights=tuple(moved))


def diff_page() -> str:
    """The page of `two_calibrations`."""
    rigs_of = two_calibrations()
    change = compare_calibrations(*rigs_of)
    return diff_html(("before.yaml", "after.yaml"), rigs_of, change, remarks_of(change), verdict(change))


def collection_page() -> str:
    """Captures that are done, doubtful, lost and failed."""
    picture = data_uri(surface().pictures["shape"])
    rows = [
        Row(name="lost", state="failed", doubt=1.0, error="L3.png: all dark; needed: an image of the object under L3; do: take it again"),
        Row(name="doubtful", state="done", doubt=0.36, picture=picture, folder="doubtful", distance_mm=397.0, distance_std_mm=20.0,
            notes="the automatic mask may be wrong (odds 36 %)", pixels=12345, pieces=1, solving_s=3.2),
        Row(name="vase", state="up to date", doubt=0.01, picture=picture, folder="vase", distance_mm=334.2, distance_std_mm=5.3,
            pixels=12345, pieces=1, solving_s=3.2),
    ]  # fmt: skip
    return collection_html("finds", rows)


def watched() -> WatchData:
    """A folder with some images judged."""
    seen: list[ImageVerdictData] = [
        {"name": "stations/07.png", "tone": "good", "words": "board found; 54 corners"},
        {"name": "objects/vase/L1.png", "tone": "fair", "words": "dim: its brightest is 10 % of full scale"},
        {"name": "stations/06.png", "tone": "poor", "words": "no board found"},
    ]
    return {
        "folder": "my_rig",
        "next": "the board to the top right, tilted by 30 degrees",
        "images": 9,
        "boards": 7,
        "covered": 0.54,
        "cells": [[k * row % 5 for k in range(6)] for row in range(4)],
        "spheres": {"chrome_0": {"tone": "good", "words": "6 of 6 highlights"}},
        "lacking": {"objects/vase": ["L2", "L3"]},
        "seen": seen,
        "model": ["the back of the vase was seen by one view only"],
        "waiting": 2,
        "put_off": 0,
        "behind_s": 0.4,
        "longest_wait_s": 0.6,
    }


REPORTS = [f"report of a {name}" for name in ("panel", "dome", "dome without camera", "robot", "hand-eye only", "bad", "calibration alone")]
"""The reports by kind of rig."""
KINDS = [*REPORTS, "relighting", "model", "collection", "diff", "watch", "mark"]
"""All kinds of page."""


@contextmanager
def address_of(kind: str, folder: Path) -> Iterator[str]:
    """The address under which a page of this kind is open."""
    if kind == "watch":
        with served(watched, 0) as at:
            assert at is not None
            yield at
    elif kind == "mark":
        serving = Served(capture_folder(folder))
        try:
            yield serving.address
        finally:
            serving.end()
    else:
        file = folder / "calib" / "page.html"
        file.parent.mkdir()
        for linked in ("surfaces/bust", "calib/doubtful", "calib/vase"):
            (folder / linked).mkdir(parents=True)
            (folder / linked / "relight.html").write_text("<title>a surface</title>")
        file.write_text(_text(kind), encoding="utf-8")
        yield file.as_uri()


def _text(kind: str) -> str:
    makers = {
        "relighting": lambda: relight(whole_ball(), lights(near=True)),
        "model": lambda: model_html(quarter_ball()),
        "collection": collection_page,
        "diff": diff_page,
    }
    return makers[kind]() if kind in makers else render(rigs()[kind.removeprefix("report of a ")])
