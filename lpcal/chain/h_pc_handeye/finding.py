r"""The solve's end: the record with its covariance, the verdict on each view, and the evidence.

How far the board is from its place in each view by a solve that the view had no part in: what a new view would show.

With up to `ONE_BY_ONE` views each is left out in turn; with more, every tenth together, so that a view's neighbours stay in. Each is one
Gauss-Newton step from the solve of all views, at its sigmas: what is left out moves it by a fraction of its own sigma.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lpcal.chain.h_pc_handeye import congruence, observability, variance
from lpcal.chain.h_pc_handeye.advice import advise
from lpcal.chain.h_pc_handeye.drift import Drift
from lpcal.chain.h_pc_handeye.likelihood import HandEyeEstimate, PoseUnknown, Views, misfit
from lpcal.chain.h_pc_handeye.moved import find_step
from lpcal.chain.h_pc_handeye.set_up import SetUp
from lpcal.chain.h_pc_handeye.state import SolveState
from lpcal.chain.h_pc_handeye.variance import covariance_of_pose_errors
from lpcal.errors import ConvergenceError, DegenerateError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.pose_track import TrackPoses
from lpcal.records.calibration import Carries, HandEye, ViewVerdict
from lpcal.records.evidence import HandEyeEvidence

ON_BODY = SetUp()
MISFIT = "its mocap pose misses the others"
"""Why a view was left out whose pose was measured but does not fit."""
MOST_BAD = 0.5
"""Share of the views that may not fit one rigid camera."""


@dataclass(frozen=True)
class HandEyeFinding:
    """The record, and the panel pose that each of the asked views got."""

    handeye: HandEye
    panel: TrackPoses
    offset_s: float
    """The clock offset at which they were taken, known or not."""
    drift: Drift | None = None
    """The clocks' drift, where it shows."""
    set_up: SetUp = ON_BODY

    def mocap_times(self, t_camera_s: Array) -> Array:
        """Times of the mocap's clock (N,) of camera times (N,)."""
        return (t_camera_s if self.drift is None else self.drift.corrected(t_camera_s)) - self.offset_s


def finding_of(
    state: SolveState,
    t_camera_s: Array | None,
    warnings: list[str],
    known_offset_s: float | None,
    drift: Drift | None = None,
    set_up: SetUp = ON_BODY,
) -> HandEyeFinding:
    """The record of a settled solve; `t_camera_s` are the views' times, freed of the `drift` that shows.

    Raises
    ------
    ConvergenceError
        Most views do not fit.
    DisagreementError
        Board or camera moved between two views.
    DegenerateError
        Those that are left cannot show H_PC.
    """
    found, views = state.estimate(), state.views()
    spread, more = observability.refuse_what_cannot_show_it(state.measured()[state.inliers])
    factor = variance.block_factor(views, found, None if t_camera_s is None else t_camera_s[state.inliers])
    covariance = _with_pose_errors(found.covariance(), covariance_of_pose_errors(views, found), factor)
    bad = float(np.mean(~state.inliers[state.panel.trusted]))
    if bad > MOST_BAD:
        raise ConvergenceError(
            f"{100 * bad:.0f} % of the views do not fit one rigid camera", needed="a majority that does", todo="look at: lpcal check"
        )
    _refuse_a_step(state)
    carries: Carries = "board" if set_up.board_carried else "camera"
    more_warnings, weakest = _weakest(found, views, covariance, factor, carries)
    warnings += more_warnings
    clocked = state.clock and t_camera_s is not None
    offset = state.offset_s if clocked else known_offset_s
    handeye = HandEye(
        H_PC=found.H_PC,
        H_PC_covariance=covariance[:6, :6],
        H_OB=found.H_OB,
        H_OB_covariance=covariance[6:12, 6:12],
        clock_offset_s=offset,
        clock_offset_std_s=float(np.sqrt(covariance[12, 12])) if clocked else (0.0 if offset is not None else None),
        views=_verdicts(state, found),
        clock_drift=drift.rate if drift is not None else 0.0,
        clock_middle_s=drift.middle_s if drift is not None else 0.0,
        warnings=(*warnings, *more),
        evidence=replace(_evidence(state, found, spread, factor), weakest=weakest),
        carries=carries,
        taken_offset_s=state.offset_s,
        misread=set_up.misstated,
    )
    return HandEyeFinding(handeye, state.panel, state.offset_s, drift, set_up)


