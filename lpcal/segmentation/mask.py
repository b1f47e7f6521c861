"""The automatic object mask: separates the object from the wall behind it, the support under it and the dark.

With near lights the binned image is segmented into planes and surfaces of free shape (segmentation.layers), of which a network classifies
the object (segmentation.background). The outline is then refined to full resolution, scale by scale, in a band about it. Without near
lights the signal strength is thresholded.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.records.calibration import Light
from lpcal.segmentation import background, cut, layers, outline, plane_hough, planes
from lpcal.segmentation.features import View
from lpcal.view.coarse import Coarse, LightTable, coarse_of, factor_of, joined
from lpcal.view.constants import CERTAIN, COARSE_PIXELS, SMALLEST_SHARE
from lpcal.view.pixel_list import PixelList, SignalMaps, strength

MEDIUM_PIXELS = 110_000
"""Largest number of pixels of the scale at which ambient light, shadows on the wall and the surroundings are evaluated."""
MOST_LIGHTS = 16
"""Largest number of lights, spread over all, used for the mask: more do not improve it."""
LEAST_OF_IMAGE = 0.003
"""Share of the image below which a region is not an object."""
BESIDE_POINT = 0.02
"""Radius about a given point, as a share of the image's shorter side, in which it selects the nearest component: thin parts may be cut."""
DOUBTED, DOUBT_POWER = 0.094, 4.0
"""Logistic curve of the doubt over the log of the expected misclassified share: its midpoint and slope, fitted by tools/fit_outline.py."""


