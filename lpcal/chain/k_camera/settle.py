"""The last solve, with what was chosen: views that do not fit left out, the board's whole shape, and mrcal's inputs kept.

mrcal knows of the board its bow alone, and no prior of it. The shape is found by `refit` and taken out of the corners before mrcal solves
them, so that both hold the same camera; symbols: q a corner, x_B the board's point with its shape, b_B on the flat board::

    q' = q - project(H_CB x_B) + project(H_CB b_B)

The covariance is that of `refit`, in which the shape is free.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.chain.k_camera.choice import Candidate
from lpcal.chain.k_camera.problem import DISTORTIONS, CameraFit, CornerProblem, Solver
from lpcal.chain.k_camera.refit import refit
from lpcal.chain.k_camera.shape import BOARDS
from lpcal.geometry import se3

WORST_SHARE = 0.5
"""A view of which more corners than this are rejected is not used."""
FEWEST_VIEWS = 3


def settle(problem: CornerProblem, solver: Solver, chosen: Candidate, start: CameraFit | None = None) -> tuple[CameraFit, dict[int, str]]:
    """The fit, and the rows of views that were left out of it because most of their corners do not fit.

    `start` is the solver's fit from which the choice was made: where it is what was chosen, it is not solved again.
    """
    known = start is not None and (start.camera.model, start.board) == (chosen.model, chosen.board) == (chosen.model, BOARDS[0])
    fit = start if start is not None and known else settled(problem, chosen.model, chosen.board, solver)
    seen = np.isfinite(problem.corners_px).all(axis=-1).sum(axis=1)
    rejected = seen - fit.inlier.sum(axis=1)
    bad = rejected > WORST_SHARE * seen
    if bad.any() and (~bad).sum() >= FEWEST_VIEWS:
        fit = settled(problem.part(~bad), chosen.model, chosen.board, solver)
    else:
        bad[:] = False
    return fit, {int(row): f"{rejected[row]} of {seen[row]} corners do not fit" for row in np.flatnonzero(bad)}


def settled(problem: CornerProblem, model: str, board: str, solver: Solver) -> CameraFit:
    """The solver's fit, the board's shape by `refit` unless the lens is splined: what a polynomial lacks would go into the shape."""
    if board == BOARDS[0] or model not in DISTORTIONS:
        return solver(problem, model, board)
    shaped = refit(problem, model, board)
    if solver is refit:
        return shaped
    flat_B = problem.board.points_B()
    taken_out = shaped.camera.project(se3.apply(shaped.H_CB, shaped.points_B)) - shaped.camera.project(se3.apply(shaped.H_CB, flat_B))
    fit = solver(replace(problem, corners_px=problem.corners_px - taken_out), model, BOARDS[0])
    fit = replace(fit, camera=replace(fit.camera, covariance=shaped.camera.covariance), sigma_px=shaped.sigma_px)
    return replace(fit, points_B=shaped.points_B, board=shaped.board, shape=shaped.shape)
