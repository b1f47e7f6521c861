"""``lpcal board``: the printable target at true scale."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from lpcal.cli.board_words import corners_of, square_of
from lpcal.errors import InputError
from lpcal.records.outcome import Outcome, Progress

if TYPE_CHECKING:
    from lpcal.records.rig import BoardSection

PAGES = ("A4", "A3", "A2", "A1", "A0", "letter")
DEFAULT_CORNERS, DEFAULT_SQUARE = "9x6", "25mm"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("-o", "--output", type=Path, default=Path("board.pdf"), metavar="PDF", help="where to write it (default board.pdf)")
    parser.add_argument(
        "--rig", type=Path, metavar="PANEL", help="panel.yaml or its folder, whose board: is drawn (default: the one here or above)"
    )
    parser.add_argument("--corners", metavar="NxM", help="inner corners along x and y (default: the rig's, else 9x6)")
    parser.add_argument("--square", metavar="LENGTH", help="side of a square with its unit (default: the rig's, else 25mm)")
    parser.add_argument("--page", choices=PAGES, help="the sheet (default: A4 or A3 if it fits, else made to measure)")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:  # noqa: ARG001
    """Draw it."""
    from lpcal.formats.outputs import marked, refuse_place, whole
    from lpcal.report.board_pdf import TITLE, choose_page, draw, size_mm, yaml_line

    kind = marked("a board", f"({TITLE}")
    refuse_place(options.output, kind)
    board, origin = _board(options)
    page = choose_page(board, options.page)
    drawn = draw(board, page)
    with whole(options.output, kind) as draft:
        draft.write_bytes(drawn)
    width, height = size_mm(board)
    summary = [
        f"{options.output}: {yaml_line(board)} ({origin})",
        f"page {page.name}, {page.width_mm:g} x {page.height_mm:g} mm; the squares together {width:g} x {height:g} mm",
        "print it at 100 %, without fitting to the page, and measure the squares: what counts is what they measure",
    ]
    document = {"file": str(options.output), "board": yaml_line(board), "page": page.name, "page_mm": [page.width_mm, page.height_mm]}
    return Outcome([*summary, *_sensor_poses(options)], document | {"squares_mm": [width, height]})


def _sensor_poses(options: argparse.Namespace) -> list[str]:
    """How to hold the board for the distance sensor, where the rig has one."""
    from lpcal.formats.panel_yaml import read_rig
    from lpcal.records.distance import CALIBRATING_POSES

    try:
        path = _panel(options.rig)
        panel = None if path is None else read_rig(path).rig.panel
    except InputError:  # the board was asked for by words, and needs no rig
        return []
    return [] if panel is None or panel.distance_sensor is None else [f"distance sensor: {CALIBRATING_POSES}"]


def _board(options: argparse.Namespace) -> tuple[BoardSection, str]:
    """The board to draw and where it comes from: the words of the command over the rig's section over the default."""
    from lpcal.formats.panel_yaml import read_rig
    from lpcal.records.rig import BoardSection

    section: BoardSection | None = None
    origin = "the default board"
    if options.rig or not (options.corners and options.square):
        panel = _panel(options.rig)
        if panel is not None:
            section, origin = read_rig(panel).rig.board, f"from {panel}"
    if section is not None and not (options.corners or options.square):
        return _drawable(section, origin), origin
    corners = corners_of(options.corners) if options.corners else section.corners if section else corners_of(DEFAULT_CORNERS)
    square = square_of(options.square) if options.square else section.square if section else square_of(DEFAULT_SQUARE)
    origin = "as asked for" if options.corners or options.square else "the default board"
    return BoardSection.model_construct(kind="chessboard", corners=corners, square=square), origin


def _panel(named: Path | None) -> Path | None:
    """The panel.yaml named, or the one here or above if there is any."""
    from lpcal.formats.panel_yaml import find

    try:
        return find(named or Path())
    except InputError:
        if named:
            raise
    return None


def _drawable(section: BoardSection, origin: str) -> BoardSection:
    if section.kind == "aprilgrid":
        raise InputError(
            "an AprilGrid is not drawn here", where=origin, needed="a chessboard, charuco or circles", todo="print it by Kalibr's own tool"
        )
    if section.kind == "charuco" and not (section.marker and section.dictionary):
        raise InputError(
            "a charuco board without marker and dictionary", where=origin, needed="both", todo="add marker: 18 mm, dictionary: DICT_5X5_100"
        )
    return section
