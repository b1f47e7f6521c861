"""H_PC, H_OB and the clock offset from board poses in the camera and panel poses in mocap, from start to covariance.

The order: trusted panel poses; the offset from relative angles, the likeliest candidates tried with the closed form among outliers;
refusal where the motion cannot show H_PC; the maximum-likelihood problem, its clock relinearised and its sigmas re-estimated until both
settle; views that miss the rest beyond their noise left out and named; the covariance, made larger where neighbours share errors.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from lpcal.chain.h_pc_handeye import clock as clocks
from lpcal.chain.h_pc_handeye import congruence, observability, variance
from lpcal.chain.h_pc_handeye.camera_part import as_pinhole, camera_prior, turned_by_half
from lpcal.chain.h_pc_handeye.likelihood import CameraPrior, Estimate, Sigmas, Views, estimate, misfit
from lpcal.errors import ConvergenceError, DegenerateError
from lpcal.geometry import park, se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.least_squares import Options as LeastSquaresOptions
from lpcal.geometry.pose_track import PoseTrack, TrackPoses, poses_at
from lpcal.records.calibration import Camera, HandEye, ViewVerdict
from lpcal.records.observations import BoardPoses

ROUNDS = 25
SETTLED = 0.01
"""Relative change of every sigma at which the estimate counts as settled."""
SETTLED_S = 2e-6
HASTE = LeastSquaresOptions(iterations=3, strict=False)
"""Of the solves between which the sigmas still change."""
FEWEST_OF_A_CLASS = 6
OUTLIER_CHI2 = 33.0
"""Of six degrees of freedom: one of a hundred thousand sound views."""
CORNER_SIGMAS = 6.0
READMIT = 5.0
CLOCK_UNSEEN_S = 0.02
"""An offset less certain than this is not one that the data show."""
MOST_BAD = 0.5


@dataclass(frozen=True)
class Options:
    """What is known beforehand."""

    clock_offset_s: float | None = None
    """None: to be estimated."""
    camera_share: float = 0.0
    """Share of the views that the camera was solved from too, whose corners its prior has counted already."""
    seed: int = 0


@dataclass(frozen=True)
class HandEyeFinding:
    """The record, and the panel pose that each of the asked views got."""

    handeye: HandEye
    panel: TrackPoses
    offset_s: float
    """The clock offset at which they were taken, known or not."""


@dataclass(frozen=True)
class _State:
    """The solve in progress. Row k of arrays is one of the boards' views."""

    boards: BoardPoses
    panel: TrackPoses
    inliers: Mask
    offset_s: float
    clock: bool
    start: tuple[Array, Array]
    camera: CameraPrior | None
    sigmas: Sigmas = field(default_factory=Sigmas)
    deflation: Array = field(default_factory=lambda: np.zeros(0))
    found: Estimate | None = None
    corners_px: Array | None = None
    corner_scale: Array | None = None
    """(N, M) by how much a pixel's error grew on the way to the pinhole of the likelihood; None: not at all."""
    track: PoseTrack | None = None

    def views(self) -> Views:
        """The inliers, as the likelihood takes them."""
        steady = self.panel.steady
        both = min(np.sum(steady[self.inliers]), np.sum(~steady[self.inliers])) >= FEWEST_OF_A_CLASS
        noise_class = steady.astype(np.intp) if both else np.zeros(len(steady), dtype=np.intp)
        whole = Views(
            self.boards.H_CB,
            self.panel.H,
            self.panel.velocity,
            noise_class,
            self.deflation,
            self.corners_px,
            self.boards.points_B,
            self.corner_scale,
        )
        return whole.of(self.inliers)


def solve_moving(boards: BoardPoses, track: PoseTrack, camera: Camera | None, options: Options) -> HandEyeFinding:
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
    t_camera_s = np.asarray(boards.t_camera_s)
    state = _start(boards, track, t_camera_s, camera, options)
    state = _refine(state, t_camera_s)
    warnings: list[str] = []
    if options.clock_offset_s is None and not state.clock:
        warnings.append("the panel stood still in every view that was used: the data do not show the clock offset, it is left out")
    return _finding(state, t_camera_s, warnings, options.clock_offset_s)


def solve_paired(boards: BoardPoses, H_OP: Array, camera: Camera | None, options: Options) -> HandEyeFinding:
    """Hand-eye from one panel pose a view, H_OP (N, 4, 4), no clock. Raises as `solve_moving`."""
    count = len(H_OP)
    panel = TrackPoses(np.full(count, np.nan), H_OP, np.zeros((count, 6)), (None,) * count, np.zeros(count, dtype=bool))
    boards, agreed = _turned_back(boards, panel, _agreed(boards, panel, options.seed))
    state = _state(boards, panel, agreed, 0.0, camera, options, clock=False)
    _refuse(state, agreed)
    return _finding(_refine(state, None), None, [], None)


