r"""Connected regions of a map of labels, and the clues by which a region is the object or not.

A clue is one number a region: how much of the image's frame it holds, what its plane spares over matter of any normal, where it lies, what
adjoins it. None needs a scale: shares of the frame or the outline, natural logarithms of brightness and depth, costs of the labels.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.geometry.hull import inside_hull
from lpcal.segmentation.flats import Sweep
from lpcal.view.coarse import Coarse, LightTable
from lpcal.view.sight import Indices, strength

SPARED = (-10.0, 30.0)
"""Bounds of the cost that a plane spares a pixel, so that a few pixels do not decide for a region."""
BEFORE = 0.02
"""Natural logarithm of a ratio of depths from which a region stands before the plane that holds most of the frame."""
FEWEST = 6
"""Coarse pixels from which matter of any normal has a depth of its own: that at which its pixels together cost least."""
ALIKE_BRIGHT = 0.15
"""Natural logarithm of a step of the lights' brightness at which the likeness of two regions falls to 1/e."""
ABOUT = (0.05, 0.125)
"""Standard deviations, in picture widths, of the neighbourhoods that a region is compared with."""
EDGE = 0.3
"""Natural logarithm of the steepest change of the lights' brightness over three pixels that lies within a region: .2 to .5 do the same."""
PART = 20
"""Coarse pixels without such an edge that make a region of their own: 12 to 40 do the same."""
JUMP = 0.03
"""Natural logarithm of a ratio of depths across an outline at which the surface's chance of going on there falls to 1/e."""
SMALLEST_PIECE = 0.08
"""Share of the object's largest piece under which a piece is dropped from it, and from its hull."""


@dataclass(frozen=True)
class View:
    """What labels are judged by; the user's hints are none by default."""

    image: Coarse
    table: LightTable
    swept: Sweep
    allowed: Mask | None = None
    """(rows, columns) where the object may be: a box."""
    points: tuple[tuple[int, int], ...] = ()
    """Rows and columns of places that show it."""

    @property
    def normals(self) -> Array:
        """Normals (rows, columns, 3) of matter of any normal."""
        return self.image.image(self.swept.normals)

    @property
    def window(self) -> tuple[slice, slice]:
        """The rows and columns of the box; all without one."""
        if self.allowed is None or not self.allowed.any():
            return slice(None), slice(None)
        rows, columns = (np.flatnonzero(self.allowed.any(axis=axis)) for axis in (1, 0))
        return slice(int(rows[0]), int(rows[-1]) + 1), slice(int(columns[0]), int(columns[-1]) + 1)


@dataclass(frozen=True)
class Regions:
    """N connected regions, each of one label."""

    number: Labels
    """(rows, columns) 0..N-1."""
    label: Labels
    """(N,)."""
    pairs: Indices
    """(K, 2) regions of two adjacent pixels of different regions."""
    pixels: Indices
    """(K, 2) these pixels."""

    @staticmethod
    def of(labels: Labels, bright: Array) -> Regions:
        """The regions of labels (rows, columns), cut along the edges of the logarithm of the lights' brightness (rows, columns).

        A label by itself may join an object and its shadow on the wall, or an object and the front of what carries it.
        """
        number = np.zeros(labels.shape, int)
        label: list[int] = []
        plain = raster.highest(bright, 1, -np.inf) + raster.highest(-bright, 1, -np.inf) < EDGE
        for one in np.unique(labels):
            own = labels == one
            core, _ = raster.labelled(own & plain)
            large = np.flatnonzero(np.bincount(core[core > 0], minlength=1) >= PART)
            nearest = core.ravel()[raster.nearest(np.isin(core, large))] if len(large) else np.zeros(labels.shape, int)
            for part in np.unique(nearest[own]):
                piece, count = raster.labelled(own & (nearest == part))
                number[piece > 0] = piece[piece > 0] - 1 + len(label)
                label += [int(one)] * count
        flat = np.arange(labels.size).reshape(labels.shape)
        beside = [(flat[:, :-1], flat[:, 1:]), (flat[:-1], flat[1:])]
        pixels = np.concatenate([np.stack([a.ravel(), b.ravel()], axis=1) for a, b in beside])
        pairs = number.ravel()[pixels]
        apart = pairs[:, 0] != pairs[:, 1]
        return Regions(number, np.array(label), pairs[apart], pixels[apart])

    @property
    def area(self) -> Array:
        """(N,) pixels."""
        return np.bincount(self.number.ravel(), minlength=len(self.label)).astype(float)

    def mean(self, values: Array) -> Array:
        """Means (N,) of values (rows, columns)."""
        return np.asarray(
            np.bincount(self.number.ravel(), weights=np.asarray(values, float).ravel(), minlength=len(self.label)) / self.area
        )

    def outline(self, weight: Array, beside: Array) -> Array:
        """Means (N,) over a region's outline of weight (K,) times what `beside` (N,) is for the region across."""
        count = len(self.label)
        a, b = self.pairs.T
        total = np.bincount(a, weights=weight * beside[b], minlength=count) + np.bincount(b, weights=weight * beside[a], minlength=count)
        return np.asarray(total / np.maximum(np.bincount(self.pairs.ravel(), minlength=count), 1))

    def frame(self) -> Array:
        """(N,) shares of the image's frame."""
        edge = np.concatenate([self.number[0], self.number[-1], self.number[:, 0], self.number[:, -1]])
        return np.asarray(np.bincount(edge, minlength=len(self.label)) / len(edge))

    def boxes(self) -> tuple[Array, Array, Array]:
        """The first row (N,) of each region, and the height and width (N,) of the box about it."""
        ends = []
        for at in np.indices(self.number.shape):
            low, high = np.full(len(self.label), at.max()), np.zeros(len(self.label), int)
            np.minimum.at(low, self.number.ravel(), at.ravel())
            np.maximum.at(high, self.number.ravel(), at.ravel())
            ends.append((low.astype(float), high - low + 1.0))
        (first, height), (_, width) = ends
        return first, height, width


