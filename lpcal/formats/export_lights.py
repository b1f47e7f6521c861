"""Lights for other systems: .lp, RelightLab's dome, DiLiGenT, LUCES, near_ps, Meshroom.

Axes: C is x right, y down, z forward; .lp, RelightLab and DiLiGenT count y up and z towards the camera: ``(x, -y, -z)``. A near light as
a direction is that from the point where the lights' axes meet (`focus_C`), and where there is none from a point on the camera's axis.
A cosine lobe stands for any lobe in LUCES and near_ps: exponent and power are fitted over the angles at which the light is known.
Sources: RTIBuilder's and RelightLab's documentation; Shi et al. 2016 (DiLiGenT); Mecca et al. 2021 (LUCES); Quéau et al. 2018 (near_ps);
AliceVision, lightingEstimation.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from lpcal import __version__
from lpcal.errors import InputError
from lpcal.formats.export_cameras import camera_of, file_names, number
from lpcal.formats.export_lobe import CosineLobe, cosine_of
from lpcal.formats.import_directions import COUNTED_FROM, counted_from
from lpcal.formats.import_near_ps import nominal_point
from lpcal.formats.light_tables import C_FROM_UP, distant, near_lights, of_light
from lpcal.formats.reading import reader
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration, Light
from lpcal.records.exchange import ExchangeContent

MM = 1e3
"""Millimetres in a metre."""


def _lobes(lights: tuple[Light, ...]) -> tuple[list[CosineLobe], list[str]]:
    found = [cosine_of(light) for light in lights]
    worst = max(one.worst for one in found)
    said = f"the lights' lobes are written as cosines of the angle to a power: up to {100 * worst:.2g} % of the axis's light off"
    return found, [said] if worst > 1e-6 else []


def reference_C(content: ExchangeContent) -> tuple[Array, list[str]]:
    """The point (3,) in C that directions to near lights are counted from, and notes on it."""
    focus_C = content.focus_C()
    if focus_C is not None:
        return focus_C, []
    sources = np.array([light.source_C for light in content.calibration.lights if light.source_C is not None])
    if not len(sources):
        return np.array([0.0, 0.0, 1.0]), []
    point = nominal_point(sources)
    return point, [f"the lights' axes meet nowhere: directions are those from a point {MM * point[2]:.0f} mm before the camera"]


def directions_up(content: ExchangeContent) -> tuple[Array, list[str]]:
    """Unit vectors (L, 3) to the lights, x right, y up, z to the camera."""
    point_C, said = reference_C(content)
    near = any(light.source_C is not None for light in content.calibration.lights)
    towards = [
        light.direction_C if light.source_C is None else of_light(light.source_C - point_C, f"light {light.name}")
        for light in content.calibration.lights
    ]
    if near:
        said = [*said, "near lights become directions, which hold at one point: elsewhere on the object they are off by degrees"]
    return np.array(towards) * C_FROM_UP, said


def rgb(light: Light) -> Array:
    """Intensity (3,)."""
    return np.broadcast_to(light.intensity, (3,)).astype(float)


def write_lp(content: ExchangeContent, folder: Path) -> list[str]:
    """lights.lp: unit vectors."""
    vectors, said = directions_up(content)
    _write_lp(folder / "lights.lp", file_names(content), vectors)
    return said


def write_lp_positions(content: ExchangeContent, folder: Path) -> list[str]:
    """lights_positions.lp: positions in millimetres about the point where the axes meet."""
    point_C, said = reference_C(content)
    sources = np.array([light.source_C for light in content.calibration.lights], dtype=float)
    _write_lp(folder / "lights_positions.lp", file_names(content), MM * (sources - point_C) * C_FROM_UP)
    with (folder / "lights_positions.lp").open("a", encoding="utf-8") as file:
        file.write(COUNTED_FROM + " ".join(number(MM * value) for value in point_C) + "\n")
    where = ", ".join(f"{MM * value:.3f}" for value in point_C)
    return [*said, f"positions are counted from the point {where} mm of the camera's frame"]


def _write_lp(path: Path, names: list[str], vectors: Array) -> None:
    lines = [str(len(names))]
    lines += [f"{name} {' '.join(number(value) for value in vector)}" for name, vector in zip(names, vectors, strict=True)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_dome(content: ExchangeContent, folder: Path) -> list[str]:
    """rig.dome of RelightLab: positions in millimetres about the point where the axes meet, and each light's colour."""
    calibration = content.calibration
    vectors, said = directions_up(content)
    near = all(light.source_C is not None for light in calibration.lights)
    point_C, _ = reference_C(content)
    places = np.array([light.source_C - point_C if light.source_C is not None else light.direction_C for light in calibration.lights])
    places = places * C_FROM_UP * (MM if near else 1.0)
    at = " ".join(number(MM * value) for value in point_C)
    diameter = 2 * float(np.linalg.norm(places, axis=1).mean()) if near else 0.0

    def points(values: Array) -> list[dict[str, float]]:
        return [dict(zip("xyz", (float(v) for v in value), strict=True)) for value in values]

    document = {
        "label": calibration.name,
        "notes": f"written by lpcal {__version__}; millimetres; x right, y up, z to the camera" + (f"\n{COUNTED_FROM}{at}" if near else ""),
        "imageWidth": _width_mm(calibration, point_C) if near else 0.0,
        "domeDiameter": diameter,
        "verticalOffset": 0.0,
        "lightConfiguration": "lights3d" if near else "directional",
        "directions": points(vectors),
        "positionsSphere": points(vectors * diameter / 2),
        "positions3d": points(places) if near else [],
        "ledAdjust": [dict(zip("rgb", (float(v) for v in rgb(light)), strict=True)) for light in calibration.lights],
    }
    (folder / "rig.dome").write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    return ["the lights' lobes have no place"] if near else said


