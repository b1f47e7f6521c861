r"""Where H_PC is known worst, which views would improve it, and by how much.

Symbols: a view k misses H_OB by the turn and the shift of ``H_OP,k H_PC H_CB,k inv(H_OB)`` at the board's origin. A left perturbation xi of
H_PC acts on it as ``J_k = A Ad(H_OP,k)``, one of H_OB as -A, with A taking a perturbation to turn and shift at that point. With W from the
scatter of the views that there are::

    N = sum_k [J_k, -A]^T W [J_k, -A],    H_PC after more views m:  ( N + sum_m ... )^-1, in proportion to the covariance reported

The views tried are those after a turn of the panel by 20 degrees either way about each of its axes, about the board's middle, so that the
board stays in sight. Source: the information matrix of the linearised problem.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.digits import fine

TURN_DEG = 20.0
FEWEST_MORE, MORE_SHARE = 6, 0.2
"""So many more views are tried: a fifth of those there are, six at least."""
WORTH = 0.9
"""Turns that leave more of the sigma than this improve nothing."""
TARGET_M, TARGET_RAD = 1e-3, np.deg2rad(0.1)
"""A worst standard deviation beyond these is warned of."""
NAMED = 0.9
LEAST_M, LEAST_RAD = 1e-5, 1e-6


@dataclass(frozen=True)
class MotionAdvice:
    """The worst direction of H_PC, and the views that would improve it most."""

    sigma_m: float
    """One standard deviation of the camera's centre along `direction_P`, its worst."""
    direction_P: Array
    sigma_rad: float
    """One standard deviation of the camera's turn about its worst axis."""
    turn_about: str
    """x | y | z of the panel."""
    sigma_m_after: float
    """What the worst sigma of the centre becomes with `more` views turned so."""
    sigma_rad_after: float
    more: int

    def words(self) -> str:
        """In one sentence."""
        worst = f"{fine(1e3 * self.sigma_m)} mm, and {fine(np.degrees(self.sigma_rad), 3)} deg"
        now = f"worst along {_named(self.direction_P)} of the panel, {worst}"
        if self.sigma_m_after > WORTH * self.sigma_m and self.sigma_rad_after > WORTH * self.sigma_rad:
            return f"{now}; no turn about one axis improves that, four times as many views like these halve it"
        return (
            f"{now}; {self.more} more views with the panel turned by up to {TURN_DEG:.0f} deg either way about its {self.turn_about}, the "
            f"board kept in sight, make that {fine(1e3 * self.sigma_m_after)} mm and {fine(np.degrees(self.sigma_rad_after), 3)} deg"
        )

    def warning(self) -> str | None:
        """The same where it is worse than it should be."""
        return f"H_PC is known {self.words()}" if self.sigma_m > TARGET_M or self.sigma_rad > TARGET_RAD else None


def advise(H_OP: Array, H_CB: Array, H_PC: Array, H_OB: Array, covariance: Array | None = None) -> MotionAdvice:
    """The worst direction, and what more views would do.

    Parameters
    ----------
    H_OP, H_CB : (N, 4, 4) of the views that agree
    H_PC, H_OB : (4, 4)
    covariance : (6, 6) of H_PC as reported; None: that of the views' scatter alone
    """
    weight = _weight(H_OP, H_CB, H_PC, H_OB)
    N = _information(H_OP, H_OB, weight)
    scale = 1.0
    if covariance is not None:
        scale = float(np.trace(_centred(covariance, H_PC)[3:, 3:]) / np.trace(_centred(_covariance(N), H_PC)[3:, 3:]))
    now = _centred(covariance if covariance is not None else _covariance(N), H_PC)
    _, vectors = np.linalg.eigh(now[3:, 3:])
    more_views = max(FEWEST_MORE, round(MORE_SHARE * len(H_OP)))
    after = {}
    for axis in range(3):
        more = _information(_turned(H_OP, H_CB, H_PC, axis, more_views), H_OB, weight)
        after["xyz"[axis]] = _worst(scale * _centred(_covariance(N + more), H_PC))
    best = min(after, key=lambda axis: after[axis][1] / TARGET_M + after[axis][0] / TARGET_RAD)
    sigma_rad, sigma_m = _worst(now)
    return MotionAdvice(sigma_m, vectors[:, -1], sigma_rad, best, min(after[best][1], sigma_m), min(after[best][0], sigma_rad), more_views)


def _worst(covariance: Array) -> tuple[float, float]:
    """Largest standard deviation of the turn and of the shift."""
    turn, shift = (float(np.sqrt(np.linalg.eigvalsh(covariance[part, part])[-1])) for part in (slice(0, 3), slice(3, 6)))
    return turn, shift


def _weight(H_OP: Array, H_CB: Array, H_PC: Array, H_OB: Array) -> Array:
    """(6,) one over the mean square of turn and shift of the views, a coordinate."""
    H = H_OP @ H_PC @ H_CB
    turn = se3.angle_rad(H[:, :3, :3] @ H_OB[:3, :3].T)
    shift = np.linalg.norm(H[:, :3, 3] - H_OB[:3, 3], axis=1)
    return np.repeat([1 / max(np.mean(turn**2) / 3, LEAST_RAD**2), 1 / max(np.mean(shift**2) / 3, LEAST_M**2)], 3)


def _information(H_OP: Array, H_OB: Array, weight: Array) -> Array:
    """(12, 12) of H_PC and H_OB."""
    A = se3.turn_and_origin_jacobian(H_OB)
    J = np.concatenate([A @ se3.adjoint(H_OP), np.broadcast_to(-A, (len(H_OP), 6, 6))], axis=2)
    return np.asarray(np.einsum("nki,k,nkj->ij", J, weight, J))


def _covariance(N: Array) -> Array:
    """(6, 6) of H_PC, the rest free."""
    scale = 1 / np.sqrt(np.diag(N))
    return np.asarray((np.linalg.pinv(N * np.outer(scale, scale), rcond=1e-14, hermitian=True) * np.outer(scale, scale))[:6, :6])


def _centred(covariance: Array, H_PC: Array) -> Array:
    """Covariance of turn and of the camera's centre, of that of a left perturbation."""
    T = se3.turn_and_origin_jacobian(H_PC)
    return np.asarray(T @ covariance @ T.T)


def _turned(H_OP: Array, H_CB: Array, H_PC: Array, axis: int, count: int) -> Array:
    """Panel poses (count, 4, 4) of the usual view turned about one of the panel's axes, about the board's place in sight."""
    R_mean = se3.nearest_rotation(H_OP[:, :3, :3].mean(axis=0))
    usual = int(np.argmin(se3.angle_rad(H_OP[:, :3, :3] @ R_mean.T)))
    pivot = (H_OP[usual] @ H_PC @ H_CB[usual])[:3, 3]
    angle = np.deg2rad(TURN_DEG) * np.linspace(-1, 1, count)
    turn = se3.rotation(angle[:, None] * H_OP[usual, :3, axis])
    H_about = se3.transform(turn, pivot - turn @ pivot)
    return np.asarray(H_about @ H_OP[usual])


def _named(direction_P: Array) -> str:
    place = int(np.argmax(np.abs(direction_P)))
    if abs(direction_P[place]) > NAMED:
        return "xyz"[place]
    return f"({', '.join(f'{part:.2f}' for part in direction_P)})"