@dataclass(frozen=True)
class Hints:
    """The user's hints of where the object is, in pixels."""

    box: tuple[int, int, int, int] | None = None
    """x, y, width and height of a box about it."""
    points: tuple[tuple[int, int], ...] = ()
    """x and y of points on it."""

    def allowed(self, shape: tuple[int, ...]) -> Mask | None:
        """The box as a mask (H, W); None where there is none."""
        if self.box is None:
            return None
        x, y, width, height = self.box
        inside = np.zeros(shape[:2], bool)
        inside[y : y + height, x : x + width] = True
        return inside

    def shrunk(self, factor: int) -> Hints:
        """The hints in coarse pixels of `factor` pixels a side."""
        box = None
        if self.box is not None:
            (x, y), (right, below) = (np.array(self.box[:2]) // factor, -(-(np.array(self.box[:2]) + self.box[2:]) // factor))
            box = (int(x), int(y), int(right - x), int(below - y))
        return Hints(box, tuple((x // factor, y // factor) for x, y in self.points))

    def of(self, mask: Mask) -> Mask:
        """The part of a mask (H, W) in the box; if there are points, only the connected components on or near which they lie."""
        allowed = self.allowed(mask.shape)
        mask = mask if allowed is None else mask & allowed
        if not self.points:
            return mask
        piece, _ = raster.connected_components(mask)
        far, nearest = raster.distance_to(mask), raster.nearest(mask)
        close = [(y, x) for x, y in self.points if far[y, x] <= BESIDE_POINT * min(mask.shape)]
        return np.asarray(mask & np.isin(piece, [piece.ravel()[nearest[y, x]] for y, x in close]))


NO_HINTS = Hints()
Keep = Literal["object", "support", "all"]
"""Layers to be reconstructed: the object; the object and its support; all that is lit."""


@dataclass(frozen=True)
class Found:
    """A mask with its planes, layers and uncertainty."""

    mask: Mask
    how: str
    """How it was found, for messages."""
    planes: tuple[planes.Plane, ...] = ()
    """Wall and supports, the largest first."""
    expected_wrong: float | None = None
    """Expected misclassified area, as a share of the object's; None where no layers were labelled."""
    why: str = ""
    """What and where the doubtful area may be, for messages."""
    layer: Labels | None = None
    """(H, W) values of background.Layer: nothing, object, support, wall; None where no layers were labelled."""
    of_plane: Labels | None = None
    """(rows, columns) index of each coarse pixel's plane, -1 for none; None where there are no planes."""
    factor: int = 1
    """Side of a coarse pixel, in pixels."""

    def kept(self, keep: Keep) -> Mask:
        """The layers (H, W) to be reconstructed."""
        if self.layer is None or keep == "object":
            return self.mask
        return np.asarray(
            self.mask | (self.layer == background.Layer.SUPPORT) if keep == "support" else self.layer > background.Layer.NOTHING
        )

    @property
    def doubt(self) -> float | None:
        """Probability (0..1) that more than a tenth of the mask's area is wrong; None where it is not known."""
        if self.expected_wrong is None:
            return None
        return float(1 / (1 + (DOUBTED / max(self.expected_wrong, 1e-3)) ** DOUBT_POWER))


def automatic(
    maps: SignalMaps,
    rays_C: Array,
    lights: Sequence[Light],
    distance_m: float | None,
    hints: Hints = NO_HINTS,
    room: Image | None = None,
    *,
    drawn: bool = True,
) -> Found:
    """Find the object; `distance_m` is the working distance of near lights, None for distant ones (no planes are found then).

    `room` (H, W) is the ambient image, if there is one. Without `drawn` the outline is not refined, for callers that only need the planes.
    """
    if distance_m is not None:
        fewer, some = maps, list(range(len(lights)))
        if len(lights) > MOST_LIGHTS:
            some = np.linspace(0, len(lights) - 1, MOST_LIGHTS).round().astype(int).tolist()
            fewer = SignalMaps(maps.signal[some], maps.sigma[some], maps.usable[some])
        found = _by_layers(fewer, rays_C, [lights[k] for k in some], distance_m, hints, room, drawn=drawn)
        if found is not None:
            return found
    return Found(hints.of(_by_strength(maps)), "by the strength of the signal")


def _by_strength(maps: SignalMaps) -> Mask:
    """Otsu's threshold (1979) on the log of the signal strength, then GrabCut along the outline."""
    lit = strength(maps)
    noise = np.median(maps.sigma, axis=0)
    level = np.log(np.maximum(lit, noise))
    mask = level > _otsu(level)
    mask &= lit > CERTAIN * noise
    return tidy(cut.along_the_seam(tidy(mask), _picture(maps)))


def _by_layers(
    maps: SignalMaps, rays_C: Array, lights: Sequence[Light], distance_m: float, hints: Hints, room: Image | None, *, drawn: bool
) -> Found | None:
    image = coarse_of(maps, rays_C, factor_of(maps, COARSE_PIXELS))
    lit = np.sum(image.signal > CERTAIN * image.sigma, axis=0) >= 3
    if lit.mean() < LEAST_OF_IMAGE:
        return None
    table, shape = LightTable.of(image, lights, distance_m), maps.signal.shape[1:]
    view = view_of(image, table, distance_m, hints, shape, room)
    planes_found = plane_hough.find(image, table, view.swept, lit, distance_m)
    labels, found, cost = layers.label(view, planes_found, lit, float(np.log(distance_m)))
    count = len(found.planes)
    judged = background.judged(view, labels, found.planes, cost)
    alone = judged.mask.sum() < LEAST_OF_IMAGE * judged.mask.size
    if alone:
        judged = background.all_of(judged, image.image(lit))
    mask, behind = judged.mask, judged.behind
    area = [int(np.sum(behind & (labels == k + 1))) for k in range(count)]
    seen = PixelList(np.ones(image.shape, bool), image.rays_C, image.signal, image.sigma, image.usable, True)
    largest_first = [k for k in np.argsort(area)[::-1] if area[k]]
    walls = tuple(_plane(found.planes[k], seen, lights, (behind & (labels == k + 1)).ravel()) for k in largest_first)
    of_plane = np.full(labels.shape, -1)
    for number, k in enumerate(largest_first):
        of_plane[behind & (labels == k + 1)] = number
    how = f"against {len(walls)} plane{'s' * (len(walls) != 1)}" if walls else "against the dark"
    how = "all that is lit lies in one plane: that is the object" if alone else how
    if not drawn:
        return Found(hints.of(outline.enlarged(mask, image.factor, shape)), how, walls, of_plane=of_plane, factor=image.factor)
    u_free = view.swept.u[np.argmin(np.median(view.swept.cost[:, mask.ravel()], axis=1))]
    kinds = background.kinds_of(labels, found.planes, image.rays_C, behind, float(np.exp(u_free)))
    doubt = background.doubt_of(judged, labels)
    fine = outline.carried(mask, image.factor, maps, rays_C) if alone else outline.drawn(apart_of(view, judged), maps, rays_C, room)
    fine = hints.of(tidy(fine))
    why = _in_words(doubt, kinds[doubt.rival], image.factor)
    layer = _layer(fine, labels, behind, kinds, image.factor)
    whole = Found(fine, how, walls, layer=layer, of_plane=of_plane, factor=image.factor)
    return whole if alone else replace(whole, expected_wrong=doubt.share, why=why)


def view_of(image: Coarse, table: LightTable, distance_m: float, hints: Hints, shape: tuple[int, ...], room: Image | None) -> View:
    """Inputs of the mask network, with the hints in coarse pixels."""
    rows, columns = image.shape
    allowed = hints.allowed(shape)
    if allowed is not None:
        blocks = allowed[: rows * image.factor, : columns * image.factor].reshape(rows, image.factor, columns, image.factor)
        allowed = blocks.any(axis=(1, 3))
    points = tuple((min(y // image.factor, rows - 1), min(x // image.factor, columns - 1)) for x, y in hints.points)
    swept, levels = plane_hough.sweep(image, table, distance_m), outline.levels_of(image.maps, room, image.factor)
    return View(image, table, swept, distance_m, *levels, allowed, points)


def apart_of(view: View, judged: background.Judged) -> outline.Apart:
    """Inputs of the outline network: log odds, and the log distance at which free normals fit the object best."""
    of_object = judged.mask.ravel() if judged.mask.any() else np.ones(judged.mask.size, bool)
    u = view.swept.u[np.argmin(np.median(view.swept.cost[:, of_object], axis=1))]
    return outline.Apart(view.image, view.table, float(u), judged.log_odds)


def _layer(mask: Mask, labels: Labels, behind: Mask, kinds: Sequence[background.Kind], factor: int) -> Labels:
    """The layer map (H, W) of a mask (H, W); pixels outside it take the kind of the nearest coarse background pixel."""
    value = {
        "support": background.Layer.SUPPORT,
        "wall": background.Layer.WALL,
        "dark": background.Layer.NOTHING,
        "other": background.Layer.WALL,
    }
    nearest = raster.nearest(behind) if behind.any() else None
    coarse = np.array([value[kind] for kind in kinds])[labels if nearest is None else labels.ravel()[nearest]]
    row, column = (np.minimum(np.arange(side) // factor, most - 1) for side, most in zip(mask.shape, labels.shape, strict=True))
    found = coarse[np.ix_(row, column)] if nearest is not None else np.zeros(mask.shape, int)
    return np.asarray(np.where(mask, background.Layer.OBJECT, found), np.uint8)


def _in_words(doubt: background.Doubt, rival: background.Kind, factor: int) -> str:
    """What the doubtful area may be and the box of its largest component, for messages; empty where there is none."""
    if not doubt.place.any():
        return ""
    piece, _ = raster.connected_components(doubt.place)
    size = np.bincount(piece.ravel())
    size[0] = 0
    row, column = (factor * np.array([one.min(), one.max() + 1]) for one in np.nonzero(piece == np.argmax(size)))
    what = {
        "support": "the support under it",
        "wall": "the wall behind it",
        "dark": "background that no light reaches",
        "other": "other matter of the background",
    }[rival]
    return f"{100 * doubt.open:.0f} % of its area may be {what}, most of it in x {column[0]} to {column[1]}, y {row[0]} to {row[1]}"


def _plane(q: Array, seen: PixelList, lights: Sequence[Light], own: Mask) -> planes.Plane:
    some = planes.thinned(seen.at(np.flatnonzero(own)))
    square, _ = planes.misfit(some, planes.predicted(q, some.rays_C, lights))
    return planes.Plane(q, float(np.sqrt(np.median(square))))


def tidy(mask: Mask) -> Mask:
    """The mask without small components and small holes."""
    label, count = raster.connected_components(raster.opened(mask))
    if not count:
        return np.asarray(mask & False)
    size = np.bincount(label.ravel())
    size[0] = 0
    kept = np.isin(label, np.flatnonzero(size >= SMALLEST_SHARE * size.max()))
    holes, _ = raster.connected_components(~kept)
    area = np.bincount(holes.ravel())
    small = np.flatnonzero(area < background.HOLE * kept.sum())
    return np.asarray(kept | np.isin(holes, small[small > 0]))


def _picture(maps: SignalMaps) -> Image:
    """An image (H, W, 3), 0..1, of three channels: second brightest, mean and a low quantile over the lights."""
    ordered = np.sort(maps.signal, axis=0)
    three = np.stack([ordered[-2], ordered.mean(axis=0), ordered[len(ordered) // 3]], axis=-1)
    top = np.percentile(three, 99.5, axis=(0, 1))
    return np.asarray(np.sqrt(np.clip(three / np.maximum(top, 1e-12), 0, 1)), np.float32)


def binned(maps: SignalMaps, rays_C: Array) -> tuple[SignalMaps, Array, int]:
    """The maps and rays binned by f x f pixels, so that at most MEDIUM_PIXELS are left, and f."""
    f = factor_of(maps, MEDIUM_PIXELS)
    return *joined(maps, rays_C, f), f


def _otsu(values: Image) -> float:
    """Otsu's threshold: the split of values into two classes of largest between-class variance."""
    count, edges = np.histogram(values, 256)
    middle = (edges[1:] + edges[:-1]) / 2
    below = np.cumsum(count)
    total = below[-1]
    mean = np.cumsum(count * middle)
    parted = np.clip(below * (total - below), 1, None).astype(float)
    between = (mean[-1] * below - mean * total) ** 2 / parted
    return float(middle[np.argmax(between)])
