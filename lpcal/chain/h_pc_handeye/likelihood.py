r"""The maximum-likelihood hand-eye problem at given noise: corners, mocap poses and the camera's prior, all with their own errors.

PoseUnknown: H_PC, H_OB, the camera's parameters, the clock offset, and a latent panel pose H_OP,k a view, which is eliminated. With the
measured pose H~_k, the velocity (w, v) of the panel and d = offset - offset_0::

    corner m of view k:   ( project( inv(H_OP,k H_PC) H_OB x_B,m ) - seen ) / sigma_px
    board pose k:         rotation and translation of inv(H~_k H_PC) H_OB against the pose found elsewhere: one scatter for both
                          sensors (they cannot be separated without corners), so that no latent pose is needed
    mocap pose k:         [ rotation( R_OP,k R~_k^T (I + d hat(w)) ),  t_OP,k - t~_k + d v ] / sigmas
    camera:               its prior from the intrinsics' covariance
    scale:                log s / its prior's sigma, s the board's size by the mocap over its stated size: x_B,m stands for s x_B,m above

Metres are the mocap's. That the board's square and the mocap's metre are both known to some parts in a thousand only is always in the
covariance, as s is solved for: with a board that is wrong (s x_B) the rotation and the position of H_PC are right; with a mocap whose
metre is wrong the data are the same, H_PC is right in the mocap's metres, in which H_OP comes too, and its position in true metres is
1/s of that. So no choice between the two is called for, and nothing but the unit of the position depends on it. With s held at 1 instead,
a wrong one moves the camera along its view of the board by up to (s - 1) times the board's distance, and turns it.

The clock's part is linear in d: `solve` relinearises. Source: the usual joint formulation of robot-world hand-eye calibration with
errors in both sensors, for example Koide & Menegatti, General hand-eye calibration based on reprojection error minimization (2019).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.least_squares import (
    POSE,
    Block,
    Model,
    Solution,
    SolverOptions,
    Term,
    compile_residual,
    matrix,
    prior,
    small_rotation,
    solve,
)

SCALE_SIGMA = 0.002
"""One standard deviation of the board's size by the mocap over its stated size, where the data show no more than that: a square measured
over many with a ruler, and a mocap's metre by its wand, are each right to a tenth or two of a percent."""
CAMERA_SIZE = 12
"""fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6."""


class PoseUnknown(StrEnum):
    """A block of parameters that is solved for."""

    H_PC = "H_PC"
    """(1, 4, 4)."""
    H_OB = "H_OB"
    """(1, 4, 4)."""
    H_OP = "H_OP"
    """(N, 4, 4), a view each."""
    CLOCK = "clock"
    """(1, 1) what the clock offset is off by, seconds."""
    SCALE = "scale"
    """(1, 1) log of the board's size by the mocap over its stated size."""
    CAMERA = "camera"
    """(1, 12) the camera's parameters, as `CAMERA_SIZE` names them."""


class Observed(StrEnum):
    """A kind of observations, a term each."""

    BOARD = "board"
    """Board poses, where there are no corners."""
    MOCAP = "mocap"
    """The body's measured poses."""
    CORNERS = "corners"
    """The board's corners in the images."""
    SCALE = "scale"
    """The prior of the board's size."""
    CAMERA = "camera"
    """The prior of the camera's parameters."""


PRIORS = (Observed.CAMERA, Observed.SCALE)
"""Kinds of terms that no view has a part in."""


