"""``mocap.poses``: one pose an image, without a clock.

Either a csv whose names say the position, the rotation and the image (without a column of images they are in the images' order), or rows
of numbers in that order: 4x4 matrices, 16 (or 12) numbers a line or a row of four a line (a matrix may stand transposed, its translation
in the last row), six numbers a line where ``mocap.rotation`` says what the last three are, or seven where ``mocap.quaternion`` says in
what order the quaternion is. A unit may follow a name: ``x_mm``, ``A [deg]``. Or as robots' controllers and programs write them:

- Universal Robots: ``p[x, y, z, rx, ry, rz]``, metres and a rotation vector in radians.
- KUKA: ``{X 100.0, Y 0.0, Z 300.0, A 0.0, B 90.0, C 0.0}`` with or without a type before it, millimetres and degrees.
- ABB: ``[[x, y, z], [q1, q2, q3, q4], ...]``, millimetres and a quaternion whose first number is the scalar.
- Matrices in brackets, as numpy and MATLAB print them, and lists of them in JSON or YAML, or in a .npy or .npz: (N, 4, 4) or (N, 3, 4), or
  one under each image's name.

========================  =============================================================================================
columns                   rotation
========================  =============================================================================================
qx, qy, qz, qw            a quaternion
rx, ry, rz                a rotation vector in radians (Universal Robots)
A, B, C                   R = Rz(A) Ry(B) Rx(C), degrees (KUKA); ``mocap.rotation: xyz_deg`` for Rx Ry Rz, ``zyz_deg`` for Rz Ry Rz
roll, pitch, yaw          R = Rz(yaw) Ry(pitch) Rx(roll) (URDF, ROS); W, P, R likewise in degrees (Fanuc)
========================  =============================================================================================
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.formats.number_arrays import ARRAYS, matrix_rows, read_arrays
from lpcal.formats.number_table import COMMENTS, is_number
from lpcal.formats.pose_table import METRES, rounded_notes
from lpcal.formats.reading import reader
from lpcal.formats.text import read_text, with_commas
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
UR = re.compile(rf"p\s*\[\s*((?:{NUMBER}\s*,\s*){{5}}{NUMBER})\s*\]")
KUKA = re.compile(
    rf"\bX\s*=?\s*({NUMBER})\s*,\s*Y\s*=?\s*({NUMBER})\s*,\s*Z\s*=?\s*({NUMBER})\s*,\s*A\s*=?\s*({NUMBER})\s*,\s*B\s*=?\s*({NUMBER})\s*,\s*C\s*=?\s*({NUMBER})"
)
ABB = re.compile(rf"\[\s*\[((?:\s*{NUMBER}\s*,){{2}}\s*{NUMBER}\s*)\]\s*,\s*\[((?:\s*{NUMBER}\s*,){{3}}\s*{NUMBER}\s*)\]")
BRACKETS = re.compile(r"[\[\](){};]|\barray\b")
LAYOUT = "file, x_m, y_m, z_m, qx, qy, qz, qw, or 4x4 matrices in the images' order"
RIGID = 5e-3
"""How far the product of a matrix and its transpose may be from the unit matrix: files keep four digits and more."""
MOST_M = 20.0
"""Metres that no robot or room reaches: larger numbers without a unit are millimetres."""
NAMES = {"file": ("file", "image", "filename", "name"), "x": ("x", "tx", "px"), "y": ("y", "ty", "py"), "z": ("z", "tz", "pz")}
NOTHING = ("", "nan", "null", "none", "n/a", "na", "-")
"""Words for no number: a row of them is an image without a pose."""
NAMED = 3
FROM_0, FROM_1 = ("q0", "q1", "q2", "q3"), ("q1", "q2", "q3", "q4")
FEWEST_POSES = 3
"""Poses from which the size of all angles says something."""
UNIT = re.compile(r"(.*?)(?:_|\s*[\[(]\s*)(m|cm|mm|rad|deg)\s*[\])]?$")


ROTATIONS: dict[str, Callable[[Array], Array]] = {
    "rotation_vector": se3.rotation,
    "rotation_vector_deg": lambda v: se3.rotation(np.deg2rad(v)),
    "abc_deg": lambda v: se3.rotation_about_axes(np.deg2rad(v), "zyx"),
    "xyz_deg": lambda v: se3.rotation_about_axes(np.deg2rad(v), "xyz"),
    "zyz_deg": lambda v: se3.rotation_about_axes(np.deg2rad(v), "zyz"),
    "rpy_deg": lambda v: se3.rotation_about_axes(np.deg2rad(v[:, ::-1]), "zyx"),
    "rpy_rad": lambda v: se3.rotation_about_axes(v[:, ::-1], "zyx"),
}
"""Rotations (N, 3, 3) of three numbers (N, 3), by what ``mocap.rotation`` calls them."""
TRIPLES: dict[tuple[str, ...], str] = {
    ("rx", "ry", "rz"): "rotation_vector",
    ("a", "b", "c"): "abc_deg",
    ("roll", "pitch", "yaw"): "",
    ("w", "p", "r"): "rpy_deg",
}
"""What columns of these names hold where neither a unit nor panel.yaml says otherwise; empty: it must be said."""


@dataclass(frozen=True)
class ImagePoses:
    """One pose an image.

    Parameters
    ----------
    H : ndarray (N, 4, 4)
        The body in the room, metres.
    files : tuple of str, optional
        The images that they belong to, where the file names them.
    notes : tuple of str
        What the reader had to decide, in words.
    lost : tuple of int
        Rows of H that are exactly the identity, as a lost body is written.
    format : str
        The layout that the file was recognised as.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> lpcal.tables.ImagePoses(np.eye(4)[None], ("a.png",)).files
    ('a.png',)
    """

    H: Array
    files: tuple[str, ...] | None
    notes: tuple[str, ...] = ()
    lost: tuple[int, ...] = ()
    """Rows of H that are exactly the identity, as a lost body is written; the first alone may be the place that all count from."""
    format: str = ""
    """The layout that the file was recognised as."""


@dataclass(frozen=True)
class Stated:
    """What panel.yaml says of the file."""

    quaternion: str | None = None
    units: str | None = None
    direction: str = "H_OP"
    rotation: str | None = None


@reader("a csv of poses, or rows of numbers")
def read_robot_poses(path: Path, stated: Stated = Stated()) -> ImagePoses:
    """One pose an image.

    Raises
    ------
    InputError
        None of the layouts, or a matrix that is no rigid transform; with its line.
    DisagreementError
        Two rows for one image.
    DegenerateError
        No pose but the identity.
    """
    text = with_commas(_plain(path), path)
    lines = [
        (number, line.strip())
        for number, line in enumerate(text.split("\n"), start=1)
        if line.strip(", \t") and not line.lstrip().startswith(COMMENTS)
    ]
    if not lines:
        raise InputError("empty", where=str(path), needed=LAYOUT)
    cells = [_cells(line) for _, line in lines]
    numbers = [number for number, _ in lines]
    if len(cells[0]) in {13, 17} and not is_number(cells[0][0]) and all(map(is_number, cells[0][1:])):
        name, poses = "matrices by image", _named_matrices(cells, numbers, path, stated)
    elif not all(map(is_number, cells[0])):
        name, poses = "csv with names, an image a row", _table(cells, numbers, path, stated)
    elif len(cells[0]) in {6, 7}:
        name, poses = f"{len(cells[0])} numbers a line, in the images' order", _by_place(cells, numbers, path, stated)
    else:
        name, poses = "matrices, in the images' order", _matrices(cells, numbers, path, stated)
    lost = tuple(int(row) for row in np.flatnonzero(np.all(poses.H - np.eye(4) == 0, axis=(1, 2))))
    lost = () if lost == (0,) else lost
    if len(lost) == len(poses.H):
        raise DegenerateError(f"all {len(lost)} poses are the identity", where=str(path), needed="a tracked body", todo="export it again")
    notes = (*poses.notes, *[f"{len(lost)} poses are the identity: lost"] * bool(lost), *rounded_notes(poses.H))
    return ImagePoses(se3.inv(poses.H) if stated.direction == "H_PO" else poses.H, poses.files, notes, lost, name)


def _plain(path: Path) -> str:
    """A file of poses as text: a csv with names, or rows of numbers, line by line as in the file where it holds lines."""
    if path.suffix.lower() not in ARRAYS:
        return _made_plain(read_text(path, LAYOUT))
    return matrix_rows(read_arrays(path, LAYOUT), path)


def _made_plain(text: str) -> str:
    """A controller's lines as a csv, brackets about numbers taken away; other text as it is."""
    lines = text.split("\n")
    for pattern, header in ((UR, "x_m,y_m,z_m,rx,ry,rz"), (KUKA, "x_mm,y_mm,z_mm,A,B,C"), (ABB, "x_mm,y_mm,z_mm,qw,qx,qy,qz")):
        matches = [pattern.search(line) for line in lines]
        if any(matches):
            rows = [",".join(match.groups()).replace(" ", "") if match else "" for match in matches]
            first = next(k for k, row in enumerate(rows) if row)
            rows[first] = f"{header}\n{rows[first]}"
            return "\n".join(rows)
    bare = ["" if line.lstrip().startswith(COMMENTS) else BRACKETS.sub(" ", line).strip().rstrip(",") for line in lines]
    filled = [line for line in bare if line.strip()]
    if filled and any(BRACKETS.search(line) for line in lines) and not re.search(r"[A-DF-Za-df-z]", "".join(filled)):
        return "\n".join(re.sub(r"[\s,]+", " ", line) for line in bare)
    return text


