"""The board in an image in which no search finds it, from its four outermost inner corners as a person marked them.

A homography of the four gives the grid; each corner is then drawn to the saddle point near it, and the grid fitted again as a surface of
third order over the board, which takes up the lens' bending, until it stands. The corners are refined and judged as those of a search.
"""

from __future__ import annotations

import numpy as np

from lpcal.detect.board import judged, stretched
from lpcal.detect.saddle import saddle_points
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.records.observations import Board, BoardView

NEAR_SHARES = (0.35, 0.25, 0.15, 0.1)
"""How far a saddle may be from where a corner is expected, in spacings, fit after fit.

At first nearer to it than to any other corner's place; at last so near that an edge of what covers the board, which makes saddles with the
board's lines, is left out. The lens of a phone is followed in three fits.
"""
SEEN_SHARE = 0.6
"""Share of the corners that must have a saddle near: a hand may cover some of the board, not most of it."""


def find_marked(image: Image | Labels, board: Board, marks_px: Array, name: str = "") -> BoardView:
    """The board in a grey image (H, W) whose outermost inner corners are about at marks (4, 2), in turn round the board.

    Returns
    -------
    The corners (ny * nx, 2) in the order of ``board.points_B()``, NaN where none was seen; or None and why, in words.
    """
    grey = stretched(image)
    places = saddle_points(grey).places_px
    fits = [_fitted(_between(np.roll(marks_px, turn, axis=0), board.corners), places) for turn in (0, 1)]
    grid, near = max(fits, key=lambda fit: float(fit[1].mean()))
    share = float(near.mean())
    if share < SEEN_SHARE:
        asked = f"{board.corners[0]}x{board.corners[1]}"
        why = f"the four marked corners span no board of {asked}: {100 * share:.0f} % of its corners are there"
        return BoardView(name, None, f"no board found: {why}")
    grid[~near] = np.nan
    return judged(grey, image, grid, board, name)


def _between(marks_px: Array, corners: tuple[int, int]) -> Array:
    """The grid (ny, nx, 2) that a homography puts between four marks, x along the first two."""
    nx, ny = corners
    x, y = (marks_px - marks_px.mean(axis=0)).T
    if np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) < 0:  # against the clock as seen
        marks_px = marks_px[::-1]
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    rows = []
    for (s, t), (x, y) in zip(square, marks_px, strict=True):
        rows += [[s, t, 1, 0, 0, 0, -x * s, -x * t], [0, 0, 0, s, t, 1, -y * s, -y * t]]
    h = np.append(np.linalg.solve(np.array(rows), marks_px.ravel()), 1).reshape(3, 3)
    s, t = np.meshgrid(np.linspace(0, 1, nx), np.linspace(0, 1, ny))
    seen = np.stack([s, t, np.ones_like(s)], axis=-1) @ h.T
    return np.asarray(seen[..., :2] / seen[..., 2:])


def _fitted(grid: Array, places_px: Array) -> tuple[Array, Mask]:
    """The grid (ny, nx, 2) drawn to saddles (N, 2), and which of its corners have one."""
    expected, near = grid, np.zeros(grid.shape[:2], bool)
    for within in NEAR_SHARES if len(places_px) else ():
        grid, near, expected = _drawn(expected, places_px, within)
    return grid, near


def _drawn(expected: Array, places_px: Array, within: float) -> tuple[Array, Mask, Array]:
    """The grid (ny, nx, 2) of the saddles nearest to where corners are expected, which are near, and where corners are expected then."""
    step = np.minimum(*(np.linalg.norm(np.gradient(expected, axis=axis), axis=-1) for axis in (0, 1)))
    apart = np.linalg.norm(expected[:, :, None] - places_px, axis=-1)
    seen = places_px[apart.argmin(axis=-1)]
    near = np.asarray(apart.min(axis=-1) < within * step, bool)
    ny, nx = near.shape
    s, t = np.meshgrid(np.linspace(-1, 1, nx), np.linspace(-1, 1, ny))
    order = min(3, nx - 1, ny - 1)
    terms = np.stack([s**i * t**j for i in range(order + 1) for j in range(order + 1 - i)], axis=-1)
    if near.sum() < 2 * terms.shape[-1]:
        return seen, near, expected
    return seen, near, np.asarray(terms @ np.linalg.lstsq(terms[near], seen[near], rcond=None)[0])
