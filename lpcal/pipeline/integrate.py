"""A normal map from elsewhere to a depth and a mesh."""

from __future__ import annotations

import re
import time
from pathlib import Path

from lpcal.api.surfaces import DISTANCE_M, Green, integrate, mesh
from lpcal.errors import InputError
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.capture import read_mask
from lpcal.formats.documents import sha256
from lpcal.formats.normal_map import read_normals
from lpcal.formats.outputs import refuse_place
from lpcal.formats.record_documents import document_of
from lpcal.formats.surface_files import SURFACE, summary_of, write_surface
from lpcal.pipeline.reconstruct import from_here
from lpcal.records.calibration import Camera
from lpcal.records.outcome import Outcome

HEAD = 1000
"""Bytes of a file among which lpcal's own says its kind, as its second line."""


def integrate_file(
    normals: Path,
    calibration: Path | None,
    mask: Path | None,
    target: Path,
    distance_m: float | None = None,
    green: Green = "auto",
    integrator: str = "lpcal",
) -> Outcome:
    """Integrate a normal map and write its folder.

    Raises
    ------
    LpcalError
        The map, the mask or the calibration cannot be read, or they disagree.
    """
    refuse_place(target, SURFACE, [path for path in (normals, calibration, mask) if path is not None])
    begun = time.perf_counter()
    values, good = read_normals(normals)
    inside = good if mask is None else good & read_mask(mask, good.shape)
    camera, working_m = (None, None) if calibration is None else _camera(calibration)
    distance_m = distance_m or working_m or DISTANCE_M
    surface = integrate(values, camera, inside, distance_m=distance_m, green=green, integrator=integrator, name=normals.stem)
    *told, _ = surface.warnings
    seconds = round(time.perf_counter() - begun, 2)
    inputs = {path.name: sha256(path) for path in (normals, calibration, mask) if path is not None}
    figures = document_of(surface.figures)
    document = summary_of(surface) | {
        "convention": figures.pop("convention"),
        "counts_and_residuals": figures,
        "times_s": {"solving": seconds},
        "inputs": inputs,
    }
    write_surface(target, surface, mesh(surface), document)
    count = len(surface.components)
    line = f"{surface.name}: {surface.mask.sum()} px in {count} piece{'s' * (count != 1)}, depth in {document['units']}, {seconds:.1f} s"
    return Outcome([f"{line} -> {from_here(target)}", *(f"  {note}" for note in told)], {"surfaces": [document]})


def _camera(path: Path) -> tuple[Camera | None, float | None]:
    """Camera and working distance of a calibration, or the camera of a file that holds one alone."""
    if not path.is_file():
        raise InputError("no such file", where=str(path), needed="calibration.yaml, or any camera file")
    with path.open("rb") as stream:
        begins = stream.read(HEAD)
    if re.search(rb"^kind: calibration\s*$", begins, re.MULTILINE):
        lights = read_calibration(path)
        return lights.camera, lights.d_object_m
    return read_camera_file(path), None
