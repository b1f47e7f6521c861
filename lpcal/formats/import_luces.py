"""LUCES ``led_params.txt``: near lights in millimetres, in C, with a pinhole camera.

A heading, ``N nrows ncols f x0 y0 mean_distance``, then ``Lx Ly Lz  Dx Dy Dz  PhiR PhiG PhiB  mu 0`` a light: position, emission
axis, power of each channel, exponent of the cosine lobe. Files exist with width and height in either order: the centre of the image tells
them apart. Lights are named after their images, 01, 02, ...
Source: Mecca et al. 2021, LUCES: a dataset for near-field point light source photometric stereo, its readme.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.camera_coefficients import MOST_SIDE_PX, sane_camera
from lpcal.formats.light_tables import numbers, text_of, unit_rows
from lpcal.records.calibration import Calibration, Camera, Light, Lobe

FILE = "led_params.txt"
M_FROM_MM = 1e-3


def is_one(path: Path) -> bool:
    """Whether a path is such a file, or a folder with one."""
    file = path / FILE if path.is_dir() else path
    return file.name.startswith("led_params") and file.is_file()


def read(path: Path) -> Calibration:
    """Read the lights and the camera.

    Raises
    ------
    InputError
        A row of another length, or no numbers.
    DisagreementError
        Another number of lights than the heading says.
    """
    file = path / FILE if path.is_dir() else path
    rows = []
    for count, line in enumerate(text_of(file).splitlines(), 1):
        words = line.split()
        if words and words[0].replace(".", "", 1).replace("-", "", 1).replace("+", "", 1)[:1].isdigit():
            rows.append(numbers(words, f"{file}:{count}"))
    if not rows or len(rows[0]) < 7 or any(len(row) < 10 for row in rows[1:]):
        raise InputError("not the rows of led_params", where=str(file), needed="N nrows ncols f x0 y0 distance, then 11 numbers a light")
    heading, body = rows[0], np.stack([row[:10] for row in rows[1:]]) if rows[1:] else np.zeros((0, 10))
    if not (
        0 < heading[1] <= MOST_SIDE_PX and 0 < heading[2] <= MOST_SIDE_PX and heading[3] > 0 and heading[6] > 0 and 0 < heading[0] < 1e5
    ):
        found = f"the heading {' '.join(f'{number:g}' for number in heading[:7])}"
        raise InputError(found, where=str(file), needed="N nrows ncols f x0 y0 distance, above zero", todo="is it whole?")
    if np.any(body[:, 6:9] < 0) or not np.all(body[:, 6:9].sum(axis=1) > 0):
        dark = int(np.argmin(body[:, 6:9].min(axis=1)))
        raise InputError(f"light {dark + 1} has no power", where=str(file), needed="powers above zero", todo="correct its row")
    if len(body) != int(heading[0]):
        raise DisagreementError(f"{len(body)} lights", where=str(file), needed=f"{int(heading[0])}, as its heading says")
    first, second, f, x0, y0, distance = heading[1:7]
    width, height = (
        (first, second) if abs(x0 - first / 2) + abs(y0 - second / 2) <= abs(x0 - second / 2) + abs(y0 - first / 2) else (second, first)
    )
    camera = Camera((int(width), int(height)), "opencv4", np.array([[f, 0, x0], [0, f, y0], [0, 0, 1.0]]), np.zeros(4))
    focus_C = np.array([0.0, 0.0, distance * M_FROM_MM])
    axes, power = unit_rows(body[:, 3:6], str(file)), body[:, 6:9] / body[:, 6:9].mean()
    lights = []
    for k, row in enumerate(body):
        source = row[:3] * M_FROM_MM
        towards = (source - focus_C) / np.linalg.norm(source - focus_C)
        lobe = Lobe("cosine", exponent=float(row[9])) if row[9] > 0 else Lobe()
        lights.append(Light(f"{k + 1:02d}", towards, power[k], None, source, axes[k], lobe))
    sane_camera(camera, str(file))
    return Calibration(file.parent.name or file.stem, tuple(lights), camera, None, float(distance * M_FROM_MM), focus_C)


FORMAT = (is_one, read)
