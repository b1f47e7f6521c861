"""Cameras, lights and calibrations that programs build, checked before anything is made of them, their lists and numbers made arrays.

What a reader of lpcal's makes is sound; of what a program makes, an axis convention, a vector that is not of length 1 or a matrix that is
transposed would come out as a wrong surface.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lpcal.errors import DisagreementError, InputError
from lpcal.geometry.arrays import Array
from lpcal.records import given
from lpcal.records.calibration import Calibration, Camera, Light
from lpcal.records.quantities import parse_gamma
from lpcal.records.sensor import StatedSensor

UNIT = 0.02
"""How far from 1 the length of a unit vector may be: vectors of two digits are taken for one."""
MODELS = {4: "opencv4", 5: "opencv5", 8: "opencv8"}
"""Lens models by how many coefficients they have: they nest, so that the count says which one is meant."""
ALSO = ("opencv", "pinhole", "radtan")
"""Names that other programs give to them."""


def calibration(found: Calibration, name: str = "calibration") -> Calibration:
    """A calibration with sound lights and a sound camera.

    Raises
    ------
    InputError
        It is none, or something in it is not what it should be.
    DisagreementError
        All its lights are distant and stand behind the object.
    """
    if not isinstance(found, Calibration):
        raise InputError(_kind(found), where=name, needed="a Calibration", todo="lpcal.read_calibration(path) reads one")
    lights = tuple(light(each, f"{name}.lights[{k}]") for k, each in enumerate(found.lights))
    if lights and all(each.source_C is None and each.direction_C[2] >= 0 for each in lights):
        raise DisagreementError(
            "every light stands behind the object (z of direction_C is 0 or more)",
            where=name,
            needed="directions in C: x right, y down, z forward, from the object to the light",
            todo="turn over the signs of y and z of directions that are x right, y up, z to the camera",
        )
    return replace(found, lights=lights, camera=None if found.camera is None else camera(found.camera, f"{name}.camera"))


def light(found: Light, name: str) -> Light:
    """A light whose vectors are of length 1 and whose intensities are above 0.

    Raises
    ------
    InputError
        They are not, or it is no light.
    """
    if not isinstance(found, Light):
        raise InputError(_kind(found), where=name, needed="a Light")
    intensity = np.atleast_1d(given.numbers(found.intensity, f"{name}.intensity"))
    if intensity.shape not in {(1,), (3,)} or not (intensity >= 0).all() or not intensity.any():
        raise InputError(f"{intensity.tolist()}", where=f"{name}.intensity", needed="one number above 0, or three of which one is")
    return replace(
        found,
        direction_C=_unit(found.direction_C, f"{name}.direction_C"),
        intensity=intensity,
        source_C=None if found.source_C is None else given.shaped(found.source_C, (3,), f"{name}.source_C"),
        axis_C=None if found.axis_C is None else _unit(found.axis_C, f"{name}.axis_C"),
    )


def _unit(vector: Array, name: str) -> Array:
    values = given.shaped(vector, (3,), name)
    length = float(np.linalg.norm(values))
    if abs(length - 1) > UNIT:
        raise InputError(f"a vector of length {length:.4g}", where=name, needed="length 1", todo="divide it by its length")
    return values


def camera(found: Camera, name: str = "camera") -> Camera:
    """A camera that can be projected with.

    Raises
    ------
    InputError
        Another lens model, a matrix that is no camera's, or a count of coefficients that no model has.
    """
    if not isinstance(found, Camera):
        raise InputError(_kind(found), where=name, needed="a Camera", todo="lpcal.read_camera(path) reads one")
    if found.model == "splined":
        return found
    if found.model not in {*MODELS.values(), *ALSO}:
        needed = f"{', '.join(MODELS.values())} or splined; a fisheye's images are to be undistorted first"
        raise InputError(repr(found.model), where=f"{name}.model", needed=needed)
    K, distortion = given.shaped(found.K, (3, 3), f"{name}.K"), given.numbers(found.distortion, f"{name}.distortion").ravel()
    if not np.allclose(K[2], [0, 0, 1]) or K[1, 0] != 0 or min(K[0, 0], K[1, 1]) <= 0:
        todo = "transpose it" if K[2, :2].any() and np.allclose(K[:, 2], [0, 0, 1]) else "focal lengths are above 0"
        raise InputError(f"{np.round(K, 3).tolist()}", where=f"{name}.K", needed="[[fx, s, cx], [0, fy, cy], [0, 0, 1]]", todo=todo)
    distortion = distortion if distortion.size else np.zeros(4)
    if distortion.size not in MODELS:
        needed = "none, 4, 5 or 8 in OpenCV's order: k1, k2, p1, p2, k3, ..."
        raise InputError(f"{distortion.size} coefficients", where=f"{name}.distortion", needed=needed)
    return replace(found, model=MODELS[distortion.size], K=K, distortion=distortion)


def sensor(found: object, name: str = "sensor") -> StatedSensor:
    """What is stated of a sensor, its gamma one that can be meant.

    Raises
    ------
    InputError
        It is no statement, or its gamma is none.
    """
    if not isinstance(found, StatedSensor):
        raise InputError(f"{found!r}"[:60], where=name, needed='what is stated, such as lpcal.StatedSensor(gamma="srgb")')
    try:
        return found if found.gamma is None else replace(found, gamma=parse_gamma(found.gamma))
    except ValueError as error:
        what, _, needed = str(error).partition("; ")
        raise InputError(what, where=f"{name}.gamma", needed=needed) from error


def lights(found: Sequence[Light], name: str = "lights") -> tuple[Light, ...]:
    """Sound lights. Raises as `light`."""
    return tuple(light(each, f"{name}[{k}]") for k, each in enumerate(found))


def _kind(found: object) -> str:
    return f"a {type(found).__name__}"
