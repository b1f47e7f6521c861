r"""Which labels are the object and which the wall behind it or the support under it: odds of every region, from clues.

The log odds that a region is the object are a sum of trees over its own clues (segmentation.regions), then linear in those of its
neighbours' odds; those of a coarse pixel are a sum of trees over its region's odds and its context (segmentation.context). All are fitted
by tools/fit_mask.py on simulated scenes, each stage on what the one before says of scenes that it was not fitted to. Their remaining
uncertainty is the mask's stated doubt. The user may say where the object is: a box takes the place of the image, and what a given point
shows is the object. Sources: Friedman 2001, Annals of Statistics 29 (gradient boosting); Wolpert 1992, Neural Networks 5 (a second fit on
the predictions of a first).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Literal

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.kernels.library import kernel
from lpcal.segmentation import context, regions
from lpcal.segmentation.regions import Pictures, Regions, View
from lpcal.view.sight import Indices

FITTED = Path(__file__).with_name("mask_trees.npz")
"""Where the mask's trees are."""
BESIDE = {
    "": 0.202,
    "itself": 0.511,
    "about": 0.78,
    "widely about, of any normal": -0.36,
    "alike in the lights', a plane": 0.756,
    "frame of the whole plane": -0.715,
    "frame of the whole, seen through": -1.37,
    "above, facing up": 0.108,
    "goes on, a plane": 3.43,
    "in the hull, dark": 0.0695,
}
"""Weights of the clues of the regions about it in a region's log odds; "" is the constant. By tools/fit_mask.py."""
RIM = 2
"""Coarse pixels at the image's border, of which those without light say what share of the picture shows nothing."""
HOLE = 0.005
"""Share of the object's area under which a hole in it is filled, in coarse pixels and in full size."""
LIKELY = (0.01, 0.99)
"""Odds beyond which a region counts no more for its neighbours."""
CARRIED = 5
"""Percentile of a plane's depths that lies before the object where the plane carries it: a wall lies behind it altogether."""
UNLIKELY = 0.02
"""Odds under which no region is taken for the object: a wall alone has .002, a card parallel to a wall .07."""
OPEN = 0.1
"""Odds that a region is on the other side from which it is named as doubtful."""

NOTHING, OBJECT, SUPPORT, WALL = 0, 1, 2, 3
"""Values of a map of layers: no light comes back; the object; what carries it; what stands behind it."""
Kind = Literal["support", "wall", "dark", "other"]
"""What a pixel may be instead of the object: its support, a wall, a place that no light reaches, or matter like theirs in no plane."""


@dataclass(frozen=True)
class Judged:
    """Odds of regions or of coarse pixels, and what follows."""

    odds: Array
    """(rows, columns) that a pixel is the object, 0..1."""
    behind: Mask
    """(rows, columns) what is not."""
    mask: Mask
    """(rows, columns) the object, without crumbs and small holes."""
    pictures: Pictures
    regions: Regions
    """What regions were judged by, in the window of the view."""


