"""meshroom.sfm: AliceVision's SfMData, version 1.2.8, a camera of the type pinhole with Brown's distortion.

All values are strings, as boost writes them. The focal length is in mm of a sensor 36 mm wide, which cancels: ``fx = f / 36 width``,
``fy = fx pixelRatio``; the principal point is counted from the middle of the image; pixel centres are at whole numbers. Its distortion is
k1 k2 k3 t1 t2, with t1 = p1 and t2 = p2 of OpenCV's. Source: AliceVision, sfmDataIO/jsonIO and camera/DistortionBrown.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.formats.camera_coefficients import central_camera
from lpcal.formats.export_cameras import calibration_of, camera_of, number
from lpcal.formats.export_lens import with_room_for
from lpcal.formats.export_lights import file_names
from lpcal.formats.reading import reader
from lpcal.records.calibration import Calibration
from lpcal.records.exchange import ExchangeContent

VERSION = ("1", "2", "8")
"""The version of the format that is written: the first in which the type of the camera and that of its distortion stand apart."""
SENSOR_MM = 36.0
"""Width of the sensor that the focal length is stated for, mm; AliceVision takes the same where nothing says it."""


def write_meshroom(content: ExchangeContent, folder: Path) -> list[str]:
    """meshroom.sfm: the camera, and a view a light."""
    camera, said = with_room_for(camera_of(content), 5)
    (width, height), K = camera.image_size, camera.K
    k1, k2, p1, p2, k3 = camera.distortion
    size = {"width": str(width), "height": str(height)}
    intrinsic = {
        "intrinsicId": "0",
        **size,
        "sensorWidth": number(SENSOR_MM),
        "sensorHeight": number(SENSOR_MM * height / width),
        "serialNumber": content.calibration.name,
        "type": "pinhole",
        "initializationMode": "calibrated",
        "initialFocalLength": number(SENSOR_MM * K[0, 0] / width),
        "focalLength": number(SENSOR_MM * K[0, 0] / width),
        "pixelRatio": number(K[1, 1] / K[0, 0]),
        "pixelRatioLocked": "true",
        "principalPoint": [number(K[0, 2] - width / 2), number(K[1, 2] - height / 2)],
        "distortionInitializationMode": "calibrated",
        "distortionParams": [number(value) for value in (k1, k2, k3, p1, p2)],
        "undistortionOffset": ["0", "0"],
        "undistortionParams": "",
        "distortionType": "brown",
        "undistortionType": "none",
        "locked": "true",
    }
    views = [
        {"viewId": str(k), "poseId": "0", "intrinsicId": "0", "path": name, **size, "metadata": ""}
        for k, name in enumerate(file_names(content))
    ]
    eye = [number(value) for value in np.eye(3).ravel()]
    pose = {"transform": {"rotation": eye, "center": ["0", "0", "0"]}, "locked": "1"}
    document: dict[str, Any] = {"version": list(VERSION), "views": views, "intrinsics": [intrinsic]}
    document["poses"] = [{"poseId": "0", "pose": pose}]
    (folder / "meshroom.sfm").write_text(json.dumps(document, indent=4) + "\n", encoding="utf-8")
    return [*said, "views name the images <light>.png beside it: put them there, or correct their paths"] if views else said


def is_meshroom(path: Path) -> bool:
    """Whether a file is an SfMData in JSON."""
    return path.is_file() and path.suffix.lower() in {".json", ".sfm"} and b'"pixelRatio"' in path.read_bytes()


@reader("an SfMData of AliceVision's in JSON")
def read_meshroom(path: Path) -> Calibration:
    """Read the one camera of an SfMData, of version 1.2.5 or later."""
    document = json.loads(path.read_text(encoding="utf-8"))
    version, intrinsics = tuple(int(part) for part in document["version"]), document["intrinsics"]
    if version < (1, 2, 5) or len(intrinsics) != 1:
        raise ValueError(f"version {'.'.join(document['version'])} with {len(intrinsics)} cameras: 1.2.5 or later and one are needed")
    stored = intrinsics[0]
    width, height = int(stored["width"]), int(stored["height"])
    kind = stored.get("distortionType", stored["type"])
    lens = [float(value) for value in stored.get("distortionParams") or []]
    if kind == "brown":
        lens = [lens[0], lens[1], lens[3], lens[4], lens[2]]
    elif kind in {"radialk1", "radialk3"}:
        k1, k2, k3 = [*lens, 0.0, 0.0, 0.0][:3]
        lens = [k1, k2, 0.0, 0.0, k3]
    elif kind not in {"none", "pinhole"} or lens:
        raise ValueError(f"a distortion {kind!r}")
    fx = float(stored["focalLength"]) / float(stored["sensorWidth"]) * width
    middle = [float(value) for value in stored["principalPoint"]]
    core = fx, fx * float(stored["pixelRatio"]), middle[0] + width / 2, middle[1] + height / 2
    return calibration_of(central_camera((width, height), core, lens, str(path)), path)
