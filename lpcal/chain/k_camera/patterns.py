"""What the residuals still show: a pattern that stays with the board, or with the image, is a shape or a lens that was not modelled.

Symbols: residual r_km of corner m of view k, its noise sigma a coordinate; G_km (2, 3) the derivative of its pixel by a displacement of the
board's point; N_m the sum of G'G over the views, g_m of G'r; in the image, n_c residuals in cell c and their mean b_c::

    board:  q_m = g_m' N_m^-1 g_m / sigma^2, chi-square of 3 where nothing is left        image:  q_c = n_c |b_c|^2 / sigma^2, of 2
    z = (sum q - dof) / sqrt(2 dof)        size^2 = sigma^2 max(0, sum q - dof) / (2 n)

z is about normal where nothing is left; size is rms a coordinate. Source: chi-square of independent means.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.chain.k_camera.problem import CameraFit
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

CELLS = (8, 6)
FEWEST = 4
"""A mean of fewer residuals than this says nothing."""
SEEN_Z, SEEN_SHARE = 6.0, 0.25
"""A pattern is said where z is over the one, and its size over this share of a corner's sigma."""


@dataclass(frozen=True)
class Pattern:
    """How large what is left is, rms a coordinate, and how sure that it is there at all."""

    size_px: float
    z: float

    def seen(self, sigma_px: float) -> bool:
        """Whether it is worth reporting."""
        return self.z > SEEN_Z and self.size_px > SEEN_SHARE * sigma_px


def on_board(fit: CameraFit) -> Pattern:
    """What displaced points of the board would explain, the same in all views."""
    G = fit.camera.projection_jacobian(se3.apply(fit.H_CB, fit.points_B)) @ fit.H_CB[:, None, :3, :3]
    G = G * fit.inlier[..., None, None]
    residual_px = np.where(fit.inlier[..., None], fit.residual_px, 0.0)
    N, g = np.einsum("kmia,kmib->mab", G, G), np.einsum("kmia,kmi->ma", G, residual_px)
    kept = fit.inlier.sum(axis=0) >= FEWEST
    explained = np.einsum("ma,mab,mb->m", g, np.linalg.pinv(N, hermitian=True), g)[kept]
    return _pattern(explained, 3, int(fit.inlier[:, kept].sum()), fit.sigma_px)


def on_image(fit: CameraFit) -> Pattern:
    """What corners in the same part of the image have in common."""
    places = fit.camera.project(se3.apply(fit.H_CB, fit.points_B))
    cell = np.clip((places / fit.camera.image_size * CELLS).astype(int), 0, np.array(CELLS) - 1)
    group, residual_px = (cell[..., 1] * CELLS[0] + cell[..., 0])[fit.inlier], fit.residual_px[fit.inlier]
    count = np.bincount(group)
    kept = count >= FEWEST
    sums = np.stack([np.bincount(group, residual_px[:, axis]) for axis in (0, 1)], axis=1)[kept]
    return _pattern(np.sum(sums**2, axis=1) / count[kept], 2, int(count[kept].sum()), fit.sigma_px)


def _pattern(explained: Array, freedom: int, count: int, sigma_px: float) -> Pattern:
    """From the squares that each group explains, and the number of residuals in all."""
    if not explained.size or not sigma_px > 0:
        return Pattern(0.0, 0.0)
    excess = float(np.sum(explained) / sigma_px**2 - freedom * explained.size)
    return Pattern(float(sigma_px * np.sqrt(max(excess, 0.0) / (2 * count))), excess / float(np.sqrt(2 * freedom * explained.size)))
