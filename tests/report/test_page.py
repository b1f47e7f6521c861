"""The report: what it says, that it stands alone, and the figures that it works out itself."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lpcal.geometry import se3
from lpcal.records.calibration import Lobe
from lpcal.records.evidence import CameraEvidence, ChosenModel, TriedModel
from lpcal.records.pictures import png
from lpcal.report import charts
from lpcal.report.chain_sections import camera_section, handeye_section, lens_choice
from lpcal.report.page import lights_section, render, sphere_disagreement, spheres_section
from lpcal.report.pictures import shrink
from lpcal.report.rig_report import origin_sigmas
from lpcal.report.scene import half_angle, rig_scene, room_scene
from lpcal.report.verdict import GATE_WORDS, GATES, headline, verdicts
from lpcal.report.wording import fixed, listed, number, sigma_of, with_sigma
from report_rig import documents, read, report_of, surface, text_of


def test_whole_page_stands_alone_and_says_what_was_found() -> None:
    page = render(report_of(documents(), surface(), name="lightpanel-6"))
    found = read(page)
    outside = [ref for ref in found.references if not ref.startswith(("data:", "#", "../surfaces/"))]
    assert outside == []
    assert {ref[1:] for ref in found.references if ref.startswith("#")} <= found.ids
    assert "@import" not in page
    assert "url(" not in page
    said = text_of(page)
    for words in (
        "Fit for use",
        "700.00 ± 0.30 px",
        "5 of 6 views",
        "32.10 ± 0.20 ms",
        "no board found",
        "L2",
        "chrome_0",
        "left out: ref.jpg",
    ):
        assert words in said
    assert "ab" * 8 in said
    assert len(page) < 400_000


@pytest.mark.parametrize("kind", ["camera", "handeye", "wings", "lights", "calibration", "H_CB", "H_OP"])
def test_a_stage_alone_or_absent_makes_a_page(kind: str) -> None:
    whole = documents()
    assert "Not there" in text_of(render(report_of({kind: whole[kind]})))
    rest = {other: document for other, document in whole.items() if other != kind}
    assert f"{kind}.yaml" in text_of(render(report_of(rest)))


@pytest.mark.parametrize("points_m", [[], None])
def test_a_rig_in_which_no_board_was_seen_has_a_page(points_m: Any) -> None:
    whole = documents()
    whole["H_CB"] |= {"board": {"corners": [5, 4], "points_m": points_m}, "views": []}
    assert "5 of 6 views" in text_of(render(report_of(whole)))


def test_what_a_rig_does_not_know_is_not_needed() -> None:
    whole = documents()
    light = {"name": "L0", "direction": [0.0, 0.0, -1.0], "intensity": [1.0, 0.9, 1.1], "source_m": None, "lobe": None}
    bare = {
        "camera": {key: whole["camera"][key] for key in ("image_size", "model", "K", "distortion", "rms_px", "views")},
        "handeye": whole["handeye"] | {"clock_offset_s": None, "clock_offset_std_s": None, "views": []},
        "lights": {"focus_m": [0.0, 0.0, 0.35], "lights": [light], "spheres": []},
    }
    said = text_of(render(report_of(bare, name="dome")))
    assert "distant" in said
    assert "1.000 / 0.900 / 1.100" in said
    assert "no clock offset" in said


def test_names_cannot_break_the_page() -> None:
    whole = documents()
    whole["lights"]["lights"][0]["name"] = "</script><b>L0"
    whole["camera"]["views"][5]["why"] = "<img src=x>"
    page = render(report_of(whole, name="<script>alert(1)</script>"))
    assert "<script>alert" not in page
    assert "<img src=x>" not in page
    assert "</script><b>" not in page
    read(page)


@pytest.mark.parametrize(("sigma_deg", "word"), [(0.05, "good"), (0.15, "fair"), (0.5, "poor")])
def test_the_gate_follows_the_sigma(sigma_deg: float, word: str) -> None:
    whole = documents()
    whole["handeye"]["H_PC_covariance"] = (np.diag([np.radians(sigma_deg)] * 3 + [1e-5] * 3) ** 2).tolist()
    report = report_of(whole)
    line = next(line for line in verdicts(report) if line.stage == "handeye")
    assert line.tone == word
    assert headline(verdicts(report))[0] == word


def test_a_warning_lowers_good_to_fair_and_is_shown() -> None:
    whole = documents()
    whole["handeye"]["warnings"] = ["turn the panel about its axis"]
    line = verdicts(report_of(whole))[1]
    assert (line.tone, line.notes) == ("fair", ("turn the panel about its axis",))


def test_a_surface_without_a_camera_is_not_judged_by_its_distance() -> None:
    lines = verdicts(report_of({}, surface(units="pixels"), surface(0.06)))
    assert [line.tone for line in lines[-2:]] == ["none", "poor"]


def distant_lights(**stated: Any) -> dict[str, Any]:
    """A calibration of lights that have directions only, as imported: no camera, no focus."""
    ways = [[0.5, 0.1, -0.8], [-0.5, 0.0, -0.8], [0.0, -0.6, -0.7]]
    lights = [{"name": f"L{k}", "direction": way, "source_m": None, "intensity": 1.0, "lobe": None} | stated for k, way in enumerate(ways)]
    return {"name": "dome", "camera": None, "lights": lights, "focus_m": None, "d_object_m": None}


def test_a_rig_without_a_camera_shows_no_camera_and_no_frame_at_nought() -> None:
    report = report_of({"calibration": distant_lights()}, surface(units="pixels"), name="dome")
    scene = rig_scene(report)
    assert scene is not None
    assert {item.tone for item in scene.items} == {"light"}
    reach = np.max([np.linalg.norm(item.points, axis=1).max() for item in scene.items])
    assert scene.radius > 0.4 * reach  # all of it is in sight
    said = text_of(render(report))
    assert "intensity not measured" in said
    assert "1.000" not in said
    assert "direction to the light" in said
    assert "seen from behind the camera" not in said
    assert "No camera: rays are taken as parallel" in said
    assert "mm away" not in said
    assert "relative depth" in said


@pytest.mark.parametrize("kind", ["matte", "chrome"])
def test_an_intensity_is_shown_where_spheres_or_an_import_say_it(kind: str) -> None:
    whole = documents()
    whole["lights"]["spheres"][0]["kind"] = kind
    for entry in whole["lights"]["lights"]:
        entry["intensity"] = 1.0
    assert ("not measured" in text_of(render(report_of(whole)))) == (kind == "chrome")
    stated = {"calibration": distant_lights(intensity=[0.9, 0.8, 1.2])}
    assert "0.900 / 0.800 / 1.200" in text_of(render(report_of(stated, name="dome")))


def test_a_camera_that_only_the_calibration_has_is_shown() -> None:
    camera = {key: documents()["camera"][key] for key in ("image_size", "model", "K", "distortion")}
    report = report_of({"calibration": distant_lights() | {"camera": camera}})
    assert verdicts(report)[0].tone == "none"
    assert "camera" in {item.tone for item in rig_scene(report).items}


def test_gates_are_said_as_they_are_applied(monkeypatch: pytest.MonkeyPatch) -> None:
    assert set(GATES) == set(GATE_WORDS)
    before = verdicts(report_of(documents()))
    assert before[0].gate == "rms \u2264 0.3 px, focal length \u2264 0.2 %"
    monkeypatch.setitem(GATES, "handeye_mm", (0.05, 2.5))
    line = next(line for line in verdicts(report_of(documents())) if line.stage == "handeye")
    assert "position \u2264 0.05 mm" in line.gate
    assert line.tone == "fair"


def test_a_solver_other_than_mrcal_is_no_doubt_of_the_camera() -> None:
    whole = documents()
    whole["camera"] |= {"solver": "opencv", "evidence": {"solver_note": "mrcal is not installed: solved without it"}, "warnings": []}
    report = report_of(whole)
    assert verdicts(report)[0].tone == "good"
    assert "mrcal is not installed" in text_of(render(report))


@pytest.mark.parametrize("sigma", [4.2e-4, 3.1e-6, 0.0123])
def test_no_sigma_reads_as_nought(sigma: float) -> None:
    whole = documents()
    for entry in whole["lights"]["lights"]:
        entry |= {"direction_std_deg": sigma, "position_std_m": 1e-3 * sigma, "intensity_std": 0.01 * sigma}
    whole["handeye"]["H_PC_covariance"] = (np.diag([np.radians(sigma)] * 3 + [1e-3 * sigma] * 3) ** 2).tolist()
    whole["handeye"]["H_PC"] = np.eye(4).tolist()
    report = report_of(whole)
    section = lights_section(report)
    assert section is not None
    shown = [getattr(row, key) for row in section.rows for key in ("position_std", "direction_std", "intensity_std")]
    for text in shown:
        assert float(text.replace("\u2212", "-")) == pytest.approx(sigma, rel=0.06)
    assert f"H_PC within {sigma_of(sigma, 3, '°')} and {sigma_of(sigma, 2, 'mm')}" in verdicts(report)[1].found


def test_origin_sigmas_are_those_of_the_origin() -> None:
    rng = np.random.default_rng(1)
    H = se3.exp(np.array([0.3, -0.2, 0.5, 0.4, 1.1, -0.6]))
    A = rng.normal(0, 1e-3, (6, 6))
    covariance = A @ A.T
    xi = rng.multivariate_normal(np.zeros(6), covariance, 4000)
    origins = np.array([(se3.exp(step) @ H)[:3, 3] for step in xi])
    np.testing.assert_allclose(origin_sigmas(H, covariance)[3:], origins.std(axis=0), rtol=0.06)
    assert np.isnan(origin_sigmas(H, None)).all()


def test_a_sphere_that_agrees_and_one_that_does_not() -> None:
    found = report_of(documents()).lights
    sphere, lamp = found.spheres[0], found.lights[0]
    assert sphere_disagreement(sphere, lamp) == pytest.approx(0, abs=1e-6)
    turn = se3.rotation(np.radians(0.3) * np.array([0.0, 1.0, 0.0]))
    turned = replace(sphere, directions_C={"L0": turn @ sphere.directions_C["L0"]})
    assert sphere_disagreement(turned, lamp) == pytest.approx(0.3, abs=0.03)
    section = spheres_section(report_of(documents()))
    assert section is not None
    assert section.largest == "0.00°"


@pytest.mark.parametrize(("kind", "spots", "used"), [("chrome", {"L0": [300.0, 200.0]}, True), ("matte", {}, True), ("chrome", {}, False)])
def test_a_sphere_is_drawn_where_it_was_found(kind: str, spots: dict[str, list[float]], used: bool) -> None:
    around = np.radians(np.arange(0, 360, 8))
    outline = np.stack([320 + 60 * np.cos(around), 240 + 60 * np.sin(around)], axis=1).tolist()
    whole = documents()
    drawn = {"name": "ball", "kind": kind, "used": used, "image_size": [640, 480], "outline_px": outline, "highlights_px": spots}
    whole["lights"]["spheres"] = [whole["lights"]["spheres"][0] | drawn]
    section = spheres_section(report_of(whole))
    assert section is not None
    (svg,) = section.outlines
    drawn = np.array([pair.split() for pair in svg.split(' d="M')[-1].split("Z")[0].split("L")], float)
    np.testing.assert_allclose((drawn - 2) * 640 / (charts.WIDTH - 4), outline, atol=0.1)
    assert svg.count("<circle") == len(spots)
    assert ("gate" in svg) != used
    assert ">ball<" in svg


def test_spheres_of_which_nothing_is_kept_are_not_drawn() -> None:
    section = spheres_section(report_of(documents()))
    assert section is not None
    assert section.outlines == []


def test_what_is_left_over_by_place_finds_a_planted_shift() -> None:
    whole = documents()
    for view in whole["H_CB"]["views"]:
        if view["corners_px"]:
            view["corners_px"] = np.add(view["corners_px"], [0.7, 0.0]).tolist()
    section = camera_section(report_of(whole))
    assert section is not None
    assert "the longest is 0.7" in section.coverage.note
    whole["camera"] |= {"model": "splined", "lensmodel": "LENSMODEL_SPLINED", "spline": [700.0, 701.0, 320.0, 240.0]}
    splined = camera_section(report_of(whole))
    assert splined is not None
    assert "arrows" not in splined.coverage.note


def test_the_way_from_the_drawing() -> None:
    section = lights_section(report_of(documents()))
    assert section is not None
    assert [row.moved for row in section.rows] == ["2.0"] * 3
    assert [row.turned for row in section.rows] == ["0.00"] * 3


def test_views_left_out_stand_with_their_reason() -> None:
    section = handeye_section(report_of(documents()))
    assert section is not None
    assert section.left_out == [("stations/5.png", "no board found")]


def test_scenes_hold_what_they_should() -> None:
    report = report_of(documents())
    rig, room = rig_scene(report), room_scene(report)
    assert rig is not None
    assert room is not None
    labels = [item.text for item in rig.items if item.kind == "label"]
    assert {"L0", "L1", "L2", "C", "D", "P"} <= set(labels)
    arrows = [item for item in rig.items if item.kind == "arrow"]
    np.testing.assert_allclose([arrow.by for arrow in arrows], [[-0.002, 0, 0]] * 3, atol=1e-5)
    assert np.isfinite([value for item in rig.items + room.items for point in item.points for value in point]).all()
    joints = [item.points[0] for item in rig.items if item.kind == "point" and item.layer == "wings"]
    np.testing.assert_allclose(np.linalg.norm(joints, axis=1), 0.1, atol=1e-4)
    assert rig_scene(report_of({})) is None


def test_half_angles() -> None:
    assert np.cos(half_angle(Lobe("cosine", exponent=3.0))) ** 3 == pytest.approx(0.5, abs=1e-3)
    table = Lobe("table", angle_rad=np.radians([0, 10, 20, 30]), value=np.array([1, 0.9, 0.4, 0.1]))
    assert half_angle(table) == pytest.approx(np.radians(20))
    assert half_angle(Lobe()) == pytest.approx(np.radians(60))


@pytest.mark.parametrize(
    ("value", "sigma", "words"),
    [
        (712.4137, 0.2345, "712.41 ± 0.23 px"),
        (-0.3019, 0.00024, "−0.30190 ± 0.00024 px"),
        (12345.6, 210.0, "12346 ± 210 px"),
        (1.5, None, "1.5000 px"),
        (None, 1.0, "–"),
        (float("nan"), 1.0, "–"),
    ],
)
def test_a_value_has_the_digits_that_its_sigma_deserves(value: Any, sigma: Any, words: str) -> None:
    assert with_sigma(value, sigma, "px").replace("\N{NO-BREAK SPACE}", " ") == words


def test_numbers_in_words() -> None:
    assert number(0.012345, 2) == "0.012"
    assert number(1.5e-7, 2) == "1.5e−07"
    assert number(0) == "0"
    assert fixed(-1.25, 1, "°") == "−1.2°"
    assert listed(["L0", "L1", "L2"]) == "L0, L1 and L2"


def test_a_png_is_read_back_as_it_was() -> None:
    import cv2

    pixels = np.random.default_rng(0).integers(0, 256, (17, 23, 4), dtype=np.uint8)
    read_back = cv2.imdecode(np.frombuffer(png(pixels), np.uint8), cv2.IMREAD_UNCHANGED)
    np.testing.assert_array_equal(read_back[..., [2, 1, 0, 3]], pixels)


def test_shrinking_averages_inside_the_mask_only() -> None:
    value = np.zeros((20, 20, 3), np.float32)
    value[4:16, 4:16] = 0.5
    value[0, 0] = 1.0
    mask = np.zeros((20, 20), bool)
    mask[4:16, 4:16] = True
    small = shrink(value, mask, 8)
    assert small.shape == (8, 8, 4)
    assert set(np.unique(small[small[..., 3] > 0][:, :3])) == {128}


def test_the_lens_table_shows_what_was_chosen_among_what_was_tried() -> None:
    tried = [("opencv4", "curved", 0.21), ("opencv4", "flat", 0.34), ("opencv8", "curved", 0.29), ("splined", "curved", np.nan)]
    scores = [TriedModel(model=model, board=board, cross_validation_px=px, expected_error_px=px) for model, board, px in tried]
    taken = ChosenModel(model="opencv4", board="curved", why="nearest")
    found = lens_choice(CameraEvidence(cross_validation=tuple(scores), chosen=taken))
    assert found is not None
    assert found.boards == ["curved", "flat"]
    rows = dict(found.rows)
    assert [chosen for _, chosen in rows["opencv4"]] == [True, False]
    assert rows["opencv4"][0][0] == "0.210"
    assert not any(chosen for model in ("opencv8", "splined") for _, chosen in rows[model])
