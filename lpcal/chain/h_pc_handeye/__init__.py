"""The camera in the tracked body: H_PC and H_OB of ``H_OP(t_k) H_PC H_CB,k = H_OB`` for views k of a static board, and the clocks' offset.

`clock` finds the offset of the two clocks, `likelihood` is the maximum-likelihood problem, `variance` weighs its parts by their own
noise, `observability` says what the motion can show; here they are put together.

The order: trusted panel poses; the offset from relative angles, the likeliest candidates tried with the closed form among outliers;
refusal where the motion cannot show H_PC; the maximum-likelihood problem, its clock relinearised and its sigmas re-estimated until both
settle; views that miss the rest beyond their noise left out and named; the covariance, made larger where neighbours share errors. Boards
that were found by their other end are turned back; body and camera that do not move as one are refused.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.chain.h_pc_handeye import clock as clocks
from lpcal.chain.h_pc_handeye import congruence, observability, set_up, variance
from lpcal.chain.h_pc_handeye.camera_part import as_pinhole, camera_prior
from lpcal.chain.h_pc_handeye.clock import late_stamps, without_rate
from lpcal.chain.h_pc_handeye.drift import Drift, drift_of
from lpcal.chain.h_pc_handeye.ends import found_by_other_end, settled_ends, with_turned
from lpcal.chain.h_pc_handeye.finding import HandEyeFinding, finding_of
from lpcal.chain.h_pc_handeye.likelihood import HandEyeEstimate, Observed, Views, estimate, misfit
from lpcal.chain.h_pc_handeye.state import HandEyeOptions, SolveState
from lpcal.errors import ConvergenceError, DegenerateError, DisagreementError
from lpcal.geometry import park, se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.least_squares import SolverOptions
from lpcal.geometry.pose_track import PoseTrack, TrackPoses, poses_at
from lpcal.records.calibration import Camera
from lpcal.records.observations import BoardPoses

__all__ = ["HandEyeFinding", "HandEyeOptions", "solve_moving", "solve_paired"]

ROUNDS = 25
SETTLED = 0.01
"""Relative change of every sigma at which the estimate counts as settled."""
SETTLED_S = 2e-6
FIRST = SolverOptions(iterations=5, strict=False)
THEN = SolverOptions(iterations=1, damping=1e-12, strict=False)
"""Options of the solves between which the sigmas still change: one Gauss-Newton step each, once near. Undamped: what the mocap
determines is known a million times worse than what the corners do, and damping in proportion to these would freeze it."""
OUTLIER_CHI2 = 33.0
"""Chi-square of six degrees of freedom that one of a hundred thousand sound views exceeds."""
CORNER_SIGMAS = 6.0
READMIT = 5.0
"""Times the rms misfit of the chosen views, less a margin, up to which a view is taken in again."""
ROUNDS_OF_DRIFT = 4
COARSE_RATE = 1e-4
"""Uncertainty (s/s) of a rate that the coarse search alone has found."""
CLOCK_UNSEEN_S = 0.02
"""An offset less certain than this is not one that the data show."""


def solve_moving(boards: BoardPoses, track: PoseTrack, camera: Camera | None, options: HandEyeOptions) -> HandEyeFinding:
    """Hand-eye from a recording with a clock.

    Parameters
    ----------
    boards : with times; corners, where the poses come from them
    track : the tracked body
    camera : with the covariance of its parameters; None: board poses alone

    Raises
    ------
    DegenerateError, DisagreementError, ConvergenceError
        Too few views or turns; clocks that do not meet; views that do not fit one rigid camera.
    """
    stamped_s = np.asarray(boards.t_camera_s)
    t_camera_s, rate = without_rate(track, stamped_s, boards.H_CB) if options.clock_offset_s is None else (stamped_s, 0.0)
    found = set_up.of_track(track, t_camera_s, boards.H_CB, options, from_images=boards.corners_px is not None)
    options = replace(options, carries="board" if found.board_carried else "camera")
    track = replace(track, inverse=found.board_carried != found.misstated)
    state = start_moving(boards, track, t_camera_s, camera, options)
    state = _refine(state, t_camera_s)
    state, t_camera_s, drift = _without_drift(state, t_camera_s)
    if rate:
        middle = float(np.mean(stamped_s))
        rest = drift if drift is not None else Drift(0.0, COARSE_RATE, middle)
        drift = Drift(rate + rest.rate - rate * rest.rate, rest.std, rest.middle_s)
    warnings = found.warnings()
    if drift is not None:
        warnings.append(
            f"the camera's clock runs {1e6 * drift.rate:+.0f} +- {1e6 * drift.std:.1f} ppm fast: its times are corrected for it"
        )
    late = late_stamps(state, t_camera_s)
    warnings += [late] if late else []
    if options.clock_offset_s is None and not state.clock:
        warnings.append("the panel stood still in every view that was used: the data do not show the clock offset, it is left out")
    return finding_of(state, t_camera_s, warnings, options.clock_offset_s, drift, found)


def solve_paired(boards: BoardPoses, H_OP: Array, camera: Camera | None, options: HandEyeOptions) -> HandEyeFinding:
    """Hand-eye from one panel pose a view, H_OP (N, 4, 4), no clock. Raises as `solve_moving`."""
    count = len(H_OP)
    found = set_up.of_pairs(H_OP, boards.H_CB, options, from_images=boards.corners_px is not None)
    options = replace(options, carries="board" if found.board_carried else "camera")
    panel = TrackPoses(np.full(count, np.nan), found.mover(H_OP), np.zeros((count, 6)), (None,) * count, np.zeros(count, dtype=bool))
    return finding_of(_refine(start_paired(boards, panel, camera, options), None), None, found.warnings(), None, set_up=found)


def _refine(state: SolveState, t_camera_s: Array | None) -> SolveState:
    """Settle with the closed form's inliers, choose the views again, settle again with their shared errors counted."""
    state = _settle(state, t_camera_s)
    refused = np.zeros_like(state.inliers)
    for _ in range(4):
        chosen, corners = _choose(state, refused)
        refused |= state.inliers & ~chosen
        same = np.array_equal(chosen, state.inliers) and corners is state.corners_px
        state = replace(state, inliers=chosen, corners_px=corners)
        if not same:
            state = _settle(state, t_camera_s)
        used, factor = state.inliers, np.ones(len(chosen))  # settling may have lost a view to an edge of the recording
        if t_camera_s is not None:
            factor[used] = variance.deflation(state.views(), state.estimate(), state.sigmas, t_camera_s[used])
        moved = np.max(np.abs(factor / state.deflation - 1))
        if moved >= 0.1:
            state = _settle(replace(state, deflation=factor), t_camera_s)
        elif same:
            break
    return state


