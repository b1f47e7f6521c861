r"""Which labels are the object and which the wall behind it or the support under it: odds of every region, from clues.

The log odds that a region is the object are linear in its clues (surface.regions), first in those of its own, then also in those of its
neighbours' odds; both are fitted by tools/fit_mask.py on simulated scenes. Their remaining uncertainty is the mask's stated doubt. The user
may say where the object is: a box takes the place of the image, and what a given point shows is the object. Source: Wolpert 1992, Neural
Networks 5 (a second fit on the predictions of a first).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.surface import regions
from lpcal.surface.likeness import likeness
from lpcal.surface.regions import Pictures, Regions, View

OWN = {
    "": 4.96,
    "frame": -6.0,
    "plane": 2.2,
    "frame, a plane": -1.46,
    "spared": -0.182,
    "begins low": -1.6,
    "width": -4.71,
    "height": -4.14,
    "fills its box": -4.35,
    "size": 12.4,
    "size, of any normal": 3.13,
    "facing down": 1.31,
    "facing aside": 1.95,
    "bright": 0.0953,
    "edge in the lights": -0.931,
    "dark frame": 2.28,
    "nothing beside": -3.06,
    "before": 1.11,
}
"""Weights of a region's own clues in its log odds; "" is the constant. By tools/fit_mask.py."""
BESIDE = {
    "": 0.562,
    "itself": 0.279,
    "about": 0.994,
    "widely about, of any normal": -0.34,
    "alike in the lights', a plane": 1.32,
    "frame of the whole plane": -2.16,
    "frame of the whole, seen through": -1.16,
    "above, facing up": 0.932,
    "goes on, a plane": 3.58,
    "in the hull, dark": -0.945,
}
"""Weights of the clues of the regions about it, likewise."""
CONTEXT = {"": 0.311, "odds": 0.947, "about": 0.636, "lights": 0.17, "room": 0.448, "room, widely": 0.126}
"""Weights of a coarse pixel's clues in its log odds, by its region's and by what it is like. By tools/fit_outline.py."""
ABOUT_PX = 1.5
"""Standard deviation, in coarse pixels, of the neighbourhood whose odds a pixel is compared with."""
LIKE_PX = (3.0, 5.0, 12.0)
"""The same of the windows in which a pixel is compared with the object and with the rest: by the image without lights, by the lights', and
widely by the image without lights."""
RIM = 2
"""Coarse pixels at the image's border, of which those without light say what share of the picture shows nothing."""
HOLE = 0.005
"""Share of the object's area under which a hole in it is filled."""
LIKELY = (0.01, 0.99)
"""Odds beyond which a region counts no more for its neighbours."""
CARRIED = 5
"""Percentile of a plane's depths that lies before the object where the plane carries it: a wall lies behind it altogether."""
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


def rim_of(shape: tuple[int, ...]) -> Mask:
    """The coarse pixels (rows, columns) at the border."""
    rim = np.ones(shape, bool)
    rim[RIM:-RIM, RIM:-RIM] = False
    return rim


def judged(view: View, labels: Labels, planes: list[Array], cost: Array) -> Judged:
    """What is the object, from labels (rows, columns) and their costs (layers, rows, columns).

    Where no region is rather the object than not, it is what is likeliest, if anything is likely at all.
    """
    pictures = Pictures.of(view, labels, planes, cost)
    found = Regions.of(pictures.labels, pictures.bright)
    probable = odds_of(pictures, found)
    odds = np.zeros(labels.shape)
    odds[view.window] = probable[found.number]
    return _judged(odds, view, labels)


def _judged(odds: Array, view: View, labels: Labels) -> Judged:
    odds = odds.copy()
    for at in view.points:
        shown, _ = raster.labelled(labels == labels[at])
        odds[shown == shown[at]] = 1.0
    likeliest = float(odds.max())
    behind = odds <= (0.5 if likeliest > 0.5 else max(likeliest / 2, OPEN))
    return Judged(odds, behind, object_in(~behind, view.points))


def in_context(judgement: Judged, view: View, labels: Labels, bright: Image, room: Image | None) -> Judged:
    """Regions judged again pixel by pixel, by what their neighbours are and which side they are like.

    `bright` and `room` (rows, columns) are the logarithms of the lights' brightness and of the image without lights, where there is one:
    what no light reaches, and what paint or a shadow has joined to a wrong region, shows itself there.
    """
    clues = context_of(judgement.odds, bright, room)
    if clues is None:
        return judgement
    odds = _odds(clues, CONTEXT).reshape(labels.shape)
    here = np.zeros(labels.shape, bool)
    here[view.window] = True
    return _judged(np.where(here, odds, 0.0), view, labels)


def context_of(odds: Array, bright: Image, room: Image | None) -> dict[str, Array] | None:
    """The clues (P,) of coarse pixels by odds (rows, columns); None where all is on one side."""
    inside = odds > 0.5
    if not inside.any() or inside.all():
        return None
    everywhere = np.ones(odds.shape, bool)
    near, plain, wide = LIKE_PX

    def like(picture: Image | None, by: float) -> Array:
        return np.zeros(odds.size) if picture is None else likeness([picture], inside, ~inside, by, everywhere)[0]

    return {
        "": np.ones(odds.size),
        "odds": logit(odds.ravel()),
        "about": raster.blurred(odds, ABOUT_PX).ravel() - 0.5,
        "lights": like(bright, plain),
        "room": like(room, near),
        "room, widely": like(room, wide),
    }


def odds_of(pictures: Pictures, found: Regions) -> Array:
    """The odds (N,), 0..1, that regions are the object."""
    first = _odds(regions.own(pictures, found), OWN)
    return _odds(regions.beside(pictures, found, logit(first)), BESIDE)


def logit(odds: Array) -> Array:
    """Log odds (N,), within bounds."""
    sure = np.clip(odds, *LIKELY)
    return np.asarray(np.log(sure / (1 - sure)))


def _odds(clues: Mapping[str, Array], weights: Mapping[str, float]) -> Array:
    total = sum(weights[name] * value for name, value in ({"": np.float64(1.0)} | dict(clues)).items())
    return np.asarray(1 / (1 + np.exp(-np.clip(total, -30, 30))))


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
