"""A DiLiGenT folder: directions, intensities and names of distant lights.

``light_directions.txt`` (N x 3, x right, y up, z to the camera), ``light_intensities.txt`` (N x 3 RGB, what the lights send),
``filenames.txt``. Lights are named after the images. The camera is far away: rays are parallel. A view of DiLiGenT-MV has its camera beside
it (`diligent_views`), and with it the distance at which the object stands.
Source: Shi et al. 2016, A benchmark dataset and evaluation for non-Lambertian photometric stereo, its readme.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path, PureWindowsPath

import numpy as np

from lpcal.errors import DisagreementError
from lpcal.formats.camera_coefficients import sane_camera
from lpcal.formats.diligent_views import view_of_set
from lpcal.formats.images import read_image
from lpcal.formats.light_tables import C_FROM_UP, distant, lines_of, positive, table, unit_rows
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration, Camera

DIRECTIONS, INTENSITIES, NAMES = "light_directions.txt", "light_intensities.txt", "filenames.txt"


def is_one(path: Path) -> bool:
    """Whether a path is such a folder."""
    return path.is_dir() and (path / DIRECTIONS).is_file() and (path / NAMES).is_file()


def read(path: Path) -> Calibration:
    """Read the lights of such a folder.

    Raises
    ------
    InputError
        A file cannot be read or holds no numbers, a direction is 0 0 0, or an intensity is not positive; of a view, its camera or its
        first image is not there.
    DisagreementError
        The three files speak of unlike numbers of lights, or two lights have one name.
    """
    directions = table(path / DIRECTIONS, 3)
    names = [PureWindowsPath(line.strip("\"' ")).stem for _, line in lines_of(path / NAMES)]
    intensities: Array = table(path / INTENSITIES, 3) if (path / INTENSITIES).is_file() else np.ones((len(directions), 3))
    if not len(names) == len(directions) == len(intensities):
        raise DisagreementError(
            f"{len(names)} images, {len(directions)} directions, {len(intensities)} intensities",
            where=str(path),
            needed=f"{NAMES}, {DIRECTIONS} and {INTENSITIES} of the same length",
        )
    double = next((name for name in names if names.count(name) > 1), None)
    if double is not None:
        raise DisagreementError(f"two lights are called {double}", where=str(path / NAMES), needed="each image once")
    intensities = positive(intensities, str(path / INTENSITIES))
    found = distant(path.resolve().name, names, unit_rows(directions, str(path / DIRECTIONS)) * C_FROM_UP, intensities)
    return _with_camera(found, path, PureWindowsPath(lines_of(path / NAMES)[0][1].strip("\"' ")).name)


def _with_camera(found: Calibration, path: Path, image: str) -> Calibration:
    """With the camera of the view that a folder is, where it is one."""
    view = view_of_set(path)
    if view is None:
        return found
    height, width = read_image(path / image).pixels.shape[:2]
    camera = sane_camera(Camera((width, height), "opencv4", view.K, np.zeros(4)), str(path.parent))
    return replace(found, camera=camera, focus_C=view.H_CO[:3, 3], d_object_m=float(view.H_CO[2, 3]))


FORMAT = (is_one, read)