def _without_drift(state: SolveState, t_camera_s: Array) -> tuple[SolveState, Array, Drift | None]:
    """The solve and its times freed of the clocks' drift, where it shows."""
    total, t_s = None, t_camera_s
    for _ in range(ROUNDS_OF_DRIFT):
        found = drift_of(state, t_s) if state.clock and state.track is not None else None
        if found is None or not found.shown:
            break
        total = found if total is None else replace(total, rate=total.rate + found.rate, std=found.std)
        t_s = total.corrected(t_camera_s)
        panel = poses_at(state.track, t_s - state.offset_s) if state.track is not None else state.panel
        state = _refine(replace(state, panel=panel, inliers=state.inliers & panel.trusted), t_s)
    return state, t_s, total


def _settle(state: SolveState, t_camera_s: Array | None) -> SolveState:
    """Solve at given sigmas, relinearise the clock, re-estimate the sigmas, until all of it stands still."""
    for _ in range(ROUNDS):
        views = state.views()
        if state.clock and not np.any(views.velocity):
            state = replace(state, clock=False)
        found = estimate(
            views, state.camera, state.sigmas, state.found or state.start, clock=state.clock, options=THEN if state.found else FIRST
        )
        sigmas = variance.components(views, found, state.sigmas, None if t_camera_s is None else t_camera_s[state.inliers])
        moved, inliers = variance.change(state.sigmas, sigmas), state.inliers
        state = replace(state, found=found, sigmas=sigmas)
        if state.clock and _clock_unseen(found):
            state = replace(state, clock=False)
        elif state.clock and t_camera_s is not None and state.track is not None:
            offset = state.offset_s + found.d_offset_s
            panel = poses_at(state.track, t_camera_s - offset)
            state = replace(state, offset_s=offset, panel=panel, inliers=state.inliers & panel.trusted)
        if moved < SETTLED and abs(found.d_offset_s) < SETTLED_S and np.array_equal(inliers, state.inliers):
            return state
    if moved > 10 * SETTLED or abs(found.d_offset_s) > 1e-4 or not np.array_equal(inliers, state.inliers):
        raise ConvergenceError(
            f"the hand-eye solve does not settle after {ROUNDS} rounds", needed="data of one rigid camera", todo="look at: lpcal check"
        )
    return state


