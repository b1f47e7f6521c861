r"""Robust costs of a pixel's samples as in segmentation.sample_costs, with unknown ambient light in the signals (no ambient image).

Symbols: signal ``I_k = m_k + A / h_k`` of light k, by whose intensity h_k signals were divided; m_k is the lamp's part, 0 in its shadow; A
is the ambient part, free at every pixel under a prior: ambient light from all over a room gives a surface of ``b = rho n`` the signal
``A = level |b|``, within SPREAD, as the object occludes the room and the light may come from one side. For a free normal, ``|b| = n . b``
with the normal n of the previous step makes this linear in b. The costs are those of segmentation.sample_costs on the signals without A,
plus that of the prior.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.kernels.library import kernel
from lpcal.segmentation import sample_costs
from lpcal.view.coarse import RoomPrior
from lpcal.view.constants import OUTLIER2, SHADOW
from lpcal.view.pixel_list import second

SPREAD = 0.35
"""Relative standard deviation of A about level |b|: in simulated scenes 0.15 over an object, 0.3 between it and the wall behind."""
DEEP = 0.02
"""Interreflected light in shadow, as a share of a pixel's brightest sample: the deviation from A allowed to a shadowed sample."""
BRIGHTER = 0.03
"""As in segmentation.sample_costs, but smaller: with 0.1 the ambient level comes out too low by a third."""
STEPS = 4
"""Solves for b and A, starting from half of the least sample as A."""
PLANE_STEPS = 3
"""Solves for a plane's albedo and A, starting from the best estimate of a single sample."""
LEVEL_TIE = 1e-9
"""Relative regularisation of the diagonal, for pixels whose samples determine fewer than four unknowns."""


@dataclass(frozen=True)
class Free:
    """P pixels fitted as surfaces of free normal."""

    b: Array
    """(P, 3)."""
    A: Array
    """(P,)."""
    cost: Array
    """(P,)."""
    information: Array
    """(P,) share of the prior variance of A that the samples remove, 0..1."""


def free(signal: Array, sigma: Array, usable: Mask, B: Array, doubt: Array, room: RoomPrior) -> Free:
    """Fit pixels as surfaces of free normal under light vectors B (L, P, 3), as `sample_costs.free`, with A."""
    if len(signal) <= sample_costs.MOST_LIGHTS and (run := kernel("room_free")):
        b, (A, cost, information) = np.empty(B.shape[1:]), np.empty((3, B.shape[1]))
        run(*signal.shape, *_given(signal, sigma, usable, B, doubt, room), STEPS, b, A, cost, information)
        return Free(b, A, cost, information)
    share, E = room.share[:, None], lambert.length(B)
    A = lowest(signal, usable, room) / 2
    n = np.zeros(B.shape[1:])
    n[:, 2] = -1.0
    information = np.zeros(len(A))
    b = _second(signal - share * A, usable)[:, None] / np.maximum(_second(E, usable), 1e-12)[:, None] * n
    for step in range(STEPS):
        lamps, spread2 = _without(signal, sigma, doubt, share * A)
        shading = np.where(usable, lamps / np.maximum(E, 1e-12), 0.0)
        dark = shading < SHADOW * _second(shading, usable)
        spread2 = spread2 + (DEEP * lamps.max(axis=0)) ** 2
        weight = usable / spread2
        if step:
            weight /= (1 + (lamps - np.where(dark, 0.0, lambert.predicted(B, b))) ** 2 / spread2 / OUTLIER2) ** 2
        b, A, information = _solved(signal, weight, np.where(dark[..., None], 0.0, B), n, lambert.length(b), room)
        length = lambert.length(b)[..., None]
        n = np.where(length > 0, b / np.maximum(length, 1e-20), n)
    cost, _ = _costs(signal, sigma, usable, doubt, lambert.predicted(B, b), share * A)
    return Free(b, A, np.sum(np.where(usable, cost, 0.0), axis=0) + _prior(A, lambert.length(b), room), information)


