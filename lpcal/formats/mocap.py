"""A motion-capture recording of whatever format: found from the file itself, not from its name."""

from __future__ import annotations

from pathlib import Path

from lpcal.errors import InputError
from lpcal.formats import mocap_c3d, mocap_generic, mocap_motive, mocap_qualisys, mocap_ros, mocap_tum, mocap_vicon
from lpcal.formats.marker_table import MarkerTable, markers_of
from lpcal.formats.pose_table import PoseTable, stream_of
from lpcal.records.observations import MarkerStream, PoseStream

KNOWN = "Motive, Vicon or Qualisys text, C3D, a ROS bag, TUM, EuRoC, or a csv of t_s, x_m, y_m, z_m, qx, qy, qz, qw"
HEAD_BYTES = 4096


def read_mocap(
    path: Path, body: str | None = None, *, quaternion: str | None = None, units: str | None = None, direction: str = "H_OP"
) -> PoseStream | MarkerStream:
    """The recorded poses of one body, or its markers where the file holds no poses.

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
    if not path.is_file() and not mocap_ros.is_ros(path, b""):
        raise InputError("no such file", where=str(path), needed="a motion-capture recording", todo="correct mocap.file in panel.yaml")
    table = _table(path, body, quaternion, units)
    return markers_of(table, path, body) if isinstance(table, MarkerTable) else stream_of(table, path, direction)


def _table(path: Path, body: str | None, quaternion: str | None, units: str | None) -> PoseTable | MarkerTable:
    """The file read by the reader whose mark it bears."""
    head = b"" if path.is_dir() else _head(path)
    if mocap_ros.is_ros(path, head):
        return mocap_ros.read_ros(path, body, units)
    if mocap_c3d.is_c3d(head):
        return mocap_c3d.read_c3d(path, units)
    if b"\x00" in head:
        raise InputError("not a text file", where=str(path), needed=KNOWN, todo="export it as one of these")
    text = head.decode("utf-8-sig", errors="replace")
    if not text.strip():
        raise InputError("empty", where=str(path), needed=KNOWN, todo="export the recording again")
    if mocap_motive.is_motive(text):
        return mocap_motive.read_motive(path, body, quaternion, units)
    if mocap_qualisys.is_qualisys(text):
        return mocap_qualisys.read_qualisys(path, body, units)
    if mocap_vicon.is_vicon(text):
        return mocap_vicon.read_vicon(path, body, units)
    if mocap_tum.is_tum(text):
        return mocap_tum.read_tum(path, quaternion, units)
    return mocap_generic.read_generic(path, quaternion, units)


def _head(path: Path) -> bytes:
    with path.open("rb") as stream:
        return stream.read(HEAD_BYTES)