def _width_mm(calibration: Calibration, point_C: Array) -> float:
    """How wide the image is in the plane of the working point, mm; 0 where there is no camera."""
    if calibration.camera is None:
        return 0.0
    K = calibration.camera.K
    return float(MM * point_C[2] * calibration.camera.image_size[0] / K[0, 0])


def is_dome(path: Path) -> bool:
    """Whether a file is a dome of RelightLab's."""
    return path.is_file() and path.suffix.lower() == ".dome"


@reader("a dome of RelightLab's")
def read_dome(path: Path) -> Calibration:
    """Read a dome: near lights, where lpcal wrote in its notes where its camera stands; else distant ones, for no dome says that."""
    document: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    stored = document.get("directions") or document.get("positions3d") or []
    vectors = np.array([[float(one[axis]) for axis in "xyz"] for one in stored]).reshape(-1, 3)
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    if not len(vectors) or not np.isfinite(length).all() or np.any(length == 0):
        raise InputError("holds no directions", where=str(path), needed="directions, or positions3d")
    power = [[float(one[channel]) for channel in "rgb"] for one in document.get("ledAdjust") or []]
    intensity = np.array(power) if len(power) == len(vectors) else None
    name, names = document.get("label") or path.stem, [f"L{k}" for k in range(len(vectors))]
    point_C = counted_from(str(document.get("notes") or ""), str(path))
    places = document.get("positions3d") or []
    if point_C is not None and len(places) == len(vectors):
        at = np.array([[float(one[axis]) for axis in "xyz"] for one in places])
        return near_lights(name, names, point_C + at * C_FROM_UP / MM, point_C, intensity)
    return distant(name, names, vectors / length * C_FROM_UP, intensity)


def write_diligent(content: ExchangeContent, folder: Path) -> list[str]:
    """diligent/: filenames.txt, light_directions.txt, light_intensities.txt; with a capture its images in 16 bit and the mask too."""
    target = folder / "diligent"
    target.mkdir()
    vectors, said = directions_up(content)
    (target / "filenames.txt").write_text("".join(f"{name}\n" for name in file_names(content)), encoding="utf-8")
    power = np.array([rgb(light) for light in content.calibration.lights])
    for name, rows in {"light_directions.txt": vectors, "light_intensities.txt": power * arriving(content)[:, None]}.items():
        (target / name).write_text("".join(" ".join(number(v) for v in row) + "\n" for row in rows), encoding="utf-8")
    return [*said, *_images(content, target)]


def arriving(content: ExchangeContent) -> Array:
    """How much of each light (L,) arrives at the working point, relative: near lights by distance and lobe."""
    point_C, _ = reference_C(content)
    arrives = [
        float(light.field(point_C)[1].mean() / light.intensity.mean()) if light.source_C is not None else 1.0
        for light in content.calibration.lights
    ]
    return np.array(arrives) / np.mean(arrives)


