"""Where the camera sits, for robots' software: ROS tf and URDF, easy_handeye.

H_PC takes camera coordinates to the body's; tf and URDF say the same as parent P and child C, with translation in metres and the rotation
as quaternion x y z w (tf) or as roll, pitch, yaw about fixed axes (URDF). Where the body carries the board, the camera stands in the room.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import yaml

from lpcal.formats.documents import plain
from lpcal.formats.guarded_yaml import load_yaml
from lpcal.formats.light_tables import sane_lights
from lpcal.formats.pasted_transforms import ROOM, rpy, write_easy_handeye
from lpcal.formats.reading import reader
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration, Carries, Light
from lpcal.records.exchange import ExchangeContent

OPTICAL = "camera_optical_frame"
"""ROS's name for a frame with x right, y down, z forward (REP 103)."""
SENSOR = "distance_sensor"
"""The distance sensor's link: x along its beam, as ROS has it for a sensor_msgs/Range."""
LIGHT = "light_"
"""How the names of the lights' links begin."""
MARK = "written by lpcal"


def pose_of(content: ExchangeContent) -> Array:
    """H_PC, which a format's `needs` promises."""
    assert content.calibration.H_PC is not None
    return content.calibration.H_PC


def parent_of(content: ExchangeContent) -> str:
    """The frame in which the camera's place is known, named as ROS may name it."""
    return "_".join((ROOM if content.calibration.carries == "board" else content.body).split()) or "panel"


