"""Where the hand-eye solve starts: trusted panel poses, the likeliest clock offset, the closed form among outliers.

Refuses where the motion cannot show H_PC, or body and camera do not move as one; turns boards back that were found by their other end.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.chain.h_pc_handeye import clock as clocks
from lpcal.chain.h_pc_handeye import congruence, observability
from lpcal.chain.h_pc_handeye.camera_part import as_pinhole, camera_prior
from lpcal.chain.h_pc_handeye.ends import found_by_other_end, settled_ends, with_turned
from lpcal.chain.h_pc_handeye.state import HandEyeOptions, SolveState
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import park, se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.pose_track import PoseTrack, TrackPoses, poses_at
from lpcal.records.calibration import Camera
from lpcal.records.observations import BoardPoses

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
    """The error of a motion that is not rigid, or that of the stated clock offset where the angles fit at another one only."""
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

    A board whose pattern does not tell its ends may be found by either; only one places it where the other views do.
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
