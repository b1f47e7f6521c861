"""Cameras whose numbers stand by name, one each, and those of Metashape, numpy and MATLAB.

- Numbers by name, in JSON or YAML: ``fx fy cx cy`` (``ppx ppy`` of RealSense; ``fl_x fl_y`` of NeRF's transforms.json, whose first pixel's
  centre is at (0.5, 0.5) as COLMAP's), a width and a height, and k1 k2 p1 p2 k3 ... or a list of them.
- Metashape's calibration of one camera, alone or in a project's doc.xml: its p1 and p2 are OpenCV's p2 and p1, b1 is fx - fy, and cx and cy
  count from the middle. Source: its manual, appendix "Camera models".
- A .npz of numpy's, or a .mat: the matrix, the distortion and the size under the names that OpenCV's files have; fc, cc, kc, nx and ny of
  the Camera Calibration Toolbox for MATLAB, which counts pixels from 0; K (or IntrinsicMatrix, its transpose), RadialDistortion,
  TangentialDistortion and ImageSize of MATLAB's own cameraParameters, which count pixels from 1 and state rows before columns.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.camera_coefficients import central_camera, refuse_lens
from lpcal.formats.mat_file import read_matrices
from lpcal.formats.number_arrays import read_arrays
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera

if TYPE_CHECKING:
    from xml.etree import ElementTree as ET

HALF_PIXEL = 0.5
FIRST_PIXEL = np.array([[0, 0, 1.0], [0, 0, 1.0], [0, 0, 0]])
"""By how much MATLAB's camera matrices are larger than those of pixels counted from 0."""
FOCAL = (("fx", "fy"), ("fl_x", "fl_y"), ("f_x", "f_y"))
CENTRE = (("cx", "cy"), ("ppx", "ppy"), ("c_x", "c_y"))
SIDES = (("width", "height"), ("w", "h"), ("image_width", "image_height"))
COEFFICIENTS = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6")
"""As OpenCV orders them."""
LISTS = ("coeffs", "distortion", "distortion_coefficients", "distortion_coeffs", "dist_coeffs", "dist", "D")
LENS_KEYS = ("model", "distortion_model", "camera_model", "lens_model", "projection")
OTHER_LENSES = ("fish", "equi", "omni", "kannala", "inverse", "ftheta", "division", "fov", "eucm", "double", "spheric", "cylindric")
"""What names of lenses hold that lpcal does not project with."""


def refuse_other_lens(document: dict[str, Any], where: str, *, distorts: bool = True) -> None:
    """Refuse a document that names a lens which lpcal does not project with; one that does not distort is any lens.

    Raises
    ------
    InputError
        It does.
    """
    for key, value in document.items():
        name = str(key).lower()
        said = str(value[0] if isinstance(value, list) and len(value) == 1 else value).lower()
        if name in LENS_KEYS and distorts and any(word in said for word in OTHER_LENSES):
            raise refuse_lens(said, where)
        if "fisheye" in name and said not in {"0", "0.0", "false", "none", ""}:
            raise refuse_lens(name, where)


def is_named(document: dict[str, Any]) -> bool:
    """Whether a document names a focal length and a principal point by their components."""
    return _pair(document, FOCAL) is not None and _pair(document, CENTRE) is not None


def camera_from_names(document: dict[str, Any], path: Path) -> Camera:
    """The camera of a document.

    Raises
    ------
    InputError
        Another lens, no image size, or numbers that are none.
    """
    focal, centre, size = (_pair(document, names) for names in (FOCAL, CENTRE, SIDES))
    assert focal is not None
    assert centre is not None
    if size is None:
        raise InputError("no image size", where=str(path), needed="width and height, beside fx, fy, cx and cy", todo="add them")
    listed = next((document[name] for name in LISTS if name in document), None)
    lens = list(listed) if listed is not None else [document.get(name, 0.0) for name in COEFFICIENTS]
    while listed is None and len(lens) > 4 and not lens[-1]:
        lens.pop()
    lens += [0.0] * (8 - len(lens) if 5 < len(lens) < 8 else 0)
    refuse_other_lens(document, str(path), distorts=any(number not in {0, "0"} for number in lens))
    first = HALF_PIXEL if "fl_x" in document else 0.0
    return central_camera(size, (*focal, float(centre[0]) - first, float(centre[1]) - first), lens, str(path))


