"""The files of captures, and the captures that surfaces were made of: read where asked for, to be solved again with what all views show."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from lpcal.errors import LpcalError
from lpcal.formats.capture import read_capture
from lpcal.formats.documents import sha256
from lpcal.formats.surface_files import SUMMARY
from lpcal.formats.zarr_files import is_zarr
from lpcal.records.observations import RawCapture
from lpcal.records.sensor import StatedSensor


def files_of(capture: Path) -> list[Path]:
    """The files of a capture: those in its folder; of one in Zarr every chunk."""
    return [path for path in sorted(capture.rglob("*") if is_zarr(capture) else capture.iterdir()) if path.is_file()]


def place_of(capture: Path, surface: Path) -> str:
    """Where a capture lies, seen from its surface's folder; the whole path where they are on different drives."""
    try:
        return Path(os.path.relpath(capture.resolve(), surface.resolve())).as_posix()
    except ValueError:
        return capture.resolve().as_posix()


class SurfaceCaptures(Mapping[str, RawCapture]):
    """Captures by the names of their surfaces.

    A capture is where the surface's summary.json says, and is one only if its files are still those that the surface was made of, by near
    lights and lpcal's own method.
    """

    def __init__(self, folders: Sequence[Path], lights: Sequence[str]) -> None:
        self.lights = tuple(lights)
        self.of_surface = {str(document["name"]): (folder, document) for folder in folders if (document := _summary(folder)) is not None}

    def __getitem__(self, name: str) -> RawCapture:
        folder, document = self.of_surface[name]
        try:
            capture, options = folder / document["capture"], document["options"]
            if not options["near"] or options["method"] is not None or not _same(capture, document["inputs"]):
                raise KeyError(name)
            raw = read_capture(capture, self.lights, name=name, use=options["use"])
        except (LpcalError, OSError, TypeError) as error:
            raise KeyError(name) from error
        sensor = document.get("sensor") or {}
        said = StatedSensor(**{key: sensor[key] for key in ("gamma", "black_level", "white_level") if key in sensor})
        return replace(raw, sensor=said.over(raw.sensor))

    def __iter__(self) -> Iterator[str]:
        return iter(self.of_surface)

    def __len__(self) -> int:
        return len(self.of_surface)


def _summary(folder: Path) -> dict[str, Any] | None:
    try:
        document = json.loads((folder / SUMMARY).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return document if isinstance(document, dict) and "name" in document else None


def _same(capture: Path, digests: Mapping[str, str]) -> bool:
    """Whether a capture's files are those of which a surface's summary gives the digests."""
    there = {name: digest for name, digest in digests.items() if (capture / name).is_file()}
    return len(there) >= len(digests) - 1 and all(sha256(capture / name) == digest for name, digest in there.items())
