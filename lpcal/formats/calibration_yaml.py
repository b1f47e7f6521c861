"""calibration.yaml, the product: camera and lights in C, all that a reconstructor needs.

- ``name``; ``camera``: ``image_size, model, K, distortion, black_level`` (a share of full scale), ``gamma``
- ``H_PC`` (4x4) where it is known; ``d_object_m``, the working distance; ``focus_m`` in C, where the lights' axes nearly meet
- ``lights``: ``name, H_CL`` (the mechanical frame), ``source_m`` and ``axis`` in C (null for a distant light), ``direction`` in C (the
  unit vector from the focus to the light), ``intensity`` (relative, the mean of all lights is 1; three numbers for RGB), ``lobe,
  position_std_m, direction_std_deg`` (an axis), ``intensity_std``

Beside them ``camera.white_level``, ``camera.flat_field`` (Chebyshev coefficients of the logarithm of the response,
see `records.sensor.FlatField`), and for a splined camera ``camera.lensmodel`` and ``camera.spline``. Without a lens ``camera`` may hold
black_level, white_level, gamma and flat_field alone, which a person may add to imported lights. ``lights: []`` stands where only a camera
or its place is known; ``H_OC``, the camera in the room, stands for ``H_PC`` where the tracked body carries the board. ``tracking`` says
how well it, the clocks and the tracked poses are known (`records.placement.RoomTracking`), which places captures in the room.
``distance_sensor`` is a beam in C (`formats.distance_files`). A lobe is one of

- ``{kind: isotropic}``
- ``{kind: cosine, exponent: m}``: cos(angle)^m; other kinds of one parameter are those of `records.lobes`
- ``{kind: leds, exponent: m, position_m: [[..]], axis: [[..]], power: [..], angle_deg: [..], value: [..]}``: the sum of
  LEDs in the frame L, each power cos(angle)^m / r^2; the table is its mean over the roll
- ``{kind: table, angle_deg: [...], value: [...], node_deg: [...], factor: [[...]]}``: monotone cubic through the table, 1 on the axis, 0
  beyond its last angle

with the angle t between the light's axis and the ray from its source. ``seen_deg``, if there, is the largest angle at which spheres showed
the light: beyond it the lobe is extrapolated. `factor`, if there, multiplies it: bilinear between nodes at
(t sin f, t cos f), f the angle about the axis from the x of the light's frame.
"""

from __future__ import annotations

from dataclasses import replace
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.camera_coefficients import sane_camera
from lpcal.formats.camera_yaml import camera_document, camera_from_document
from lpcal.formats.distance_files import beam_document, beam_from_document
from lpcal.formats.document_numbers import covariance, rigid, sigma
from lpcal.formats.documents import read_document, write_document
from lpcal.formats.light_tables import FARTHEST_M, sane_lights
from lpcal.formats.reading import reader
from lpcal.formats.record_documents import document_of, record_of
from lpcal.formats.sensor_document import KEYS, sensor_document, sensor_from_document
from lpcal.geometry.arrays import Array
from lpcal.geometry.light_field import TABLED
from lpcal.records.calibration import NAMES, Calibration, Camera, Carries, LedCluster, Light, Lobe
from lpcal.records.placement import RoomTracking
from lpcal.records.provenance import Provenance
from lpcal.records.sensor import StatedSensor

KIND = "calibration"


def write_calibration(path: Path, calibration: Calibration, provenance: Provenance) -> None:
    """Write calibration.yaml."""
    body: dict[str, Any] = {"name": calibration.name}
    if calibration.camera is not None:
        body["camera"] = camera_document(calibration.camera)
    elif calibration.sensor.said:
        body["camera"] = sensor_document(calibration.sensor)
    if calibration.H_PC is not None:
        body[NAMES[calibration.carries][0]] = calibration.H_PC
        body |= {} if calibration.tracking is None else {"tracking": document_of(calibration.tracking)}
    if calibration.distance_sensor is not None:
        body["distance_sensor"] = beam_document(calibration.distance_sensor)
    body |= {
        "d_object_m": calibration.d_object_m,
        "focus_m": calibration.focus_C,
        "lights": [light_document(light) for light in calibration.lights],
    }
    write_document(path, KIND, body, provenance)


