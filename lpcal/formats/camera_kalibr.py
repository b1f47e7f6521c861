"""Kalibr's camchain.yaml (cam0: camera_model, intrinsics, distortion_model, ...) and the flat sensor.yaml of EuRoC with the same keys.

Source: Kalibr's wiki, "yaml formats"; radtan is OpenCV's k1 k2 p1 p2.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from lpcal.errors import InputError
from lpcal.formats.camera_coefficients import central_camera, refuse_lens
from lpcal.records.calibration import Camera

LENSES = ("radtan", "radial-tangential", "plumb_bob", "none", "")


def is_kalibr(document: dict[str, Any]) -> bool:
    """Whether a YAML document is of this form."""
    return "camera_model" in document or any(isinstance(entry, dict) and "camera_model" in entry for entry in document.values())


def camera_from_kalibr(document: dict[str, Any], path: Path) -> Camera:
    """The one camera of a document.

    Raises
    ------
    InputError
        Several cameras, a lens that is not pinhole with radial-tangential distortion, or a number that is lacking.
    """
    if "camera_model" not in document:
        names = [name for name, entry in document.items() if isinstance(entry, dict) and "camera_model" in entry]
        if len(names) > 1:
            raise InputError(
                f"{len(names)} cameras: {', '.join(names)}",
                where=str(path),
                needed="one camera",
                todo="keep one of them, in a file of its own",
            )
        document = document[names[0]]
    lens = str(document.get("distortion_model") or "")
    if document["camera_model"] != "pinhole" or lens not in LENSES:
        raise refuse_lens(f"{document['camera_model']} {lens}", str(path))
    try:
        distortion = document.get("distortion_coeffs", document.get("distortion_coefficients", []))
        return central_camera(document["resolution"], document["intrinsics"], distortion, str(path))
    except KeyError as error:
        raise InputError(f"the key {error} is lacking", where=str(path), needed="a whole Kalibr camera file") from error
