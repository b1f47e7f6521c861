"""Charuco boards: chessboard corners named by the markers between them, so that part of a board is enough.

Corner numbers run along x first, from the corner of the board's first marker, as in `Board.points_B`. Source: OpenCV, aruco module.
"""

from __future__ import annotations

import numpy as np

from lpcal.errors import InputError
from lpcal.geometry.arrays import Array, Labels
from lpcal.records.observations import Board

FEWEST_CORNERS = 8


def find_charuco(grey: Labels, board: Board) -> Array | None:
    """Rough corners (ny, nx, 2) of a charuco board in a grey image (H, W) of 8 bit, NaN where not seen; None: too few.

    Raises
    ------
    InputError
        The board has no marker size, or a dictionary that OpenCV does not know.
    """
    import cv2

    columns, rows = board.corners
    dictionary = getattr(cv2.aruco, board.dictionary, None)
    if not np.isfinite(board.marker_m) or not isinstance(dictionary, int):
        raise InputError(
            f"a charuco board with marker {board.marker_m} m and dictionary {board.dictionary!r}",
            where="board",
            needed="marker: 18 mm and dictionary: DICT_5X5_100, or another of OpenCV's",
        )
    pattern = cv2.aruco.CharucoBoard(
        (columns + 1, rows + 1), board.square_m[0], board.marker_m, cv2.aruco.getPredefinedDictionary(dictionary)
    )
    for legacy in (False, True):
        pattern.setLegacyPattern(legacy)
        places, names, _, _ = cv2.aruco.CharucoDetector(pattern).detectBoard(grey)
        if names is not None and len(names) >= FEWEST_CORNERS:
            grid = np.full((rows * columns, 2), np.nan)
            grid[names.ravel()] = places.reshape(-1, 2)
            return grid.reshape(rows, columns, 2)
    return None


def marker_free(board: Board) -> float:
    """Half side of the largest window about a corner that no marker reaches into, in units of the spacing."""
    return 0.45 * (1 - board.marker_m / board.square_m[0])
