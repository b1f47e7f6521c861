"""The intrinsics K of the camera from board corners: choose a lens model, solve, reject, say how sure.

``q_km = project(K, H_CB[k] x_B,m)`` for corner m of view k; unknown are the lens, the poses H_CB and the board's shape. Solved by mrcal
where it is installed and the squares are square, else from OpenCV's start by lpcal's own adjustment, which finds the same and knows more
shapes of a board.

The last solve, with what was chosen: views that do not fit left out, the board's whole shape, and mrcal's inputs kept.

mrcal knows of the board its bow alone, and no prior of it. The shape is found by `refit` and taken out of the corners before mrcal solves
them, so that both hold the same camera; symbols: q a corner, x_B the board's point with its shape, b_B on the flat board::

    q' = q - project(H_CB x_B) + project(H_CB b_B)

The covariance is that of `refit`, in which the shape is free.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from importlib.util import find_spec

import numpy as np

from lpcal.chain.k_camera import patterns
from lpcal.chain.k_camera.bundle import find_shape, refit
from lpcal.chain.k_camera.choice import FEWEST_VIEWS as FEWEST_TO_CHOOSE
from lpcal.chain.k_camera.choice import Candidate, better_of, choose
from lpcal.chain.k_camera.findings import blurred_or_glaring, findings
from lpcal.chain.k_camera.next_view import TODO, monotony
from lpcal.chain.k_camera.problem import DISTORTIONS, CameraFit, CornerProblem, Solver, rms
from lpcal.chain.k_camera.shape import BOARDS
from lpcal.errors import ConvergenceError, DegenerateError, InputError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera, CameraSolution, ViewVerdict
from lpcal.records.evidence import CameraEvidence, ChosenModel, ShapeTerm, TriedModel
from lpcal.records.observations import Board, BoardViews

DEGENERATE_SHARE, WEAK_SHARE = 0.03, 0.005
"""Sigma, as a share of a focal length (of the image's width for the principal point), above which a camera is refused, warned of."""
UNEQUAL_SHARE, UNEQUAL_SIGMAS = 0.03, 3.0
"""fx and fy that differ by this share, and by so many sigmas, are said: sensors' pixels are square within a tenth of a per cent."""
SPLINE_SHARE = 0.5
"""A splined lens is tried where the residuals keep a pattern in the image of more than this share of a corner's sigma."""


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
        Fewer than three views with a board, or views that do not determine the focal length or the principal point.
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
    name, solve, missing = pick_solver(solver, board)
    if model == "splined" and name != "mrcal":
        raise InputError(f"a splined lens needs mrcal; {missing}", where="camera.model", todo="install mrcal, or use opencv8")
    corners_px = np.stack([np.asarray(views.views[index].corners_px) for index in found])
    problem = CornerProblem(board, views.image_size, corners_px)
    try:
        chosen, tried, fit, left_out = _chosen_and_solved(problem, solve, model, may_spline=name == "mrcal")
    except (ConvergenceError, np.linalg.LinAlgError) as error:
        if (alike := monotony(problem, None)) is None:
            raise
        raise DegenerateError(alike, where="camera.images", needed="views that differ enough to determine a camera", todo=TODO) from error
    found, misfits = [index for row, index in enumerate(found) if row not in left_out], {found[row]: why for row, why in left_out.items()}
    alike = monotony(problem, fit.camera if fit.camera.spline is None else None)
    doubts = refuse_degenerate(fit, alike)
    kept = problem.part(np.array([row not in left_out for row in range(len(corners_px))]))
    figures, unmodelled = findings(kept, fit, [views.views[index].image for index in found], blame_board=alike is None)
    return CameraSolution(
        camera=fit.camera,
        points_B=fit.points_B,
        views=_verdicts(views, found, misfits, fit),
        solver=name,
        corner_sigma_px=fit.sigma_px,
        evidence=replace(_evidence(chosen, tried, fit, board, figures), solver_note=missing or None),
        warnings=(*doubts, *unmodelled, *blurred_or_glaring(views.views)),
        cameramodel=fit.cameramodel() if fit.cameramodel else "",
        H_CB={views.views[index].image: H_CB for index, H_CB in zip(found, fit.H_CB, strict=True)},
    )


def _chosen_and_solved(
    problem: CornerProblem, solve: Solver, model: str, *, may_spline: bool
) -> tuple[Candidate, list[Candidate], CameraFit, dict[int, str]]:
    """The candidate chosen, all that were tried, its fit, and the rows of views left out of it."""
    may_warp = problem.board.warp
    start = solve(problem, "opencv4", BOARDS[may_warp])
    problem, judged = replace(problem, camera=start.camera, H_CB=start.H_CB), refit if model != "splined" else solve
    chosen, tried = choose(problem, judged, list(DISTORTIONS) if model == "auto" else [model], may_warp)
    fit, left_out = settle(problem, solve, chosen, start)
    left = patterns.on_image(fit)
    if model == "auto" and may_spline and left.seen(fit.sigma_px) and left.size_px > SPLINE_SHARE * fit.sigma_px:
        ranked = better_of(problem, (judged, chosen.model, chosen.board), (partial(settled, solver=solve), "splined", BOARDS[may_warp]))
        tried = [*(one for one in tried if one != chosen), *ranked]
        if ranked[0].model == "splined":
            chosen = ranked[0]
            fit, left_out = settle(problem, solve, chosen)
    return chosen, tried, fit, left_out


def pick_solver(solver: str, board: Board) -> tuple[str, Solver, str | None]:
    """The solver's name and function, and what is missing where it is not mrcal, in words."""
    unequal = board.square_m[0] != board.square_m[1]
    absent = any(find_spec(name) is None for name in ("mrcal", "numpysane"))  # mrcal installed without what it imports is none
    if solver == "mrcal" or (solver == "auto" and not unequal and not absent):
        from lpcal.chain.k_camera import mrcal_solver

        return "mrcal", mrcal_solver.solve, None
    from lpcal.chain.k_camera.bundle import solve_from_opencv

    missing = None
    if solver == "auto":
        missing = "mrcal knows no unequal squares" if unequal else "mrcal is not installed"
        missing += ": solved without it; camera.cameramodel holds no optimisation inputs, and mrcal's tools give no uncertainty for it"
    return "opencv", solve_from_opencv, missing


def refuse_degenerate(fit: CameraFit, alike: str | None = None) -> list[str]:
    """Warnings about what the views hardly determine; `alike` says what they have too much in common, where that is known.

    Raises
    ------
    DegenerateError
        They do not determine it at all: boards that all face the camera leave focal length and distance undecided.
    """
    camera = fit.camera
    if camera.covariance is None:
        return [f"{alike}; {TODO}"] if alike else []
    variance = np.diag(camera.covariance)[:4]  # negative where an information matrix without a rank was inverted
    sigma = np.where(variance >= 0, np.sqrt(np.abs(variance)), np.inf)
    shares = sigma / [camera.K[0, 0], camera.K[1, 1], camera.image_size[0], camera.image_size[0]]
    worst = {"focal length": float(shares[:2].max()), "principal point": float(shares[2:].max())}
    how = {name: f"to {100 * share:.1g} %" if np.isfinite(share) else "not at all" for name, share in worst.items()}
    said = {name: f"{name} {how[name]}" for name, share in worst.items() if not share < WEAK_SHARE}
    lost = [name for name, share in worst.items() if not share < DEGENERATE_SHARE]
    why = alike or "the board seems to face the camera, or to fill little of the image"
    if lost:
        raise DegenerateError(
            f"these {len(fit.H_CB)} views do not determine the {' and the '.join(lost)}: {', '.join(said.values())}; {why}",
            where="camera.images",
            needed=f"one sigma under {100 * DEGENERATE_SHARE:.0f} %",
            todo=TODO,
        )
    doubts = [f"the views determine the {', the '.join(said.values())} only{f': {alike}' if alike else ''}; {TODO}"] if said else []
    if alike and not said:
        doubts.append(f"{alike}; the sigmas are those of corners that scatter, and hold only if the lens is as modelled")
    return doubts + _unequal_focal(fit, sigma)


def _unequal_focal(fit: CameraFit, sigma: Array) -> list[str]:
    """A warning where focal lengths along x and y differ by more than sensors do."""
    fx, fy = fit.camera.K[0, 0], fit.camera.K[1, 1]
    off = fx / fy - 1
    if abs(off) < max(UNEQUAL_SHARE, UNEQUAL_SIGMAS * float(np.hypot(sigma[0] / fx, sigma[1] / fy))):
        return []
    longer = "x" if off > 0 else "y"
    return [
        f"fx {fx:.1f} and fy {fy:.1f} px differ by {100 * (max(fx, fy) / min(fx, fy) - 1):.1f} %: pixels that are not square are rare. "
        f"Were the images stretched along {longer} (resized, anamorphic, half the lines), or are the board's squares not square "
        "(board.square: [x, y] as measured)?"
    ]


def board_shape(views: BoardViews, board: Board, camera: Camera, H_CB: dict[str, Array]) -> Array:
    """Points_B (M, 3) of a board that may be bent, the camera given and poses H_CB by image known about."""
    if not board.warp or camera.spline is not None or len(H_CB) < FEWEST_VIEWS:
        return board.points_B()
    corners_px = np.stack([np.asarray(view.corners_px) for view in views.views if view.image in H_CB])
    problem = CornerProblem(board, views.image_size, corners_px)
    return find_shape(problem, camera, np.stack([H_CB[view.image] for view in views.views if view.image in H_CB]))


def _verdicts(views: BoardViews, found: Sequence[int], misfits: dict[int, str], fit: CameraFit) -> tuple[ViewVerdict, ...]:
    rows = {index: row for row, index in enumerate(found)}
    verdicts = []
    for index, view in enumerate(views.views):
        if index not in rows:
            verdicts.append(ViewVerdict(view.image, used=False, why=misfits.get(index, view.why)))
            continue
        inlier, residual_px = fit.inlier[rows[index]], fit.residual_px[rows[index]]
        used = int(inlier.sum())
        rejected = int(np.isfinite(residual_px).all(axis=-1).sum()) - used
        verdicts.append(
            ViewVerdict(
                view.image,
                used=True,
                why=None,
                residual_px=rms(residual_px, inlier),
                corners=used,
                rejected=rejected,
                blur_px=view.blur_px,
                glare=view.glare,
            )
        )
    return tuple(verdicts)


def _evidence(chosen: Candidate, tried: Sequence[Candidate], fit: CameraFit, board: Board, figures: CameraEvidence) -> CameraEvidence:
    """The figures with how the choice was made, in figures and in words."""
    if len(tried) == 1 and (len(fit.H_CB) >= FEWEST_TO_CHOOSE or not board.warp):
        why = "as asked"
    elif np.isnan(chosen.score_px):
        why = "too few views to cross-validate: the simplest"
    else:
        sheets = [f"{c.expected_px:.3f} px on a {c.board} board" for c in tried if c.model == chosen.model]
        why = "expected to be nearest to the truth" + (f": {', '.join(sheets)}" if len(sheets) > 1 else "")
    return replace(
        figures,
        chosen=ChosenModel(model=chosen.model, board=chosen.board, why=why),
        cross_validation=tuple(
            TriedModel(model=c.model, board=c.board, cross_validation_px=c.score_px, expected_error_px=c.expected_px) for c in tried
        ),
        corner_sigma_px=fit.sigma_px,
        board_warp_m=tuple(fit.shape[name][0] for name in ("bow_x_m", "bow_y_m")) if fit.shape else None,
        board_shape={name: ShapeTerm(value=value, std=std) for name, (value, std) in fit.shape.items()},
        board_warp_allowed=board.warp,
    )


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
