r"""Normals and albedo of each pixel from few or many lights, robust to shadows and gloss.

Symbols: signal I_k, light vector B_k (see geometry.lambert), variance of a sample ``s_k^2 = noise^2 + (MODEL I_k)^2``, residual
``r_k = (I_k - B_k . b) / s_k``.

A sample is a candidate if it is not saturated, significant over its noise, not shadowed by its shading ``I_k / E_k`` (above SHADOW times
the second largest of the pixel), and its light is not known to be occluded. With few lights every triple of candidates proposes b, the
proposal of least ``sum min(r^2, OUTLIER^2)`` wins, and weighted least squares on its inliers (abs(r) < OUTLIER) follows, in rounds. With
many lights a fit to the middle of the ranked shadings is refined by robust reweighting. Sources: Barsky and Petrou 2003 (four lights),
Fischler and Bolles 1981 (consensus), Wu et al. 2010 and Hernandez et al. 2008 (shadows as outliers), Verbiest and Van Gool 2008 (ranks).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.kernels.library import kernel
from lpcal.view import parallel
from lpcal.view.constants import LEAST_COSINE, OUTLIER, OUTLIER2, SHADOW
from lpcal.view.pixel_list import LIGHTS_NEEDED, Illumination, Indices, PixelList, vectors

MODEL = 0.015
"""Relative standard deviation of a sample due to errors of the model."""
ROUNDS = 3
FEW_LIGHTS = 8
TRIMMED = 0.3
"""Share of a pixel's samples trimmed at the dark end (shadows) and at the bright end (highlights)."""
WEIGHT_ROUNDS = 6
SCALE = 1.5
MAD = 1.4826
MANY_LANES = 8
"""Pixels that the kernel for many lights processes at once."""


@dataclass(frozen=True)
class Estimate:
    """Per-pixel photometric stereo estimates: P pixels, L lights."""

    b: Array
    """(P, 3) albedo times normal; NaN where it is undetermined."""
    inliers: Mask
    """(L, P) samples that agree with it."""
    covariance: Array
    """(P, 3, 3) of b, from the samples' variances."""
    chi2: Array
    """(P,) of the inliers."""
    cost: Array
    """(P,) sum of min(r^2, OUTLIER^2) over the candidates."""
    gloss: Array | None = None
    """(L, P) gloss that was subtracted from the signals."""

    @staticmethod
    def nothing() -> Estimate:
        """An estimate of no pixels."""
        return Estimate(np.empty((0, 3)), np.empty((0, 0), bool), np.empty((0, 3, 3)), np.empty(0), np.empty(0))

    @property
    def used(self) -> Array:
        """Number of inliers (P,)."""
        return np.asarray(self.inliers.sum(axis=0))

    def at(self, some: Indices | slice) -> Estimate:
        """The estimate at some of the pixels."""
        gloss = None if self.gloss is None else self.gloss[:, some]
        return Estimate(self.b[some], self.inliers[:, some], self.covariance[some], self.chi2[some], self.cost[some], gloss)

    def diffuse(self, seen: PixelList) -> Array:
        """Signals (L, P) without gloss."""
        return seen.signal if self.gloss is None else np.maximum(seen.signal - self.gloss, 0.0)


def candidates(seen: PixelList, E: Array, hidden: Mask | None = None) -> Mask:
    """Mask (L, P) of samples that appear lit, unoccluded and usable; `hidden` (L, P) samples are excluded."""

    def of(at: slice) -> Mask:
        signal, light = seen.signal[:, at], E[:, at]
        lit = seen.usable[:, at] & (light > 0)
        shading = np.where(lit, signal / np.maximum(light, 1e-300), 0.0)
        bright = np.partition(shading, -2, axis=0)[-2]
        found = lit & (shading > SHADOW * bright) & (signal > OUTLIER * seen.sigma[:, at])
        return found if hidden is None else found & ~hidden[:, at]

    return np.concatenate(parallel.run_bands(seen.pixels, len(E), of), axis=1)


def variances(seen: PixelList) -> Array:
    """Variance (L, P) of the samples: noise plus the model error (MODEL of the signal)."""
    variance = MODEL * seen.signal
    variance *= variance
    variance += seen.sigma**2
    return variance


def estimate(seen: PixelList, light: Illumination | Array, usable: Mask, variance: Array) -> Estimate:
    """Estimate b of each pixel from the samples `usable` (L, P), under an illumination or light vectors (L, P, 3)."""
    way = _few if len(seen.signal) <= FEW_LIGHTS else _many

    def of(at: slice) -> Estimate:
        return way(seen.signal[:, at], vectors(light, at), usable[:, at], variance[:, at], seen.rays_C[at])

    return joined(parallel.run_bands(seen.pixels, len(seen.signal), of))


