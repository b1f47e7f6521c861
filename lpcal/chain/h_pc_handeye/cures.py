r"""What may have been done to poses on their way into a file, each with its undoing: inverted, reordered, mirrored, their axes exchanged.

Positions whose axes were changed and rotations whose were not (y up made z up of the one alone) leave a linear law in an unknown 3x3 M::

    R_OP t_PC + M x_OP - t_OB = -R_OP R_PC t_CB        of every view, R_PC from the rotations alone

Its solution M is, but for the scale, the signed permutation that puts the positions right.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from lpcal.geometry import park, se3
from lpcal.geometry.arrays import Array

SHIFTS = (1, -1, 2, -2, 3, -3)
NEAR_WHOLE = 0.2
"""How far the numbers of M, its scale taken away, may be from whole ones: ten times what noise leaves in a session of twelve views."""
PAIRS = "correct the images' names or times: mocap.poses or mocap.images"
RIGHT_HANDED = "export the recording again in a right-handed frame (x forward, y left, z up, or y up: both are right-handed)"
CONJUGATE = "transpose the matrices, or turn over the signs of qx, qy and qz,"
type Cure = tuple[str | None, str, Array, Array]
"""What was done, in words; what to do about it; H_OP and H_CB with it undone."""
ANGLES: dict[str, Callable[[Array], Array]] = {
    "abc_deg": lambda v: se3.rotation_about_axes(v, "zyx"),
    "xyz_deg": lambda v: se3.rotation_about_axes(v, "xyz"),
    "zyz_deg": lambda v: se3.rotation_about_axes(v, "zyz"),
    "rpy_deg": lambda v: se3.rotation_about_axes(v[:, ::-1], "zyx"),
    "rotation_vector_deg": se3.rotation,
}
"""Rotations (N, 3, 3) of three numbers (N, 3) in radians, by what ``mocap.rotation`` calls them."""
MEANT = {
    "abc_deg": "angles about z, y', x''",
    "xyz_deg": "angles about x, y', z''",
    "zyz_deg": "angles about z, y', z''",
    "rpy_deg": "roll, pitch, yaw",
    "rotation_vector_deg": "a rotation vector",
}


def cures(H_OP: Array, H_CB: Array, *, in_order: bool, from_images: bool) -> Iterator[Cure]:
    """What might have gone wrong, what to do, and the data with it undone."""
    yield None, "", H_OP, H_CB
    todo = "write mocap.direction: H_PO (or H_OP, if it says H_PO); or mocap.carries: board, if the camera stands still in the room"
    yield "the mocap poses are inverted: they take room to body", todo, se3.inv(H_OP), H_CB
    if not from_images:
        yield from _other_boards(H_OP, H_CB)
    q = se3.quaternion(H_OP[:, :3, :3])
    for order, place, other in (("w, x, y, z", [1, 2, 3, 0], "wxyz"), ("x, y, z, w", [3, 0, 1, 2], "xyzw")):
        H = with_rotations(H_OP, se3.rotation_from_quaternion(q[:, place]))
        words = f"the quaternions are in another order: they are {order}"
        yield words, f"write mocap.quaternion: {other}", H, H_CB
        yield f"{words}, and the poses are inverted", f"write mocap.quaternion: {other} and mocap.direction: H_PO", se3.inv(H), H_CB
    yield from _other_angles(H_OP, H_CB)
    yield from _other_axes(H_OP, H_CB)
    for shift in SHIFTS if in_order else ():
        poses, boards = (H_OP[shift:], H_CB[:-shift]) if shift > 0 else (H_OP[:shift], H_CB[-shift:])
        if len(poses) >= 6:
            words = f"the pairing is shifted by {abs(shift)}: view k belongs to the pose of view k{shift:+d}"
            yield words, PAIRS, poses, boards
    if in_order and len(H_OP) >= 6:
        yield "the poses are in backward order", PAIRS, H_OP[::-1], H_CB
        for first in (0, 1) if len(H_OP) > 10 else ():
            by_text = np.argsort([str(k + first) for k in range(len(H_OP))], kind="stable")
            for rows, which in ((by_text, "images"), (np.argsort(by_text), "poses")):
                yield f"the {which} are in the order of their names as text (1, 10, 11, 2), the others are not", PAIRS, H_OP[rows], H_CB


def _other_angles(H_OP: Array, H_CB: Array) -> Iterator[tuple[str, str, Array, Array]]:
    """Three numbers of a rotation read as one thing that are another; where poses hold no such numbers, none of it corrects anything."""
    R = H_OP[:, :3, :3]
    zyx = se3.angles_about_zyx(R)
    for read, v in (("abc_deg", zyx), ("rpy_deg", zyx[:, ::-1]), ("rotation_vector", se3.rotation_vector(R))):
        for name, meant in ANGLES.items():
            if name != read and (read, name) != ("rpy_deg", "abc_deg"):
                H = with_rotations(H_OP, meant(v))
                words = f"the rotations' three numbers are of another order or kind than {read.split('_deg')[0]}: {MEANT[name]}"
                todo = f"write mocap.rotation: {name}{_other_way(read, name)}; of a recording, export quaternions"
                yield words, todo, H, H_CB


def _other_way(read: str, name: str) -> str:
    """What to add where the same corrects the other mistake, and where a rotation vector, in radians, turned out to hold angles."""
    if (read, name) == ("abc_deg", "rpy_deg"):
        return " (or abc_deg, if it says rpy)"
    return " (the numbers in degrees)" if read == "rotation_vector" else ""


def _other_boards(H_OP: Array, H_CB: Array) -> Iterator[Cure]:
    """Board poses found elsewhere: inverted, or with their quaternions otherwise than they are read."""
    todo = "write mocap.board_poses.direction: H_BC (or H_CB, if it says H_BC); or mocap.carries: board, if the camera stands still"
    yield "the board poses are inverted", todo, H_OP, se3.inv(H_CB)
    q = se3.quaternion(H_CB[:, :3, :3])
    for order, place in (("w, x, y, z", [1, 2, 3, 0]), ("x, y, z, w", [3, 0, 1, 2])):
        words = f"the board poses' quaternions are in another order: they are {order}"
        todo = "name the columns of the board poses as they are: x_m, y_m, z_m and qx, qy, qz, qw in their order"
        yield words, todo, H_OP, with_rotations(H_CB, se3.rotation_from_quaternion(q[:, place]))
    words = "the rotations of the board poses are inverted, their positions are not"
    yield words, f"{CONJUGATE} of the board poses", H_OP, with_rotations(H_CB, np.swapaxes(H_CB[:, :3, :3], 1, 2))


def _other_axes(H_OP: Array, H_CB: Array) -> Iterator[Cure]:
    """Rotations alone inverted, axes turned over or exchanged: of the positions, or of all."""
    conjugate = with_rotations(H_OP, np.swapaxes(H_OP[:, :3, :3], 1, 2))
    words = "the rotations of the mocap poses are inverted, their positions are not"
    yield words, f"{CONJUGATE} of the recording", conjugate, H_CB
    for axis in range(3):
        flip = np.eye(4)
        flip[axis, axis] = -1
        words = f"the positions are mirrored along {'xyz'[axis]}: the recording is left-handed"
        yield words, RIGHT_HANDED, with_positions(H_OP, flip[:3, :3]), H_CB
    mirror = np.diag([1.0, -1.0, 1.0, 1.0])
    yield "the poses are mirrored: the recording is left-handed", RIGHT_HANDED, mirror @ H_OP @ mirror, H_CB
    words = "two axes of the poses are exchanged, of positions and quaternions alike: the recording is left-handed"
    yield words, RIGHT_HANDED, mirror @ conjugate @ mirror, H_CB
    P = axes_of_positions(H_OP, H_CB)
    if P is not None and np.abs(P - np.diag(np.diag(P))).max() + (np.trace(P) == -1) > 0:
        named = ", ".join(("" if row.sum() > 0 else "-") + "xyz"[int(np.abs(row).argmax())] for row in P)
        words = f"positions and rotations are of different axes: the rotations' x, y, z are the positions' {named}"
        yield words, "turn both into the same axes, or neither, when the recording is exported", with_positions(H_OP, P), H_CB


def axes_of_positions(H_OP: Array, H_CB: Array) -> Array | None:
    """The signed permutation (3, 3) that takes positions to the axes of the rotations; None where nothing near to one fits."""
    agreed = park.consensus_of_rotations(H_OP, H_CB)
    if agreed is None:
        return None
    R_PC, inliers = agreed
    R_OP, x_OP, t_CB = H_OP[inliers, :3, :3], H_OP[inliers, :3, 3], H_CB[inliers, :3, 3]
    across = np.einsum("ij,nk->nijk", np.eye(3), x_OP).reshape(-1, 3, 9)
    A = np.concatenate([R_OP, across, np.broadcast_to(-np.eye(3), (len(R_OP), 3, 3))], axis=2).reshape(-1, 15)
    found, _, rank, _ = np.linalg.lstsq(A, -(R_OP @ R_PC @ t_CB[..., None]).ravel(), rcond=None)
    M = found[3:12].reshape(3, 3)
    size = float(np.cbrt(np.abs(np.linalg.det(M))))
    if rank < 15 or not size > 0:
        return None
    P = np.rint(M / size)
    whole = np.array_equal(np.abs(P).sum(axis=0), np.ones(3)) and np.array_equal(np.abs(P).sum(axis=1), np.ones(3))
    return P if whole and np.abs(M / size - P).max() < NEAR_WHOLE else None


def with_rotations(H: Array, R: Array) -> Array:
    """Poses (N, 4, 4) with other rotations (N, 3, 3)."""
    return se3.transform(R, H[:, :3, 3])


def with_positions(H: Array, P: Array) -> Array:
    """Poses (N, 4, 4) with positions in other axes, P (3, 3) of them."""
    return se3.transform(H[:, :3, :3], H[:, :3, 3] @ P.T)
