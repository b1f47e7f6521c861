r"""Boards that the camera did not see at a reading: through the room, by the panel's pose and the hand-eye transforms.

Symbols: a, e, f, d errors of H_OP, H_PC, H_OB (left perturbations) and of the clock offset, w the twist by which H_OP changes a second::

    H_CB = H_CP H_PO H_OB          xi = Ad(H_CO) (f - a + w d) - Ad(H_CP) e
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import HandEye

SHARED = 13
"""Errors that readings through one room share: of H_PC (6), of H_OB (6), of the clock offset."""


def boards_through_room(handeye: HandEye, H_OP: Array, variance: Array, velocity: Array) -> tuple[Array, Array, Array]:
    """H_CB (N, 4, 4), each one's own covariance (N, 6, 6), and by what the shared errors act on it (N, 6, 13).

    `variance` (N, 6) is that of the turn and the origin of H_OP (N, 4, 4) an axis, `velocity` (N, 6) of the turn and the origin.
    """
    H_CP, H_PO = se3.inv(handeye.H_PC), se3.inv(H_OP)
    H_CB = H_CP @ H_PO @ handeye.H_OB
    A = se3.adjoint(H_CP @ H_PO)
    T = np.linalg.inv(se3.turn_and_origin_jacobian(H_OP))
    own = (A @ T) @ (variance[:, :, None] * np.swapaxes(A @ T, 1, 2))
    twist = np.concatenate([velocity[:, :3], velocity[:, 3:] - np.cross(velocity[:, :3], H_OP[:, :3, 3])], axis=1)
    by_room = np.zeros((len(H_OP), 6, SHARED))
    by_room[:, :, :6] = -se3.adjoint(H_CP)
    by_room[:, :, 6:12] = A
    by_room[:, :, 12] = np.einsum("nij,nj->ni", A, twist)
    return H_CB, own, by_room


def room_covariance(handeye: HandEye) -> Array:
    """Covariance (13, 13) of the shared errors; that H_PC and H_OB err together is not counted, which makes readings count less."""
    found = np.zeros((SHARED, SHARED))
    found[:6, :6], found[6:12, 6:12] = handeye.H_PC_covariance, handeye.H_OB_covariance
    found[12, 12] = max(handeye.clock_offset_std_s or 0.0, LEAST_CLOCK_S) ** 2
    return found


LEAST_CLOCK_S = 1e-5
"""Seconds within which a clock offset is known at best."""
