"""Lambertian shading, solved pixel by pixel.

Symbols: light k brings irradiance E_k from the unit direction d_k, ``B_k = E_k d_k``; the surface has normal n and albedo rho,
``b = rho n``; the signal is ``I_k = B_k . b`` where the light reaches it. Source: Woodham 1980, Optical Engineering 19(1).

Layout: samples are (L, P), light vectors B (L, P, 3), of L lights at P pixels.
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.kernels.library import kernel

SINGULAR = 1e-12


def weighted(B: Array, signal: Array, weight: Array) -> tuple[Array, Array]:
    """b (P, 3) that minimises ``sum_k weight (signal - B . b)^2``, and the inverse (P, 3, 3) of its normal matrix.

    Where the weighted lights do not span space, b is NaN.
    """
    if run := kernel("weighted"):
        L, P = signal.shape
        b, inverse = np.empty((P, 3)), np.empty((P, 3, 3))
        run(L, P, *(np.ascontiguousarray(one, float) for one in (B, signal, weight)), SINGULAR, b, inverse)
        return b, inverse
    inverse = inverse_3x3(normal_matrix(B, weight))
    return np.einsum("pij,pj->pi", inverse, np.einsum("kpi,kp->pi", B, weight * signal)), inverse


def normal_matrix(B: Array, weight: Array) -> Array:
    """Sums (P, 3, 3) of the outer products of light vectors B (L, P, 3) with themselves, by weights (L, P)."""
    columns = np.ascontiguousarray(np.moveaxis(B, 2, 0))
    found = np.empty((B.shape[1], 3, 3))
    for i in range(3):
        weighted = weight * columns[i]
        for j in range(i, 3):
            found[:, i, j] = found[:, j, i] = np.einsum("kp,kp->p", weighted, columns[j])
    return found


def inverse_3x3(M: Array, singular: float = SINGULAR) -> Array:
    """Inverse (P, 3, 3) of symmetric matrices M (P, 3, 3), by cofactors; NaN where the determinant is below this share of trace^3."""
    a, b, c, _, d, e, _, _, f = np.ascontiguousarray(M.reshape(-1, 9).T)
    upper = d * f - e * e, c * e - b * f, b * e - c * d, a * f - c * c, b * c - a * e, a * d - b * b
    determinant = a * upper[0] + b * upper[1] + c * upper[2]
    determinant = np.where(determinant > singular * (a + d + f) ** 3, determinant, np.nan)
    inverse = np.empty((len(M), 9))
    for cofactor, places in zip(upper, ((0,), (1, 3), (2, 6), (4,), (5, 7), (8,)), strict=True):
        inverse[:, places] = (cofactor / determinant)[:, None]
    return inverse.reshape(-1, 3, 3)


def three_lights(B: Array, signal: Array, crossed: dict[tuple[int, int], Array], three: tuple[int, int, int]) -> Array:
    """b (P, 3) of exactly three of the lights B (L, P, 3), i < j < k, with their signals (L, P); NaN where they lie in a plane.

    `crossed` holds the products ``B_i x B_j`` of all pairs i < j (see `crosses`).
    """
    i, j, k = three
    determinant = dot(B[k], crossed[i, j])
    size = np.sqrt(dot(B[i], B[i]) * dot(B[j], B[j]) * dot(B[k], B[k]))
    factor = 1 / np.where(np.abs(determinant) > SINGULAR * size, determinant, np.nan)
    return np.asarray(
        (signal[i] * factor)[:, None] * crossed[j, k]
        - (signal[j] * factor)[:, None] * crossed[i, k]
        + (signal[k] * factor)[:, None] * crossed[i, j]
    )


def crosses(B: Array) -> dict[tuple[int, int], Array]:
    """``B_i x B_j`` (P, 3) of all pairs i < j of lights B (L, P, 3)."""
    return {(i, j): cross(B[i], B[j]) for j in range(len(B)) for i in range(j)}


def cross(a: Array, b: Array) -> Array:
    """Cross product (P, 3), faster than numpy's own."""
    return np.stack(
        [a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1], a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2], a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]], axis=1
    )


def trace(M: Array) -> Array:
    """Trace (P,) of matrices M (P, 3, 3), in a tenth of the time of `np.trace`."""
    return np.asarray(M[:, 0, 0] + M[:, 1, 1] + M[:, 2, 2])


def dot(a: Array, b: Array) -> Array:
    """Dot product (...) over the last axis of three."""
    found = np.asarray(a[..., 0] * b[..., 0])
    found += a[..., 1] * b[..., 1]
    found += a[..., 2] * b[..., 2]
    return found


def length(a: Array) -> Array:
    """Length (...) over the last axis of three, in a tenth of the time of `np.linalg.norm` and to the same last digit."""
    return np.sqrt(dot(a, a))


def predicted(B: Array, b: Array) -> Array:
    """Signals (L, P) of b (P, 3); 0 where a surface turns away from the light."""
    return np.maximum(dot(B, b), 0.0)


def unit(b: Array) -> tuple[Array, Array]:
    """Normals (..., 3) and albedo (...) of b (..., 3)."""
    albedo = length(b)
    return b / np.maximum(albedo, 1e-300)[..., None], albedo