def planar(signal: Array, sigma: Array, usable: Mask, m: Array, doubt: Array, room: RoomPrior) -> tuple[Array, Array, Mask, Array]:
    """Cost (P,), albedo (P,), lit samples (L, P) and A (P,) of pixels on a plane of signals m (L, P), as `sample_costs.planar`."""
    if len(signal) <= sample_costs.MOST_LIGHTS and (run := kernel("room_planar")):
        (cost, albedo, A), lit = np.empty((3, m.shape[1])), np.empty(m.shape, bool)
        run(*signal.shape, *_given(signal, sigma, usable, m, doubt, room), PLANE_STEPS, cost, albedo, lit, A)
        return cost, albedo, lit, A
    share = room.share[:, None]
    least, albedo, A = np.full(m.shape[1], np.inf), np.zeros(m.shape[1]), np.zeros(m.shape[1])
    lit = np.zeros(m.shape, bool)

    def consider(one: Array, ambient: Array, allowed: Mask) -> None:
        each, square = _costs(signal, sigma, usable, doubt, one * m, share * ambient)
        agree = usable & (square < OUTLIER2) & (m > 0)
        total = np.sum(np.where(usable, each, 0.0), axis=0) + _prior(ambient, one, room)
        cost = np.where(allowed & (one > 0) & (agree.sum(axis=0) >= 2), total, np.inf)
        better = cost < least
        least[better], albedo[better], lit[:, better], A[better] = cost[better], one[better], agree[:, better], ambient[better]

    for k in range(len(m)):
        one = signal[k] / np.maximum(m[k] + room.level * share[k], 1e-12)
        consider(one, room.level * one, usable[k] & (m[k] > 0))
    for _ in range(PLANE_STEPS):
        lamps, spread2 = _without(signal, sigma, doubt, share * A)
        dark = usable & ~lit & (lamps < sample_costs.DARK_SHARE * albedo * m)
        weight = (lit | dark) / (spread2 + (DEEP * lamps.max(axis=0)) ** 2)
        one, ambient = albedo_and_room(signal, weight, np.where(dark, 0.0, m), albedo, room)
        consider(one, np.maximum(ambient, 0.0), one > 0)
    blind = usable.sum(axis=0) < 2
    return np.where(blind, 0.0, np.where(np.isfinite(least), least, sample_costs.OUTLIER * len(m))), albedo, lit, A


def _given(
    signal: Array, sigma: Array, usable: Mask, light: Array, doubt: Array, room: RoomPrior
) -> tuple[npt.NDArray[np.generic] | float, ...]:
    """Arguments of the kernels: samples (L, P), their light, the ambient prior, and the constants."""
    constants = [
        sample_costs.MODEL**2,
        BRIGHTER,
        sample_costs.DARKER,
        sample_costs.OUTLIER,
        sample_costs.DARK,
        sample_costs.HALF_DARK,
        sample_costs.DARK_SHARE,
    ]
    constants += [SHADOW, OUTLIER2, DEEP, SPREAD, LEVEL_TIE]
    signal, sigma, light, share = (np.ascontiguousarray(one, float) for one in (signal, sigma, light, room.share))
    doubts = np.ascontiguousarray(doubt, np.float32)
    return signal, sigma, np.ascontiguousarray(usable), light, doubts, share, room.level, np.array(constants)


def nothing(signal: Array, sigma: Array, usable: Mask, around: Array, room: RoomPrior) -> tuple[Array, Array]:
    """Cost (P,), as `sample_costs.nothing`, of places lit by the ambient light alone, and their A (P,)."""
    share, spread2 = room.share[:, None], sigma**2 + (sample_costs.INTERREFLECTED * around) ** 2
    weight = usable / spread2
    A = np.sum(weight * share * signal, axis=0) / np.maximum(np.sum(weight * share**2, axis=0), 1e-30)
    return np.sum(np.where(usable, np.minimum((signal - share * A) ** 2 / spread2, sample_costs.OUTLIER), 0.0), axis=0) / 2, A


def albedo_and_room(signal: Array, weight: Array, m: Array, albedo: Array, room: RoomPrior) -> tuple[Array, Array]:
    """Least-squares albedo (P,) and A (P,) with weights (L, P), under the prior at an initial albedo (P,)."""
    share, tie = room.share[:, None], prior_weight(albedo, room)
    mm, ms = np.sum(weight * m * m, axis=0) + tie * room.level**2, np.sum(weight * m * share, axis=0) - tie * room.level
    ss, my, sy = np.sum(weight * share**2, axis=0) + tie, np.sum(weight * m * signal, axis=0), np.sum(weight * share * signal, axis=0)
    over = np.maximum(mm * ss - ms**2, 1e-30)
    return (ss * my - ms * sy) / over, (mm * sy - ms * my) / over


