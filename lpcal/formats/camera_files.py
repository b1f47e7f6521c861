"""Cameras of whatever file: the format is recognised from what stands in it, not from its name (but for COLMAP's cameras.bin).

Known: lpcal (camera.yaml, calibration.yaml), mrcal (.cameramodel), OpenCV (FileStorage as YAML, XML, JSON), ROS (camera_info), Kalibr
(camchain.yaml, and EuRoC's sensor.yaml), COLMAP (cameras.txt, cameras.bin).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from lpcal.errors import InputError
from lpcal.formats.camera_coefficients import sane_camera
from lpcal.formats.camera_colmap import is_colmap, read_colmap_camera
from lpcal.formats.camera_kalibr import camera_from_kalibr, is_kalibr
from lpcal.formats.camera_opencv import read_opencv_camera
from lpcal.formats.camera_ros import camera_from_ros, is_ros
from lpcal.formats.camera_yaml import camera_from_document, read_camera
from lpcal.formats.cameramodel import read_cameramodel
from lpcal.formats.documents import read_document
from lpcal.formats.guarded_yaml import load_yaml
from lpcal.formats.reading import reader
from lpcal.formats.text import read_text
from lpcal.records.calibration import Camera

KNOWN = "a camera file of lpcal, mrcal, OpenCV, ROS, Kalibr or COLMAP"


@reader(KNOWN)
def read_camera_file(path: Path) -> Camera:
    """The camera of a file, whatever its format.

    Raises
    ------
    InputError
        Not there, of no format known, garbled, several cameras, or a lens that lpcal does not project with.
    """
    return sane_camera(_read(path), str(path))


def _read(path: Path) -> Camera:
    if not path.is_file():
        raise InputError("no such camera file", where=str(path), needed=KNOWN)
    if path.suffix == ".bin":
        return read_colmap_camera(path)
    text = read_text(path, KNOWN)
    if "lensmodel" in text and "imagersize" in text:
        return read_cameramodel(path)
    if text.startswith(("%YAML:1.0", "<?xml", "<opencv_storage")) or "opencv-matrix" in text:
        return read_opencv_camera(path)
    if is_colmap(text):
        return read_colmap_camera(path)
    return _from_document(_load(text, path), path)


def _load(text: str, path: Path) -> dict[str, Any]:
    try:
        document = load_yaml(text, path)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        place = f"{path}:{mark.line + 1}" if mark else str(path)
        raise InputError("of no format known, or cut off", where=place, needed=KNOWN) from error
    if not isinstance(document, dict):
        raise InputError("of no format known", where=str(path), needed=KNOWN)
    return document


def _from_document(document: dict[str, Any], path: Path) -> Camera:
    if "lpcal" in document:
        return _of_lpcal(document, path)
    if isinstance(document.get("camera_info"), dict):
        document = document["camera_info"]
    if is_kalibr(document):
        return camera_from_kalibr(document, path)
    if is_ros(document):
        return camera_from_ros(document, path)
    if path.suffix == ".json":
        return read_opencv_camera(path)
    raise InputError(f"of no format known: its keys are {', '.join(map(str, list(document)[:6]))}", where=str(path), needed=KNOWN)


def _of_lpcal(document: dict[str, Any], path: Path) -> Camera:
    if document.get("kind") != "calibration":
        return read_camera(path)
    section = read_document(path, "calibration").get("camera")
    if section is None:
        raise InputError("a calibration without a camera", where=str(path), needed="its camera: section")
    try:
        return camera_from_document(section)
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"{error} is lacking or garbled", where=str(path), needed="a whole calibration file") from error
