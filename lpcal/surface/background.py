"""Which labels are the object and which the wall behind it or the support under it, by what planes do at the image's border.

A plane that reaches the border is wall or support, unless the surface goes on from it without a crease: then it is a flat part of an object
that the border cuts. The user may say where the object is: a box takes the place of the border, and what a given point shows is the object.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.surface import flats
from lpcal.surface.coarse import Coarse, LightTable
from lpcal.surface.flats import Sweep

RIM = 2
"""Coarse pixels at the image's border: a plane that reaches them is wall or support."""
SMALLEST_PIECE = 0.08
"""Share of the largest piece under which a piece is dropped."""
HOLE = 0.005
"""Share of the object's area under which a hole in it is filled."""
NO_CREASE, MOSTLY, BESIDE = 0.97, 0.5, 2
"""Cosine (14 degrees) of normals that go on smoothly, share of an edge along which what lies beside it decides, and its width in coarse
pixels."""
FEWEST_BESIDE = 30
"""Coarse pixels beside a plane from which it is asked whether the surface goes on."""
LEAST_SEEN_THROUGH = 6
"""Coarse pixels of a piece of a wall from which it is asked whether it is seen through the object."""
SEEN_THROUGH = 2.5
"""Cost a light of such a piece at most."""
NEARER = (0.85, 0.7)
"""Distances, by that of the wall, from which a plane of the piece's own is looked for."""
INNER = 0.15
"""Share of the largest piece from which one that does not touch the border goes before all that do."""
CARRIED = 5
"""Percentile of a plane's depths that lies before the object where the plane carries it: a wall lies behind it altogether."""
WEAK = 5.0
"""Difference of costs, averaged over 3x3 pixels, under which a pixel's side is in doubt."""

NOTHING, OBJECT, SUPPORT, WALL = 0, 1, 2, 3
"""Values of a map of layers: no light comes back; the object; what carries it; what stands behind it."""
Kind = Literal["support", "wall", "dark", "other"]
"""What a pixel may be instead of the object: its support, a wall, a place that no light reaches, or matter like theirs in no plane."""


@dataclass(frozen=True)
class View:
    """What labels are judged by; the user's hints are none by default."""

    image: Coarse
    table: LightTable
    swept: Sweep
    allowed: Mask | None = None
    """(rows, columns) where the object may be."""
    points: tuple[tuple[int, int], ...] = ()
    """Rows and columns of places that show it."""

    @property
    def normals(self) -> Array:
        """Normals (rows, columns, 3) of matter of any normal."""
        return self.image.image(self.swept.normals)


def rim_of(shape: tuple[int, ...]) -> Mask:
    """The coarse pixels (rows, columns) at the border."""
    rim = np.ones(shape, bool)
    rim[RIM:-RIM, RIM:-RIM] = False
    return rim


def background_of(labels: Labels, planes: list[Array], view: View) -> Mask:
    """Pixels (rows, columns) of planes that reach the border, of nothing, and of other matter that lies among these.

    A piece within the object is seen through it where it lies in the hindmost of the planes that reach the border. Other matter that has
    the object beside it is a part of the object of another albedo.
    """
    from scipy import ndimage

    found = labels == len(planes) + 1
    rim = rim_of(labels.shape)
    if view.allowed is not None:
        found, rim = found | ~view.allowed, rim | ~view.allowed
    pieces = [ndimage.label(labels == k)[0] for k in range(1, len(planes) + 1)]
    shown = [{int(piece[at]) for at in view.points} - {0} for piece in pieces]
    walls = []
    for piece, q, ours in zip(pieces, planes, shown, strict=True):
        for one in np.setdiff1d(piece[rim], [0, *ours]):
            if not _goes_on(piece == one, q, labels, view.normals):
                found |= piece == one
        if np.any(found & (piece > 0)):
            walls.append(q)
    for piece, q, ours in zip(pieces, planes, shown, strict=True):
        size = np.bincount(piece.ravel())
        for one in np.setdiff1d(np.flatnonzero(size >= LEAST_SEEN_THROUGH), [0, *ours, *np.unique(piece[rim])]):
            if any(q is wall for wall in walls) and _seen_through(view, q, (piece == one).ravel(), walls):
                found |= piece == one
    found |= _among(labels == len(planes) + 2, found)
    for at in view.points:
        same, _ = ndimage.label(labels == labels[at])
        found &= same != same[at]
    return np.asarray(found)


