"""Cameras of whatever file: the format is recognised from what stands in it, not from its name (but for COLMAP's cameras.bin).

Known: lpcal (camera.yaml, calibration.yaml), mrcal (.cameramodel), OpenCV (FileStorage as YAML, XML, JSON), ROS (camera_info), Kalibr
(camchain.yaml, and EuRoC's sensor.yaml), COLMAP (cameras.txt, cameras.bin), Metashape, numpy's and MATLAB's arrays, and numbers by name
(`camera_named`). Here stand those of a few matrices by name:

- ROS: the yaml of camera_calibration (image_width, camera_matrix.data, ...) and a printed sensor_msgs/CameraInfo (width, K or k, D or d).
  ``distortion_model`` plumb_bob and rational_polynomial are OpenCV's; K and D hold the raw image, so the projection matrix P is not used.
  They are of the sensor's full size: a printed one's ``roi`` and ``binning`` (REP 104) say which of its pixels the images hold.
- Kalibr: camchain.yaml (cam0: camera_model, intrinsics, distortion_model, ...) and the flat sensor.yaml of EuRoC with the same keys.
  Source: Kalibr's wiki, "yaml formats"; radtan is OpenCV's k1 k2 p1 p2.
- OpenCV's FileStorage, as its calibration samples and many tools write it; names as these tools spell them. It is read here and not by
  OpenCV, whose parser ends the interpreter on some files that are garbled.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import yaml

from lpcal.errors import InputError
from lpcal.formats.camera_coefficients import central_camera, core_of, refuse_lens, sane_camera
from lpcal.formats.camera_colmap import is_colmap, read_colmap_camera
from lpcal.formats.camera_named import (
    arrays_of,
    camera_from_metashape,
    camera_from_names,
    is_named,
    metashape_calibration,
    refuse_other_lens,
)
from lpcal.formats.camera_yaml import camera_from_document, read_camera
from lpcal.formats.cameramodel import read_cameramodel
from lpcal.formats.documents import read_document
from lpcal.formats.guarded_yaml import load_yaml
from lpcal.formats.named_files import did_you_mean
from lpcal.formats.reading import reader
from lpcal.formats.text import read_text
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera

if TYPE_CHECKING:
    from xml.etree import ElementTree as ET

ROS_LENSES = ("plumb_bob", "rational_polynomial", "")
"""The lenses of ROS that lpcal projects with."""
KALIBR_LENSES = ("radtan", "radial-tangential", "plumb_bob", "none", "")
"""Those of Kalibr."""
MATRIX = ("camera_matrix", "cameraMatrix", "Camera_Matrix", "CameraMatrix", "intrinsic_matrix", "mtx", "K", "M1", "K1")
DISTORTION = (
    "distortion_coefficients",
    "Distortion_Coefficients",
    "distCoeffs",
    "dist_coeffs",
    "dist_coeff",
    "distCoeff",
    "distortionCoefficients",
    "distortion_coeffs",
    "distortion",
    "DistCoeffs",
    "dist",
    "D",
    "D1",
)
WIDTH, HEIGHT = ("image_width", "image_Width", "imageWidth", "width"), ("image_height", "image_Height", "imageHeight", "height")
SIZES = ("image_size", "imageSize", "image_Size", "size", "resolution")
ANY_DISTORTION = re.compile(r"dist|coef|^d\d?$|^kc$", re.IGNORECASE)
"""Names of what may be a distortion, where none of DISTORTION is there."""
HEADER_LINES = re.compile(r"^\s*(seq|stamp|secs?|nsecs?|nanosec|sec|frame_id|header):.*\n", re.MULTILINE)
"""Lines in which two messages of one camera differ."""
ARRAYS = (".npz", ".mat")
NUMBERS = re.compile(r"\d*[ucwsifdh]")
"""How OpenCV states what a matrix holds: ``d``, ``3f``."""
FILE_STORAGE = "a whole FileStorage of OpenCV's"
MOST_BYTES = 16 << 20
"""Bytes of the largest file of a camera that is read."""
KNOWN = "a camera file of lpcal, mrcal, OpenCV, ROS, Kalibr, COLMAP, Metashape, or its matrices in a .npz or .mat"


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
        raise InputError("no such camera file", where=str(path), needed=KNOWN, todo=did_you_mean(path))
    if path.suffix == ".bin":
        return read_colmap_camera(path)
    if path.suffix.lower() in ARRAYS:
        return _of_opencv(arrays_of(path), path)
    text = read_text(path, KNOWN)
    if "lensmodel" in text and "imagersize" in text:
        return read_cameramodel(path)
    if text.lstrip().startswith(("%YAML:1.0", "<")) or "opencv-matrix" in text:
        return read_opencv_camera(path)
    if is_colmap(text):
        return read_colmap_camera(path)
    return _from_document(_load(text, path), path)


def _load(text: str, path: Path) -> dict[str, Any]:
    try:
        document = load_yaml(_one_message(text, path), path)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        place = f"{path}:{mark.line + 1}" if mark else str(path)
        raise InputError("of no format known, or cut off", where=place, needed=KNOWN) from error
    if not isinstance(document, dict):
        raise InputError("of no format known", where=str(path), needed=KNOWN)
    return document


def _one_message(text: str, path: Path) -> str:
    """The first of the documents of a text, which may hold one camera many times, as a printed topic does."""
    first, *more = [part for part in re.split(r"^---[ \t]*$", text, flags=re.MULTILINE) if part.strip()] or [text]
    bare = HEADER_LINES.sub("", first).strip()
    if any(HEADER_LINES.sub("", other).strip() != bare for other in more):
        raise InputError(f"{1 + len(more)} documents of several cameras", where=str(path), needed="one camera", todo="keep one of them")
    return first if not more else text[: text.index(first)] + first


def _from_document(document: dict[str, Any], path: Path) -> Camera:
    if "lpcal" in document:
        return _of_lpcal(document, path)
    if isinstance(document.get("camera_info"), dict):
        document = document["camera_info"]
    if is_kalibr(document):
        return camera_from_kalibr(document, path)
    if is_ros(document):
        return camera_from_ros(document, path)
    if is_named(document):
        return camera_from_names(document, path)
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


def is_ros(document: dict[str, Any]) -> bool:
    """Whether a YAML document is of this form."""
    return {"image_width", "camera_matrix"} <= document.keys() or ("width" in document and bool({"K", "k"} & document.keys()))


def camera_from_ros(document: dict[str, Any], path: Path) -> Camera:
    """The camera of a document.

    Raises
    ------
    InputError
        A fisheye lens, or a number that is lacking; a camera that was never calibrated has K = 0.
    """
    lens = str(document.get("distortion_model") or "")
    if lens not in ROS_LENSES:
        raise refuse_lens(lens, str(path))
    try:
        core = core_of(_data(document, "camera_matrix", "K", "k"), str(path))
        size = document.get("image_width", document.get("width")), document.get("image_height", document.get("height"))
        whole = central_camera(size, core, _data(document, "distortion_coefficients", "D", "d"), str(path))
        return _of_region(whole, document)
    except (KeyError, IndexError, TypeError) as error:
        raise InputError(f"{error} is lacking or garbled", where=str(path), needed="a whole ROS camera file") from error


def _of_region(whole: Camera, document: dict[str, Any]) -> Camera:
    """The camera of the images, by which of the sensor's pixels they hold; a size of 0 or 1 says all."""
    roi = document.get("roi") or {}
    size = [int(roi.get(side) or all_of_it) for side, all_of_it in zip(("width", "height"), whole.image_size, strict=True)]
    first = [int(roi.get(side) or 0) for side in ("x_offset", "y_offset")]
    bins = [max(int(document.get(side) or 1), 1) for side in ("binning_x", "binning_y")]
    K = whole.K.copy()
    for axis in (0, 1):
        K[axis, 2] = (K[axis, 2] - first[axis] + 0.5) / bins[axis] - 0.5
        K[axis, axis] /= bins[axis]
    return Camera((size[0] // bins[0], size[1] // bins[1]), whole.model, K, whole.distortion)


def _data(document: dict[str, Any], *names: str) -> list[Any]:
    entry = next((document[name] for name in names if name in document), None)
    if entry is None:
        raise KeyError(names[0])
    return list(entry["data"] if isinstance(entry, dict) else entry)


def is_kalibr(document: dict[str, Any]) -> bool:
    """Whether a YAML document is of this form."""
    return "camera_model" in document or any(isinstance(entry, dict) and "camera_model" in entry for entry in document.values())


def camera_from_kalibr(document: dict[str, Any], path: Path) -> Camera:
    """The one camera of a document.

    Raises
    ------
    InputError
        Several cameras, a lens that is not pinhole with radial-tangential distortion, or a number that is lacking.
    """
    if "camera_model" not in document:
        names = [name for name, entry in document.items() if isinstance(entry, dict) and "camera_model" in entry]
        if len(names) > 1:
            raise InputError(
                f"{len(names)} cameras: {', '.join(names)}",
                where=str(path),
                needed="one camera",
                todo="keep one of them, in a file of its own",
            )
        document = document[names[0]]
    lens = str(document.get("distortion_model") or "")
    if document["camera_model"] != "pinhole" or lens not in KALIBR_LENSES:
        raise refuse_lens(f"{document['camera_model']} {lens}", str(path))
    try:
        distortion = document.get("distortion_coeffs", document.get("distortion_coefficients", []))
        return central_camera(document["resolution"], document["intrinsics"], distortion, str(path))
    except KeyError as error:
        raise InputError(f"the key {error} is lacking", where=str(path), needed="a whole Kalibr camera file") from error


class _Loader(yaml.SafeLoader):
    """OpenCV's tags (``!!opencv-matrix``) are mappings like any other."""


_Loader.add_multi_constructor("tag:yaml.org,2002:opencv-", lambda loader, _, node: loader.construct_mapping(node, deep=True))


@reader(FILE_STORAGE)
def read_opencv_camera(path: Path) -> Camera:
    """Read a camera that OpenCV wrote.

    Raises
    ------
    InputError
        Not readable, or the matrix, the distortion or the image size is not there.
    """
    stored = _stored(path)
    return camera_from_metashape(stored, path) if not isinstance(stored, dict) else _of_opencv(stored, path)


def _of_opencv(stored: dict[str, Any], path: Path) -> Camera:
    """The camera of matrices by the names that OpenCV's files have."""
    refuse_other_lens(stored, str(path))
    if not any(name in stored for name in MATRIX) and is_named(stored):
        return camera_from_names(stored, path)
    K = _matrix(stored, MATRIX)
    distortion = _matrix(stored, DISTORTION)
    size = _size(stored)
    if K is None or K.size != 9:
        raise InputError("no camera matrix", where=str(path), needed=f"a 3x3 matrix named {', '.join(MATRIX)}")
    if size is None:
        raise InputError("no image size", where=str(path), needed="image_width and image_height", todo="add them")
    if distortion is None and (strange := [name for name in stored if ANY_DISTORTION.search(name)]):
        found = f"no distortion of a name known, but {', '.join(strange[:4])}"
        raise InputError(found, where=str(path), needed=f"one of {', '.join(DISTORTION)}", todo="rename it")
    coefficients = [] if distortion is None else list(distortion.ravel())
    return central_camera(size, core_of(list(K.ravel()), str(path)), coefficients, str(path))


def _stored(path: Path) -> dict[str, Any] | ET.Element:
    """The entries of a file, or the document that holds Metashape's calibration."""
    text = read_text(path, FILE_STORAGE)
    if len(text) > MOST_BYTES:
        raise InputError(f"{len(text) / 1e6:.0f} MB", where=str(path), needed="the file of a camera")
    if text.lstrip().startswith("<"):
        from xml.etree import ElementTree as ET

        root = ET.fromstring(text)
        if metashape_calibration(root) is not None:
            return root
        found: Any = _from_xml(root)
    elif text.lstrip().startswith("{"):
        found = json.loads(text)
    else:
        found = _from_yaml(re.sub(r"\A\s*%YAML[^\n]*\n(?:---[^\n]*\n)?", lambda head: "\n" * head[0].count("\n"), text), path)
    if not isinstance(found, dict):
        raise InputError("no names and values", where=str(path), needed=FILE_STORAGE, todo="is it cut off?")
    return found


def _from_yaml(text: str, path: Path) -> Any:
    try:
        return load_yaml(text, path, _Loader)
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else 1
        raise InputError(f"not YAML: {error.problem}", where=f"{path}:{line}", needed=FILE_STORAGE, todo="is it cut off?") from error


def _from_xml(element: ET.Element) -> Any:
    """An element's children by name, or the words of its text."""
    if len(element):
        return {child.tag: _from_xml(child) for child in element}
    return (element.text or "").split()


def _matrix(stored: dict[str, Any], names: tuple[str, ...]) -> Array | None:
    """The numbers of the first entry of these names, in the shape that it states."""
    entry = next((stored[name] for name in names if name in stored), None)
    if entry is None:
        return None
    data = entry.get("data", []) if isinstance(entry, dict) else entry
    numbers = np.array(data, dtype=float)
    if isinstance(entry, dict):
        rows, columns = (int(_scalar(entry.get(key, 0))) for key in ("rows", "cols"))
        kind = str(entry.get("dt", "d")[0] if isinstance(entry.get("dt"), list) else entry.get("dt", "d"))
        if not NUMBERS.fullmatch(kind):
            found = f"a matrix of {kind!r}, which are no numbers"
            raise ValueError(found)
        if rows * columns != numbers.size or min(rows, columns) < 1:
            found = f"a matrix of {rows} rows and {columns} columns with {numbers.size} numbers"
            raise ValueError(found)
    return numbers


def _size(stored: dict[str, Any]) -> tuple[float, float] | None:
    for width, height in zip(WIDTH, HEIGHT, strict=True):
        if width in stored and height in stored:
            return _scalar(stored[width]), _scalar(stored[height])
    for name in SIZES:
        pair = stored.get(name)
        if isinstance(pair, list) and len(pair) == 2:
            return _scalar(pair[0]), _scalar(pair[1])
    return None


def _scalar(value: Any) -> float:
    return float(value[0] if isinstance(value, list) else value)
