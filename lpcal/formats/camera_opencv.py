"""OpenCV's FileStorage (YAML, XML, JSON), as its calibration samples and many tools write it; names as these tools spell them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.camera_coefficients import central_camera
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


def read_opencv_camera(path: Path) -> Camera:
    """Read a camera that OpenCV wrote.

    Raises
    ------
    InputError
        Not readable, or the matrix, the distortion or the image size is not there.
    """
    import cv2

    try:
        storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_READ)
        K = _matrix(storage, MATRIX)
        distortion = _matrix(storage, DISTORTION)
        size = _size(storage)
    except (cv2.error, SystemError) as error:
        raise InputError("cannot be read as OpenCV's FileStorage", where=str(path), needed="a whole file", todo="is it cut off?") from error
    if K is None or K.shape != (3, 3):
        raise InputError("no camera matrix", where=str(path), needed=f"a 3x3 matrix named {', '.join(MATRIX)}")
    if size is None:
        raise InputError("no image size", where=str(path), needed="image_width and image_height", todo="add them")
    coefficients = [] if distortion is None else list(distortion.ravel())
    return central_camera(size, (K[0, 0], K[1, 1], K[0, 2], K[1, 2]), coefficients, str(path))


def _matrix(storage: Any, names: tuple[str, ...]) -> Array | None:
    for name in names:
        node = storage.getNode(name)
        if node.isMap():
            return np.asarray(node.mat(), dtype=float)
        if node.isSeq():
            numbers = np.array([_numbers(node.at(k)) for k in range(node.size())], dtype=float)
            return numbers.reshape(3, 3) if numbers.size == 9 else numbers
    return None


def _numbers(node: Any) -> Any:
    return [node.at(k).real() for k in range(node.size())] if node.isSeq() else node.real()


def _size(storage: Any) -> tuple[float, float] | None:
    for width, height in zip(WIDTH, HEIGHT, strict=True):
        pair = storage.getNode(width), storage.getNode(height)
        if all(node.isInt() or node.isReal() for node in pair):
            return pair[0].real(), pair[1].real()
    for name in SIZE:
        node = storage.getNode(name)
        if node.isSeq() and node.size() == 2:
            return node.at(0).real(), node.at(1).real()
    return None