def _pair(document: dict[str, Any], names: tuple[tuple[str, str], ...]) -> tuple[Any, Any] | None:
    return next(((document[one], document[other]) for one, other in names if one in document and other in document), None)


def metashape_calibration(root: ET.Element) -> ET.Element | None:
    """Metashape's calibration in a document; None where there is none. Of a sensor's own and the adjusted one it is the adjusted one."""
    found = [one for one in root.iter("calibration") if one.find("f") is not None]
    return next((one for one in reversed(found) if one.get("class") == "adjusted"), found[-1] if found else None)


def camera_from_metashape(root: ET.Element, path: Path) -> Camera:
    """The camera of Metashape's calibration of a frame camera.

    Raises
    ------
    InputError
        Another projection, coefficients that lpcal's models have not, or several sensors.
    """
    sensors = [one.get("label") or one.get("id") or "?" for one in root.iter("sensor") if metashape_calibration(one) is not None]
    if len(sensors) > 1:
        found = f"{len(sensors)} cameras: {', '.join(sensors)}"
        raise InputError(found, where=str(path), needed="one camera", todo="Tools, Camera Calibration, Save: a file of one")
    held = metashape_calibration(root)
    if held is None:
        raise InputError("no calibration of Metashape's", where=str(path), needed="its focal length <f>")
    kind = held.findtext("projection") or held.get("type") or "frame"
    if kind != "frame":
        raise refuse_lens(kind, str(path))

    def value(name: str) -> float:
        return float(held.findtext(name) or 0.0)

    if value("k4") or value("b2"):
        needed = "a calibration with k4 and b2 left at zero"
        raise InputError("k4 or b2, which lpcal's lens models have not", where=str(path), needed=needed)
    resolution = held.find("resolution")
    sides = [resolution.get(side) if resolution is not None else held.findtext(side) for side in ("width", "height")]
    width, height = (int(side or 0) for side in sides)
    core = (value("f") + value("b1"), value("f"), value("cx") + width / 2 - HALF_PIXEL, value("cy") + height / 2 - HALF_PIXEL)
    return central_camera((width, height), core, [value(name) for name in ("k1", "k2", "p2", "p1", "k3")], str(path))


def arrays_of(path: Path) -> dict[str, Any]:
    """The arrays of a .npz or .mat by name, those of MATLAB's toolboxes as OpenCV's files name and order them.

    Raises
    ------
    InputError
        Not readable.
    """
    arrays = read_matrices(path) if path.suffix.lower() == ".mat" else _of_npz(path)
    if {"fc", "cc"} <= arrays.keys():
        (fx, fy), (cx, cy) = (arrays[name].ravel()[:2] for name in ("fc", "cc"))
        skew = float(arrays["alpha_c"].ravel()[0]) * fx if "alpha_c" in arrays else 0.0
        arrays |= {"K": np.array([[fx, skew, cx], [0, fy, cy], [0, 0, 1.0]]), "distortion": arrays.get("kc", np.zeros(5))}
        arrays |= {to: arrays[name] for name, to in (("nx", "width"), ("ny", "height")) if name in arrays}
    if "RadialDistortion" in arrays and {"IntrinsicMatrix", "K"} & arrays.keys():
        K = arrays["K"] if "K" in arrays else arrays["IntrinsicMatrix"].T
        radial = np.pad(arrays.pop("RadialDistortion").ravel(), (0, 3))[:3]
        tangential = np.pad(arrays.pop("TangentialDistortion", np.zeros(2)).ravel(), (0, 2))[:2]
        arrays |= {"K": K - FIRST_PIXEL, "distortion": np.array([*radial[:2], *tangential, radial[2]])}
    if "ImageSize" in arrays:
        arrays["image_size"] = arrays["ImageSize"].ravel()[::-1]
    return {name: value.ravel().tolist() if value.size > 1 else float(value.ravel()[0]) for name, value in arrays.items() if value.size}


def _of_npz(path: Path) -> dict[str, Array]:
    held = read_arrays(path, "a .npz of arrays of numbers")
    arrays = held if isinstance(held, dict) else {"K": held}
    return {name: np.asarray(value, float) for name, value in arrays.items() if value.dtype.kind in "iuf"}