def residuals(signal: Array, weight: Array, m: Array, albedo: Array, room: RoomPrior) -> Array:
    """Weighted residuals (L P + P,) of a plane, those of the prior last; albedo and A are eliminated, from an initial albedo (P,)."""
    one, A = albedo_and_room(signal, weight**2, m, albedo, room)
    of_prior = np.sqrt(prior_weight(albedo, room)) * (A - room.level * one)
    return np.concatenate([(weight * (signal - one * m - room.share[:, None] * A)).ravel(), of_prior])


def prior_weight(size: Array, room: RoomPrior) -> Array:
    """Inverse prior variance (P,) of A for surfaces of |b| (P,)."""
    return np.asarray(1 / np.maximum(SPREAD * room.level * size, 1e-12) ** 2)


def lowest(signal: Array, usable: Mask, room: RoomPrior) -> Array:
    """Upper bound (P,) of A: the least usable sample; 0 where none is usable."""
    least = np.min(np.where(usable, signal / room.share[:, None], np.inf), axis=0)
    return np.asarray(np.where(np.isfinite(least), np.maximum(least, 0.0), 0.0))


def _without(signal: Array, sigma: Array, doubt: Array, ambient: Array) -> tuple[Array, Array]:
    """Signals (L, P) without the ambient part, and their variance."""
    lamps = signal - ambient
    return lamps, sample_costs.variance(lamps, sigma, doubt)


def _costs(signal: Array, sigma: Array, usable: Mask, doubt: Array, predicted: Array, ambient: Array) -> tuple[Array, Array]:
    """Cost (L, P) and squared residual (L, P) of samples; a sample darker than the ambient light is not explained by a shadow."""
    lamps, spread2 = _without(signal, sigma, doubt, ambient)
    top = np.max(np.where(usable, lamps, 0.0), axis=0)
    indirect = np.where(lamps > predicted, BRIGHTER, sample_costs.DARKER) * top
    square = (lamps - predicted) ** 2 / (spread2 + indirect**2)
    below = np.minimum(np.minimum(lamps, 0.0) ** 2 / (spread2 + (DEEP * top) ** 2), sample_costs.OUTLIER)
    shadow = np.where(lamps < sample_costs.DARK_SHARE * predicted, sample_costs.DARK, sample_costs.HALF_DARK) + below
    return np.minimum(square, np.where(lamps < predicted, shadow, sample_costs.OUTLIER)), square


def _prior(A: Array, size: Array, room: RoomPrior) -> Array:
    """Cost (P,) of the deviation of A from level |b|."""
    return np.asarray(np.minimum((A - room.level * size) ** 2 * prior_weight(size, room), sample_costs.OUTLIER))


def _second(values: Array, usable: Mask) -> Array:
    """The second largest usable value (P,)."""
    return second(np.where(usable, values, 0.0))


def _solved(signal: Array, weight: Array, B: Array, n: Array, size: Array, room: RoomPrior) -> tuple[Array, Array, Array]:
    """Least-squares b (P, 3), A (P,), `Free.information` (P,); B (L, P, 3) is 0 in shadow, n (P, 3) and |b| (P,) are from the last step."""
    share = np.broadcast_to(room.share[:, None, None], (*signal.shape, 1))
    M = np.concatenate([B + room.level * share * n, share], axis=2)
    weighted = M * weight[..., None]
    normal = np.einsum("lpi,lpj->pij", weighted, M)
    right = np.einsum("lpi,lp->pi", weighted, signal)
    prior = prior_weight(size, room)
    normal[:, 3, 3] += prior
    scale = np.sqrt(np.maximum(np.einsum("pii->pi", normal), 1e-30))
    normal = normal / scale[:, :, None] / scale[:, None, :] + LEVEL_TIE * np.eye(4)
    both = np.stack([right / scale, np.broadcast_to([0.0, 0, 0, 1], right.shape)], axis=2)
    x, inverse = np.moveaxis(np.linalg.solve(normal, both) / scale[:, :, None], 2, 0)
    information = np.clip(1 - prior * inverse[:, 3] / scale[:, 3], 0, 1)
    return x[:, :3], np.maximum(room.level * lambert.dot(n, x[:, :3]) + x[:, 3], 0.0), information
