"""Albedo of pixels whose normals are known."""

from __future__ import annotations

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Image
from lpcal.surface import normals
from lpcal.surface.normals import Estimate
from lpcal.surface.sight import Lit, Sight


def albedo_of(signal: Array | Image, intensity: Array, lit: Lit, n: Array, found: Estimate, seen: Sight) -> Array:
    """Albedo (P, C): the least-squares factor of the shading, a channel at a time, over the samples that agree.

    `signal` (L, P, C) and `intensity` (L, C) are the channels' own, `n` (P, 3) the normals.
    """
    shading = lambert.predicted(lit.B, n)
    used = np.where(found.used >= normals.LEAST, found.inliers, seen.usable)
    matte = signal / intensity[:, None] - (0.0 if found.gloss is None else found.gloss[..., None])
    return np.asarray(np.einsum("kp,kpc->pc", used * shading, matte) / np.maximum(np.sum(used * shading**2, axis=0), 1e-12)[:, None])
