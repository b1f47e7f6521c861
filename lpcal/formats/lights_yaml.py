"""lights.yaml: the refined lights, as in calibration.yaml, and what they rest on.

``focus_m, d_object_m, H_CD, lights: [...], spheres: [{name, kind, centre_m, radius_m, used, why, directions: {L0: [..]}, residual,
image_size, outline_px, highlights_px: {L0: [..]}, outline_sigma_px, highlight_sigma_px: {L0: ..}}], warnings, evidence``; a sphere's
residual is the rms of its highlights in px (chrome) or of its shading as a fraction (matte); outline and highlights are those found in the
images, with the scatter of the one's points and the standard deviation of the others.
With covariances of left perturbations: ``H_CD_covariance``; ``H_PD, H_PD_covariance`` where the panel is tracked and no markers say it;
with ``joint_solve`` also ``H_PC, H_PC_covariance`` and ``camera``, which then stand in calibration.yaml; left out otherwise.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.formats.calibration_yaml import light_document, light_from_document
from lpcal.formats.camera_yaml import camera_document, camera_from_document
from lpcal.formats.document_numbers import covariance, number, numbers, rigid, sigma
from lpcal.formats.documents import read_record, write_document
from lpcal.formats.light_tables import sane_lights
from lpcal.formats.record_documents import document_of, record_of
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration, LightsSolution, SphereFinding
from lpcal.records.evidence import LightsEvidence
from lpcal.records.provenance import Provenance

KIND = "lights"


def write_lights(path: Path, solution: LightsSolution, provenance: Provenance) -> None:
    """Write lights.yaml."""
    body = {
        "focus_m": solution.focus_C,
        "d_object_m": solution.d_object_m,
        "H_CD": solution.H_CD,
        "H_CD_covariance": solution.H_CD_covariance,
        "lights": [light_document(light) for light in solution.lights],
        "spheres": [
            {
                "name": sphere.name,
                "kind": sphere.kind,
                "centre_m": sphere.centre_C,
                "radius_m": sphere.radius_m,
                "used": sphere.used,
                "why": sphere.why,
                "directions": sphere.directions_C,
                "residual": sphere.residual,
                "image_size": sphere.image_size,
                "outline_px": sphere.outline_px,
                "highlights_px": sphere.highlights_px,
                "outline_sigma_px": sphere.outline_sigma_px,
                "highlight_sigma_px": sphere.highlight_sigma_px,
            }
            for sphere in solution.spheres
        ],
        "warnings": solution.warnings,
        "evidence": document_of(solution.evidence),
    }
    found = {
        "H_PC": solution.H_PC,
        "H_PC_covariance": solution.H_PC_covariance,
        "H_PD": solution.H_PD,
        "H_PD_covariance": solution.H_PD_covariance,
        "camera": None if solution.camera is None else camera_document(solution.camera),
    }
    write_document(path, KIND, body | {key: value for key, value in found.items() if value is not None}, provenance)


def read_lights(path: Path) -> LightsSolution:
    """Read lights.yaml.

    Raises
    ------
    InputError
        Not there, cut off, of another kind, or garbled.
    """
    found = read_record(path, KIND, "lpcal refine", lights_from_document)
    sane_lights(Calibration(path.stem, found.lights), str(path))
    return found


def _size(entry: dict[str, Any]) -> tuple[int, int]:
    width, height = numbers(entry, "image_size", 2)
    return int(width), int(height)


def lights_from_document(document: dict[str, Any]) -> LightsSolution:
    """The refined lights as written.

    Raises
    ------
    KeyError, TypeError, ValueError
        A key is lacking or holds something else; the message is the key's name.
    """

    def matrix(key: str) -> Array | None:
        if document.get(key) is None:
            return None
        return covariance(document, key, 6) if key.endswith("covariance") else rigid(document, key)

    return LightsSolution(
        lights=tuple(light_from_document(entry) for entry in document["lights"]),
        focus_C=numbers(document, "focus_m", 3),
        d_object_m=number(document, "d_object_m"),
        H_CD=matrix("H_CD"),
        H_CD_covariance=matrix("H_CD_covariance"),
        H_PC=matrix("H_PC"),
        H_PC_covariance=matrix("H_PC_covariance"),
        H_PD=matrix("H_PD"),
        H_PD_covariance=matrix("H_PD_covariance"),
        camera=camera_from_document(document["camera"]) if document.get("camera") else None,
        spheres=tuple(
            SphereFinding(
                name=entry["name"],
                kind=entry["kind"],
                centre_C=None if entry["centre_m"] is None else numbers(entry, "centre_m", 3),
                radius_m=number(entry, "radius_m"),
                used=entry["used"],
                why=entry["why"],
                directions_C={light: numbers(entry["directions"], light, 3) for light in entry["directions"]},
                residual=sigma(entry, "residual"),
                outline_px=numbers(entry, "outline_px", -1, 2) if entry.get("outline_px") else np.zeros((0, 2)),
                highlights_px={light: numbers(entry["highlights_px"], light, 2) for light in entry.get("highlights_px") or {}},
                image_size=None if entry.get("image_size") is None else _size(entry),
                outline_sigma_px=sigma(entry, "outline_sigma_px") if "outline_sigma_px" in entry else float("nan"),
                highlight_sigma_px={light: sigma(entry["highlight_sigma_px"], light) for light in entry.get("highlight_sigma_px") or {}},
            )
            for entry in document["spheres"]
        ),
        warnings=tuple(document.get("warnings") or ()),
        evidence=record_of(LightsEvidence, document.get("evidence") or {}),
    )