def _cells(line: str) -> list[str]:
    if "," in line:
        return [cell.strip() for cell in line.split(",")]
    return line.split()


def _floats(cells: list[str], where: str) -> list[float]:
    """Cells as finite numbers."""
    wrong = next((cell for cell in cells if not is_number(cell) or not np.isfinite(float(cell))), None)
    if wrong is not None:
        raise InputError(f"{wrong!r}", where=where, needed="a finite number", todo="is the file cut off?")
    return [float(cell) for cell in cells]


def _table(cells: list[list[str]], lines: list[int], path: Path, stated: Stated) -> ImagePoses:
    """A csv with names."""
    names, units = _names(cells[0])
    _number_quaternion(names, stated, f"{path}:{lines[0]}")
    triple = next((triple for triple in TRIPLES if set(triple) <= set(names)), None)
    turn = ("qx", "qy", "qz", "qw") if "qw" in names or triple is None else triple
    lacking = [name for name in ("x", "y", "z", *turn) if name not in names]
    if lacking:
        raise InputError(f"no column for {', '.join(lacking)}", where=f"{path}:{lines[0]}", needed=LAYOUT, todo="name the columns so")
    files: dict[str, int] = {}
    rows, row_lines, left_out = [], [], []
    for row, line in zip(cells[1:], lines[1:], strict=True):
        if len(row) < len(cells[0]):
            raise InputError(f"{len(row)} cells", where=f"{path}:{line}", needed=f"{len(cells[0])}", todo="is the file cut off?")
        name = row[names["file"]] if "file" in names else f"row {line}"
        values = [row[names[key]] for key in ("x", "y", "z", *turn)]
        if "file" in names and all(value.lower() in NOTHING for value in values):
            left_out.append(name)
            continue
        if name in files:
            raise DisagreementError(
                f"{name} stands in line {files[name]} already",
                where=f"{path}:{line}",
                needed="one pose an image",
                todo="remove one of them",
            )
        files[name] = line
        rows.append(_floats(values, f"{path}:{line}"))
        row_lines.append(line)
    numbers = np.array(rows).reshape(-1, 3 + len(turn))
    if not rows:
        raise InputError("no rows", where=str(path), needed="a row an image")
    x, notes = _metres(numbers[:, :3], units.get("x"), stated)
    notes = (*notes, *[f"no pose of {', '.join(left_out[:NAMED])}{' and others' * (len(left_out) > NAMED)}"] * bool(left_out))
    named = tuple(files) if "file" in names else None
    if turn[0] == "qx":
        by_number = "q1" in names
        q = numbers[:, [4, 5, 6, 3]] if stated.quaternion == "wxyz" and names["qx"] < names["qw"] and not by_number else numbers[:, 3:]
        return ImagePoses(se3.transform(_of_quaternions(q, path, row_lines), x), named, notes)
    R, said = _rotations(numbers[:, 3:], turn, units.get(turn[0]), stated, f"{path}:{lines[0]}")
    return ImagePoses(se3.transform(R, x), named, (*notes, *said))