@dataclass(frozen=True)
class Pictures:
    """What clues are taken from, (rows, columns) each."""

    labels: Labels
    planes: list[Array]
    """q (3,) each, of labels 1..; label 0 is matter of any normal, then come nothing and other matter."""
    spared: Array
    """Cost that the label spares a pixel, compared with matter of any normal."""
    bright: Array
    """Log of the brightest signal but one."""
    normals: Array
    """(rows, columns, 3) the plane's, or those of matter of any normal; 0 where no light reaches."""
    rays_C: Array
    """(rows, columns, 3)."""
    swept: tuple[Array, Array]
    """u (D,) and the cost (D, rows, columns) of matter of any normal."""
    free: Array
    flat: Array
    """Costs of matter of any normal, and of the best of the planes; SPARED's upper bound where there is none."""
    of_any: Array
    """(rows, columns, 3) normals of matter of any normal, whatever the label."""
    blown: Array
    """Share of a pixel's samples that cannot be used: saturated, as a bright wall behind a dark object is."""

    @staticmethod
    def of(view: View, labels: Labels, planes: list[Array], cost: Array) -> Pictures:
        """In the view's window, from labels (rows, columns) and the costs (layers, rows, columns)."""
        here = view.window
        image, count = view.image, len(planes)
        signal = strength(image.maps)
        facing = np.stack([np.zeros(3), *(-q / np.linalg.norm(q) for q in planes), np.zeros(3), np.zeros(3)])[labels]
        free = (labels == 0) | (labels == count + 2)  # what no light reaches shows no normal
        flat = cost[1 : count + 1].min(axis=0) if count else np.full(labels.shape, SPARED[1])
        return Pictures(
            labels[here],
            planes,
            np.clip(cost[0] - np.take_along_axis(cost, labels[None], axis=0)[0], *SPARED)[here],
            np.log(np.maximum(signal, 1e-3 * np.percentile(signal, 99)))[here],
            np.where(free[..., None], view.normals, facing)[here],
            image.image(image.rays_C)[here],
            (view.swept.u, view.swept.cost.reshape(-1, *image.shape)[:, *here]),
            cost[0][here],
            flat[here],
            view.normals[here],
            image.image(1.0 - image.usable.mean(axis=0))[here],
        )


def own(pictures: Pictures, regions: Regions) -> dict[str, Array]:
    """The clues (N,) of a region alone."""
    rows, columns = regions.number.shape
    count = len(pictures.planes)
    plane = ((regions.label > 0) & (regions.label <= count)).astype(float)
    frame = regions.frame()
    size = np.sqrt(regions.area / regions.number.size)
    first, height, width = regions.boxes()
    along, all_over = np.ones(len(regions.pairs)), np.ones(len(regions.label))
    return {
        "frame": np.sqrt(frame),
        "plane": plane,
        "frame, a plane": np.sqrt(frame) * plane,
        "spared": regions.mean(pictures.spared),
        "begins low": first / rows,
        "width": width / columns,
        "height": height / rows,
        "fills its box": regions.area / (width * height),
        "size": size,
        "size, of any normal": size * (regions.label == 0),
        "facing down": regions.mean(pictures.normals[..., 1]),
        "facing aside": np.abs(regions.mean(pictures.normals[..., 0])),
        "bright": regions.mean(pictures.bright) - float(np.median(pictures.bright)),
        "edge in the lights": regions.outline(np.minimum(_step(pictures.bright, regions), 1.0), all_over),
        "blown out": regions.mean(pictures.blown),
        "dark frame": np.full(len(plane), frame[regions.label == count + 1].sum()),
        "nothing beside": regions.outline(along, regions.label == count + 1),
        "before": _before(pictures, regions, frame, plane > 0),
    }


