r"""The distance of a piece from the edge of its shadow on the plane behind it; no intensities enter.

Symbols: plane ``q . y = 1`` (see surface.planes), light at S, point X of the piece; its shadow falls on ``y = S + t (X - S)`` with
``t = (1 - q.S) / (q.(X - S))``. The piece is scaled about the camera by s and the shadow that its pixels would throw is compared with
the one that is seen: ``cost(s) = mean abs(foretold - seen)`` over the plane's pixels and the lights. The side of a shadow away from its
light is thrown by parts that the camera sees. Source: shape from shadows, Savarese et al. 2007, Int. J. Computer Vision 71.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.records.calibration import Camera, Light
from lpcal.surface import planes
from lpcal.surface.sight import Sight

SCALES = np.linspace(0.955, 1.045, 31)
NEEDED_DROP = 0.10
"""Of the cost: less says nothing."""
FEWEST_EDGE_PIXELS = 150
STD = 0.004
"""Relative, of a distance that the shadow tells."""


@dataclass(frozen=True)
class Screen:
    """The plane behind the object as a screen for shadows, in coarse pixels."""

    plane: planes.Plane
    shade: Array
    """(L, H, W) how deep in shadow a pixel of the plane is, 0 lit to 1."""
    weight: Array
    """(L, H, W) 1 where this can be said, 0 elsewhere."""
    factor: int
    """Pixels a coarse pixel."""


def screen(seen: Sight, plane: planes.Plane, lights: Sequence[Light], object_mask: Mask, factor: int) -> Screen:
    """What the plane's pixels show; `seen` is the whole coarse image, `object_mask` (H, W) what is not plane in it."""
    m = planes.foretold(plane.q, seen.rays_C, lights)
    square, count = planes.misfit(seen, m)
    strong = (m > planes.WEAK * np.nanmax(m, axis=0)) & seen.usable & (seen.sigma < 0.2 * np.nanmax(seen.signal, axis=0))
    ratio = np.where(strong, seen.signal / np.maximum(m, 1e-9), -np.inf)
    albedo = np.sort(ratio, axis=0)[-2]
    shade = np.clip(1 - ratio / np.maximum(albedo, 1e-9), 0, 1)
    known = strong & (count >= 2) & (square < planes.TRUSTED**2) & ~object_mask.ravel()
    size = (len(m), *seen.mask.shape)
    return Screen(plane, np.where(known, shade, 0.0).reshape(size), known.astype(float).reshape(size), factor)


def anchored(shown: Screen, lights: Sequence[Light], camera: Camera, x_C: Array, label: Labels) -> dict[int, float]:
    """Scales by piece, where its shadow tells one; points x_C (P, 3) with their piece's label (P,)."""
    found: dict[int, float] = {}
    x_C = x_C.copy()
    for one in np.unique(label):
        inside = label == one
        rest = _foretold(shown, lights, camera, x_C[~inside])
        costs = np.array([_cost(shown, rest, _foretold(shown, lights, camera, scale * x_C[inside])) for scale in SCALES])
        scale, drop, edge = _lowest(costs, _cost(shown, rest, _foretold(shown, lights, camera, x_C[inside])), shown)
        if drop > NEEDED_DROP and edge:
            found[int(one)] = scale
            x_C[inside] *= scale
    return found


def _cost(shown: Screen, rest: Mask, own: Mask) -> float:
    return float(np.sum(shown.weight * np.abs((rest | own) - shown.shade)) / max(shown.weight.sum(), 1))


def _lowest(costs: Array, now: float, shown: Screen) -> tuple[float, float, bool]:
    """The scale of least cost by a parabola through its neighbours, the drop that it brings, and whether it lies inside the range."""
    k = int(np.argmin(costs))
    if k in {0, len(costs) - 1} or shown.shade.sum() < FEWEST_EDGE_PIXELS:
        return 1.0, 0.0, False
    left, middle, right = costs[k - 1 : k + 2]
    shift = 0.5 * (left - right) / max(left - 2 * middle + right, 1e-12)
    return float(SCALES[k] + np.clip(shift, -0.5, 0.5) * (SCALES[1] - SCALES[0])), 1 - float(middle) / max(now, 1e-12), True


def _foretold(shown: Screen, lights: Sequence[Light], camera: Camera, x_C: Array) -> Mask:
    """Shadows (L, H, W) of points x_C (P, 3) on the screen."""
    from scipy import ndimage

    shade = np.zeros(shown.shade.shape, bool)
    for k, light in enumerate(lights):
        if light.source_C is None or not len(x_C):
            continue
        along = x_C - light.source_C
        y_C = light.source_C + ((1 - shown.plane.q @ light.source_C) / (along @ shown.plane.q))[:, None] * along
        pixel = np.rint((camera.project(y_C) - (shown.factor - 1) / 2) / shown.factor)
        inside = (pixel >= 0).all(axis=1) & (pixel[:, 0] < shade.shape[2]) & (pixel[:, 1] < shade.shape[1]) & (y_C[:, 2] > 0)
        column, row = pixel[inside].astype(int).T
        shade[k, row, column] = True
        shade[k] = ndimage.binary_closing(shade[k])
    return shade