@dataclass(frozen=True)
class Views:
    """What the solve is given, one row a view."""

    H_CB: Array
    """(N, 4, 4)."""
    H_OP: Array
    """(N, 4, 4) as measured, at the offset `offset_s`."""
    velocity: Array
    """(N, 6) of the measured pose, zero where there is no clock."""
    noise_class: npt.NDArray[np.intp]
    """(N,) views of one class share the mocap's sigmas: 0 moving or single samples, 1 dwells."""
    deflation: Array
    """(N,) factor on the mocap's variance for errors that neighbouring views share."""
    corners_px: Array | None = None
    """(N, M, 2), NaN where not seen; None: board poses alone."""
    points_B: Array | None = None
    """(M, 3)."""
    corner_scale: Array | None = None
    """(N, M) factor on the corners' sigma; None: 1."""
    pose_variance: Array | None = None
    """(N, 6) of each mocap pose, over that of the sigmas; None: 1."""
    inverse: bool = False
    """Whether `H_OP` is H_PO, of a board that the body carries: the mocap's errors are those of H_OP still."""

    @property
    def count(self) -> int:
        """Number of views."""
        return len(self.H_CB)

    def of(self, rows: npt.NDArray[Any]) -> Views:
        """Some of the views."""
        corners = None if self.corners_px is None else self.corners_px[rows]
        scale = None if self.corner_scale is None else self.corner_scale[rows]
        variance = None if self.pose_variance is None else self.pose_variance[rows]
        return Views(
            self.H_CB[rows],
            self.H_OP[rows],
            self.velocity[rows],
            self.noise_class[rows],
            self.deflation[rows],
            corners,
            self.points_B,
            scale,
            variance,
            self.inverse,
        )

    def mocap_sigmas(self, sigmas: Sigmas) -> Array:
        """One standard deviation (N, 6) of each view's mocap pose by itself."""
        usual = np.stack([np.array(sigmas.mocap_rad), np.array(sigmas.mocap_m)], axis=1)[self.noise_class]
        return np.repeat(usual, 3, axis=1) * (1.0 if self.pose_variance is None else np.sqrt(self.pose_variance))


@dataclass(frozen=True)
class CameraPrior:
    """The camera's parameters (12,), as `CAMERA_SIZE` names them, which may move, and their covariance (F, F) for those that may."""

    mean: Array
    free: npt.NDArray[np.bool_]
    covariance: Array


@dataclass(frozen=True)
class Sigmas:
    """One standard deviation of every kind of measurement."""

    px: float = 0.1
    board_rad: float = np.deg2rad(0.3)
    board_lateral_m: float = 2e-3
    board_depth_m: float = 4e-3
    mocap_rad: tuple[float, ...] = (np.deg2rad(0.075), np.deg2rad(0.075))
    """By noise class."""
    mocap_m: tuple[float, ...] = (2e-4, 2e-4)
    log_scale: float = SCALE_SIGMA
    """One standard deviation of the prior of the log of the board's size; wider where the data show more than chance, so that a board far
    off is not pulled back."""


@dataclass(frozen=True)
class HandEyeEstimate:
    """H_PC, H_OB, camera, offset, and the solution that they come from."""

    H_PC: Array
    H_OB: Array
    camera: Array
    d_offset_s: float
    scale: float
    """The board's size by the mocap over its stated size."""
    solution: Solution
    order: tuple[Observed, ...]
    """Kinds of the solution's terms: corners | board, mocap, camera, scale."""
    sigmas: Sigmas
    """Those that it was weighted by."""

    def term(self, kind: Observed) -> int:
        """Place of a kind of term; -1 where there is none."""
        return self.order.index(kind) if kind in self.order else -1

    def views_of(self, kind: Observed) -> npt.NDArray[np.intp]:
        """The view (K,) of each observation of a kind of term that is no prior."""
        term = self.solution.terms[self.term(kind)]
        return term.items(term.blocks.index(PoseUnknown.H_OP)) if PoseUnknown.H_OP in term.blocks else np.arange(term.count)

    def of_views(self, chosen: Mask) -> list[Mask]:
        """Which observations (K,) of each term belong to chosen views (N,)."""
        terms = zip(self.order, self.solution.terms, strict=True)
        return [np.zeros(term.count, dtype=bool) if kind in PRIORS else chosen[self.views_of(kind)] for kind, term in terms]

    def corner_residuals(self) -> tuple[Array, npt.NDArray[np.intp]]:
        """Residuals (K, 2) of the corners in pixels of the image, and the view (K,) of each; empty where there are no corners."""
        place = self.term(Observed.CORNERS)
        if place < 0:
            return np.zeros((0, 2)), np.zeros(0, dtype=np.intp)
        term = self.solution.terms[place]
        return self.solution.residuals[place] * np.sqrt(np.asarray(term.weight)) * self.sigmas.px, self.views_of(Observed.CORNERS)

    def in_mocap_metres(self, H_CB: Array) -> Array:
        """Board poses (N, 4, 4) at the board's size as found."""
        found = H_CB.copy()
        found[..., :3, 3] *= self.scale
        return found

    @property
    def scale_std(self) -> float:
        """One standard deviation of the scale."""
        return float(self.scale * np.sqrt(self.solution.covariance(PoseUnknown.SCALE)[0, 0]))

    def covariance(self) -> Array:
        """(13, 13) of H_PC, H_OB (left perturbations) and the offset."""
        return self.solution.covariance(PoseUnknown.H_PC, PoseUnknown.H_OB, PoseUnknown.CLOCK)


