"""H_OP at any time: the tracked body's stream as a track that can be asked for a pose at a time.

The mathematics is `lpcal.geometry.pose_track`: samples that tracking got wrong are left out, poses are interpolated within runs.
"""

from __future__ import annotations

from lpcal.geometry import pose_track
from lpcal.records.observations import PoseStream


def track_of(stream: PoseStream) -> pose_track.PoseTrack:
    """The trusted samples of a stream, H_OP, cut into runs without a gap or a jump."""
    return pose_track.clean(stream.t_s, stream.H_OP, stream.error_m)
