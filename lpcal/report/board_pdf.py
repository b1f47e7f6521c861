"""The calibration target as a PDF at true scale, drawn with vectors: squares, rulers on two edges, the board's YAML.

The page is the smallest of A4 and A3, lying or standing, that holds the board with its margin, or one made to measure. The board's first
corner (its outer square is black where the counts decide it) is at the upper left. Units in here: millimetres from the page's upper left.
"""

from __future__ import annotations

import io
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from lpcal.errors import InputError

if TYPE_CHECKING:
    from lpcal.records.rig import BoardSection

POINTS_PER_MM = 72 / 25.4
MARGIN_MM = 17.0
"""White and rulers round the squares."""
QUIET_MM = 8.0
"""White round the squares that nothing is printed on."""
PAGES_MM = {
    "A4": (210.0, 297.0),
    "A3": (297.0, 420.0),
    "A2": (420.0, 594.0),
    "A1": (594.0, 841.0),
    "A0": (841.0, 1189.0),
    "letter": (215.9, 279.4),
}
PICKED = ("A4", "A3")
TITLE = "lpcal board"
"""What the PDF's title begins with; it distinguishes a board that lpcal drew from any other PDF."""


@dataclass(frozen=True)
class Page:
    """A sheet: its name and its size in millimetres."""

    name: str
    width_mm: float
    height_mm: float


def choose_page(board: BoardSection, page: str | None = None) -> Page:
    """The sheet for a board: the one asked for, lying or standing, or the smallest that fits, or one made to measure.

    Raises
    ------
    InputError
        The board does not fit on the page asked for.
    """
    width, height = size_mm(board)
    needed = width + 2 * MARGIN_MM, height + 2 * MARGIN_MM
    for name in [page] if page else PICKED:
        short, long = PAGES_MM[name]
        for sheet in ((long, short), (short, long)):
            if needed[0] <= sheet[0] and needed[1] <= sheet[1]:
                return Page(name, *sheet)
    if page:
        raise InputError(
            f"a board of {width:g} x {height:g} mm does not fit on {page}",
            where="board",
            needed=f"a page of {needed[0]:g} x {needed[1]:g} mm",
            todo="name a larger page, or leave --page out",
        )
    return Page("made to measure", *needed)


def size_mm(board: BoardSection) -> tuple[float, float]:
    """Width and height of all squares together."""
    return (board.corners[0] + 1) * 1e3 * board.square[0], (board.corners[1] + 1) * 1e3 * board.square[1]


def draw(board: BoardSection, page: Page) -> bytes:
    """The PDF."""
    from reportlab.pdfgen.canvas import Canvas

    stream = io.BytesIO()
    size = page.width_mm * POINTS_PER_MM, page.height_mm * POINTS_PER_MM
    canvas = Canvas(stream, pagesize=size, pageCompression=0, invariant=1)
    canvas.setTitle(f"{TITLE}, {yaml_line(board)}")
    canvas.transform(POINTS_PER_MM, 0, 0, -POINTS_PER_MM, 0, size[1])
    width, height = size_mm(board)
    left, top = (page.width_mm - width) / 2, (page.height_mm - height) / 2
    if board.kind == "circles":
        _circles(canvas, board, left, top)
    else:
        _squares(canvas, board, left, top)
    if board.kind == "charuco":
        _markers(canvas, board, left, top)
    _ruler(canvas, left, top + height + QUIET_MM, width, across=False)
    _ruler(canvas, left - QUIET_MM, top, height, across=True)
    _text(canvas, left, top - QUIET_MM - 4.2, yaml_line(board), 7)
    _text(
        canvas,
        left,
        top - QUIET_MM - 1.0,
        "print at 100 %, without fitting to the page; hold a ruler to the scales; glue it on a flat plate",
        6,
    )
    canvas.showPage()
    canvas.save()
    return stream.getvalue()


def yaml_line(board: BoardSection) -> str:
    """The board's section of panel.yaml, in one line."""
    x, y = (f"{1e3 * side:g} mm" for side in board.square)
    square = x if x == y else f"[{x}, {y}]"
    charuco = f", marker: {1e3 * (board.marker or 0):g} mm, dictionary: {board.dictionary}" if board.kind == "charuco" else ""
    return f"board: {{kind: {board.kind}, corners: [{board.corners[0]}, {board.corners[1]}], square: {square}{charuco}}}"


CIRCLE_SHARE = 0.25
"""Radius of a printed circle, in units of how far apart they are: half of the way is white, as OpenCV's own pattern."""


def _circles(canvas: Any, board: BoardSection, left: float, top: float) -> None:
    """Black circles, their centres where a chessboard's corners would be."""
    x, y = (1e3 * side for side in board.square)
    for row in range(board.corners[1]):
        for column in range(board.corners[0]):
            canvas.circle(left + (column + 1) * x, top + (row + 1) * y, CIRCLE_SHARE * min(x, y), stroke=0, fill=1)


def _squares(canvas: Any, board: BoardSection, left: float, top: float) -> None:
    """Black squares; the upper left one is black."""
    x, y = (1e3 * side for side in board.square)
    for row in range(board.corners[1] + 1):
        for column in range(row % 2, board.corners[0] + 1, 2):
            canvas.rect(left + column * x, top + row * y, x, y, stroke=0, fill=1)


def _markers(canvas: Any, board: BoardSection, left: float, top: float) -> None:
    """Markers in the white squares, numbered along the rows, as OpenCV's CharucoBoard has them."""
    import cv2

    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, str(board.dictionary)))
    x, y = (1e3 * side for side in board.square)
    marker = 1e3 * (board.marker or 0.0)
    cells = int(dictionary.markerSize) + 2
    number = 0
    for row in range(board.corners[1] + 1):
        for column in range((row + 1) % 2, board.corners[0] + 1, 2):
            bits = cv2.aruco.generateImageMarker(dictionary, number, cells)
            number += 1
            u, v = left + column * x + (x - marker) / 2, top + row * y + (y - marker) / 2
            canvas.setFillGray(0)
            canvas.rect(u, v, marker, marker, stroke=0, fill=1)
            canvas.setFillGray(1)
            for j, i in zip(*bits.nonzero(), strict=True):
                canvas.rect(u + i * marker / cells, v + j * marker / cells, marker / cells, marker / cells, stroke=0, fill=1)
    canvas.setFillGray(0)


def _ruler(canvas: Any, x: float, y: float, length: float, *, across: bool) -> None:
    """A scale with a tick each millimetre, along the lower (across: the left) edge, outwards."""
    canvas.setLineWidth(0.1)
    for mm in range(int(length) + 1):
        tick = 4.0 if mm % 10 == 0 else 3.0 if mm % 5 == 0 else 2.0
        if across:
            canvas.line(x, y + mm, x - tick, y + mm)
        else:
            canvas.line(x + mm, y, x + mm, y + tick)
        if mm % 10 == 0:
            at = (x - tick - 3.6, y + mm + 0.7) if across else (x + mm - 1.0, y + tick + 2.2)
            _text(canvas, *at, str(mm), 5)


def _text(canvas: Any, x: float, y: float, text: str, points: float) -> None:
    canvas.saveState()
    canvas.transform(1, 0, 0, -1, x, y)
    canvas.setFont("Helvetica", points / POINTS_PER_MM)
    canvas.drawString(0, 0, text)
    canvas.restoreState()
