r"""The rigid transform between two sets of the same points, and how sure it is.

Symbols: points x_A,i = H_AB x_B,i + e_i, e_i of standard deviation sigma an axis; centroids c_A, c_B::

    R_AB = nearest rotation to sum (x_A,i - c_A)(x_B,i - c_B)^T,    t_AB = c_A - R_AB c_B
    covariance = sigma^2 (sum J_i^T J_i)^-1,    J_i = [-hat(x_A,i), I]    of the left perturbation

Source: Kabsch, A solution for the best rotation to relate two sets of vectors (1976).
"""

from __future__ import annotations

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask

FEWEST_POINTS = 3
LINE = 1e-3
"""Second extent of the points over the first, under which they count as lying on a line."""


def fit(points_A: Array, points_B: Array, sigma_m: float | None = None) -> tuple[Array, Array, Array]:
    """H_AB of points (N, 3) in A and in B.

    Parameters
    ----------
    points_A, points_B : row i is the same point
    sigma_m : one standard deviation of a coordinate of their difference; None: as the residuals show (7 coordinates or more)

    Returns
    -------
    H_AB (4, 4), its covariance (6, 6), and the residuals (N, 3) in A.

    Raises
    ------
    DegenerateError
        Fewer than three points, or all on a line.
    """
    if len(points_A) < FEWEST_POINTS:
        raise DegenerateError(f"{len(points_A)} points", needed=f"{FEWEST_POINTS}, not on one line")
    c_A, c_B = points_A.mean(axis=0), points_B.mean(axis=0)
    a, b = points_A - c_A, points_B - c_B
    extent = np.linalg.svd(b, compute_uv=False)
    if extent[1] < LINE * extent[0] or extent[0] == 0:
        raise DegenerateError("the points lie on one line", needed=f"{FEWEST_POINTS} that do not")
    R_AB = se3.nearest_rotation(a.T @ b)
    H_AB = se3.transform(R_AB, c_A - R_AB @ c_B)
    fitted_A = se3.apply(H_AB, points_B)
    residuals_A = points_A - fitted_A
    if sigma_m is None:
        sigma_m = float(np.sqrt(np.sum(residuals_A**2) / (3 * len(points_A) - 6)))
    J = se3.point_jacobian(fitted_A).reshape(-1, 6)
    return H_AB, sigma_m**2 * np.linalg.inv(J.T @ J), residuals_A


def fit_each(points_A: Array, points_B: Array, seen: Mask) -> tuple[Array, Array]:
    """H_AB (N, 4, 4) of N sets of the same points, and what remains of each point.

    Parameters
    ----------
    points_A : (N, M, 3), anything where not seen
    points_B : (M, 3)
    seen : (N, M); three at least, not on one line, or H_AB is meaningless

    Returns
    -------
    H_AB (N, 4, 4), and the residuals (N, M, 3) in A, zero where not seen.
    """
    weight = seen[..., None].astype(float)
    a, count = np.where(weight > 0, points_A, 0.0), np.maximum(weight.sum(axis=1, keepdims=True), 1)
    c_A, c_B = a.sum(axis=1, keepdims=True) / count, (weight * points_B).sum(axis=1, keepdims=True) / count
    R_AB = se3.nearest_rotation(np.swapaxes(weight * (a - c_A), 1, 2) @ (points_B - c_B))
    t_AB = c_A[:, 0] - (R_AB @ c_B[:, 0, :, None])[..., 0]
    fitted_A = points_B @ np.swapaxes(R_AB, 1, 2) + t_AB[:, None]
    return se3.transform(R_AB, t_AB), weight * (a - fitted_A)


def covariances(fitted_A: Array, seen: Mask, sigma_m: float) -> Array:
    """Covariance (N, 6, 6) of each H_AB of fitted points (N, M, 3), of which some were seen (N, M)."""
    J = se3.point_jacobian(fitted_A) * seen[..., None, None]
    return np.asarray(sigma_m**2 * np.linalg.inv(np.einsum("nmki,nmkj->nij", J, J)))