def _start(boards: BoardPoses, track: PoseTrack, t_camera_s: Array, camera: Camera | None, options: Options) -> _State:
    """The closed form at each likely offset; the one of least scatter."""
    if options.clock_offset_s is not None:
        offsets = [options.clock_offset_s]
    else:
        offsets = [candidate.offset_s for candidate in clocks.offset_candidates(track, t_camera_s, boards.H_CB)]
    best: tuple[float, _State, park.Consensus] | None = None
    for offset in offsets:
        panel = poses_at(track, t_camera_s - offset)
        if panel.trusted.sum() < observability.FEWEST_VIEWS:
            continue
        agreed = _agreed(boards, panel, options.seed)
        turned, agreed = _turned_back(boards, panel, agreed)
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
    _refuse(best[1], best[2])
    return best[1]


def _refuse(state: _State, agreed: park.Consensus) -> None:
    """Stop where the data are no rigid motion, with what is wrong."""
    trusted = state.panel.trusted
    of_trusted = replace(agreed, inliers=agreed.inliers[trusted])
    congruence.refuse(state.panel.H[trusted], state.boards.H_CB[trusted], of_trusted, from_images=state.boards.corners_px is not None)


def _agreed(boards: BoardPoses, panel: TrackPoses, seed: int) -> park.Consensus:
    """The closed form on the trusted views, after the refusal of motions that cannot show H_PC; rows are all views."""
    trusted = panel.trusted
    observability.refuse_what_cannot_show_it(panel.H[trusted])
    found = park.consensus(panel.H[trusted], boards.H_CB[trusted], seed)
    inliers = np.zeros(len(trusted), dtype=bool)
    inliers[trusted] = found.inliers
    angle, distance = park.residuals(panel.H, boards.H_CB, found.H_PC, found.H_OB)
    return replace(found, inliers=inliers, residual_rad=angle, residual_m=distance)


def _turned_back(boards: BoardPoses, panel: TrackPoses, agreed: park.Consensus) -> tuple[BoardPoses, park.Consensus]:
    """The boards, those turned by half a turn that were found by the wrong end, and the closed form with them.

    A board whose pattern does not tell its ends may be found by either; only one places it where the other views do.
    """
    if boards.corners_px is None or boards.points_B is None or not agreed.inliers.any():
        return boards, agreed
    turned = turned_by_half(boards)
    angle, distance = park.residuals(panel.H, turned.H_CB, agreed.H_PC, agreed.H_OB)
    fits = (angle <= READMIT * agreed.residual_rad[agreed.inliers].max()) & (distance <= READMIT * agreed.residual_m[agreed.inliers].max())
    wrong = panel.trusted & ~agreed.inliers & fits & (angle < 0.2 * agreed.residual_rad)
    if not wrong.any():
        return boards, agreed
    H_CB = np.where(wrong[:, None, None], turned.H_CB, boards.H_CB)
    corners = np.where(wrong[:, None, None], np.asarray(turned.corners_px), boards.corners_px)
    return replace(boards, H_CB=H_CB, corners_px=corners), replace(
        agreed,
        inliers=agreed.inliers | wrong,
        residual_rad=np.where(wrong, angle, agreed.residual_rad),
        residual_m=np.where(wrong, distance, agreed.residual_m),
    )


def _state(
    boards: BoardPoses, panel: TrackPoses, agreed: park.Consensus, offset: float, camera: Camera | None, options: Options, *, clock: bool
) -> _State:
    count = len(boards.H_CB)
    corners, scale = (None, None) if boards.corners_px is None or camera is None else as_pinhole(boards.corners_px, camera)
    return _State(
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
    )


def _refine(state: _State, t_camera_s: Array | None) -> _State:
    """Settle with the closed form's inliers, choose the views anew, settle again with their shared errors counted."""
    state = _settle(state, t_camera_s)
    for _ in range(4):
        chosen, corners = _choose(state)
        same = np.array_equal(chosen, state.inliers) and corners is state.corners_px
        state = replace(state, inliers=chosen, corners_px=corners)
        if not same:
            state = _settle(state, t_camera_s)
        factor = np.ones(len(chosen))
        if t_camera_s is not None:
            factor[chosen] = variance.deflation(state.views(), _estimate(state), state.sigmas, t_camera_s[chosen])
        moved = np.max(np.abs(factor / state.deflation - 1))
        if same and moved < 0.1:
            break
        state = _settle(replace(state, deflation=factor), t_camera_s)
    return state


def _settle(state: _State, t_camera_s: Array | None) -> _State:
    """Solve at given sigmas, relinearise the clock, re-estimate the sigmas, until all of it stands still."""
    for _ in range(ROUNDS):
        views = state.views()
        if state.clock and not np.any(views.velocity):
            state = replace(state, clock=False)
        found = estimate(views, state.camera, state.sigmas, state.found or state.start, clock=state.clock, options=HASTE)
        sigmas = variance.components(views, found, state.sigmas)
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


