"""The distance sensor as lpcal's documents hold it.

``distance_sensor`` of calibration.yaml: ``position_m`` (3,) and ``direction`` (3,) of the beam in C, ``bias_m``, ``scale`` (a reading is
``bias + scale t`` of what the beam hits at ``position + t direction``), ``noise_m`` (one sigma of a reading), ``covariance`` (8x8, of
position, direction, bias, scale).

distance.yaml: that, and ``warnings``, ``evidence``, ``readings: [{name, used, why, reading_m, residual_m, at_m}]`` (``why`` is null where
used; ``at_m``: x, y of B at which the beam meets the board's plane).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.formats.document_numbers import covariance, number, numbers
from lpcal.formats.documents import read_record, write_document
from lpcal.formats.record_documents import document_of, record_of
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
