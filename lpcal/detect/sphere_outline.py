r"""The outline of a sphere at sub-pixel, through perspective and lens distortion.

A closed curve (what the lens makes of the sphere's tangent cone, or a circle where there is no camera) is laid on the image; along
each of its normals the profile is matched to a model of the edge, s pixels outwards from the curve, edge at s0, blur sigma::

    chrome   c0 + [c1 + c2 t + c3 t^2] step(t) blurred                   t = s0 - s, inwards
    matte    c0 + c1 step(t) + c2 sqrt(1 - (1 - t / r)^2) blurred        r the radius in pixels: a limb darkens as its normals turn away

The coefficients are linear and projected out; s0 is searched on a grid for all rays at once and refined by a parabola. Where the outline
was found is fitted again, until it stays. Source: variable projection (Golub, Pereyra 1973); limb of a Lambertian sphere.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry import sphere
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Camera

RAYS = 360
REACH_PX = 6.0
STEP_PX = 0.1
SEARCH_PX = 2.5
COARSEST = 40
"""Places looked at on either side of the curve, at the most."""
BLURS_PX = (0.4, 2.5)
FIT_ROUNDS = 4
OUTLIER_MADS = 4.0
FEWEST_RAYS = 90


@dataclass(frozen=True)
class Curve:
    """How an outline is fitted to points and drawn: `fit` (K, 2) points to parameters, `draw` parameters to (RAYS, 2) points."""

    fit: Callable[[Array], Array]
    draw: Callable[[Array], Array]


@dataclass(frozen=True)
class Outline:
    """Points (K, 2) of an outline, the scatter of one point along its normal, and the circle nearest to it."""

    points_px: Array
    sigma_px: float
    centre_px: Array
    radius_px: float
    blur_px: float
    contrast: float
    """Median step at the edge in units of its noise."""


AROUND = np.linspace(0, 2 * np.pi, RAYS, endpoint=False)


def perspective_curve(camera: Camera, radius_m: float) -> Curve:
    """The tangent cone of a sphere through a lens; parameters are its centre in C."""

    def fit(points_px: Array) -> Array:
        try:
            return sphere.from_outline(camera.unproject(points_px), radius_m)
        except ValueError as error:
            raise DegenerateError(str(error)) from error

    return Curve(fit, lambda centre_C: camera.project(sphere.outline(centre_C, radius_m, AROUND)))


def circle_curve() -> Curve:
    """A circle; parameters are x, y, radius in pixels (Kasa's fit)."""

    def fit(points_px: Array) -> Array:
        A = np.column_stack([2 * points_px, np.ones(len(points_px))])
        x, y, c = np.linalg.lstsq(A, np.sum(points_px**2, axis=1), rcond=None)[0]
        return np.array([x, y, np.sqrt(max(c + x * x + y * y, 0.0))])

    return Curve(fit, lambda p: p[:2] + p[2] * np.stack([np.cos(AROUND), np.sin(AROUND)], axis=1))


def refine_outline(image: Image, kind: str, start_px: Array, curve: Curve) -> Outline:
    """Refine a circle start_px (x, y, radius) to the outline of a sphere in a linear image (H, W).

    Raises
    ------
    DegenerateError
        Fewer than a quarter of the rays find an edge: no outline there, cut by the frame, or out of focus.
    """
    from scipy.ndimage import spline_filter

    coefficients = spline_filter(image.astype(float), order=3, mode="mirror")
    parameters = curve.fit(start_px[:2] + start_px[2] * np.stack([np.cos(AROUND), np.sin(AROUND)], axis=1))
    search_px, good, moved, fits = max(SEARCH_PX, 0.06 * start_px[2]), np.ones(RAYS, dtype=bool), np.zeros(RAYS), None
    for round_ in range(FIT_ROUNDS):
        points, normals = _with_normals(curve.draw(parameters))
        radius = _circle(points)[2]
        fits = _match_edges(coefficients, image.shape, points, normals, kind, radius, search_px)
        good = fits.found & (np.abs(fits.offset_px) < 0.95 * search_px)
        moved = points + fits.offset_px[:, None] * normals
        for _ in range(5):
            if good.sum() < FEWEST_RAYS:
                raise DegenerateError(
                    f"only {good.sum()} of {RAYS} rays find an edge",
                    needed="a sharp outline, whole in the picture",
                    todo="give its place as hint: [x, y, radius]",
                )
            parameters = curve.fit(moved[good])
            distance = _distance(curve.draw(parameters), moved)
            spread = 1.4826 * np.median(np.abs(distance[good]))
            kept = fits.found & (np.abs(distance) < max(OUTLIER_MADS * spread, 0.05))
            if np.array_equal(kept, good):
                break
            good = kept
        search_px = SEARCH_PX if round_ else max(SEARCH_PX, search_px / 2)
    assert fits is not None
    x, y, r = _circle(moved[good])
    sigma = float(1.4826 * np.median(np.abs(distance[good])))
    return Outline(moved[good], max(sigma, 1e-3), np.array([x, y]), r, fits.blur_px, float(np.median(fits.contrast[good])))


@dataclass(frozen=True)
class _Edges:
    offset_px: Array
    found: Mask
    contrast: Array
    blur_px: float


def _match_edges(
    coefficients: Array, shape: tuple[int, ...], points: Array, normals: Array, kind: str, radius: float, search_px: float
) -> _Edges:
    """Where along its normal each ray's edge lies, under the one blur that fits most rays best."""
    from scipy.ndimage import map_coordinates
    from scipy.optimize import minimize_scalar

    reach = REACH_PX + search_px
    s = np.arange(-reach, reach + STEP_PX / 2, STEP_PX)
    at = points[:, None] + s[:, None] * normals[:, None]
    inside = np.all((at > 0) & (at < [shape[1] - 1, shape[0] - 1]), axis=(1, 2))
    profile = map_coordinates(coefficients, [at[..., 1], at[..., 0]], order=3, mode="mirror", prefilter=False)
    offsets = np.linspace(-search_px, search_px, int(2 * np.ceil(min(search_px / STEP_PX, COARSEST))) + 1)
    if not inside.any():
        return _Edges(np.zeros(len(points)), inside, np.zeros(len(points)), 0.0)

    def costs(blur: float) -> Array:
        return np.stack([_misfit(profile, s, offset, blur, kind, radius) for offset in offsets], axis=1)

    def total(log_blur: float) -> float:
        least = np.min(costs(float(np.exp(log_blur))), axis=1)[inside]
        return float(np.mean(np.sort(least)[: int(np.ceil(0.8 * least.size))]))

    blur = float(np.exp(minimize_scalar(total, bounds=tuple(np.log(BLURS_PX)), method="bounded", options={"xatol": 0.02}).x))
    cost = costs(blur)
    k = np.clip(np.argmin(cost, axis=1), 1, len(offsets) - 2)
    rows = np.arange(len(points))
    below, at_best, above = cost[rows, k - 1], cost[rows, k], cost[rows, k + 1]
    curvature = below - 2 * at_best + above
    shift = np.where(curvature > 0, 0.5 * (below - above) / np.where(curvature > 0, curvature, 1), 0.0)
    near = np.abs(s[None] - offsets[k][:, None]) <= REACH_PX
    noise = np.sqrt(np.maximum(at_best, 1e-300) / near.sum(axis=1))
    outer = np.where((s[None] > offsets[k][:, None] + 2) & near, profile, np.nan)
    inner = np.where((s[None] < offsets[k][:, None] - 2) & near, profile, np.nan)
    contrast = np.abs(np.nanmean(inner, axis=1) - np.nanmean(outer, axis=1)) / np.maximum(noise, 1e-12)
    return _Edges(offsets[k] + np.clip(shift, -1, 1) * (offsets[1] - offsets[0]), inside & (contrast > 4), contrast, blur)


def _misfit(profile: Array, s: Array, offset: float, blur: float, kind: str, radius: float) -> Array:
    """Squared misfit (K,) of the profiles to an edge at an offset, within the reach of it."""
    near = np.abs(s - offset) <= REACH_PX
    Q = np.linalg.qr(_edge_terms(s[near] - offset, blur, kind, radius))[0]
    part = profile[:, near]
    part = part - part.mean(axis=1, keepdims=True)  # numerically kinder; the constant is one of the terms
    return np.asarray(np.sum(part**2, axis=1) - np.sum((part @ Q) ** 2, axis=1))


def _edge_terms(s: Array, blur: float, kind: str, radius: float) -> Array:
    """Columns of the edge model at s pixels outwards of the edge, blurred."""
    fine = np.arange(s[0] - 5 * blur, s[-1] + 5 * blur + STEP_PX / 2, STEP_PX)
    t = -fine
    step = np.clip(t / STEP_PX + 0.5, 0.0, 1.0)
    inward = np.maximum(t, 0.0)
    if kind == "matte":
        terms = [step, np.sqrt(np.maximum(1 - (1 - np.minimum(inward / radius, 1.0)) ** 2, 0.0))]
    else:
        terms = [step, inward, inward**2]
    half = int(np.ceil(5 * blur / STEP_PX))
    kernel = np.exp(-0.5 * (np.arange(-half, half + 1) * STEP_PX / blur) ** 2)
    kernel /= kernel.sum()
    blurred = [np.interp(s, fine, np.convolve(np.pad(term, half, mode="edge"), kernel, mode="valid")) for term in terms]
    return np.stack([np.ones_like(s), *blurred], axis=1)


def _with_normals(points: Array) -> tuple[Array, Array]:
    """Points and outward unit normals (K, 2) of a closed curve."""
    tangent = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    outward = np.sign(np.sum(normal * (points - points.mean(axis=0)), axis=1, keepdims=True))
    return points, normal * outward


def _distance(curve_px: Array, points_px: Array) -> Array:
    """Signed distance (K,) of points to the nearest place of a closed curve, outwards positive."""
    from scipy.spatial import cKDTree

    points, normals = _with_normals(curve_px)
    nearest = cKDTree(points).query(points_px)[1]
    gap = points_px - points[nearest]
    tangent_gap = gap[:, 0] * -normals[nearest, 1] + gap[:, 1] * normals[nearest, 0]
    radius = _circle(points)[2]
    return np.asarray(np.sum(gap * normals[nearest], axis=1) + tangent_gap**2 / (2 * radius))


def _circle(points_px: Array) -> tuple[float, float, float]:
    x, y, r = circle_curve().fit(points_px)
    return float(x), float(y), float(r)
