"""What all files of cameras end in: an image size, K, and OpenCV's distortion vector."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from lpcal.errors import InputError
from lpcal.records.calibration import Camera

MODELS = {4: "opencv4", 5: "opencv5", 8: "opencv8"}


def central_camera(image_size: Sequence[Any], core: Sequence[Any], distortion: Sequence[Any], where: str) -> Camera:
    """The camera of (width, height), (fx, fy, cx, cy) and k1 k2 p1 p2 [k3 [k4 k5 k6 [thin prism, tilt]]].

    Raises
    ------
    InputError
        A number is lacking or not finite, or a coefficient that lpcal does not project with is not zero.
    """
    try:
        width, height = (int(side) for side in image_size)
        fx, fy, cx, cy = (float(number) for number in core)
        coefficients = np.array([float(number) for number in distortion])
    except (TypeError, ValueError) as error:
        raise InputError(f"no camera: {error}", where=where, needed="image size, fx fy cx cy, distortion") from error
    beyond = coefficients[8:]
    coefficients = coefficients[:8]
    count = next(count for count in MODELS if count >= coefficients.size)
    coefficients = np.pad(coefficients, (0, count - coefficients.size))
    if np.any(beyond):
        raise InputError(
            "a thin-prism or tilted sensor model",
            where=where,
            needed="at most k1 k2 p1 p2 k3 k4 k5 k6",
            todo="solve anew: lpcal intrinsics",
        )
    if not (np.isfinite([fx, fy, cx, cy]).all() and np.isfinite(coefficients).all() and min(width, height, fx, fy) > 0):
        raise InputError(f"fx fy cx cy {core}, image {width}x{height}", where=where, needed="finite numbers, sizes above zero")
    return Camera((width, height), MODELS[count], np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1.0]]), coefficients)


def refuse_lens(model: str, where: str) -> InputError:
    """The error for a lens model that lpcal does not project with."""
    return InputError(
        f"lens model {model!r}",
        where=where,
        needed="pinhole with radial-tangential (OpenCV) distortion, or mrcal's splined model",
        todo="solve the camera anew: lpcal intrinsics, model: splined for a very wide lens",
    )