def _clock_unseen(found: HandEyeEstimate) -> bool:
    """Whether the views leave the offset open: the panel stood still in all of them."""
    try:
        return bool(np.sqrt(found.covariance()[12, 12]) > CLOCK_UNSEEN_S)
    except DegenerateError:
        return True


def _choose(state: SolveState, refused: Mask) -> tuple[Mask, Array | None]:
    """Views whose mocap pose fits within its noise, and the corners without gross ones; what was refused once is not taken in again."""
    found, views = state.estimate(), state.views()
    kind = Observed.MOCAP if state.camera is not None else Observed.BOARD
    place = found.term(kind)
    free = np.maximum(1 - found.solution.leverage(place), 0.02)
    sigma = variance.row_sigmas(views, state.sigmas, kind)
    chi2 = np.sum((found.solution.residuals[place] / sigma) ** 2 / free, axis=1)
    rows = np.flatnonzero(state.inliers)
    sound = chi2 < OUTLIER_CHI2
    chosen = np.zeros_like(state.inliers)
    chosen[rows[sound]] = True
    whole = Views(state.boards.H_CB, state.panel.H, state.panel.velocity, np.zeros(0, dtype=np.intp), np.zeros(0))
    angle, distance = misfit(whole, found)
    limit_rad, limit_m = (READMIT * np.sqrt(np.mean(of[chosen] ** 2)) for of in (angle, distance))
    chosen |= state.panel.trusted & ~state.inliers & ~refused & (angle < 0.7 * limit_rad) & (distance < 0.7 * limit_m)
    if chosen.sum() < observability.FEWEST_VIEWS:
        raise DegenerateError(
            f"{int(chosen.sum())} of {len(chosen)} views agree", needed="a majority of one rigid camera", todo="look at: lpcal check"
        )
    return chosen, _without_gross_corners(state, found)


def _without_gross_corners(state: SolveState, found: HandEyeEstimate) -> Array | None:
    """The corners, NaN where one misses the model by many sigmas; the same array where none does."""
    residuals, _ = found.corner_residuals()
    if not len(residuals) or state.corners_px is None:
        return state.corners_px
    gross = np.linalg.norm(residuals, axis=1) > CORNER_SIGMAS * np.sqrt(2) * state.sigmas.px
    if not gross.any():
        return state.corners_px
    rows = np.flatnonzero(state.inliers)
    view, corner = np.nonzero(np.isfinite(state.corners_px[rows]).all(axis=2))
    corners = state.corners_px.copy()
    corners[rows[view[gross]], corner[gross]] = np.nan
    return corners


CLEARLY_WORSE = 1.0
"""Offsets at which the angles disagree by so much more, in logarithms of squares, are not tried."""


def start_moving(boards: BoardPoses, track: PoseTrack, t_camera_s: Array, camera: Camera | None, options: HandEyeOptions) -> SolveState:
    """The closed form at each likely offset; the one of least scatter."""
    if options.clock_offset_s is not None:
        offsets = [options.clock_offset_s]
    else:
        candidates = clocks.offset_candidates(track, t_camera_s, boards.H_CB)
        offsets = [candidate.offset_s for candidate in candidates if candidate.cost < candidates[0].cost + CLEARLY_WORSE]
    best: tuple[float, SolveState, park.Consensus] | None = None
    for offset in offsets:
        panel = poses_at(track, t_camera_s - offset)
        if panel.trusted.sum() < observability.FEWEST_VIEWS:
            continue
        ended, _ = settled_ends(boards, panel.H, panel.trusted)
        agreed = _agreed(ended, panel, options)
        turned, agreed = _turned_back(ended, panel, agreed)
        score = agreed.scatter_m * len(t_camera_s) / panel.trusted.sum()
        if best is None or score < best[0]:
            state = _state(turned, panel, agreed, offset, camera, options, clock=options.clock_offset_s is None)
            best = score, replace(state, track=track), agreed
    if not offsets:
        raise DegenerateError(
            "no clock offset at which a third of the views fall into steady stretches of the recording",
            needed="a body that is tracked through most of the images",
            todo="look at: lpcal check; or state the offset: mocap.clock_offset",
        )
    if best is None:
        raise DegenerateError(
            f"{int(poses_at(track, t_camera_s - offsets[0]).trusted.sum())} views with a trusted panel pose",
            needed=f"{observability.FEWEST_VIEWS}, better 15",
            todo="record the body during the images, its markers in sight; check the clocks: mocap.clock_offset",
        )
    try:
        _refuse(best[1], best[2])
    except DisagreementError as error:
        raise _by_the_clock(error, boards, track, t_camera_s, options.clock_offset_s) from error
    return best[1]


