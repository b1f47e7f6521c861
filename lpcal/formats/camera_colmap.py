"""COLMAP's cameras.txt and cameras.bin; its first pixel's centre is at (0.5, 0.5), so half a pixel is taken from the principal point.

Text: a line a camera, ``CAMERA_ID MODEL WIDTH HEIGHT PARAMS...``. Binary: their count, then id, model, width, height, parameters each.
Source: COLMAP's documentation, "Output format"; models and their parameters by pycolmap.
"""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any

from lpcal.errors import InputError
from lpcal.formats.camera_coefficients import central_camera, refuse_lens
from lpcal.formats.reading import reader
from lpcal.geometry.colmap import load_pycolmap
from lpcal.records.calibration import Camera

HALF_PIXEL = 0.5


def is_colmap(text: str) -> bool:
    """Whether a text is a cameras.txt: its first line that is no remark names a model after a number."""
    words = next((line.split() for line in text.splitlines() if line.strip() and not line.startswith("#")), [])
    return len(words) >= 5 and words[0].isdigit() and words[1].isupper() and words[2].isdigit() and words[3].isdigit()


@reader("COLMAP's cameras, whole")
def read_colmap_camera(path: Path) -> Camera:
    """Read the one camera of a cameras.txt or cameras.bin.

    Raises
    ------
    InputError
        Garbled, several cameras, or a lens that lpcal does not project with.
    """
    pycolmap = load_pycolmap()

    try:
        cameras = _binary(path.read_bytes()) if path.suffix == ".bin" else _text(path.read_text(encoding="utf-8"))
        if len(cameras) != 1:
            raise InputError(f"{len(cameras)} cameras", where=str(path), needed="one camera", todo="keep one of them, in a file of its own")
        model, width, height, params = cameras[0]
        _refuse_model(model if isinstance(model, str) else model.name, params, path)
        camera = pycolmap.Camera(model=model, width=width, height=height, params=params)
    except (struct.error, UnicodeDecodeError, ValueError, IndexError, AttributeError, TypeError) as error:
        raise InputError(
            f"cannot be read as COLMAP's cameras: {error}", where=str(path), needed="a whole file", todo="is it cut off?"
        ) from error
    core = (camera.focal_length_x, camera.focal_length_y, camera.principal_point_x - HALF_PIXEL, camera.principal_point_y - HALF_PIXEL)
    return central_camera((width, height), core, params[DISTORTION_FIRST[camera.model.name] :], str(path))


PARAMETERS = {"SIMPLE_PINHOLE": 3, "PINHOLE": 4, "SIMPLE_RADIAL": 4, "RADIAL": 5, "OPENCV": 8, "FULL_OPENCV": 12}
"""How many parameters a model has."""
DISTORTION_FIRST = {"SIMPLE_PINHOLE": 3, "PINHOLE": 4, "SIMPLE_RADIAL": 3, "RADIAL": 3, "OPENCV": 4, "FULL_OPENCV": 4}
"""Where the distortion begins among a model's parameters; what it holds is the beginning of OpenCV's vector."""


def _refuse_model(name: str, params: list[float], path: Path) -> None:
    """Refuse what is no model that lpcal projects with, or lacks parameters."""
    if name not in PARAMETERS:
        raise refuse_lens(name, str(path))
    if len(params) != PARAMETERS[name]:
        raise InputError(f"{len(params)} parameters", where=str(path), needed=f"{PARAMETERS[name]} of {name}", todo="is it cut off?")


def _text(text: str) -> list[tuple[str, int, int, list[float]]]:
    lines = [line.split() for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return [(words[1], int(words[2]), int(words[3]), [float(word) for word in words[4:]]) for words in lines]


def _binary(data: bytes) -> list[tuple[Any, int, int, list[float]]]:
    pycolmap = load_pycolmap()

    (count,) = struct.unpack_from("<Q", data, 0)
    if count != 1:
        found = f"{count} cameras: one is needed, in a file of its own"
        raise ValueError(found)
    place, cameras = 8, []
    for _ in range(min(count, 2)):
        _, number, width, height = struct.unpack_from("<iiQQ", data, place)
        model = pycolmap.CameraModelId(number)
        size = len(pycolmap.Camera.create_from_model_id(1, model, 1.0, 1, 1).params)
        params = list(struct.unpack_from(f"<{size}d", data, place + 24))
        place += 24 + 8 * size
        cameras.append((model, width, height, params))
    return cameras
