"""camera.yaml: the intrinsics, how sure they are, how they were chosen, and what became of each view.

``image_size: [w, h], model, K, distortion, black_level, gamma, rms_px`` (a coordinate), ``parameters: [fx, fy, ...]`` and their
``covariance`` in that order, ``views: [{image, used, why, corners, rms_px}]`` (``why`` is null where used, ``corners`` a count); beside
them ``white_level``, ``flat_field`` (Chebyshev coefficients of the logarithm of the response), ``solver``, ``corner_sigma_px``,
``evidence``, ``warnings``, and for a splined camera ``lensmodel`` and ``spline``, whose K is that of its stereographic core. ``camera:``
in calibration.yaml has the keys that make images.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.formats.camera_coefficients import sane_camera
from lpcal.formats.document_numbers import covariance, number, numbers, sigma
from lpcal.formats.documents import read_record, write_document
from lpcal.formats.record_documents import document_of, record_of
from lpcal.formats.sensor_document import sensor_from_document
from lpcal.records.calibration import Camera, CameraSolution, ViewVerdict
from lpcal.records.evidence import CameraEvidence
from lpcal.records.provenance import Provenance
from lpcal.records.sensor import PLAIN

KIND = "camera"
COEFFICIENTS = {"opencv4": 4, "opencv5": 5, "opencv8": 8, "splined": -1}
"""How many numbers of distortion each model has."""


def write_camera(path: Path, solution: CameraSolution, provenance: Provenance) -> None:
    """Write camera.yaml."""
    camera = solution.camera
    body = camera_document(camera) | {
        "rms_px": camera.rms_px,
        "parameters": list(camera.parameters),
        "covariance": camera.covariance,
        "corner_sigma_px": solution.corner_sigma_px,
        "solver": solution.solver,
        "evidence": document_of(solution.evidence),
        "warnings": list(solution.warnings),
        "views": [_view(view) for view in solution.views],
    }
    write_document(path, KIND, body, provenance)


def read_camera(path: Path) -> Camera:
    """Read the camera of a camera.yaml.

    Raises
    ------
    InputError
        Not there, cut off, of another kind, or a key that is lacking or holds no numbers.
    """
    return sane_camera(read_record(path, KIND, "lpcal intrinsics", camera_from_document), str(path))


def read_camera_solution(path: Path) -> CameraSolution:
    """Read the camera of a camera.yaml with what became of each view and what it rests on; the board's shape stands in H_CB.yaml.

    Raises
    ------
    InputError
        As `read_camera`.
    """
    return read_record(path, KIND, "lpcal intrinsics", solution_from_document)


def solution_from_document(document: dict[str, Any]) -> CameraSolution:
    """A solved or given camera as it was written.

    Raises
    ------
    KeyError, TypeError, ValueError
        As `camera_from_document`.
    """
    return CameraSolution(
        camera=camera_from_document(document),
        points_B=np.zeros((0, 3)),
        views=tuple(_verdict(view) for view in document["views"]),
        solver=document.get("solver") or "",
        corner_sigma_px=sigma(document, "corner_sigma_px"),
        evidence=record_of(CameraEvidence, document.get("evidence") or {}),
        warnings=tuple(document.get("warnings") or ()),
    )


def camera_document(camera: Camera) -> dict[str, Any]:
    """What makes images of a camera, as it is written."""
    document: dict[str, Any] = {
        "image_size": list(camera.image_size),
        "model": camera.model,
        "K": camera.K,
        "distortion": camera.distortion,
        "black_level": camera.black_level,
        "white_level": camera.white_level,
        "gamma": camera.gamma,
    }
    if camera.size_guessed:
        document["image_size_guessed"] = True
    if camera.flat_field is not None:
        document["flat_field"] = camera.flat_field.coefficients
    if camera.spline is not None:
        document |= {"lensmodel": camera.lensmodel, "spline": camera.spline}
    return document


def camera_from_document(document: dict[str, Any]) -> Camera:
    """A camera as it was written, in camera.yaml or in calibration.yaml.

    Raises
    ------
    KeyError, TypeError, ValueError
        A key is lacking or holds no numbers of the right count; the message is the key's name.
    """
    if document["model"] not in COEFFICIENTS:
        raise ValueError("model")
    width, height = (int(side) for side in numbers(document, "image_size", 2))
    parameters = tuple(document.get("parameters") or ())
    spline = document.get("spline")
    if document["model"] == "splined" and spline is None:
        raise KeyError("spline")
    sensor = sensor_from_document(document).onto(PLAIN)
    return Camera(
        image_size=(width, height),
        model=document["model"],
        K=numbers(document, "K", 3, 3),
        distortion=numbers(document, "distortion", COEFFICIENTS[document["model"]]),
        gamma=sensor.gamma,
        black_level=sensor.black_level,
        white_level=sensor.white_level,
        flat_field=sensor.flat_field,
        rms_px=sigma(document, "rms_px"),
        parameters=parameters,
        covariance=None if document.get("covariance") is None else covariance(document, "covariance", len(parameters)),
        lensmodel=document.get("lensmodel", ""),
        spline=None if spline is None else numbers(document, "spline", -1),
        size_guessed=document.get("image_size_guessed") is True,
    )


def _view(view: ViewVerdict) -> dict[str, Any]:
    return {
        "image": view.image,
        "used": view.used,
        "why": view.why,
        "corners": view.corners,
        "rejected": view.rejected,
        "rms_px": view.residual_px,
        "blur_px": view.blur_px,
        "glare": view.glare,
    }


def _verdict(view: dict[str, Any]) -> ViewVerdict:
    return ViewVerdict(
        view["image"],
        view["used"],
        view["why"],
        residual_px=number(view, "rms_px"),
        corners=int(view["corners"]),
        rejected=int(view.get("rejected") or 0),
        blur_px=number(view, "blur_px"),
        glare=number(view, "glare"),
    )
