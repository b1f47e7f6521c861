"""What the report is made from: the stages' documents as read, and what was written for each object."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.report.wording import Document

KINDS = ("camera", "H_CB", "H_OP", "handeye", "wings", "lights", "calibration")
"""The documents in the chain's order, by kind; each stands in calib/ under its kind's name."""


@dataclass(frozen=True)
class SurfaceReport:
    """One reconstructed object: its summary.json, small PNG pictures by what they show, and the relighting page beside the report."""

    name: str
    summary: Document = field(default_factory=dict)
    pictures: Mapping[str, bytes] = field(default_factory=dict)
    relight: str | None = None


@dataclass(frozen=True)
class RigReport:
    """A rig's name, its documents by kind (those that are there), and its surfaces."""

    name: str
    documents: Mapping[str, Document]
    surfaces: tuple[SurfaceReport, ...] = ()

    def get(self, kind: str) -> Document:
        """A document, empty where the stage has not run."""
        return self.documents.get(kind) or {}

    @property
    def camera(self) -> Document:
        """The camera as solved or read, or the one of an imported calibration; empty for a rig that has none."""
        return self.get("camera") or self.get("calibration").get("camera") or {}

    @property
    def lights(self) -> Document:
        """The document that the lights stand in: refined, or exported or imported; empty where there is none."""
        return self.get("lights") or self.get("calibration")

    @property
    def intensities_measured(self) -> bool:
        """Whether the lights' intensities are more than a stand-in of 1: matte spheres showed them, or an import states them."""
        lights = items(self.lights, "lights")
        if any(np.any(array(light.get("intensity")) != 1.0) for light in lights):
            return True
        if self.get("lights"):
            return any(sphere.get("used") and sphere.get("kind") == "matte" for sphere in items(self.get("lights"), "spheres"))
        return not self.get("wings") and any(light.get("intensity_std") is not None for light in lights)


def array(value: Any) -> Array:
    """A nested list as an array, null as NaN."""
    return np.array(value, dtype=float)


def items(document: Document, key: str) -> list[dict[str, Any]]:
    """A list of entries; a mapping by name becomes entries with their name."""
    found = document.get(key) or []
    if isinstance(found, Mapping):
        return [{"name": name, **(entry if isinstance(entry, Mapping) else {"value": entry})} for name, entry in found.items()]
    return [dict(entry) for entry in found if isinstance(entry, Mapping)]


def board_points(report: RigReport) -> Array | None:
    """Corners (M, 3) of the board with its warp, metres; None where no board was seen."""
    found = (report.get("H_CB").get("board") or {}).get("points_m")
    return array(found) if found else None


def poses(document: Document, name: str) -> dict[str, Array]:
    """Transforms (4, 4) by image, of H_CB.yaml and H_OP.yaml; images without one are left out."""
    return {str(view.get("image")): array(view[name]) for view in items(document, "views") if view.get(name) is not None}


def sigmas(covariance: Any, size: int) -> Array:
    """Standard deviations (size,) of a covariance; NaN where there is none."""
    if covariance is None or np.shape(covariance) != (size, size):
        return np.full(size, np.nan)
    return np.sqrt(np.maximum(np.diag(array(covariance)), 0))


def origin_sigmas(H: Array, covariance: Any) -> Array:
    """Standard deviations (6,) of a rotation (rad) and of the origin (m), from the covariance (6, 6) of the left perturbation.

    NaN where there is no covariance.
    """
    if covariance is None or np.shape(covariance) != (6, 6):
        return np.full(6, np.nan)
    J = se3.turn_and_origin_jacobian(H)
    return sigmas(J @ array(covariance) @ J.T, 6)
