"""rig.glb: the calibrated rig as a glTF scene, camera and spot lights, as Blender and viewers open it.

glTF has x right, y up, z to the viewer; its cameras look along their -z, its spots shine along their -z; so C is turned half about x at the
root, and half about x again in each camera and spot. A spot's light falls from the inner to the outer angle of its cone as
``((cos t - cos outer) / (cos inner - cos outer))^2``, cut to 0..1; both angles are fitted to the lobe. Metres; candela are relative: 1 is
the mean of all lights. A light's mechanical frame is a node below it. The lens, lobes and the working point, whole, stand in extras, from
which lpcal reads them back (`import_rig_glb`). Source: glTF 2.0, and its extension KHR_lights_punctual.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal import __version__
from lpcal.formats.calibration_yaml import lobe_document
from lpcal.formats.camera_yaml import camera_document
from lpcal.formats.distance_files import beam_document
from lpcal.formats.documents import plain
from lpcal.formats.export_cameras import camera_of
from lpcal.formats.export_lights import rgb
from lpcal.formats.export_lobe import round_lobe
from lpcal.formats.mesh_files import glb_of
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Light
from lpcal.records.exchange import ExchangeContent

HALF_TURN = se3.transform(np.diag([1.0, -1.0, -1.0]), np.zeros(3))
"""Half a turn about x: C to glTF's axes, and a light's or camera's z forward to z backward."""
LIGHTS = "KHR_lights_punctual"
BODY, ROOM, SENSOR, FRAME = "P: the tracked body", "O: the room", "distance sensor: x along its beam", "mechanical frame"
"""Names of the nodes of the rig's other frames; a light's begins with the light's name."""
WIDEST = np.pi / 2
"""Largest outer angle of a spot, by the format."""


def write_rig_glb(content: ExchangeContent, folder: Path) -> list[str]:
    """Write rig.glb."""
    calibration = content.calibration
    nodes: list[dict[str, Any]] = [
        {"name": "C: x right, y down, z forward", **_placed(HALF_TURN), "children": []},
        {"name": "camera", **_placed(HALF_TURN), "camera": 0},
    ]
    inside = nodes[0]["children"]
    inside.append(1)
    if calibration.H_PC is not None:
        name = BODY if calibration.carries == "camera" else ROOM
        inside.append(len(nodes))
        nodes.append({"name": name, **_placed(se3.inv(calibration.H_PC))})
    beam = calibration.distance_sensor
    if beam is not None:
        inside.append(len(nodes))
        nodes.append({"name": SENSOR, **_placed(beam.H_CR), "extras": plain(beam_document(beam))})
    spots: list[dict[str, Any]] = []
    worst = 0.0
    for light in calibration.lights:
        cone, off = spot_of(light)
        worst = max(worst, off)
        inside.append(len(nodes))
        H_CS = _of_light(light) @ HALF_TURN
        nodes.append({"name": light.name, **_placed(H_CS), "extensions": {LIGHTS: {"light": len(spots)}}})
        spots.append(_light(light, cone))
        if light.H_CL is not None:
            nodes[-1]["children"] = [len(nodes)]
            nodes.append({"name": f"{light.name}: {FRAME}", **_placed(se3.inv(H_CS) @ light.H_CL)})
    document: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": f"lpcal {__version__}", "extras": _said(content)},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": nodes,
        "cameras": [_camera(content)],
    }
    if spots:
        document |= {"extensionsUsed": [LIGHTS], "extensions": {LIGHTS: {"lights": spots}}}
    (folder / "rig.glb").write_bytes(glb_of(plain(document)))
    said = ["the principal point and the distortion stand in the camera's extras: glTF's cameras have neither"]
    said += [f"lobes become cones with a soft edge: up to {100 * worst:.2g} % of the axis's light off"] * (worst > 1e-6)
    return said


def _said(content: ExchangeContent) -> dict[str, Any]:
    """What the scene says of itself besides."""
    calibration = content.calibration
    return {"unit": "metre", "name": calibration.name, "d_object_m": calibration.d_object_m, "focus_m": calibration.focus_C}


def _placed(H: Array) -> dict[str, Any]:
    """A node's place; glTF has the quaternion as x y z w."""
    return {"translation": plain(H[:3, 3]), "rotation": plain(se3.quaternion(H[:3, :3]))}


def _of_light(light: Light) -> Array:
    """H (4, 4) of a light with its source as origin and its axis as z; of a distant one at 1 m in its direction."""
    axis = -light.direction_C if light.axis_C is None else light.axis_C
    z = axis / np.linalg.norm(axis)
    across = light.H_CL[:3, 0] if light.H_CL is not None else np.eye(3)[int(np.argmin(np.abs(z)))]
    y = np.cross(z, across)
    y /= np.linalg.norm(y)
    place = light.direction_C if light.source_C is None else light.source_C
    return se3.transform(np.stack([np.cross(y, z), y, z], axis=1), place)


def spot_of(light: Light) -> tuple[tuple[float, float] | None, float]:
    """Inner and outer angle, rad, of the cone nearest to a light's lobe, and how far it is off; None: the same to all sides."""
    if light.source_C is None or light.lobe.kind == "isotropic":
        return None, 0.0
    angle = np.linspace(0, WIDEST * 0.999, 181)
    wanted = round_lobe(light, angle)
    weight = np.sqrt(np.sin(angle) + 1e-3)

    from scipy.optimize import least_squares

    def cone(unknowns: Array) -> Array:
        inner, outer = unknowns[0] * unknowns[1], unknowns[1]
        return np.clip((np.cos(angle) - np.cos(outer)) / max(np.cos(inner) - np.cos(outer), 1e-3), 0, 1) ** 2

    def misses(unknowns: Array) -> Array:
        return np.asarray(weight * (cone(unknowns) - wanted))

    found = least_squares(misses, [0.1, 0.7], bounds=([0.0, 0.02], [0.999, WIDEST]))
    return (float(found.x[0] * found.x[1]), float(found.x[1])), float(np.abs(cone(found.x) - wanted).max())


def _light(light: Light, cone: tuple[float, float] | None) -> dict[str, Any]:
    colour = rgb(light)
    strongest = float(colour.max())
    stored: dict[str, Any] = {"name": light.name, "color": plain(colour / strongest), "intensity": strongest}
    if light.source_C is None:
        return stored | {"type": "directional"}
    stored["extras"] = {"lobe": plain(lobe_document(light.lobe))}
    if cone is None:
        return stored | {"type": "point"}
    return stored | {"type": "spot", "spot": {"innerConeAngle": cone[0], "outerConeAngle": cone[1]}}


def _camera(content: ExchangeContent) -> dict[str, Any]:
    camera = camera_of(content)
    (width, height), K = camera.image_size, camera.K
    return {
        "type": "perspective",
        "name": "camera",
        "perspective": {
            "yfov": float(2 * np.arctan(height / 2 / K[1, 1])),
            "aspectRatio": float(width / K[0, 0] / (height / K[1, 1])),
            "znear": 0.01,
            "zfar": 100.0,
        },
        "extras": plain({**camera_document(camera), "pixel centres": "whole numbers"}),
    }
