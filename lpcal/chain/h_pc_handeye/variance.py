r"""How noisy the measurements are, by the solve's own residuals, and the covariance that follows where neighbours share their errors.

Symbols: residual r_j with the weight w_j = 1/sigma_j^2 and leverage h_j (the share of it that the fit absorbs), frozen set of views::

    sigma_g^2 <- sum_g r_j^2 / f_j  /  sum_g (1 - h_j)          variance components, a group g of measurements (Forstner 1979)
    f_k = sum_l correlation(t_k - t_l)                           views that stand for one, where mocap errors drift slowly
    cov = (B-1)/B sum_b (x_b - mean)(x_b - mean)^T               block jackknife: x_b without the views of stretch b of B

Mocap errors are coloured: differences of the stream understate them fifty times. Sources: Forstner, Ein Verfahren zur Schatzung von
Varianz- und Kovarianzkomponenten (1979); Kunsch, The jackknife and the bootstrap for general stationary observations (1989).

Errors of the panel's poses that depend on the pose: a robot's joint offsets and link lengths, a mocap's corner of the room.

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

import itertools
from dataclasses import replace

import numpy as np

from lpcal.chain.h_pc_handeye.likelihood import SCALE_SIGMA, HandEyeEstimate, Observed, PoseUnknown, Sigmas, Views
from lpcal.errors import DegenerateError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.camera import projection_jacobian

LAGS_S = (0.0, 0.15, 0.3, 0.6, 1.2, 2.5, 5.0, 10.0)
"""Edges of the bins of time in which the correlation of mocap errors is taken."""
SIGNIFICANT = 3.0
FEWEST_PAIRS = 15
LEAST_FREEDOM = 6.0
"""Redundancy under which a group keeps the sigma it has."""
SHRINK = 0.2
"""The least that a sigma may become in one step, as a share of what it was: a component that collapses stays away from zero."""
BLOCKS = (10, 20)
"""Stretches of equally many views that the recording is cut into."""
BEYOND_CHANCE = 3.0
"""Standard deviations of the jackknife's own scatter, beyond which it counts."""
SCALE_DOUBTS = 3.0
"""Standard deviations, with all that neighbouring views share, up to which a board of another size may be chance: of sound data one
session in 400 goes beyond."""
FLOOR_PX = 1e-3


def components(views: Views, found: HandEyeEstimate, sigmas: Sigmas, t_s: Array | None) -> Sigmas:
    """The sigmas that the residuals show, at the present weights; t_s (N,) are the times of the views, where they are known."""
    sigmas = replace(sigmas, log_scale=_scale_sigma(views, found, t_s))
    if (place := found.term(Observed.BOARD)) >= 0:
        r, free = found.solution.residuals[place], 1 - found.solution.leverage(place)
        return replace(
            sigmas,
            board_rad=_updated(sigmas.board_rad, r[:, :3], free[:, :3]),
            board_lateral_m=_updated(sigmas.board_lateral_m, r[:, 3:5], free[:, 3:5]),
            board_depth_m=_updated(sigmas.board_depth_m, r[:, 5:], free[:, 5:]),
        )
    place = found.term(Observed.MOCAP)
    r, leverage = found.solution.residuals[place], found.solution.leverage(place)
    r = r if views.pose_variance is None else r / np.sqrt(views.pose_variance)
    free = 1 - leverage
    rad, metre = list(sigmas.mocap_rad), list(sigmas.mocap_m)
    for group in np.unique(views.noise_class):
        of = views.noise_class == group
        rad[group] = _updated(rad[group], r[of, :3], free[of, :3])
        metre[group] = _updated(metre[group], r[of, 3:], free[of, 3:])
    corners, _ = found.corner_residuals()
    absorbed = found.solution.parameters - float(leverage.sum())  # all leverages add up to the parameters; the prior's are the camera's
    px = np.sqrt(np.sum(corners**2) / max(corners.size - absorbed, LEAST_FREEDOM))
    return replace(sigmas, mocap_rad=tuple(rad), mocap_m=tuple(metre), px=max(float(px), SHRINK * sigmas.px, FLOOR_PX))