def joined(parts: list[Estimate]) -> Estimate:
    """Concatenate the estimates of bands of pixels."""
    gloss = [part.gloss for part in parts if part.gloss is not None]
    return Estimate(
        np.concatenate([part.b for part in parts]),
        np.concatenate([part.inliers for part in parts], axis=1),
        np.concatenate([part.covariance for part in parts]),
        np.concatenate([part.chi2 for part in parts]),
        np.concatenate([part.cost for part in parts]),
        np.concatenate(gloss, axis=1) if gloss else None,
    )


def misfit(seen: PixelList, B: Array, usable: Mask, found: Estimate) -> float:
    """Mean of min(r^2, OUTLIER^2) over the samples `usable` (L, P) of an estimate."""
    square = (seen.signal - lambert.predicted(B, np.nan_to_num(found.b))) ** 2 / variances(seen)
    return float(np.sum(np.where(usable, np.minimum(square, OUTLIER2), 0.0)) / max(usable.sum(), 1))


def gloss_share(lit: Illumination, found: Estimate) -> Array:
    """Ratio (P,) of gloss to directly lit diffuse signal, summed over the inliers."""
    if found.gloss is None:
        return np.zeros(len(found.b))
    shown = found.gloss

    def of(at: slice) -> Array:
        inliers = found.inliers[:, at]
        direct = np.where(inliers, lambert.predicted(lit.at(at).direct, np.nan_to_num(found.b[at])), 0.0).sum(axis=0)
        return np.asarray(np.where(inliers, shown[:, at], 0.0).sum(axis=0) / np.maximum(direct, 1e-12))

    return np.concatenate(parallel.run_bands(len(found.b), len(found.inliers), of))


def interreflected_share(lit: Illumination, found: Estimate) -> Array:
    """Ratio (P,) of interreflected to direct light, summed over the inliers."""
    if lit.interreflected is None:
        return np.zeros(len(found.b))

    def of(at: slice) -> Array:
        here, b, inliers = lit.at(at), np.nan_to_num(found.b[at]), found.inliers[:, at]
        assert here.interreflected is not None
        direct, interreflected = (
            np.sum(np.where(inliers, lambert.predicted(B, b), 0.0), axis=0) for B in (here.direct, here.interreflected)
        )
        return np.asarray(interreflected / np.maximum(direct, 1e-12))

    return np.concatenate(parallel.run_bands(len(found.b), len(found.inliers), of))


def _few(signal: Array, B: Array, usable: Mask, variance: Array, rays_C: Array) -> Estimate:
    """Estimate by the best triple of lights, then least squares on its inliers, in rounds."""
    if run := kernel("few"):
        return _run(run, (signal, B, usable, variance, rays_C), (OUTLIER2, ROUNDS, LIGHTS_NEEDED, -LEAST_COSINE, lambert.SINGULAR))
    b = _best_three(signal, B, usable, variance)
    inliers = usable & (_square_residual(signal, B, b, variance) < OUTLIER2)
    for _ in range(ROUNDS):
        b, covariance = lambert.weighted(B, signal, inliers / variance)
        inliers = usable & (_square_residual(signal, B, b, variance) < OUTLIER2)
    return _judged(signal, B, usable, variance, rays_C, b, covariance)


def _many(signal: Array, B: Array, usable: Mask, variance: Array, rays_C: Array) -> Estimate:
    """Estimate from the middle ranks, reweighted by ``1 / (1 + (r / (SCALE s))^2)^2`` with the pixel's own residual scale s, in rounds."""
    if run := kernel("many"):
        ranks, ends = (TRIMMED, TRIMMED, MAD, SCALE, WEIGHT_ROUNDS), (OUTLIER2, LIGHTS_NEEDED, -LEAST_COSINE, lambert.SINGULAR)
        return _run(run, (signal, B, usable, variance, rays_C), (*ranks, *ends, np.empty(8 * MANY_LANES * len(signal))))
    b = _middle_of_the_ranks(signal, B, usable)
    for _ in range(WEIGHT_ROUNDS):
        residual = np.where(usable, np.abs(signal - lambert.predicted(B, b)), np.nan)
        spread = MAD * _median_of_known(residual)
        own = np.maximum(variance, spread**2)
        square = np.nan_to_num(residual) ** 2 / (SCALE**2 * own)
        b, covariance = lambert.weighted(B, signal, usable / (1 + square) ** 2 / own)
    return _judged(signal, B, usable, np.maximum(variance, spread**2), rays_C, b, covariance)