def _by_the_clock(
    error: DisagreementError, boards: BoardPoses, track: PoseTrack, t_camera_s: Array, stated_s: float | None
) -> DisagreementError:
    """The error of a motion that is not rigid; that of a rate, or of the stated clock offset, where the angles fit at another one only."""
    if stated_s is None and (misread := clocks.misread_rate(track, t_camera_s, boards.H_CB)) is not None:
        return misread.error
    candidates = [] if stated_s is None else clocks.offset_candidates(track, t_camera_s - stated_s, boards.H_CB)
    if stated_s is None or not candidates:
        return error
    best = replace(candidates[0], offset_s=candidates[0].offset_s + stated_s)
    if clocks.fits_as_well(track, t_camera_s, boards.H_CB, stated_s, best):
        return error
    return DisagreementError(
        f"at the stated clock offset of {1e3 * stated_s:.0f} ms {error.found}; the angles say {1e3 * best.offset_s:.0f} ms",
        needed="t_camera = t_mocap + offset",
        todo="write mocap.clock_offset: estimate",
    )


def start_paired(boards: BoardPoses, panel: TrackPoses, camera: Camera | None, options: HandEyeOptions) -> SolveState:
    """The closed form with one panel pose a view. Raises as `start_moving`."""
    boards, _ = settled_ends(boards, panel.H, panel.trusted)
    boards, agreed = _turned_back(boards, panel, _agreed(boards, panel, options))
    state = _state(boards, panel, agreed, 0.0, camera, options, clock=False)
    _refuse(state, agreed)
    return state


def _refuse(state: SolveState, agreed: park.Consensus) -> None:
    """Stop where the data are no rigid motion, with what is wrong."""
    trusted = state.panel.trusted
    of_trusted = replace(agreed, inliers=agreed.inliers[trusted])
    congruence.refuse(state.panel.H[trusted], state.boards.H_CB[trusted], of_trusted, from_images=state.boards.corners_px is not None)


def _agreed(boards: BoardPoses, panel: TrackPoses, options: HandEyeOptions) -> park.Consensus:
    """The closed form on the trusted views, after the refusal of motions that cannot show H_PC; rows are all views."""
    trusted = panel.trusted
    measured = se3.inv(panel.H[trusted]) if options.carries == "board" else panel.H[trusted]
    observability.refuse_what_cannot_show_it(measured)
    found = park.consensus(panel.H[trusted], boards.H_CB[trusted], options.seed)
    observability.refuse_what_cannot_show_it(measured[found.inliers])
    inliers = np.zeros(len(trusted), dtype=bool)
    inliers[trusted] = found.inliers
    angle, distance = park.residuals(panel.H, boards.H_CB, found.H_PC, found.H_OB)
    return replace(found, inliers=inliers, residual_rad=angle, residual_m=distance)


def _turned_back(boards: BoardPoses, panel: TrackPoses, agreed: park.Consensus) -> tuple[BoardPoses, park.Consensus]:
    """The boards, those turned by half a turn that were found by the wrong end, and the closed form with them.

    A board whose pattern does not show its ends may be found by either; only one places it where the other views do.
    """
    if boards.corners_px is None or boards.points_B is None or not agreed.inliers.any():
        return boards, agreed
    turned, wrong, angle, distance = found_by_other_end(boards, panel.H, agreed)
    wrong &= panel.trusted
    if not wrong.any():
        return boards, agreed
    return with_turned(boards, turned, wrong), replace(
        agreed,
        inliers=agreed.inliers | wrong,
        residual_rad=np.where(wrong, angle, agreed.residual_rad),
        residual_m=np.where(wrong, distance, agreed.residual_m),
    )


def _state(
    boards: BoardPoses,
    panel: TrackPoses,
    agreed: park.Consensus,
    offset: float,
    camera: Camera | None,
    options: HandEyeOptions,
    *,
    clock: bool,
) -> SolveState:
    count = len(boards.H_CB)
    corners, scale = (None, None) if boards.corners_px is None or camera is None else as_pinhole(boards.corners_px, camera)
    return SolveState(
        boards,
        panel,
        agreed.inliers,
        offset,
        clock,
        (agreed.H_PC, agreed.H_OB),
        camera_prior(camera, options.camera_share) if camera is not None and corners is not None else None,
        deflation=np.ones(count),
        corners_px=corners,
        corner_scale=scale,
        board_carried=options.carries == "board",
    )