def _names(cells: list[str]) -> tuple[dict[str, int], dict[str, str]]:
    """Places of the columns by name, and their units where the names state them."""
    names: dict[str, int] = {}
    units: dict[str, str] = {}
    for place, cell in enumerate(cells):
        text = cell.strip().lower().replace("pos_", "").replace("position_", "").replace("quat_", "q")
        match = UNIT.fullmatch(text)
        text, unit = (match.group(1).strip(), match.group(2)) if match else (text, "")
        key = next((key for key, known in NAMES.items() if text in known), text)
        if key not in names:
            names[key] = place
            units[key] = unit
    return names, units


def _number_quaternion(names: dict[str, int], stated: Stated, where: str) -> None:
    """Give the columns q0 to q3, or q1 to q4, the names of what they hold: q0 is the scalar, q1 of four may be.

    Raises
    ------
    InputError
        They are q1 to q4, and nothing says which is the scalar.
    """
    if set(FROM_0) <= names.keys():
        names |= {name: names[column] for name, column in zip(("qw", "qx", "qy", "qz"), FROM_0, strict=True)}
    elif set(FROM_1) <= names.keys():
        if stated.quaternion is None:
            raise InputError(
                "q1, q2, q3, q4: which of them is the scalar does not show",
                where=where,
                needed="the order of the quaternion",
                todo="state mocap.quaternion in panel.yaml: wxyz (ABB: q1 is the scalar) | xyzw, or name the columns qx, qy, qz, qw",
            )
        names |= {f"q{axis}": names[column] for axis, column in zip(stated.quaternion, FROM_1, strict=True)}


