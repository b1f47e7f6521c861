"""rig.glb read back, and any other glTF scene (.glb, .gltf) with lights of KHR_lights_punctual, as Blender writes them.

C is the frame of the scene's first camera, turned half about x (glTF: x right, y up, z to the viewer); without a camera the scene's own,
turned so. A light's source is its node's origin, its axis the node's -z. A cone becomes a lobe by glTF's formula::

    ((cos t - cos outer) / (cos inner - cos outer))^2,  cut to 0..1

Metres. What glTF has no place for lpcal writes as extras (lens, lobes, the working point), and takes them before glTF's own. A camera
without them states no image size, so no pixel focal length either: it gives the frame alone. Source: glTF 2.0, KHR_lights_punctual.
"""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.calibration_yaml import lobe_from_document
from lpcal.formats.camera_coefficients import sane_camera
from lpcal.formats.camera_yaml import camera_from_document
from lpcal.formats.distance_files import beam_from_document
from lpcal.formats.export_rig_glb import BODY, FRAME, HALF_TURN, LIGHTS, ROOM, SENSOR, WIDEST
from lpcal.formats.import_near_ps import nominal_point
from lpcal.formats.light_tables import of_light, sane_lights, scaled
from lpcal.formats.mesh_files import GLB_MAGIC, JSON_CHUNK
from lpcal.formats.reading import reader
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration, Camera, Light, Lobe

MOST_BYTES = 32_000_000
"""Bytes of a scene's description beyond which it is none of a rig: its numbers alone may be larger."""
CONE_ANGLES = 91
"""Angles at which a cone becomes a lobe's table: half a degree apart for the widest but one in ten."""
MOST_NODES = 100_000
"""Nodes beyond which a scene is none of a rig."""


def is_rig_glb(path: Path) -> bool:
    """Whether a file is a glTF scene with lights of KHR_lights_punctual, or one that lpcal wrote of a rig."""
    if path.suffix.lower() not in {".glb", ".gltf"} or not path.is_file():
        return False
    try:
        document = _document(path)
    except (InputError, ValueError, OSError, struct.error):
        return False
    asset = document.get("asset")
    ours = isinstance(asset, dict) and str(asset.get("generator")).startswith("lpcal") and "cameras" in document
    return ours or LIGHTS in str(document.get("extensionsUsed"))


@reader("a glTF scene with lights of KHR_lights_punctual")
def read_rig_glb(path: Path) -> Calibration:
    """Read a scene's lights, its first camera, and the body and the distance sensor of lpcal's own.

    Raises
    ------
    InputError
        No such scene, no lights and no camera in it, or a light that can be none.
    """
    document = _document(path)
    nodes = _placed(document, path)
    eye = next((node for node in nodes if "camera" in node.held), None)
    H_SC = HALF_TURN if eye is None else _rigid(eye.H @ HALF_TURN, path, eye.name)
    H_CS = se3.inv(H_SC)
    extras = _extras(document["asset"])
    camera, said = _camera(document, eye, path)
    focus_C = None if extras.get("focus_m") is None else np.asarray(extras["focus_m"], float).reshape(3)
    distance_m = extras.get("d_object_m")
    body = next((node for node in nodes if node.name in {BODY, ROOM}), None)
    found = Calibration(
        str(extras.get("name") or path.stem),
        _lights(document, nodes, H_CS, focus_C, path),
        camera,
        None if body is None else se3.inv(_rigid(H_CS @ body.H, path, body.name)),
        None if distance_m is None else float(distance_m),
        focus_C,
        warnings=tuple(said),
        carries="board" if body is not None and body.name == ROOM else "camera",
    )
    sensor = next((node for node in nodes if node.name == SENSOR), None)
    if sensor is not None and "covariance" in (entry := _extras(sensor.held)):
        H_CR = H_CS @ sensor.H
        found = replace(found, distance_sensor=beam_from_document({**entry, "position_m": H_CR[:3, 3], "direction": H_CR[:3, 0]}))
    if not found.lights and camera is None and found.H_PC is None:
        raise InputError("holds no lights and no camera", where=str(path), needed="a scene with lights of KHR_lights_punctual")
    return sane_lights(found, str(path)) if found.lights else found


def _document(path: Path) -> dict[str, Any]:
    """A scene's description.

    Raises
    ------
    InputError
        It is none, or too large.
    """
    with path.open("rb") as file:
        head = file.read(20)
        if len(head) == 20 and struct.unpack("<I", head[:4])[0] == GLB_MAGIC:
            length, kind = struct.unpack("<II", head[12:20])
            text = file.read(length) if kind == JSON_CHUNK and length <= MOST_BYTES else b""
        else:
            text = head + file.read(MOST_BYTES)
    document = json.loads(text) if text else None
    if not isinstance(document, dict) or not isinstance(document.get("asset"), dict):
        raise InputError("is no glTF scene", where=str(path), needed="a .glb or .gltf with its description first")
    return document


@dataclass(frozen=True)
class _Node:
    """A node of the scene: its name, what it holds, and its frame in the scene's."""

    name: str
    held: dict[str, Any]
    H: Array
    parent: int


