"""Boards of other patterns, by OpenCV's detectors: grids of circles, and AprilGrids as Kalibr prints them.

A grid of circles: the centres of its dark dots, nx by ny, `square` apart. A blob's centroid is not where the circle's centre is seen: under
perspective it lies off by up to some tenths of a pixel, which grows with the dot's size in the image and the board's tilt.

An AprilGrid: tags of side `marker` whose first edges are `square` apart, small black squares where their corners meet. Its corners are
those of the tags, two a tag along each side, so `corners` are even numbers. Tags are numbered along the rows, from the lower row on, as
Kalibr does, or from the upper one. Which corner of a tag is which comes from where the tags' middles lie, by a homography, not from how
the tag is turned.
"""

from __future__ import annotations

import itertools

import numpy as np

from lpcal.detect.board_grid import in_clockwise_order
from lpcal.errors import InputError
from lpcal.geometry.arrays import Array, Labels
from lpcal.records.observations import Board

FEWEST_TAGS = 4
"""Tags that must be seen: as many places as a homography needs."""
BORDER_BITS = (2, 1)
"""Widths of a tag's black border, in its bits, that are tried: Kalibr prints 2, the AprilTag library 1."""
NEAR = 0.3
"""Share of a tag's side within which a corner must lie of where the tags' middles say."""


def find_circles(grey: Labels, board: Board) -> Array | None:
    """Centres (ny, nx, 2) of a grid of dark circles in a grey image (H, W) of 8 bit, the board's first one first; None: not seen."""
    import cv2

    found, places = cv2.findCirclesGrid(grey, board.corners, flags=cv2.CALIB_CB_SYMMETRIC_GRID | cv2.CALIB_CB_CLUSTERING)
    if not found:
        found, places = cv2.findCirclesGrid(grey, board.corners, flags=cv2.CALIB_CB_SYMMETRIC_GRID)
    if not found:
        return None
    return in_clockwise_order(np.asarray(places, dtype=float).reshape(board.corners[1], board.corners[0], 2))


def find_aprilgrid(grey: Labels, board: Board) -> Array | None:
    """Rough corners (ny, nx, 2) of an AprilGrid in a grey image (H, W) of 8 bit, NaN where not seen; None: too few tags.

    Raises
    ------
    InputError
        The board has an odd count of corners, no marker size, or a dictionary that OpenCV does not know.
    """
    import cv2

    dictionary = getattr(cv2.aruco, board.dictionary, None)
    if not board.marker_m < min(board.square_m) or not isinstance(dictionary, int) or any(count % 2 for count in board.corners):
        raise InputError(
            f"an AprilGrid of {board.corners[0]}x{board.corners[1]} corners, marker {board.marker_m} m, dictionary {board.dictionary!r}",
            where="board",
            needed="even corner counts, a marker smaller than square, and dictionary: DICT_APRILTAG_36h11 or another of OpenCV's",
        )
    for bits in BORDER_BITS:
        parameters = cv2.aruco.DetectorParameters()
        parameters.markerBorderBits = bits
        tags, names, _ = cv2.aruco.ArucoDetector(cv2.aruco.getPredefinedDictionary(dictionary), parameters).detectMarkers(grey)
        if names is not None and len(names) >= FEWEST_TAGS:
            grid = _placed([np.asarray(tag, dtype=float).reshape(4, 2) for tag in tags], names.ravel().tolist(), board)
            if grid is not None:
                return grid
    return None


def _placed(tags: list[Array], names: list[int], board: Board) -> Array | None:
    """The corners in their places (ny, nx, 2); None where the tags do not lie as a board's."""
    import cv2

    across, down = board.corners[0] // 2, board.corners[1] // 2
    known = [(tag, name) for tag, name in zip(tags, names, strict=True) if name < across * down]
    if len(known) < FEWEST_TAGS:
        return None
    points = board.points_B()[:, :2].reshape(board.corners[1], board.corners[0], 2)
    for from_below in (True, False):
        cells = [(down - 1 - name // across if from_below else name // across, name % across) for _, name in known]
        middles = np.array([points[2 * r : 2 * r + 2, 2 * c : 2 * c + 2].mean(axis=(0, 1)) for r, c in cells])
        H, _ = cv2.findHomography(middles, np.array([tag.mean(axis=0) for tag, _ in known]))
        if H is None or np.linalg.det(H) <= 0:
            continue
        grid = np.full(points.shape, np.nan)
        good = 0
        for (tag, _), (r, c) in zip(known, cells, strict=True):
            side = float(np.linalg.norm(np.roll(tag, 1, axis=0) - tag, axis=1).mean())
            for j, i in itertools.product((2 * r, 2 * r + 1), (2 * c, 2 * c + 1)):
                x, y, w = H @ [*points[j, i], 1]
                away = np.linalg.norm(tag - [x / w, y / w], axis=1)
                if away.min() < NEAR * side:
                    grid[j, i], good = tag[away.argmin()], good + 1
        if good >= 2 * len(known):
            return grid
    return None
