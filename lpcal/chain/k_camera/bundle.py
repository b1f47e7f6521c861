"""Bundle adjustment of one camera and a printed board, in numpy: lens, poses and the board's shape at once.

Symbols: corner m of view k, residual ``r_km = q_km - project(H_CB[k] (x_B,m + sum_j w_j f_jm))`` with the fields f of `shape`;
shared unknowns s (lens, then w), poses by left perturbation xi_k. With A = dr/ds, B_k = dr/dxi_k::

    (sum A'A - sum A'B_k (B_k'B_k)^-1 B_k'A) ds = -(...)          poses eliminated (Schur)
    covariance of s = sigma^2 times the inverse of that matrix

Coefficients of rational lenses have a weak prior about 0, without which ordinary lenses get absurd ones; so have the board's terms.
Corners further off than four sigmas are rejected until none is. Source: Triggs et al. 2000, Bundle adjustment: a modern synthesis.

The intrinsics by lpcal's own adjustment, from a camera and poses known about: the board may have any of the shapes of `shape`.

What it adds to mrcal's solve: twist, cubic terms and unequal squares; with the same terms it finds the same. See `bundle`.

The intrinsics without mrcal: OpenCV's closed form and first adjustment as the start, then lpcal's own bundle adjustment.

What is missing against mrcal: splined lenses, and the optimisation inputs in camera.cameramodel. Source: Zhang 2000; see `bundle`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lpcal.chain.k_camera.problem import DISTORTIONS, ROUNDS, CameraFit, CornerProblem, fitting, parameter_names, rms, scatter
from lpcal.chain.k_camera.shape import BOARDS, ShapeTerms, shape_terms
from lpcal.errors import ConvergenceError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.camera import project, projection_jacobian
from lpcal.records.calibration import Camera

STEPS = 60
PRECISION = 1e-7
"""Relative fall of the cost that ends the search."""
PRIOR_COEFFICIENT = 1.0
"""One standard deviation of k3 to k6, in units in which a corner's is PRIOR_PX."""
PRIOR_PX = 0.1
EMPTY = 1e-9
"""Holds the pose of a view all of whose corners were rejected."""


@dataclass(frozen=True)
class Unknowns:
    """The state: K and distortion, poses, and the numbers (J,) of the board's terms."""

    K: Array
    distortion: Array
    H_CB: Array
    shape: Array

    def moved(self, shared: Array, poses: Array, free_lens: bool) -> Unknowns:
        """After a step of the shared unknowns and of the poses (N, 6)."""
        K, distortion = self.K.copy(), self.distortion.copy()
        if free_lens:
            K[0, 0] += shared[0]
            K[1, 1] += shared[1]
            K[0, 2] += shared[2]
            K[1, 2] += shared[3]
            distortion += shared[4 : 4 + distortion.size]
        return Unknowns(K, distortion, se3.exp(poses) @ self.H_CB, self.shape + shared[shared.size - self.shape.size :])


@dataclass(frozen=True)
class Adjusted:
    """The state found, what was rejected, and the covariance of the shared unknowns for corners of unit sigma."""

    state: Unknowns
    inlier: Mask
    residual_px: Array
    covariance: Array
    sigma_px: float


