"""C3D, the marker file of biomechanics: points, their unit and rate. A residual below zero says that a marker was not seen.

Read with ezc3d. Source: the C3D file format, c3d.org.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.marker_table import MarkerTable
from lpcal.formats.number_table import is_rate
from lpcal.formats.pose_table import unit_of
from lpcal.formats.reading import parse_limited

OUTPUTS = ("ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS")
"""Parameters of POINT that name what a model made and no camera saw."""


def is_c3d(head: bytes) -> bool:
    """Whether the first bytes of a file are those of a C3D header."""
    return head[1:2] == b"\x50" and head[:1] < b"\x20"


def read_c3d(path: Path, units: str | None = None) -> MarkerTable:
    """The tracks of all markers.

    Raises
    ------
    InputError
        Cut off or garbled, no markers, or a unit that nothing states.
    """
    found = parse_limited(parse, path, "a whole C3D file")
    points, residuals, first, parameters = found["points"], found["residuals"], found["first_frame"], found["parameters"]
    labels = [str(label).strip() for key in ("LABELS", "LABELS2") for label in parameters.get(key, {"value": []})["value"]]
    made = {str(label).strip() for key in OUTPUTS for label in parameters.get(key, {"value": []})["value"]} - {""}
    if not points.size or not set(labels) - made:
        raise InputError("no markers", where=str(path), needed="points with labels", todo="export the marker trajectories")
    stated = "".join(parameters.get("UNITS", {"value": []})["value"]).strip().lower()
    if units is None and unit_of(stated) is None:
        raise InputError(f"{stated!r} as unit of length", where=str(path), needed="m, cm or mm", todo="state mocap.units in panel.yaml")
    rate = float(parameters.get("RATE", {"value": [0]})["value"][0])
    if not is_rate(str(rate)):
        raise InputError(f"a rate of {rate:g} Hz", where=str(path), needed="the frames a second", todo="export it again")
    x = np.where(residuals[..., None] < 0, np.nan, np.moveaxis(points[:3], 0, -1))
    notes = (f"lengths read as {units}, as panel.yaml says, against the file's {stated}",) if units and stated not in {"", units} else ()
    t_s = (first + np.arange(points.shape[2])) / rate
    tracks = {label: track for label, track in zip(labels, x, strict=False) if label not in made}
    return MarkerTable(t_s, tracks, units or str(unit_of(stated)), notes)


def parse(path: str) -> dict[str, Any]:
    """What ezc3d finds in a file: points (4, markers, frames), residuals (markers, frames), the first frame, POINT's parameters."""
    import ezc3d

    content = ezc3d.c3d(path)
    parameters = content["parameters"]["POINT"]
    wanted = ("LABELS", "LABELS2", "UNITS", "RATE", *OUTPUTS)
    return {
        "points": np.asarray(content["data"]["points"], dtype=float),
        "residuals": np.asarray(content["data"]["meta_points"]["residuals"], dtype=float)[0],
        "first_frame": int(content["header"]["points"]["first_frame"]),
        "parameters": {key: {"value": list(parameters[key]["value"])} for key in wanted if key in parameters},
    }