def estimate(
    views: Views,
    camera: CameraPrior | None,
    sigmas: Sigmas,
    start: HandEyeEstimate | tuple[Array, Array],
    *,
    clock: bool,
    options: SolverOptions | None = None,
) -> HandEyeEstimate:
    """Solve at given sigmas from a start, which is an earlier estimate or (H_PC, H_OB).

    Raises
    ------
    DegenerateError, ConvergenceError
        As `least_squares.solve`.
    """
    H_PC, H_OB = (start.H_PC, start.H_OB) if isinstance(start, HandEyeEstimate) else start
    earlier = start if isinstance(start, HandEyeEstimate) else None
    log_scale = Block(np.full((1, 1), 0.0 if earlier is None else np.log(earlier.scale)))
    blocks: dict[str, Block] = {
        PoseUnknown.H_PC: Block(H_PC[None]),
        PoseUnknown.H_OB: Block(H_OB[None]),
        PoseUnknown.CLOCK: Block(np.zeros((1, 1)), free=clock),
        PoseUnknown.SCALE: log_scale,
    }
    of_scale = prior(PoseUnknown.SCALE, log_scale, np.zeros(1), np.array([[sigmas.log_scale**2]]))
    if views.corners_px is None or camera is None:
        return _estimate(solve(blocks, [_board_term(views, sigmas), of_scale], options=options), (Observed.BOARD, Observed.SCALE), sigmas)
    same_views = earlier is not None and len(earlier.solution[PoseUnknown.H_OP]) == views.count
    blocks[PoseUnknown.H_OP] = Block(earlier.solution[PoseUnknown.H_OP] if earlier is not None and same_views else views.H_OP)
    blocks[PoseUnknown.CAMERA] = Block((camera.mean if earlier is None else earlier.camera)[None], free=camera.free[None])
    terms, order = [_mocap_term(views, sigmas), _corner_term(views, sigmas), of_scale], [Observed.MOCAP, Observed.CORNERS, Observed.SCALE]
    if camera.free.any():
        terms.append(_camera_prior(camera))
        order.append(Observed.CAMERA)
    return _estimate(solve(blocks, terms, eliminate=PoseUnknown.H_OP, options=options), tuple(order), sigmas)


def _estimate(found: Solution, order: tuple[Observed, ...], sigmas: Sigmas) -> HandEyeEstimate:
    camera = found[PoseUnknown.CAMERA][0] if PoseUnknown.CAMERA in found.blocks else np.zeros(CAMERA_SIZE)
    clock, scale = float(found[PoseUnknown.CLOCK][0, 0]), float(np.exp(found[PoseUnknown.SCALE][0, 0]))
    return HandEyeEstimate(found[PoseUnknown.H_PC][0], found[PoseUnknown.H_OB][0], camera, clock, scale, found, order, sigmas)


def _mocap_term(views: Views, sigmas: Sigmas) -> Term:
    weight = views.mocap_sigmas(sigmas) ** -2 / views.deflation[:, None]
    data = np.concatenate([views.H_OP.reshape(-1, 16), views.velocity], axis=1)
    return Term(
        _mocap_model_of_inverse() if views.inverse else _mocap_model(),
        (PoseUnknown.H_OP, PoseUnknown.CLOCK),
        (np.arange(views.count), 0),
        data,
        weight=weight,
    )


def _corner_term(views: Views, sigmas: Sigmas) -> Term:
    corners, points_B = np.asarray(views.corners_px), np.asarray(views.points_B)
    view, corner = np.nonzero(np.isfinite(corners).all(axis=2))
    data = np.concatenate([corners[view, corner], points_B[corner]], axis=1)
    scale = np.ones(len(view)) if views.corner_scale is None else views.corner_scale[view, corner]
    return Term(
        _corner_model(),
        (PoseUnknown.H_PC, PoseUnknown.H_OB, PoseUnknown.H_OP, PoseUnknown.CAMERA, PoseUnknown.SCALE),
        (0, 0, view, 0, 0),
        data,
        weight=np.repeat(scale[:, None] ** -2.0, 2, axis=1) / sigmas.px**2,
    )


