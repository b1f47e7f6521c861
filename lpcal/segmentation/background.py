r"""Which coarse pixels are the object and which the wall behind it or the support under it: odds, and how far they leave the mask open.

The odds are those of a network (view.network) that sees what the layers and the sweep of depths say (segmentation.features). What they
leave uncertain is the mask's stated doubt. The user may say where the object is: a box takes the place of the image, and what a given point
shows is the object.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import IntEnum
from pathlib import Path
from typing import Literal

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.segmentation import features
from lpcal.segmentation.features import View
from lpcal.view.constants import UNLIKELY
from lpcal.view.network import Network

FITTED = Path(__file__).with_name("mask_network.npz")
"""Where the network's weights are that tools/fit_mask.py has fitted."""
RIM = 2
"""Coarse pixels at the image's border, of which those without light say what share of the picture shows nothing."""
HOLE = 0.005
"""Share of the object's area under which a hole in it is filled, in coarse pixels and in full size."""
SMALLEST_PIECE = 0.08
"""Share of the object's largest piece under which a piece is dropped from it."""
LIKELY = (5e-5, 1 - 5e-5)
"""Odds beyond which it makes no difference how sure a coarse pixel is."""
CARRIED = 5
"""Percentile of a plane's depths that lies before the object where the plane carries it: a wall lies behind it altogether."""
OPEN = 0.1
"""Odds that a pixel is on the other side from which it is named as doubtful."""


class Layer(IntEnum):
    """Values of a map of layers."""

    NOTHING = 0
    """No light comes back."""
    OBJECT = 1
    SUPPORT = 2
    """What carries the object."""
    WALL = 3
    """What stands behind it."""


Kind = Literal["support", "wall", "dark", "other"]
"""What a pixel may be instead of the object: its support, a wall, a place that no light reaches, or matter like theirs in no plane."""


@dataclass(frozen=True)
class Judged:
    """Odds of coarse pixels, and what follows."""

    odds: Array
    """(rows, columns) that a pixel is the object, 0..1."""
    behind: Mask
    """(rows, columns) what is not."""
    mask: Mask
    """(rows, columns) the object, without crumbs and small holes."""
    least: float
    """Odds above which a pixel is not behind."""

    @property
    def log_odds(self) -> Array:
        """(rows, columns) natural logarithms of the odds over the least ones, within bounds."""
        return logit(self.odds) - logit(self.least)


def judged(view: View, labels: Labels, planes: list[Array], cost: Array, network: Network | None = None) -> Judged:
    """What is the object, from labels (rows, columns) and their costs (layers, rows, columns).

    Where nothing is rather the object than not, it is what is likeliest.
    """
    log_odds = log_odds_by(network or Network.read(FITTED), features.channels(view, labels, planes, cost))
    odds = np.zeros(labels.shape)
    odds[view.window] = 1 / (1 + np.exp(-np.clip(log_odds, -30, 30)))
    for at in view.points:
        shown, _ = raster.connected_components(labels == labels[at])
        odds[shown == shown[at]] = 1.0
    likeliest = float(odds.max())
    least = 0.5 if likeliest > 0.5 else max(likeliest / 2, UNLIKELY)
    return Judged(odds, odds <= least, object_in(odds > least, view.points), least)


def log_odds_by(network: Network, channels: Mapping[str, Array]) -> Array:
    """Log odds (rows, columns) that pixels are the object: the mean of the network's answers on a picture and on its mirror image."""
    return np.asarray(np.mean(network.answers(channels), axis=0)[0], float)


def all_of(judgement: Judged, lit: Mask) -> Judged:
    """All that is lit (rows, columns) as the object, where nothing in the picture is likely to be it."""
    return replace(judgement, odds=np.where(lit, LIKELY[1], LIKELY[0]), behind=~lit, mask=lit, least=0.5)


def rim_of(shape: tuple[int, ...]) -> Mask:
    """The coarse pixels (rows, columns) at the border."""
    rim = np.ones(shape, bool)
    rim[RIM:-RIM, RIM:-RIM] = False
    return rim


def logit(odds: Array | float) -> Array:
    """Log odds (...) of odds, within bounds."""
    sure = np.clip(odds, *LIKELY)
    return np.asarray(np.log(sure / (1 - sure)))


def object_in(mask: Mask, points: Sequence[tuple[int, int]]) -> Mask:
    """A mask (rows, columns) without crumbs and small holes; where points are given it is the pieces that they lie on."""
    piece, count = raster.connected_components(mask)
    if not count:
        return np.zeros(mask.shape, bool)
    size = np.bincount(piece.ravel()).astype(float)
    size[0] = 0
    kept = np.isin(np.arange(count + 1), [piece[at] for at in points]) if points else size >= SMALLEST_PIECE * size.max()
    kept[0] = False
    found = kept[piece]
    hole, _ = raster.connected_components(~found)
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
