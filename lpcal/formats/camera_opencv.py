"""OpenCV's FileStorage (YAML, XML, JSON), as its calibration samples and many tools write it; names as these tools spell them.

The files are read here and not by OpenCV, whose parser ends the interpreter on some that are garbled.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import yaml

from lpcal.errors import InputError
from lpcal.formats.camera_coefficients import central_camera
from lpcal.formats.guarded_yaml import load_yaml
from lpcal.formats.reading import reader
from lpcal.formats.text import read_text
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera

MATRIX = ("camera_matrix", "cameraMatrix", "Camera_Matrix", "CameraMatrix", "intrinsic_matrix", "mtx", "K", "M1", "K1")
DISTORTION = (
    "distortion_coefficients",
    "Distortion_Coefficients",
    "distCoeffs",
    "dist_coeffs",
    "distortion",
    "DistCoeffs",
    "dist",
    "D",
    "D1",
)
WIDTH, HEIGHT = ("image_width", "image_Width", "imageWidth", "width"), ("image_height", "image_Height", "imageHeight", "height")
SIZE = ("image_size", "imageSize", "image_Size", "size", "resolution")
NUMBERS = re.compile(r"\d*[ucwsifdh]")
"""How OpenCV states what a matrix holds: ``d``, ``3f``."""
NEEDED = "a whole FileStorage of OpenCV's"
MOST_BYTES = 16 << 20
"""Bytes of the largest file of a camera that is read."""


class _Loader(yaml.SafeLoader):
    """OpenCV's tags (``!!opencv-matrix``) are mappings like any other."""


_Loader.add_multi_constructor("tag:yaml.org,2002:opencv-", lambda loader, _, node: loader.construct_mapping(node, deep=True))


@reader(NEEDED)
def read_opencv_camera(path: Path) -> Camera:
    """Read a camera that OpenCV wrote.

    Raises
    ------
    InputError
        Not readable, or the matrix, the distortion or the image size is not there.
    """
    stored = _stored(path)
    K = _matrix(stored, MATRIX)
    distortion = _matrix(stored, DISTORTION)
    size = _size(stored)
    if K is None or K.size != 9:
        raise InputError("no camera matrix", where=str(path), needed=f"a 3x3 matrix named {', '.join(MATRIX)}")
    if size is None:
        raise InputError("no image size", where=str(path), needed="image_width and image_height", todo="add them")
    K = K.reshape(3, 3)
    coefficients = [] if distortion is None else list(distortion.ravel())
    return central_camera(size, (K[0, 0], K[1, 1], K[0, 2], K[1, 2]), coefficients, str(path))


def _stored(path: Path) -> dict[str, Any]:
    """The entries of a file."""
    text = read_text(path, NEEDED)
    if len(text) > MOST_BYTES:
        raise InputError(f"{len(text) / 1e6:.0f} MB", where=str(path), needed="the file of a camera")
    if text.lstrip().startswith("<"):
        found: Any = _from_xml(ET.fromstring(text))
    elif text.lstrip().startswith("{"):
        found = json.loads(text)
    else:
        found = _from_yaml(re.sub(r"\A\s*%YAML[^\n]*\n(?:---[^\n]*\n)?", lambda head: "\n" * head[0].count("\n"), text), path)
    if not isinstance(found, dict):
        raise InputError("no names and values", where=str(path), needed=NEEDED, todo="is it cut off?")
    return found


def _from_yaml(text: str, path: Path) -> Any:
    try:
        return load_yaml(text, path, _Loader)
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else 1
        raise InputError(f"not YAML: {error.problem}", where=f"{path}:{line}", needed=NEEDED, todo="is it cut off?") from error


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
    for name in SIZE:
        pair = stored.get(name)
        if isinstance(pair, list) and len(pair) == 2:
            return _scalar(pair[0]), _scalar(pair[1])
    return None


def _scalar(value: Any) -> float:
    return float(value[0] if isinstance(value, list) else value)
