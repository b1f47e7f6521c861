r"""Input channels of the mask network (view.network), which classifies coarse pixels as object or background.

Symbols: u is a log depth, in units of the working distance. No channel has a scale of brightness: each holds a relative log brightness or
log depth, a cost of segmentation.sample_costs, a normal, or a property of a label.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.segmentation.plane_hough import Sweep
from lpcal.view.coarse import Coarse, LightTable

COST = 60.0
"""Upper bound of the cost of a free normal: outliers beyond it are all alike."""
SPARED = 30.0
"""Upper bound of the difference between the costs of two explanations or layers: beyond it the decision is certain anyway."""
ABOVE = 20.0
"""Upper bound of the excess of a depth's cost over that of the pixel's best depth."""
DEPTHS = (-0.8, -0.5, -0.3, -0.15, 0.0, 0.15, 0.3, 0.5, 0.8, 1.2)
"""Log depths, relative to the working distance, whose costs are channels."""
NEAREST, FURTHEST = -1.5, 2.0
"""Bounds to which a plane's log depth, relative to the working distance, is clipped: no object lies beyond."""
SPARED_BY_LABEL = (-10.0, 30.0)
"""Bounds of the difference between the cost of a free normal and that of the pixel's label."""
MIRRORED = ("normal x", "free normal x")
"""Channels whose sign changes in the mirror image."""


type Channel = npt.NDArray[np.floating] | Mask
"""One value a coarse pixel (rows, columns)."""


@dataclass(frozen=True)
class View:
    """Inputs of the mask network besides the labels, and the user's hints (none by default)."""

    image: Coarse
    table: LightTable
    swept: Sweep
    distance_m: float
    """The working distance."""
    bright: Image
    """(rows, columns) logarithm of the lights' brightness."""
    room: Image | None = None
    """(rows, columns) logarithm of the ambient image; None where there is none."""
    allowed: Mask | None = None
    """(rows, columns) mask of the user's box."""
    points: tuple[tuple[int, int], ...] = ()
    """Row and column of points that the user marked on the object."""

    @property
    def window(self) -> tuple[slice, slice]:
        """Rows and columns of the user's box; the whole image without one."""
        if self.allowed is None or not self.allowed.any():
            return slice(None), slice(None)
        rows, columns = (np.flatnonzero(self.allowed.any(axis=axis)) for axis in (1, 0))
        return slice(int(rows[0]), int(rows[-1]) + 1), slice(int(columns[0]), int(columns[-1]) + 1)


def channels(view: View, labels: Labels, planes: list[Array], cost: Array) -> dict[str, Array]:
    """The channels in the view's window by name, from labels (rows, columns), planes (3,) and costs (layers, rows, columns)."""
    here = view.window
    labels, cost = labels[here], cost[:, *here]
    found = (
        _of_brightness(view) | _of_labels(view, labels, planes, cost) | _of_regions(labels, len(planes)) | _of_depth(view, labels, planes)
    )
    return {name: np.asarray(value, float) for name, value in found.items()}


def _of_brightness(view: View) -> dict[str, Channel]:
    here = view.window
    bright, usable = view.bright[here], view.image.image(view.image.usable.mean(axis=0))[here]
    room = np.zeros_like(bright) if view.room is None else view.room[here]
    return {
        "bright": bright - np.median(bright),
        "room": room - np.median(room),
        "has room": np.full(bright.shape, float(view.room is not None)),
        "blown out": 1 - usable,
    }


def _of_labels(view: View, labels: Labels, planes: list[Array], cost: Array) -> dict[str, Channel]:
    """Indicators of the labels, cost differences to a free normal, and normals."""
    count = len(planes)
    free, other = labels == 0, labels == count + 2
    flat = cost[1 : count + 1].min(axis=0) if count else cost[0] + SPARED
    own = np.take_along_axis(cost, labels[None], axis=0)[0]
    found: dict[str, Channel] = {
        "free": free,
        "plane": (labels > 0) & (labels <= count),
        "nothing": labels == count + 1,
        "other": other,
        "spared": np.clip(cost[0] - own, *SPARED_BY_LABEL),
        "cost": np.clip(cost[0], 0, COST),
        "flat cost": np.clip(flat - cost[0], -SPARED, SPARED),
    }
    of_any = view.image.image(view.swept.normals)[view.window]
    facing = np.stack([np.zeros(3), *(-q / np.linalg.norm(q) for q in planes), np.zeros(3), np.zeros(3)])[labels]
    normals = np.where((free | other)[..., None], of_any, facing)
    for k, axis in enumerate("xyz"):
        found |= {f"normal {axis}": normals[..., k], f"free normal {axis}": of_any[..., k]}
    return found


def _of_regions(labels: Labels, planes: int) -> dict[str, Channel]:
    """Square roots of the area of each label's connected component, and of the shares of the image border in it and in the whole label."""
    region, count = np.zeros(labels.shape, int), 0
    for one in range(planes + 3):
        piece, pieces = raster.connected_components(labels == one)
        region[piece > 0] = piece[piece > 0] + count - 1
        count += pieces
    size = np.bincount(region.ravel(), minlength=count) / labels.size

    of_region, of_label = (_frame(each, int(each.max()) + 1)[each] for each in (region, labels))
    return {"size": np.sqrt(size)[region], "frame": np.sqrt(of_region), "frame of the label": np.sqrt(of_label)}


def _frame(of: Labels | npt.NDArray[np.int_], count: int) -> Array:
    """Share (count,) of the image's border pixels in each label of a map (rows, columns)."""
    edge = np.concatenate([of[0], of[-1], of[:, 0], of[:, -1]])
    return np.asarray(np.bincount(edge, minlength=count) / len(edge))


def _of_depth(view: View, labels: Labels, planes: list[Array]) -> dict[str, Channel]:
    """Log depths of the pixel's plane and of the plane that covers most of the border, and costs of a free normal at some depths."""
    here, working_u = view.window, np.log(view.distance_m)
    rays, u = view.image.image(view.image.rays_C)[here], view.swept.u - working_u
    cost = view.swept.cost.reshape(len(u), *view.image.shape)[:, *here]
    above = cost - cost.min(axis=0)
    best = u[np.argmin(cost, axis=0)]
    met = [-working_u - np.log(np.maximum(rays @ q, 1e-9)) for q in planes]
    depths = np.stack([np.clip(one, NEAREST, FURTHEST) for one in met]) if planes else np.empty((0, *labels.shape))
    held = _frame(labels, len(planes) + 1)[1 : len(planes) + 1]
    wall = depths[int(np.argmax(held))] if held.any() else np.full(labels.shape, FURTHEST)
    shown = (labels > 0) & (labels <= len(planes))
    own = np.take_along_axis(depths, np.where(shown, labels - 1, 0)[None], axis=0)[0] if planes else np.zeros(labels.shape)
    at_wall = np.take_along_axis(above, np.argmin(np.abs(u[:, None, None] - wall), axis=0)[None], axis=0)[0]
    return {
        "depth": np.where(shown, own, 0.0),
        "best depth": best,
        "depth of the wall": wall,
        "before the wall": np.clip(wall - np.where(shown, own, best), -1, 1),
        "cost at the wall": np.where(wall < FURTHEST, np.minimum(at_wall, ABOVE), ABOVE),
        **{f"cost at {at:g}": np.minimum(above[np.argmin(np.abs(u - at))], ABOVE) for at in DEPTHS},
    }
