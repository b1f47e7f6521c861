"""near_ps: near lights in millimetres from MATLAB files.

``light.mat`` holds S (N, 3) positions in mm, Dir (N, 3) emission axes, Phi (N, 1 or 3) powers, mu (N, 1) exponents, all in C; Dir is needed
only where mu is not 0. ``camera.mat`` beside it holds K, sometimes transposed. Lights are named 1, 2, ...

The image size is that of an image beside them, else twice the principal point and one, the middle of an image being at (w - 1) / 2.
Axes that do not meet leave the calibration without a working point.
Source: the readme of near_ps (Quéau et al. 2018, LED-based photometric stereo: modeling, calibration and solution).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.camera_coefficients import sane_camera
from lpcal.formats.images import ENDINGS, read_image
from lpcal.formats.light_tables import unit_rows
from lpcal.formats.limited import parse_limited
from lpcal.formats.named_files import hidden
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration, Camera, Light, Lobe

FILE, CAMERA = "light.mat", "camera.mat"
PARALLEL = 1e-3
"""Least eigenvalue a light of the sum of the projectors across the axes, under which they are parallel: sin^2 of two degrees."""
APART = 0.2
"""How far past the point where they nearly meet the axes may pass, of its distance from the light: more, and they mean nothing."""
DISTANCES = 3.0
"""A distance at which lights without a meeting point are looked at, in mean distances of the lights from their middle."""
M_FROM_MM = 1e-3


def is_one(path: Path) -> bool:
    """Whether a path is such a file, or a folder with one."""
    return (path.is_dir() and (path / FILE).is_file()) or (path.is_file() and path.suffix.lower() == ".mat")


def read(path: Path) -> Calibration:
    """Read the lights, and the camera where camera.mat stands beside them.

    Raises
    ------
    InputError
        Not a MATLAB file, or a variable is lacking or of another form.
    """
    file = path / FILE if path.is_dir() else path
    stored = _load(file)
    S = _matrix(stored, "S", file, 3) * M_FROM_MM
    count = len(S)
    Phi = _matrix(stored, "Phi", file, None) if "Phi" in stored else np.ones((count, 1))
    mu = np.ravel(_matrix(stored, "mu", file, None)) if "mu" in stored else np.zeros(count)
    Dir = _matrix(stored, "Dir", file, 3) if "Dir" in stored or np.any(mu > 0) else np.tile([0.0, 0.0, 1.0], (count, 1))
    if not count == len(Dir) == len(Phi) == len(mu) or Phi.shape[1] not in {1, 3}:
        raise InputError(
            f"S, Dir, Phi and mu have {count}, {len(Dir)}, {len(Phi)} and {len(mu)} rows", where=str(file), needed="one a light"
        )
    if np.any(Phi < 0) or not np.all(Phi.sum(axis=1) > 0):
        raise InputError("a light without power", where=f"{file}, Phi", needed="powers above zero", todo="correct it")
    Dir, power = unit_rows(Dir, str(file)), Phi / Phi.mean()
    focus = _meeting_point(S, Dir) if "Dir" in stored else None
    towards = S - (focus if focus is not None else np.array([0.0, 0.0, DISTANCES * np.linalg.norm(S - S.mean(axis=0), axis=1).mean()]))
    lobes = [Lobe("cosine", exponent=float(one)) if one > 0 else Lobe() for one in mu]
    lights = tuple(Light(str(k + 1), towards[k] / np.linalg.norm(towards[k]), power[k], None, S[k], Dir[k], lobes[k]) for k in range(count))
    distance_m = None if focus is None else float(np.linalg.norm(focus))
    return Calibration(file.parent.name or file.stem, lights, _camera(file.parent / CAMERA), None, distance_m, focus)


def _camera(file: Path) -> Camera | None:
    if not file.is_file():
        return None
    K = _matrix(_load(file), "K", file, 3)
    K = K.T if K[0, 2] == 0 else K
    size = _image_size(file.parent) or (round(2 * float(K[0, 2] / K[2, 2])) + 1, round(2 * float(K[1, 2] / K[2, 2])) + 1)
    return sane_camera(Camera(size, "opencv4", K / K[2, 2], np.zeros(4)), str(file))


def _image_size(folder: Path) -> tuple[int, int] | None:
    """The size of the images beside the file."""
    images = sorted(path for path in folder.iterdir() if path.suffix.lower() in ENDINGS and not hidden(path))
    return read_image(images[0]).size if images else None


def _meeting_point(S: Array, Dir: Array) -> Array | None:
    """The point in front of the camera nearest to all axes; None where they do not meet there: parallel, or pointing apart."""
    across = np.eye(3) - Dir[:, :, None] * Dir[:, None, :]
    normal = across.sum(axis=0)
    if np.linalg.eigvalsh(normal)[0] < PARALLEL * len(S):
        return None
    focus = np.asarray(np.linalg.solve(normal, np.einsum("kij,kj->i", across, S)))
    ahead = np.einsum("kj,kj->k", focus - S, Dir)
    miss = np.linalg.norm(np.einsum("kij,kj->ki", across, focus - S), axis=1)
    return focus if focus[2] > 0 and np.all(ahead > 0) and np.median(miss / ahead) < APART else None


def _load(file: Path) -> dict[str, Any]:
    if file.read_bytes()[:8] == b"\x89HDF\r\n\x1a\n" or b"MATLAB 7.3" in file.read_bytes()[:116]:
        raise InputError("a MATLAB file of version 7.3", where=str(file), needed="version 7 or older", todo="save it with: save -v7")
    found: dict[str, Any] = parse_limited(parse, file, "a MATLAB file of near_ps: light.mat or camera.mat")
    return found


def parse(path: str) -> dict[str, Any]:
    """The numeric variables of a MATLAB file."""
    from scipy.io import loadmat

    stored = loadmat(path, variable_names=["S", "Dir", "Phi", "mu", "K"])
    return {key: value for key, value in stored.items() if isinstance(value, np.ndarray) and value.dtype.kind in "uif"}


def _matrix(stored: dict[str, Any], key: str, file: Path, columns: int | None) -> Array:
    if key not in stored:
        raise InputError(f"holds no {key}", where=str(file), needed="S, Dir, Phi, mu (light.mat) or K (camera.mat)")
    try:
        value = np.atleast_2d(np.asarray(stored[key], dtype=float))
    except (TypeError, ValueError) as error:
        raise InputError(f"{key} holds no numbers", where=str(file), needed="a matrix") from error
    if not np.isfinite(value).all() or (columns is not None and value.shape[1] != columns):
        raise InputError(
            f"{key} is {value.shape[0]}x{value.shape[1]} or not finite", where=str(file), needed=f"N x {columns or 1} finite numbers"
        )
    return value


FORMAT = (is_one, read)