@dataclass(frozen=True)
class Trees:
    """Gradient-boosted trees: log odds as a sum over T small decision trees of a few clues, N nodes together.

    A node asks whether a clue is at most a threshold; a leaf is what the way there adds. scikit-learn fits them, numpy alone uses them.
    """

    clues: tuple[str, ...]
    start: float
    """Log odds before any tree."""
    root: Indices
    """(T,) the first node of each tree."""
    clue: Indices
    """(N,) the number of the clue that a node asks for; -1 at a leaf."""
    threshold: Array
    """(N,) up to which the way leads left."""
    left: Indices
    right: Indices
    """(N,) the next node."""
    leaf: Array
    """(N,) what a leaf adds to the log odds; 0 at other nodes."""

    def log_odds(self, clues: Mapping[str, Array]) -> Array:
        """Log odds (P,) by clues (P,) of these names, of which there may be more."""
        at = np.stack([np.asarray(clues[name], float) for name in self.clues], axis=1)
        return self._summed(at)

    def _summed(self, clues: Array) -> Array:
        """Log odds (P,) by clues (P, C)."""
        total = np.full(len(clues), self.start)
        if run := kernel("trees"):
            nodes = (np.ascontiguousarray(one, np.int64) for one in (self.root, self.clue, self.left, self.right))
            values = (np.ascontiguousarray(one, float) for one in (self.threshold, self.leaf))
            run(*clues.shape, len(self.root), np.ascontiguousarray(clues), *nodes, *values, total)
            return total
        every = np.arange(len(clues))
        for root in self.root:
            node = np.full(len(clues), root)
            while (open_ := self.clue[node] >= 0).any():
                goes = clues[every, np.maximum(self.clue[node], 0)] <= self.threshold[node]
                node = np.where(open_, np.where(goes, self.left[node], self.right[node]), node)
            total += self.leaf[node]
        return total

    def arrays(self, name: str) -> dict[str, np.ndarray]:
        """What a file keeps of them, under a name."""
        kept: dict[str, np.ndarray] = {"clues": np.array(self.clues), "start": np.array(self.start), "root": self.root.astype(np.int32)}
        kept |= {"clue": self.clue.astype(np.int8), "left": self.left.astype(np.int32), "right": self.right.astype(np.int32)}
        kept |= {"threshold": self.threshold, "leaf": self.leaf.astype(np.float32)}
        return {f"{name}.{key}": value for key, value in kept.items()}

    @staticmethod
    def of(arrays: Mapping[str, np.ndarray], name: str) -> Trees:
        """From what a file keeps."""
        root, clue, left, right = (arrays[f"{name}.{key}"].astype(np.int64) for key in ("root", "clue", "left", "right"))
        threshold, leaf = (arrays[f"{name}.{key}"].astype(float) for key in ("threshold", "leaf"))
        return Trees(tuple(map(str, arrays[f"{name}.clues"])), float(arrays[f"{name}.start"]), root, clue, threshold, left, right, leaf)


@dataclass(frozen=True)
class Judge:
    """What clues say: fitted to simulated scenes."""

    own: Trees
    beside: Mapping[str, float]
    context: Trees

    @staticmethod
    @cache
    def fitted() -> Judge:
        """The one that tools/fit_mask.py has fitted."""
        with np.load(FITTED) as arrays:
            return Judge(Trees.of(arrays, "regions"), BESIDE, Trees.of(arrays, "context"))

    def of_regions(self, pictures: Pictures, found: Regions) -> Array:
        """The odds (N,), 0..1, that regions are the object."""
        first = _odds(self.own.log_odds(regions.own(pictures, found)))
        total = np.full(len(first), self.beside[""])
        for name, clue in regions.beside(pictures, found, logit(first)).items():
            total += self.beside[name] * clue
        return _odds(total)


def rim_of(shape: tuple[int, ...]) -> Mask:
    """The coarse pixels (rows, columns) at the border."""
    rim = np.ones(shape, bool)
    rim[RIM:-RIM, RIM:-RIM] = False
    return rim


def judged(view: View, labels: Labels, planes: list[Array], cost: Array, judge: Judge | None = None) -> Judged:
    """What is the object, from labels (rows, columns) and their costs (layers, rows, columns).

    The odds are those given that the picture shows an object, if anything is likely to be it at all: one region alone must then be it.
    Where still nothing is rather the object than not, it is what is likeliest.
    """
    pictures = Pictures.of(view, labels, planes, cost)
    found = Regions.of(pictures.labels, pictures.bright)
    odds = (judge or Judge.fitted()).of_regions(pictures, found)
    if odds.max() > UNLIKELY:
        odds = odds / (1 - np.prod(1 - odds))  # given that the picture shows an object
    return _judged(odds[found.number], view, labels, pictures, found)


def _judged(in_window: Array, view: View, labels: Labels, pictures: Pictures, found: Regions) -> Judged:
    odds = np.zeros(labels.shape)
    odds[view.window] = in_window
    for at in view.points:
        shown, _ = raster.labelled(labels == labels[at])
        odds[shown == shown[at]] = 1.0
    likeliest = float(odds.max())
    behind = odds <= (0.5 if likeliest > 0.5 else max(likeliest / 2, UNLIKELY))
    return Judged(odds, behind, object_in(~behind, view.points), pictures, found)


