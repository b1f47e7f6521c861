"""A transform in the forms that other programs take: numbers to copy, and easy_handeye's yaml.

Conventions: H_AB takes coordinates in B to coordinates in A, its last column is B's origin in A; quaternions x, y, z, w; roll, pitch, yaw
about fixed axes, ``R = Rz(yaw) Ry(pitch) Rx(roll)`` (URDF); the rotation vector is OpenCV's rvec; ROS publishes child B in parent A.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import yaml

from lpcal.formats.documents import plain
from lpcal.formats.outputs import marked, write_text
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import NAMES, Carries

BOARD, CAMERA, ROOM = "board", "camera", "mocap"


def rpy(H_AB: Array) -> Array:
    """Roll, pitch, yaw (3,) in rad about fixed axes x, y, z in this order."""
    R = H_AB[:3, :3]
    pitch = np.arctan2(-R[2, 0], np.hypot(R[0, 0], R[1, 0]))
    return np.array([np.arctan2(R[2, 1], R[2, 2]), pitch, np.arctan2(R[1, 0], R[0, 0])])


def forms(H_AB: Array, parent: str, child: str) -> dict[str, Any]:
    """The transform in all forms, for a file; `parent` and `child` are the names of A and B."""
    q, x = se3.quaternion(H_AB[:3, :3]), H_AB[:3, 3]
    return {
        "says": f"takes {child} coordinates to {parent} coordinates; the last column is the {child}'s origin in the {parent}'s frame, m",
        "matrix": H_AB,
        "translation_m": x,
        "quaternion_xyzw": q,
        "quaternion_wxyz": q[[3, 0, 1, 2]],
        "rotation_vector_rad": se3.rotation_vector(H_AB[:3, :3]),
        "rpy_rad": rpy(H_AB),
        "urdf": f'<origin xyz="{numbers(x, 6, " ")}" rpy="{numbers(rpy(H_AB), 6, " ")}"/>',
        "ros": _ros(H_AB, parent, child),
    }


def matrix_lines(H_AB: Array) -> list[str]:
    """The matrix as lines to read and copy."""
    last = len(H_AB) - 1
    return [f"{' ' if k else '['}[{numbers(row, 6)}]{']' if k == last else ','}" for k, row in enumerate(H_AB)]


def both_ways(H_PC: Array, H_OB: Array, body: str, carries: Carries = "camera") -> dict[str, dict[str, Any]]:
    """H_PC, H_CP, H_OB, H_BO in all forms; of a board that the body carries H_OC, H_CO, H_PB, H_BP, given in their places."""
    of_camera, of_board = NAMES[carries]
    camera_in, board_in = (ROOM, body) if carries == "board" else (body, ROOM)
    return {
        of_camera: forms(H_PC, camera_in, CAMERA),
        f"H_C{of_camera[2]}": forms(se3.inv(H_PC), CAMERA, camera_in),
        of_board: forms(H_OB, board_in, BOARD),
        f"H_B{of_board[2]}": forms(se3.inv(H_OB), BOARD, board_in),
    }


MARK = "# written by lpcal for easy_handeye\n"
EASY_HANDEYE = marked("an easy_handeye calibration", MARK)


def write_easy_handeye(path: Path, H_PC: Array, body: str, carries: Carries = "camera") -> None:
    """easy_handeye's calibration file, eye on hand: the camera (``tracking_base_frame``) in the body (``robot_effector_frame``).

    Where the body carries the board it is eye on base: the camera in the room (``robot_base_frame``).
    """
    x, y, z = H_PC[:3, 3]
    qx, qy, qz, qw = se3.quaternion(H_PC[:3, :3])
    on_hand = carries == "camera"
    document = {
        "parameters": {
            "eye_on_hand": on_hand,
            "freehand_robot_movement": True,
            "move_group": "manipulator",
            "move_group_namespace": "/",
            "namespace": "/lpcal_eye_on_hand/" if on_hand else "/lpcal_eye_on_base/",
            "robot_base_frame": ROOM,
            "robot_effector_frame": body,
            "tracking_base_frame": CAMERA,
            "tracking_marker_frame": BOARD,
        },
        "transformation": {"qw": qw, "qx": qx, "qy": qy, "qz": qz, "x": x, "y": y, "z": z},
    }
    write_text(path, MARK + yaml.safe_dump(plain(document), sort_keys=False), EASY_HANDEYE)


def numbers(values: Array, digits: int, between: str = ", ") -> str:
    """Numbers side by side."""
    return between.join(f"{value:.{digits}f}" for value in values)


def _ros(H_AB: Array, parent: str, child: str) -> str:
    q, x = se3.quaternion(H_AB[:3, :3]), H_AB[:3, 3]
    return (
        f"ros2 run tf2_ros static_transform_publisher --x {x[0]:.6f} --y {x[1]:.6f} --z {x[2]:.6f} --qx {q[0]:.7f} --qy {q[1]:.7f} "
        f"--qz {q[2]:.7f} --qw {q[3]:.7f} --frame-id {_frame(parent)} --child-frame-id {_frame(child)}"
    )


def _frame(name: str) -> str:
    """A name as a ROS frame may be called: no blanks."""
    return "_".join(name.split())
