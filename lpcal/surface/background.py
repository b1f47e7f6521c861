r"""Which labels are the object and which the wall behind it or the support under it: odds of every region, from clues.

The log odds that a region is the object are linear in its clues (surface.regions), first in those of its own, then in what its neighbours'
odds say as well; both lines are fitted by tools/fit_mask.py on drawn scenes. What they leave open is the mask's stated doubt. The user may
say where the object is: a box takes the place of the image, and what a given point shows is the object.
Source: Wolpert 1992, Neural Networks 5 (a second fit on the predictions of a first).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.surface import flats, regions
from lpcal.surface.regions import Pictures, Regions, View

OWN = {
    "": 1.84,
    "frame": -3.09,
    "plane": 3.23,
    "frame, a plane": -5.14,
    "spared": -0.166,
    "off centre": -1.84,
    "facing down": 1.41,
    "size": 0.57,
    "size, of any normal": 4.35,
    "dark frame": 2.42,
    "nothing beside": -3.02,
    "two sides": -1.41,
    "before": 0.592,
    "free beside, a plane": 2.19,
    "edge, a plane": -3.44,
}
"""Weights of a region's own clues in its log odds; "" is the constant. By tools/fit_mask.py."""
BESIDE = {
    "": 0.513,
    "itself": 0.365,
    "about": 0.878,
    "alike in the room's light": 0.429,
    "alike in the lights', a plane": 0.344,
    "frame of the whole plane": -3.09,
    "facing the camera, a plane": 0.441,
    "widely about, of any normal": -0.364,
}
"""Weights of what the regions about it say, likewise."""
RIM = 2
"""Coarse pixels at the image's border, of which those without light say how much of the picture shows nothing."""
SMALLEST_PIECE = 0.08
"""Share of the largest piece under which a piece is dropped."""
HOLE = 0.005
"""Share of the object's area under which a hole in it is filled."""
LEAST_SEEN_THROUGH = 6
"""Coarse pixels of a piece of a wall from which it is asked whether it is seen through the object."""
SEEN_THROUGH = 2.5
"""Cost a light of such a piece at most."""
NEARER = (0.85, 0.7)
"""Distances, by that of the wall, from which a plane of the piece's own is looked for."""
LIKELY = (0.01, 0.99)
"""Odds beyond which a region says no more to its neighbours."""
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
    """Odds of the regions, and what follows."""

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
    from scipy import ndimage

    pictures = Pictures.of(view, labels, planes, cost)
    found = Regions.of(pictures.labels)
    probable = odds_of(pictures, found)
    odds = np.zeros(labels.shape)
    odds[view.window] = probable[found.number]
    odds[_holes(view, labels, planes, odds)] = 0.0
    for at in view.points:
        shown, _ = ndimage.label(labels == labels[at])
        odds[shown == shown[at]] = 1.0
    likeliest = float(odds.max())
    behind = odds <= (0.5 if likeliest > 0.5 else max(likeliest / 2, OPEN))
    return Judged(odds, behind, object_in(~behind, view.points))


def _holes(view: View, labels: Labels, planes: list[Array], odds: Array) -> Mask:
    """Pieces (rows, columns) of a wall that are seen through the object: they lie in the hindmost wall there."""
    from scipy import ndimage

    found = np.zeros(labels.shape, bool)
    behind = odds <= 0.5
    walls = [k for k in range(len(planes)) if np.any(behind & (labels == k + 1))]
    for k in walls:
        piece, _ = ndimage.label((labels == k + 1) & ~behind)
        for one in np.setdiff1d(np.flatnonzero(np.bincount(piece.ravel()) >= LEAST_SEEN_THROUGH), [0]):
            if _seen_through(view, planes[k], (piece == one).ravel(), [planes[wall] for wall in walls]):
                found |= piece == one
    return found


def _seen_through(view: View, q: Array, inside: Mask, walls: list[Array]) -> bool:
    """Whether the pixels `inside` (P,) lie in the plane q, the hindmost of the walls there, and not in one of their own before it."""
    image, table = view.image, view.table
    own = np.flatnonzero(inside)
    cost = float(flats.explained(image, table, q, own)[0].mean())
    if cost > SEEN_THROUGH * len(image.signal) or any(
        np.median(image.rays_C[own] @ (wall - q)) < 0 < np.median(image.rays_C[own] @ wall) for wall in walls
    ):
        return False
    trials = [flats.fitted(image, table, q / share, inside, rounds=3) for share in (1.0, *NEARER)]
    return bool(cost - min(float(flats.explained(image, table, one, own)[0].mean()) for one in trials) < flats.CLEARLY_EACH)


def odds_of(pictures: Pictures, found: Regions) -> Array:
    """The odds (N,), 0..1, that regions are the object."""
    first = _odds(regions.own(pictures, found), OWN)
    return _odds(regions.beside(pictures, found, logit(first)), BESIDE)


def logit(odds: Array) -> Array:
    """Log odds (N,), within bounds."""
    sure = np.clip(odds, *LIKELY)
    return np.asarray(np.log(sure / (1 - sure)))


def _odds(clues: Mapping[str, Array], weights: Mapping[str, float]) -> Array:
    total = sum(weights[name] * value for name, value in ({"": 1.0} | dict(clues)).items())
    return np.asarray(1 / (1 + np.exp(-np.clip(total, -30, 30))))


def object_in(mask: Mask, points: Sequence[tuple[int, int]]) -> Mask:
    """A mask (rows, columns) without crumbs and small holes; where points are given it is the pieces that they lie on."""
    from scipy import ndimage

    piece, count = ndimage.label(_opened_but(mask, points))
    if not count:
        return np.zeros(mask.shape, bool)
    size = np.bincount(piece.ravel()).astype(float)
    size[0] = 0
    kept = np.isin(np.arange(count + 1), [piece[at] for at in points]) if points else size >= SMALLEST_PIECE * size.max()
    kept[0] = False
    found = kept[piece]
    hole, _ = ndimage.label(~found)
    area = np.bincount(hole.ravel())
    small = np.flatnonzero(area < HOLE * max(int(found.sum()), 1))
    return np.asarray(found | np.isin(hole, small[small > 0]))


def _opened_but(mask: Mask, points: Sequence[tuple[int, int]]) -> Mask:
    """A mask without what is one pixel thin, but for places of it that are given."""
    from scipy import ndimage

    opened = np.asarray(ndimage.binary_opening(mask))
    for at in points:
        opened[at] = mask[at]
    return opened


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
    """What of an object's outline is open."""

    share: float
    """Area that is expected to be on the wrong side, as a share of the object's."""
    open: float
    """Area of `place`, likewise."""
    place: Mask
    """(rows, columns) where the odds leave open what it is."""
    rival: int
    """The label that most of it has, or whose place it takes."""


def doubt_of(judgement: Judged, labels: Labels) -> Doubt:
    """The doubt of a judgement on labels (rows, columns)."""
    wrong = np.where(judgement.mask, 1 - judgement.odds, judgement.odds)
    place: Mask = wrong > OPEN
    rival = int(np.argmax(np.bincount(labels[place]))) if place.any() else 0
    area = max(int(judgement.mask.sum()), 1)
    return Doubt(float(wrong.sum()) / area, float(place.sum()) / area, place, rival)