@dataclass(frozen=True)
class Bundle:
    """A problem: corners (N, M, 2) NaN where not seen, points_B (M, 3) of the flat board, the terms of its shape, and what is free."""

    corners_px: Array
    points_B: Array
    terms: ShapeTerms
    free_lens: bool
    sigma_px: float = PRIOR_PX
    """About what a corner scatters by: the scale on which the priors count."""

    def shaped(self, state: Unknowns) -> Array:
        """points_B (M, 3) with the board's shape."""
        return np.asarray(self.points_B + np.tensordot(state.shape, self.terms.fields, axes=1))

    def residual(self, state: Unknowns) -> Array:
        """(N, M, 2), NaN where not seen."""
        return np.asarray(self.corners_px - project(se3.apply(state.H_CB, self.shaped(state)), state.K, state.distortion))

    def jacobians(self, state: Unknowns) -> tuple[Array, Array]:
        """Derivatives of the projection by the shared unknowns (N, M, 2, S) and by the poses (N, M, 2, 6)."""
        x_C = se3.apply(state.H_CB, self.shaped(state))
        J_x = projection_jacobian(x_C, state.K, state.distortion)
        poses = J_x @ se3.point_jacobian(x_C)
        shared = [lens_jacobian(x_C, state.K, state.distortion)] if self.free_lens else []
        if len(self.terms.names):
            J_B = J_x @ state.H_CB[:, None, :3, :3]
            shared.append(J_B @ np.moveaxis(self.terms.fields, 0, -1)[None])
        return np.concatenate(shared, axis=-1) if shared else np.zeros((*x_C.shape[:2], 2, 0)), poses


def adjust(bundle: Bundle, start: Unknowns, *, reject: bool = True) -> Adjusted:
    """Solve, reject, solve again, until no more corners are rejected.

    Raises
    ------
    ConvergenceError
        The state runs away.
    """
    seen = np.isfinite(bundle.corners_px).all(axis=-1)
    inlier, state = seen.copy(), start
    for _ in range(ROUNDS):
        state, covariance = _solve(bundle, state, inlier)
        residual_px = bundle.residual(state)
        sigma_px = scatter(residual_px, inlier, 6 * len(inlier) + len(covariance))
        if not np.isfinite(sigma_px):
            raise ConvergenceError("the adjustment of the camera runs away", todo="look at the corners found")
        kept = fitting(residual_px, sigma_px)
        if not reject or np.array_equal(kept, inlier):
            break
        inlier = kept
        bundle = replace(bundle, sigma_px=sigma_px)
    return Adjusted(state, inlier, residual_px, covariance, sigma_px)


