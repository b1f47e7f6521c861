"""H_CB.yaml: the board in every image of ``camera.images`` and ``mocap.images``, with the corners it comes from.

- ``board``: ``corners`` [nx, ny], and ``points_m`` (nx*ny, 3) in B, x first, bowed as found, their mean plane z = 0
- ``corner_sigma_px``: one standard deviation of a corner coordinate
- ``views``, one an image: ``image, used, why, H_CB`` (null where no board), ``covariance`` (6, 6, rotation then translation, of the left
  perturbation, the camera taken as exact), ``rms_px`` a coordinate, ``corners_px`` (nx*ny, 2), [null, null] where not seen or rejected
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.formats.document_numbers import covariance, numbers, rigid
from lpcal.formats.documents import read_record, write_document
from lpcal.geometry.arrays import Array
from lpcal.records.observations import BoardPoses
from lpcal.records.provenance import Provenance

KIND = "H_CB"


def write_h_cb(path: Path, poses: BoardPoses, left_out: dict[str, str], corners: tuple[int, int], provenance: Provenance) -> None:
    """Write H_CB.yaml; `left_out` are the images without a pose, and why."""
    found = [_view(poses, row) for row in range(len(poses.images))]
    lacking = [
        {"image": image, "used": False, "why": why, "H_CB": None, "covariance": None, "rms_px": None, "corners_px": None}
        for image, why in left_out.items()
    ]
    body = {
        "board": {"corners": list(corners), "points_m": poses.points_B},
        "corner_sigma_px": poses.corner_sigma_px,
        "views": found + lacking,
    }
    write_document(path, KIND, body, provenance)


def read_h_cb(path: Path) -> BoardPoses:
    """Board poses of the images in which the board was found; no times.

    Raises
    ------
    InputError
        Not there, cut off, of another kind, or garbled.
    """
    return read_record(path, KIND, "lpcal intrinsics", h_cb_from_document)


def h_cb_from_document(document: dict[str, Any]) -> BoardPoses:
    """Board poses as written.

    Raises
    ------
    KeyError, TypeError, ValueError
        A key is lacking or holds something else; the message is the key's name.
    """
    views = [view for view in document["views"] if view["H_CB"] is not None]
    points_B = numbers(document["board"], "points_m", -1, 3) if document["board"]["points_m"] else None
    return BoardPoses(
        images=tuple(view["image"] for view in views),
        t_camera_s=None,
        H_CB=_stack([rigid(view, "H_CB") for view in views], (4, 4)),
        corners_px=_stack([view["corners_px"] for view in views], (0 if points_B is None else len(points_B), 2)),
        points_B=points_B,
        covariance=_stack([covariance(view, "covariance", 6) for view in views], (6, 6)),
        rms_px=np.array([numbers(view, "rms_px") for view in views]),
        corner_sigma_px=float(numbers(document, "corner_sigma_px")),
    )


def _view(poses: BoardPoses, row: int) -> dict[str, Any]:
    return {
        "image": poses.images[row],
        "used": True,
        "why": None,
        "H_CB": poses.H_CB[row],
        "covariance": None if poses.covariance is None else poses.covariance[row],
        "rms_px": None if poses.rms_px is None else poses.rms_px[row],
        "corners_px": None if poses.corners_px is None else np.round(poses.corners_px[row], 4),
    }


def _stack(entries: list[Any], shape: tuple[int, ...]) -> Array:
    return np.array(entries, dtype=float).reshape(len(entries), *shape)
