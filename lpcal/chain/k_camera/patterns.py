"""What the residuals still show: a pattern that stays with the board, or with the image, is a shape or a lens that was not modelled.

Symbols: residual r_km of corner m of view k, its noise sigma a coordinate; G_km (2, 3) the derivative of its pixel by a displacement of the
board's point; N_m the sum of G'G over the views, g_m of G'r; in the image, n_c residuals in cell c and their mean b_c::

    board:  q_m = g_m' N_m^-1 g_m / sigma^2, chi-square of 3 where nothing is left        image:  q_c = n_c |b_c|^2 / sigma^2, of 2
    z = (sum q - dof) / sqrt(2 dof)        size^2 = sigma^2 max(0, sum q - dof) / (2 n)

z is about normal where nothing is left; size is rms a coordinate. Source: chi-square of independent means.

And whether the camera changed between two views, as one does whose zoom or focus is moved: what the views before and those after say of the
focal length (a share of it) and the centre, each view's own pose free, P projecting that out of its derivatives A::

    d = sum (A' P A)^-1 sum A' P r, before and after        chi2 = (d_after - d_before)' (C_after + C_before)^-1 (d_after - d_before), of 3

C holds the noise and how far views of one side disagree (a sandwich, views being the clusters): what is not modelled differs by view.
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
FEWEST_BESIDE = 3
"""Views before a change of the camera, and after it, from which they show it."""
CHANGED_CHI2, CHANGED_SHARE, CHANGED_PX = 45.0, 3e-4, 0.5
"""A change is said where its chi-square of three is over the first, and the focal length's share or the centre's shift in pixels over the
others: less harms nobody. Of four real cameras that did not change it comes to 22 at most, of drawn ones to 4."""


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


@dataclass(frozen=True)
class Change:
    """How the camera differs from one view on."""

    view: int
    """The first view after it."""
    focal_share: float
    """By how much the focal length is longer, a share of it."""
    centre_px: Array
    """(2,) by how much the centre lies elsewhere."""
    chi2: float
    """Chi-square of the change, of three degrees of freedom."""

    @property
    def seen(self) -> bool:
        """Whether it is worth reporting."""
        return self.chi2 > CHANGED_CHI2 and (abs(self.focal_share) > CHANGED_SHARE or float(np.hypot(*self.centre_px)) > CHANGED_PX)


def change(fit: CameraFit) -> Change | None:
    """The change between two views that explains the residuals best, views in the order in which they were taken; None of few views."""
    if len(fit.H_CB) < 2 * FEWEST_BESIDE or not fit.sigma_px > 0:
        return None
    x_C = se3.apply(fit.H_CB, fit.points_B)
    pixels = fit.camera.project(x_C)
    of_pose = fit.camera.projection_jacobian(x_C) @ se3.point_jacobian(x_C)
    of_camera = np.concatenate([(pixels - fit.camera.K[:2, 2])[..., None], np.broadcast_to(np.eye(2), (*pixels.shape, 2))], axis=-1)
    N, g = np.zeros((len(x_C), 3, 3)), np.zeros((len(x_C), 3))
    for k, used in enumerate(fit.inlier):
        if used.sum() > FEWEST:
            A, r = of_camera[k, used].reshape(-1, 3), fit.residual_px[k, used].ravel()
            Q = np.linalg.qr(of_pose[k, used].reshape(-1, 6))[0]
            free = A - Q @ (Q.T @ A)
            N[k], g[k] = free.T @ free, free.T @ r
    best = None
    for first in range(FEWEST_BESIDE, len(x_C) - FEWEST_BESIDE + 1):
        (before, C_before), (after, C_after) = (_said_by(N[part], g[part], fit.sigma_px) for part in (slice(first), slice(first, None)))
        d = after - before
        chi2 = float(d @ np.linalg.pinv(C_before + C_after, hermitian=True) @ d)
        if best is None or chi2 > best.chi2:
            best = Change(first, float(d[0]), d[1:], chi2)
    return best


def _said_by(N: Array, g: Array, sigma_px: float) -> tuple[Array, Array]:
    """d (3,) of views by their normal equations N (n, 3, 3) and g (n, 3), and its covariance: noise, and how far views disagree."""
    inverse = np.linalg.pinv(N.sum(axis=0), hermitian=True)
    d = inverse @ g.sum(axis=0)
    left = (g - N @ d) * np.sqrt(len(g) / max(len(g) - 2, 1))
    return d, inverse * sigma_px**2 + inverse @ (left.T @ left) @ inverse
