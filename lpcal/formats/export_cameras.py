"""A camera for other systems: OpenCV, ROS, Kalibr, COLMAP, mrcal, Metashape, Meshroom.

Pixel centres: whole numbers in lpcal, OpenCV, ROS, Kalibr and mrcal; COLMAP and Metashape count the first pixel's centre as (0.5, 0.5), so
half a pixel is added to the principal point. All numbers are written with all their digits. Sources: OpenCV, FileStorage; ROS REP 104 and
camera_calibration_parsers; Kalibr's wiki, "yaml formats"; COLMAP's documentation, "Output format"; mrcal's documentation, "cameramodel";
Metashape's manual, appendix "Camera models" (its p1 and p2 are OpenCV's p2 and p1, b1 is fx - fy, cx and cy are counted from the middle).

meshroom.sfm is AliceVision's SfMData, version 1.2.8: a camera of the type pinhole with Brown's distortion, all values strings. The focal
length is in mm of a sensor 36 mm wide, which cancels: ``fx = f / 36 width``, ``fy = fx pixelRatio``; the principal point is counted from
the middle of the image; its distortion is k1 k2 k3 t1 t2, with t1 = p1 and t2 = p2 of OpenCV's. Source: AliceVision, sfmDataIO/jsonIO and
camera/DistortionBrown.
"""

from __future__ import annotations

import ast
import json
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np

from lpcal.formats.camera_coefficients import central_camera, sane_camera
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.camera_named import camera_from_metashape
from lpcal.formats.cameramodel import MARK as CAMERAMODEL_MARK
from lpcal.formats.cameramodel import cameramodel_text, read_cameramodel
from lpcal.formats.export_lens import with_room_for
from lpcal.formats.reading import reader
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration
from lpcal.records.camera import Camera
from lpcal.records.exchange import ExchangeContent

HALF_PIXEL = 0.5
"""By how many pixels COLMAP's and Metashape's image coordinates are larger than lpcal's."""
MARK = "written by lpcal"
ROS_LENSES = {5: "plumb_bob", 8: "rational_polynomial"}


def camera_of(content: ExchangeContent) -> Camera:
    """The camera, which a format's `needs` promises."""
    assert content.calibration.camera is not None
    return content.calibration.camera


def file_names(content: ExchangeContent) -> list[str]:
    """The names of the lights' images: those of the capture's files as they are written beside, else ``<light>.png``."""
    return [f"{light.name}.png" for light in content.calibration.lights]


def calibration_of(camera: Camera, path: Path) -> Calibration:
    """A calibration of a camera alone, as it is read back."""
    return Calibration(path.stem, (), camera)


def read_camera_alone(path: Path) -> Calibration:
    """A camera file of any format that `read_camera_file` knows."""
    return calibration_of(read_camera_file(path), path)


def number(value: float) -> str:
    """A number with all its digits."""
    return repr(float(value))


def listed(values: Array) -> str:
    """Numbers side by side, with commas."""
    return ", ".join(number(value) for value in np.ravel(values))


def _most(camera: Camera) -> tuple[Camera, list[str]]:
    """The camera with OpenCV's 5 or 8 coefficients, whichever it needs."""
    return with_room_for(camera, 8 if camera.spline is not None or camera.distortion.size > 5 else 5)


def write_opencv(content: ExchangeContent, folder: Path) -> list[str]:
    """camera.opencv.yml, by the keys of OpenCV's own calibration sample."""
    camera, said = _most(camera_of(content))

    def matrix(values: Array) -> str:
        rows, columns = values.shape
        return f"!!opencv-matrix\n   rows: {rows}\n   cols: {columns}\n   dt: d\n   data: [ {listed(values)} ]"

    lines = [
        "%YAML:1.0",
        "---",
        f"# {MARK}; pixel centres at whole numbers; k1 k2 p1 p2 k3 [k4 k5 k6]",
        f"image_width: {camera.image_size[0]}",
        f"image_height: {camera.image_size[1]}",
        f"camera_matrix: {matrix(camera.K)}",
        f"distortion_coefficients: {matrix(camera.distortion[None])}",
    ]
    lines += [f"avg_reprojection_error: {number(camera.rms_px * np.sqrt(2))}"] * bool(np.isfinite(camera.rms_px))
    (folder / "camera.opencv.yml").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return said


