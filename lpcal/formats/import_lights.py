"""Lights that other systems calibrated, as a Calibration: which format a file or folder is, and its reader.

Each reader is one module of this package with ``is_one(path) -> bool`` and ``read(path) -> Calibration``; those of vectors alone take what
the user states them to be, and return also notes.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from pathlib import Path

from lpcal.errors import DisagreementError, InputError
from lpcal.formats import import_diligent, import_directions, import_luces, import_near_ps
from lpcal.formats.light_tables import sane_lights
from lpcal.formats.named_files import RESERVED, did_you_mean, exists, image_endings, natural_stem
from lpcal.formats.reading import reading
from lpcal.records.calibration import Calibration

FORMATS = {
    "DiLiGenT folder": import_diligent.FORMAT,
    "LUCES led_params": import_luces.FORMAT,
    "near_ps light.mat": import_near_ps.FORMAT,
}
VECTORS = {"RTI light file (.lp)": import_directions.LP, "light directions in a text": import_directions.TABLE}
"""Files of vectors alone, which may be directions or positions."""


def read_lights(path: Path) -> tuple[str, Calibration]:
    """The format's name and the calibration that a file or folder holds.

    Raises
    ------
    InputError
        Not there, of no known format, or not what a file of its format holds.
    """
    found = import_lights(path)
    return found.format, found.calibration


@dataclass(frozen=True)
class Imported:
    """Lights from a file: its format, what it holds, and notes on it."""

    format: str
    calibration: Calibration
    notes: tuple[str, ...] = ()


def import_lights(path: Path, vectors: str | None = None) -> Imported:
    """What a file or folder holds; `vectors` of a light file may be stated to be directions or positions.

    Raises
    ------
    InputError
        Not there, of no known format, or not what a file of its format holds.
    DisagreementError
        Parts of it contradict each other.
    """
    if not exists(path):
        needed = f"one of: {', '.join([*FORMATS, *VECTORS])}"
        raise InputError("no such file or folder", where=str(path), needed=needed, todo=did_you_mean(path))
    with reading(path, f"one of: {', '.join([*FORMATS, *VECTORS])}"):
        for name, (is_one, read) in FORMATS.items():
            if is_one(path):
                return Imported(name, sane_lights(read(path), str(path)))
        for name, (is_vectors, read_vectors) in VECTORS.items():
            if is_vectors(path):
                calibration, notes = read_vectors(path, vectors)
                return Imported(name, sane_lights(calibration, str(path)), tuple(notes))
    raise InputError("of no format that lpcal imports", where=str(path), needed=f"one of: {', '.join([*FORMATS, *VECTORS])}")


def named_after(calibration: Calibration, folder: Path) -> Calibration:
    """The same lights, named after the images of a folder in natural order (not ambient, mask and short ones).

    Raises
    ------
    InputError
        No such folder.
    DisagreementError
        Another number of images than of lights.
    """
    if not folder.is_dir():
        raise InputError("no such folder", where=str(folder), needed="a folder of images, one a light", todo=did_you_mean(folder))
    stems = [path.stem for path in folder.iterdir() if path.suffix.lower() in image_endings() and not path.name.startswith(".")]
    stems = [stem for stem in stems if not RESERVED & set(re.split(r"[^a-z]+", stem.lower()))]
    stems.sort(key=natural_stem)
    if len(stems) != len(calibration.lights):
        raise DisagreementError(f"{len(stems)} images", where=str(folder), needed=f"{len(calibration.lights)}, one a light")
    return replace(calibration, lights=tuple(replace(light, name=stem) for light, stem in zip(calibration.lights, stems, strict=True)))
