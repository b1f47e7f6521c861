"""calib/.cache/corners.json: the corners already found, by the content of image, board and detector, so that a second run is instant.

One entry a key: the image's ``size``, ``corners`` (M, 2) with null where not seen, or null and ``why``; ``blur_px`` and ``glare``. A file
that cannot be read counts as empty.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.formats.documents import plain, sha256
from lpcal.formats.outputs import Kind, write_text
from lpcal.geometry.arrays import Array
from lpcal.records.observations import Board, BoardView

CACHE = Kind("the corners' cache", lambda path: path.parent.name == ".cache")
"""The cache, as an output: what stands in calib/.cache is lpcal's own."""


def cache_key(image: Path, board: Board, version: int, marks_px: Array | None = None) -> str:
    """What a detection depends on, as one digest; `marks_px` (4, 2) where a person marked the board's outermost corners."""
    marked = "" if marks_px is None else f" {np.round(marks_px, 1).tolist()}"
    pattern = f"{board.kind} {board.corners} {board.dictionary} {board.corner_fit} {board.marker_m / board.square_m[0]}"
    seeds = f"{sha256(image)} {pattern} {version}{marked}"
    return hashlib.sha256(seeds.encode()).hexdigest()


@dataclass(frozen=True)
class Sighting:
    """What was found in an image of a size (width, height)."""

    size: tuple[int, int]
    view: BoardView

    def named(self, image: str) -> BoardView:
        """The detection, for the image that it is now asked for."""
        return replace(self.view, image=image)


def read_corner_cache(path: Path) -> dict[str, Sighting]:
    """Detections by key, their images unnamed."""
    try:
        entries = json.loads(path.read_text(encoding="utf-8"))
        return {key: Sighting((int(entry["size"][0]), int(entry["size"][1])), _view(entry)) for key, entry in entries.items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return {}


def write_corner_cache(path: Path, sightings: Mapping[str, Sighting]) -> None:
    """Keep detections by key."""
    entries = {
        key: {
            "size": s.size,
            "corners": plain(s.view.corners_px),
            "why": s.view.why,
            "blur_px": plain(s.view.blur_px),
            "glare": plain(s.view.glare),
        }
        for key, s in sightings.items()
    }
    write_text(path, json.dumps(entries, sort_keys=True), CACHE)


def _view(entry: dict[str, Any]) -> BoardView:
    blur_px, glare = (float("nan") if entry.get(key) is None else float(entry[key]) for key in ("blur_px", "glare"))
    return BoardView("", _corners(entry["corners"]), entry["why"], blur_px, glare)


def _corners(entry: list[list[float | None]] | None) -> Array | None:
    return None if entry is None else np.array(entry, dtype=float).reshape(-1, 2)