def _board_term(views: Views, sigmas: Sigmas) -> Term:
    s = [sigmas.board_rad] * 3 + [sigmas.board_lateral_m] * 2 + [sigmas.board_depth_m]
    weight = np.array(s) ** -2.0 / views.deflation[:, None]
    data = np.concatenate([views.H_OP.reshape(-1, 16), views.velocity, views.H_CB.reshape(-1, 16)], axis=1)
    return Term(
        _board_model(), (PoseUnknown.H_PC, PoseUnknown.H_OB, PoseUnknown.CLOCK, PoseUnknown.SCALE), (0, 0, 0, 0), data, weight=weight
    )


def _camera_prior(camera: CameraPrior) -> Term:
    """The prior of the free parameters; those that are held get a unit variance that never acts."""
    covariance = np.eye(CAMERA_SIZE)
    covariance[np.ix_(camera.free, camera.free)] = camera.covariance
    return prior(PoseUnknown.CAMERA, Block(camera.mean[None]), camera.mean, covariance)


@cache
def _mocap_model() -> Model:
    import casadi as ca

    def residual(H_OP: Any, d: Any, data: Any) -> Any:
        H_seen, w, v = matrix(data[:16], 4, 4), data[16:19], data[19:22]
        R = H_OP[:3, :3] @ H_seen[:3, :3].T @ (ca.SX.eye(3) + ca.skew(w) * d)
        return ca.vertcat(small_rotation(R), H_OP[:3, 3] - H_seen[:3, 3] + v * d)

    return compile_residual(residual, (POSE, 1), 22)


@cache
def _mocap_model_of_inverse() -> Model:
    import casadi as ca

    def residual(H_PO: Any, d: Any, data: Any) -> Any:
        H_seen, w, v = matrix(data[:16], 4, 4), data[16:19], data[19:22]
        R_seen, t_seen = (ca.SX.eye(3) - ca.skew(w) * d) @ H_seen[:3, :3], H_seen[:3, 3] - v * d
        R_OP = H_PO[:3, :3].T
        return ca.vertcat(small_rotation(R_OP @ R_seen), R_seen.T @ t_seen - R_OP @ H_PO[:3, 3])

    return compile_residual(residual, (POSE, 1), 22)


@cache
def _board_model() -> Model:
    import casadi as ca

    def residual(H_PC: Any, H_OB: Any, d: Any, log_scale: Any, data: Any) -> Any:
        H_then, w, v, H_seen = matrix(data[:16], 4, 4), data[16:19], data[19:22], matrix(data[22:], 4, 4)
        R_OP, t_OP = (ca.SX.eye(3) - ca.skew(w) * d) @ H_then[:3, :3], H_then[:3, 3] - v * d
        R_OC, t_OC = R_OP @ H_PC[:3, :3], R_OP @ H_PC[:3, 3] + t_OP
        turn = R_OC.T @ H_OB[:3, :3] @ H_seen[:3, :3].T
        return ca.vertcat(small_rotation(turn), R_OC.T @ (H_OB[:3, 3] - t_OC) * ca.exp(-log_scale) - H_seen[:3, 3])

    return compile_residual(residual, (POSE, POSE, 1, 1), 38)


@cache
def _corner_model() -> Model:
    import casadi as ca

    def residual(H_PC: Any, H_OB: Any, H_OP: Any, camera: Any, log_scale: Any, data: Any) -> Any:
        x_O = H_OB[:3, :3] @ (ca.exp(log_scale) * data[2:]) + H_OB[:3, 3]
        x_P = H_OP[:3, :3].T @ (x_O - H_OP[:3, 3])
        x_C = H_PC[:3, :3].T @ (x_P - H_PC[:3, 3])
        x, y = x_C[0] / x_C[2], x_C[1] / x_C[2]
        k1, k2, p1, p2, k3, k4, k5, k6 = ca.vertsplit(camera[4:])
        r2 = x * x + y * y
        radial = (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)))
        x_d = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)
        y_d = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y
        return ca.vertcat(camera[0] * x_d + camera[2], camera[1] * y_d + camera[3]) - data[:2]

    return compile_residual(residual, (POSE, POSE, POSE, CAMERA_SIZE, 1), 5)


def misfit(views: Views, found: HandEyeEstimate) -> tuple[Array, Array]:
    """Angle (N,) and distance (N,) by which each view's board, seen through the measured panel pose, misses H_OB."""
    H_OB_k = views.H_OP @ found.H_PC @ found.in_mocap_metres(views.H_CB)
    return se3.angle_rad(H_OB_k[:, :3, :3] @ found.H_OB[:3, :3].T), np.linalg.norm(H_OB_k[:, :3, 3] - found.H_OB[:3, 3], axis=1)
