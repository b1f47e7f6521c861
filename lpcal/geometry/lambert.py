"""Lambertian shading, solved pixel by pixel.

Symbols: light k brings irradiance E_k from the unit direction d_k, ``B_k = E_k d_k``; the surface has normal n and albedo rho,
``b = rho n``; the signal is ``I_k = B_k . b`` where the light reaches it. Source: Woodham 1980, Optical Engineering 19(1).

Layout: samples are (L, P), light vectors B (L, P, 3), of L lights at P pixels.
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array

SINGULAR = 1e-12


def weighted(B: Array, signal: Array, weight: Array) -> tuple[Array, Array]:
    """b (P, 3) that minimises ``sum_k weight (signal - B . b)^2``, and the inverse (P, 3, 3) of its normal matrix.

    Where the weighted lights do not span space, b is NaN.
    """
    WB = weight[..., None] * B
    normal_matrix = np.einsum("kpi,kpj->pij", WB, B)
    inverse = inverse_3x3(normal_matrix)
    return np.einsum("pij,pj->pi", inverse, np.einsum("kpi,kp->pi", WB, signal)), inverse


def inverse_3x3(M: Array) -> Array:
    """Inverse (P, 3, 3) of symmetric matrices M (P, 3, 3), by cofactors; NaN where singular."""
    cofactors = np.stack([np.cross(M[:, 1], M[:, 2]), np.cross(M[:, 2], M[:, 0]), np.cross(M[:, 0], M[:, 1])], axis=1)
    determinant = np.einsum("pi,pi->p", M[:, 0], cofactors[:, 0])
    scale = np.trace(M, axis1=1, axis2=2) ** 3
    determinant = np.where(determinant > SINGULAR * scale, determinant, np.nan)
    return np.asarray(cofactors / determinant[:, None, None])


def three_lights(B: Array, signal: Array) -> Array:
    """b (P, 3) of exactly three lights B (3, P, 3) with their signals (3, P); huge where the lights are nearly in a plane."""
    crossed = np.stack([np.cross(B[1], B[2]), np.cross(B[2], B[0]), np.cross(B[0], B[1])])
    determinant = np.einsum("pi,pi->p", B[0], crossed[0])
    determinant = np.where(np.abs(determinant) > SINGULAR * np.linalg.norm(B, axis=2).prod(axis=0), determinant, np.nan)
    return np.asarray(np.einsum("kpi,kp->pi", crossed, signal) / determinant[:, None])


def predicted(B: Array, b: Array) -> Array:
    """Signals (L, P) of b (P, 3); 0 where a surface turns away from the light."""
    return np.asarray(np.maximum(np.einsum("kpi,pi->kp", B, b), 0.0))


def unit(b: Array) -> tuple[Array, Array]:
    """Normals (..., 3) and albedo (...) of b (..., 3)."""
    albedo = np.linalg.norm(b, axis=-1)
    return b / np.maximum(albedo, 1e-300)[..., None], albedo
