"""near_ps: near lights in millimetres from MATLAB files.

``light.mat`` holds S (N, 3) positions in mm, Dir (N, 3) emission axes, Phi (N, 1 or 3) powers, mu (N, 1) exponents, all in C;
``camera.mat`` beside it K, sometimes transposed. Lights are named 1, 2, ... The image size is that of an image beside them, else twice the
principal point. Source: the readme of near_ps (Quéau et al. 2018, LED-based photometric stereo: modeling, calibration and solution).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.images import ENDINGS, read_image
from lpcal.formats.light_tables import unit_rows
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration, Camera, Light, Lobe

FILE, CAMERA = "light.mat", "camera.mat"
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
    Dir, count = unit_rows(_matrix(stored, "Dir", file, 3), str(file)), len(S)
    Phi = _matrix(stored, "Phi", file, None) if "Phi" in stored else np.ones((count, 1))
    mu = np.ravel(_matrix(stored, "mu", file, None)) if "mu" in stored else np.zeros(count)
    if not count == len(Dir) == len(Phi) == len(mu) or Phi.shape[1] not in {1, 3}:
        raise InputError(
            f"S, Dir, Phi and mu have {count}, {len(Dir)}, {len(Phi)} and {len(mu)} rows", where=str(file), needed="one a light"
        )
    power = Phi / Phi.mean()
    middle = _meeting_point(S, Dir)
    lights = tuple(
        Light(
            str(k + 1),
            (S[k] - middle) / np.linalg.norm(S[k] - middle),
            power[k],
            None,
            S[k],
            Dir[k],
            Lobe("cosine", exponent=float(mu[k])) if mu[k] > 0 else Lobe(),
        )
        for k in range(count)
    )
    return Calibration(file.parent.name or file.stem, lights, _camera(file.parent / CAMERA), None, float(np.linalg.norm(middle)), middle)


def _camera(file: Path) -> Camera | None:
    if not file.is_file():
        return None
    K = _matrix(_load(file), "K", file, 3)
    K = K.T if K[0, 2] == 0 else K
    images = sorted(path for path in file.parent.iterdir() if path.suffix.lower() in ENDINGS)
    size = read_image(images[0]).size if images else (round(2 * float(K[0, 2])), round(2 * float(K[1, 2])))
    return Camera(size, "opencv4", K / K[2, 2], np.zeros(4))


def _meeting_point(S: Array, Dir: Array) -> Array:
    """The point nearest to all axes."""
    across = np.eye(3) - Dir[:, :, None] * Dir[:, None, :]
    return np.asarray(np.linalg.lstsq(across.sum(axis=0), np.einsum("kij,kj->i", across, S), rcond=None)[0])


def _load(file: Path) -> dict[str, Any]:
    from scipy.io import loadmat
    from scipy.io.matlab import MatReadError

    try:
        return dict(loadmat(file))
    except (OSError, ValueError, NotImplementedError, TypeError, MatReadError) as error:
        raise InputError(
            "cannot be read as a MATLAB file (version 7.2 or older)", where=str(file), needed="light.mat of near_ps"
        ) from error


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