def _clock_unseen(found: Estimate) -> bool:
    """Whether the views leave the offset open: the panel stood still in all of them."""
    try:
        return bool(np.sqrt(found.covariance()[12, 12]) > CLOCK_UNSEEN_S)
    except DegenerateError:
        return True


def _estimate(state: _State) -> Estimate:
    if state.found is None:
        raise ConvergenceError("the hand-eye solve has not run", needed="a solve")
    return state.found


def _choose(state: _State) -> tuple[Mask, Array | None]:
    """Views whose mocap pose fits within its noise, and the corners without gross ones."""
    found, views = _estimate(state), state.views()
    kind = "mocap" if state.camera is not None else "board"
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
    chosen |= state.panel.trusted & ~state.inliers & (angle < 0.7 * limit_rad) & (distance < 0.7 * limit_m)
    if chosen.sum() < observability.FEWEST_VIEWS:
        raise DegenerateError(
            f"{int(chosen.sum())} of {len(chosen)} views agree", needed="a majority of one rigid camera", todo="look at: lpcal check"
        )
    return chosen, _without_gross_corners(state, found)


def _without_gross_corners(state: _State, found: Estimate) -> Array | None:
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


def _finding(state: _State, t_camera_s: Array | None, warnings: list[str], known_offset_s: float | None) -> HandEyeFinding:
    found, views = _estimate(state), state.views()
    spread, more = observability.refuse_what_cannot_show_it(views.H_OP)
    factor = variance.block_factor(views, found, None if t_camera_s is None else t_camera_s[state.inliers])
    covariance = found.covariance() * factor
    bad = float(np.mean(~state.inliers[state.panel.trusted]))
    if bad > MOST_BAD:
        raise ConvergenceError(
            f"{100 * bad:.0f} % of the views do not fit one rigid camera", needed="a majority that does", todo="look at: lpcal check"
        )
    size = congruence.board_size_warning(views.H_OP, views.H_CB, found.H_PC[:3, :3])
    roles = congruence.swapped_roles_warning(found.H_PC, found.H_OB)
    warnings += [each for each in (size, roles) if each is not None]
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
        warnings=(*warnings, *more),
        evidence=_evidence(state, found, spread, factor),
    )
    return HandEyeFinding(handeye, state.panel, state.offset_s)


def _verdicts(state: _State, found: Estimate) -> tuple[ViewVerdict, ...]:
    whole = Views(state.boards.H_CB, state.panel.H, state.panel.velocity, np.zeros(0, dtype=np.intp), np.zeros(0))
    angle, distance = misfit(whole, found)
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
            why = f"its mocap pose misses the others by {np.degrees(angle[k]):.2f} deg, {1e3 * distance[k]:.1f} mm"
        seen = why is None or used or state.panel.why[k] is None
        verdicts.append(
            ViewVerdict(
                image,
                used,
                None if used else why,
                residual_px=float(px[k]) if np.isfinite(px[k]) else None,
                residual_m=float(distance[k]) if seen else None,
                residual_rad=float(angle[k]) if seen else None,
            )
        )
    return tuple(verdicts)


def _evidence(state: _State, found: Estimate, spread: observability.Spread, factor: float) -> dict[str, object]:
    s = state.sigmas
    group = int(state.views().noise_class.max())
    evidence: dict[str, object] = {
        "views_used": int(state.inliers.sum()),
        "rotation_spread_deg": np.degrees(spread.sigma_rad),
        "mocap_sigma_deg": np.degrees(s.mocap_rad[0]),
        "mocap_sigma_m": s.mocap_m[0],
        "closed_form_H_PC": state.start[0],
        "covariance_factor_of_shared_errors": factor,
        "views_that_share_an_error": float(np.median(state.deflation[state.inliers])),
    }
    if group:
        evidence |= {"mocap_sigma_dwell_deg": np.degrees(s.mocap_rad[1]), "mocap_sigma_dwell_m": s.mocap_m[1]}
    if state.camera is not None:
        evidence |= {"corner_sigma_px": s.px, "camera_as_refined_here": found.camera, "camera_moved": found.camera - state.camera.mean}
    else:
        evidence |= {"board_sigma_deg": np.degrees(s.board_rad), "board_sigma_m": [s.board_lateral_m, s.board_lateral_m, s.board_depth_m]}
    difference = found.H_PC @ se3.inv(state.start[0])
    evidence["moved_from_closed_form_deg"] = float(np.degrees(se3.angle_rad(difference[:3, :3])))
    evidence["moved_from_closed_form_m"] = float(np.linalg.norm(found.H_PC[:3, 3] - state.start[0][:3, 3]))
    return evidence
