r"""Discontinuity-preserving integration of normals within a mask, anchored to each pixel's own distance from near light.

Symbols: u = log z (central) or z (parallel rays); neighbours a, b with the mean m of their normals::

    g_ab = log((m . r_a) / (m . r_b))                                   central: both rays meet one plane
    g_ab = -m_x / m_z  (columns),  -m_y / m_z  (rows)                   parallel

minimise  sum_ab w_ab ((u_b - u_a - g_ab) / s_ab)^2  +  sum_p H_p (u_p - h_p)^2

s_ab is the standard deviation of a step due to the normals' errors; H_p and h_p are the curvature and optimum of the pixel's own distance
(surface.distance). The weights ``w = (B / (B + e^2))^2``, with e the step's residual in standard deviations, are those of the Geman and
McClure loss, which charges B for a broken edge: C^2, by the scale C of all residuals, times the edge's own break cost, which is high where
the images show no contrast (surface.contrast). The own distances start with GRADUATION times their weight (graduated non-convexity), so
that jumps appear before the steps smooth them. Sources: Quéau, Durou and Aujol 2018, J. Math. Imaging and Vision 60 (perspective, masks);
Black and Rangarajan 1996, Int. J. Computer Vision 19 (weights, graduation).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.integration import multigrid
from lpcal.integration.multigrid import Matrix, Pyramid
from lpcal.kernels.library import kernel
from lpcal.view.constants import LEAST_COSINE, OUTLIER, REGULARISATION
from lpcal.view.pixel_list import Indices

GRADUATION = (1000.0, 300.0, 100.0, 30.0, 10.0, 3.0, 1.0, 1.0)
AGAIN = GRADUATION[2::2]
"""The graduation used when a depth is already known."""
NORMAL_ERROR_RAD = 0.035
UNEVEN = 0.2
"""Standard deviation of a step, as a share of the difference between the steps that the two normals of an edge predict."""
SPREAD = 2 * OUTLIER
"""Lower bound of C, in medians of the absolute residuals."""


@dataclass(frozen=True)
class Grid:
    """The 4-neighbour graph of a mask's pixels; the edges to the right come first, then those downwards."""

    a: Indices
    b: Indices
    horizontal: Mask
    rows: Indices
    columns: Indices
    pyramid: Pyramid

    @staticmethod
    def of(mask: Mask) -> Grid:
        """The grid of a mask (H, W)."""
        number = np.full(mask.shape, -1, np.int64)
        number[mask] = np.arange(mask.sum())
        across, down = mask[:, :-1] & mask[:, 1:], mask[:-1] & mask[1:]
        a = np.concatenate([number[:, :-1][across], number[:-1][down]])
        b = np.concatenate([number[:, 1:][across], number[1:][down]])
        rows, columns = (index.astype(np.int64) for index in np.nonzero(mask))
        return Grid(a, b, np.arange(len(a)) < across.sum(), rows, columns, Pyramid.of(rows, columns))


@dataclass(frozen=True)
class Own:
    """Each pixel's own estimate of u from near light: curvature (inverse variance) H (P,) and optimum h (P,)."""

    curvature: Array
    optimum: Array


@dataclass(frozen=True)
class Steps:
    """Steps of u along the edges of a grid."""

    value: Array
    """g (edges,)."""
    sigma: Array
    """s (edges,), standard deviation of g."""
    break_cost: Array
    """(edges,) cost of a break, in C^2."""

    def residual(self, grid: Grid, u: Array) -> Array:
        """Differences (edges,) of u (P,) minus their steps."""
        return np.asarray(u[grid.b] - u[grid.a] - self.value)


def steps(
    grid: Grid, normals: Array, rays_C: Array, *, central: bool, tilt_rad: Array | None = None, break_cost: Array | None = None
) -> Steps:
    """Steps from normals (P, 3) of standard deviation NORMAL_ERROR_RAD, plus `tilt_rad` (P,) if given; breaks cost C^2 if not given.

    With a camera the sigma also contains UNEVEN times the difference of the two normals' steps: a step is uncertain where the surface
    bends, and at the rim of an occluding part.
    """
    break_cost = np.ones(len(grid.a)) if break_cost is None else break_cost
    if central and (run := kernel("steps")):
        found = np.empty(len(grid.a)), np.empty(len(grid.a))
        tilt2 = np.zeros(len(normals)) if tilt_rad is None else np.ascontiguousarray(tilt_rad**2, float)
        given = (np.ascontiguousarray(one, float) for one in (normals, rays_C))
        run(len(grid.a), len(normals), grid.a, grid.b, *given, tilt2, NORMAL_ERROR_RAD, UNEVEN, LEAST_COSINE, *found)
        return Steps(*found, break_cost)
    mean = normals[grid.a] + normals[grid.b]
    mean /= np.maximum(lambert.length(mean)[..., None], 1e-12)
    error = np.full(len(grid.a), NORMAL_ERROR_RAD)
    if tilt_rad is not None:
        error = np.sqrt(error**2 + (tilt_rad[grid.a] ** 2 + tilt_rad[grid.b] ** 2) / 2)
    if not central:
        slope = np.minimum(mean[:, 2], -LEAST_COSINE)
        return Steps(-np.where(grid.horizontal, mean[:, 0], mean[:, 1]) / slope, error / slope**2, break_cost)
    r_a, r_b = rays_C[grid.a], rays_C[grid.b]
    off = UNEVEN * (_own_step(normals[grid.a], r_a, r_b) - _own_step(normals[grid.b], r_a, r_b))
    towards_a = np.minimum(np.einsum("ei,ei->e", mean, r_a), -LEAST_COSINE)
    towards_b = np.minimum(np.einsum("ei,ei->e", mean, r_b), -LEAST_COSINE)
    sigma = np.hypot(off, error * lambert.length(r_b - r_a) / (towards_a * towards_b))
    return Steps(np.log(towards_a / towards_b), sigma, break_cost)