def write_tf(content: ExchangeContent, folder: Path) -> list[str]:
    """tf_static.sh, a command to run, and tf_static.yaml, the same as a geometry_msgs/TransformStamped."""
    H, parent = pose_of(content), parent_of(content)
    x, q = H[:3, 3], se3.quaternion(H[:3, :3])
    words = [f"--{name} {float(value)!r}" for name, value in zip(("x", "y", "z", "qx", "qy", "qz", "qw"), (*x, *q), strict=True)]
    command = f"ros2 run tf2_ros static_transform_publisher {' '.join(words)} --frame-id {parent} --child-frame-id {OPTICAL}"
    (folder / "tf_static.sh").write_text(f"#!/bin/sh\n# {MARK}: the camera in the frame {parent}\n{command}\n", encoding="utf-8")
    message = {
        "header": {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": parent},
        "child_frame_id": OPTICAL,
        "transform": {
            "translation": dict(zip("xyz", x, strict=True)),
            "rotation": dict(zip("xyzw", q, strict=True)),
        },
    }
    (folder / "tf_static.yaml").write_text(f"# {MARK}\n" + yaml.safe_dump(plain(message), sort_keys=False), encoding="utf-8")
    return []


def is_tf(path: Path) -> bool:
    """Whether a file is a TransformStamped in YAML."""
    return path.suffix in {".yaml", ".yml"} and path.is_file() and b"child_frame_id:" in path.read_bytes()[:4096]


@reader("a geometry_msgs/TransformStamped in YAML")
def read_tf(path: Path) -> Calibration:
    """H_PC of a TransformStamped whose child is the camera's optical frame."""
    document: dict[str, Any] = load_yaml(path.read_text(encoding="utf-8"), path)
    moved, turned = document["transform"]["translation"], document["transform"]["rotation"]
    H = _rigid([float(turned[axis]) for axis in "xyzw"], [float(moved[axis]) for axis in "xyz"])
    return Calibration(path.stem, (), H_PC=H, carries=_carries(document["header"]["frame_id"]))


def write_urdf(content: ExchangeContent, folder: Path) -> list[str]:
    """rig.urdf: the body, the camera's optical frame in it, and in the camera's each light's mechanical frame and the distance sensor's."""
    parent = parent_of(content)
    root = ET.Element("robot", name="lpcal_rig")
    root.append(ET.Comment(f" {MARK}; metres, radians; the optical frame has x right, y down, z forward "))
    ET.SubElement(root, "link", name=parent)
    _joint(root, parent, OPTICAL, pose_of(content))
    left = [light.name for light in content.calibration.lights if light.H_CL is None]
    for light in content.calibration.lights:
        if light.H_CL is not None:
            _joint(root, OPTICAL, f"{LIGHT}{re.sub(r'[^0-9A-Za-z_]', '_', light.name)}", light.H_CL)
    if content.calibration.distance_sensor is not None:
        _joint(root, OPTICAL, SENSOR, content.calibration.distance_sensor.H_CR)
    ET.indent(root)
    head = '<?xml version="1.0"?>\n'
    (folder / "rig.urdf").write_text(head + ET.tostring(root, encoding="unicode") + "\n", encoding="utf-8")
    return [f"{len(left)} lights have no frame of their own and are left out"] if left else []


def _joint(root: ET.Element, parent: str, child: str, H: Array) -> None:
    ET.SubElement(root, "link", name=child)
    joint = ET.SubElement(root, "joint", name=f"{parent}_to_{child}", type="fixed")
    ET.SubElement(joint, "parent", link=parent)
    ET.SubElement(joint, "child", link=child)
    xyz, turn = (" ".join(repr(float(value)) for value in values) for values in (H[:3, 3], rpy(H)))
    ET.SubElement(joint, "origin", xyz=xyz, rpy=turn)


def is_urdf(path: Path) -> bool:
    """Whether a file is a URDF."""
    return path.is_file() and path.suffix.lower() == ".urdf"


@reader("a URDF with a fixed joint to the camera's optical frame")
def read_urdf(path: Path) -> Calibration:
    """H_PC of the fixed joint whose child's name ends in ``optical_frame``, and the lights below it, each taken to shine from its frame."""
    joints = [_held(joint) for joint in ET.fromstring(path.read_text(encoding="utf-8")).iter("joint")]
    camera = next((one for one in joints if one.child.endswith("optical_frame")), None)
    if camera is None:
        raise ValueError("no joint leads to a link called ...optical_frame")
    frames = {one.child.removeprefix(LIGHT): one.H for one in joints if one.parent == camera.child and one.child.startswith(LIGHT)}
    lights = tuple(Light(name, -H[:3, 2], np.ones(1), H, H[:3, 3], H[:3, 2]) for name, H in frames.items())
    said = ("each light is taken to shine from its frame's origin, alike on all sides: a URDF holds neither source nor lobe",)
    found = Calibration(path.stem, lights, H_PC=camera.H, carries=_carries(camera.parent), warnings=said if lights else ())
    return sane_lights(found, str(path)) if lights else found


@dataclass(frozen=True)
class _Joint:
    """A joint: the links that it joins, and the child's frame (4, 4) in the parent's."""

    parent: str
    child: str
    H: Array


def _held(joint: ET.Element) -> _Joint:
    """A joint as it is written; one of a transmission has neither parent nor child."""
    origin = joint.find("origin")
    stated = ["0 0 0" if origin is None else origin.get(key) or "0 0 0" for key in ("xyz", "rpy")]
    x, turn = (np.array([float(value) for value in words.split()]).reshape(3) for words in stated)
    if not np.isfinite([x, turn]).all():
        raise ValueError(f"joint {joint.get('name')}: an origin that is not finite")
    ends = [found.get("link", "") if (found := joint.find(end)) is not None else "" for end in ("parent", "child")]
    return _Joint(ends[0], ends[1], se3.transform(se3.rotation_about_axes(turn[None, ::-1], "zyx")[0], x))


def write_handeye_yaml(content: ExchangeContent, folder: Path) -> list[str]:
    """easy_handeye.yaml, for easy_handeye's publisher."""
    write_easy_handeye(folder / "easy_handeye.yaml", pose_of(content), content.body, content.calibration.carries)
    return []


def is_easy_handeye(path: Path) -> bool:
    """Whether a file is easy_handeye's."""
    return path.suffix in {".yaml", ".yml"} and path.is_file() and b"eye_on_hand" in path.read_bytes()[:4096]


@reader("a calibration of easy_handeye's")
def read_easy_handeye(path: Path) -> Calibration:
    """H_PC of easy_handeye's file; of one that is eye on base, the camera in the room."""
    document: dict[str, Any] = load_yaml(path.read_text(encoding="utf-8"), path)
    stored = document["transformation"]
    H = _rigid([float(stored[key]) for key in ("qx", "qy", "qz", "qw")], [float(stored[key]) for key in "xyz"])
    carries: Carries = "camera" if document["parameters"]["eye_on_hand"] else "board"
    return Calibration(path.stem, (), H_PC=H, carries=carries)


def _carries(parent: str) -> Carries:
    """Whether the parent frame is the tracked body, or the room with a camera that stands still."""
    return "board" if parent == ROOM else "camera"


def _rigid(q: list[float], x: list[float]) -> Array:
    """H of a quaternion x y z w and a translation, both checked."""
    quaternion, place = np.array(q), np.array(x)
    length = float(np.linalg.norm(quaternion))
    if not (np.isfinite(quaternion).all() and np.isfinite(place).all() and abs(length - 1) < 1e-3):
        raise ValueError("a quaternion of length 1 and a finite translation are lacking")
    return se3.transform(se3.rotation_from_quaternion(quaternion / length), place)