def lens_jacobian(x_C: Array, K: Array, distortion: Array) -> Array:
    """Derivative (..., 2, 4 + D) of the projection by fx, fy, cx, cy and the D coefficients."""
    x, y = x_C[..., 0] / x_C[..., 2], x_C[..., 1] / x_C[..., 2]
    k1, k2, _, _, k3, k4, k5, k6 = np.concatenate([distortion, np.zeros(8 - distortion.size)])
    r2 = x * x + y * y
    below = 1 + r2 * (k4 + r2 * (k5 + r2 * k6))
    radial = (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / below
    plane_d = project(x_C, np.eye(3), distortion)
    J = np.zeros((*x.shape, 2, 12))
    J[..., 0, 0], J[..., 1, 1] = plane_d[..., 0], plane_d[..., 1]
    J[..., 0, 2] = J[..., 1, 3] = 1.0
    for column, factor in ((4, r2), (5, r2**2), (8, r2**3), (9, -radial * r2), (10, -radial * r2**2), (11, -radial * r2**3)):
        J[..., 0, column], J[..., 1, column] = K[0, 0] * x * factor / below, K[1, 1] * y * factor / below
    J[..., 0, 6], J[..., 1, 6] = K[0, 0] * 2 * x * y, K[1, 1] * (r2 + 2 * y * y)
    J[..., 0, 7], J[..., 1, 7] = K[0, 0] * (r2 + 2 * x * x), K[1, 1] * 2 * x * y
    return np.asarray(J[..., : 4 + distortion.size])


def _solve(bundle: Bundle, state: Unknowns, inlier: Mask) -> tuple[Unknowns, Array]:
    """Levenberg-Marquardt with the poses eliminated; the state and the covariance of the shared unknowns for unit sigma."""
    damping, cost = 1e-4, _cost(bundle, state, inlier)
    system = _normal(bundle, state, inlier)
    for _ in range(STEPS):
        shared, poses = _step(system, damping)
        trial = state.moved(shared, poses, bundle.free_lens)
        lower = _cost(bundle, trial, inlier)
        if lower < cost:
            fall, state, cost, damping = (cost - lower) / max(cost, 1e-300), trial, lower, damping * 0.1
            system = _normal(bundle, state, inlier)
            if fall < PRECISION:
                break
        else:
            damping *= 10
            if damping > 1e10:
                break
    return state, _covariance(system)


type _System = tuple[Array, Array, Array, Array, Array]


def _normal(bundle: Bundle, state: Unknowns, inlier: Mask) -> _System:
    """Normal matrices of shared (S, S), coupling (N, S, 6), poses (N, 6, 6), and right sides (S,), (N, 6); the prior counts."""
    A, B = bundle.jacobians(state)
    r = np.nan_to_num(bundle.residual(state)) * inlier[..., None]
    A, B = A * inlier[..., None, None], B * inlier[..., None, None]
    count = len(r)
    A, B, r = A.reshape(count, -1, A.shape[-1]), B.reshape(count, -1, 6), r.reshape(count, -1)
    At, Bt = np.swapaxes(A, 1, 2), np.swapaxes(B, 1, 2)
    shared, right = (At @ A).sum(axis=0), (At @ r[..., None]).sum(axis=0)[:, 0]
    weight, value = _prior(bundle, state)
    poses = Bt @ B + EMPTY * np.eye(6)
    return shared + np.diag(weight), At @ B, poses, right - weight * value, (Bt @ r[..., None])[..., 0]


def _prior(bundle: Bundle, state: Unknowns) -> tuple[Array, Array]:
    """Weight and value (S,) of the priors on the coefficients k3 to k6 and on the board's terms."""
    lens = np.concatenate([np.zeros(8), state.distortion[4:]]) if bundle.free_lens else np.zeros(0)
    weight = np.zeros(lens.size)
    weight[8:] = (PRIOR_PX / PRIOR_COEFFICIENT) ** 2
    return np.concatenate([weight, (bundle.sigma_px / bundle.terms.prior) ** 2]), np.concatenate([lens, state.shape])


def _cost(bundle: Bundle, state: Unknowns, inlier: Mask) -> float:
    if np.any(se3.apply(state.H_CB, bundle.points_B)[..., 2] <= 0) or state.K[0, 0] <= 0 or state.K[1, 1] <= 0:
        return np.inf
    weight, value = _prior(bundle, state)
    cost = float(np.sum(bundle.residual(state)[inlier] ** 2) + np.sum(weight * value**2))
    return cost if np.isfinite(cost) else np.inf


def _step(system: _System, damping: float) -> tuple[Array, Array]:
    shared, coupling, poses, right_s, right_p = system
    shared = shared + damping * np.diag(np.diag(shared))
    poses = poses + damping * poses * np.eye(6)
    solved = np.linalg.solve(poses, np.concatenate([np.swapaxes(coupling, 1, 2), right_p[..., None]], axis=-1))
    reduced = shared - (coupling @ solved[..., :-1]).sum(axis=0)
    step = np.linalg.solve(reduced, right_s - (coupling @ solved[..., -1:]).sum(axis=0)[:, 0])
    return step, solved[..., -1] - solved[..., :-1] @ step


def _covariance(system: _System) -> Array:
    """Covariance of the shared unknowns; the prior counts as knowledge."""
    shared, coupling, poses, _, _ = system
    reduced = shared - (coupling @ np.linalg.solve(poses, np.swapaxes(coupling, 1, 2))).sum(axis=0)
    scale = 1 / np.sqrt(np.diag(reduced))
    return np.asarray(np.linalg.pinv(reduced * scale[:, None] * scale, hermitian=True) * scale[:, None] * scale)


def view_information(bundle: Bundle, state: Unknowns, inlier: Mask) -> tuple[Array, Array]:
    """What each view knows of the shared unknowns (N, S, S), its pose eliminated, and the weights (S,) of the priors; for unit sigma."""
    A, B = bundle.jacobians(state)
    A, B = (J * inlier[..., None, None] for J in (A, B))
    A, B = A.reshape(len(A), -1, A.shape[-1]), B.reshape(len(B), -1, 6)
    coupling = np.swapaxes(A, 1, 2) @ B
    poses = np.swapaxes(B, 1, 2) @ B + EMPTY * np.eye(6)
    own = np.swapaxes(A, 1, 2) @ A - coupling @ np.linalg.solve(poses, np.swapaxes(coupling, 1, 2))
    return np.asarray(own), _prior(bundle, state)[0]


def refit(problem: CornerProblem, model: str, board: str) -> CameraFit:
    """Intrinsics, poses and the board's shape from ``problem.camera`` and ``problem.H_CB``.

    Raises
    ------
    ConvergenceError
        The adjustment runs away.
    """
    assert problem.camera is not None
    assert problem.H_CB is not None
    terms = shape_terms(problem.board, board)
    distortion = np.zeros(DISTORTIONS[model])
    known = problem.camera.distortion[: distortion.size]
    distortion[: known.size] = known
    bundle = Bundle(problem.corners_px, problem.board.points_B(), terms, free_lens=True)
    found = adjust(bundle, Unknowns(problem.camera.K, distortion, problem.H_CB, np.zeros(len(terms.names))))
    return _fit(problem, model, board, bundle, found)


def find_shape(problem: CornerProblem, camera: Camera, H_CB: Array) -> Array:
    """Points_B (M, 3) with the shape that fits best where the lens is given; poses H_CB (N, 4, 4) to start from."""
    terms = shape_terms(problem.board, BOARDS[2])
    bundle = Bundle(problem.corners_px, problem.board.points_B(), terms, free_lens=False)
    return bundle.shaped(adjust(bundle, Unknowns(camera.K, camera.distortion, H_CB, np.zeros(len(terms.names)))).state)


def _fit(problem: CornerProblem, model: str, board: str, bundle: Bundle, found: Adjusted) -> CameraFit:
    state, count = found.state, 4 + found.state.distortion.size
    camera = Camera(
        problem.image_size,
        model,
        state.K,
        state.distortion,
        rms_px=rms(found.residual_px, found.inlier),
        parameters=parameter_names(model),
        covariance=found.sigma_px**2 * found.covariance[:count, :count],
    )
    sigma = found.sigma_px * np.sqrt(np.diag(found.covariance)[count:])
    shape = {name: (float(value), float(one)) for name, value, one in zip(bundle.terms.names, state.shape, sigma, strict=True)}
    return CameraFit(camera, state.H_CB, bundle.shaped(state), found.inlier, found.residual_px, found.sigma_px, board, shape)


def solve_from_opencv(problem: CornerProblem, model: str, board: str) -> CameraFit:
    """Intrinsics, poses and the board's shape.

    Raises
    ------
    ConvergenceError
        OpenCV finds no start, or the adjustment runs away.
    """
    known = problem if problem.H_CB is not None else _started(problem)
    return refit(known, model, board)


def _started(problem: CornerProblem) -> CornerProblem:
    """The problem with a camera and poses to start from."""
    import cv2

    points_B = problem.board.points_B().astype(np.float32)
    seen = np.isfinite(problem.corners_px).all(axis=-1)
    corners = [view[mask].astype(np.float32).reshape(-1, 1, 2) for view, mask in zip(problem.corners_px, seen, strict=True)]
    flags = cv2.CALIB_FIX_K3
    try:
        _, K, distortion, phi, t = cv2.calibrateCamera(
            [points_B[mask] for mask in seen], corners, problem.image_size, None, None, flags=flags
        )
    except cv2.error as error:
        raise ConvergenceError(
            "OpenCV finds no start for the intrinsics", needed="views of different tilts", todo="take more images of the board, tilted"
        ) from error
    H_CB = se3.transform(se3.rotation(np.array(phi).reshape(-1, 3)), np.array(t).reshape(-1, 3))
    camera = Camera(problem.image_size, "opencv4", np.asarray(K, dtype=float), np.ravel(distortion)[:4].astype(float))
    return replace(problem, camera=camera, H_CB=H_CB)
