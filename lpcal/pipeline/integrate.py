"""A normal map from elsewhere to a depth and a mesh."""

from __future__ import annotations

import time
from dataclasses import asdict
from pathlib import Path

from lpcal import __version__
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.capture import read_mask
from lpcal.formats.documents import sha256
from lpcal.formats.normal_map import read_normals
from lpcal.formats.outputs import refuse_place
from lpcal.formats.surface_files import SURFACE, write_surface
from lpcal.pipeline.reconstruct import from_here
from lpcal.records.outcome import Outcome
from lpcal.surface import mesh
from lpcal.surface.of_normals import surface_of_normals

DISTANCE_M = 0.35
"""Where neither a calibration nor the user says how far away the object is."""


def integrate_file(normals: Path, calibration: Path | None, mask: Path | None, target: Path, distance_m: float | None = None) -> Outcome:
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
    lights = None if calibration is None else read_calibration(calibration)
    camera = None if lights is None else lights.camera
    told = distance_m or (lights.d_object_m if lights is not None else None)
    surface = surface_of_normals(normals.stem, values, inside, camera, told or DISTANCE_M)
    seconds = round(time.perf_counter() - begun, 2)
    inputs = {path.name: sha256(path) for path in (normals, calibration, mask) if path is not None}
    note = "normals tell the shape; the distance, and that of pieces to each other, is not measured"
    document = {
        "lpcal": 1,
        "kind": "surface",
        "name": surface.name,
        "units": "pixels" if camera is None else "metres",
        "components": [asdict(component) for component in surface.components],
        "counts_and_residuals": surface.figures,
        "times_s": {"solving": seconds},
        "versions": {"lpcal": __version__},
        "inputs": inputs,
        "notes": [note],
    }
    write_surface(target, surface, mesh.build(surface), document)
    count = len(surface.components)
    line = f"{surface.name}: {inside.sum()} px in {count} piece{'s' * (count != 1)}, depth in {document['units']}, {seconds:.1f} s"
    return Outcome([f"{line} -> {from_here(target)}"], {"surfaces": [document]})
