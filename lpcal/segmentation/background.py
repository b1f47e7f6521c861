r"""Classification of coarse pixels as object or background (wall, support, dark), with probabilities and the mask's uncertainty.

A network (view.network) gives the probability of each pixel from the labelled layers and the depth sweep (segmentation.features); the
remaining uncertainty is the mask's stated doubt. The user's hints are respected: a box replaces the image, and the component under a given
point is the object. `odds` are probabilities, 0..1, throughout.
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
"""File of the network's weights, fitted by tools/fit_mask.py."""
RIM = 2
"""Width of the image border, coarse pixels, from which the prior share of unlit background is estimated."""
HOLE = 0.005
"""Share of the object's area below which a hole is filled, in coarse pixels and at full size."""
SMALLEST_PIECE = 0.08
"""Share of the largest component's area below which a component is dropped from the object."""
LIKELY = (5e-5, 1 - 5e-5)
"""Bounds to which probabilities are clipped before their log odds are taken."""
CARRIED = 5
"""Percentile of a plane's depths that lies in front of the object if the plane is its support; a wall lies behind it altogether."""
OPEN = 0.1
"""Probability of misclassification from which a pixel is reported as doubtful."""


class Layer(IntEnum):
    """Values of the layer map."""

    NOTHING = 0
    """Background without a signal."""
    OBJECT = 1
    SUPPORT = 2
    """The surface under the object."""
    WALL = 3
    """Background behind the object."""


Kind = Literal["support", "wall", "dark", "other"]
"""Kinds of background: the support, a wall, a place that no light reaches, or similar matter that lies in none of the planes."""


@dataclass(frozen=True)
class Judged:
    """Classification of coarse pixels."""

    odds: Array
    """(rows, columns) probability that a pixel is the object, 0..1."""
    behind: Mask
    """(rows, columns) mask of the background."""
    mask: Mask
    """(rows, columns) mask of the object, without small components and small holes."""
    least: float
    """Probability threshold above which a pixel is not background."""

    @property
    def log_odds(self) -> Array:
        """(rows, columns) log odds relative to the threshold, clipped."""
        return logit(self.odds) - logit(self.least)


def judged(view: View, labels: Labels, planes: list[Array], cost: Array, network: Network | None = None) -> Judged:
    """Classify coarse pixels from labels (rows, columns) and costs (layers, rows, columns).

    If no pixel is more probably object than not, the threshold is lowered to half of the largest probability.
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
    """Log odds (rows, columns) that pixels are the object: the mean of the network's outputs for the image and its mirror image."""
    return np.asarray(np.mean(network.answers(channels), axis=0)[0], float)


def all_of(judgement: Judged, lit: Mask) -> Judged:
    """The classification with all lit pixels (rows, columns) as the object, used where no pixel is likely to be the object."""
    return replace(judgement, odds=np.where(lit, LIKELY[1], LIKELY[0]), behind=~lit, mask=lit, least=0.5)


def rim_of(shape: tuple[int, ...]) -> Mask:
    """Mask of the border's pixels for an image of `shape` (rows, columns)."""
    rim = np.ones(shape, bool)
    rim[RIM:-RIM, RIM:-RIM] = False
    return rim


def logit(odds: Array | float) -> Array:
    """Log odds (...) of probabilities, clipped to LIKELY."""
    sure = np.clip(odds, *LIKELY)
    return np.asarray(np.log(sure / (1 - sure)))


def object_in(mask: Mask, points: Sequence[tuple[int, int]]) -> Mask:
    """A mask (rows, columns) without small components and small holes; if points are given, only the components under them."""
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
    """The kind of background that each label would be, for the background mask `behind` (rows, columns) and the object's distance."""
    found: list[Kind] = ["other"]
    for k, q in enumerate(planes, 1):
        own = behind & (labels == k)
        depth = 1 / np.maximum(rays_C.reshape(*labels.shape, 3)[own] @ q, 1e-9)
        found.append("support" if own.any() and np.percentile(depth, CARRIED) < distance_m else "wall")
    return [*found, "dark", "other"]


@dataclass(frozen=True)
class Doubt:
    """Uncertainty of a mask."""

    share: float
    """Expected misclassified area, as a share of the object's area."""
    open: float
    """Area of `place`, as a share of the object's area."""
    place: Mask
    """(rows, columns) mask of doubtful pixels."""
    rival: int
    """The most frequent label of the doubtful pixels."""


def doubt_of(judgement: Judged, labels: Labels) -> Doubt:
    """The uncertainty of a classification of labels (rows, columns)."""
    wrong = np.where(judgement.mask, 1 - judgement.odds, judgement.odds)
    place: Mask = wrong > OPEN
    rival = int(np.argmax(np.bincount(labels[place]))) if place.any() else 0
    area = max(int(judgement.mask.sum()), 1)
    return Doubt(float(wrong.sum()) / area, float(place.sum()) / area, place, rival)
