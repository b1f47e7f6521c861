"""The distance sensor in files: as lpcal's own documents hold it, and its readings as people write them.

``distance_sensor`` of calibration.yaml: ``position_m`` (3,) and ``direction`` (3,) of the beam in C, ``bias_m``, ``scale`` (a reading is
``bias + scale t`` of what the beam hits at ``position + t direction``), ``noise_m`` (one sigma of a reading), ``covariance`` (8x8, of
position, direction, bias, scale).

distance.yaml: that, and ``warnings``, ``evidence``, ``readings: [{name, used, why, reading_m, residual_m, at_m}]`` (``why`` is null where
used; ``at_m``: x, y of B at which the beam meets the board's plane).

Readings stand in a column of the csv files of images, or in a csv of their own, with the columns ``file`` (an image's path, relative to the
csv), ``time_s`` (the camera's clock) or both, and ``distance_m``, ``distance_mm`` or ``distance_cm``. A row whose distance is empty has no
reading. Further columns are left alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.document_numbers import covariance, number, numbers
from lpcal.formats.documents import read_record, write_document
from lpcal.formats.image_times import FILES, TIMES
from lpcal.formats.named_files import did_you_mean, resolve_named
from lpcal.formats.number_table import COMMENTS, is_number, seconds
from lpcal.formats.reading import reader
from lpcal.formats.record_documents import document_of, record_of
from lpcal.formats.text import read_text, with_commas
from lpcal.records.distance import DistanceSensor, ReadingVerdict, SensorEvidence, SensorSolution
from lpcal.records.provenance import Provenance

KIND = "distance"


def beam_document(sensor: DistanceSensor) -> dict[str, Any]:
    """A sensor as it is written."""
    return {
        "position_m": sensor.position_C,
        "direction": sensor.direction_C,
        "bias_m": sensor.bias_m,
        "scale": sensor.scale,
        "noise_m": sensor.noise_m,
        "covariance": sensor.covariance,
    }


def beam_from_document(entry: dict[str, Any]) -> DistanceSensor:
    """A sensor as it was written.

    Raises
    ------
    KeyError, TypeError, ValueError
        A key is lacking or holds something else; the message is the key's name.
    """
    direction = numbers(entry, "direction", 3)
    scale, bias_m, noise_m = number(entry, "scale"), number(entry, "bias_m"), number(entry, "noise_m")
    if not direction.any():
        raise ValueError("direction")
    if scale is None or scale <= 0:
        raise ValueError("scale")
    if noise_m is None or noise_m <= 0:
        raise ValueError("noise_m")
    return DistanceSensor(
        numbers(entry, "position_m", 3),
        direction / np.linalg.norm(direction),
        bias_m or 0.0,
        scale,
        noise_m,
        covariance(entry, "covariance", 8),
    )


def write_distance(path: Path, found: SensorSolution, provenance: Provenance) -> None:
    """Write distance.yaml."""
    body = {
        "distance_sensor": beam_document(found.sensor),
        "warnings": list(found.warnings),
        "evidence": document_of(found.evidence),
        "readings": [document_of(one) for one in found.readings],
    }
    write_document(path, KIND, body, provenance)


def read_distance(path: Path) -> SensorSolution:
    """Read distance.yaml.

    Raises
    ------
    InputError
        Not there, cut off, of another kind, or garbled.
    """
    return read_record(path, KIND, "lpcal distance", distance_from_document)


def distance_from_document(document: dict[str, Any]) -> SensorSolution:
    """What distance.yaml holds, as written.

    Raises
    ------
    KeyError, TypeError, ValueError
        A key is lacking or holds something else; the message is the key's name.
    """
    return SensorSolution(
        beam_from_document(document["distance_sensor"]),
        tuple(record_of(ReadingVerdict, entry) for entry in document["readings"]),
        record_of(SensorEvidence, document["evidence"]),
        tuple(str(one) for one in document.get("warnings") or ()),
    )


DISTANCES = {"distance_m": 1.0, "distance_mm": 1e-3, "distance_cm": 1e-2}
"""Names of the column of readings, and the metres in its unit."""
LAYOUT = "columns file or time_s, and distance_m"


@dataclass(frozen=True)
class ReadingRow:
    """One reading: of an image, at a time on the camera's clock, or both."""

    name: str
    """Where it stands, in words."""
    image: Path | None
    t_camera_s: float | None
    distance_m: float


@reader(LAYOUT)
def read_distances(path: Path, *, needed: bool = True) -> list[ReadingRow]:
    """The readings of a csv; none where it has no such column and none is `needed`.

    Raises
    ------
    InputError
        No column of distances (where one is needed), neither file nor time, a distance or time that is no number, or no such image.
    """
    lines = [
        (number, [cell.strip() for cell in line.split(",")])
        for number, line in enumerate(with_commas(read_text(path, LAYOUT), path).split("\n"), start=1)
        if line.strip(", \t") and not line.lstrip().startswith(COMMENTS)
    ]
    names = [cell.lower().lstrip("#").strip() for cell in lines[0][1]] if lines else []
    column = next((names.index(name) for name in DISTANCES if name in names), None)
    if column is None:
        if not needed:
            return []
        raise InputError(f"columns {','.join(names)}", where=f"{path}:1", needed=LAYOUT, todo="name the columns so")
    file = next((names.index(name) for name in FILES if name in names), None)
    time = next((names.index(name) for name in TIMES if name in names), None)
    if file is None and time is None:
        raise InputError(f"columns {','.join(names)}", where=f"{path}:{lines[0][0]}", needed=LAYOUT, todo="name an image or a time each")
    unit = DISTANCES[names[column]]
    found: list[ReadingRow] = []
    for row, cells in lines[1:]:
        where = f"{path}:{row}"
        if len(cells) <= column or not cells[column]:
            continue
        if not is_number(cells[column]) or not np.isfinite(float(cells[column])):
            raise InputError(f"{names[column]} {cells[column]!r}", where=where, needed="a number, or nothing where there is no reading")
        image = None if file is None or not cells[file] else resolve_named(path.parent, cells[file])
        if file is not None and cells[file] and image is None:
            todo = did_you_mean(path.parent / cells[file], "correct it")
            raise InputError(f"no such image: {cells[file]}", where=where, needed="a path relative to this csv", todo=todo)
        if time is not None and not is_number(cells[time]):
            raise InputError(f"{names[time]} {cells[time]!r}", where=where, needed="seconds", todo="is the file cut off?")
        at = None if time is None else float(seconds([cells[time]], TIMES[names[time]])[0])
        name = f"{path.name}:{row}" if image is None else image.name
        found.append(ReadingRow(name, image, at, unit * float(cells[column])))
    return found