def _run(run: Callable[..., None], samples: tuple[Array, Array, Mask, Array, Array], fixed: tuple[object, ...]) -> Estimate:
    """The estimate by a kernel, with its constants `fixed`."""
    signal, B, usable, variance, rays_C = samples
    (L, P), given = signal.shape, (np.ascontiguousarray(one, float) for one in (B, signal))
    rest = (np.ascontiguousarray(one, float) for one in (variance, rays_C))
    found = Estimate(np.empty((P, 3)), np.empty((L, P), bool), np.empty((P, 3, 3)), np.empty(P), np.empty(P))
    run(L, P, *given, np.ascontiguousarray(usable), *rest, *fixed, found.b, found.inliers, found.covariance, found.chi2, found.cost)
    return found


def _judged(signal: Array, B: Array, usable: Mask, variance: Array, rays_C: Array, b: Array, covariance: Array) -> Estimate:
    """The estimate with inliers and misfit; b is NaN where there are too few inliers or the normal faces away."""
    square = np.where(usable, _square_residual(signal, B, b, variance), 0.0)
    inliers = usable & (square < OUTLIER2)
    towards = lambert.dot(b, rays_C) < -LEAST_COSINE * lambert.length(b) * lambert.length(rays_C)
    good = (inliers.sum(axis=0) >= LIGHTS_NEEDED) & towards
    return Estimate(
        np.where(good[:, None], b, np.nan),
        inliers,
        covariance,
        np.sum(np.where(inliers, square, 0.0), axis=0),
        np.sum(np.minimum(square, OUTLIER2), axis=0),
    )


def _square_residual(signal: Array, B: Array, b: Array, variance: Array) -> Array:
    square = (signal - lambert.predicted(B, b)) ** 2 / variance
    return np.where(np.isfinite(square), square, np.inf)


def _best_three(signal: Array, B: Array, usable: Mask, variance: Array) -> Array:
    """b (P, 3) of the triple of lights with the least truncated misfit over all candidates."""
    best, least = np.full(B.shape[1:], np.nan), np.full(B.shape[1], np.inf)
    crossed, weight = lambert.crosses(B), usable / variance
    for three in combinations(range(len(B)), 3):
        b = lambert.three_lights(B, signal, crossed, three)
        square = weight * (signal - lambert.predicted(B, b)) ** 2
        cost = np.where(usable[list(three)].all(axis=0), np.minimum(square, OUTLIER2).sum(axis=0), np.inf)
        better = cost < least  # False where b is NaN
        best[better], least[better] = b[better], cost[better]
    return best


def _middle_of_the_ranks(signal: Array, B: Array, usable: Mask) -> Array:
    """b (P, 3) by least squares on the candidates without the darkest and the brightest of them."""
    shading = np.where(usable, signal / np.maximum(lambert.length(B), 1e-300), np.inf)
    rank = np.argsort(np.argsort(shading, axis=0, kind="stable"), axis=0)
    count = usable.sum(axis=0)
    kept = usable & (rank >= np.floor(TRIMMED * count)) & (rank < np.ceil((1 - TRIMMED) * count))
    return lambert.weighted(B, signal, kept.astype(float))[0]


def _median_of_known(values: Array) -> Array:
    """Median (P,) over the lights of values (L, P), ignoring NaN; 0 where all are NaN."""
    count = np.isfinite(values).sum(axis=0)
    ranked = np.sort(values, axis=0)  # NaN goes last
    low, high = np.maximum(count - 1, 0) // 2, count // 2
    found = (
        np.take_along_axis(ranked, low[None], axis=0)[0] + np.take_along_axis(ranked, np.minimum(high, len(values) - 1)[None], axis=0)[0]
    ) / 2
    return np.nan_to_num(found)


def albedo_of(signal: Array | Image, intensity: Array, lit: Illumination, n: Array, found: Estimate, seen: PixelList) -> Array:
    """Albedo (P, C): the least-squares factor of signal on shading over the inliers, channel by channel.

    `signal` (L, P, C) and `intensity` (L, C) are per channel, `n` (P, 3) are the normals.
    """
    shading = lambert.predicted(lit.B, n)
    used = np.where(found.used >= LIGHTS_NEEDED, found.inliers, seen.usable)
    matte = signal / intensity[:, None] - (0.0 if found.gloss is None else found.gloss[..., None])
    return np.asarray(np.einsum("kp,kpc->pc", used * shading, matte) / np.maximum(np.sum(used * shading**2, axis=0), 1e-12)[:, None])
