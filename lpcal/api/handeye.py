"""Poses of a tracked body and of a board to the hand-eye transforms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from lpcal.api.staged import staged
from lpcal.chain.h_op_body import body_of
from lpcal.chain.h_op_panel import track_of
from lpcal.chain.h_pc_handeye import HandEyeOptions, solve_moving, solve_paired
from lpcal.errors import DisagreementError, InputError
from lpcal.geometry.arrays import Array
from lpcal.records import given
from lpcal.records.calibration import Camera, Carries, HandEye
from lpcal.records.observations import BoardPoses, MarkerStream, PoseStream
from lpcal.records.outcome import Progress, silent

NO_CLOCK = "t_camera_s"
"""The argument that a recording with a clock needs."""


@staged("hand-eye")
def solve_handeye(
    H_OP: PoseStream | MarkerStream | npt.ArrayLike,
    H_CB: BoardPoses | npt.ArrayLike,
    *,
    t_mocap_s: npt.ArrayLike | None = None,
    t_camera_s: npt.ArrayLike | None = None,
    camera: Camera | None = None,
    clock_offset_s: float | None = None,
    carries: Carries | None = None,
    inverted: bool = False,
    camera_share: float = 0.0,
    progress: Progress = silent,
) -> HandEye:
    """Solve for the camera in a tracked body and the board in the room: ``H_OP(t) H_PC H_CB(t) = H_OB``.

    Parameters
    ----------
    H_OP : PoseStream, MarkerStream, or ndarray (N, 4, 4)
        The body (P) in the room (O), metres: a recording with a clock, or poses at `t_mocap_s`; without times one pose a view of H_CB.
    H_CB : BoardPoses, or ndarray (M, 4, 4)
        The static board (B) in the camera (C), metres; of `locate_boards` with its corners, which makes for better sigmas.
    t_mocap_s : ndarray (N,), optional
        Seconds on the mocap's clock, where `H_OP` is an array with times of its own.
    t_camera_s : ndarray (M,), optional
        Seconds on the camera's clock, of the views; needed wherever the body's poses have times.
    camera : Camera, optional
        The camera, where `H_CB` holds corners: its parameters' covariance is taken as a prior and the corners are fitted directly.
    clock_offset_s : float, optional
        ``t_camera = t_mocap + clock_offset_s``, where it is known; else it is estimated.
    carries : str, optional
        What rides on the tracked body, "camera" or "board"; by default what the data say.
    inverted : bool
        Whether the poses came as H_PO and were inverted for this call: it helps to distinguish a fixed camera from a tracked one.
    camera_share : float
        Share of the views, 0 to 1, from which `camera` was solved too: their corners are not counted twice.
    progress : callable, optional
        Called as ``progress(what, done, total)``.

    Returns
    -------
    HandEye
        H_PC and H_OB with their (6, 6) covariances (rotation in radians first, then metres, left perturbation), the clock offset with its
        sigma, what became of each view, and warnings. Where the body carries the board, H_PC holds H_OC and H_OB holds H_PB.

    Raises
    ------
    InputError, DisagreementError
        Arrays of another shape, transforms that are not rigid, times that are lacking; clocks that do not meet.
    DegenerateError
        Too few views, or turns about one axis only.
    ConvergenceError
        Most views do not fit one rigid camera.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> session = lpcal.simulate_rig(lpcal.read_rig("robot-camera"), seed=3)
    >>> truth = session.board_truth()
    >>> found = lpcal.solve_handeye(truth.H_OP, truth.H_CB)
    >>> bool(np.linalg.norm(found.H_PC[:3, 3] - session.H_PC[:3, 3]) < 1e-4)
    True
    """
    boards = boards_of(H_CB, t_camera_s)
    options = HandEyeOptions(clock_offset_s, camera_share, inverted=inverted, carries=carries)
    lens = camera if boards.corners_px is not None else None
    progress("hand-eye", 0, 1)
    stream = stream_of(H_OP, t_mocap_s)
    if stream is not None:
        if boards.t_camera_s is None:
            raise InputError("none are given", where=NO_CLOCK, needed="the views' times: the body's poses have times")
        found = solve_moving(boards, track_of(stream), lens, options)
    else:
        assert not isinstance(H_OP, PoseStream | MarkerStream)
        poses = given.transforms(H_OP, "H_OP")
        refuse_unpaired(poses, boards)
        found = solve_paired(boards, poses, lens, options)
    progress("hand-eye", 1, 1)
    return found.handeye


def stream_of(H_OP: PoseStream | MarkerStream | npt.ArrayLike, t_mocap_s: npt.ArrayLike | None) -> PoseStream | None:
    """The body's poses as a recording; None where they have no times."""
    if isinstance(H_OP, MarkerStream):
        return body_of(H_OP, None)
    if isinstance(H_OP, PoseStream):
        return given.stream(H_OP, "H_OP")
    if t_mocap_s is None:
        return None
    poses = given.transforms(H_OP, "H_OP")
    t_s = given.times(t_mocap_s, len(poses), "t_mocap_s", "H_OP")
    return given.stream(PoseStream("", t_s, poses, np.full(len(poses), np.nan)), "H_OP")


def boards_of(H_CB: BoardPoses | npt.ArrayLike, t_camera_s: npt.ArrayLike | None) -> BoardPoses:
    """The board's poses as a record, with the times that are given."""
    if isinstance(H_CB, BoardPoses):
        boards = H_CB
    else:
        poses = given.transforms(H_CB, "H_CB")
        boards = BoardPoses(tuple(f"view {k}" for k in range(len(poses))), None, poses)
    if t_camera_s is None:
        return boards
    return replace(boards, t_camera_s=given.times(t_camera_s, len(boards.images), "t_camera_s", "H_CB"))


def refuse_unpaired(H_OP: Array, boards: BoardPoses) -> None:
    """Poses without times must be one a view."""
    if len(H_OP) != len(boards.images):
        raise DisagreementError(
            f"{len(H_OP)} poses of the body and {len(boards.images)} of the board",
            where="H_OP, H_CB",
            needed="one pair a view",
            todo="give both lists in one order, or times: t_mocap_s, t_camera_s",
        )
    if boards.t_camera_s is not None:
        raise InputError(
            "none are given", where="t_mocap_s", needed="the body's times: the views have times", todo="leave both out, or give both"
        )
