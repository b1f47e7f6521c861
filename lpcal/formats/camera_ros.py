"""ROS: the yaml of camera_calibration (image_width, camera_matrix.data, ...) and a printed sensor_msgs/CameraInfo (width, K or k, D or d).

``distortion_model`` plumb_bob and rational_polynomial are OpenCV's; K and D hold the raw image, so the projection matrix P is not used.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from lpcal.errors import InputError
from lpcal.formats.camera_coefficients import central_camera, refuse_lens
from lpcal.records.calibration import Camera

LENSES = ("plumb_bob", "rational_polynomial", "")


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
    if lens not in LENSES:
        raise refuse_lens(lens, str(path))
    try:
        K = _data(document, "camera_matrix", "K", "k")
        size = document.get("image_width", document.get("width")), document.get("image_height", document.get("height"))
        return central_camera(size, (K[0], K[4], K[2], K[5]), _data(document, "distortion_coefficients", "D", "d"), str(path))
    except (KeyError, IndexError, TypeError) as error:
        raise InputError(f"{error} is lacking or garbled", where=str(path), needed="a whole ROS camera file") from error


def _data(document: dict[str, Any], *names: str) -> list[Any]:
    entry = next((document[name] for name in names if name in document), None)
    if entry is None:
        raise KeyError(names[0])
    return list(entry["data"] if isinstance(entry, dict) else entry)
