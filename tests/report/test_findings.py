"""The report's best findings: where the camera is sure, cross-checks, residuals, the light field, held-out spheres; and contrast."""

from __future__ import annotations

import re
from dataclasses import replace
from importlib.resources import files

import numpy as np
import pytest

from lpcal.records.body_course import BodyCourse, Lapse
from lpcal.records.calibration import Calibration
from lpcal.records.evidence import CameraEvidence, LightsEvidence, NextSphere, NextView, OtherSolver, ProjectionUncertainty, ViewThatMatters
from lpcal.report import charts
from lpcal.report.chain_sections import camera_section, handeye_section
from lpcal.report.page import lights_section, render, spheres_section
from lpcal.report.rig_report import PARTS, RigReport
from lpcal.report.time_lines import time_lines
from lpcal.report.verdict import verdicts
from report_rig import documents, read, report_of, surface, text_of

TRUSTED = np.zeros((4, 6), bool)
TRUSTED[1:3, 1:5] = True


def uncertainty() -> ProjectionUncertainty:
    return ProjectionUncertainty(
        of="projection",
        columns_px=np.linspace(0, 639, 6),
        rows_px=np.linspace(0, 479, 4),
        worst_direction_std_px=np.where(TRUSTED, 0.05, 0.4),
        rms_px=0.1,
        most_px=0.4,
        covered_share=0.5,
        covered=TRUSTED,
        trusted=TRUSTED,
        trusted_share=1 / 3,
    )


def evidence() -> CameraEvidence:
    return CameraEvidence(
        projection_uncertainty=uncertainty(),
        independent_check=OtherSolver(by="OpenCV calibrateCamera", difference_rms_px=0.0123, difference_worst_px=0.05),
        free_board_check=OtherSolver(by="COLMAP, every corner free", failed="no memory"),
        views_that_matter=(ViewThatMatters(image="stations/3.png", without_it=1.25),),
        next_view=NextView(hold_the_board="at the top left, its top edge turned away", std_now_px=0.1, std_then_px=0.07),
    )


def plain(text: str) -> str:
    """A text with blanks that break."""
    return text.replace("\N{NO-BREAK SPACE}", " ")


def solved() -> RigReport:
    report = report_of(documents())
    return replace(report, camera=replace(report.camera, evidence=evidence()))


def test_where_the_camera_is_sure_and_the_next_view_stand_on_the_page() -> None:
    part = camera_section(solved())
    assert "33 % of the image, at most 0.050 px there" in plain(part.uncertainty.note)
    assert part.uncertainty.svg.count('style="--share:') == 24 + 24, "24 cells, and 24 steps of the colour bar"
    said = text_of(render(solved()))
    assert "the same corners by OpenCV calibrateCamera 0.012 px rms, 0.050 px at most apart" in said
    assert "COLMAP, every corner free failed: no memory" in said
    assert "stations/3.png (25 %)" in said
    assert "at the top left, its top edge turned away (0.10 → 0.070 px)" in said


def test_the_line_goes_round_what_is_trusted() -> None:
    svg = charts.heat_map(np.ones((4, 6)), unit="px", aspect=1.5, outline=TRUSTED)
    path = re.search(r'class="border" d="([^"]+)"', svg)[1]
    assert path.count("v") == 4
    assert path.count("h") == 8
    x = [float(value) for value in re.findall(r"M([\d.]+) ", path)]
    across = (charts.WIDTH - 4) / 6
    assert min(x) == pytest.approx(2 + across, abs=0.1)
    assert max(x) == pytest.approx(2 + 5 * across, abs=0.1)


def test_a_cell_of_which_nothing_is_known_is_left_empty() -> None:
    value = np.ones((3, 3))
    value[1, 1] = np.nan
    assert charts.heat_map(value, unit="px", aspect=1.0).count("<title>") == 8


def test_residual_vectors_show_a_shift_that_one_view_has() -> None:
    whole = documents()
    seen = np.array(whole["H_CB"]["views"][2]["corners_px"]) + np.array([3.0, 0.0])
    whole["H_CB"]["views"][2]["corners_px"] = seen.tolist()
    part = camera_section(report_of(whole))
    lines = np.array(re.findall(r"l(-?[\d.]+) (-?[\d.]+)", re.search(r'class="vectors" d="([^"]+)"', part.vectors.svg)[1]), float)
    assert len(lines) == 100, "20 corners of the five views used"
    factor = float(re.search(r"× ([\d.]+)", part.vectors.note)[1]) * (charts.WIDTH - 4) / 640
    assert np.median(lines[40:60, 0]) / factor == pytest.approx(3.0, abs=0.15)
    assert abs(np.median(lines[:40, 0])) / factor < 0.1