def _among(matter: Mask, found: Mask) -> Mask:
    """The connected components of `matter` (rows, columns) that lie mostly among what was `found` to be background."""
    from scipy import ndimage

    piece, count = ndimage.label(matter)
    kept = np.zeros(count + 1, bool)
    for one in range(1, count + 1):
        beside = ndimage.binary_dilation(piece == one, iterations=BESIDE) & ~matter
        kept[one] = not beside.any() or found[beside].mean() > MOSTLY
    return np.asarray(kept[piece])


def _goes_on(own: Mask, q: Array, labels: Labels, n_free: Array) -> bool:
    """Whether matter of any normal goes on without a crease from a piece `own` (rows, columns) of a plane (3,)."""
    from scipy import ndimage

    smooth = n_free @ (-q / np.linalg.norm(q)) > NO_CREASE
    beside = ndimage.binary_dilation(own, iterations=BESIDE) & (labels == 0)
    return bool(beside.sum() > FEWEST_BESIDE and smooth[beside].mean() > MOSTLY)


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


def object_of(labels: Labels, planes: list[Array], view: View) -> Mask:
    """The object (rows, columns): what is no background, without crumbs; pieces that hang on the border only where there is no other.

    Where points are given it is the pieces that they lie on.
    """
    from scipy import ndimage

    piece, count = ndimage.label(_opened_but(~background_of(labels, planes, view), view.points))
    if not count:
        return np.zeros(labels.shape, bool)
    if view.points:
        kept = np.isin(np.arange(count + 1), [piece[at] for at in view.points])
    else:
        size = np.bincount(piece.ravel()).astype(float)
        size[0] = 0
        touches = np.isin(np.arange(count + 1), np.concatenate([piece[:1].ravel(), piece[-1:].ravel(), piece[:, 0], piece[:, -1]]))
        inner = float((size * ~touches).max())
        kept = ~touches & (size >= SMALLEST_PIECE * inner) if inner > INNER * size.max() else size == size.max()
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
    """What of an object's outline hangs on weak evidence."""

    share: float
    """Area that might as well be of the object, or not of it, as a share of the object's."""
    place: Mask
    """(rows, columns) that area."""
    rival: int
    """The layer that most of it may belong to."""


def doubt_of(labels: Labels, cost: Array, mask: Mask, planes: int, ceiling: float) -> Doubt:
    """The doubt of an object (rows, columns) by the costs (layers, rows, columns) of its layers: they differ by less than WEAK."""
    from scipy import ndimage

    here, everywhere = (np.bincount(one.ravel(), minlength=len(cost))[: len(cost)] for one in (labels[mask], labels))
    ours = (2 * here > everywhere) & (np.arange(len(cost)) <= planes)
    ours[0] = True
    others = np.where(ours[:, None, None], np.inf, cost)
    theirs, rival = others.min(axis=0), np.argmin(others, axis=0)
    mine = np.where(ours[:, None, None], cost, np.inf).min(axis=0)
    difference = ndimage.uniform_filter(np.clip(theirs - mine, -ceiling, ceiling), 3)
    about = ndimage.binary_dilation(mask, iterations=max(1, int(np.sqrt(mask.sum()) / 4)))
    wrong: Mask = about & np.where(mask, difference < WEAK, difference > -WEAK)
    most = int(np.argmax(np.bincount(rival[wrong], minlength=len(cost)))) if wrong.any() else len(cost) - 1
    return Doubt(float(np.sum(wrong)) / max(int(np.sum(mask)), 1), wrong, most)
