"""How far the board is from its place in each view by a solve that the view had no part in: what a new view would show.

With up to `ONE_BY_ONE` views each is left out in turn; with more, every tenth together, so that a view's neighbours stay in. Each is one
Gauss-Newton step from the solve of all views, at its sigmas: what is left out moves it by a fraction of its own sigma.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.chain.h_pc_handeye import observability
from lpcal.chain.h_pc_handeye.likelihood import PoseUnknown, misfit
from lpcal.chain.h_pc_handeye.state import SolveState
from lpcal.errors import DegenerateError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

ONE_BY_ONE, FOLDS = 20, 10


def held_out(state: SolveState) -> tuple[Array, Array]:
    """Angle (N,) and distance (N,) by which each used view's board misses the H_OB of the others; NaN for views not used."""
    rows = np.flatnonzero(state.inliers)
    angle, distance = np.full(len(state.inliers), np.nan), np.full(len(state.inliers), np.nan)
    found, views = state.estimate(), state.views()
    at = found.solution.columns(PoseUnknown.H_PC, PoseUnknown.H_OB)
    folds = len(rows) if len(rows) <= ONE_BY_ONE else FOLDS
    for fold in range(folds):
        out = np.arange(len(rows)) % folds == fold
        if np.sum(~out) < observability.FEWEST_VIEWS:
            continue
        try:
            step = found.solution.without(found.of_views(out))[at]
        except DegenerateError:
            continue
        others = replace(found, H_PC=se3.exp(step[:6]) @ found.H_PC, H_OB=se3.exp(step[6:]) @ found.H_OB)
        angle[rows[out]], distance[rows[out]] = misfit(views.of(out), others)
    return angle, distance
