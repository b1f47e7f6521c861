"""The intrinsics by lpcal's own adjustment, from a camera and poses known about: the board may have any of the shapes of `shape`.

What it adds to mrcal's solve: twist, cubic terms and unequal squares; with the same terms it finds the same. See `bundle`.
"""

from __future__ import annotations

import numpy as np

from lpcal.chain.k_camera.bundle import Adjusted, Bundle, Unknowns, adjust
from lpcal.chain.k_camera.problem import DISTORTIONS, CameraFit, CornerProblem, parameter_names, rms
from lpcal.chain.k_camera.shape import BOARDS, shape_terms
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera


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
