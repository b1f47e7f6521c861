"""`lpcal mark`: the page's messages write a hint, a mask and names, whole or not at all, and only for who knows the token."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from PIL import Image

from browser_pages import Opened, chromium, findings
from lpcal.cli.main import main
from lpcal.errors import InputError, UsageError
from lpcal.formats.capture import read_capture
from lpcal.formats.marks import with_value
from lpcal.formats.panel_yaml import read_rig
from lpcal.pipeline.mark import Marking, mark
from marking import PANEL, SIZE, Served, boards, capture_folder


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A rig with the images of a sphere."""
    return capture_folder(tmp_path)


@pytest.fixture
def served(folder: Path) -> Iterator[Served]:
    """The command, ended at the end."""
    at = Served(folder)
    yield at
    at.end()


def picture(mask: np.ndarray) -> str:
    """A mask as the page sends it."""
    rgba = np.zeros((*mask.shape, 4), np.uint8)
    rgba[..., 3] = 255 * mask
    content = io.BytesIO()
    Image.fromarray(rgba).save(content, format="PNG")
    return "data:image/png;base64," + base64.b64encode(content.getvalue()).decode()


@pytest.mark.parametrize("sphere", ["ball", "grey"])
def test_a_hint_leaves_all_else_as_it_was(sphere: str) -> None:
    first = with_value(PANEL, ["spheres", sphere, "hint"], "[1 px, 2 px, 3 px]", "panel.yaml")
    assert yaml.safe_load(first)["spheres"][sphere]["hint"] == ["1 px", "2 px", "3 px"]
    again = with_value(first, ["spheres", sphere, "hint"], "[4 px, 5 px, 6 px]", "panel.yaml")
    assert again == first.replace("[1 px, 2 px, 3 px]", "[4 px, 5 px, 6 px]")
    for part in ("# my panel", "# three", "# the large one", "# painted"):
        assert part in again


def test_sections_that_lack_are_made_and_what_cannot_be_kept_is_refused() -> None:
    assert yaml.safe_load(with_value("", ["images"], '{"L0": "a.png"}', "c")) == {"images": {"L0": "a.png"}}
    assert yaml.safe_load(with_value("# nothing\n", ["images"], "{a: b}", "c")) == {"images": {"a": "b"}}
    assert yaml.safe_load(with_value("gain: 2\n", ["spheres", "ball", "hint"], "[1 px]", "c"))["spheres"] == {"ball": {"hint": ["1 px"]}}
    shared = "a: &one {hint: 1}\nb: *one\n"
    with pytest.raises(InputError, match="cannot be set"):
        with_value(shared, ["b", "hint"], "2", "c")


def test_what_the_page_sends_is_written(served: Served, folder: Path) -> None:
    mask = np.zeros(SIZE, bool)
    mask[10:40, 20:60] = True
    message = {"circle": [40.2, 30.1, 20.0], "mask": picture(mask), "named": {"L0": "IMG_2.png", "L1": "IMG_0.png", "L2": "IMG_1.png"}}
    status, content = served.ask("/save", message)
    assert status == 200, content
    hint = read_rig(folder.parents[1] / "panel.yaml").rig.spheres["ball"].hint
    assert hint == pytest.approx((40.2, 30.1, 20.0))
    raw = read_capture(folder, ["L0", "L1", "L2"])
    np.testing.assert_array_equal(raw.mask, mask)
    assert raw.images[:, 0, 0] * 255 == pytest.approx([22, 20, 21])
    mask[:20] = False
    assert served.ask("/save", {"mask": picture(mask)})[0] == 200
    np.testing.assert_array_equal(read_capture(folder, ["L0", "L1", "L2"]).mask, mask)


def test_a_mask_of_somebody_elses_stays(served: Served, folder: Path) -> None:
    Image.fromarray(np.full(SIZE, 255, np.uint8)).save(folder / "mask.png")
    before = (folder / "mask.png").read_bytes()
    status, content = served.ask("/save", {"mask": picture(np.eye(*SIZE, dtype=bool))})
    assert status == 409
    assert b"another file is there already" in content
    assert (folder / "mask.png").read_bytes() == before


