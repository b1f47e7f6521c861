"""The outline of a sphere at sub-pixel, through perspective and lens distortion.

A closed curve (what the lens makes of the sphere's tangent cone, or a circle where there is no camera) is laid on the image; along each
of its normals the edge is found (`edge_profile`), the curve is fitted to the edges, what lies off it (a rod, a stand, a shadow) is dropped,
and the whole is done again from there until it stays.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lpcal.detect.edge_profile import Edges, edge_scale, match_edges
from lpcal.errors import DegenerateError
from lpcal.geometry import sphere
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Camera

RAYS = 360
COARSE_SHARE = 0.06
"""A start may be off by this share of its radius."""
FIT_ROUNDS, SHARP_ROUNDS = 4, 2
TRIPLES = 500
"""Circles tried through three edges each: of a majority of 60 % one in five is."""
OUTLIER_MADS = 3.0
FEWEST_RAYS = 90


@dataclass(frozen=True)
class RimCurve:
    """How an outline is fitted to points and drawn: `fit` (K, 2) points to parameters, `draw` parameters to (RAYS, 2) points."""

    fit: Callable[[Array], Array]
    draw: Callable[[Array], Array]


@dataclass(frozen=True)
class Outline:
    """Points (K, 2) of an outline, the scatter of one point along its normal, and the circle nearest to it."""

    curve_px: Array
    """(RAYS, 2) as fitted, all round."""
    points_px: Array
    sigma_px: float
    centre_px: Array
    radius_px: float
    blur_px: float
    contrast: float
    """Median step at the edge in units of its noise."""

    @property
    def scale(self) -> float:
        """Large outlines are softer: lengths in pixels that are right for small ones grow by this."""
        return edge_scale(self.radius_px)


AROUND = np.linspace(0, 2 * np.pi, RAYS, endpoint=False)


def perspective_curve(camera: Camera, radius_m: float) -> RimCurve:
    """The tangent cone of a sphere through a lens; parameters are its centre in C."""

    def fit(points_px: Array) -> Array:
        try:
            return sphere.from_outline(camera.unproject(points_px), radius_m)
        except ValueError as error:
            raise DegenerateError(str(error)) from error

    return RimCurve(fit, lambda centre_C: camera.project(sphere.outline(centre_C, radius_m, AROUND)))


def circle_curve() -> RimCurve:
    """A circle; parameters are x, y, radius in pixels (Kasa's fit)."""

    def fit(points_px: Array) -> Array:
        A = np.column_stack([2 * points_px, np.ones(len(points_px))])
        x, y, c = np.linalg.lstsq(A, np.sum(points_px**2, axis=1), rcond=None)[0]
        return np.array([x, y, np.sqrt(max(c + x * x + y * y, 0.0))])

    return RimCurve(fit, lambda p: p[:2] + p[2] * np.stack([np.cos(AROUND), np.sin(AROUND)], axis=1))


def refine_outline(image: Image, kind: str, start_px: Array, curve: RimCurve) -> Outline:
    """Refine a circle start_px (x, y, radius) to the outline of a sphere in a linear image (H, W).

    Raises
    ------
    DegenerateError
        Fewer than a quarter of the rays find an edge: no outline there, cut by the frame, or out of focus.
    """
    from scipy.ndimage import spline_filter

    coefficients = spline_filter(image.astype(float), order=3, mode="mirror")
    parameters = curve.fit(start_px[:2] + start_px[2] * np.stack([np.cos(AROUND), np.sin(AROUND)], axis=1))
    search_px = COARSE_SHARE * start_px[2]
    for _round in range(FIT_ROUNDS):
        moved, fits = _edges(coefficients, kind, curve.draw(parameters), search_px)
        parameters, good, distance = _agreeing(curve, moved, fits.found, fits.found)
        search_px = 0.0
    return _outline(curve.draw(parameters), moved, good, distance, fits)


def on_sharp_edges(image: Image, outline: Outline, curve: RimCurve) -> Outline:
    """A chrome sphere's outline again, fitted to its sharp edges alone; as it was where they are too few.

    Where the rim mirrors what is as bright as what is behind it, there is no edge but where that fades: up to 2 px beside the rim.
    """
    from scipy.ndimage import spline_filter

    coefficients = spline_filter(image.astype(float), order=3, mode="mirror")
    drawn = outline.curve_px
    try:
        for _round in range(SHARP_ROUNDS):
            moved, fits = _edges(coefficients, "chrome", drawn, 0.0)
            parameters, good, distance = _agreeing(curve, moved, fits.sharp, _majority(fits))
            drawn = curve.draw(parameters)
    except DegenerateError:
        return outline
    return _outline(drawn, moved, good, distance, fits)


def _edges(coefficients: Array, kind: str, drawn: Array, search_px: float) -> tuple[Array, Edges]:
    """Where (RAYS, 2) the edges beside a drawn curve are."""
    points, normals = _with_normals(drawn)
    fits = match_edges(coefficients, points, normals, kind, _circle(points)[2], search_px)
    return points + fits.offset_px[:, None] * normals, fits


def _majority(fits: Edges) -> Mask:
    """The half of the sharp edges that lies nearest to one circle, by least median of squares (Rousseeuw 1984)."""
    waves = np.column_stack([np.ones(RAYS), np.cos(AROUND), np.sin(AROUND)])
    rows = np.flatnonzero(fits.sharp)
    if rows.size < FEWEST_RAYS:
        return fits.sharp
    three = np.random.default_rng(0).choice(rows, (TRIPLES, 3))
    tried = np.linalg.pinv(waves[three]) @ fits.offset_px[three][:, :, None]
    off = np.abs(fits.offset_px[rows] - (waves[rows] @ tried)[:, :, 0])
    median = np.median(off, axis=1)
    best = int(np.argmin(median))
    return np.isin(np.arange(RAYS), rows[off[best] <= median[best]])


def _agreeing(curve: RimCurve, moved: Array, found: Mask, first: Mask) -> tuple[Array, Mask, Array]:
    """The parameters of the curve through those points found that agree, from a first guess at which; which they are; all's distances."""
    good, kept = first, found
    for _ in range(5):
        if kept.sum() < FEWEST_RAYS:
            raise DegenerateError(
                f"only {kept.sum()} of {RAYS} rays find an edge",
                needed="a sharp outline, whole in the picture",
                todo="state its place as hint: [x px, y px, r px] in panel.yaml",
            )
        parameters = curve.fit(moved[good])
        distance = _distance(curve.draw(parameters), moved)
        spread = 1.4826 * np.median(np.abs(distance[good]))
        kept = found & (np.abs(distance) < max(OUTLIER_MADS * spread, 0.05))
        if np.array_equal(kept, good):
            break
        good = kept
    return parameters, good, distance


def _outline(drawn: Array, moved: Array, good: Mask, distance: Array, fits: Edges) -> Outline:
    x, y, r = _circle(moved[good])
    sigma = max(float(1.4826 * np.median(np.abs(distance[good]))), 1e-3)
    return Outline(drawn, moved[good], sigma, np.array([x, y]), r, fits.blur_px, float(np.median(fits.contrast[good])))


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
