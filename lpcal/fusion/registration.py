r"""Registration of all views and their pieces, and the views that are left out.

1. The large pieces of every view are looked up in those of others at the tracked poses; a view that the others contradict is left out.
2. These pieces are aligned, poses and distances and slow bending at once (`align`); those that no other confirms there are taken back.
3. Every other piece, and the views that were left out, are looked for along their rays (`piece_distances`), until no more are found.
4. All that were found are aligned together. A view that had to move or grow too far is left out; so is a piece that the others contradict,
   and what two views at least see through.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.fusion.align import SHARED, Aligned, PairFit, Start, align, compared, knots_px, placed_view
from lpcal.fusion.consensus import MOST_SCALE_SIGMAS, Doubted, agreement, moved_too_far, outvoted, usual_growth
from lpcal.fusion.correspondences import Placed
from lpcal.fusion.deformation import bending_of
from lpcal.fusion.occlusion import Fronts
from lpcal.fusion.pair_selection import Partners, among, partners_of
from lpcal.fusion.piece_distances import CONTRADICTED, GATE_PX, Among, Piece, cleared, confirmed_share, labels_by_size, only
from lpcal.fusion.views import PlacedView
from lpcal.geometry.arrays import Array
from lpcal.records.outcome import Progress, silent

FEWEST = 2
"""Views that a model takes: of one alone `lpcal reconstruct` makes a mesh."""
LOOKS = 3
"""How often all are aligned anew because pieces were found: where the views stand better, more are."""
LARGE = 0.4
"""Least size of a piece, over that of its view's largest, with which the alignment begins: of a knot every view shows three strands about
as large, and the largest ones alone were of one side of it, which no piece of the other side meets."""
PASSES = 4
"""How often pieces are looked for: those that were found may confirm others."""


@dataclass(frozen=True)
class Registered:
    """Views as aligned, what was left out, and why."""

    aligned: Aligned
    kept: tuple[int, ...]
    """Places in the list of those that were aligned."""
    why: dict[int, str]
    """Why every other view is left out."""
    shares: dict[int, float]
    """Share of each view's largest piece that the others confirm at the tracked poses."""
    pieces: dict[int, tuple[Piece, ...]]
    """The pieces of each view that was aligned."""


def registered(name: str, views: Sequence[PlacedView], H_PC_covariance: Array, progress: Progress = silent) -> Registered:
    """Register views; see the head of this module.

    Raises
    ------
    DegenerateError
        Fewer than two views are left that overlap.
    """
    step_px, partners = knots_px(views), partners_of(views)
    begun = [large_pieces(view) for view in views]
    alone = [only(view, labels) for view, labels in zip(views, begun, strict=True)]
    pairs = compared(alone, H_PC_covariance, step_px, partners)
    shares = agreement(range(len(views)), pairs)
    search = _Search(views, begun, step_px, partners, {one.index: one.why for one in outvoted(len(views), pairs)})
    kept = [k for k in range(len(views)) if k not in search.why]
    progress("views compared", len(kept), len(views))
    _refuse_apart(name, kept, len(views), pairs)
    aligned = align([alone[k] for k in kept], H_PC_covariance, progress, step_px=step_px, partners=among(partners, kept))
    before_m, fresh = aligned.before_m, True
    search.take(aligned, kept)
    for _ in range(LOOKS + len(views)):
        found = search.look()
        if found or not fresh or len(search.kept) < len(kept):
            kept = search.kept
            _refuse_apart(name, kept, len(views), pairs)
            placed, start = [search.shown(k) for k in kept], search.start(kept)
            aligned = align(placed, H_PC_covariance, progress, start, step_px, among(partners, kept))
            search.take(aligned, kept)
        pieces = search.judged(aligned, kept)
        doubt = _doubtful(aligned, kept, pieces)
        fresh = doubt is None
        if doubt is not None and len(search.why) < len(views) // 2 and len(kept) > FEWEST + 1:
            search.drop(doubt)
        elif not found or search.looks >= LOOKS:
            break
    shown = replace(_as_shown(search, aligned, kept, pieces), before_m=before_m)
    return Registered(shown, tuple(kept), {k: why for k, why in search.why.items() if k not in kept}, shares, pieces)


def large_pieces(view: PlacedView) -> list[int]:
    """Labels of a view's pieces with which its alignment begins, the largest first."""
    labels = labels_by_size(view)
    count = np.bincount(view.component[view.witness], minlength=256)
    return [label for label in labels if count[label] >= LARGE * count[labels[0]]]


def _refuse_apart(name: str, kept: Sequence[int], count: int, pairs: dict[tuple[int, int], PairFit]) -> None:
    if len(kept) < FEWEST or not any(pairs[key].agree for key in pairs if set(key) <= set(kept)):
        raise DegenerateError(
            f"{len(kept)} of {count} surfaces agree, and they do not overlap" if len(kept) >= FEWEST else "one surface is left",
            where=name,
            needed="surfaces that overlap, of one object",
            todo="are they placed in one frame, and is the object the same?",
        )


def _doubtful(aligned: Aligned, kept: Sequence[int], pieces: dict[int, tuple[Piece, ...]]) -> Doubted | None:
    """The view that is left out next: nothing of it fits, or it had to move or grow by far more than its sigmas."""
    for k in kept:
        if all(piece.why is not None for piece in pieces[k]):
            return Doubted(k, next(str(piece.why) for piece in pieces[k]))
    moved = moved_too_far(aligned)
    return replace(moved[0], index=kept[moved[0].index]) if moved else None