def all_of(judgement: Judged, lit: Mask) -> Judged:
    """All that is lit (rows, columns) as the object, where nothing in the picture is likely to be it."""
    return replace(judgement, odds=np.where(lit, LIKELY[1], LIKELY[0]), behind=~lit, mask=lit)


def in_context(judgement: Judged, view: View, labels: Labels, bright: Image, room: Image | None, judge: Judge | None = None) -> Judged:
    """Regions judged again pixel by pixel, by what their neighbours are and which side they are like.

    `bright` and `room` (rows, columns) are the logarithms of the lights' brightness and of the image without lights, where there is one.
    """
    clues = clues_in(judgement, view, bright, room)
    if clues is None:
        return judgement
    odds = _odds((judge or Judge.fitted()).context.log_odds(clues)).reshape(judgement.pictures.labels.shape)
    return _judged(odds, view, labels, judgement.pictures, judgement.regions)


def clues_in(judgement: Judged, view: View, bright: Image, room: Image | None) -> dict[str, Array] | None:
    """The clues (P,) of the coarse pixels of the view's window; None where all is on one side."""
    odds, here = judgement.odds[view.window], view.window
    return context.clues_of(odds, logit(odds), judgement.pictures, judgement.regions, bright[here], None if room is None else room[here])


def logit(odds: Array) -> Array:
    """Log odds (N,), within bounds."""
    sure = np.clip(odds, *LIKELY)
    return np.asarray(np.log(sure / (1 - sure)))


def _odds(log_odds: Array) -> Array:
    return np.asarray(1 / (1 + np.exp(-np.clip(log_odds, -30, 30))))


def object_in(mask: Mask, points: Sequence[tuple[int, int]]) -> Mask:
    """A mask (rows, columns) without crumbs and small holes; where points are given it is the pieces that they lie on."""
    piece, count = raster.labelled(mask)
    if not count:
        return np.zeros(mask.shape, bool)
    size = np.bincount(piece.ravel()).astype(float)
    size[0] = 0
    kept = np.isin(np.arange(count + 1), [piece[at] for at in points]) if points else size >= regions.SMALLEST_PIECE * size.max()
    kept[0] = False
    found = kept[piece]
    hole, _ = raster.labelled(~found)
    area = np.bincount(hole.ravel())
    small = np.flatnonzero(area < HOLE * max(int(found.sum()), 1))
    return np.asarray(found | np.isin(hole, small[small > 0]))


def kinds_of(labels: Labels, planes: list[Array], rays_C: Array, behind: Mask, distance_m: float) -> list[Kind]:
    """What each layer is where it is background: `behind` (rows, columns), the object at about `distance_m`."""
    found: list[Kind] = ["other"]
    for k, q in enumerate(planes, 1):
        own = behind & (labels == k)
        depth = 1 / np.maximum(rays_C.reshape(*labels.shape, 3)[own] @ q, 1e-9)
        found.append("support" if own.any() and np.percentile(depth, CARRIED) < distance_m else "wall")
    return [*found, "dark", "other"]


@dataclass(frozen=True)
class Doubt:
    """What of an object's outline is uncertain."""

    share: float
    """Area that is expected to be on the wrong side, as a share of the object's."""
    open: float
    """Area of `place`, likewise."""
    place: Mask
    """(rows, columns) where the odds leave it uncertain."""
    rival: int
    """The label that most of it has, or whose place it takes."""


def doubt_of(judgement: Judged, labels: Labels) -> Doubt:
    """The doubt of a judgement on labels (rows, columns)."""
    wrong = np.where(judgement.mask, 1 - judgement.odds, judgement.odds)
    place: Mask = wrong > OPEN
    rival = int(np.argmax(np.bincount(labels[place]))) if place.any() else 0
    area = max(int(judgement.mask.sum()), 1)
    return Doubt(float(wrong.sum()) / area, float(place.sum()) / area, place, rival)
