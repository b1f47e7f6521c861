r"""How noisy the measurements are, told by the solve itself, and the covariance that follows where neighbours share their errors.

Symbols: residual r_j with the weight w_j = 1/sigma_j^2 and leverage h_j (the share of it that the fit absorbs), frozen set of views::

    sigma_g^2 <- sum_g r_j^2 / f_j  /  sum_g (1 - h_j)          variance components, a group g of measurements (Forstner 1979)
    f_k = sum_l correlation(t_k - t_l)                           views that stand for one, where mocap errors drift slowly
    cov = (B-1)/B sum_b (x_b - mean)(x_b - mean)^T               block jackknife: x_b without the views of stretch b of B

Mocap errors are coloured: differences of the stream understate them fifty times. Sources: Forstner, Ein Verfahren zur Schatzung von
Varianz- und Kovarianzkomponenten (1979); Kunsch, The jackknife and the bootstrap for general stationary observations (1989).
"""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np

from lpcal.chain.h_pc_handeye.likelihood import SCALE_SIGMA, HandEyeEstimate, Observed, PoseUnknown, Sigmas, Views
from lpcal.errors import DegenerateError
from lpcal.geometry.arrays import Array

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
