"""A motion-capture recording of whatever format: found from the file itself, not from its name."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from lpcal.errors import InputError
from lpcal.formats import mocap_generic, mocap_motive, mocap_tum
from lpcal.formats.pose_table import stream_of
from lpcal.records.observations import PoseStream

KNOWN = "Motive CSV, TUM, or a csv of t_s, x_m, y_m, z_m, qx, qy, qz, qw"
HEAD_BYTES = 4096
OTHERS: dict[str, Callable[[bytes], bool]] = {
    "C3D": lambda head: head[1:2] == b"\x50" and head[:1] < b"\x20",
    "a ROS bag": lambda head: head.startswith((b"#ROSBAG", b"\x89MCAP", b"SQLite format 3")),
    "Qualisys TSV": lambda head: head.startswith((b"NO_OF_FRAMES", b"\xef\xbb\xbfNO_OF_FRAMES")),
    "Vicon CSV": lambda head: (
        head.lstrip(b"\xef\xbb\xbf").split(b",")[0].split(b"\n")[0].strip() in {b"Trajectories", b"Objects", b"Segments"}
    ),
}


def read_mocap(
    path: Path, body: str | None = None, *, quaternion: str | None = None, units: str | None = None, direction: str = "H_OP"
) -> PoseStream:
    """The recorded poses of one body.

    Parameters
    ----------
    path : the recording
    body : the body's name; may be None where the file holds one
    quaternion, units : xyzw | wxyz, m | cm | mm, where the file does not say
    direction : H_OP | H_PO, what the file holds

    Raises
    ------
    InputError
        Not there, of no known format, or a line that cannot be read.
    DisagreementError
        It does not hold the body.
    DegenerateError
        It holds no pose.
    """
    if not path.is_file():
        raise InputError("no such file", where=str(path), needed="a motion-capture recording", todo="correct mocap.file in panel.yaml")
    with path.open("rb") as stream:
        head = stream.read(HEAD_BYTES)
    for name, matches in OTHERS.items():
        if matches(head):
            raise InputError(f"{name}, which lpcal does not read yet", where=str(path), needed=KNOWN, todo="export it as one of these")
    if b"\x00" in head:
        raise InputError("not a text file", where=str(path), needed=KNOWN, todo="export it as one of these")
    text = head.decode("utf-8-sig", errors="replace")
    if not text.strip():
        raise InputError("empty", where=str(path), needed=KNOWN, todo="export the recording again")
    if mocap_motive.is_motive(text):
        table = mocap_motive.read_motive(path, body, quaternion, units)
    elif mocap_tum.is_tum(text):
        table = mocap_tum.read_tum(path, quaternion, units)
    else:
        table = mocap_generic.read_generic(path, quaternion, units)
    return stream_of(table, path, direction)