@reader("a whole calibration file")
def read_calibration(path: Path) -> Calibration:
    """Read calibration.yaml.

    Raises
    ------
    InputError
        Not there, cut off, of another kind, or a value that is lacking, of another form, or no number; the light is named.
    """
    return calibration_from_document(read_document(path, KIND), path)


def calibration_from_document(document: dict[str, Any], path: Path) -> Calibration:
    """A calibration as written; `path` is what errors name.

    Raises
    ------
    InputError
        As `read_calibration`.
    """
    try:
        camera, sensor = _camera(document.get("camera"), path)
        lights = tuple(_light(path, entry) for entry in document["lights"])
        carries: Carries = "board" if "H_OC" in document else "camera"
        H_PC = rigid(document, NAMES[carries][0]) if document.get(NAMES[carries][0]) else None
        focus_C = _numbers(document, "focus_m", 3) if document.get("focus_m") else None
        tracking = _tracking(document)
        beam = beam_from_document(document["distance_sensor"]) if document.get("distance_sensor") else None
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(
            f"lacks or garbles {error}", where=str(path), needed="a whole calibration file", todo="write it again with lpcal export"
        ) from error
    distance_m = document.get("d_object_m")
    if distance_m is not None and not (isinstance(distance_m, (int, float)) and 0 < distance_m < FARTHEST_M):
        raise InputError(f"d_object_m: {distance_m}", where=str(path), needed="metres above zero", todo="correct it, or write null")
    found = Calibration(str(document.get("name", path.stem)), lights, camera, H_PC, distance_m, focus_C, sensor, carries=carries)
    found = replace(found, tracking=tracking, distance_sensor=beam)
    alone = document["lights"] == [] and focus_C is None and distance_m is None
    if alone and (camera is not None or H_PC is not None):
        return found
    return sane_lights(found, str(path))


def _tracking(document: dict[str, Any]) -> RoomTracking | None:
    """What is known of the tracking, where the file says it."""
    entry = document.get("tracking")
    if not entry:
        return None
    return replace(record_of(RoomTracking, entry), H_PC_covariance=covariance(entry, "H_PC_covariance", 6))


def _camera(entry: Any, path: Path) -> tuple[Camera | None, StatedSensor]:
    """The camera, or what is said of the sensor where the section holds nothing else."""
    if not entry:
        return None, StatedSensor()
    if isinstance(entry, dict) and set(entry) <= set(KEYS):
        return None, sensor_from_document(entry)
    return sane_camera(camera_from_document(entry), f"{path}, camera"), StatedSensor()


def light_document(light: Light) -> dict[str, Any]:
    """A light as it is written."""
    intensity: float | Array = float(light.intensity[0]) if light.intensity.size == 1 else light.intensity
    return {
        "name": light.name,
        "H_CL": light.H_CL,
        "source_m": light.source_C,
        "axis": light.axis_C,
        "direction": light.direction_C,
        "intensity": intensity,
        "lobe": lobe_document(light.lobe),
        "position_std_m": light.position_std_m,
        "direction_std_deg": np.degrees(light.direction_std_rad),
        "intensity_std": light.intensity_std,
    }


def lobe_document(lobe: Lobe) -> dict[str, Any]:
    """A lobe as it is written."""
    seen = {} if np.isnan(lobe.seen_rad) else {"seen_deg": float(np.degrees(lobe.seen_rad).round(3))}
    if lobe.kind == "table":
        table = {"kind": "table", "angle_deg": np.degrees(lobe.angle_rad).round(4), "value": lobe.value.round(6)}
        factor = {"node_deg": np.degrees(lobe.node_rad).round(4), "factor": lobe.factor.round(5)} if lobe.node_rad.size else {}
        return table | factor | seen
    if lobe.leds is not None:
        leds = {"exponent": lobe.leds.exponent, "position_m": lobe.leds.position_L.round(7), "axis": lobe.leds.axis_L.round(7)}
        table = {"angle_deg": np.degrees(lobe.angle_rad).round(4), "value": lobe.value.round(6)}
        return {"kind": "leds", **leds, "power": lobe.leds.power.round(7), **table, **seen}
    return {"kind": lobe.kind} if lobe.kind == "isotropic" else {"kind": lobe.kind, "exponent": lobe.exponent}


