"""ROS 1 bag, ROS 2 bag (db3 or mcap; the file or its folder): PoseStamped, TransformStamped, Odometry, tf. Time is the header's stamp.

The body is a topic (``/vrpn/panel/pose``, or its part ``panel``) or, in tf, a child frame; its parent is taken as the room. The time at
which the bag got a message is not used. Read with rosbags. Source: the ROS message definitions.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import DegenerateError, InputError
from lpcal.formats.body_choice import choose_body
from lpcal.formats.pose_table import PoseTable

MAGIC = (b"#ROSBAG", b"\x89MCAP", b"SQLite format 3")
KINDS = {
    "geometry_msgs/msg/PoseStamped": lambda message: message.pose,
    "geometry_msgs/msg/PoseWithCovarianceStamped": lambda message: message.pose.pose,
    "nav_msgs/msg/Odometry": lambda message: message.pose.pose,
    "geometry_msgs/msg/TransformStamped": lambda message: message.transform,
}
TF = "tf2_msgs/msg/TFMessage"
FEWEST = 3
"""Poses of a body that moves; a static transform is no body."""


def is_ros(path: Path, head: bytes) -> bool:
    """Whether a file, or a folder, is a recording of ROS."""
    return (path / "metadata.yaml").is_file() if path.is_dir() else head.startswith(MAGIC)


def read_ros(path: Path, body: str | None, units: str | None = None) -> PoseTable:
    """The poses of one body.

    Raises
    ------
    InputError
        The package rosbags is not there, the bag is cut off, several bodies and none named.
    DisagreementError
        The named body is not in it.
    DegenerateError
        It holds no poses.
    """
    poses = _poses(path)
    bodies = {name: rows for name, rows in poses.items() if len(rows) >= FEWEST}
    if not bodies:
        raise DegenerateError("no topic with poses", where=str(path), needed=", ".join([*KINDS, TF]))
    name = choose_body(list(bodies), body, path, lambda name: (name.strip("/"), *name.split("/")))
    rows = np.array(bodies[name])
    t_s = rows[:, 0] + 1e-9 * rows[:, 1]
    return PoseTable(name, t_s, rows[:, 2:5], None, rows[:, 5:], units or "m")


def _poses(path: Path) -> dict[str, list[tuple[float, ...]]]:
    """Seconds, nanoseconds, x, y, z, qx, qy, qz, qw of every body."""
    with _errors(path):
        found: dict[str, list[tuple[float, ...]]] = {}
        for topic, kind, message in _messages(path):
            if kind == TF:
                for each in message.transforms:
                    found.setdefault(each.child_frame_id.lstrip("/"), []).append(_row(each.header.stamp, each.transform))
            else:
                found.setdefault(topic, []).append(_row(message.header.stamp, KINDS[kind](message)))
        return found


def _messages(path: Path) -> Iterator[tuple[str, str, Any]]:
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore

    with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
        wanted = [connection for connection in reader.connections if connection.msgtype in {*KINDS, TF}]
        for connection, _, raw in reader.messages(connections=wanted) if wanted else ():
            yield connection.topic, connection.msgtype, reader.deserialize(raw, connection.msgtype)


def _row(stamp: Any, pose: Any) -> tuple[float, ...]:
    x = pose.position if hasattr(pose, "position") else pose.translation
    q = pose.orientation if hasattr(pose, "orientation") else pose.rotation
    return (float(stamp.sec), float(stamp.nanosec), x.x, x.y, x.z, q.x, q.y, q.z, q.w)


@contextlib.contextmanager
def _errors(path: Path) -> Iterator[None]:
    """What rosbags, or its absence, raises, as the house's error."""
    try:
        yield
    except ImportError as error:
        raise InputError(
            "a recording of ROS, and the package rosbags is not there", where=str(path), needed="rosbags", todo="pip install lpcal[ros]"
        ) from error
    except Exception as error:
        if isinstance(error, (KeyboardInterrupt, MemoryError)):
            raise
        raise InputError(
            f"cannot be read as a bag: {error}",
            where=str(path),
            needed="a whole bag",
            todo="is it cut off? ros2 bag reindex, or rosbag reindex",
        ) from error
