"""Images as functions of the light's direction: polynomial texture maps and hemispherical harmonics, fitted pixel by pixel.

Symbols: unit direction to the light (u, v, w), u right, v up, w to the camera; basis b(u, v, w) (K,); images I (L, N) of L lights::

    I = B C,  B (L, K) rows b of the lights,    C (K, N) = (B^T B + ridge)^-1 B^T I

Held-out error: the fit is linear, so what it says of light k without image k differs from it by ``(I - B C)_k / (1 - h_k)`` with the
leverages h on the diagonal of ``B (B^T B + ridge)^-1 B^T``. Sources: Malzbender et al. 2001, Polynomial texture maps; Gautron et al. 2004,
A novel hemispherical basis.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Image, Mask

LOWEST_RAD = 0.15
"""Elevation below which the harmonics take a light as standing there, radians: as OpenLIME does, for they bend hard at the horizon."""
RIDGE = 1e-4
"""Share of the mean of the basis' squares that is added to them: next to nothing where the lights determine the fit."""
PTM_TERMS = 6
HSH_TERMS = (4, 9, 16)
"""Terms of the harmonics of order 1 to 3, which RTIViewer knows; OpenLIME knows the first two."""


def ptm_basis(directions: Array) -> Array:
    """u^2, v^2, uv, u, v, 1 (L, 6) of directions (L, 3)."""
    u, v = directions[:, 0], directions[:, 1]
    return np.stack([u * u, v * v, u * v, u, v, np.ones_like(u)], axis=1)


def hsh_basis(directions: Array, terms: int) -> Array:
    """Hemispherical harmonics (L, terms) of directions (L, 3), 4, 9 or 16 terms."""
    phi = np.arctan2(directions[:, 1], directions[:, 0])
    c = np.cos(np.minimum(np.arccos(np.clip(directions[:, 2], -1, 1)), np.pi / 2 - LOWEST_RAD))
    s = np.sqrt(np.maximum(c - c * c, 0.0))
    one, two, three, five = (np.sqrt(factor / np.pi) for factor in (0.5, 6.0, 30.0, 2.5))
    steep, bowed, leaning = (np.sqrt(factor / np.pi) for factor in (140.0, 210.0, 84.0))
    found = [
        np.full_like(c, one),
        two * np.cos(phi) * s,
        np.sqrt(1.5 / np.pi) * (2 * c - 1),
        two * np.sin(phi) * s,
        three * np.cos(2 * phi) * (c * c - c),
        three * np.cos(phi) * (2 * c - 1) * s,
        five * (1 - 6 * c + 6 * c * c),
        three * np.sin(phi) * (2 * c - 1) * s,
        three * np.sin(2 * phi) * (c * c - c),
        steep * np.cos(3 * phi) * s**3,
        bowed * np.cos(2 * phi) * (2 * c - 1) * (c * c - c),
        leaning * np.cos(phi) * s * (1 - 5 * c + 5 * c * c),
        np.sqrt(3.5 / np.pi) * (20 * c**3 - 30 * c * c + 12 * c - 1),
        leaning * np.sin(phi) * s * (1 - 5 * c + 5 * c * c),
        bowed * np.sin(2 * phi) * (2 * c - 1) * (c * c - c),
        steep * np.sin(3 * phi) * s**3,
    ]
    return np.stack(found[:terms], axis=1)


@dataclass(frozen=True)
class RelightFit:
    """Coefficients of images over the light's direction, and how well they predict an image that they were not fitted to."""

    coefficients: Image
    """(K, ...) as the images' pixels."""
    held_out: Array
    """(L,) rms of each image, predicted by all others, as a share of full scale."""


def fit(basis: Array, images: Image, inside: Mask | None = None) -> RelightFit:
    """Fit a basis (L, K) to images (L, H, W, C), 0..1; `inside` (H, W) says which pixels the held-out error counts."""
    normal = basis.T @ basis
    normal += RIDGE * np.trace(normal) / len(normal) * np.eye(len(normal))
    smoother = np.linalg.solve(normal, basis.T)
    leverage = np.clip(np.einsum("lk,kl->l", basis, smoother), 0.0, 1 - 1e-6)
    flat = images.reshape(len(images), -1)
    coefficients = (smoother @ flat).astype(np.float32)
    counted = np.ones(images.shape[1:], bool) if inside is None else np.broadcast_to(inside[..., None], images.shape[1:])
    missed = []
    for k, row in enumerate(flat):
        predicted = row - (row - basis[k] @ coefficients) / (1 - leverage[k])
        apart = (np.clip(predicted, 0, 1) - row)[counted.ravel()]
        missed.append(float(np.sqrt(np.mean(apart**2))))
    return RelightFit(coefficients.reshape(-1, *images.shape[1:]), np.array(missed))
