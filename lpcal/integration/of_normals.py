r"""The surface of an external normal map by bilateral normal integration; normals alone do not determine the distance.

A pixel next to a discontinuity is smooth on one side only, which its weights find.

Symbols: u = log z (central) or z in pixels (parallel rays); neighbours a, b a distance h apart, along an axis of the image; t = -n . r::

    g_a = log((n_a . r_a) / (n_a . r_b))      the step that the normal of a predicts (parallel: -n_x / n_z), g_b likewise
    gap of pixel a towards b:   (t_a (u_b - u_a) / h)^2
    w_a = 1 / (1 + exp(-k (gap on the other side - gap towards b)))

so a pixel beside a jump relies on its other side. There are two phases. In the first each pixel uses its own normal::

    sum_ab  w_a t_a^2 (u_b - u_a - g_a)^2 + w_b t_b^2 (u_b - u_a - g_b)^2

which finds the jumps; in the second an edge has the weight ``sqrt(w_a w_b)`` (a jump is one for both its pixels) and the step of the mean
normal, which is second-order accurate on curved surfaces where a pixel's own step is not. Source of the weights: Cao, Santo, Shi, Okura and
Matsushita 2022, Bilateral normal integration, ECCV; the second phase is ours.
"""

from __future__ import annotations

import numpy as np

from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.integration import multigrid, pieces
from lpcal.integration.integrate import Grid, steps, system
from lpcal.records.calibration import Camera
from lpcal.records.figures import SurfaceFigures
from lpcal.records.surface import Component, Surface
from lpcal.view.constants import FEWEST_PIXELS, LEAST_COSINE, REGULARISATION
from lpcal.view.pixel_list import ray_map

UNKNOWN_DISTANCE = 0.5
"""Relative standard deviation stated for an unknown distance."""


def surface_of_normals(name: str, normals_C: Image, mask: Mask, camera: Camera | None, distance_m: float) -> Surface:
    """The surface of normals (H, W, 3) in C within a mask (H, W); its median depth is put at `distance_m`, or at 0 pixels without a camera.

    Raises
    ------
    DisagreementError
        The map is not of the camera's size.
    DegenerateError
        Too few pixels, or most normals look away from the camera.
    """
    check(name, mask, camera)
    rays_C = ray_map(mask.shape, camera)
    n = lambert.unit(normals_C[mask].astype(float))[0]
    away = float(np.mean(np.einsum("pi,pi->p", n, rays_C[mask]) >= 0))
    if away > 0.5:
        raise DegenerateError(
            f"{100 * away:.0f} % of the normals look away from the camera", where=name, needed="normals of what the camera sees"
        )
    grid = Grid.of(mask)
    u, weight = integrate_normals(grid, n, rays_C[mask], central=camera is not None)
    weight = pieces.without_slivers(grid, weight, mask)
    depth = u - np.median(u) if camera is None else distance_m * np.exp(u - np.median(u))
    label = pieces.pieces(grid, weight, mask)

    def as_map(values: Array) -> Image:
        found = np.full((*mask.shape, *values.shape[1:]), np.nan, np.float32)
        found[mask] = values
        return found

    unknown = np.full(len(n), np.nan)
    labels = np.zeros(mask.shape, np.uint8)
    labels[mask] = label
    return Surface(
        name=name,
        normals=as_map(n),
        depth=as_map(depth),
        albedo=as_map(np.ones(len(n))),
        mask=mask,
        normal_std_deg=as_map(unknown),
        depth_std=as_map(unknown),
        lights_used=np.zeros(mask.shape, np.uint8),
        component=labels,
        rays_C=rays_C,
        components=tuple(
            Component(int(one), int((label == one).sum()), float(depth[label == one].mean()), UNKNOWN_DISTANCE) for one in np.unique(label)
        ),
        figures=SurfaceFigures(pixels=len(n), normals_away_from_the_camera=round(away, 4)),
        breaks=pieces.break_map(grid, weight, mask),
    )


def check(name: str, mask: Mask, camera: Camera | None) -> None:
    """Refuse a map of another size than the camera's, or of too few pixels.

    Raises
    ------
    DisagreementError, DegenerateError
        It is one of the two.
    """
    height, width = mask.shape
    if camera is not None and (width, height) != tuple(camera.image_size):
        raise DisagreementError(
            f"normals of {width}x{height}",
            where=name,
            needed=f"{camera.image_size[0]}x{camera.image_size[1]}, the calibrated camera's size",
            todo="give the map of the whole image, or leave the calibration out",
        )
    if mask.sum() < FEWEST_PIXELS:
        raise DegenerateError(
            f"normals of {mask.sum()} pixels", where=name, needed=f"{FEWEST_PIXELS} at least", todo="check the map and the mask"
        )


