r"""Robust costs of a pixel's samples under a hypothesis: a surface of free normal, a plane of known normal and depth, or no light.

Symbols: signal I_k, predicted signal m_k, residual r_k = (I_k - m_k) / s_k with the sample's standard deviation s_k::

    s_k^2 = noise^2 + (MODEL^2 + doubt_k^2) I_k^2 + (indirect max_l I_l)^2

A sample brighter than predicted costs min(r^2, OUTLIER). A darker one costs min(r^2, cost of a shadow): DARK where less than DARK_SHARE of
the predicted signal is left, else HALF_DARK. Interreflection only adds light, so `indirect` is BRIGHTER for brighter samples and DARKER for
darker ones. Costs are minus twice the log likelihood, so those of independent samples add up.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.kernels.library import kernel
from lpcal.view.constants import OUTLIER2, SHADOW
from lpcal.view.pixel_list import second

MODEL = 0.03
"""Relative standard deviation of the Lambertian model: interreflection, ripples of a lobe."""
BRIGHTER, DARKER = 0.1, 0.015
"""Standard deviation of interreflected light, as a share of a pixel's brightest sample, for samples above and below the prediction."""
OUTLIER = 25.0
"""Largest cost of a sample above its prediction (5 sigmas): a highlight, or another surface."""
DARK, HALF_DARK = 5.0, 12.0
"""Costs of a shadowed sample, minus twice the log of its prior probability: below DARK_SHARE of the predicted signal, and above."""
DARK_SHARE = 0.2
"""Share of the predicted signal below which a sample is dark: only interreflected light reaches a cast shadow."""
INTERREFLECTED = 0.04
"""Interreflected light in deep shadow, as a share of the signal of the brightest matter in full light (measured: 2 to 6 per cent)."""
ROUNDS = 3
"""Solves for the normal: the first uses all unshadowed samples, the others are reweighted by their residuals."""
MOST_LIGHTS = 32
"""Largest number of lights that the kernels support."""


def variance(signal: Array, sigma: Array, doubt: Array) -> Array:
    """Variance (L, P) of samples, without that of interreflected light."""
    return np.asarray(sigma**2 + (MODEL**2 + np.asarray(doubt, float) ** 2) * signal**2)


def square_residual(signal: Array, predicted: Array, spread2: Array) -> Array:
    """Squared residuals (L, P) in standard deviations, with interreflected light in the variance."""
    indirect = np.where(signal > predicted, BRIGHTER, DARKER) * signal.max(axis=0)
    return np.asarray((signal - predicted) ** 2 / (spread2 + indirect**2))


def price(signal: Array, predicted: Array, square: Array) -> Array:
    """Cost (L, P) of samples from their squared residuals."""
    shadow = np.where(signal < DARK_SHARE * predicted, DARK, HALF_DARK)
    return np.minimum(square, np.where(signal < predicted, shadow, OUTLIER))


def free(signal: Array, sigma: Array, usable: Mask, B: Array, doubt: Array) -> tuple[Array, Array]:
    """b (P, 3) and cost (P,) of pixels as surfaces of free normal under light vectors B (L, P, 3), by iteratively reweighted least squares.

    A shadowed sample costs the same for an attached shadow as for a cast one.
    """
    if len(signal) <= MOST_LIGHTS and (run := kernel("free")):
        b, cost = np.empty(B.shape[1:]), np.empty(B.shape[1])
        run(*signal.shape, *_given(signal, sigma, usable, B, doubt), ROUNDS, b, cost)
        return b, cost
    spread2, E = variance(signal, sigma, doubt), lambert.length(B)
    shading = np.where(usable & (E > 0), signal / np.maximum(E, 1e-12), 0.0)
    shadow = shading < SHADOW * second(shading)
    weight = (usable & ~shadow) / spread2
    b = lambert.weighted(B, signal, weight)[0]
    for _ in range(ROUNDS - 1):
        square = square_residual(signal, lambert.predicted(B, b), spread2)
        b = lambert.weighted(B, signal, weight / (1 + square / OUTLIER2) ** 2)[0]
    b = np.nan_to_num(b)
    predicted = lambert.predicted(B, b)
    cost = price(signal, predicted, square_residual(signal, predicted, spread2))
    return b, np.asarray(np.sum(np.where(usable, np.where(shadow, np.maximum(cost, DARK), cost), 0.0), axis=0))


def planar(signal: Array, sigma: Array, usable: Mask, m: Array, doubt: Array) -> tuple[Array, Array, Mask]:
    """Cost (P,) and albedo (P,) of pixels on a plane that has signals m (L, P) at albedo 1, and the samples (L, P) that are lit.

    The albedo is the one of least cost among those of single samples, then the weighted mean of the samples that agree with it.
    """
    if len(signal) <= MOST_LIGHTS and (run := kernel("planar")):
        found, one, agreed = np.empty(m.shape[1]), np.empty(m.shape[1]), np.empty(m.shape, bool)
        run(*signal.shape, *_given(signal, sigma, usable, m, doubt), found, one, agreed)
        return found, one, agreed
    spread2 = variance(signal, sigma, doubt)
    least, albedo, lit = np.full(m.shape[1], np.inf), np.zeros(m.shape[1]), np.zeros(m.shape, bool)

    def consider(one: Array, allowed: Mask) -> None:
        predicted = one * m
        square = square_residual(signal, predicted, spread2)
        agree = usable & (square < OUTLIER2) & (m > 0)
        cost = np.where(allowed & (agree.sum(axis=0) >= 2), np.sum(np.where(usable, price(signal, predicted, square), 0.0), axis=0), np.inf)
        better = cost < least
        least[better], albedo[better], lit[:, better] = cost[better], one[better], agree[:, better]

    for k in range(len(m)):
        consider(np.where(m[k] > 0, signal[k] / np.maximum(m[k], 1e-12), 0.0), usable[k] & (m[k] > 0) & (signal[k] > 0))
    for _ in range(2):
        weight = lit / spread2
        mean = np.sum(weight * m * signal, axis=0) / np.maximum(np.sum(weight * m**2, axis=0), 1e-12)
        consider(mean, mean > 0)
    blind = usable.sum(axis=0) < 2
    return np.where(blind, 0.0, np.where(np.isfinite(least), least, OUTLIER * len(m))), albedo, lit


def _given(signal: Array, sigma: Array, usable: Mask, light: Array, doubt: Array) -> tuple[npt.NDArray[np.generic], ...]:
    """Arguments of the kernels: samples (L, P), their light, and the constants."""
    constants = np.array([MODEL**2, BRIGHTER, DARKER, OUTLIER, DARK, HALF_DARK, DARK_SHARE, SHADOW, OUTLIER2, lambert.SINGULAR])
    signal, sigma, light = (np.ascontiguousarray(one, float) for one in (signal, sigma, light))
    return signal, sigma, np.ascontiguousarray(usable), light, np.ascontiguousarray(doubt, np.float32), constants


def nothing(signal: Array, sigma: Array, usable: Mask, around: Array) -> Array:
    """Cost (P,) of pixels as places that no lamp reaches: their only light is interreflected, a share INTERREFLECTED of `around` (L, P)."""
    square = signal**2 / (sigma**2 + (INTERREFLECTED * around) ** 2)
    return np.asarray(np.sum(np.where(usable, np.minimum(square, OUTLIER), 0.0), axis=0) / 2)
