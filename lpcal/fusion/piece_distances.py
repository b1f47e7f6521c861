r"""Distance of each piece of a view, confirmed by the other views.

A view may come in pieces that hide each other, and light alone knows the distance of a small one badly: some stood a quarter of their
distance wrong, five of their sigmas. Along its rays a piece has but one freedom. Symbols: x its points, n their normals, s a step of log
distance, a_p and c_p how many other views confirm a point and contradict it there::

    x_p(s) = H_AC (x_p exp(s)),      score(s) = #{p: a_p > 0, a_p >= c_p} - #{p: c_p > a_p}

Normals know nothing of distances: only where the piece really lies do they, the surfaces and all outlines agree. The best s is believed
where two other views confirm it, or one and the piece's own sigma; a piece without such a place is left out, and named.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from lpcal.fusion.align import Aligned, showing
from lpcal.fusion.correspondences import Placed, votes
from lpcal.fusion.occlusion import Fronts
from lpcal.fusion.pair_selection import Partners
from lpcal.fusion.views import PlacedView, may_see
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Index, Mask

GATE_PX = 2.5
"""How far apart two surfaces may be to be taken for one, in footprints of a pixel: views whose poses are tracked alone differ by some."""
POINTS = 150
"""Points of a piece that are looked up: a score is sure to a twelfth."""
FEWEST_POINTS = 12
"""Fewest points of a piece that are looked for: of fewer, chance confirms enough."""
SUPPORT = 0.05
"""Share of a piece's points that a view must confirm to count for it; at wrong distances views confirmed a fiftieth."""
CONFIRMED = 0.12
"""Share of a piece's points that the others must confirm: at its true distance a piece had a fifth and more, at wrong ones a sixteenth."""
FEWEST_SUPPORT = 4
"""Fewest such points."""
CONTRADICTED = 0.4
"""Share of the points that the others judge which they may contradict: some lie at steps that the view has smoothed."""
SECOND = 0.6
"""Share of the best score that no other distance may reach: where two are as good, nothing is known."""
SEEN_THROUGH = 2
"""Views that see through a place of another view from which on it is not shown: one of them may be wrong itself."""
PRIOR_SIGMAS = 2.0
"""By how many of its sigmas a piece may have to move where one view alone confirms it."""


@dataclass(frozen=True)
class Piece:
    """A piece of a view and what the other views say of it."""

    view: int
    label: int
    pixels: int
    delta: float
    """Step of log distance at which it is placed."""
    supporters: int
    """Views that confirm it there."""
    why: str | None = None
    """Why it is left out, in words; None: it is used."""


def labels_by_size(view: PlacedView) -> list[int]:
    """Labels of a view's pieces, that with the most pixels that can be compared first."""
    count = np.bincount(view.component[view.witness], minlength=256)
    return sorted((label for label, _ in view.pieces), key=lambda label: -int(count[label]))


def only(view: PlacedView, labels: Sequence[int]) -> PlacedView:
    """The view with some of its pieces alone."""
    return view.without(~np.isin(view.component, labels))