def _scale_sigma(views: Views, found: HandEyeEstimate, t_s: Array | None) -> float:
    """The prior's sigma of the board's size: as wide as what was found beyond `SCALE_DOUBTS` of the data's own sigmas."""
    size, information = abs(np.log(found.scale)), found.scale_std**-2 - found.sigmas.log_scale**-2
    if not information > 0 or size < SCALE_DOUBTS * found.scale_std:
        return SCALE_SIGMA
    chance = SCALE_DOUBTS**2 * block_factor(views, found, t_s) / information
    by_data = size / (information * found.scale_std**2)
    return float(np.sqrt(SCALE_SIGMA**2 + max(by_data**2 - chance, 0.0)))


def row_sigmas(views: Views, sigmas: Sigmas, kind: Observed) -> Array:
    """One standard deviation (N, 6) of the rows of a term, mocap | board, of one view by itself."""
    if kind is Observed.BOARD:
        row = [sigmas.board_rad] * 3 + [sigmas.board_lateral_m] * 2 + [sigmas.board_depth_m]
        return np.tile(np.array(row), (views.count, 1))
    return views.mocap_sigmas(sigmas)


def change(before: Sigmas, after: Sigmas) -> float:
    """The largest relative change of a sigma."""
    old, new = (
        np.array([s.px, s.board_rad, s.board_lateral_m, s.board_depth_m, *s.mocap_rad, *s.mocap_m, s.log_scale]) for s in (before, after)
    )
    return float(np.max(np.abs(new / old - 1)))


def deflation(views: Views, found: HandEyeEstimate, sigmas: Sigmas, t_s: Array) -> Array:
    """Factor (N,) on the mocap's variance of each view: the number of views that share its error, by the residuals' correlation."""
    kind = Observed.MOCAP if found.term(Observed.MOCAP) >= 0 else Observed.BOARD
    z = found.solution.residuals[found.term(kind)] / row_sigmas(views, sigmas, kind)
    gap = np.abs(t_s[:, None] - t_s[None])
    np.fill_diagonal(gap, np.inf)
    product = z @ z.T / z.shape[1]
    level = float(np.mean(z**2))
    factor, ceiling = np.ones(len(z)), 1.0
    for low, high in itertools.pairwise(LAGS_S):
        near = (gap > low) & (gap <= high)
        pairs = near.sum() / 2
        if pairs < FEWEST_PAIRS:
            continue
        found_here = float(product[near].mean()) / level
        if found_here < SIGNIFICANT / np.sqrt(min(pairs, len(z)) * z.shape[1]):
            break
        ceiling = min(ceiling, found_here)
        factor += ceiling * near.sum(axis=1)
    return factor


def block_factor(views: Views, found: HandEyeEstimate, t_s: Array | None) -> float:
    """Factor on the covariance by which stretches of neighbouring views move H_PC more than their noise; at least 1.

    What correlation of neighbours misses: errors that last, and a model that is not all there is. Counted only where it is beyond chance,
    so that white noise keeps its covariance.
    """
    solution = found.solution
    at, formal = solution.columns(PoseUnknown.H_PC), solution.covariance(PoseUnknown.H_PC)
    place = np.argsort(np.argsort(t_s)) if t_s is not None else np.arange(views.count)
    factor = 1.0
    for number in BLOCKS:
        if number > views.count:
            break
        block = place * number // views.count
        try:
            without = np.array([solution.without(found.of_views(block == b))[at] for b in range(number)])
        except DegenerateError:  # one stretch alone shows a direction
            break
        moved = without - without.mean(axis=0)
        ratio = (number - 1) / number * float(np.trace(np.linalg.solve(formal, moved.T @ moved))) / len(at)
        if ratio > 1 + BEYOND_CHANCE * np.sqrt(2 / (number * len(at))):
            factor = max(factor, ratio)
    return factor


def _updated(sigma: float, r: Array, free: Array) -> float:
    freedom = float(free.sum())
    if freedom < LEAST_FREEDOM:
        return sigma
    return float(max(np.sqrt(np.sum(r**2) / freedom), SHRINK * sigma))


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
    """(N, 6) of zero mean and unit spread; a direction in which the poses do not differ says nothing."""
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
    from scipy.linalg import solve_triangular
    from scipy.optimize import minimize

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
