"""handeye.yaml: the camera in the tracked body, the board in the room, the clock offset, and what became of each view.

- ``H_PC``, ``H_OB`` (4x4) and ``H_PC_covariance``, ``H_OB_covariance`` (6x6, rotation in rad then translation in m, of the left
  perturbation); ``H_PC`` takes camera coordinates to the body's, its last column is the camera's centre in the body's frame
- ``clock_offset_s``, ``clock_offset_std_s``: t_camera = t_mocap + offset; null where the data do not show it
- ``clock_drift_ppm``, ``clock_middle_s``: t_camera = t_mocap + offset + 1e-6 drift (t_camera - middle); 0 where the data show no drift
- ``views``: ``image, used, why`` (null where used), ``residual_px`` (corners, rms a coordinate), ``residual_m``, ``residual_deg``
  (the board seen through the measured body pose against H_OB), ``held_out_m`` (the same against the H_OB of a solve without the view)
- ``transforms``: H_PC, H_CP, H_OB, H_BO in the forms that other programs take

Where the body carries the board, before a camera that stands still, ``H_OC`` (the camera in the room) stands for ``H_PC`` and ``H_PB``
(the board on the body) for ``H_OB`` in all of it; the residuals are those of the board on the body.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.formats.document_numbers import covariance, number, rigid
from lpcal.formats.documents import read_record, write_document
from lpcal.formats.pasted_transforms import both_ways
from lpcal.formats.record_documents import document_of, known_record_of
from lpcal.records.calibration import NAMES, Carries, HandEye, ViewVerdict
from lpcal.records.evidence import HandEyeEvidence
from lpcal.records.provenance import Provenance

KIND = "handeye"


def write_handeye(path: Path, found: HandEye, provenance: Provenance, body: str = "panel") -> None:
    """Write handeye.yaml; `body` is the tracked body's name."""
    camera, board = found.names
    content = {
        camera: found.H_PC,
        f"{camera}_covariance": found.H_PC_covariance,
        board: found.H_OB,
        f"{board}_covariance": found.H_OB_covariance,
        "clock_offset_s": found.clock_offset_s,
        "clock_offset_std_s": found.clock_offset_std_s,
        "clock_drift_ppm": 1e6 * found.clock_drift,
        "clock_middle_s": found.clock_middle_s,
        "warnings": list(found.warnings),
        "transforms": both_ways(found.H_PC, found.H_OB, body, found.carries),
        "evidence": {} if found.evidence is None else document_of(found.evidence),
        "views": [_view(view) for view in found.views],
    }
    write_document(path, KIND, content, provenance)


def read_handeye(path: Path) -> HandEye:
    """Read handeye.yaml.

    Raises
    ------
    InputError
        Not there, cut off, of another kind, or a key that is lacking or holds no numbers.
    """
    return read_record(path, KIND, "lpcal handeye", handeye_from_document)


def handeye_from_document(document: dict[str, Any]) -> HandEye:
    """A hand-eye as written.

    Raises
    ------
    KeyError, TypeError, ValueError
        A key is lacking or holds something else; the message is the key's name.
    """
    carries: Carries = "board" if "H_OC" in document else "camera"
    camera, board = NAMES[carries]
    return HandEye(
        H_PC=rigid(document, camera),
        H_PC_covariance=covariance(document, f"{camera}_covariance", 6),
        H_OB=rigid(document, board),
        H_OB_covariance=covariance(document, f"{board}_covariance", 6),
        clock_offset_s=number(document, "clock_offset_s"),
        clock_offset_std_s=number(document, "clock_offset_std_s"),
        views=tuple(_verdict(view) for view in document["views"]),
        clock_drift=1e-6 * (number(document, "clock_drift_ppm") or 0.0),
        clock_middle_s=number(document, "clock_middle_s") or 0.0,
        warnings=tuple(document.get("warnings") or ()),
        evidence=known_record_of(HandEyeEvidence, document.get("evidence")),
        carries=carries,
        taken_offset_s=number(document, "clock_offset_s") or 0.0,
    )


def _view(view: ViewVerdict) -> dict[str, Any]:
    return {
        "image": view.image,
        "used": view.used,
        "why": view.why,
        "residual_px": view.residual_px,
        "residual_m": view.residual_m,
        "residual_deg": None if view.residual_rad is None else float(np.degrees(view.residual_rad)),
        "held_out_m": view.held_out_m,
    }


def _verdict(view: dict[str, Any]) -> ViewVerdict:
    degrees = view.get("residual_deg")
    return ViewVerdict(
        view["image"],
        view["used"],
        view["why"],
        view.get("residual_px"),
        view.get("residual_m"),
        None if degrees is None else float(np.radians(degrees)),
        held_out_m=view.get("held_out_m"),
    )