def test_views_have_their_names_on_the_axis() -> None:
    part = handeye_section(report_of(documents()))
    for _, svg in part.residuals:
        assert [re.search(rf'class="middle level"[^>]*>{k}<', svg) is not None for k in range(6)] == [True] * 6
    many = [charts.Bar(1.0, f"view {k}", name=f"a_rather_long_name_{k:03d}") for k in range(300)]
    drawn = charts.bars(many, unit="px", across="views")
    assert 'class="middle"' not in drawn
    assert drawn.count('class="end name"') < 45
    assert "…" in drawn


def test_the_boards_shape_has_a_colour_bar() -> None:
    svg = camera_section(report_of(documents())).warp
    low, high = re.findall(r">(−?[\d.]+(?:e−?\d+)?)(?: mm)?</text>", svg)[0], re.search(r">([\d.]+) mm</text>", svg)[1]
    assert float(low.replace("−", "-")) == -float(high) == pytest.approx(-1.0)


def test_the_light_field_over_the_working_plane() -> None:
    part = lights_section(report_of(documents()))
    assert "350 mm away" in part.field.note
    darkest = float(re.search(r"gets ([\d.]+) %", part.field.note)[1])
    assert 5 < darkest < 80
    assert lights_section(report_of({"calibration": documents()["calibration"]})).field is None, "no camera: no view of it"


def test_spheres_held_out_are_predicted() -> None:
    report = report_of(documents())
    found = LightsEvidence(
        highlight_rms_px=0.02,
        predicted_highlight_px=0.031,
        shading_rms=0.004,
        predicted_shading_rms=0.012,
        next_sphere=NextSphere(where="at the left", centre_m=np.zeros(3), direction_std_deg=0.05, with_it_deg=0.04),
    )
    part = spheres_section(replace(report, lights=replace(report.lights, evidence=found)))
    rows = {label: plain(value) for label, value in part.predicted}
    assert rows["a chrome sphere held out: its highlights, predicted by the others"] == "0.031 px rms"
    assert rows["a matte sphere held out: its shading, predicted by the others"] == "1.2 % rms"
    assert rows["one more chrome sphere helps most"] == "at the left (0.050 → 0.040°)"
    assert "the same, its albedo free" not in rows
    assert spheres_section(report).predicted == []


def test_a_rig_without_lights_is_not_said_to_have_none_refined() -> None:
    report = replace(report_of({"handeye": documents()["handeye"]}), calibration=Calibration("hand", ()))
    line = next(one for one in verdicts(report) if one.title == "Lights")
    assert (line.tone, line.found) == ("absent", "No lights: the rig states none.")
    assert "0 lights" not in text_of(render(report))


def test_parts_that_a_rig_does_not_have_are_not_missed() -> None:
    whole = documents()
    hand = replace(
        report_of({kind: whole[kind] for kind in ("camera", "H_CB", "H_OP", "handeye")}), lacks=frozenset(PARTS) - {"camera", "handeye"}
    )
    page = read(render(hand))
    said = " ".join(" ".join(page.words).split())
    assert {"camera", "handeye"} <= page.ids
    assert not {"lights", "spheres", "surfaces"} & page.ids
    assert "#lights" not in page.references
    assert "Not part of this rig, and not judged: wings whose setting is stated, lights, spheres and objects." in said
    assert "Not there: calibration" not in said
    assert [line.stage for line in verdicts(hand)] == ["camera", "handeye"]
    dome = replace(
        report_of({kind: whole[kind] for kind in ("camera", "H_CB", "lights", "calibration")}), lacks=frozenset({"handeye", "wings"})
    )
    assert "handeye" not in read(render(dome)).ids
    assert "H_OP.yaml" not in text_of(render(dome))
    assert "handeye" in read(render(replace(dome, lacks=frozenset()))).ids, "a rig that has mocap misses its hand-eye"
    blind = replace(
        report_of({"lights": whole["lights"], "calibration": whole["calibration"]}), lacks=frozenset({"camera", "handeye", "wings"})
    )
    assert "camera" not in read(render(blind)).ids
    assert "rays are taken as parallel" in text_of(render(blind))


def test_what_was_found_is_shown_even_where_the_rig_does_not_state_it() -> None:
    imported = replace(report_of(documents()), lacks=frozenset(PARTS))
    assert {"camera", "handeye", "lights", "spheres"} <= read(render(imported)).ids


