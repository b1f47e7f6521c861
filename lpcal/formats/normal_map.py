"""Normal maps from elsewhere: .npz and .npy arrays, MATLAB's .mat (DiLiGenT's Normal_gt.mat), .png and .tif images.

Normals that face the camera show their own axes: those with z towards the viewer (x right, y up, as in normals_gl.png) have z > 0, those
in C (x right, y down, z forward) z < 0. Whole numbers 0..max, and floats none of which is negative, stand for -1..1.
"""

from __future__ import annotations

import math
import tokenize
import zipfile
import zlib
from pathlib import Path
from typing import IO, Any

import numpy as np
import numpy.typing as npt

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.images import read_image
from lpcal.formats.mat_file import read_matrices
from lpcal.formats.named_files import did_you_mean
from lpcal.formats.reading import reader
from lpcal.geometry.arrays import Image, Mask

C_FROM_GL = np.array([1.0, -1.0, -1.0], np.float32)
KEYS = ("normals", "normal_gt", "Normal_gt", "normal", "n")
DEPTH_KEYS = ("depth", "depth_gt", "Depth_gt", "z")
"""Names under which a depth stands beside normals."""
MOST_BYTES = 1 << 30
"""Bytes of the largest array that is read: normals of 89 megapixels in 32 bit."""
LONGEST = 10.0
"""Components beyond this are damage, as if they were not finite."""
LENGTHS = (0.5, 1.5)
"""A pixel whose vector is no longer or shorter holds a normal."""


MAPS = "a normal map: .npz, .npy, .mat, .png or .tif"
"""What is read."""


@reader(MAPS, "cv2")
def read_normals(path: Path) -> tuple[Image, Mask]:
    """Normals (H, W, 3) in C, not made unit, and the pixels (H, W) that hold one.

    Raises
    ------
    InputError
        Not there, not readable, or no map of vectors.
    DisagreementError
        The mask beside the normals has another size.
    """
    values: npt.NDArray[Any]
    mask: Mask | None = None
    if path.suffix.lower() in {".npz", ".npy"}:
        values, mask = _read_arrays(path)
    elif path.suffix.lower() == ".mat":
        values = _of_matlab(path)
    elif path.suffix.lower() in {".txt", ".csv", ".exr", ".hdr", ".pfm"}:
        raise InputError(f"a {path.suffix.lower()} file", where=str(path), needed=MAPS, todo="store the map as .npy: numpy.save, H x W x 3")
    else:
        values = read_image(path).pixels
        mask = _alpha(path)
    if values.ndim != 3 or values.shape[2] != 3:
        raise InputError(f"holds an array of {'x'.join(map(str, values.shape))}", where=str(path), needed="normals, height x width x 3")
    full_scale = np.iinfo(values.dtype).max if values.dtype.kind in "ui" else 1
    values = values.astype(np.float32) / np.float32(full_scale)
    if not np.nanmin(values, initial=0.0) < 0:
        values = 2 * values - 1
    values = np.where(np.abs(values) <= LONGEST, values, np.float32(np.nan))
    length = np.linalg.norm(values, axis=2)
    good = np.isfinite(length) & (length > LENGTHS[0]) & (length < LENGTHS[1])
    if mask is not None and mask.shape != good.shape:
        found = f"a mask of {'x'.join(map(str, mask.shape))} for normals of {good.shape[0]}x{good.shape[1]}"
        raise DisagreementError(found, where=str(path), needed="a mask of the map's height x width")
    if mask is not None:
        good &= mask
    if not good.any():
        raise InputError("holds no normals", where=str(path), needed="vectors of length 1, or coded 0..max for -1..1")
    return np.asarray(values * (C_FROM_GL if np.median(values[good][:, 2]) > 0 else np.float32(1)), np.float32), good


