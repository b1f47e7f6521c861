"""How far the board is from its place in each view by a solve that the view had no part in: what a new view would show.

With up to `ONE_BY_ONE` views each is left out in turn; with more, every tenth together, so that a view's neighbours stay in. Each is one
Gauss-Newton step from the solve of all views, at its sigmas: what is left out moves it by a fraction of its own sigma.
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

ONE_BY_ONE, FOLDS = 20, 10
ONE_STEP = LeastSquaresOptions(iterations=1, strict=False)


def held_out(state: State) -> tuple[Array, Array]:
    """Angle (N,) and distance (N,) by which each used view's board misses the H_OB of the others; NaN for views not used."""
    rows = np.flatnonzero(state.inliers)
    angle, distance = np.full(len(state.inliers), np.nan), np.full(len(state.inliers), np.nan)
    folds = len(rows) if len(rows) <= ONE_BY_ONE else FOLDS
    whole = state.estimate()
    latent = whole.solution["H_OP"] if whole.term("mocap") >= 0 else None
    for fold in range(folds):
        out = rows[fold::folds]
        rest = state.inliers.copy()
        rest[out] = False
        if rest.sum() < observability.FEWEST_VIEWS:
            continue
        others = replace(state, inliers=rest).views()
        try:
            start_OP = None if latent is None else latent[rest[rows]]
            found = estimate(others, state.camera, state.sigmas, whole, clock=state.clock, options=ONE_STEP, start_OP=start_OP)
        except LpcalError:
            continue
        left_out = replace(state, inliers=np.isin(np.arange(len(rest)), out)).views()
        angle[out], distance[out] = misfit(left_out, found)
    return angle, distance
