"""Board corners as mrcal's tools keep them: a vnlog, one line a corner, in the order of the board.

::

    # filename x y level
    frame00.png 131.20 97.51 0        level: how often the image was halved to find it; mrcal weighs by 0.5^level
    frame01.png - - -                 no board in this image
    frame02.png - - -                 within a board's lines: a corner that was not seen

Source: mrcal-calibrate-cameras, ``--corners-cache``.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.named_files import did_you_mean
from lpcal.formats.outputs import write_text
from lpcal.formats.reading import reader
from lpcal.geometry.arrays import Array
from lpcal.records.observations import BoardView

NOTHING = "-"
NAMES = ("filename", "x", "y")


def write_corners(path: Path, views: Sequence[BoardView]) -> None:
    """Write the corners of all views, those without a board too."""
    lines = ["# filename x y level"]
    for view in views:
        if view.corners_px is None:
            lines.append(f"{view.image} - - -")
            continue
        lines += [f"{view.image} {x:.6f} {y:.6f} 0" if np.isfinite(x) else f"{view.image} - - -" for x, y in view.corners_px]
    write_text(path, "\n".join(lines) + "\n")


@reader("corners as mrcal's tools keep them")
def read_corners(path: Path, count: int) -> dict[str, Array | None]:
    """Corners (count, 2) by image, NaN where not seen; None: no board.

    Raises
    ------
    InputError
        Not there, no such columns, or numbers that are none; file and line are named.
    DisagreementError
        An image with another number of corners.
    """
    if not path.is_file():
        raise InputError("no such file", where=str(path), needed="a vnlog of corners: # filename x y level", todo=did_you_mean(path))
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except UnicodeDecodeError as error:
        raise InputError("not a text file", where=str(path), needed="a vnlog of corners: # filename x y level") from error
    columns: list[int] | None = None
    found: dict[str, list[tuple[float, float]]] = {}
    for number, line in enumerate(lines, start=1):
        if line.startswith("#"):
            columns = columns or _columns(line)
            continue
        if not line.strip():
            continue
        if columns is None:
            raise InputError("no line that names the columns", where=str(path), needed="# filename x y level before the numbers")
        name, x, y = _fields(line, columns, f"{path}:{number}")
        found.setdefault(name, []).append((x, y))
    return {name: _view(np.array(points), count, f"{path}, {name}") for name, points in found.items()}


def _columns(line: str) -> list[int] | None:
    names = line.lstrip("#! ").split()
    return [names.index(name) for name in NAMES] if set(NAMES) <= set(names) else None


def _fields(line: str, columns: Sequence[int], where: str) -> tuple[str, float, float]:
    words = line.split()
    try:
        name, *numbers = (words[column] for column in columns)
        x, y = (float("nan") if word == NOTHING else float(word) for word in numbers)
    except (IndexError, ValueError) as error:
        raise InputError(
            f"no corner: {line.strip()!r}", where=where, needed="a file name, x and y, or - - where nothing was seen"
        ) from error
    return name, x, y


def _view(points: Array, count: int, where: str) -> Array | None:
    if len(points) == 1 and np.isnan(points).any():
        return None
    if len(points) != count:
        raise DisagreementError(
            f"{len(points)} corners", where=where, needed=f"{count}, as board.corners says", todo="correct board.corners, or the corners"
        )
    return points
