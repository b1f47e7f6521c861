r"""H_OC of a capture: the camera in the room when it was taken, or in the tracked body M that the object rides on.

Symbols: H_OP(t) the body that carries the camera, H_OM(t) the one that carries the object, their measured poses with errors a, b (left
perturbations, ``H = exp(a) H~``), e that of H_PC, d that of the clock offset, (w, v) twists by which the poses change with time::

    H_OC = H_OP H_PC                 xi = a + Ad(H_OP) e - (w_P, v_P) d
    H_MC = H_MO H_OP H_PC            xi = Ad(H_MO) (a - b + Ad(H_OP) e - (w_P - w_M, v_P - v_M) d)

with ``t_mocap = t_camera - offset``. Where the tracked body carries the board the camera stands still in the room, at H_OC of the hand-eye
solve: ``xi = e``, and a tracked object moves before it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.pose_track import TrackPoses
from lpcal.records.placement import Placement, RoomTracking


@dataclass(frozen=True)
class BodyAt:
    """A body in the room at one time."""

    pose: Array
    """(4, 4) the body in the room."""
    covariance: Array
    """(6, 6) of the left perturbation."""
    twist: Array
    """(6,) by which it changes a second: left perturbation."""

    @staticmethod
    def stated(pose: Array, position_std_m: float, turn_std_rad: float) -> BodyAt:
        """A body that stands still where somebody says, within sigmas an axis."""
        return BodyAt(pose, pose_covariance(pose, position_std_m, turn_std_rad), np.zeros(6))

    @staticmethod
    def measured(found: TrackPoses, row: int, tracking: RoomTracking) -> BodyAt:
        """A body at one of a track's times."""
        pose, velocity = found.H[row], found.velocity[row]
        over_usual = np.ones(6) if found.variance is None else found.variance[row]
        covariance = pose_covariance(pose, *tracking.sigmas(steady=bool(found.steady[row])), over_usual)
        twist = np.concatenate([velocity[:3], velocity[3:] - np.cross(velocity[:3], pose[:3, 3])])
        return BodyAt(pose, covariance, twist)


def pose_covariance(pose: Array, position_std_m: float, turn_std_rad: float, over_usual: Array | None = None) -> Array:
    """Covariance (6, 6) of the left perturbation of a pose (4, 4) whose turn and origin are off by sigmas an axis.

    `over_usual` (6,) multiplies the variances of turn and origin.
    """
    variance = np.repeat([turn_std_rad**2, position_std_m**2], 3) * (1.0 if over_usual is None else over_usual)
    T = np.linalg.inv(se3.turn_and_origin_jacobian(pose))
    return np.asarray(T @ np.diag(variance) @ T.T)


def carried_camera(panel: BodyAt, H_PC: Array, tracking: RoomTracking, carrier: BodyAt | None = None, body: str | None = None) -> Placement:
    """The camera that a tracked body carries: in the room, or in the body `carrier` (called `body`) that the object rides on."""
    return _placed(panel.pose @ H_PC, panel.covariance, se3.adjoint(panel.pose), -panel.twist, tracking, carrier, body)


def fixed_camera(pose: Array, tracking: RoomTracking, carrier: BodyAt | None = None, body: str | None = None) -> Placement:
    """The camera that stands still in the room, at a pose (4, 4): there, or in the body `carrier` that the object rides on."""
    return _placed(pose, np.zeros((6, 6)), np.eye(6), np.zeros(6), tracking, carrier, body)


def stated_camera(pose: Array, position_std_m: float, turn_std_rad: float) -> Placement:
    """The camera where somebody says, at a pose (4, 4) within sigmas an axis."""
    noise = pose_covariance(pose, position_std_m, turn_std_rad)
    return Placement(pose, noise, noise_covariance=noise)


def _placed(
    pose: Array, noise: Array, by_handeye: Array, by_clock: Array, tracking: RoomTracking, carrier: BodyAt | None, body: str | None
) -> Placement:
    """The camera at a pose (4, 4) in the room, seen from the body that the object rides on where there is one."""
    if carrier is not None:
        to_body = se3.inv(carrier.pose)
        A = se3.adjoint(to_body)
        pose, noise = to_body @ pose, A @ (noise + carrier.covariance) @ A.T
        by_handeye, by_clock = A @ by_handeye, A @ (by_clock + carrier.twist)
    clock_std_s = tracking.clock_offset_std_s or 0.0
    covariance = noise + by_handeye @ tracking.H_PC_covariance @ by_handeye.T + clock_std_s**2 * np.outer(by_clock, by_clock)
    return Placement(pose, covariance, body, noise, by_handeye, by_clock)
