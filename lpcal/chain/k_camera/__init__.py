"""The intrinsics K of the camera from board corners: choose a lens model, solve, reject, say how sure.

``q_km = project(K, H_CB[k] x_B,m)`` for corner m of view k; unknown are the lens, the poses H_CB and the board's bow.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from importlib.util import find_spec

import numpy as np

from lpcal.chain.k_camera.choice import Candidate, choose
from lpcal.chain.k_camera.problem import DISTORTIONS, CameraFit, CornerProblem, Solver, rms
from lpcal.errors import DegenerateError, InputError
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import CameraSolution, ViewVerdict
from lpcal.records.observations import Board, BoardViews

FEWEST_VIEWS = 3
WORST_SHARE = 0.5
"""A view of which more corners than this are rejected is not used."""


def solve_camera(views: BoardViews, board: Board, *, model: str = "auto", solver: str = "auto") -> CameraSolution:
    """Intrinsics, the board's shape, and what became of each view.

    Parameters
    ----------
    views : what was found in the images
    board : the board; ``board.warp`` lets it be bowed where cross-validation prefers that
    model : auto | opencv4 | opencv5 | opencv8 | splined
    solver : auto | mrcal | opencv

    Raises
    ------
    DegenerateError
        Fewer than three views with a board.
    InputError
        A splined lens without mrcal.
    ConvergenceError
        No solution.
    """
    found = [index for index, view in enumerate(views.views) if view.corners_px is not None]
    if len(found) < FEWEST_VIEWS:
        raise DegenerateError(
            f"the board was found in {len(found)} of {len(views.views)} images",
            where="camera.images",
            needed=f"at least {FEWEST_VIEWS}, better 20, of different tilts",
            todo="take more images of the board",
        )
    name, solve = pick_solver(solver)
    if model == "splined" and name != "mrcal":
        raise InputError("a splined lens needs mrcal, which is not installed", where="camera.model", todo="install mrcal, or use opencv8")
    corners_px = np.stack([np.asarray(views.views[index].corners_px) for index in found])
    problem = CornerProblem(board, views.image_size, corners_px)
    models = list(DISTORTIONS) if model == "auto" else [model]
    chosen, tried = choose(problem, solve, models, [False, True] if board.warp else [False])
    fit = solve(problem, chosen.model, chosen.warp)
    return CameraSolution(
        camera=fit.camera,
        points_B=fit.points_B,
        views=_verdicts(views, found, fit),
        solver=name,
        corner_sigma_px=fit.sigma_px,
        evidence=_evidence(chosen, tried, fit, board),
        cameramodel=fit.cameramodel,
    )


def pick_solver(solver: str) -> tuple[str, Solver]:
    """The solver's name and function; auto is mrcal where it is installed."""
    if solver == "mrcal" or (solver == "auto" and find_spec("mrcal") is not None):
        from lpcal.chain.k_camera import mrcal_solver

        return "mrcal", mrcal_solver.solve
    raise InputError("mrcal is not installed", needed="mrcal, which solves the camera", todo="pip install --no-deps mrcal")


def _verdicts(views: BoardViews, found: Sequence[int], fit: CameraFit) -> tuple[ViewVerdict, ...]:
    rows = {index: row for row, index in enumerate(found)}
    verdicts = []
    for index, view in enumerate(views.views):
        if index not in rows:
            verdicts.append(ViewVerdict(view.image, used=False, why=view.why))
            continue
        inlier, residual_px = fit.inlier[rows[index]], fit.residual_px[rows[index]]
        seen = int(np.isfinite(residual_px).all(axis=-1).sum())
        rejected = seen - int(inlier.sum())
        used = rejected <= WORST_SHARE * seen
        why = None if used else f"{rejected} of {seen} corners do not fit"
        verdicts.append(
            ViewVerdict(view.image, used, why, residual_px=rms(residual_px, inlier), corners=int(inlier.sum()), rejected=rejected)
        )
    return tuple(verdicts)


def _evidence(chosen: Candidate, tried: Sequence[Candidate], fit: CameraFit, board: Board) -> dict[str, object]:
    """How the choice was made, in figures and in words."""
    scores = [{"model": c.model, "warp": c.warp, "cross_validation_px": c.score_px} for c in tried]
    if len(tried) == 1:
        why = "as asked"
    elif np.isnan(chosen.score_px):
        why = "too few views to cross-validate: the simplest"
    else:
        flat = [c.score_px for c in tried if not c.warp and c.model == chosen.model]
        bowed = [c.score_px for c in tried if c.warp and c.model == chosen.model]
        why = "halves of the views agree best"
        if flat and bowed:
            why += f": {bowed[0]:.3f} px with a bowed board, {flat[0]:.3f} px with a flat one"
    return {
        "chosen": {"model": chosen.model, "warp": chosen.warp, "why": why},
        "cross_validation": scores,
        "corner_sigma_px": fit.sigma_px,
        "board_warp_m": None if fit.warp_m is None else list(fit.warp_m),
        "board_warp_allowed": board.warp,
    }


def with_radiometry(solution: CameraSolution, **levels: object) -> CameraSolution:
    """The solution with what the sensor does to light: black_level, white_level, gamma, flat_field."""
    return replace(solution, camera=replace(solution.camera, **levels))  # type: ignore[arg-type]


__all__ = ["Array", "pick_solver", "solve_camera", "with_radiometry"]
