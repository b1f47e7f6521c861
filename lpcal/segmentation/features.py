r"""What of a picture says which of its coarse pixels are the object: the channels of the network (view.network).

Symbols: u is a log depth, in units of the working distance. A channel needs no scale of brightness: it holds a natural logarithm of
brightness or depth, a cost of segmentation.sample_costs, a normal, or what a label says.
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
"""Cost of matter of any normal at most: a few wild pixels are like others."""
SPARED = 30.0
"""Cost at most by which one explanation, or layer, is better than another: beyond, they are all alike."""
ABOVE = 20.0
"""Cost at most by which a depth is worse than a pixel's best."""
DEPTHS = (-0.8, -0.5, -0.3, -0.15, 0.0, 0.15, 0.3, 0.5, 0.8, 1.2)
"""Log depths, over the working distance, whose costs are channels."""
NEAREST, FURTHEST = -1.5, 2.0
"""Log depths, over the working distance, beyond which a plane's depth is held: no object lies there."""
SPARED_BY_LABEL = (-10.0, 30.0)
"""Bounds of the cost that its label spares a pixel."""
MIRRORED = ("normal x", "free normal x")
"""Channels that change their sign in a mirror."""


type Channel = npt.NDArray[np.floating] | Mask
"""A number a pixel (rows, columns)."""


@dataclass(frozen=True)
class View:
    """What labels are judged by; the user's hints are none by default."""

    image: Coarse
    table: LightTable
    swept: Sweep
    distance_m: float
    """The working distance."""
    bright: Image
    """(rows, columns) logarithm of the lights' brightness."""
    room: Image | None = None
    """(rows, columns) logarithm of the image without lights; None where there is none."""
    allowed: Mask | None = None
    """(rows, columns) where the object may be: a box."""
    points: tuple[tuple[int, int], ...] = ()
    """Rows and columns of places that show it."""

    @property
    def window(self) -> tuple[slice, slice]:
        """The rows and columns of the box; all without one."""
        if self.allowed is None or not self.allowed.any():
            return slice(None), slice(None)
        rows, columns = (np.flatnonzero(self.allowed.any(axis=axis)) for axis in (1, 0))
        return slice(int(rows[0]), int(rows[-1]) + 1), slice(int(columns[0]), int(columns[-1]) + 1)


def channels(view: View, labels: Labels, planes: list[Array], cost: Array) -> dict[str, Array]:
    """The channels in the view's window, from labels (rows, columns), planes (3,) and the layers' costs (layers, rows, columns)."""
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
    """What a pixel is made of, what its label spares over matter of any normal, and which way it faces."""
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
    """How large the connected component of the label is, and how much of the image's frame it and the whole label hold; square roots."""
    region, count = np.zeros(labels.shape, int), 0
    for one in range(planes + 3):
        piece, pieces = raster.connected_components(labels == one)
        region[piece > 0] = piece[piece > 0] + count - 1
        count += pieces
    size = np.bincount(region.ravel(), minlength=count) / labels.size

    of_region, of_label = (_frame(each, int(each.max()) + 1)[each] for each in (region, labels))
    return {"size": np.sqrt(size)[region], "frame": np.sqrt(of_region), "frame of the label": np.sqrt(of_label)}


def _frame(of: Labels | npt.NDArray[np.int_], count: int) -> Array:
    """The share (count,) of the image's frame that each number of a map (rows, columns) holds."""
    edge = np.concatenate([of[0], of[-1], of[:, 0], of[:, -1]])
    return np.asarray(np.bincount(edge, minlength=count) / len(edge))


def _of_depth(view: View, labels: Labels, planes: list[Array]) -> dict[str, Channel]:
    """The plane's depth, that of the plane which holds most of the frame, and how well matter of any normal suits each depth."""
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
