"""How far the board is from its place in each view by a solve that the view had no part in: what a new view would show.

With up to `MOST_SOLVES` views each is left out in turn; with more, every n-th together, so that a view's neighbours stay in.
The noise stays as found; the sigmas of the whole set weigh each part.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.chain.h_pc_handeye import observability
from lpcal.chain.h_pc_handeye.likelihood import estimate, misfit
from lpcal.chain.h_pc_handeye.state import State
from lpcal.errors import LpcalError
from lpcal.geometry.arrays import Array
from lpcal.geometry.least_squares import Options as LeastSquaresOptions

MOST_SOLVES = 20
FEW_STEPS = LeastSquaresOptions(iterations=3, strict=False)


def held_out(state: State) -> tuple[Array, Array]:
    """Angle (N,) and distance (N,) by which each used view's board misses the H_OB of the others; NaN for views not used."""
    rows = np.flatnonzero(state.inliers)
    angle, distance = np.full(len(state.inliers), np.nan), np.full(len(state.inliers), np.nan)
    folds = min(MOST_SOLVES, len(rows))
    for fold in range(folds):
        out = rows[fold::folds]
        rest = state.inliers.copy()
        rest[out] = False
        if rest.sum() < observability.FEWEST_VIEWS:
            continue
        others = replace(state, inliers=rest).views()
        try:
            found = estimate(others, state.camera, state.sigmas, state.estimate(), clock=state.clock, options=FEW_STEPS)
        except LpcalError:
            continue
        left_out = replace(state, inliers=np.isin(np.arange(len(rest)), out)).views()
        angle[out], distance[out] = misfit(left_out, found)
    return angle, distance