def _own_step(n: Array, r_a: Array, r_b: Array) -> Array:
    """Step (edges,) of log depth from ray a to ray b on planes of normals n (edges, 3)."""
    return np.asarray(np.log(np.minimum(lambert.dot(n, r_a), -LEAST_COSINE) / np.minimum(lambert.dot(n, r_b), -LEAST_COSINE)))


def integrate(grid: Grid, step: Steps, own: Own, start: Array, *, graduated: bool) -> tuple[Array, Array]:
    """Integrate: u (P,) and the final weights w (edges,); edges of low weight are depth discontinuities."""
    strengths = GRADUATION if graduated else AGAIN
    if run := kernel("integrated"):
        return _integrated(run, grid, step, own, start, strengths, fresh=graduated)
    u = start
    weight = np.ones(len(grid.a)) if graduated else weights_of(grid, u, step)
    for strength in strengths:
        A, right = system(grid, weight / step.sigma**2, step.value, own.curvature * strength, own.optimum)
        u = multigrid.solve(A, right, u)
        weight = weights_of(grid, u, step)
    return u, weight


def _integrated(
    run: Callable[..., None], grid: Grid, step: Steps, own: Own, start: Array, strengths: Sequence[float], *, fresh: bool
) -> tuple[Array, Array]:
    """`integrate` by its kernel."""
    finest, (sizes, cells, stretches) = grid.pyramid.levels[0], grid.pyramid.laid_out
    by_pixel = [np.stack(finest.by_pixel(one)) for one in (step.value, step.sigma, step.break_cost)]
    u, weight = np.array(start, float), np.empty_like(by_pixel[0])
    work_space = grid.pyramid.work_space(7)
    given = (np.ascontiguousarray(one, float) for one in (*by_pixel, own.curvature, own.optimum))
    robustly = (multigrid.PRECISION, OUTLIER, SPREAD, REGULARISATION)
    levels, way = (len(sizes), sizes, cells, stretches), (multigrid.MOST, grid.pyramid.way)
    run(*levels, *given, fresh, len(strengths), np.array(strengths), *robustly, u, weight, *work_space, *way)
    first = finest.to_the_right
    return u, np.concatenate([weight[0, grid.a[:first]], weight[1, grid.a[first:]]])


def settle(grid: Grid, step: Steps, own: Own, start: Array, weight: Array) -> Array:
    """u (P,) for fixed weights (edges,).

    At the minimum ``sum_p H_p (u_p - h_p) = 0``, since steps do not constrain a common offset; where H is tiny the iterative solver meets
    this only within its precision, so it is enforced at the end.
    """
    A, right = system(grid, weight / step.sigma**2, step.value, own.curvature, own.optimum)
    u = multigrid.solve(A, right, start)
    if own.curvature.max() > REGULARISATION:
        return u
    return np.asarray(u + np.average(own.optimum - u, weights=own.curvature))


def weights_of(grid: Grid, u: Array, step: Steps) -> Array:
    """Weight (edges,) of each edge from the residual of its step."""
    residual = step.residual(grid, u) / step.sigma
    most = scale_of(residual) ** 2 * step.break_cost
    return np.asarray((most / (most + residual**2)) ** 2 + REGULARISATION)


def scale_of(residual: Array) -> float:
    """C from the steps' residuals (edges,) in standard deviations."""
    return max(OUTLIER, SPREAD * float(np.median(np.abs(residual))))


def system(grid: Grid, weight: Array, step: Array, curvature: Array, optimum: Array) -> tuple[Matrix, Array]:
    """Matrix and right-hand side of the normal equations."""
    pull, count = weight * step, len(curvature)
    right = curvature * optimum + np.bincount(grid.b, pull, count) - np.bincount(grid.a, pull, count)
    return Matrix(grid.pyramid, curvature, weight), right


def normals_of(grid: Grid, points_C: Array, whole: Mask) -> Array:
    """Normals (P, 3) of points (P, 3), facing the camera; NaN where a slope along rows or columns is missing.

    They are cross products of the slopes along rows and columns, over the unbroken edges `whole` (edges,).
    """
    count = len(points_C)
    slopes = []
    for edges in (grid.horizontal & whole, ~grid.horizontal & whole):
        a, b = grid.a[edges], grid.b[edges]
        chord = points_C[b] - points_C[a]
        number = np.bincount(a, minlength=count) + np.bincount(b, minlength=count)
        total = np.stack([np.bincount(a, column, count) + np.bincount(b, column, count) for column in chord.T], axis=1)
        slopes.append(np.where(number[:, None] > 0, total / np.maximum(number, 1)[:, None], np.nan))
    normal = -np.cross(slopes[0], slopes[1])
    return np.asarray(normal / lambert.length(normal)[..., None])