@pytest.mark.parametrize(
    "message",
    [
        {"circle": [1, 2]},
        {"circle": [1, 2, -3]},
        {"mask": "data:,x"},
        {"mask": picture(np.ones((3, 3), bool))},
        {"named": {"L9": "IMG_0.png"}},
    ],
)
def test_a_message_that_is_none_writes_nothing(served: Served, folder: Path, message: Any) -> None:
    before = {path: path.read_bytes() for path in folder.parents[1].rglob("*") if path.is_file()}
    assert served.ask("/save", message)[0] == 409
    assert {path: path.read_bytes() for path in folder.parents[1].rglob("*") if path.is_file()} == before


def test_only_who_knows_the_token_is_answered(served: Served) -> None:
    assert served.ask("/")[0] == 200
    assert served.ask("/image/IMG_0.png")[1].startswith(b"\x89PNG")
    assert served.ask("/", token=False)[0] == 403
    assert served.ask("/save", {}, token=False)[0] == 403
    assert served.ask("/", host="elsewhere.example:80")[0] == 403
    assert served.ask("/image/..%2f..%2fpanel.yaml")[0] == 404


def test_a_folder_without_images_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["mark", str(tmp_path / "nowhere"), "--no-browser"]) == 3
    (tmp_path / "empty").mkdir()
    assert main(["mark", str(tmp_path / "empty"), "--no-browser"]) == 3
    assert "no image" in capsys.readouterr().err


def test_a_port_that_is_taken_is_the_users(served: Served, folder: Path) -> None:
    with pytest.raises(UsageError, match="port"):
        mark(folder, None, lambda _: None, port=int(served.address.split(":")[2].split("/")[0]))


