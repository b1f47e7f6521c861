"""``lpcal intrinsics --compare OTHER``: how far another calibration projects from this one, in pixels.

Symbols: p a pixel of this camera, d(p) how far the other camera puts the ray of p from p, a turn of the camera taken out or not. The turn
is fitted over the part of the imager that is looked at; rays are at infinity. See `geometry.camera_difference`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import DisagreementError
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.camera_yaml import read_camera, read_camera_solution
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.camera_difference import pixel_grid, projection_difference
from lpcal.pipeline.workspace import Workspace
from lpcal.records.calibration import Camera
from lpcal.records.outcome import Outcome

INVERTED_PX = 1e-3
"""A pixel whose ray does not project back to it this closely lies where the lens cannot be inverted, and is left out; so is one
that the other camera puts outside all bounds."""


def compare(workspace: Workspace, other: Path) -> Outcome:
    """The rig's camera.yaml against a camera in any format that lpcal reads.

    Raises
    ------
    InputError
        Either is not there or cannot be read.
    DisagreementError
        Their images are of two sizes.
    """
    path = workspace.calib("camera.yaml")
    own, foreign = read_camera(path), read_camera_file(other)
    if own.image_size != foreign.image_size:
        raise DisagreementError(
            "a camera of {}x{} pixels; this rig's has {}x{}".format(*foreign.image_size, *own.image_size),
            where=str(other),
            needed="two calibrations of one camera, at one image size",
            todo="compare with the calibration of the same images",
        )
    pixels = pixel_grid(own.image_size)
    covered = _covered(path, pixels)
    document: dict[str, Any] = {"other": str(other), "imager": _measures(own, foreign, pixels)}
    if covered.any() and not covered.all():
        document["where_corners_are"] = _measures(own, foreign, pixels[covered])
    document["expected_px"] = _expected(path)
    return Outcome(summary=_lines(document, other), document=document)


def _measures(own: Camera, foreign: Camera, pixels: Array) -> dict[str, Any]:
    """Rms and worst (px), the turn taken out (deg), and both without that turn, over pixels (N, 2)."""
    rays_C = own.unproject(pixels)
    good = np.linalg.norm(own.project(rays_C) - pixels, axis=1) < INVERTED_PX
    good &= np.linalg.norm(foreign.project(rays_C) - pixels, axis=1) < float(np.hypot(*own.image_size))
    if not good.any():
        raise DisagreementError(
            "no ray of this rig's camera lands in the other's image",
            where="--compare",
            needed="two calibrations of one camera",
            todo="compare with the calibration of the same images",
        )
    pixels, rays_C = pixels[good], rays_C[good]
    straight = np.linalg.norm(foreign.project(rays_C) - pixels, axis=1)
    difference, turn = projection_difference(pixels, rays_C, foreign.project)
    apart = np.linalg.norm(difference, axis=1)
    worst = int(apart.argmax())
    return {
        "rms_px": float(np.sqrt(np.mean(apart**2))),
        "worst_px": float(apart[worst]),
        "worst_at_px": pixels[worst],
        "turn_deg": float(np.degrees(np.linalg.norm(turn))),
        "rms_without_turn_px": float(np.sqrt(np.mean(straight**2))),
        "worst_without_turn_px": float(straight.max()),
        "left_out_share": float(1 - good.mean()),
    }


def _covered(path: Path, pixels: Array) -> Mask:
    """The pixels near a place of camera.yaml's grid that corners cover; none where it has no grid."""
    sure = read_camera_solution(path).evidence.projection_uncertainty
    if sure is None:
        return np.zeros(len(pixels), dtype=bool)
    column = np.abs(pixels[:, :1] - sure.columns_px).argmin(axis=1)
    row = np.abs(pixels[:, 1:] - sure.rows_px).argmin(axis=1)
    return np.asarray(sure.covered[row, column])


def _expected(path: Path) -> float | None:
    """What this camera's own sigma makes of it, rms where corners are."""
    sure = read_camera_solution(path).evidence.projection_uncertainty
    return None if sure is None else sure.rms_px


def _lines(document: dict[str, Any], other: Path) -> list[str]:
    lines = [f"compared    calib/camera.yaml with {other}"]
    for key, label in (("imager", "imager"), ("where_corners_are", "corners")):
        if key in document:
            found = document[key]
            at = "({:.0f}, {:.0f})".format(*found["worst_at_px"])
            lines.append(f"{label:<12}{found['rms_px']:.4f} px rms, {found['worst_px']:.4f} px worst at {at}")
            lines.append(
                f"            after a turn of {found['turn_deg']:.4f} deg; without it {found['rms_without_turn_px']:.3f} px rms, "
                f"{found['worst_without_turn_px']:.3f} px worst"
            )
    if document["expected_px"] is not None:
        where = document.get("where_corners_are") or document["imager"]
        ratio = where["rms_px"] / max(document["expected_px"], 1e-12)
        lines.append(
            f"expected    {document['expected_px']:.4f} px rms where corners are, by its own sigma: it is there {ratio:.1f} times it"
        )
    return lines
