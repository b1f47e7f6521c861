r"""Errors of the panel's poses that hang on the pose: a robot's joint offsets and link lengths, a mocap's corner of the room.

Symbols: the misplacement e_k = (turn, shift of the origin) of the panel in O of view k, from its measured pose to that which the board
shows, and its covariance S_k by white noise of both sensors; its derivatives J_k by left perturbations of H_PC, H_OB; the pose's features
c_k, its six numbers less their means, in units of their spread. A smooth error is a linear function of them to first order, so each of
the six components of e is::

    e = J theta + F a + w,    a ~ N(0, T),   w ~ N(0, s S)

with variances of turns and of shifts in T, and s, found by restricted maximum likelihood. The solve takes w alone for noise: theta then
errs by M F a besides, M = (J^T S^-1 J)^-1 J^T S^-1, which the residuals show in part only, since theta takes up the rest.
Source: Patterson & Thompson, Recovery of inter-block information when block sizes are unequal (1971).
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import solve_triangular
from scipy.optimize import minimize

from lpcal.chain.h_pc_handeye.likelihood import HandEyeEstimate, Views
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.camera import projection_jacobian

FEWEST_VIEWS = 12
"""Views under which six linear features explain any residual."""
CHANCE = 6.0
"""Twice the gain in log likelihood that is put down to chance, the 95 % point of chi^2 of the two variances; what goes beyond it counts in
full only where it is far beyond, so that white noise keeps its covariance and no threshold makes it jump."""
LEAST_SHARE = 1e-4
"""The least variance of the smooth errors that is tried, as a share of the noise's: as good as none."""


def covariance_of_pose_errors(views: Views, found: HandEyeEstimate) -> Array:
    """What errors that are linear in the panel's pose add to the covariance (12, 12) of H_PC and H_OB, as left perturbations.

    Zeros where the board poses come without corners, which would show their own noise, or where the views are few.
    """
    if views.corners_px is None or views.points_B is None or views.count < FEWEST_VIEWS:
        return np.zeros((12, 12))
    H_OC = found.H_OB @ se3.inv(found.in_mocap_metres(views.H_CB))
    H_OP = H_OC @ se3.inv(found.H_PC)
    turn = se3.rotation_vector(H_OP[:, :3, :3] @ np.swapaxes(views.H_OP[:, :3, :3], 1, 2))
    e = np.concatenate([turn, H_OP[:, :3, 3] - views.H_OP[:, :3, 3]], axis=1)
    by_O = se3.turn_and_origin_jacobian(H_OP)
    J = np.concatenate([-by_O @ se3.adjoint(H_OP), by_O], axis=2)
    F = np.einsum("kf,cd->kcfd", _pose_features(views.H_OP), np.eye(6)).reshape(views.count, 6, -1)
    mocap = views.mocap_sigmas(found.sigmas) ** 2 * views.deflation[:, None]
    by_C = by_O @ se3.adjoint(H_OC)
    S = by_C @ _board_covariance(views, found) @ np.swapaxes(by_C, 1, 2) + _mocap_covariance(views, mocap)
    white = np.swapaxes(np.linalg.cholesky(np.linalg.inv(S)), 1, 2)
    unit = np.sqrt(np.median(mocap, axis=0))
    J, F, e = (
        (white @ J).reshape(-1, 12),
        (white @ (unit[:, None] * F)).reshape(6 * views.count, -1),
        np.einsum("kij,kj->ki", white, e).ravel(),
    )
    smooth = _variances(J, F, e)
    carried = np.linalg.lstsq(J, F, rcond=None)[0]
    return np.asarray(carried * np.tile(smooth.repeat(3), F.shape[1] // 6) @ carried.T)


def _board_covariance(views: Views, found: HandEyeEstimate) -> Array:
    """(N, 6, 6) of the left perturbations of H_CB by the noise of the corners."""
    points_B = found.scale * np.asarray(views.points_B)
    fx, fy, cx, cy = found.camera[:4]
    x_C = se3.apply(found.in_mocap_metres(views.H_CB), points_B[None])
    J = projection_jacobian(x_C, np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]]), found.camera[4:]) @ se3.point_jacobian(x_C)
    seen = np.isfinite(np.asarray(views.corners_px)).all(axis=2)
    J = np.where(seen[:, :, None, None], J, 0.0) / found.sigmas.px
    return np.asarray(np.linalg.inv(np.einsum("nmai,nmaj->nij", J, J)))


def _mocap_covariance(views: Views, variance: Array) -> Array:
    """(N, 6, 6) of turn and shift of the views' poses, of the variances (N, 6) of the mocap's; those of H_OP act on H_PO by its lever."""
    diagonal = variance[:, :, None] * np.eye(6)
    if not views.inverse:
        return np.asarray(diagonal)
    measured = se3.inv(views.H_OP)
    back = -np.swapaxes(measured[:, :3, :3], 1, 2)
    G = np.zeros((views.count, 6, 6))
    G[:, :3, :3] = G[:, 3:, 3:] = back
    G[:, 3:, :3] = back @ se3.hat(measured[:, :3, 3])
    return np.asarray(G @ diagonal @ np.swapaxes(G, 1, 2))


def _pose_features(H_OP: Array) -> Array:
    """(N, 6) of zero mean and unit spread; a direction in which the poses do not differ tells nothing."""
    features = np.hstack([se3.rotation_vector(H_OP[0, :3, :3].T @ H_OP[:, :3, :3]), H_OP[:, :3, 3]])
    features = features - features.mean(axis=0)
    spread = features.std(axis=0)
    return np.asarray(np.where(spread > 0, features / np.where(spread > 0, spread, 1), 0.0))


def _variances(J: Array, F: Array, e: Array) -> Array:
    """Variances (2,) of the features' coefficients, of turns and of shifts, most likely given what no theta explains.

    Parameters
    ----------
    J, F, e : (R, 12), (R, 36), (R,) in units of the white noise; the columns of F are by feature, then component
    """
    Q = np.linalg.qr(J)[0]
    F, e = F - Q @ (Q.T @ F), e - Q @ (Q.T @ e)
    square, mixed, own, freedom = F.T @ F, F.T @ e, float(e @ e), len(e) - J.shape[1]

    def cost(logs: Array) -> float:
        root = np.sqrt(np.tile(np.exp(logs).repeat(3), F.shape[1] // 6))
        L = np.linalg.cholesky(np.eye(len(root)) + root[:, None] * square * root)
        explained = float(np.sum(solve_triangular(L, root * mixed, lower=True) ** 2))
        return float(2 * np.log(np.diag(L)).sum() + freedom * np.log(max(own - explained, np.finfo(float).tiny)))

    floor = np.log(LEAST_SHARE)
    starts = [np.full(2, start) for start in (-1.0, floor / 2)]
    found = min((minimize(cost, start, method="L-BFGS-B", bounds=[(floor, 8.0)] * 2) for start in starts), key=lambda each: float(each.fun))
    gain = cost(np.full(2, floor)) - float(found.fun)
    smooth = np.exp(found.x) * max(0.0, 1 - CHANCE / max(gain, CHANCE))
    root = np.sqrt(np.tile(smooth.repeat(3), F.shape[1] // 6))
    inner = np.linalg.solve(np.eye(len(root)) + root[:, None] * square * root, root * mixed)
    noise = (own - float((root * mixed) @ inner)) / freedom
    return np.asarray(smooth * noise)
