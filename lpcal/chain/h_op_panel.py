"""H_OP at any time: the tracked body's stream as a track that can be asked for a pose at a time.

The mathematics is `lpcal.geometry.pose_track`: samples that tracking got wrong are left out, poses are interpolated within runs. Poses
made of markers come with a covariance C of the left perturbation; the error of the origin t_OP is its ``rho + phi x t_OP``.
"""

from __future__ import annotations

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry import pose_track, se3
from lpcal.geometry.arrays import Array
from lpcal.records.observations import PoseStream


def track_of(stream: PoseStream) -> pose_track.PoseTrack:
    """The trusted samples of a stream, H_OP, cut into runs without a gap or a jump.

    Raises
    ------
    DegenerateError
        No sample can be trusted.
    """
    variance = None if stream.covariance is None else _over_the_usual(stream.covariance, stream.H_OP)
    track = pose_track.clean(stream.t_s, stream.H_OP, stream.error_m, variance)
    if not len(track.t_s):
        why = ", ".join(f"{count} {reason}" for reason, count in track.dropped.items() if count)
        raise DegenerateError(
            f"none of the {len(stream.t_s)} poses of {stream.body or 'the body'} can be trusted{': ' * bool(why)}{why}",
            needed="a recording of some seconds in which the body moves as a panel can",
            todo="look at the recording: are its markers, its units and its rate right?",
        )
    return track


def _over_the_usual(covariance: Array, H_OP: Array) -> Array:
    """Variances (N, 6) of rotation and origin along the axes of O, each over its median."""
    T = se3.turn_and_origin_jacobian(H_OP)
    variance = np.einsum("nij,njk,nik->ni", T, covariance, T)
    usual = [float(np.median(variance[:, part].mean(axis=1))) for part in (slice(0, 3), slice(3, 6))]
    return np.asarray(variance / np.repeat(usual, 3))
