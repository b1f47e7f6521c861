"""How a printed board differs from a flat grid of squares: displacement fields of its corners, each times one number.

Symbols: u, v from -1 to 1 over the corners along x and along y; m, n the half sides of the grid in metres. Every field of heights is
made orthogonal to 1, u and v over the corners, so that the board's mean plane stays z = 0::

    bow      z = 1 - u^2, 1 - v^2              the middle's deflection along x, along y (mrcal's two)
    twist    z = u v                           of opposite ends against each other
    cubic    z = u^3, u^2 v, u v^2, v^3
    stretch  (x, y) = (m u, -n v) / 2, (n v, m u) / 2      sides unequal, not square to each other

All have a prior about 0: none is switched on or off by chance where two are nearly equal.

Source: plate bending (Timoshenko & Woinowsky-Krieger 1959) for the order of the terms; the priors are print shops' tolerances.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.records.observations import Board

BOARDS = ("flat", "bowed", "shaped", "stretched")
"""What a board may be taken as, each with the terms of the one before."""
CUBIC_SHARE = 4e-4
"""One standard deviation of a cubic term, in units of the grid's diagonal."""
QUADRATIC_SHARE = 1.2e-3
"""One standard deviation of bow and twist beforehand, in units of the grid's diagonal: 0.3 mm on a board of 9x6 squares of 25 mm. With it
the shape goes continuously from flat, where the data do not show it, to what they show; a bow of many times that is found all the same."""
STRETCH = 1e-3
"""One standard deviation of what the sides differ by, relative."""


@dataclass(frozen=True)
class ShapeTerms:
    """Displacements (J, M, 3) of the corners for a unit of each term, and one standard deviation (J,) of the terms beforehand."""

    names: tuple[str, ...]
    fields: Array
    prior: Array


def shape_terms(board: Board, kind: str) -> ShapeTerms:
    """The terms that are free when the board is taken as one of BOARDS; heights in metres, stretch and shear relative."""
    columns, rows = board.corners
    half = np.array([columns - 1, rows - 1]) * np.array(board.square_m) / 2
    u, v = (axis.ravel() for axis in np.meshgrid(np.linspace(-1, 1, columns), np.linspace(-1, 1, rows)))
    diagonal = float(2 * np.hypot(*half))
    heights = {"bow_x_m": 1 - u**2, "bow_y_m": 1 - v**2}
    prior = [QUADRATIC_SHARE * diagonal] * 2
    if kind in BOARDS[2:]:
        heights |= {"twist_m": u * v, "cubic_xxx_m": u**3, "cubic_xxy_m": u * u * v, "cubic_xyy_m": u * v * v, "cubic_yyy_m": v**3}
        prior += [QUADRATIC_SHARE * diagonal] + [CUBIC_SHARE * diagonal] * 4
    level = np.stack([np.ones_like(u), u, v], axis=1)
    named = {name: _raised(height, level) for name, height in heights.items()} if kind != BOARDS[0] else {}
    if kind == BOARDS[3]:
        along, across = half[0] * u / 2, half[1] * v / 2
        named |= {"stretch": np.stack([along, -across, 0 * u], axis=1), "shear": np.stack([across, along, 0 * u], axis=1)}
        prior += [STRETCH, STRETCH]
    fields = np.array(list(named.values())).reshape(len(named), u.size, 3)
    return ShapeTerms(tuple(named), fields, np.array(prior[: len(named)]))


def _raised(height: Array, level: Array) -> Array:
    """Displacements (M, 3) along z, what is of a plane taken out."""
    above = height - level @ np.linalg.lstsq(level, height, rcond=None)[0]
    return above[:, None] * np.array([0.0, 0.0, 1.0])
