r"""Whether one clock runs faster than the other: ``t_camera = t_mocap + offset + rate (t_camera - middle)``.

Symbols: the panel as the board shows it misses the measured pose by e_k (turn and shift) in view k; with the velocity u_k of the measured
pose, a time that is wrong by d_k makes ``e_k = -d_k u_k``, and ``d_k = d + rate (t_k - middle)``: a weighted line through the views. The
rate counts where it is beyond its own noise; crystals differ by up to 100 ppm, 6 ms a minute.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.chain.h_pc_handeye.state import SolveState
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

SIGNIFICANT = 5.0
MOST = 1e-3
"""A rate beyond this is no clock's."""
FEWEST = 12


@dataclass(frozen=True)
class Drift:
    """The rate by which the camera's clock runs ahead, s/s, with its noise; and the camera's time at which the offset holds."""

    rate: float
    std: float
    middle_s: float

    @property
    def shown(self) -> bool:
        """Whether the data show it."""
        return SIGNIFICANT * self.std < abs(self.rate) < MOST

    def corrected(self, t_camera_s: Array) -> Array:
        """Camera times freed of the drift."""
        return np.asarray(t_camera_s - self.rate * (t_camera_s - self.middle_s))


def drift_of(state: SolveState, t_s: Array) -> Drift | None:
    """The rate that remains in a settled solve at camera times t_s (N,); None where the panel did not move in enough views."""
    found = state.estimate()
    moving = state.inliers & np.any(state.panel.velocity != 0, axis=1)
    if moving.sum() < FEWEST:
        return None
    H_OP = found.H_OB @ se3.inv(found.H_PC @ found.in_mocap_metres(state.boards.H_CB[moving]))
    measured, u = state.panel.H[moving], state.panel.velocity[moving]
    turn = se3.rotation_vector(H_OP[:, :3, :3] @ np.swapaxes(measured[:, :3, :3], 1, 2))
    e = np.concatenate([turn, H_OP[:, :3, 3] - measured[:, :3, 3]], axis=1)
    scatter = np.array([np.mean(e[:, :3] ** 2)] * 3 + [np.mean(e[:, 3:] ** 2)] * 3)
    root = 1 / np.sqrt(np.maximum(scatter, 1e-18))
    middle = float(np.mean(t_s[moving]))
    A = -np.stack([u * root, u * root * (t_s[moving] - middle)[:, None]], axis=2).reshape(-1, 2)
    b = (e * root).ravel()
    x, *_ = np.linalg.lstsq(A, b, rcond=None)
    left = float(np.mean((A @ x - b) ** 2))
    shared = float(np.median(state.deflation[moving]))
    covariance = left * shared * np.linalg.pinv(A.T @ A)
    return Drift(float(x[1]), float(np.sqrt(covariance[1, 1])), middle)