def _weakest(found: HandEyeEstimate, views: Views, covariance: Array, factor: float, carries: Carries) -> tuple[list[str], str | None]:
    """Warnings; and, where the body carries the camera, in which direction it is known worst, in words."""
    size = congruence.board_size_warning(found.scale, found.scale_std * np.sqrt(factor), found.H_PC, carries)
    behind = congruence.behind_warning(views.H_CB)
    if carries == "board":
        return [each for each in (size, behind) if each is not None], None
    roles = congruence.swapped_roles_warning(found.H_PC, found.H_OB)
    advised = advise(views.H_OP, found.in_mocap_metres(views.H_CB), found.H_PC, found.H_OB, covariance[:6, :6])
    return [each for each in (size, behind, roles, advised.warning()) if each is not None], advised.words()


def _refuse_a_step(state: SolveState) -> None:
    """Stop where board or camera moved between two views; their order is that of the images."""
    rows = np.flatnonzero(state.panel.trusted)
    images = [state.boards.images[row] for row in rows]
    step = find_step(state.panel.H[rows], state.boards.H_CB[rows], images, board_carried=state.board_carried)
    if step is not None:
        raise step.refusal()


def _verdicts(state: SolveState, found: HandEyeEstimate) -> tuple[ViewVerdict, ...]:
    whole = Views(state.boards.H_CB, state.panel.H, state.panel.velocity, np.zeros(0, dtype=np.intp), np.zeros(0))
    angle, distance = misfit(whole, found)
    _, held_out_m = held_out(state)
    px = np.full(len(state.inliers), np.nan)
    residuals, view = found.corner_residuals()
    if len(residuals):
        rows = np.flatnonzero(state.inliers)
        squares = np.bincount(rows[view], np.sum(residuals**2, axis=1) / 2, len(px))
        counts = np.bincount(rows[view], minlength=len(px))
        px = np.where(counts > 0, np.sqrt(squares / np.maximum(counts, 1)), np.nan)
    verdicts = []
    for k, image in enumerate(state.boards.images):
        why = state.panel.why[k]
        used = bool(state.inliers[k])
        if why is None and not used:
            why = f"{MISFIT} by {np.degrees(angle[k]):.2f} deg, {1e3 * distance[k]:.1f} mm"
        seen = why is None or used or state.panel.why[k] is None
        verdicts.append(
            ViewVerdict(
                image,
                used,
                None if used else why,
                residual_px=float(px[k]) if np.isfinite(px[k]) else None,
                residual_m=float(distance[k]) if seen else None,
                residual_rad=float(angle[k]) if seen else None,
                held_out_m=float(held_out_m[k]) if np.isfinite(held_out_m[k]) else None,
                reason=None if used else state.panel.why[k] or MISFIT,
            )
        )
    return tuple(verdicts)


def _with_pose_errors(covariance: Array, added: Array, factor: float) -> Array:
    """The covariance (13, 13) with what errors that depend on the pose add (12, 12), at least a factor more than by white noise."""
    whole = covariance.copy()
    whole[:12, :12] += added
    grown = float(np.trace(np.linalg.solve(covariance[:6, :6], whole[:6, :6]))) / 6
    return np.asarray(whole * max(1.0, factor / grown))


def _evidence(state: SolveState, found: HandEyeEstimate, spread: observability.Spread, factor: float) -> HandEyeEvidence:
    s = state.sigmas
    group = int(state.views().noise_class.max())
    dwells, camera = bool(group), state.camera
    start, difference = state.start[0], found.H_PC @ se3.inv(state.start[0])
    return HandEyeEvidence(
        views_used=int(state.inliers.sum()),
        rotation_spread_deg=np.degrees(spread.sigma_rad),
        mocap_sigma_deg=float(np.degrees(s.mocap_rad[0])),
        mocap_sigma_m=s.mocap_m[0],
        closed_form_H_PC=None if state.board_carried else start,
        closed_form_H_OC=start if state.board_carried else None,
        covariance_factor_of_shared_errors=factor,
        board_size_by_mocap=found.scale,
        board_size_by_mocap_std=found.scale_std * float(np.sqrt(factor)),
        views_that_share_an_error=float(np.median(state.deflation[state.inliers])),
        mocap_sigma_dwell_deg=float(np.degrees(s.mocap_rad[1])) if dwells else None,
        mocap_sigma_dwell_m=s.mocap_m[1] if dwells else None,
        corner_sigma_px=s.px if camera is not None else None,
        camera_as_refined_here=found.camera if camera is not None else None,
        camera_moved=found.camera - camera.mean if camera is not None else None,
        board_sigma_deg=float(np.degrees(s.board_rad)) if camera is None else None,
        board_sigma_m=(s.board_lateral_m, s.board_lateral_m, s.board_depth_m) if camera is None else None,
        moved_from_closed_form_deg=float(np.degrees(se3.angle_rad(difference[:3, :3]))),
        moved_from_closed_form_m=float(np.linalg.norm(found.H_PC[:3, 3] - start[:3, 3])),
    )


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
