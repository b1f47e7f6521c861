"""lpcal board: the target's drawing, measured in the PDF's own coordinates."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lpcal.formats.panel_yaml import read_rig
from lpcal.records.rig import BoardSection
from lpcal.report.board_pdf import MARGIN_MM, choose_page, draw, yaml_line

NUMBER = rb"(-?[\d.]+)"
RECT = re.compile(NUMBER + rb" " + NUMBER + rb" " + NUMBER + rb" " + NUMBER + rb" re f")
LINE = re.compile(rb"n " + NUMBER + rb" " + NUMBER + rb" m " + NUMBER + rb" " + NUMBER + rb" l S")


def board(**changes: Any) -> BoardSection:
    return BoardSection(**({"corners": [9, 6], "square": "25 mm"} | changes))


def drawn_mm(pdf: bytes) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Page size, rectangles (x, y, w, h) and lines in millimetres of paper, y downwards: the page's own transform is applied."""
    page = np.array([float(n) for n in re.search(rb"/MediaBox \[ 0 0 " + NUMBER + rb" " + NUMBER, pdf).groups()]) * 25.4 / 72
    scale, flip, height = (
        float(n) for n in re.search(NUMBER + rb" 0 0 " + NUMBER + rb" 0 " + NUMBER + rb" cm\n", pdf[pdf.index(b"stream") :][40:]).groups()
    )
    assert scale == pytest.approx(72 / 25.4, rel=1e-5)  # a millimetre of the drawing is a millimetre of paper
    assert flip == pytest.approx(-scale)
    assert height * 25.4 / 72 == pytest.approx(page[1], rel=1e-5)
    rects = np.array([[float(n) for n in match.groups()] for match in RECT.finditer(pdf)])
    lines = np.array([[float(n) for n in match.groups()] for match in LINE.finditer(pdf)])
    return page, rects, lines


def test_squares_are_at_true_scale_and_the_first_is_black() -> None:
    page, rects, _ = drawn_mm(draw(board(), choose_page(board())))
    np.testing.assert_allclose(page, [297, 210], atol=0.01)
    assert len(rects) == 35
    np.testing.assert_allclose(rects[:, 2:], 25, atol=1e-3)
    left, top = rects[:, :2].min(axis=0)
    assert (left, top) == pytest.approx(((297 - 250) / 2, (210 - 175) / 2), abs=1e-3)
    cells = np.round((rects[:, :2] - [left, top]) / 25).astype(int)
    assert {tuple(cell) for cell in cells} == {(i, j) for i in range(10) for j in range(7) if (i + j) % 2 == 0}


def test_unequal_squares_as_measured() -> None:
    section = board(corners=[4, 3], square=["24 mm", "26 mm"])
    _, rects, _ = drawn_mm(draw(section, choose_page(section)))
    np.testing.assert_allclose(rects[:, 2:], np.broadcast_to([24, 26], (len(rects), 2)), atol=1e-3)


def test_rulers_tick_every_millimetre_along_two_edges() -> None:
    page, rects, lines = drawn_mm(draw(board(), choose_page(board())))
    left, top = rects[:, :2].min(axis=0)
    below, aside = lines[lines[:, 0] == lines[:, 2]], lines[lines[:, 1] == lines[:, 3]]
    np.testing.assert_allclose(below[:, 0], left + np.arange(251), atol=1e-3)
    np.testing.assert_allclose(aside[:, 1], top + np.arange(176), atol=1e-3)
    assert below[:, [1, 3]].min() > top + 175  # outside the squares and on the paper
    assert below[:, [1, 3]].max() < page[1]
    assert 0 < aside[:, [0, 2]].min() < aside[:, [0, 2]].max() < left


@pytest.mark.parametrize(
    ("corners", "square", "name", "size"),
    [
        ((9, 6), "25 mm", "A4", (297, 210)),
        ((6, 9), "25 mm", "A4", (210, 297)),
        ((9, 6), "35 mm", "A3", (420, 297)),
        ((13, 12), "40 mm", "made to measure", None),
    ],
)
def test_the_page_is_picked_to_fit(corners: tuple[int, int], square: str, name: str, size: tuple[int, int] | None) -> None:
    section = board(corners=corners, square=square)
    page = choose_page(section)
    assert page.name == name
    width, height = (corners[0] + 1) * 1e3 * section.square[0], (corners[1] + 1) * 1e3 * section.square[1]
    assert (page.width_mm, page.height_mm) == pytest.approx(size or (width + 2 * MARGIN_MM, height + 2 * MARGIN_MM))
    assert page.width_mm >= width + 2 * MARGIN_MM


def test_the_yaml_on_the_sheet_is_the_boards_own(tmp_path: Path) -> None:
    section = board(square=["24.9 mm", "25.1 mm"])
    line = yaml_line(section)
    assert line.encode().replace(b"(", rb"\(") in draw(section, choose_page(section))
    (tmp_path / "panel.yaml").write_text(f"lpcal: 1\n{line}\n")
    assert read_rig(tmp_path / "panel.yaml").rig.board == section


def test_markers_stand_in_the_white_squares() -> None:
    section = board(kind="charuco", corners=[4, 3], marker="18 mm", dictionary="DICT_5X5_100")
    _, rects, _ = drawn_mm(draw(section, choose_page(section)))
    sizes = np.round(rects[:, 2], 3)
    assert (np.sum(sizes == 25), np.sum(sizes == 18)) == (10, 10)
    cells = rects[sizes < 17]
    np.testing.assert_allclose(cells[:, 2:], 18 / 7, atol=1e-4)
    assert read_rig_line(yaml_line(section))


def read_rig_line(line: str) -> bool:
    return "marker: 18 mm" in line and "DICT_5X5_100" in line


def test_the_command_takes_the_rigs_board_and_words_over_it(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    (tmp_path / "panel.yaml").write_text("lpcal: 1\nboard: {corners: [6, 4], square: 30 mm}\n")
    code, out, _ = lpcal("board", cwd=tmp_path)
    assert code == 0
    assert "corners: [6, 4], square: 30 mm" in out
    assert (tmp_path / "board.pdf").read_bytes().startswith(b"%PDF")
    code, out, _ = lpcal("board", "-o", "other.pdf", "--corners", "7x5", cwd=tmp_path)
    assert code == 0
    assert "corners: [7, 5], square: 30 mm" in out


def test_the_default_board_outside_a_rig(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    code, out, _ = lpcal("board", cwd=tmp_path)
    assert code == 0
    assert "corners: [9, 6], square: 25 mm" in out
    assert "A4" in out


def test_what_a_user_gets_wrong(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    assert lpcal("board", "--corners", "9", cwd=tmp_path)[0] == 2
    code, _, err = lpcal("board", "--square", "25", cwd=tmp_path)
    assert (code, "25mm" in err) == (2, True)
    code, _, err = lpcal("board", "--page", "A4", "--square", "60mm", cwd=tmp_path)
    assert (code, "does not fit on A4" in err) == (3, True)
    (tmp_path / "panel.yaml").write_text("lpcal: 1\nboard: {corners: [9, 6], square: 25}\n")
    code, _, err = lpcal("board", cwd=tmp_path)
    assert (code, "panel.yaml:2" in err) == (3, True)
    assert not (tmp_path / "board.pdf").exists()
