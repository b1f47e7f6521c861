"""``mocap.poses``: one pose an image, without a clock.

Either a csv whose names say ``file, x_m, y_m, z_m, qx, qy, qz, qw``, or a text of 4x4 matrices in the images' order: 16 (or 12) numbers a
line, or a row of four a line. A matrix may stand transposed (its translation in the last row).
"""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.number_table import is_number, read_text
from lpcal.formats.pose_table import METRES
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

LAYOUT = "file, x_m, y_m, z_m, qx, qy, qz, qw, or 4x4 matrices in the images' order"
RIGID = 5e-3


@dataclass(frozen=True)
class ImagePoses:
    """H_AB (N, 4, 4), and the images that they belong to where the file names them."""

    H: Array
    files: tuple[str, ...] | None


def read_robot_poses(path: Path, *, quaternion: str | None = None, units: str | None = None, direction: str = "H_OP") -> ImagePoses:
    """One pose an image.

    Raises
    ------
    InputError
        Neither layout, or a matrix that is no rigid transform; with its line.
    """
    text = read_text(path)
    lines = [(number, line) for number, line in enumerate(text.splitlines(), start=1) if line.strip() and not line.lstrip().startswith("#")]
    if not lines:
        raise InputError("empty", where=str(path), needed=LAYOUT)
    cells = [cell for cell in re.split(r"[,;\s]+", lines[0][1].strip()) if cell]
    poses = _matrices(lines, path) if all(map(is_number, cells)) else _table(text, path, quaternion)
    H = poses.H.copy()
    H[:, :3, 3] *= METRES[units or "m"]
    return ImagePoses(se3.inv(H) if direction == "H_PO" else H, poses.files)


def _table(text: str, path: Path, quaternion: str | None) -> ImagePoses:
    reader = csv.DictReader(text.splitlines(), skipinitialspace=True)
    names = {name: re.sub(r"_m$", "", name.strip().lower()) for name in reader.fieldnames or ()}
    lacking = {"file", "x", "y", "z", "qx", "qy", "qz", "qw"} - set(names.values())
    if lacking:
        raise InputError(f"no column for {', '.join(sorted(lacking))}", where=f"{path}:1", needed=LAYOUT, todo="name the columns so")
    files, rows = [], []
    for row in reader:
        cells = {names[name]: value for name, value in row.items() if name in names}
        try:
            rows.append([float(cells[key]) for key in ("x", "y", "z", "qx", "qy", "qz", "qw")])
        except (TypeError, ValueError) as error:
            raise InputError("a cell that is no number", where=f"{path}:{reader.line_num}", needed=LAYOUT, todo="is it cut off?") from error
        files.append(str(cells["file"]).strip())
        if not 0.98 < np.linalg.norm(rows[-1][3:]) < 1.02:
            raise InputError(
                f"a quaternion of length {np.linalg.norm(rows[-1][3:]):.3g}", where=f"{path}:{reader.line_num}", needed="length 1"
            )
    numbers = np.array(rows).reshape(-1, 7)
    q = numbers[:, [4, 5, 6, 3]] if quaternion == "wxyz" else numbers[:, 3:]
    return ImagePoses(se3.transform(se3.rotation_from_quaternion(q), numbers[:, :3]), tuple(files))


def _matrices(lines: list[tuple[int, str]], path: Path) -> ImagePoses:
    numbers: list[float] = []
    starts: list[int] = []
    for number, line in lines:
        cells = [cell for cell in re.split(r"[,;\s]+", line.strip()) if cell]
        wrong = next((cell for cell in cells if not is_number(cell)), None)
        if wrong is not None or len(cells) not in {4, 12, 16}:
            found = f"{wrong!r}" if wrong is not None else f"{len(cells)} numbers"
            raise InputError(found, where=f"{path}:{number}", needed="16, 12 or 4 numbers a line", todo="is the file cut off?")
        numbers += [*map(float, cells), *([0.0, 0.0, 0.0, 1.0] if len(cells) == 12 else [])]
        starts += [number] * (4 if len(cells) > 4 else 1)
    if len(numbers) % 16:
        raise InputError(f"{len(numbers)} numbers", where=f"{path}:{lines[-1][0]}", needed="16 a pose", todo="is the file cut off?")
    H = np.array(numbers).reshape(-1, 4, 4)
    if np.any(H[:, 3, :3]) and not np.any(H[:, :3, 3]):
        H = np.swapaxes(H, 1, 2).copy()
    R = H[:, :3, :3]
    off = np.abs(R @ np.swapaxes(R, 1, 2) - np.eye(3)).max(axis=(1, 2)) + np.abs(H[:, 3] - [0, 0, 0, 1]).max(axis=1)
    wrong_ones = np.flatnonzero(~(off < RIGID) | (np.linalg.det(R) < 0))
    if wrong_ones.size:
        raise InputError(
            "a matrix that is no rotation and translation", where=f"{path}:{starts[4 * wrong_ones[0]]}", needed="a rigid 4x4 matrix"
        )
    H[:, :3, :3] = se3.nearest_rotation(R)
    return ImagePoses(H, None)