def _metres(x: Array, unit: str | None, stated: Stated) -> tuple[Array, tuple[str, ...]]:
    """Positions in metres, by what panel.yaml or the names say, or by their size."""
    if stated.units or unit in METRES:
        return METRES[stated.units or str(unit)] * x, ()
    if np.median(np.abs(x).max(axis=1)) > MOST_M:
        return 1e-3 * x, ("positions without a unit are taken as millimetres: as metres they would be hundreds; mocap.units states it",)
    return x, ()


def _rotations(v: Array, names: tuple[str, ...], unit: str | None, stated: Stated, where: str) -> tuple[Array, tuple[str, ...]]:
    """Rotations (N, 3, 3) of three numbers, by what panel.yaml says, the names and their unit."""
    kind = stated.rotation or TRIPLES[names]
    if stated.rotation is None and unit == "rad" and names[0] == "a":
        v, unit = np.rad2deg(v), "deg"
    if stated.rotation is None and unit in {"deg", "rad"}:
        kind = {"rotation_vector": {"deg": "rotation_vector_deg", "rad": "rotation_vector"}}.get(
            kind, {"deg": "rpy_deg", "rad": "rpy_rad"}
        )[unit]
        kind = "abc_deg" if names[0] == "a" and unit == "deg" else kind
    too_large = kind in {"rotation_vector", "rpy_rad"} and np.abs(v).max() > 2 * np.pi + 1e-3
    if not kind or too_large:
        found = f"{', '.join(names)}: {'too large for radians' if too_large else 'degrees or radians'}"
        raise InputError(
            found, where=where, needed="what they are", todo=f"state mocap.rotation in panel.yaml: {' | '.join(ROTATIONS)}, or name a unit"
        )
    _refuse_radians(v, kind, where)
    return ROTATIONS[kind](v), (f"{', '.join(names)} read as {kind.replace('_', ' ')}",)


def _refuse_radians(v: Array, kind: str, where: str) -> None:
    """Refuse angles (N, 3) of some degrees at most: a body that turns by no more shows nothing, and radians are never larger.

    Raises
    ------
    DisagreementError
        They are.
    """
    if kind.endswith("_deg") and len(v) >= FEWEST_POSES and np.abs(v).max() <= np.pi + 1e-3 and np.ptp(v, axis=0).max() > 0:
        raise DisagreementError(
            f"angles of {np.abs(v).max():.3g} at most, read as degrees ({kind.replace('_', ' ')})",
            where=where,
            needed="degrees: a body that turns by so little tells nothing",
            todo="if they are radians, say so: mocap.rotation: rpy_rad or rotation_vector, or names such as A_rad",
        )