class _Search:
    """Pieces as they are found one after another."""

    def __init__(
        self, views: Sequence[PlacedView], begun: Sequence[Sequence[int]], step_px: int, partners: Partners, why: dict[int, str]
    ) -> None:
        self.views, self.begun, self.partners = views, begun, partners
        self.mains = [labels[0] for labels in begun]
        self.why = why
        self.bendings = [bending_of(view, step_px) for view in views]
        self.gate_m = GATE_PX * float(np.median([view.footprint_m for view in views]))
        self.found: dict[tuple[int, int], Piece] = {}
        self.shared: Array = np.zeros(SHARED)
        self.own: dict[int, Array] = {}
        self.refused: set[int] = set()
        self.looks = 0

    def take(self, aligned: Aligned, kept: Sequence[int]) -> None:
        """Where the aligned views stand.

        At first their large pieces count as found: the largest where the others do not contradict it there, further ones where one other
        at least confirms them, too.
        """
        first = not self.found
        self.shared, self.own = aligned.parameters[:SHARED], {}
        for place, k in enumerate(kept):
            start = int(aligned.starts[place])
            self.own[k] = aligned.parameters[start : start + 6 + self.bendings[k].size]
            for label, _ in self.views[k].pieces:
                grown = float(self.own[k][6 + self.bendings[k].place[label]] + self.shared[6])
                if (k, label) in self.found:
                    self.found[k, label] = replace(self.found[k, label], delta=grown)
                elif first and label in self.begun[k]:
                    self.found[k, label] = replace(self.piece(k, label), delta=grown)
        if first:
            for k, judged in self.judged(aligned, kept).items():
                for piece in judged:
                    if piece.why is not None or (piece.label != self.mains[k] and piece.supporters < 1):
                        del self.found[k, piece.label]
                if not self.labels(k):
                    del self.own[k]

    def piece(self, view: int, label: int) -> Piece:
        """A piece of which nothing is known."""
        return Piece(view, label, int((self.views[view].component == label).sum()), 0.0, 0)

    @property
    def kept(self) -> list[int]:
        """Views of which a piece is placed."""
        return sorted({k for (k, _), piece in self.found.items() if piece.why is None})

    def labels(self, view: int) -> list[int]:
        """Pieces of a view that are placed."""
        return [label for (k, label), piece in self.found.items() if k == view and piece.why is None]

    def shown(self, view: int) -> PlacedView:
        """A view with the pieces that are placed alone."""
        return only(self.views[view], self.labels(view))

    def start(self, kept: Sequence[int]) -> Start:
        """Where to begin an alignment of some views."""
        grown = [{label: self.found[k, label].delta for label in self.labels(k)} for k in kept]
        return Start(self.shared, [self.own.get(k) for k in kept], grown)

    def state(self) -> list[Placed]:
        """All views where they are thought to stand, with the pieces that are placed."""
        everyone = range(len(self.views))
        start = self.start(everyone)
        shown = [self.shown(k) for k in everyone]
        return start.placed([placed_view(view, bending) for view, bending in zip(shown, self.bendings, strict=True)])

    def look(self) -> bool:
        """Look for every piece that is not placed, again and again while any is found; whether any was.

        Of a view that was left out its largest piece comes first: its distance may change by so many sigmas and not more.
        """
        some = False
        self.looks += 1
        for _ in range(PASSES):
            others = Among(self.state(), self.views, frozenset(self.kept), self.gate_m, self.partners)
            new = {}
            usual = usual_growth([self.found[k, self.mains[k]].delta for k in self.kept if self.mains[k] in self.labels(k)])
            for k, view in enumerate(self.views):
                placed = self.labels(k)
                for label, std in view.pieces:
                    if k in self.refused or label in placed or (not placed and label != self.mains[k]):
                        continue
                    piece = others.look_for(k, label)
                    sigmas = abs(piece.delta - usual) / std
                    if piece.why is None and not placed and sigmas > MOST_SCALE_SIGMAS:
                        by_m = piece.delta * view.distance_m
                        piece = replace(
                            piece, why=f"its distance differs by {1e3 * by_m:+.1f} mm from what fits the others, {sigmas:.1f} sigmas"
                        )
                        self.why[k] = str(piece.why)
                    new[k, label] = piece
            self.found |= new
            if not any(piece.why is None for piece in new.values()):
                return some
            some = True
        return some

    def drop(self, doubt: Doubted) -> None:
        """Leave a view out for good."""
        self.refused.add(doubt.index)
        self.why[doubt.index] = doubt.why
        self.found = {key: piece for key, piece in self.found.items() if key[0] != doubt.index}

    def judged(self, aligned: Aligned, kept: Sequence[int]) -> dict[int, tuple[Piece, ...]]:
        """Every piece of the aligned views with what the others say of it now."""
        said = {}
        fronts = Fronts(aligned.placed, aligned.partners)
        for place, k in enumerate(kept):
            shares, supporters = confirmed_share(fronts, place, self.gate_m)
            pieces = [self.found[k, label] for label, _ in self.views[k].pieces if (k, label) in self.found]
            for at, piece in enumerate(pieces):
                if piece.why is None:
                    contradicted = 100 * (1 - shares[piece.label])
                    why = (
                        f"the others contradict {contradicted:.0f} % of it where it fits best"
                        if contradicted > 100 * CONTRADICTED
                        else None
                    )
                    pieces[at] = replace(piece, supporters=supporters[piece.label], why=why)
            said[k] = tuple(pieces)
        return said


def _as_shown(search: _Search, aligned: Aligned, kept: Sequence[int], pieces: dict[int, tuple[Piece, ...]]) -> Aligned:
    """The aligned views without the pieces that are left out, and without what others see through."""
    views = [only(search.views[k], [one.label for one in pieces[k] if one.why is None]) for k in kept]
    state = [replace(one, view=view) for one, view in zip(aligned.placed, views, strict=True)]
    return cleared(replace(aligned, placed=tuple(state)))