@reader("a depth map in an .npz")
def read_depth(path: Path) -> Image | None:
    """The depth (H, W) that stands beside the normals of an .npz, as it is stored; None where none does.

    Raises
    ------
    InputError
        Not readable, or no map.
    """
    if not zipfile.is_zipfile(path):
        return None
    with zipfile.ZipFile(path) as archive:
        name = next((f"{key}.npy" for key in DEPTH_KEYS if f"{key}.npy" in archive.namelist()), None)
        if name is None:
            return None
        with archive.open(name) as stream:
            depth = _array(stream, path)
    if depth.ndim != 2:
        raise InputError(f"a depth of {'x'.join(map(str, depth.shape))}", where=str(path), needed="height x width")
    return np.asarray(depth, np.float32)


def _read_arrays(path: Path) -> tuple[npt.NDArray[Any], Mask | None]:
    if not path.is_file():
        raise InputError("no such file", where=str(path), needed=MAPS, todo=did_you_mean(path))
    try:
        if not zipfile.is_zipfile(path):
            with path.open("rb") as stream:
                return _array(stream, path), None
        with zipfile.ZipFile(path) as archive:
            arrays = {name.removesuffix(".npy"): name for name in archive.namelist() if name.endswith(".npy")}
            key = next((key for key in KEYS if key in arrays), next(iter(arrays)) if len(arrays) == 1 else None)
            if key is None:
                raise InputError(f"holds {', '.join(arrays)[:100]}", where=str(path), needed="an array `normals`, height x width x 3")
            with archive.open(arrays[key]) as stream:
                values = _array(stream, path)
            if "mask" not in arrays:
                return values, None
            with archive.open(arrays["mask"]) as stream:
                return values, np.asarray(_array(stream, path) > 0)
    except (OSError, EOFError, zipfile.BadZipFile, zlib.error, RuntimeError) as error:
        raise InputError(
            f"cannot be read ({str(error)[:80]})", where=str(path), needed="a whole .npz or .npy file", todo="write it again"
        ) from error


def _of_matlab(path: Path) -> npt.NDArray[Any]:
    """The array (H, W, 3) of a MATLAB file."""
    found = {name: values for name, values in read_matrices(path, 3, MOST_BYTES).items() if values.shape[2] == 3}
    key = next((key for key in KEYS if key in found), next(iter(found)) if len(found) == 1 else None)
    if key is None:
        raise InputError(f"holds {len(found)} arrays of height x width x 3", where=str(path), needed="one of normals, such as Normal_gt")
    return found[key]


def _array(stream: IO[bytes], path: Path) -> npt.NDArray[Any]:
    """An array of numbers of a .npy stream, its size checked before it is read."""
    try:
        read_header = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}
        shape, by_column, kind = read_header[np.lib.format.read_magic(stream)](stream)
        size = math.prod(shape) * kind.itemsize
    except (KeyError, ValueError, TypeError, SyntaxError, tokenize.TokenError, RecursionError) as error:
        raise InputError(
            "its head is no .npy array's", where=str(path), needed="a whole .npz or .npy file", todo="write it again"
        ) from error
    if kind.kind not in "fiub" or not 0 < size <= MOST_BYTES:
        found = f"an array {'x'.join(map(str, shape))[:40]} of {kind.name[:20]}"
        raise InputError(found, where=str(path), needed=f"numbers, up to {MOST_BYTES / 1e9:g} GB")
    stored = stream.read(size)
    if len(stored) < size:
        raise InputError(f"cut off: {len(stored)} bytes of {size}", where=str(path), needed="a whole file", todo="write it again")
    return np.frombuffer(stored, kind).reshape(shape, order="F" if by_column else "C")


def _alpha(path: Path) -> Mask | None:
    """Where (H, W) an image that has been read is not transparent; None without such a channel."""
    import cv2

    stored = cv2.imdecode(np.frombuffer(path.read_bytes(), np.uint8), cv2.IMREAD_UNCHANGED)
    return np.asarray(stored[..., 3] > 0) if stored is not None and stored.ndim == 3 and stored.shape[2] == 4 else None
