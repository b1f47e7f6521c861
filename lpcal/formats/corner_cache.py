"""calib/.cache/corners.json: the corners already found, by the content of image, board and detector, so that a second run is instant.

One entry a key: ``corners`` (M, 2) with null where not seen, or null and ``why``. A file that cannot be read counts as empty.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from lpcal.formats.documents import plain, sha256, write_text
from lpcal.records.observations import Board, BoardView


def cache_key(image: Path, board: Board, version: int) -> str:
    """What a detection depends on, as one digest."""
    seeds = f"{sha256(image)} {board.kind} {board.corners} {board.dictionary} {board.marker_m / board.square_m[0]} {version}"
    return hashlib.sha256(seeds.encode()).hexdigest()


def read_corner_cache(path: Path) -> dict[str, BoardView]:
    """Detections by key, their images unnamed."""
    try:
        entries = json.loads(path.read_text(encoding="utf-8"))
        return {
            key: BoardView("", None if entry["corners"] is None else np.array(entry["corners"], dtype=float).reshape(-1, 2), entry["why"])
            for key, entry in entries.items()
        }
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return {}


def write_corner_cache(path: Path, views: Mapping[str, BoardView]) -> None:
    """Keep detections by key."""
    entries = {key: {"corners": plain(view.corners_px), "why": view.why} for key, view in views.items()}
    write_text(path, json.dumps(entries))


def named(view: BoardView, image: str) -> BoardView:
    """A detection for the image that it is now asked for."""
    return replace(view, image=image)