def course(lapses: tuple[Lapse, ...] = ()) -> BodyCourse:
    t_s = np.delete(np.linspace(10, 40, 61), np.arange(20, 25))
    return BodyCourse(t_s, 0.3 * np.abs(np.sin(t_s)), 0.5 * np.abs(np.cos(t_s)), lapses)


def test_the_recording_is_drawn_over_time() -> None:
    whole = report_of(documents())
    times = {view.image: 11.0 + 5 * k for k, view in enumerate(whole.handeye.views)}
    found = replace(whole.handeye, clock_drift=1e-4, taken_offset_s=0.5)
    part = time_lines(course((Lapse(20.0, 22.4, tracked=False), Lapse(30.0, 30.3, tracked=True))), found, times)
    said = plain(part.note)
    assert (
        "30 s of the recording; the body was not seen (amber) 1 time, 2.4 s at most and flipped or jumped (red) 1 time, 0.3 s at most."
        in said
    )
    assert "Markers that fit in two ways make flips" in said
    assert "drift apart by 3.00 ms" in said
    bands = [float(value) for value in re.findall(r'<rect x="([\d.]+)"', part.svg)]
    across = charts.WIDTH - charts.LEFT - charts.RIGHT
    assert bands == pytest.approx([charts.LEFT + across / 3, charts.LEFT + across * 2 / 3], abs=0.1)
    dots = np.array(re.findall(r'<circle class="fill-\w+" cx="([\d.]+)"', part.svg), float)
    expected = found.mocap_times(np.array(list(times.values()))) - 10
    assert dots == pytest.approx(charts.LEFT + across * expected / 30, abs=0.1)
    assert part.svg.count('class="curve"') == 4, "two curves, each broken at the gap"
    assert "seen and steady all along" in plain(time_lines(course(), found, times).note)


def test_the_recording_stands_on_the_page() -> None:
    whole = documents()
    for k, view in enumerate(whole["H_OP"]["views"]):
        view["t_camera_s"] = 12.0 + k
    whole["H_OP"]["recording"] = {"t_mocap_s": [10.0, 15.0, 20.0], "moved_m": [0, 0.1, 0.2], "turned_deg": [0, 5, 9.0], "lapses": []}
    assert "Over time" in text_of(render(report_of(whole)))
    whole["H_OP"]["recording"] = None
    assert "Over time" not in text_of(render(report_of(whole)))


def test_a_piece_that_fails_the_gate_is_named() -> None:
    whole = surface()
    small = replace(whole.summary.components[0], label=3, pixels=1007, scale_std=0.085)
    odd = replace(whole, summary=replace(whole.summary, components=(*whole.summary.components, small)))
    line = next(one for one in verdicts(report_of({}, odd)) if one.title == "bust")
    assert "its piece 3 of 1007 pixels is known to 8.5 % only" in plain(line.found).replace("\N{NARROW NO-BREAK SPACE}", "")
    assert line.tone == "fair", "most of the surface is sure"


def test_a_surface_fails_the_gate_where_most_of_it_does() -> None:
    whole = surface()
    first = whole.summary.components[0]
    large = replace(first, label=2, pixels=first.pixels, scale_std=0.085)
    pieces = (replace(first, scale_std=0.07, pixels=first.pixels + 1), large)
    odd = replace(whole, summary=replace(whole.summary, components=pieces))
    line = next(one for one in verdicts(report_of({}, odd)) if one.title == "bust")
    assert line.tone == "poor"


def luminance(colour: str) -> float:
    channels = np.array([int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)])
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    return float(linear @ [0.2126, 0.7152, 0.0722])


def contrast(one: str, other: str) -> float:
    bright, dark = sorted((luminance(one), luminance(other)), reverse=True)
    return (bright + 0.05) / (dark + 0.05)


@pytest.mark.parametrize(("sheet", "grounds"), [("report.css", ("paper", "plate")), ("relight.css", ("stage", "panel"))])
def test_words_stand_out_from_their_ground(sheet: str, grounds: tuple[str, ...]) -> None:
    """WCAG 2.2, 1.4.3: text 4.5 to 1, in light and in dark."""
    css = files("lpcal.report.templates").joinpath(sheet).read_text(encoding="utf-8")
    schemes = [dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6})", block)) for block in re.findall(r":root \{([^}]*)\}", css)]
    schemes = [scheme for scheme in schemes if set(grounds) <= set(scheme)]
    assert len(schemes) == (2 if sheet == "report.css" else 1)
    for scheme in schemes:
        for ground in grounds:
            for name in ("ink", "soft", "faint", "accent", "good", "fair", "poor"):
                if name in scheme:
                    assert contrast(scheme[name], scheme[ground]) >= 4.5, f"{name} on {ground}: {scheme[name]} on {scheme[ground]}"
