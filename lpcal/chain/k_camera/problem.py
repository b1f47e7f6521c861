"""What every solver of the intrinsics takes and gives.

Symbols: corner m of view k, pixel q_km; board points x_B,m; ``q_km = project(K, H_CB[k] x_B,m)`` plus noise of `sigma_px` a coordinate.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.records.calibration import Camera
from lpcal.records.observations import Board

DISTORTIONS = {"opencv4": 4, "opencv5": 5, "opencv8": 8}
CORE = ("fx", "fy", "cx", "cy")
REJECT_SIGMAS = 4.0
"""A corner further off than this is rejected."""
ROUNDS = 10
"""At most so many rounds of solving and rejecting."""
COEFFICIENTS = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6")
DIGITS = 4
"""Decimals of a pixel that a cross-check keeps: OpenCV's threads and COLMAP's order of unknowns change the seventh."""


@dataclass(frozen=True)
class CornerProblem:
    """The corners of all views in which the board was found."""

    board: Board
    image_size: tuple[int, int]
    corners_px: Array
    """(N, M, 2) in the order of ``board.points_B()``, NaN where one was not seen."""
    camera: Camera | None = None
    """About what the camera is, where that is known."""
    H_CB: Array | None = None
    """(N, 4, 4) about where the boards are, where that is known."""

    def part(self, rows: Mask) -> CornerProblem:
        """Some of the views."""
        return replace(self, corners_px=self.corners_px[rows], H_CB=None if self.H_CB is None else self.H_CB[rows])


@dataclass(frozen=True)
class CameraFit:
    """What a solver found with one lens model."""

    camera: Camera
    """Covariance included."""
    H_CB: Array
    """(N, 4, 4)."""
    points_B: Array
    """(M, 3), mean plane z = 0."""
    inlier: Mask
    """(N, M) seen and used."""
    residual_px: Array
    """(N, M, 2) seen less projected, outliers too; NaN where not seen."""
    sigma_px: float
    """One standard deviation of a corner coordinate, degrees of freedom counted."""
    board: str
    """What the board was taken as, one of `shape.BOARDS`."""
    shape: dict[str, tuple[float, float]]
    """The numbers of the board's terms, each with its sigma (NaN where the solver does not state it)."""
    cameramodel: Callable[[], str] | None = None
    """The text of a .cameramodel with the optimisation inputs, where the solver has them."""
    uncertainty: Callable[[Array], Array] | None = None
    """The worst direction's sigma (N,) in px at pixels (N, 2) by the solver itself, for lenses of which no covariance is kept."""


type Solver = Callable[[CornerProblem, str, str], CameraFit]
"""A problem, a lens model, and what the board is taken as, one of `shape.BOARDS`."""


def parameter_names(model: str) -> tuple[str, ...]:
    """Names of a model's parameters, in the order of its covariance."""
    return CORE + COEFFICIENTS[: DISTORTIONS[model]]


def scatter(residual_px: Array, inlier: Mask, unknowns: int) -> float:
    """One standard deviation of a corner coordinate: residuals of the inliers over their degrees of freedom."""
    freedom = 2 * int(inlier.sum()) - unknowns
    return float(np.sqrt(np.sum(residual_px[inlier] ** 2) / max(freedom, 1)))


def fitting(residual_px: Array, sigma_px: float) -> Mask:
    """Corners (N, M) within four sigmas, whatever was thought of them before: one rejected under a worse fit may come back."""
    return np.asarray(np.linalg.norm(np.nan_to_num(residual_px, nan=np.inf), axis=-1) < REJECT_SIGMAS * sigma_px)


def rms(residual_px: Array, inlier: Mask) -> float:
    """Root mean square a coordinate over the inliers."""
    return float(np.sqrt(np.mean(residual_px[inlier] ** 2))) if inlier.any() else float("nan")
