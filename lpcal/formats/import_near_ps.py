"""near_ps: near lights in millimetres from MATLAB files.

``light.mat`` holds S (N, 3) positions in mm, Dir (N, 3) emission axes (needed only where mu > 0), Phi (N, 1 or 3) powers, mu (N, 1)
exponents, all in C; ``camera.mat`` beside it K, sometimes transposed. Lights are named 1, 2, ... The image size is that of an image beside
them, else it is guessed from the principal point and said to be so. Where the axes meet before the lights, that is the working point; where
they do not (parallel, apart, or of lights that send alike to all sides) there is none.
Source: the readme of near_ps (Quéau et al. 2018, LED-based photometric stereo: modeling, calibration and solution).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lpcal.errors import DegenerateError, InputError
from lpcal.formats.camera_coefficients import sane_camera
from lpcal.formats.images import read_image
from lpcal.formats.light_tables import LARGEST, of_light, positive, scaled, unit_rows
from lpcal.formats.mat_file import read_matrices
from lpcal.formats.named_files import image_endings
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration, Camera, Light, Lobe

FILE, CAMERA = "light.mat", "camera.mat"
M_FROM_MM = 1e-3
MISS = 0.35
"""Share of the lights' spread: axes that pass a point farther off (rms) do not meet there. Parallel axes miss every point by 1."""
NOMINAL = 3.0
"""Spreads of the lights before them: where an object is thought to be, for the lights' directions only, where no axes say it."""


def is_one(path: Path) -> bool:
    """Whether a path is such a file, or a folder with one."""
    return (path.is_dir() and (path / FILE).is_file()) or (path.is_file() and path.suffix.lower() == ".mat")


def read(path: Path) -> Calibration:
    """Read the lights, and the camera where camera.mat stands beside them.

    Raises
    ------
    InputError
        Not a MATLAB file, or a variable is lacking or of another form.
    DegenerateError
        All lights stand at one place.
    """
    file = path / FILE if path.is_dir() else path
    stored = read_matrices(file)
    S = _matrix(stored, "S", file, 3) * M_FROM_MM
    count = len(S)
    mu = np.ravel(_matrix(stored, "mu", file, None)) if "mu" in stored else np.zeros(count)
    Phi = _matrix(stored, "Phi", file, None) if "Phi" in stored else np.ones((count, 1))
    Phi = Phi.T if Phi.shape[0] == 1 and Phi.shape[1] == count != 1 else Phi
    aimed = "Dir" in stored
    if not aimed and np.any(mu > 0):
        raise InputError("holds no Dir", where=str(file), needed="Dir, the lights' axes, where mu > 0", todo="add Dir, or mu = 0")
    Dir = unit_rows(_matrix(stored, "Dir", file, 3), str(file)) if aimed else np.tile([0.0, 0.0, 1.0], (count, 1))
    if not count == len(Dir) == len(Phi) == len(mu) or Phi.shape[1] not in {1, 3}:
        raise InputError(
            f"S, Dir, Phi and mu have {count}, {len(Dir)}, {len(Phi)} and {len(mu)} rows", where=str(file), needed="one a light"
        )
    if np.any(mu < 0):
        raise InputError(f"mu of light {int(np.argmax(mu < 0)) + 1} is negative", where=str(file), needed="exponents of 0 or more")
    spread = _spread(S)
    if not spread > 0:
        raise DegenerateError("all lights stand at one place", where=str(file), needed="lights at different places, S in mm")
    power = scaled(positive(Phi, str(file)))
    middle = _meeting_point(S, Dir) if aimed and np.any(mu > 0) else None
    about = nominal_point(S) if middle is None else middle
    lights = tuple(
        Light(
            str(k + 1),
            of_light(S[k] - about, f"{file}, light {k + 1}"),
            power[k],
            None,
            S[k],
            Dir[k],
            Lobe("cosine", exponent=float(mu[k])) if mu[k] > 0 else Lobe(),
        )
        for k in range(count)
    )
    distance = None if middle is None else float(np.linalg.norm(middle))
    return Calibration(file.resolve().parent.name or file.stem, lights, _camera(file.parent / CAMERA), None, distance, middle)


def nominal_point(S: Array) -> Array:
    """A point (3,) on the camera's axis before the lights (N, 3): where their directions are counted from if nothing states it."""
    return np.array([0.0, 0.0, max(float(S[:, 2].mean()), 0.0) + NOMINAL * _spread(S)])


def _camera(file: Path) -> Camera | None:
    if not file.is_file():
        return None
    K = _matrix(read_matrices(file), "K", file, 3)
    if K.shape != (3, 3):
        raise InputError(f"K is {K.shape[0]}x{K.shape[1]}", where=str(file), needed="3 x 3")
    K = K.T if K[0, 2] == 0 else K
    images = sorted(path for path in file.parent.iterdir() if path.suffix.lower() in image_endings() and not path.name.startswith("."))
    if K[2, 2] != 0:
        K = K / K[2, 2]
    guess = (round(2 * float(K[0, 2])) + 1, round(2 * float(K[1, 2])) + 1)
    size = read_image(images[0]).size if images else guess
    return sane_camera(Camera(size, "opencv4", K, np.zeros(4), size_guessed=not images), str(file))


def _spread(S: Array) -> float:
    """Root mean square distance of the lights (N, 3) from their middle."""
    return float(np.sqrt(np.mean(np.sum((S - S.mean(axis=0)) ** 2, axis=1))))


def _meeting_point(S: Array, Dir: Array) -> Array | None:
    """The point nearest to all axes; None where they do not meet, or not before the lights and the camera."""
    across = np.eye(3) - Dir[:, :, None] * Dir[:, None, :]
    point = np.asarray(np.linalg.lstsq(across.sum(axis=0), np.einsum("kij,kj->i", across, S), rcond=None)[0])
    off = np.sqrt(np.mean(np.sum(np.einsum("kij,kj->ki", across, point - S) ** 2, axis=1)))
    before = np.mean(np.einsum("ki,ki->k", Dir, point - S) > 0) > 0.5
    return point if off < MISS * _spread(S) and before and point[2] > 0 else None


def _matrix(stored: dict[str, Array], key: str, file: Path, columns: int | None) -> Array:
    if key not in stored:
        held = f"; it holds {', '.join(sorted(stored))[:100]}" if stored else ""
        raise InputError(f"holds no {key}{held}", where=str(file), needed="S, Dir, Phi, mu (light.mat) or K (camera.mat)")
    value = stored[key]
    if not value.size or not np.isfinite(value).all() or (columns is not None and value.shape[1] != columns):
        raise InputError(
            f"{key} is {value.shape[0]}x{value.shape[1]} or not finite", where=str(file), needed=f"N x {columns or 1} finite numbers"
        )
    if np.abs(value).max() > LARGEST:
        raise InputError(f"{key} holds {np.abs(value).max():.3g}", where=str(file), needed="numbers of lights", todo="is the file damaged?")
    return value


FORMAT = (is_one, read)
