"""A motion-capture recording of whatever format: found from the file itself, not from its name; others' formats are asked first."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from lpcal.errors import InputError
from lpcal.formats import mocap_c3d, mocap_generic, mocap_motive, mocap_qualisys, mocap_ros, mocap_trc, mocap_tum, mocap_vicon
from lpcal.formats.marker_table import MarkerTable, markers_of
from lpcal.formats.mocap_added import MocapFormat, format_of, of_packages
from lpcal.formats.named_files import did_you_mean
from lpcal.formats.pose_table import PoseTable, stream_of
from lpcal.formats.reading import reader, reading
from lpcal.formats.text import decimal_points, read_text, with_commas
from lpcal.geometry import se3
from lpcal.records import given
from lpcal.records.observations import MarkerStream, PoseStream

KNOWN = "Motive, Vicon or Qualisys text, TRC, C3D, a ROS bag, TUM, EuRoC, or a csv of t_s, x_m, y_m, z_m, qx, qy, qz, qw"
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
    of_packages()  # before the memory is bounded: what packages load is not what the file asks for
    return _read(path, body, quaternion, units, direction)


@reader("a whole motion-capture recording")
def _read(path: Path, body: str | None, quaternion: str | None, units: str | None, direction: str) -> PoseStream | MarkerStream:
    if not path.is_file() and not mocap_ros.is_ros(path, b"") and not (path.is_dir() and format_of(b"", path)):
        todo = did_you_mean(path, "correct mocap.file in panel.yaml")
        raise InputError("no such file", where=str(path), needed="a motion-capture recording", todo=todo)
    head = b"" if path.is_dir() else _head(path)
    if (added := format_of(head, path)) is not None:
        if quaternion or units:
            what = "units" if units else "quaternion"
            todo = f"leave mocap.{what} out, or correct the format"
            raise InputError(
                f"mocap.{what} says nothing to the format {added.name}", where=str(path), needed="metres, as it reads", todo=todo
            )
        return _by(added, path, body, direction)
    name, table = _table(path, head, body, quaternion, units)
    found = markers_of(table, path, body) if isinstance(table, MarkerTable) else stream_of(table, path, direction)
    return replace(found, format=name)


def _table(path: Path, head: bytes, body: str | None, quaternion: str | None, units: str | None) -> tuple[str, PoseTable | MarkerTable]:
    """The format whose mark the file bears, and the file as its reader reads it."""
    if mocap_ros.is_ros(path, head):
        return "ROS bag", mocap_ros.read_ros(path, body, units)
    if mocap_c3d.is_c3d(head):
        return "C3D", mocap_c3d.read_c3d(path, units)
    for mark, found in OTHER_FILES.items():
        if head.startswith(mark):
            what, _, todo = found.partition("; ")
            raise InputError(what, where=str(path), needed=KNOWN, todo=todo)
    text = read_text(path, KNOWN)
    if not text.strip():
        raise InputError("empty", where=str(path), needed=KNOWN, todo="export the recording again")
    refuse_other_systems(text, path)
    if mocap_qualisys.is_qualisys(text):
        return "Qualisys tsv", mocap_qualisys.read_qualisys(decimal_points(text), path, body, units)
    if mocap_trc.is_trc(text):
        return "TRC", mocap_trc.read_trc(decimal_points(text), path, units)
    if mocap_tum.is_tum(text):
        return "TUM trajectory", mocap_tum.read_tum(decimal_points(text), path, quaternion, units)
    text = with_commas(text, path)
    if mocap_motive.is_motive(text):
        return "Motive csv", mocap_motive.read_motive(text, path, body, quaternion, units)
    if mocap_vicon.is_vicon(text):
        return "Vicon csv", mocap_vicon.read_vicon(text, path, body, units)
    return "csv of poses", mocap_generic.read_generic(text, path, quaternion, units, body)


def _by(added: MocapFormat, path: Path, body: str | None, direction: str) -> PoseStream | MarkerStream:
    """What an added format reads, held to what lpcal's own readers give."""
    with reading(path, f"a whole recording of the format {added.name}"):
        found = added.read(path, body)
    if not isinstance(found, PoseStream | MarkerStream):
        raise InputError(f"the format {added.name} gave a {type(found).__name__}", where=str(path), needed="a PoseStream or a MarkerStream")
    if isinstance(found, MarkerStream):
        return replace(given.markers(found, str(path)), format=added.name)
    stream = given.stream(found, str(path))
    poses = stream.H_OP
    return replace(stream, H_OP=se3.inv(poses) if direction == "H_PO" else poses, format=added.name)


@reader("a csv of poses")
def read_pose_csv(path: Path, quaternion: str | None = None, units: str | None = None) -> PoseTable:
    """The poses of a plain csv, as `read_generic`; of whatever encoding and delimiter."""
    return mocap_generic.read_generic(with_commas(read_text(path, "a csv of poses"), path), path, quaternion, units)


OTHER_SYSTEMS = {
    "HIERARCHY": "a BVH file: it holds joint angles of a skeleton; export rigid bodies as csv",
    "; FBX": "an FBX scene; export rigid bodies as csv or markers as C3D",
    "{": "a JSON document; write t_s, x_m, y_m, z_m, qx, qy, qz, qw as csv",
    "<?xml": "an XML document; export csv, tsv or C3D",
    "<!DOCTYPE": "a web page, not the file; download it again",
    "<html": "a web page, not the file; download it again",
}
"""How other systems' texts begin, and what to export instead."""
OTHER_FILES = {
    b"PK\x03\x04": "a zip archive or an Excel workbook; save it as csv",
    b"\xd0\xcf\x11\xe0": "an old Excel workbook; save it as csv",
    b"Kaydara FBX": "an FBX scene; export rigid bodies as csv or markers as C3D",
    b"\x89HDF": "an HDF5 or MATLAB 7.3 file; export csv",
    b"MATLAB": "a MATLAB file; export csv",
}
"""How other systems' binary files begin, and what to export instead."""


def refuse_other_systems(text: str, path: Path) -> None:
    """Name a text of a kind that is not read.

    Raises
    ------
    InputError
        It is one.
    """
    for mark, found in OTHER_SYSTEMS.items():
        if text.lstrip().startswith(mark):
            what, _, todo = found.partition("; ")
            raise InputError(what, where=str(path), needed=KNOWN, todo=todo)


def _head(path: Path) -> bytes:
    with path.open("rb") as stream:
        return stream.read(HEAD_BYTES)