def beside(pictures: Pictures, regions: Regions, logit: Array) -> dict[str, Array]:
    """The clues (N,) of a region by the log odds (N,) of those about it."""
    count = len(pictures.planes)
    plane, free = (regions.label > 0) & (regions.label <= count), regions.label == 0
    near, far = (regions.mean(raster.blurred(logit[regions.number], share * regions.number.shape[1], "nearest")) for share in ABOUT)
    frame = regions.frame()
    odds = 1 / (1 + np.exp(-logit))
    of_label = np.bincount(regions.label, weights=frame, minlength=count + 3)[regions.label]
    alike = np.exp(-((_step(pictures.bright, regions) / ALIKE_BRIGHT) ** 2))
    return {
        "itself": logit,
        "about": near,
        "widely about, of any normal": free * far,
        "alike in the lights', a plane": plane * regions.outline(alike, logit),
        "frame of the whole plane": plane * of_label,
        "frame of the whole, seen through": (frame == 0) * of_label,
        "above, facing up": plane * np.maximum(-regions.mean(pictures.normals[..., 1]), 0.0) * _above(regions, odds),
        "goes on, a plane": plane * _goes_on(pictures, regions, odds),
        "in the hull, dark": (regions.label == count + 1) * _in_hull(regions, odds),
    }


def _above(regions: Regions, odds: Array) -> Array:
    """How far (N,) regions lie above the middle of the likely object, by odds (N,), in its standard deviations: no support does."""
    of_pixel = odds[regions.number]
    weight = np.where(of_pixel > 0.5, of_pixel, 1e-9)
    row = np.indices(regions.number.shape)[0]
    middle = np.average(row, weights=weight)
    spread = np.sqrt(np.average((row - middle) ** 2, weights=weight))
    return np.clip((middle - regions.mean(row)) / (spread + 1), -3, 3)


def _goes_on(pictures: Pictures, regions: Regions, odds: Array) -> Array:
    """The share (N,) of each region's outline over which the likely object, by odds (N,), goes on at the same depth."""
    log_z = log_depth(pictures, regions)
    a, b = log_z.ravel()[regions.pixels].T
    same = np.nan_to_num(np.exp(-np.abs(a - b) / JUMP))
    return regions.outline(same, odds)


def _in_hull(regions: Regions, odds: Array) -> Array:
    """The share (N,) of each region that lies in the convex hull of the likely object, by odds (N,)."""
    piece, _ = raster.labelled(odds[regions.number] > 0.5)
    size = np.bincount(piece.ravel())
    size[0] = 0
    held = np.isin(piece, np.flatnonzero(size >= SMALLEST_PIECE * max(int(size.max()), 1)))
    places = np.indices(piece.shape).reshape(2, -1).T.astype(float)
    return regions.mean(inside_hull(places, places[held.ravel()]).astype(float).reshape(piece.shape))


def _step(picture: Array, regions: Regions) -> Array:
    """Steps (K,) of a picture (rows, columns) across outlines."""
    a, b = picture.ravel()[regions.pixels].T
    return np.asarray(np.abs(a - b))


def _before(pictures: Pictures, regions: Regions, frame: Array, plane: Mask) -> Array:
    """1 where a region (N,) stands before the plane that holds most of the frame, else 0."""
    if not pictures.planes:
        return np.zeros(len(regions.label))
    held = np.bincount(regions.label[plane], weights=frame[plane], minlength=len(pictures.planes) + 1)[1:]
    wall = _depth(pictures.planes[int(np.argmax(held))], pictures.rays_C)
    ahead = np.nan_to_num(np.clip(np.log(wall) - log_depth(pictures, regions), -1, 1))
    return np.asarray(regions.mean(ahead) > BEFORE, float)


def log_depth(pictures: Pictures, regions: Regions) -> Array:
    """Log depth (rows, columns): a plane's, or that at which a region's pixels together cost least; NaN where there is none."""
    log_z = np.full(regions.number.shape, np.nan)
    u, cost = pictures.swept
    for k, label in enumerate(regions.label):
        inside = regions.number == k
        if 0 < label <= len(pictures.planes):
            log_z[inside] = np.log(_depth(pictures.planes[label - 1], pictures.rays_C[inside]))
        elif label != len(pictures.planes) + 1 and inside.sum() >= FEWEST:
            log_z[inside] = u[np.argmin(np.minimum(cost[:, inside], SPARED[1]).mean(axis=1))]
    return log_z


def _depth(q: Array, rays_C: Array) -> Array:
    """Depths (...) at which rays (..., 3) meet a plane; NaN where they miss it."""
    slope = rays_C @ q
    return np.asarray(np.where(slope > 1e-6, 1 / np.maximum(slope, 1e-6), np.nan))