@dataclass(frozen=True)
class Among:
    """Views that stand where they are thought to, each with the pieces that are placed; a view without any says nothing."""

    state: Sequence[Placed]
    views: Sequence[PlacedView]
    """The same with all their pieces."""
    speaking: frozenset[int]
    """Places of the views that have a piece which is placed, in any order."""
    gate_m: float
    partners: Partners
    """Which views are compared with which."""

    @cached_property
    def fronts(self) -> Fronts:
        """What stands before what."""
        return Fronts(self.state, self.partners)

    def look_for(self, view: int, label: int) -> Piece:
        """The step of log distance at which the others confirm a piece."""
        one = self.state[view]
        row, column = self._points(view, label)
        pixels = int((self.views[view].component == label).sum())
        found = Piece(view, label, pixels, 0.0, 0)
        others = [k for k in self.partners[view] if k in self.speaking]
        if len(row) < FEWEST_POINTS or not others:
            return replace(found, why=f"{len(row)} of its pixels can be compared")
        x_C = self.views[view].points_C(row, column)
        n_A = se3.rotate(one.H_AC, self.views[view].normals_C[row, column])
        steps = self._steps(one, x_C, others)
        agree, contradict = np.zeros((2, len(steps), len(row)), np.int16)
        support = np.zeros((len(steps), len(self.state)), np.intp)
        p_A = se3.apply(one.H_AC, (np.exp(steps)[:, None, None] * x_C).reshape(-1, 3))
        many = np.tile(n_A, (len(steps), 1))
        for k in others:
            if may_see(self.state[k].view, self.state[k].H_AC, p_A):
                yes, no = (found.reshape(len(steps), -1) for found in votes((p_A, many), self.state[k], self.gate_m))
                agree += yes
                contradict += no
                support[:, k] = yes.sum(axis=1)
        contradict = contradict + self.fronts.deny(view, row, column, np.exp(steps)[:, None] * x_C[:, 2], self.gate_m)
        confirmed, denied = ((agree > 0) & (agree >= contradict)).sum(axis=1), (contradict > agree).sum(axis=1)
        return self._believed(found, steps, confirmed, denied, support, len(row))

    def _believed(self, piece: Piece, steps: Array, confirmed: Index, denied: Index, support: Index, count: int) -> Piece:
        """The best step, if it is to be believed."""
        view, std = self.views[piece.view], dict(self.views[piece.view].pieces)[piece.label]
        score = confirmed - denied
        best = int(np.argmax(score))
        # a broad peak's middle: steps that are as good but for chance
        top = score >= score[best] - max(0.1 * abs(score[best]), 1)
        near = np.abs(steps - steps[best]) < 2 * self.gate_m / view.distance_m
        delta = float(np.average(steps[top & near], weights=np.maximum(score[top & near], 1)))
        supporters = int((support[best] >= max(SUPPORT * count, FEWEST_SUPPORT)).sum())
        elsewhere = np.abs(steps - steps[best]) > 4 * self.gate_m / view.distance_m
        second = int(score[elsewhere].max(initial=0))
        found = replace(piece, delta=delta, supporters=supporters)
        if confirmed[best] < CONFIRMED * count or supporters < 1:
            return replace(found, why="no other view confirms it at any distance")
        if denied[best] > CONTRADICTED * (confirmed[best] + denied[best]):
            return replace(found, why=f"where {supporters} other views confirm it best, more of it is contradicted than they allow")
        if second > SECOND * score[best]:
            return replace(found, why="the other views confirm it at two distances alike")
        if supporters < 2 and abs(delta) > PRIOR_SIGMAS * std:
            by_m = delta * view.distance_m
            return replace(
                found, why=f"one other view alone confirms it, {1e3 * by_m:+.1f} mm from its distance, {abs(delta) / std:.0f} sigmas"
            )
        return found

    def _points(self, view: int, label: int) -> tuple[Index, Index]:
        row, column = np.nonzero((self.views[view].component == label) & self.views[view].witness)
        some = np.unique(np.linspace(0, len(row) - 1, min(POINTS, len(row))).astype(int)) if len(row) else np.zeros(0, int)
        return row[some], column[some]

    def _steps(self, one: Placed, x_C: Array, others: Sequence[int]) -> Array:
        """Steps at which the piece may lie: those that bring it to where other views show anything among its rays."""
        plane = x_C[:, :2] / x_C[:, 2:]
        spare = 2 * self.gate_m / float(x_C[:, 2].min())
        low, high = plane.min(axis=0) - spare, plane.max(axis=0) + spare
        near, far = np.inf, 0.0
        for k in others:
            points = se3.apply(se3.inv(one.H_AC), self.state[k].points()[0])
            z = points[points[:, 2] > 1e-6, 2]
            x, y = (points[points[:, 2] > 1e-6, axis] / z for axis in range(2))
            z = z[(x > low[0]) & (x < high[0]) & (y > low[1]) & (y < high[1])]
            near, far = min(near, float(z.min(initial=np.inf))), max(far, float(z.max(initial=0)))
        if far <= 0:
            return np.zeros(1)
        first, last = np.log((near - self.gate_m) / x_C[:, 2].max()), np.log((far + self.gate_m) / x_C[:, 2].min())
        return np.arange(first, last, self.gate_m / 2 / one.view.distance_m)


def confirmed_share(fronts: Fronts, place: int, gate_m: float) -> tuple[dict[int, float], dict[int, int]]:
    """The share of every piece's judged points that the others confirm, and how many views confirm some of it, by the labels of a view.

    The share is 1 where they judge too few.
    """
    one = fronts.state[place]
    p_A, n_A, from_A = one.points()
    label = one.view.component[one.row, one.column]
    numbers = [number for number, _ in one.view.pieces]
    size = np.bincount(label, minlength=256)
    agree, contradict, supporters = np.zeros(len(p_A), np.intp), np.zeros(len(p_A), np.intp), np.zeros(256, np.intp)
    for other in (fronts.state[k] for k in fronts.partners[place]):
        if may_see(other.view, other.H_AC, p_A):
            yes, no = votes((p_A, n_A), other, gate_m)
            agree += yes
            contradict += no
            supporters += np.bincount(label[yes], minlength=256) >= np.maximum(SUPPORT * size, FEWEST_SUPPORT)
    contradict += fronts.deny(place, one.row, one.column, from_A @ one.H_AC[:3, 2], gate_m)
    confirmed = np.bincount(label[(agree > 0) & (agree >= contradict)], minlength=256)
    judged = confirmed + np.bincount(label[contradict > agree], minlength=256)
    share = np.where(judged >= FEWEST_POINTS, confirmed / np.maximum(judged, 1), 1.0)
    return {number: float(share[number]) for number in numbers}, {number: int(supporters[number]) for number in numbers}


def seen_through(fronts: Fronts, place: int, gate_m: float, outvoted: int) -> Mask:
    """Pixels (H, W) of a placed view that at least so many others contradict, and more than confirm them."""
    one = fronts.state[place]
    row, column = np.nonzero(one.view.witness)
    p_A, n_A, from_A = replace(one, row=row, column=column).points()
    agree, contradict = np.zeros((2, len(row)), np.int16)
    for other in (fronts.state[k] for k in fronts.partners[place]):
        if may_see(other.view, other.H_AC, p_A):
            yes, no = votes((p_A, n_A), other, gate_m)
            agree += yes
            contradict += no
    contradict = contradict + fronts.deny(place, row, column, from_A @ one.H_AC[:3, 2], gate_m)
    gone = np.zeros(one.view.witness.shape, bool)
    bad = (contradict >= outvoted) & (contradict > agree)
    gone[row[bad], column[bad]] = True
    return gone


def cleared(aligned: Aligned) -> Aligned:
    """Aligned views without the pixels that SEEN_THROUGH others at least contradict, and more than confirm them."""
    fronts = Fronts(aligned.placed, aligned.partners)
    gate_m = GATE_PX * float(np.median([one.view.footprint_m for one in aligned.placed]))
    gone = [seen_through(fronts, place, gate_m, SEEN_THROUGH) for place in range(len(aligned.placed))]
    return replace(aligned, placed=tuple(showing(one, one.view.without(mask)) for one, mask in zip(aligned.placed, gone, strict=True)))