def test_large_pictures_are_shown_smaller(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("lpcal.pipeline.mark.LARGEST_PX", 40)
    at = Marking(folder, read_rig(folder.parents[1] / "panel.yaml"), ("IMG_0.png",))
    content, step = at.shown("IMG_0.png")
    assert step == 2
    assert Image.open(io.BytesIO(content)).size == (40, 30)
    at.save({"mask": picture(np.ones((30, 40), bool))})
    assert Image.open(folder / "mask.png").size == (80, 60)


def test_a_boards_corners_are_written_by_image(tmp_path: Path) -> None:
    folder = boards(tmp_path)
    at = Marking(folder, read_rig(tmp_path / "panel.yaml"), ("0.png", "1.png"))
    assert at.document()["board"] is True
    corners = [10.0, 11, 60, 12, 61, 42.25, 9, 40]
    assert "board.marks of stations/a/1.png" in at.save({"marks": {"1.png": corners}})[0]
    at = Marking(folder, read_rig(tmp_path / "panel.yaml"), ("0.png", "1.png"))
    at.save({"marks": {"0.png": [[1, 2], [3, 4], [5, 6], [7, 8]]}})
    text = (tmp_path / "panel.yaml").read_text()
    assert "# printed" in text
    marks = read_rig(tmp_path / "panel.yaml").rig.board.marks
    assert marks == {"stations/a/1.png": pytest.approx(corners, abs=0.06), "stations/a/0.png": (1, 2, 3, 4, 5, 6, 7, 8)}
    assert Marking(folder, read_rig(tmp_path / "panel.yaml"), ("0.png", "1.png")).document()["marks"]["0.png"] == [1, 2, 3, 4, 5, 6, 7, 8]
    for wrong in ({"2.png": corners}, {"1.png": corners[:6]}, {"1.png": [float("nan")] * 8}):
        with pytest.raises(UsageError, match="corners of"):
            at.save({"marks": wrong})
    assert Marking(tmp_path, None, ("a.png",)).document()["board"] is False


def test_a_spheres_images_are_no_boards(folder: Path) -> None:
    panel = folder.parents[1] / "panel.yaml"
    panel.write_text(PANEL + "board: {corners: [9, 6], square: 25 mm}\n")
    at = Marking(folder, read_rig(panel), ("IMG_0.png",))
    assert at.document()["board"] is False
    with pytest.raises(UsageError, match="a board is marked"):
        at.save({"marks": {"IMG_0.png": [1] * 8}})


@pytest.mark.slow
def test_the_page_marks_a_boards_corners(tmp_path: Path) -> None:
    at = Served(boards(tmp_path))
    try:
        with chromium() as browser:
            page = browser.new_page(viewport={"width": 1000, "height": 700})
            page.goto(at.address)
            page.wait_for_function("document.documentElement.dataset.ready", timeout=90_000)
            place = page.locator("#view").bounding_box()
            scale, x, y = page.evaluate("[marks.scale, marks.x, marks.y]")

            def on(column: float, row: float) -> tuple[float, float]:
                return place["x"] + x + scale * (column + 0.5), place["y"] + y + scale * (row + 0.5)

            for corner in ((10, 10), (70, 12), (68, 50), (12, 40)):
                page.mouse.click(*on(*corner))
            page.mouse.move(*on(12, 40))
            page.mouse.down()
            page.mouse.move(*on(12, 48))
            page.mouse.up()
            page.focus("#view")
            page.keyboard.press("ArrowRight")
            assert findings(page) == []
            page.click("#save")
            page.wait_for_function("document.documentElement.dataset.answer === '200'", timeout=90_000)
    finally:
        at.end()
    marks = read_rig(tmp_path / "panel.yaml").rig.board.marks
    assert marks == {"stations/a/0.png": pytest.approx((10, 10, 70, 12, 68, 50, 13, 48), abs=0.6)}


@pytest.mark.slow
def test_the_page_marks_by_mouse(served: Served, folder: Path) -> None:
    with chromium() as browser:
        page = browser.new_page(viewport={"width": 1000, "height": 700})
        found = Opened(page)
        found.said.clear()
        page.goto(served.address)
        page.wait_for_function("document.documentElement.dataset.ready", timeout=90_000)
        place = page.locator("#view").bounding_box()
        scale, x, y = page.evaluate("[marks.scale, marks.x, marks.y]")

        def at(column: float, row: float) -> tuple[float, float]:
            return place["x"] + x + scale * (column + 0.5), place["y"] + y + scale * (row + 0.5)

        page.mouse.move(*at(40, 30))
        page.mouse.down()
        page.mouse.move(*at(60, 30))
        page.mouse.up()
        page.click("[data-tool=box]")
        page.mouse.move(*at(10, 10))
        page.mouse.down()
        page.mouse.move(*at(29, 19))
        page.mouse.up()
        page.click("[data-tool=polygon]")
        for corner in ((40, 10), (60, 10), (60, 20), (40, 20)):
            page.mouse.click(*at(*corner))
        page.focus("#view")
        page.keyboard.press("Enter")
        page.click("[data-tool=brush]")
        page.mouse.click(*at(70, 50))
        page.click("[data-tool=erase]")
        page.mouse.click(*at(12, 12))
        page.click("#undo")
        page.select_option("[data-of=L1]", "IMG_2.png")
        page.screenshot(path=folder.parent / "mark.png")
        page.click("#save")
        page.wait_for_function("document.documentElement.dataset.answer === '200'", timeout=90_000)
        assert not [line for line in found.said if not line.startswith(served.address.partition("?")[0])]
        assert findings(page) == []
    hint = read_rig(folder.parents[1] / "panel.yaml").rig.spheres["ball"].hint
    assert hint == pytest.approx((40, 30, 20), abs=0.3)
    mask = np.asarray(Image.open(folder / "mask.png")) > 0
    assert mask[10:20, 10:30].all()
    assert mask[12:18, 42:58].all()
    assert mask[50, 70]
    assert not mask[25, 20]
    assert yaml.safe_load((folder / "capture.yaml").read_text()) == {"images": {"L1": "IMG_2.png"}}