def write_luces(content: ExchangeContent, folder: Path) -> list[str]:
    """luces/led_params.txt: near lights in mm, in C, with a pinhole camera; with a capture its images 01.png, ... and the mask too."""
    camera, lights = camera_of(content), content.calibration.lights
    target = folder / "luces"
    target.mkdir()
    point_C, said = reference_C(content)
    lobes, more = _lobes(lights)
    (width, height), K = camera.image_size, camera.K
    distance = content.calibration.d_object_m or float(point_C[2])
    heading = [str(len(lights)), str(width), str(height), *(number(v) for v in (K[0, 0], K[0, 2], K[1, 2], MM * distance))]
    rows = ["N_img nrows ncols f x0 y0 mean_distance sfull:[Lpos Ldir Phi mu 0]", " ".join(heading)]
    for light, lobe in zip(lights, lobes, strict=True):
        assert light.source_C is not None
        assert light.axis_C is not None
        values = [*(MM * light.source_C), *light.axis_C, *(lobe.power * rgb(light)), lobe.exponent]
        rows.append(" ".join(number(value) for value in values) + " 0")
    (target / "led_params.txt").write_text("\n".join(rows) + "\n", encoding="utf-8")
    if abs(K[0, 0] / K[1, 1] - 1) > 1e-9:
        said = [*said, f"one focal length: fy is {100 * (K[1, 1] / K[0, 0] - 1):+.3g} % of fx"]
    said = [*said, *_unbent(content), *more]
    return [*said, *_images(content, target, [f"{k + 1:02d}" for k in range(len(lights))])]


def write_near_ps(content: ExchangeContent, folder: Path) -> list[str]:
    """near_ps/: light.mat and camera.mat in mm; with a capture its images and the mask too."""
    from scipy.io import savemat

    camera, lights = camera_of(content), content.calibration.lights
    target = folder / "near_ps"
    target.mkdir()
    lobes, said = _lobes(lights)
    power = np.array([lobe.power * rgb(light) for light, lobe in zip(lights, lobes, strict=True)])
    stored = {
        "S": MM * np.array([light.source_C for light in lights]),
        "Dir": np.array([light.axis_C for light in lights]),
        "Phi": MM**2 * (power if np.ptp(power, axis=1).any() else power[:, :1]),
        "mu": np.array([[lobe.exponent] for lobe in lobes]),
    }
    savemat(target / "light.mat", stored, format="5")
    savemat(target / "camera.mat", {"K": camera.K}, format="5")
    names = [f"photometric_sample_raw_{k + 1:04d}" for k in range(len(lights))]
    return [*said, *_unbent(content), *_images(content, target, names, "photometric_sample_mask_raw")]


def _unbent(content: ExchangeContent) -> list[str]:
    """What a format of pinhole cameras makes of a lens."""
    camera = camera_of(content)
    if camera.spline is None and not np.any(camera.distortion):
        return []
    if content.capture is None:
        return ["the lens's distortion has no place: undistort the images before they are used with it"]
    return ["the lens's distortion has no place: the images beside it are made free of it"]


def _images(content: ExchangeContent, target: Path, names: list[str] | None = None, mask: str = "mask") -> list[str]:
    from lpcal.formats.export_images import write_images

    return write_images(content, target, names, mask) if content.capture is not None else []


def write_meshroom_lights(content: ExchangeContent, folder: Path) -> list[str]:
    """meshroom_lights.json, as AliceVision's LightingCalibration writes it, by the ids of the views in meshroom.sfm."""
    vectors, said = directions_up(content)
    towards_C = vectors * C_FROM_UP
    lights = [
        {
            "viewId": str(k),
            "type": "directional",
            "direction": [number(value) for value in direction],
            "intensity": [number(value) for value in rgb(light)],
        }
        for k, (light, direction) in enumerate(zip(content.calibration.lights, towards_C, strict=True))
    ]
    (folder / "meshroom_lights.json").write_text(json.dumps({"lights": lights}, indent=4) + "\n", encoding="utf-8")
    return said


def is_meshroom_lights(path: Path) -> bool:
    """Whether a file is a JSON of AliceVision's lights."""
    return path.is_file() and path.suffix.lower() == ".json" and b'"lights"' in path.read_bytes()[:4096]


@reader("a JSON of AliceVision's lights")
def read_meshroom_lights(path: Path) -> Calibration:
    """Read directional lights, named after their view or light."""
    entries = json.loads(path.read_text(encoding="utf-8"))["lights"]
    if any(entry.get("type") not in {None, "directional"} for entry in entries):
        raise ValueError("lights that are no directional ones")
    names = [f"L{entry.get('viewId', entry.get('lightId', k))}" for k, entry in enumerate(entries)]
    vectors = np.array([[float(value) for value in entry["direction"]] for entry in entries]).reshape(-1, 3)
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    if not len(vectors) or np.any(length == 0):
        raise ValueError("no directions")
    power = np.array([[float(value) for value in entry["intensity"]] for entry in entries])
    return distant(path.stem, names, vectors / length, power)
