"""Lights that other systems calibrated, as a Calibration: which format a file or folder is, and its reader.

Each reader is one module of this package with ``is_one(path) -> bool`` and ``read(path) -> Calibration``.
"""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

from lpcal.errors import DisagreementError, InputError
from lpcal.formats import import_diligent, import_directions, import_luces, import_near_ps
from lpcal.formats.images import ENDINGS
from lpcal.formats.light_tables import sane_lights
from lpcal.formats.named_files import exists, hidden
from lpcal.formats.reading import reading
from lpcal.records.calibration import Calibration

NO_LIGHT = re.compile(r"(^|[_-])(mask|ambient|background|normals?|depth)([_-]|\d*$)|^short_", re.IGNORECASE)
"""What the names of images hold that show no light: ambient.png, ball_mask.png, short_L0.png."""
FORMATS = {
    "RTI light file (.lp)": import_directions.LP,
    "DiLiGenT folder": import_diligent.FORMAT,
    "LUCES led_params": import_luces.FORMAT,
    "near_ps light.mat": import_near_ps.FORMAT,
    "light directions in a text": import_directions.TABLE,
}


def read_lights(path: Path) -> tuple[str, Calibration]:
    """The format's name and the calibration that a file or folder holds.

    Raises
    ------
    InputError
        Not there, of no known format, or not what a file of its format holds.
    """
    if not exists(path):
        raise InputError("no such file or folder", where=str(path), needed=f"one of: {', '.join(FORMATS)}")
    for name, (is_one, read) in FORMATS.items():
        if is_one(path):
            with reading(path, name):
                return name, sane_lights(read(path), str(path))
    raise InputError("of no format that lpcal imports", where=str(path), needed=f"one of: {', '.join(FORMATS)}")


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
        raise InputError("no such folder", where=str(folder), needed="a folder of images, one a light")
    stems = [path.stem for path in folder.iterdir() if path.suffix.lower() in ENDINGS and not hidden(path)]
    stems = [stem for stem in stems if not NO_LIGHT.search(stem)]
    stems.sort(key=lambda stem: [(part.isdigit(), int(part) if part.isdigit() else 0, part) for part in re.split(r"(\d+)", stem)])
    if len(stems) != len(calibration.lights):
        raise DisagreementError(f"{len(stems)} images", where=str(folder), needed=f"{len(calibration.lights)}, one a light")
    return replace(calibration, lights=tuple(replace(light, name=stem) for light, stem in zip(calibration.lights, stems, strict=True)))
