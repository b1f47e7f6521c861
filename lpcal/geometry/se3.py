"""Rigid transforms as plain (..., 4, 4) arrays.

Symbols: ``H_AB`` takes coordinates in B to coordinates in A, ``x_A = H_AB x_B``; ``xi = (phi, rho)`` is a twist, rotation
vector (rad) first, then translation (m); ``exp(xi)`` is the exponential map of SE(3), so that a covariance (6, 6) belongs to the
left perturbation ``H = exp(xi) H_mean``. Source: Barfoot, State Estimation for Robotics (2017), chapter 7.
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array

SMALL_ANGLE_RAD = 1e-4


def hat(v: Array) -> Array:
    """Skew matrix (..., 3, 3) of v (..., 3): ``hat(v) @ w = cross(v, w)``."""
    v = np.asarray(v, dtype=float)
    zero = np.zeros_like(v[..., 0])
    rows = [zero, -v[..., 2], v[..., 1], v[..., 2], zero, -v[..., 0], -v[..., 1], v[..., 0], zero]
    return np.stack(rows, axis=-1).reshape(*v.shape[:-1], 3, 3)


def rotation(phi: Array) -> Array:
    """Rotation matrix (..., 3, 3) of a rotation vector phi (..., 3) in radians (Rodrigues)."""
    phi = np.asarray(phi, dtype=float)
    angle2 = np.sum(phi * phi, axis=-1)[..., None, None]
    a, b, _ = _series(angle2)
    W = hat(phi)
    return np.asarray(np.eye(3) + a * W + b * (W @ W))


def rotation_about_axes(angles: Array, axes: str) -> Array:
    """Rotations (N, 3, 3) by three angles (N, 3), rad, each about an axis turned by the ones before: ``zyx`` is Rz(a) Ry(b) Rx(c)."""
    a, b, c = (rotation(np.eye(3)["xyz".index(axis)] * angles[:, k, None]) for k, axis in enumerate(axes))
    return np.asarray(a @ b @ c)


def angles_about_zyx(R: Array) -> Array:
    """Angles (N, 3), rad, a of R = Rz(a0) Ry(a1) Rx(a2), the middle one within a quarter turn, of rotations (N, 3, 3)."""
    middle = np.arctan2(-R[:, 2, 0], np.hypot(R[:, 0, 0], R[:, 1, 0]))
    return np.stack([np.arctan2(R[:, 1, 0], R[:, 0, 0]), middle, np.arctan2(R[:, 2, 1], R[:, 2, 2])], axis=1)


def rotation_vector(R: Array) -> Array:
    """Rotation vector (..., 3) in radians, of length at most pi, of rotation matrices R (..., 3, 3); exact near 0 and pi."""
    q = quaternion(R)
    sine = np.linalg.norm(q[..., :3], axis=-1)
    angle = 2 * np.arctan2(sine, q[..., 3])
    factor = np.where(sine > 1e-12, angle / np.maximum(sine, 1e-300), 2.0)
    return np.asarray(q[..., :3] * factor[..., None])


def quaternion(R: Array) -> Array:
    """Unit quaternion (..., 4) as x, y, z, w with w >= 0 of rotation matrices R (..., 3, 3).

    K of R (Bar-Itzhack 2000) is 4 q q^T of a rotation: its largest column is q. Two steps of power iteration give the nearest rotation's
    where R is only nearly one.
    """
    R = np.asarray(R, dtype=float)
    if R.shape[-2:] != (3, 3):
        msg = f"a rotation is (..., 3, 3), not {R.shape}"
        raise ValueError(msg)
    K = np.empty((*R.shape[:-2], 4, 4))
    K[..., :3, :3] = R + np.swapaxes(R, -1, -2)
    trace = np.trace(R, axis1=-2, axis2=-1)
    K[..., range(3), range(3)] += 1 - trace[..., None]
    K[..., 3, 3] = 1 + trace
    K[..., 0, 3] = K[..., 3, 0] = R[..., 2, 1] - R[..., 1, 2]
    K[..., 1, 3] = K[..., 3, 1] = R[..., 0, 2] - R[..., 2, 0]
    K[..., 2, 3] = K[..., 3, 2] = R[..., 1, 0] - R[..., 0, 1]
    largest = np.argmax(np.diagonal(K, axis1=-2, axis2=-1), axis=-1)
    q = np.take_along_axis(K, largest[..., None, None], axis=-1)
    for _ in range(2):
        q = K @ (q / np.linalg.norm(q, axis=-2, keepdims=True))
    q = q[..., 0] / np.linalg.norm(q[..., 0], axis=-1, keepdims=True)
    return np.asarray(np.where(q[..., 3:] < 0, -q, q))


def rotation_from_quaternion(q: Array) -> Array:
    """Rotation matrix (..., 3, 3) of a quaternion (..., 4) as x, y, z, w, of any length but zero."""
    q = np.asarray(q, dtype=float)
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    v, w = q[..., :3], q[..., 3, None, None]
    W = hat(v)
    return np.asarray(np.eye(3) + 2 * w * W + 2 * (W @ W))


def nearest_rotation(M: Array) -> Array:
    """The rotation (..., 3, 3) nearest to M (..., 3, 3) in the Frobenius norm."""
    U, _, Vt = np.linalg.svd(M)
    sign = np.ones(M.shape[:-1])
    sign[..., 2] = np.linalg.det(U @ Vt)
    return np.asarray(U @ (sign[..., None] * Vt))


def transform(R: Array, t: Array) -> Array:
    """H (..., 4, 4) from a rotation R (..., 3, 3) and a translation t (..., 3); they broadcast."""
    shape = np.broadcast_shapes(np.shape(R)[:-2], np.shape(t)[:-1])
    H = np.zeros((*shape, 4, 4))
    H[..., :3, :3], H[..., :3, 3], H[..., 3, 3] = R, t, 1.0
    return H


def inv(H_AB: Array) -> Array:
    """H_BA (..., 4, 4) of rigid H_AB (..., 4, 4)."""
    R_BA = np.swapaxes(H_AB[..., :3, :3], -1, -2)
    return transform(R_BA, -(R_BA @ H_AB[..., :3, 3:])[..., 0])


def apply(H_AB: Array, x_B: Array) -> Array:
    """Points x_A (..., N, 3) of points x_B (..., N, 3)."""
    return np.asarray(x_B @ np.swapaxes(H_AB[..., :3, :3], -1, -2) + H_AB[..., None, :3, 3])


def rotate(H_AB: Array, v_B: Array) -> Array:
    """Directions v_A (..., N, 3) of directions v_B (..., N, 3)."""
    return np.asarray(v_B @ np.swapaxes(H_AB[..., :3, :3], -1, -2))


def exp(xi: Array) -> Array:
    """H (..., 4, 4) of twists xi (..., 6)."""
    xi = np.asarray(xi, dtype=float)
    return transform(rotation(xi[..., :3]), (left_jacobian(xi[..., :3]) @ xi[..., 3:, None])[..., 0])


def log(H: Array) -> Array:
    """Twists xi (..., 6) of rigid transforms H (..., 4, 4), the inverse of `exp` for angles under pi."""
    phi = rotation_vector(H[..., :3, :3])
    rho = np.linalg.solve(left_jacobian(phi), H[..., :3, 3:])[..., 0]
    return np.concatenate([phi, rho], axis=-1)


def left_jacobian(phi: Array) -> Array:
    """Left Jacobian (..., 3, 3) of SO(3) at rotation vectors phi (..., 3)."""
    angle2 = np.sum(phi * phi, axis=-1)[..., None, None]
    _, b, c = _series(angle2)
    W = hat(phi)
    return np.asarray(np.eye(3) + b * W + c * (W @ W))


def adjoint(H: Array) -> Array:
    """Adjoint (..., 6, 6): ``H exp(xi) inv(H) = exp(adjoint(H) xi)``."""
    R = H[..., :3, :3]
    A = np.zeros((*H.shape[:-2], 6, 6))
    A[..., :3, :3] = A[..., 3:, 3:] = R
    A[..., 3:, :3] = hat(H[..., :3, 3]) @ R
    return A


def interpolate(H_AB: Array, t_s: Array, t_new_s: Array) -> Array:
    """Poses H_AB (M, 4, 4) at times t_new_s (M,) between samples H_AB (N, 4, 4) at increasing times t_s (N,).

    Rotation along the geodesic and translation along the chord between the two neighbours; at the ends the last pair is continued.
    """
    left = np.clip(np.searchsorted(t_s, t_new_s, side="right") - 1, 0, len(t_s) - 2)
    share = (t_new_s - t_s[left]) / (t_s[left + 1] - t_s[left])
    R, t = H_AB[..., :3, :3], H_AB[..., :3, 3]
    turn = rotation_vector(R[left + 1] @ np.swapaxes(R[left], -1, -2))
    return transform(rotation(share[:, None] * turn) @ R[left], t[left] + share[:, None] * (t[left + 1] - t[left]))


def angle_rad(R: Array) -> Array:
    """Angle (...) of rotations R (..., 3, 3), exact near 0 and pi."""
    return np.asarray(np.linalg.norm(rotation_vector(R), axis=-1))


def _series(angle2: Array) -> tuple[Array, Array, Array]:
    """sin(a)/a, (1 - cos a)/a^2 and (a - sin a)/a^3 of the squared angle, by their series near zero."""
    small = angle2 < SMALL_ANGLE_RAD**2
    a2 = np.where(small, 1.0, angle2)
    a = np.sqrt(a2)
    return (
        np.where(small, 1 - angle2 / 6, np.sin(a) / a),
        np.where(small, 0.5 - angle2 / 24, (1 - np.cos(a)) / a2),
        np.where(small, 1 / 6 - angle2 / 120, (a - np.sin(a)) / (a2 * a)),
    )


def point_jacobian(x_A: Array) -> Array:
    """Derivatives (..., 3, 6) of points x_A (..., 3) by the left perturbation xi of ``H_AB = exp(xi) H_AB``: ``[-hat(x), I]``."""
    return np.concatenate([-hat(x_A), np.broadcast_to(np.eye(3), (*x_A.shape[:-1], 3, 3))], axis=-1)


def turn_and_origin_jacobian(H_AB: Array) -> Array:
    """Derivatives (..., 6, 6) of the turn and of B's origin in A by the left perturbation of H_AB (..., 4, 4)."""
    J = np.zeros((*H_AB.shape[:-2], 6, 6))
    J[..., :3, :3] = np.eye(3)
    J[..., 3:, :] = point_jacobian(H_AB[..., :3, 3])
    return J


def origin_covariance(H_AB: Array, covariance: Array) -> Array:
    """Covariance (3, 3) of B's origin in A, of the covariance (6, 6) of the left perturbation of H_AB (4, 4)."""
    J = point_jacobian(H_AB[:3, 3])
    return np.asarray(J @ covariance @ J.T)


def origin_sigmas(H_AB: Array, covariance: Array) -> Array:
    """Standard deviations (3,) of B's origin in A, of the covariance (6, 6) of the left perturbation of H_AB (4, 4)."""
    return np.asarray(np.sqrt(np.diag(origin_covariance(H_AB, covariance))))