def _placed(document: dict[str, Any], path: Path) -> list[_Node]:
    """All nodes of the scene, parents first.

    Raises
    ------
    InputError
        A node below itself, or too many.
    """
    stored = document.get("nodes") or []
    scenes = document.get("scenes") or [{"nodes": list(range(len(stored)))}]
    waiting = [(int(k), np.eye(4), -1) for k in scenes[int(document.get("scene", 0))].get("nodes") or []]
    found: list[_Node] = []
    met: set[int] = set()
    while waiting:
        k, H_above, parent = waiting.pop(0)
        if k in met or len(met) > MOST_NODES or not 0 <= k < len(stored):
            raise InputError(f"node {k} stands twice, nowhere, or is one of too many", where=str(path), needed="a scene that is a tree")
        met.add(k)
        H = H_above @ _local(stored[k])
        found.append(_Node(str(stored[k].get("name") or f"node {k}"), stored[k], H, parent))
        waiting += [(int(below), H, len(found) - 1) for below in stored[k].get("children") or []]
    return found


def _local(node: dict[str, Any]) -> Array:
    """A node's frame (4, 4) in that above it."""
    if "matrix" in node:
        return np.asarray(node["matrix"], float).reshape(4, 4).T
    R = se3.rotation_from_quaternion(np.asarray(node.get("rotation", [0, 0, 0, 1]), float).reshape(4))
    scale = np.asarray(node.get("scale", [1, 1, 1]), float).reshape(3)
    return se3.transform(R, np.asarray(node.get("translation", [0, 0, 0]), float).reshape(3)) @ np.diag([*scale, 1.0])


def _rigid(H: Array, path: Path, name: str) -> Array:
    """A frame without its scale.

    Raises
    ------
    InputError
        It is squashed, mirrored or not finite.
    """
    length = np.linalg.norm(H[:3, :3], axis=0)
    if not (np.isfinite(H).all() and length.min() > 1e-9):
        raise InputError("a frame that is not finite or has no size", where=f"{path}, node {name}", needed="a turn and a place")
    R = H[:3, :3] / length
    if np.abs(R.T @ R - np.eye(3)).max() > 1e-3 or np.linalg.det(R) < 0:
        raise InputError("a frame that is squashed or mirrored", where=f"{path}, node {name}", needed="a turn and a place")
    return se3.transform(R, H[:3, 3])


def _extras(entry: dict[str, Any]) -> dict[str, Any]:
    extras = entry.get("extras")
    return extras if isinstance(extras, dict) else {}


def _camera(document: dict[str, Any], eye: _Node | None, path: Path) -> tuple[Camera | None, list[str]]:
    """The camera of the extras, and what is to be said of one without."""
    if eye is None:
        return None, ["the scene has no camera: its own frame is taken as the camera's"]
    entry = _extras(document["cameras"][int(eye.held["camera"])])
    if "image_size" not in entry:
        return None, ["the scene's camera states no image size: its place is taken, its lens is not"]
    return sane_camera(camera_from_document(entry), f"{path}, camera"), []


def _lights(document: dict[str, Any], nodes: list[_Node], H_CS: Array, focus_C: Array | None, path: Path) -> tuple[Light, ...]:
    """The lights of the scene, in the order of their nodes."""
    kinds = ((document.get("extensions") or {}).get(LIGHTS) or {}).get("lights") or []
    placed = [(k, node) for k, node in enumerate(nodes) if LIGHTS in (node.held.get("extensions") or {})]
    stored = [kinds[int(node.held["extensions"][LIGHTS]["light"])] for _, node in placed]
    frames = [_rigid(H_CS @ node.H @ HALF_TURN, path, node.name) for _, node in placed]
    near = [one.get("type") != "directional" for one in stored]
    sources = np.array([H[:3, 3] for H, one in zip(frames, near, strict=True) if one]).reshape(-1, 3)
    about = focus_C if focus_C is not None or not len(sources) else nominal_point(sources)
    lights = []
    for (k, node), one, H, stands in zip(placed, stored, frames, near, strict=True):
        intensity = float(one.get("intensity", 1.0)) * np.asarray(one.get("color", [1.0, 1.0, 1.0]), float).reshape(3)
        intensity = intensity if np.ptp(intensity) else intensity[:1]
        where = f"{path}, light {node.name}"
        mechanical = next((other for other in nodes if other.parent == k and other.name.endswith(FRAME)), None)
        H_CL = None if mechanical is None else _rigid(H_CS @ mechanical.H, path, mechanical.name)
        if not stands:
            lights.append(Light(node.name, -H[:3, 2], intensity, H_CL))
            continue
        assert about is not None
        towards = of_light(H[:3, 3] - about, where)
        lights.append(Light(node.name, towards, intensity, H_CL, H[:3, 3], H[:3, 2], _lobe(one)))
    if not lights:
        return ()
    power = scaled(np.array([np.broadcast_to(light.intensity, (3,)) for light in lights]))
    return tuple(replace(light, intensity=row[: light.intensity.size]) for light, row in zip(lights, power, strict=True))


def _lobe(one: dict[str, Any]) -> Lobe:
    """A near light's lobe: as lpcal wrote it, or of its cone."""
    extras = _extras(one)
    if "lobe" in extras:
        return lobe_from_document(extras["lobe"])
    if one.get("type") != "spot":
        return Lobe()
    cone = one.get("spot") or {}
    inner, outer = float(cone.get("innerConeAngle", 0.0)), float(cone.get("outerConeAngle", np.pi / 4))
    if not 0 <= inner < outer <= WIDEST + 1e-6:
        raise ValueError(f"a cone of {inner:g} to {outer:g} rad")
    angle = np.linspace(0, outer, CONE_ANGLES)
    falls = (np.cos(angle) - np.cos(outer)) / max(np.cos(inner) - np.cos(outer), 1e-9)
    return Lobe("table", angle_rad=angle, value=np.clip(falls, 0, 1) ** 2)
