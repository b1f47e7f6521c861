"""LUCES ``led_params.txt``: near lights in millimetres, in C, with a pinhole camera.

A heading, ``N nrows ncols f x0 y0 mean_distance``, then ``Lx Ly Lz  Dx Dy Dz  PhiR PhiG PhiB  mu 0`` a light: position, emission axis,
power of each channel, exponent of the cosine lobe. Files exist with width and height in either order: the centre of the image distinguishes
them. Lights are named after their images, 01, 02, ... Source: Mecca et al. 2021, LUCES: a dataset for near-field point light source
photometric stereo, its readme.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.camera_coefficients import sane_camera
from lpcal.formats.light_tables import lines_of, numbers, of_light, positive, scaled, unit_rows, whole_number, words_of
from lpcal.geometry.arrays import Array
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
        A row of another length, no numbers, or numbers that no light or camera has.
    DisagreementError
        Another number of lights than the heading says.
    """
    file = path / FILE if path.is_dir() else path
    rows: list[Array] = []
    for count, line in lines_of(file):
        words = words_of(line)
        if words and (rows or words[0].lstrip("+-.")[:1].isdigit()):  # the heading of words comes first
            rows.append(numbers(words, f"{file}:{count}"))
    if not rows or len(rows[0]) < 7 or any(len(row) < 10 for row in rows[1:]):
        raise InputError("not the rows of led_params", where=str(file), needed="N nrows ncols f x0 y0 distance, then 11 numbers a light")
    heading, body = rows[0], np.stack([row[:10] for row in rows[1:]]) if rows[1:] else np.zeros((0, 10))
    wanted = whole_number(float(heading[0]), str(file), "the number of lights")
    if len(body) != wanted:
        raise DisagreementError(f"{len(body)} lights", where=str(file), needed=f"{wanted}, as its heading says")
    if np.any(body[:, 9] < 0):
        k = int(np.argmax(body[:, 9] < 0))
        raise InputError(f"light {k + 1} has the exponent {body[k, 9]:g}", where=str(file), needed="exponents of 0 or more")
    first, second, f, x0, y0, distance = heading[1:7]
    if not distance > 0:
        raise InputError(f"a mean distance of {distance:g}", where=str(file), needed="a distance in mm, above 0")
    width, height = (
        (first, second) if abs(x0 - first / 2) + abs(y0 - second / 2) <= abs(x0 - second / 2) + abs(y0 - first / 2) else (second, first)
    )
    size = whole_number(float(width), str(file), "the image's width"), whole_number(float(height), str(file), "the image's height")
    K = np.array([[f, 0, x0], [0, f, y0], [0, 0, 1.0]])
    camera = sane_camera(Camera(size, "opencv4", K, np.zeros(4)), str(file))
    focus_C = np.array([0.0, 0.0, distance * M_FROM_MM])
    axes, power = unit_rows(body[:, 3:6], str(file)), scaled(positive(body[:, 6:9], str(file)))
    lights = []
    for k, row in enumerate(body):
        source = row[:3] * M_FROM_MM
        towards = of_light(source - focus_C, f"{file}, light {k + 1}")
        lobe = Lobe("cosine", exponent=float(row[9])) if row[9] > 0 else Lobe()
        lights.append(Light(f"{k + 1:02d}", towards, power[k], None, source, axes[k], lobe))
    return Calibration(file.resolve().parent.name or file.stem, tuple(lights), camera, None, float(distance * M_FROM_MM), focus_C)


FORMAT = (is_one, read)
