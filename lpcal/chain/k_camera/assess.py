"""How sure the camera is over the imager, which views make it so, and where the board should be held next.

Symbols: s the shared unknowns (lens, board's shape); S_k the information that view k has of them, its pose eliminated; C the lens' block of
the covariance; J(p) the derivative of the projection at pixel p by the lens, R(p) by a turn of the camera, which means nothing::

    C = sigma^2 [(sum S_k + prior)^-1]_lens        J'(p) = J(p) - R(p) R^+ J        U(p) = J'(p) C J'(p)'

R^+ over what corners cover: a polynomial lens means nothing beyond their hull, and nothing there is trusted. The worst direction's sigma
is the root of U's greater eigenvalue. Without view k: sum less S_k; with another view: plus S of a board put there.
Source: projection uncertainty as in mrcal's documentation, here at infinity; Pukelsheim 1993 (design).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.chain.k_camera.bundle import Bundle, Unknowns, lens_jacobian, view_information
from lpcal.chain.k_camera.problem import CameraFit, CornerProblem
from lpcal.chain.k_camera.shape import shape_terms
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.camera_difference import pixel_grid
from lpcal.geometry.hull import inside_hull

COLUMNS, ROWS = 12, 8
"""Columns and rows of the grid over the imager."""
TRUSTED = 3.0
"""A place is trusted where the worst direction's sigma is under so many times the median of what corners cover."""
INVERTED_PX = 1e-3
"""A pixel whose ray does not project back to it this closely lies where the lens cannot be inverted."""


@dataclass(frozen=True)
class Sureness:
    """Worst direction's sigma (ROWS, COLUMNS) over the imager, in px, and what follows from it."""

    pixels: Array
    """(ROWS, COLUMNS, 2)."""
    worst_px: Array
    covered: Mask
    """Inside the hull of all corners."""
    trusted: Mask
    """Covered, and about as sure as is usual there."""
    gain: Array
    """(N,) how much worse the mean over the covered part becomes without each view, as a ratio."""


@dataclass(frozen=True)
class Information:
    """What the views know: S_k (N, S, S), the prior (S,), the lens' count, sigma, and the state that it was made at."""

    views: Array
    prior: Array
    lens: int
    sigma_px: float
    bundle: Bundle
    state: Unknowns

    def covariance(self, total: Array) -> Array:
        """Covariance of the lens (P, P), from the sum of the views' information."""
        total = total + np.diag(self.prior)
        scale = 1 / np.sqrt(np.maximum(np.diag(total), 1e-300))
        inverse = np.linalg.pinv(total * scale[:, None] * scale, hermitian=True) * scale[:, None] * scale
        return np.asarray(self.sigma_px**2 * inverse[: self.lens, : self.lens])


def information(problem: CornerProblem, fit: CameraFit) -> Information:
    """Information of each view, at the fit."""
    terms = shape_terms(problem.board, fit.board)
    bundle = Bundle(problem.corners_px, problem.board.points_B(), terms, free_lens=True, sigma_px=fit.sigma_px)
    state = Unknowns(fit.camera.K, fit.camera.distortion, fit.H_CB, np.array([fit.shape[name][0] for name in terms.names]))
    views, prior = view_information(bundle, state, fit.inlier)
    return Information(views, prior, 4 + state.distortion.size, fit.sigma_px, bundle, state)


def assess(known: Information, fit: CameraFit) -> Sureness:
    """Sureness over the imager, and what each view is worth."""
    pixels = pixel_grid(fit.camera.image_size, COLUMNS, ROWS)
    covered = judged_pixels(pixels, fit)
    judged = covered if covered.any() else np.ones(len(pixels), dtype=bool)
    slope = ray_slope(known, pixels, fit, judged)
    total = known.views.sum(axis=0)
    worst = np.minimum(np.nan_to_num(worst_direction(slope, known.covariance(total)), nan=np.inf), fit.camera.image_size[0])
    usual = float(np.median(worst[judged]))
    mean = mean_sigma(slope[judged], known.covariance(total))
    without = [mean_sigma(slope[judged], known.covariance(total - one)) for one in known.views]
    shape = (ROWS, COLUMNS)
    return Sureness(
        pixels=pixels.reshape(*shape, 2),
        worst_px=worst.reshape(shape),
        covered=covered.reshape(shape),
        trusted=(covered & (worst < TRUSTED * usual)).reshape(shape),
        gain=np.array(without) / mean,
    )


def assess_spline(fit: CameraFit) -> Sureness:
    """Sureness over the imager as the solver itself states it; what each view is worth is not known."""
    assert fit.uncertainty is not None
    pixels = pixel_grid(fit.camera.image_size, COLUMNS, ROWS)
    worst = fit.uncertainty(pixels)
    covered = judged_pixels(pixels, fit)
    trusted = covered & (worst < TRUSTED * float(np.median(worst[covered] if covered.any() else worst)))
    shape = (ROWS, COLUMNS)
    return Sureness(pixels.reshape(*shape, 2), worst.reshape(shape), covered.reshape(shape), trusted.reshape(shape), np.zeros(0))


def judged_pixels(pixels: Array, fit: CameraFit) -> Mask:
    """Those of the pixels (N, 2) inside the hull of the corners used, where the lens can be inverted."""
    covered = inside_hull(pixels, (fit.camera.project(se3.apply(fit.H_CB, fit.points_B)))[fit.inlier])
    return np.asarray(covered & (np.linalg.norm(fit.camera.project(fit.camera.unproject(pixels)) - pixels, axis=1) < INVERTED_PX))


def ray_slope(known: Information, pixels: Array, fit: CameraFit, judged: Mask | None = None) -> Array:
    """J' (N, 2, P): how pixels of fixed rays move with the lens, a turn of the camera taken out over those judged (all)."""
    rays_C = fit.camera.unproject(pixels)
    J = lens_jacobian(rays_C, known.state.K, known.state.distortion)
    turn = -fit.camera.projection_jacobian(rays_C) @ se3.hat(rays_C)
    rows = slice(None) if judged is None else judged
    taken_out = np.linalg.lstsq(turn[rows].reshape(-1, 3), J[rows].reshape(-1, J.shape[-1]), rcond=None)[0]
    return np.asarray(J - turn @ taken_out)


def worst_direction(slope: Array, covariance: Array) -> Array:
    """The worst direction's sigma (N,) in px."""
    return np.asarray(np.sqrt(np.maximum(np.linalg.eigvalsh(slope @ covariance @ np.swapaxes(slope, 1, 2))[:, -1], 0.0)))


def mean_sigma(slope: Array, covariance: Array) -> float:
    """Root of the mean variance over the pixels, both directions added."""
    return float(np.sqrt(np.mean(np.trace(slope @ covariance @ np.swapaxes(slope, 1, 2), axis1=1, axis2=2))))
