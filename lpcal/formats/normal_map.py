"""Normal maps from elsewhere: .npz and .npy arrays, .png and .tif images.

Normals that face the camera tell their own axes: those with z towards the viewer (x right, y up, as in normals_gl.png) have z > 0, those
in C (x right, y down, z forward) z < 0. Whole numbers 0..max, and floats none of which is negative, stand for -1..1.
"""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.errors import InputError
from lpcal.formats.images import read_image
from lpcal.formats.reading import reader
from lpcal.geometry.arrays import Image, Mask

C_FROM_GL = np.array([1.0, -1.0, -1.0], np.float32)
KEYS = ("normals", "normal_gt", "Normal_gt", "normal", "n")
LENGTHS = (0.5, 1.5)
"""A pixel whose vector is no longer or shorter holds a normal."""


@reader("a normal map: .npz, .npy, .png or .tif")
def read_normals(path: Path) -> tuple[Image, Mask]:
    """Normals (H, W, 3) in C, not made unit, and the pixels (H, W) that hold one.

    Raises
    ------
    InputError
        Not there, not readable, or no map of vectors.
    """
    values: npt.NDArray[Any]
    mask: Mask | None = None
    if path.suffix.lower() in {".npz", ".npy"}:
        values, mask = _read_arrays(path)
    else:
        values = read_image(path).pixels
    if values.ndim != 3 or values.shape[2] != 3:
        raise InputError(f"holds an array of {'x'.join(map(str, values.shape))}", where=str(path), needed="normals, height x width x 3")
    full_scale = np.iinfo(values.dtype).max if values.dtype.kind in "ui" else 1
    values = values.astype(np.float32) / np.float32(full_scale)
    if not np.nanmin(values, initial=0.0) < 0:
        values = 2 * values - 1
    length = np.linalg.norm(values, axis=2)
    good = np.isfinite(length) & (length > LENGTHS[0]) & (length < LENGTHS[1])
    if mask is not None and mask.shape == good.shape:
        good &= mask
    if not good.any():
        raise InputError("holds no normals", where=str(path), needed="vectors of length 1, or coded 0..max for -1..1")
    return np.asarray(values * (C_FROM_GL if np.median(values[good][:, 2]) > 0 else np.float32(1)), np.float32), good


def _read_arrays(path: Path) -> tuple[npt.NDArray[Any], Mask | None]:
    if not path.is_file():
        raise InputError("no such file", where=str(path), needed="a normal map: .npz, .npy, .png or .tif")
    try:
        stored = np.load(path)
        if isinstance(stored, np.ndarray):
            return stored, None
        with stored:
            keys = [key for key in KEYS if key in stored.files] or [key for key in stored.files if stored[key].shape[2:] == (3,)]
            if len(keys) == 0:
                raise InputError(f"holds {', '.join(stored.files)}", where=str(path), needed="an array `normals`, height x width x 3")
            return stored[keys[0]], stored["mask"] > 0 if "mask" in stored.files else None
    except (OSError, ValueError, EOFError, zipfile.BadZipFile) as error:
        raise InputError(f"cannot be read ({error})", where=str(path), needed="a whole .npz or .npy file", todo="write it anew") from error
