"""What all files of cameras end in: an image size, K, and OpenCV's distortion vector."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from lpcal.errors import InputError
from lpcal.records.calibration import Camera

MODELS = {4: "opencv4", 5: "opencv5", 8: "opencv8"}
COUNTS = (0, 1, 2, 4, 5, 8, 12, 14)
"""How many numbers OpenCV's distortion may have, and COLMAP's, which are k1 or k1 k2; three could be k1 k2 k3 as well as k1 k2 p1."""
SKEW_PX = 0.1
"""Skew, pixels, from which a matrix's axes are not taken as square: at the image's edge it is then of the size of a corner's error."""


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
    if coefficients.size not in COUNTS:
        raise InputError(
            f"{coefficients.size} numbers of distortion",
            where=where,
            needed="OpenCV's k1 k2 p1 p2 [k3 [k4 k5 k6]]: 0, 4, 5, 8, 12 or 14",
            todo="put them into that order, with zeros for those that were not solved for",
        )
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


def core_of(K: Sequence[Any], where: str) -> tuple[float, float, float, float]:
    """fx, fy, cx, cy of a camera matrix, its nine numbers row by row.

    Raises
    ------
    InputError
        It is transposed, skew, or none.
    """
    try:
        matrix = np.array([float(number) for number in K]).reshape(3, 3)
    except (TypeError, ValueError, OverflowError) as error:
        raise InputError(f"no camera matrix: {error}", where=where, needed="nine numbers, row by row") from error
    if not matrix[:2, 2].any() and matrix[2, :2].any():
        raise InputError(
            "the camera matrix is transposed",
            where=where,
            needed="[fx 0 cx; 0 fy cy; 0 0 1], row by row",
            todo="write its transpose (MATLAB's IntrinsicMatrix is one, and counts pixels from 1: take 1 off cx and cy)",
        )
    if abs(matrix[0, 1]) > SKEW_PX:
        needed = "pixels whose rows and columns are at right angles"
        raise InputError(f"a skew of {matrix[0, 1]:g} px", where=where, needed=needed, todo="calibrate anew without skew")
    return float(matrix[0, 0]), float(matrix[1, 1]), float(matrix[0, 2]), float(matrix[1, 2])


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
    if camera.spline is None and min(fx, fy) < LEAST_FOCAL * max(width, height):
        raise InputError(
            f"a focal length of {min(fx, fy):.3g} in an image of {width}x{height}: less than any lens has, in pixels",
            where=where,
            needed="fx, fy, cx and cy in pixels",
            todo="divide millimetres by a pixel's width; multiply shares of the width by it",
        )
    _refuse_centre(camera, where)
    return camera


LEAST_FOCAL = 0.05
"""Least focal length as a share of the larger side: a lens without distortion then sees 168 degrees."""
NEAR_MIDDLE, OFF_MIDDLE = 0.05, 0.15
"""Shares of the sides by which a principal point is near the middle, as those of nearly all cameras are, or clearly off it."""


def _refuse_centre(camera: Camera, where: str) -> None:
    """Refuse a principal point out of the image, or one that is in the middle if width and height are exchanged, and only then."""
    sides, centre = np.array(camera.image_size, float), camera.K[:2, 2]
    off, exchanged = (np.abs((centre + 0.5) / size - 0.5) for size in (sides, sides[::-1]))
    portrait = bool(np.all(exchanged < NEAR_MIDDLE) and np.all(off > OFF_MIDDLE))
    if np.all(off < 0.5) and not portrait:
        return
    raise InputError(
        f"a principal point at {centre[0]:g}, {centre[1]:g} in an image of {camera.image_size[0]}x{camera.image_size[1]}",
        where=where,
        needed="cx and cy in pixels, within an image of width x height",
        todo="exchange width and height"
        if portrait
        else "is it the right file, of images of this size, and are cx and cy in their places?",
    )