def _by_place(cells: list[list[str]], lines: list[int], path: Path, stated: Stated) -> ImagePoses:
    """Six or seven numbers a line: a position, and what panel.yaml says."""
    count = len(cells[0])
    if (stated.rotation if count == 6 else stated.quaternion) is None:
        todo = f"mocap.rotation in panel.yaml: {' | '.join(ROTATIONS)}" if count == 6 else "mocap.quaternion in panel.yaml: xyzw | wxyz"
        raise InputError(
            f"{'six' if count == 6 else 'seven'} numbers a line: a position, and a rotation that nothing names",
            where=f"{path}:{lines[0]}",
            needed="what the last three are" if count == 6 else "the order of the quaternion",
            todo=f"state {todo}",
        )
    for row, line in zip(cells, lines, strict=True):
        if len(row) != count:
            needed = f"{count}, as in the first row"
            raise InputError(f"{len(row)} numbers", where=f"{path}:{line}", needed=needed, todo="is the file cut off?")
    numbers = np.array([_floats(row, f"{path}:{line}") for row, line in zip(cells, lines, strict=True)])
    x, notes = _metres(numbers[:, :3], None, stated)
    if count == 7:
        q = numbers[:, [4, 5, 6, 3]] if stated.quaternion == "wxyz" else numbers[:, 3:]
        return ImagePoses(se3.transform(_of_quaternions(q, path, lines), x), None, notes)
    assert stated.rotation is not None
    _refuse_radians(numbers[:, 3:], stated.rotation, str(path))
    return ImagePoses(se3.transform(ROTATIONS[stated.rotation](numbers[:, 3:]), x), None, notes)


def _of_quaternions(q: Array, path: Path, lines: list[int]) -> Array:
    """Rotations (N, 3, 3) of quaternions (N, 4), x y z w, that stand in these lines."""
    length = np.linalg.norm(q, axis=1)
    wrong = np.flatnonzero(np.abs(length - 1) > 0.02)
    if wrong.size:
        found = f"a quaternion of length {length[wrong[0]]:.3g}"
        raise InputError(found, where=f"{path}:{lines[wrong[0]]}", needed="length 1", todo="is the row cut off?")
    return se3.rotation_from_quaternion(q)


def _named_matrices(cells: list[list[str]], lines: list[int], path: Path, stated: Stated) -> ImagePoses:
    """An image's name and its matrix a line."""
    poses = _matrices([row[1:] for row in cells], lines, path, stated)
    return ImagePoses(poses.H, tuple(row[0] for row in cells), poses.notes)


def _matrices(cells: list[list[str]], lines: list[int], path: Path, stated: Stated) -> ImagePoses:
    numbers: list[float] = []
    starts: list[int] = []
    for row, line in zip(cells, lines, strict=True):
        found = [cell for cell in row if cell]
        values = _floats(found, f"{path}:{line}")
        if len(values) not in {4, 12, 16}:
            found_many = f"{len(values)} numbers"
            raise InputError(found_many, where=f"{path}:{line}", needed="16, 12 or 4 numbers a line", todo="is the file cut off?")
        numbers += [*values, *([0.0, 0.0, 0.0, 1.0] if len(values) == 12 else [])]
        starts += [line] * (4 if len(values) > 4 else 1)
    if len(numbers) % 16:
        raise InputError(f"{len(numbers)} numbers", where=f"{path}:{lines[-1]}", needed="16 a pose", todo="is the file cut off?")
    H = np.array(numbers).reshape(-1, 4, 4)
    if np.any(H[:, 3, :3]) and not np.any(H[:, :3, 3]):
        H = np.swapaxes(H, 1, 2).copy()
    R = H[:, :3, :3]
    with np.errstate(over="ignore", invalid="ignore"):
        off = np.abs(R @ np.swapaxes(R, 1, 2) - np.eye(3)).max(axis=(1, 2)) + np.abs(H[:, 3] - [0, 0, 0, 1]).max(axis=1)
        wrong = np.flatnonzero(~(off < RIGID) | (np.linalg.det(R) < 0))
    if wrong.size:
        raise InputError(
            "a matrix that is no rotation and translation", where=f"{path}:{starts[4 * wrong[0]]}", needed="a rigid 4x4 matrix"
        )
    H[:, :3, :3] = se3.nearest_rotation(R)
    H[:, :3, 3], notes = _metres(H[:, :3, 3], None, stated)
    return ImagePoses(H, None, notes)