ONE_SIDED_ROUNDS, ROUNDS = 12, 40
"""Number of rounds of the first phase, and largest number of the second."""
ONE_SIDED_K, K = 8.0, 16.0
"""Steepness k of the weights in the two phases: gaps of about an eighth and a sixteenth of a squared pixel take effect."""
PRECISION = 1e-3
"""Relative residual at which a solve ends, and relative change of the cost at which the rounds end."""


def integrate_normals(grid: Grid, normals: Array, rays_C: Array, *, central: bool) -> tuple[Array, Array]:
    """u (P,) about zero, and weights (edges,) from 0 at a jump to 1, of normals (P, 3) that face the camera along rays (P, 3)."""
    a, b, count = grid.a, grid.b, len(normals)
    middle = steps(grid, normals, rays_C, central=central).value
    step_a, step_b, pull_a, pull_b = _one_sided(grid, normals, rays_C, central=central)
    w_a, w_b = np.full(len(a), 0.5), np.full(len(a), 0.5)
    hold, origin, u = np.full(count, lambert.SINGULAR), np.zeros(count), np.zeros(count)
    before = np.inf
    for k in range(ONE_SIDED_ROUNDS + ROUNDS):
        first = k < ONE_SIDED_ROUNDS
        of_a, of_b = w_a * pull_a, w_b * pull_b
        weight = np.maximum(of_a + of_b if first else np.sqrt(w_a * w_b) * (pull_a + pull_b), REGULARISATION * (pull_a + pull_b))
        step = (of_a * step_a + of_b * step_b) / np.maximum(of_a + of_b, 1e-12) if first else middle
        A, right = system(grid, weight, step, hold, origin)
        u = multigrid.solve(A, right, u, precision=PRECISION)
        rise = (u[b] - u[a]) ** 2
        w_a, w_b = _weights(grid, pull_a * rise, pull_b * rise, ONE_SIDED_K if first else K, count)
        cost = float(np.sum(weight * (u[b] - u[a] - step) ** 2))
        if not first and abs(cost - before) < PRECISION * before:
            break
        before = cost
    return u, np.asarray(2 * np.sqrt(w_a * w_b))


def _one_sided(grid: Grid, normals: Array, rays_C: Array, *, central: bool) -> tuple[Array, Array, Array, Array]:
    """Steps (edges,) predicted by the normals of a and of b, and ``(t / h)^2`` of both."""
    n_a, n_b = normals[grid.a], normals[grid.b]
    if not central:
        t_a, t_b = np.maximum(-n_a[:, 2], LEAST_COSINE), np.maximum(-n_b[:, 2], LEAST_COSINE)
        along_a, along_b = (np.where(grid.horizontal, n[:, 0], n[:, 1]) for n in (n_a, n_b))
        return along_a / t_a, along_b / t_b, t_a**2, t_b**2
    r_a, r_b = rays_C[grid.a], rays_C[grid.b]
    own_a, own_b, across_a, across_b = (
        np.maximum(-np.einsum("ei,ei->e", n, r), LEAST_COSINE) for n, r in ((n_a, r_a), (n_b, r_b), (n_a, r_b), (n_b, r_a))
    )
    h = lambert.length(r_b - r_a)
    return np.log(own_a / across_a), np.log(across_b / own_b), (own_a / h) ** 2, (own_b / h) ** 2


def _weights(grid: Grid, gap_a: Array, gap_b: Array, k: float, count: int) -> tuple[Array, Array]:
    """w_a and w_b (edges,) from the gaps (edges,) of both pixels of an edge."""
    w_a, w_b = np.empty(len(gap_a)), np.empty(len(gap_a))
    for edges in (grid.horizontal, ~grid.horizontal):
        a, b = grid.a[edges], grid.b[edges]
        ahead, behind = np.zeros(count), np.zeros(count)
        ahead[a], behind[b] = gap_a[edges], gap_b[edges]
        leaning = (1 + np.tanh(k * (behind - ahead) / 2)) / 2
        w_a[edges], w_b[edges] = leaning[a], 1 - leaning[b]
    return w_a, w_b
