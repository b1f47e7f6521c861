r"""What samples say for and against an explanation of a pixel: matter of any normal, or a plane whose normal and depth are known.

Symbols: signal I_k, predicted signal m_k, in units of the sample's standard deviation s_k::

    s_k^2 = noise^2 + (MODEL^2 + doubt_k^2) I_k^2 + (indirect max_l I_l)^2

A brighter sample costs min(r^2, OUTLIER), a darker one min(r^2, a shadow's price): DARK where next to nothing is left of it, HALF_DARK
where it keeps much of its light. Light from elsewhere only adds, so `indirect` is BRIGHTER for brighter samples, DARKER for darker ones.
Costs are twice negative logarithms of likelihoods: those of independent samples add up.
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
"""Share of a signal that a model of matte matter lacks: light from elsewhere, ripples of a lobe."""
BRIGHTER, DARKER = 0.1, 0.015
"""Light from other surfaces, as a share of a pixel's brightest sample, by which a sample may be brighter, and darker, than predicted."""
OUTLIER = 25.0
"""Cost of a sample that is brighter than predicted by any amount (5 sigmas): a highlight, or another surface."""
DARK, HALF_DARK = 5.0, 12.0
"""Costs of a sample in shadow, twice the logarithm of how rare that is: with next to nothing left, and with more than DARK_SHARE left."""
DARK_SHARE = 0.2
"""Share of the predicted signal under which a sample is dark: shadows get light from elsewhere only."""
INTERREFLECTED = 0.04
"""Light that surfaces throw into deep shadow, as a share of what the brightest matter sends back in full light (2 to 6 per cent)."""
ROUNDS = 3
"""Solves of the normal, the first with all samples that no shadow darkens, the others by their residuals."""
MOST_LIGHTS = 32
"""Lights that the kernels have room for."""


def variance(signal: Array, sigma: Array, doubt: Array) -> Array:
    """Variance (L, P) of samples but for indirect light."""
    return np.asarray(sigma**2 + (MODEL**2 + np.asarray(doubt, float) ** 2) * signal**2)


def square_residual(signal: Array, predicted: Array, spread2: Array) -> Array:
    """Square residuals (L, P) in sigmas, indirect light counted."""
    indirect = np.where(signal > predicted, BRIGHTER, DARKER) * signal.max(axis=0)
    return np.asarray((signal - predicted) ** 2 / (spread2 + indirect**2))


def price(signal: Array, predicted: Array, square: Array) -> Array:
    """Cost (L, P) of samples by their square residuals."""
    shadow = np.where(signal < DARK_SHARE * predicted, DARK, HALF_DARK)
    return np.minimum(square, np.where(signal < predicted, shadow, OUTLIER))


def free(signal: Array, sigma: Array, usable: Mask, B: Array, doubt: Array) -> tuple[Array, Array]:
    """b (P, 3) by iteratively reweighted least squares, and the cost (P,) of pixels as matter of any normal, lit by B (L, P, 3).

    A sample in shadow costs the same whether the surface turns away from its light or something stands between.
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
    """Cost (P,) of pixels as parts of a plane that sends back m (L, P) where it is white, their albedo (P,), and the lit samples (L, P).

    The albedo of least cost among those that a sample by itself states is taken, then the mean of the samples that agree with it.
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
    """What the kernels are given: samples (L, P), their light, and the constants."""
    constants = np.array([MODEL**2, BRIGHTER, DARKER, OUTLIER, DARK, HALF_DARK, DARK_SHARE, SHADOW, OUTLIER2, lambert.SINGULAR])
    signal, sigma, light = (np.ascontiguousarray(one, float) for one in (signal, sigma, light))
    return signal, sigma, np.ascontiguousarray(usable), light, np.ascontiguousarray(doubt, np.float32), constants


def nothing(signal: Array, sigma: Array, usable: Mask, around: Array) -> Array:
    """Cost (P,) of pixels as places that no light reaches but what other surfaces throw there, a share of `around` (L, P)."""
    square = signal**2 / (sigma**2 + (INTERREFLECTED * around) ** 2)
    return np.asarray(np.sum(np.where(usable, np.minimum(square, OUTLIER), 0.0), axis=0) / 2)
