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
    except (TypeError, ValueError, OverflowError) as error:
        raise InputError(f"no camera: {error}", where=where, needed="image size, fx fy cx cy, distortion") from error
    if not 0 <= coefficients.size <= 14:
        raise InputError(f"{coefficients.size} numbers of distortion", where=where, needed="OpenCV's 0, 4, 5, 8, 12 or 14")
    beyond = coefficients[8:]
    coefficients = coefficients[:8]
    count = next(count for count in MODELS if count >= coefficients.size)
    coefficients = np.pad(coefficients, (0, count - coefficients.size))
    if np.any(beyond):
        raise InputError(
            "a thin-prism or tilted sensor model",
            where=where,
            needed="at most k1 k2 p1 p2 k3 k4 k5 k6",
            todo="solve again: lpcal intrinsics",
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
        todo="solve the camera again: lpcal intrinsics, model: splined for a very wide lens",
    )


MOST_SIDE_PX = 200_000
"""Pixels along a side of the largest image that is believed."""


def sane_camera(camera: Camera, where: str) -> Camera:
    """The camera, which can be one.

    Raises
    ------
    InputError
        A focal length or a size that is not positive, a number that is not finite, or a K that is none.
    """
    width, height = camera.image_size
    fx, fy = camera.K[0, 0], camera.K[1, 1]
    whole = bool(np.isfinite(camera.K).all() and np.isfinite(camera.distortion).all())
    whole = whole and camera.K[1, 0] == 0 and np.allclose(camera.K[2], [0, 0, 1])
    splined = camera.spline is None or np.isfinite(camera.spline).all()
    if not (whole and splined and min(fx, fy) > 0 and min(width, height) > 0 and max(width, height) <= MOST_SIDE_PX):
        found = f"fx {fx:g}, fy {fy:g}, cx {camera.K[0, 2]:g}, cy {camera.K[1, 2]:g}, image {width}x{height}"
        raise InputError(
            found,
            where=where,
            needed="K = [fx 0 cx; 0 fy cy; 0 0 1], finite, focal lengths and sizes above zero",
            todo="is it the right file?",
        )
    return camera