def lobe_from_document(entry: dict[str, Any]) -> Lobe:
    """A lobe as it was written.

    Raises
    ------
    InputError
        A key that its kind does not have.
    """
    _known_keys_alone(entry)
    if entry["kind"] in TABLED:
        seen_rad = np.radians(float(entry.get("seen_deg", np.nan)))
        lobe = Lobe(entry["kind"], angle_rad=np.radians(_numbers(entry, "angle_deg")), value=_numbers(entry, "value"), seen_rad=seen_rad)
        if entry.get("node_deg"):
            nodes = np.radians(_numbers(entry, "node_deg"))
            return replace(lobe, node_rad=nodes, factor=_numbers(entry, "factor", nodes.size, nodes.size))
        if entry["kind"] == "table":
            return lobe
        power = _numbers(entry, "power")
        places, axes = (_numbers(entry, key, power.size, 3) for key in ("position_m", "axis"))
        return replace(lobe, leds=LedCluster(places, axes, power, float(entry["exponent"])))
    return Lobe(entry["kind"], exponent=float(entry.get("exponent", 0.0)))


LOBE_KEYS = {
    "isotropic": (),
    "table": ("angle_deg", "value", "node_deg", "factor", "seen_deg"),
    "leds": ("angle_deg", "value", "exponent", "position_m", "axis", "power", "node_deg", "factor", "seen_deg"),
}
"""What a lobe holds besides its kind, by kind; any other kind holds its exponent alone."""


def _known_keys_alone(entry: dict[str, Any]) -> None:
    known = ("kind", *LOBE_KEYS.get(entry["kind"], ("exponent",)))
    unknown = [str(key) for key in entry if key not in known]
    if unknown:
        near = get_close_matches(unknown[0], known, n=1)
        todo = f"did you mean {near[0]}?" if near else "leave it out"
        found = f"a lobe of kind {entry['kind']} with the unknown key {unknown[0]}"
        raise InputError(found, needed=f"no other keys than {', '.join(known)}", todo=todo)


def light_from_document(entry: dict[str, Any]) -> Light:
    """A light as it was written.

    Raises
    ------
    KeyError, ValueError
        A key is lacking or holds no numbers of the right count; the message is the key's name.
    InputError
        Its lobe has a key that its kind does not have.
    """
    near = entry.get("source_m") is not None
    intensity = np.atleast_1d(np.asarray(entry["intensity"], dtype=float))
    if not np.isfinite(intensity).all() or intensity.size not in (1, 3):
        raise ValueError("intensity")
    direction_C = _numbers(entry, "direction", 3)
    if not np.any(direction_C):
        raise ValueError("direction")

    return Light(
        name=str(entry["name"]),
        direction_C=direction_C / np.linalg.norm(direction_C),
        intensity=intensity,
        H_CL=rigid(entry, "H_CL") if entry.get("H_CL") is not None else None,
        source_C=_numbers(entry, "source_m", 3) if near else None,
        axis_C=_numbers(entry, "axis", 3) if near else None,
        lobe=lobe_from_document(entry.get("lobe") or {"kind": "isotropic"}),
        position_std_m=sigma(entry, "position_std_m"),
        direction_std_rad=float(np.radians(sigma(entry, "direction_std_deg"))),
        intensity_std=sigma(entry, "intensity_std"),
    )


def _light(path: Path, entry: dict[str, Any]) -> Light:
    try:
        return light_from_document(entry)
    except InputError as error:
        where = f"{path}, light {entry.get('name', '?')}"
        raise InputError(error.found, where=where, needed=error.needed, todo=error.todo) from error
    except (KeyError, TypeError, ValueError) as error:
        name = entry.get("name", "?") if isinstance(entry, dict) else "?"
        raise InputError(
            f"{error} is lacking or holds no numbers",
            where=f"{path}, light {name}",
            needed="the keys of a calibration.yaml",
            todo="write it again with lpcal export",
        ) from error


def _numbers(document: dict[str, Any], key: str, *shape: int) -> Array:
    value = np.asarray(document[key], dtype=float)
    if not np.isfinite(value).all() or (shape and value.shape != shape) or value.size == 0:
        raise ValueError(key)
    return value
