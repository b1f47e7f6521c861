r"""The distance of a piece from the edge of its shadow on the plane behind it; no intensities enter.

Symbols: plane ``q . y = 1`` (see segmentation.planes), point X of the piece, d the direction to the light there; its shadow falls on
``y = X - t d`` with ``t = (q.X - 1) / (q.d)``. The piece is scaled about the camera by s and the shadow that its pixels would throw is
compared with the one that is seen, over the plane's pixels and the lights: ``cost(s) = sum(predicted and lit) + sum(dark, not
predicted, beyond)``. Only the side of a shadow away from its object is cast by parts that the camera sees; what is dark on the near side
of a predicted shadow may be cast by what the camera does not see, and says nothing.

The shadow is no better than the plane, and near light placed that, often by the tails of the lobes: its misfit counts as doubt. An error of
the lights' intensities moves plane and piece alike, which no shadow shows; so the shadow corrects only what the model lacks at the piece
(gloss, parts hidden from each other). It is used where the piece is more uncertain than the plane, and the two are combined by inverse
variance. Source: shape from shadows, Savarese et al. 2007, Int. J. Computer Vision 71.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.records.calibration import Camera, Light
from lpcal.records.figures import Anchor
from lpcal.segmentation import planes
from lpcal.view.agreed import MANY_PIXELS
from lpcal.view.sight import Sight, second

SCALES = np.linspace(0.955, 1.045, 31)
RIM = 4
NEEDED_RISE = 0.3
"""Pixels that disagree more, RIM scales to either side of the best one, by the root of the dark area: a shallower valley says nothing."""
EDGE_STD, PLANE_STD = 0.0107, 0.0213
"""Relative standard deviation of a distance by a shadow: by its edge, and by a plane of misfit 1; on simulated scenes."""


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
    m = planes.predicted(plane.q, seen.rays_C, lights)
    square, count = planes.misfit(seen, m)
    strong = (m > planes.WEAK * np.fmax.reduce(m, axis=0)) & seen.usable & (seen.sigma < 0.2 * np.fmax.reduce(seen.signal, axis=0))
    ratio = np.where(strong, seen.signal / np.maximum(m, 1e-9), -np.inf)
    albedo = second(ratio)
    shade = np.clip(1 - ratio / np.maximum(albedo, 1e-9), 0, 1)
    known = strong & (count >= 2) & (square < planes.TRUSTED**2) & ~object_mask.ravel()
    size = (len(m), *seen.mask.shape)
    return Screen(plane, np.where(known, shade, 0.0).reshape(size), known.astype(float).reshape(size), factor)


def anchored(
    shown: Screen, lights: Sequence[Light], camera: Camera, x_C: Array, label: Labels, model_std: dict[int, float]
) -> dict[int, Anchor]:
    """Anchors by piece, where its shadow gives one, of points x_C (P, 3) with their piece's label (P,).

    `model_std` is how sure near light is of each piece but for the calibration.
    """
    found: dict[int, Anchor] = {}
    x_C = x_C.copy()
    shadow_std = float(np.hypot(EDGE_STD, PLANE_STD * shown.plane.misfit))
    for one, own_std in model_std.items():
        if own_std < shadow_std:
            continue
        inside = label == one
        rest = _predicted(shown, lights, camera, x_C[~inside])
        costs = np.array([_cost(shown, rest, _predicted(shown, lights, camera, scale * x_C[inside])) for scale in SCALES])
        scale = _lowest(costs, NEEDED_RISE * float(np.sqrt(shown.shade.sum())))
        if scale is None:
            continue
        share = own_std**2 / (own_std**2 + shadow_std**2)
        found[one] = Anchor(scale, float(scale**share), float(shadow_std * np.sqrt(share)))
        x_C[inside] *= found[one].used
    return found


@dataclass(frozen=True)
class Predicted:
    """Shadows (L, H, W), and the pixels on their near sides, of which they say nothing."""

    dark: Mask
    near_side: Mask


def _cost(shown: Screen, rest: Predicted, own: Predicted) -> float:
    dark = rest.dark | own.dark
    beyond = ~dark & ~rest.near_side & ~own.near_side
    return float(np.sum(shown.weight * (dark * (1 - shown.shade) + beyond * shown.shade)))


def _lowest(costs: Array, needed_rise: float) -> float | None:
    """The scale of least cost by a parabola through its neighbours; None where the valley is shallow or at the end of the range."""
    k = int(np.argmin(costs))
    if not RIM <= k < len(costs) - RIM or min(costs[k - RIM], costs[k + RIM]) - costs[k] < needed_rise:
        return None
    left, middle, right = costs[k - 1 : k + 2]
    shift = 0.5 * (left - right) / max(left - 2 * middle + right, 1e-12)
    return float(SCALES[k] + np.clip(shift, -0.5, 0.5) * (SCALES[1] - SCALES[0]))


def _predicted(shown: Screen, lights: Sequence[Light], camera: Camera, x_C: Array) -> Predicted:
    """Shadows of points x_C (P, 3) on the screen."""
    dark, near_side = np.zeros(shown.shade.shape, bool), np.zeros(shown.shade.shape, bool)
    if not len(x_C):
        return Predicted(dark, near_side)
    some = slice(None, None, max(1, len(x_C) // MANY_PIXELS))
    own_px = camera.project(x_C[some])
    for k, light in enumerate(lights):
        d, _ = light.field(x_C)
        y_C = x_C - ((x_C @ shown.plane.q - 1) / np.minimum(d @ shown.plane.q, -1e-6))[:, None] * d
        shadow_px = camera.project(y_C)
        pixel = np.rint((shadow_px - (shown.factor - 1) / 2) / shown.factor)
        inside = (pixel >= 0).all(axis=1) & (pixel[:, 0] < dark.shape[2]) & (pixel[:, 1] < dark.shape[1]) & (y_C[:, 2] > 0)
        column, row = pixel[inside].astype(int).T
        dark[k, row, column] = True
        dark[k] = raster.closed(dark[k])
        away = np.median(shadow_px[some] - own_px, axis=0)
        near_side[k] = _behind(dark[k], away / max(np.linalg.norm(away), 1e-9), int(np.linalg.norm(away) / shown.factor) + 1)
    return Predicted(dark, near_side)


def _behind(dark: Mask, away: Array, reach: int) -> Mask:
    """Pixels (H, W) from which some dark one lies within reach in the direction away (x, y), doubling the step each time."""
    found, step = dark.copy(), 1.0
    while step <= 2 * reach:
        column, row = (int(v) for v in np.rint(away * step))
        found |= _moved(found, -row, -column)
        step *= 2
    return found


def _moved(values: Mask, rows: int, columns: int) -> Mask:
    """Values (H, W) moved by rows and columns, False coming in."""
    height, width = values.shape
    found = np.zeros_like(values)
    if abs(rows) < height and abs(columns) < width:
        found[max(rows, 0) : height + min(rows, 0), max(columns, 0) : width + min(columns, 0)] = values[
            max(-rows, 0) : height + min(-rows, 0), max(-columns, 0) : width + min(-columns, 0)
        ]
    return found
