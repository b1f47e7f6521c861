"""Where a capture was taken: from a tracked body's recording, or from a pose that somebody states."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from lpcal.api.staged import staged
from lpcal.chain.h_oc_capture import BodyAt, carried_camera, fixed_camera, stated_camera
from lpcal.chain.h_op_body import body_of
from lpcal.chain.h_op_panel import track_of
from lpcal.errors import DegenerateError, InputError, UsageError
from lpcal.geometry.arrays import Array
from lpcal.geometry.pose_track import TrackPoses, poses_at
from lpcal.records import given
from lpcal.records.calibration import Calibration
from lpcal.records.observations import MarkerStream, PoseStream
from lpcal.records.placement import POSE_STD, Placement, RoomTracking

NOT_MEASURED = RoomTracking(np.zeros((6, 6)))
"""What is taken where nothing is known of the tracking: the transform that a calibration holds as exact, clocks that agree."""
NOISE_UNKNOWN = "the calibration does not say how well H_PC and the tracked poses are known: taken as {} mm and {} deg, H_PC as exact"


@staged("placement")
def place(
    calibration: Calibration,
    poses: PoseStream | MarkerStream | None = None,
    t_camera_s: float | None = None,
    *,
    object_poses: PoseStream | MarkerStream | None = None,
    H_OP: npt.ArrayLike | None = None,
    H_OC: npt.ArrayLike | None = None,
    tolerance: tuple[float, float] | None = None,
    clock_offset_s: float | None = None,
) -> Placement:
    """Place a capture in the room, or in the tracked body that its object rides on.

    Parameters
    ----------
    calibration : Calibration
        Holds H_PC, and how well it, the clocks and the tracked poses are known.
    poses : PoseStream, optional
        The recording of the body that carries the camera.
    t_camera_s : float, optional
        When the capture was taken, seconds on the camera's clock.
    object_poses : PoseStream, optional
        The recording of the body that the object rides on, on the same clock: the capture is then placed in that body.
    H_OP, H_OC : ndarray (4, 4), optional
        The body, or the camera itself, in the room, metres, where no recording gives it.
    tolerance : (float, float), optional
        One sigma of that pose, an axis: metres, radians.
    clock_offset_s : float, optional
        ``t_camera = t_mocap + clock_offset_s`` of this recording, where it is another than the calibration's.

    Returns
    -------
    Placement
        The camera in the room or in the body, with its covariance: of the poses' noise, of H_PC and of the clock.

    Raises
    ------
    InputError, UsageError
        The calibration holds no H_PC; nothing that gives a place, or too much; a matrix that is not rigid.
    DegenerateError
        The recording holds no pose to trust at that time.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> stream = lpcal.PoseStream("cart", np.arange(300) / 100, np.tile(np.eye(4), (300, 1, 1)), np.full(300, np.nan))
    >>> placement = lpcal.place(lpcal.Calibration("arm", (), H_PC=np.eye(4)), stream, 1.5)
    >>> placement.name, placement.H_AC[:3, 3].tolist()
    ('H_OC', [0.0, 0.0, 0.0])
    """
    given_ways = [one is not None for one in (poses, H_OP, H_OC)]
    if sum(given_ways) > 1:
        raise UsageError("more than one of poses, H_OP and H_OC", where="place", needed="one that says where the camera was")
    if object_poses is not None and (H_OP is not None or H_OC is not None):
        raise UsageError("object_poses with a stated pose", where="place", needed="poses: both bodies in one recording")
    if H_OC is not None:
        found = stated_camera(given.transforms(np.asarray(H_OC)[None], "H_OC")[0], *(tolerance or POSE_STD))
        return replace(found, t_camera_s=t_camera_s, source="the camera's pose, as stated")
    if calibration.H_PC is None:
        raise InputError(
            "holds no H_PC", where=f"calibration {calibration.name}", needed="the camera in the tracked body", todo="run lpcal handeye"
        )
    tracking = calibration.tracking or NOT_MEASURED
    if clock_offset_s is not None:
        tracking = replace(tracking, clock_offset_s=clock_offset_s, clock_drift_ppm=0.0)
    notes = () if calibration.tracking is not None else (NOISE_UNKNOWN.format(1e3 * POSE_STD[0], round(np.degrees(POSE_STD[1]), 3)),)
    if H_OP is not None:
        sigmas = tolerance or tracking.sigmas(steady=True)
        body = BodyAt.stated(given.transforms(np.asarray(H_OP)[None], "H_OP")[0], *sigmas)
        found = carried_camera(body, calibration.H_PC, tracking)
        return replace(found, t_camera_s=t_camera_s, source="the panel's pose, as stated", notes=notes)
    return replace(_tracked(calibration, poses, t_camera_s, object_poses, tracking), notes=notes)


def _tracked(
    calibration: Calibration,
    poses: PoseStream | MarkerStream | None,
    t_camera_s: float | None,
    object_poses: PoseStream | MarkerStream | None,
    tracking: RoomTracking,
) -> Placement:
    """The camera by what recordings say."""
    known = calibration.H_PC
    assert known is not None
    still = calibration.carries == "board"
    if still and object_poses is None:
        return replace(fixed_camera(known, tracking), t_camera_s=t_camera_s, source="the camera stands still in the room")
    if t_camera_s is None:
        raise InputError("no time", where="t_camera_s", needed="when the capture was taken, seconds on the camera's clock")
    t_s = tracking.mocap_times(np.array([t_camera_s]))
    carrier, moving = (None, "") if object_poses is None else _at(object_poses, t_s, tracking)
    body = None if object_poses is None else object_poses.body
    if still:
        found = fixed_camera(known, tracking, carrier, body)
        return replace(found, t_camera_s=t_camera_s, source=f"{body} at {t_s[0]:.3f} s of the recording{moving}")
    if poses is None:
        raise InputError("no recording", where="poses", needed="the recording of the body that carries the camera, or H_OP, or H_OC")
    panel, of_panel = _at(poses, t_s, tracking)
    source = f"{poses.body or 'the panel'} at {t_s[0]:.3f} s of the recording{of_panel or moving}"
    return replace(carried_camera(panel, known, tracking, carrier, body), t_camera_s=t_camera_s, source=source)


def _at(poses: PoseStream | MarkerStream, t_s: Array, tracking: RoomTracking) -> tuple[BodyAt, str]:
    """A body at a time (1,) of its recording, and whether it moved then, in words."""
    stream = body_of(poses) if isinstance(poses, MarkerStream) else given.stream(poses, "poses")
    found: TrackPoses = poses_at(track_of(stream), t_s)
    if found.why[0] is not None:
        raise DegenerateError(
            f"no pose of {stream.body or 'the body'} to trust: {found.why[0]}",
            where=f"{t_s[0]:.3f} s of the recording ({stream.t_s[0]:.3f} to {stream.t_s[-1]:.3f} s)",
            needed="a body that is seen while the capture is taken",
            todo="is the time on the camera's clock, and the recording that of the capture?",
        )
    return BodyAt.measured(found, 0, tracking), "" if found.steady[0] else ", moving"
