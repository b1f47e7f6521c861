"""What the residuals still know: a pattern that stays with the board, or with the image, is a shape or a lens that was not modelled.

Symbols: residual r_km of corner m of view k, its noise sigma a coordinate; mean a_m over the views, turned to the board's own axes; mean
b_c over the corners in cell c of the image; n of them each::

    pattern^2 = mean over m of (|a_m|^2 / 2 - sigma^2 / n_m)       z = (sum n_m |a_m|^2 / sigma^2 - 2 M) / sqrt(4 M)

z is about normal where nothing is left. Source: chi-square of independent means.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.chain.k_camera.problem import CameraFit
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Index

CELLS = (8, 6)
FEWEST = 4
"""A mean of fewer residuals than this says nothing."""
SEEN_Z, SEEN_SHARE = 5.0, 0.35
"""A pattern is said where z is over the one, and its size over this share of a corner's sigma."""


@dataclass(frozen=True)
class Pattern:
    """How large what is left is, rms a coordinate, and how sure that it is there at all."""

    size_px: float
    z: float

    def seen(self, sigma_px: float) -> bool:
        """Whether it is worth a word."""
        return self.z > SEEN_Z and self.size_px > SEEN_SHARE * sigma_px


def on_board(fit: CameraFit) -> Pattern:
    """What the views have in common at each corner of the board."""
    along = fit.camera.project(se3.apply(fit.H_CB, fit.points_B)) - fit.camera.project(
        se3.apply(fit.H_CB, fit.points_B - np.array([1e-4, 0.0, 0.0]))
    )
    x = along / np.linalg.norm(along, axis=-1, keepdims=True)
    turned = np.stack(
        [np.sum(fit.residual_px * x, axis=-1), fit.residual_px[..., 1] * x[..., 0] - fit.residual_px[..., 0] * x[..., 1]], axis=-1
    )
    number = np.broadcast_to(np.arange(len(fit.points_B)), fit.inlier.shape)
    return _pattern(turned[fit.inlier], number[fit.inlier], fit.sigma_px)


def on_image(fit: CameraFit) -> Pattern:
    """What corners in the same part of the image have in common."""
    places = fit.camera.project(se3.apply(fit.H_CB, fit.points_B))
    cell = np.clip((places / fit.camera.image_size * CELLS).astype(int), 0, np.array(CELLS) - 1)
    return _pattern(fit.residual_px[fit.inlier], (cell[..., 1] * CELLS[0] + cell[..., 0])[fit.inlier], fit.sigma_px)


def _pattern(residual_px: Array, group: Index, sigma_px: float) -> Pattern:
    count = np.bincount(group)
    kept = count >= FEWEST
    if not kept.any() or not sigma_px > 0:
        return Pattern(0.0, 0.0)
    means = np.stack([np.bincount(group, residual_px[:, axis]) for axis in (0, 1)], axis=1)[kept] / count[kept, None]
    squares = np.sum(means**2, axis=1)
    excess = float(np.mean(squares / 2 - sigma_px**2 / count[kept]))
    z = float((np.sum(count[kept] * squares) / sigma_px**2 - 2 * kept.sum()) / np.sqrt(4 * kept.sum()))
    return Pattern(float(np.sqrt(max(excess, 0.0))), z)