def write_ros(content: ExchangeContent, folder: Path) -> list[str]:
    """camera.ros.yaml, with the projection matrix [K 0] that image_proc rectifies with."""
    camera, said = _most(camera_of(content))
    P = np.hstack([camera.K, np.zeros((3, 1))])
    lines = [
        f"# {MARK}; frame: optical, x right, y down, z forward",
        f"image_width: {camera.image_size[0]}",
        f"image_height: {camera.image_size[1]}",
        "camera_name: camera",
        f"camera_matrix: {{rows: 3, cols: 3, data: [{listed(camera.K)}]}}",
        f"distortion_model: {ROS_LENSES[camera.distortion.size]}",
        f"distortion_coefficients: {{rows: 1, cols: {camera.distortion.size}, data: [{listed(camera.distortion)}]}}",
        f"rectification_matrix: {{rows: 3, cols: 3, data: [{listed(np.eye(3))}]}}",
        f"projection_matrix: {{rows: 3, cols: 4, data: [{listed(P)}]}}",
    ]
    (folder / "camera.ros.yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return said


def write_kalibr(content: ExchangeContent, folder: Path) -> list[str]:
    """camchain.yaml, pinhole-radtan."""
    camera, said = with_room_for(camera_of(content), 4)
    K = camera.K
    lines = [
        f"# {MARK}",
        "cam0:",
        "  cam_overlaps: []",
        "  camera_model: pinhole",
        f"  distortion_coeffs: [{listed(camera.distortion)}]",
        "  distortion_model: radtan",
        f"  intrinsics: [{listed(np.array([K[0, 0], K[1, 1], K[0, 2], K[1, 2]]))}]",
        f"  resolution: [{camera.image_size[0]}, {camera.image_size[1]}]",
        "  rostopic: /camera/image_raw",
    ]
    (folder / "camchain.yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return said


def write_colmap(content: ExchangeContent, folder: Path) -> list[str]:
    """colmap/: a model of one camera and no image yet, as `pycolmap.Reconstruction` and colmap's `--input_path` take it."""
    camera, said = camera_of(content), list[str]()
    four = camera.spline is None and not np.any(camera.distortion[4:])
    camera, said = with_room_for(camera, 4 if four else 8)
    K, k = camera.K, camera.distortion
    core = [K[0, 0], K[1, 1], K[0, 2] + HALF_PIXEL, K[1, 2] + HALF_PIXEL]
    width, height = camera.image_size
    line = f"1 {'OPENCV' if four else 'FULL_OPENCV'} {width} {height} {' '.join(number(value) for value in (*core, *k))}"
    target = folder / "colmap"
    target.mkdir()
    heads = {
        "cameras.txt": f"# {MARK}; the first pixel's centre is (0.5, 0.5)\n# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n{line}\n",
        "rigs.txt": f"# {MARK}\n# RIG_ID, NUM_SENSORS, REF_SENSOR_TYPE, REF_SENSOR_ID\n1 1 CAMERA 1\n",
        "frames.txt": f"# {MARK}\n",
        "images.txt": f"# {MARK}\n",
        "points3D.txt": f"# {MARK}\n",
    }
    for name, text in heads.items():
        (target / name).write_text(text, encoding="utf-8")
    return said


def write_mrcal(content: ExchangeContent, folder: Path) -> list[str]:
    """camera.cameramodel; its reference frame is the tracked body's where H_PC is known."""
    camera, text = camera_of(content), cameramodel_text(camera_of(content))
    H_PC = content.calibration.H_PC
    if H_PC is not None:
        H_CP = se3.inv(H_PC)
        pose = listed(np.concatenate([se3.rotation_vector(H_CP[:3, :3]), H_CP[:3, 3]]))
        text = text.replace("'extrinsics': [ 0, 0, 0, 0, 0, 0 ]", f"'rt_cam_ref': [ {pose} ],\n    'extrinsics': [ {pose} ]")
    (folder / "camera.cameramodel").write_text(CAMERAMODEL_MARK + text, encoding="utf-8")
    return ["what it was solved from stays in the rig's own camera.cameramodel"] * (camera.covariance is not None)


def is_mrcal(path: Path) -> bool:
    """Whether a file is a cameramodel."""
    return path.is_file() and path.suffix.lower() == ".cameramodel"


@reader("a cameramodel of mrcal's")
def read_mrcal(path: Path) -> Calibration:
    """A cameramodel, with H_PC where its pose is not the identity."""
    camera = sane_camera(read_cameramodel(path), str(path))
    document = ast.literal_eval(path.read_text(encoding="utf-8"))
    pose = np.array(document.get("rt_cam_ref", document.get("extrinsics", np.zeros(6))), dtype=float)
    if pose.shape != (6,) or not np.isfinite(pose).all():
        raise ValueError("a pose of six finite numbers is lacking")
    H_PC = se3.inv(se3.transform(se3.rotation(pose[:3]), pose[3:])) if np.any(pose) else None
    return replace(calibration_of(camera, path), H_PC=H_PC)


def write_metashape(content: ExchangeContent, folder: Path) -> list[str]:
    """camera.metashape.xml, as Metashape's "Tools, Camera Calibration, load" takes it."""
    camera, said = with_room_for(camera_of(content), 5)
    (width, height), K = camera.image_size, camera.K
    k1, k2, p1, p2, k3 = camera.distortion
    values = {
        "f": K[1, 1],
        "cx": K[0, 2] + HALF_PIXEL - width / 2,
        "cy": K[1, 2] + HALF_PIXEL - height / 2,
        "b1": K[0, 0] - K[1, 1],
        "k1": k1,
        "k2": k2,
        "k3": k3,
        "p1": p2,
        "p2": p1,
    }
    root = ET.Element("calibration")
    for name, text in {"projection": "frame", "width": str(width), "height": str(height)}.items():
        ET.SubElement(root, name).text = text
    for name, value in values.items():
        ET.SubElement(root, name).text = number(value)
    ET.indent(root)
    body = ET.tostring(root, encoding="unicode")
    head = f'<?xml version="1.0" encoding="UTF-8"?>\n<!-- {MARK} -->\n'
    (folder / "camera.metashape.xml").write_text(head + body + "\n", encoding="utf-8")
    return said


def is_metashape(path: Path) -> bool:
    """Whether a file is Metashape's calibration of one camera."""
    return path.is_file() and path.suffix.lower() == ".xml" and b"<projection>" in path.read_bytes()[:4096]


@reader("a camera calibration of Metashape's, in XML")
def read_metashape(path: Path) -> Calibration:
    """Read Metashape's calibration of a frame camera."""
    return calibration_of(camera_from_metashape(ET.fromstring(path.read_text(encoding="utf-8")), path), path)


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
