"""``lpcal report``: what it writes, and what it says where there is nothing to write."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lpcal as library
from lpcal.formats.documents import write_document
from lpcal.records.provenance import Provenance
from relight_ball import ball
from report_rig import documents, plain


@pytest.fixture
def rig(tmp_path: Path) -> Path:
    (tmp_path / "panel.yaml").write_text("lpcal: 1\nname: small\n", encoding="utf-8")
    return tmp_path


def fill(rig: Path) -> None:
    for kind, document in documents().items():
        body = {key: value for key, value in document.items() if key not in {"lpcal", "kind", "provenance"}}
        write_document(rig / "calib" / f"{kind}.yaml", kind, body, Provenance())


def test_nothing_to_report_on(rig: Path, lpcal: Any) -> None:
    code, out, err = lpcal("report", cwd=rig)
    assert code == 3
    assert out == ""
    assert "no stage has written anything yet" in err
    assert "lpcal run" in err
    assert not (rig / "calib").exists()


def test_the_report_is_written_and_its_path_printed(rig: Path, lpcal: Any) -> None:
    fill(rig)
    code, out, err = lpcal("report", cwd=rig)
    assert (code, err) == (0, "")
    assert "calib/report.html" in out
    assert "Fit for use" in out
    assert "Fit for use" in (rig / "calib" / "report.html").read_text(encoding="utf-8")


def test_a_subfolder_of_the_rig_finds_it_and_json_is_json(rig: Path, lpcal: Any) -> None:
    fill(rig)
    code, out, _ = lpcal("report", "--json", cwd=rig / "calib")
    assert code == 0
    told = json.loads(out)
    assert told["verdict"] == "good"
    assert [stage["stage"] for stage in told["stages"]] == ["camera", "handeye", "wings", "lights"]


def test_a_document_cut_in_half_stops_it_and_the_old_report_stays(rig: Path, lpcal: Any) -> None:
    fill(rig)
    assert lpcal("report", cwd=rig)[0] == 0
    before = (rig / "calib" / "report.html").read_bytes()
    lights = rig / "calib" / "lights.yaml"
    lights.write_text(lights.read_text(encoding="utf-8")[:700], encoding="utf-8")
    code, _, err = lpcal("report", cwd=rig)
    assert code == 3
    assert "lights.yaml" in err
    assert (rig / "calib" / "report.html").read_bytes() == before


def test_surfaces_come_with_pictures_and_a_link(rig: Path, lpcal: Any) -> None:
    import cv2

    folder = rig / "surfaces" / "bust"
    folder.mkdir(parents=True)
    mask = np.zeros((40, 50), np.uint8)
    mask[5:30, 8:44] = 255
    cv2.imwrite(str(folder / "mask.png"), mask)
    cv2.imwrite(str(folder / "normals_gl.png"), np.where(mask[..., None] > 0, np.array([65535, 32768, 32768]), 0).astype(np.uint16))
    cv2.imwrite(str(folder / "albedo.png"), (mask.astype(np.uint16) * 200))
    (folder / "relight.html").write_text("x", encoding="utf-8")
    pieces = [{"label": 1, "pixels": 900, "mean_depth_m": 0.35, "scale_std": 0.004}]
    (folder / "summary.json").write_text(json.dumps(plain({"name": "bust", "units": "metres", "components": pieces})), encoding="utf-8")
    code, out, _ = lpcal("report", cwd=rig)
    assert code == 0
    assert "bust" in out
    page = (rig / "calib" / "report.html").read_text(encoding="utf-8")
    assert page.count("data:image/png;base64,") == 3
    assert 'href="../surfaces/bust/relight.html"' in page


def test_a_summary_that_is_no_json_is_named(rig: Path, lpcal: Any) -> None:
    folder = rig / "surfaces" / "bust"
    folder.mkdir(parents=True)
    (folder / "summary.json").write_text('{"name": "bu', encoding="utf-8")
    code, _, err = lpcal("report", cwd=rig)
    assert code == 3
    assert "surfaces/bust/summary.json" in err
    assert not (rig / "calib" / "report.html").exists()


def test_the_stage_knows_when_it_is_out_of_date(rig: Path, lpcal: Any) -> None:
    from lpcal.formats.panel_yaml import read_rig
    from lpcal.pipeline.report import STAGE
    from lpcal.pipeline.workspace import Workspace

    fill(rig)
    workspace = Workspace(read_rig(rig / "panel.yaml"))
    assert STAGE.wanted(workspace)
    assert not STAGE.up_to_date(workspace)
    assert lpcal("report", cwd=rig)[0] == 0
    assert STAGE.up_to_date(workspace)
    (rig / "calib" / "handeye.yaml").unlink()
    assert not STAGE.up_to_date(workspace)


def test_a_calibration_alone_has_a_page(tmp_path: Path, rig: Path, lpcal: Any) -> None:
    """Without a rig, of the calibration alone; its page is not the rig's, which would be of all its stages."""
    fill(rig)
    place = tmp_path / "elsewhere"
    place.mkdir()
    (rig / "calib" / "calibration.yaml").rename(place / "ours.yaml")
    code, out, err = lpcal("report", "-c", "ours.yaml", cwd=place)
    assert (code, err) == (0, "")
    assert "ours_report.html" in out
    page = (place / "ours_report.html").read_text(encoding="utf-8")
    assert 'id="lights"' in page
    assert 'id="handeye"' not in page
    assert lpcal("report", "-c", "ours.yaml", "-o", "page.html", cwd=place)[0] == 0
    assert (place / "page.html").read_text(encoding="utf-8") == page
    (place / "note.html").write_text("mine", encoding="utf-8")
    assert lpcal("report", "-c", "ours.yaml", "-o", "note.html", cwd=place)[0] == 3
    assert (place / "note.html").read_text(encoding="utf-8") == "mine"
    assert lpcal("report", "-c", "ours.yaml", "-o", "ours.yaml", cwd=place)[0] == 2
    assert lpcal("report", "-c", "absent.yaml", cwd=place)[0] == 3


@pytest.mark.parametrize("words", [("surfaces/bust",), ("-o", "page.html")])
def test_what_needs_a_calibration_says_so(rig: Path, lpcal: Any, words: tuple[str, ...]) -> None:
    fill(rig)
    code, _, err = lpcal("report", *words, cwd=rig)
    assert code == 2
    assert "-c calibration.yaml" in err


def test_surfaces_on_the_page_of_a_calibration_lead_to_their_own_pages(tmp_path: Path, rig: Path, lpcal: Any) -> None:
    fill(rig)
    calibration = library.read_calibration(rig / "calib" / "calibration.yaml")
    folder = tmp_path / "shapes of two" / "ball"
    library.write_surface(folder, ball(perspective=True), calibration)
    code, out, err = lpcal("report", "-c", str(rig / "calib" / "calibration.yaml"), str(folder), "-o", str(tmp_path / "p.html"), cwd=rig)
    assert (code, err.replace("pictures: 1 of 1\n", "")) == (0, "")
    assert "ball" in out
    assert 'href="shapes%20of%20two/ball/relight.html"' in (tmp_path / "p.html").read_text(encoding="utf-8")
