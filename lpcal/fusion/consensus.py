r"""Outlier views: those whose pose, distance or object the others contradict.

Symbols: for views i, j at their tracked poses, of the points of i that j should have seen::

    A_ij = agree / (agree + contradict),      A_i = sum_j weight A / sum_j weight   over both ways round

A view that stands elsewhere puts its points where others see through, or sees through theirs. The worst is left out, the rest is judged
again without it, until all that are left agree: each with most of the others. After the alignment a view that had to move, or to grow, by
far more than its sigmas say is left out as well, and the rest is aligned again.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.fusion.align import Aligned, PairFit
from lpcal.geometry.arrays import Array

LEAST_AGREEMENT = 0.75
"""Least share of a view's points that the others must confirm: whole sessions had 0.9 and more, a view 20 mm off had under 0.6."""
BELOW_OTHERS = 0.12
"""How far under the median view's share a view must lie to be left out: where all views are poor, none is the odd one."""
FEWEST_POINTS = 30
"""Fewest points in common that say anything of a pair."""
MOST_SIGMAS = 6.0
"""By how many sigmas, over all six parameters of a pose, a view may have moved in the alignment."""
FEWEST_JUDGES = 2
"""Views that must judge another for it to be left out at its tracked pose: of two that differ nobody knows which is wrong."""
MOST_SCALE_SIGMAS = 2.75
"""By how many of its sigmas the distance of a view's largest piece may have changed otherwise than the others': of 95 right views of six
simulated sessions it was 1.7 in all but one of 2.6, of a view 20 mm too near or too far it is 2.9 and more."""
FEWEST_OTHERS = 3
"""Views of which the middle one says what distances were changed by usually: of fewer one wrong one is half of it."""


@dataclass(frozen=True)
class Doubted:
    """A view that is left out: its place in the list, and why, in words."""

    index: int
    why: str
    agreement: float = 0.0
    """The share of it that the others confirm at its tracked pose."""


def outvoted(count: int, pairs: Mapping[tuple[int, int], PairFit]) -> list[Doubted]:
    """The views that the others contradict at their tracked poses, the worst first."""
    out: list[Doubted] = []
    while count - len(out) > 2:
        left = [k for k in range(count) if k not in {one.index for one in out}]
        share = agreement(left, pairs)
        judged = {k: value for k, value in share.items() if np.isfinite(value) and len(_judges(k, left, pairs)) >= FEWEST_JUDGES}
        if len(judged) < 3:
            break
        worst = min(judged, key=lambda k: judged[k])
        usual = float(np.median(list(judged.values())))
        if judged[worst] >= min(LEAST_AGREEMENT, usual - BELOW_OTHERS):
            break
        why = f"the others confirm {100 * judged[worst]:.0f} % of it, and {100 * usual:.0f} % of each other"
        out.append(Doubted(worst, why, judged[worst]))
    return out


def agreement(left: Sequence[int], pairs: Mapping[tuple[int, int], PairFit]) -> dict[int, float]:
    """The share of each view's points that the other ones confirm; NaN where too few say anything.

    A view's share is the median over its partners, so that one wrong partner does not spoil it.
    """
    found = {}
    for k in left:
        said = _judges(k, left, pairs)
        weights = np.array([agree + contradict for agree, contradict in said])
        shares = np.array([agree / (agree + contradict) for agree, contradict in said])
        found[k] = _weighted_median(shares, weights) if said else float("nan")
    return found


def _judges(k: int, left: Sequence[int], pairs: Mapping[tuple[int, int], PairFit]) -> list[tuple[int, int]]:
    """How many points of a view every other one that says anything of it confirms, and contradicts."""
    found = []
    for other in left:
        both = [pairs[key] for key in ((k, other), (other, k)) if key in pairs]
        agree, contradict = sum(one.agree for one in both), sum(one.contradict for one in both)
        if agree + contradict >= FEWEST_POINTS:
            found.append((agree, contradict))
    return found


def moved_too_far(aligned: Aligned) -> list[Doubted]:
    """Views that the alignment moved or scaled by far more than their sigmas say, the worst first; only the worst is sure."""
    found: list[tuple[float, Doubted]] = []
    growths = [_grown(aligned, k) for k in range(len(aligned.placed))]
    usual = usual_growth([grown for grown, _ in growths])
    for k, (one, (grown, std)) in enumerate(zip(aligned.placed, growths, strict=True)):
        sigmas, scale_sigmas = _moved_sigmas(aligned, k), abs(grown - usual) / std
        if sigmas > MOST_SIGMAS:
            at = one.H_AC[:3, 3] - one.view.placement.H_AC[:3, 3]
            why = f"it fits the others {1e3 * np.linalg.norm(at):.1f} mm beside its pose, {sigmas:.0f} sigmas"
            found.append((sigmas / MOST_SIGMAS, Doubted(k, why)))
        elif scale_sigmas > MOST_SCALE_SIGMAS:
            why = (
                f"its distance differs by {1e3 * (grown - usual) * one.view.distance_m:+.1f} mm from what fits the others, "
                f"{scale_sigmas:.1f} sigmas"
            )
            found.append((scale_sigmas / MOST_SCALE_SIGMAS, Doubted(k, why)))
    return [doubt for _, doubt in sorted(found, key=lambda each: -each[0])]


def _moved_sigmas(aligned: Aligned, place: int) -> float:
    """By how many sigmas, over all six parameters of its pose, a view moved."""
    xi, covariance = aligned.shift(place)
    squared = float(xi @ np.linalg.solve(covariance + 1e-16 * np.eye(6), xi))
    return float(np.sqrt(max(squared, 0.0) / 6))


def _grown(aligned: Aligned, place: int) -> tuple[float, float]:
    """By how much the distance of the largest piece that a view shows grew, relative, and its standard deviation."""
    view, start = aligned.placed[place].view, aligned.starts[place] + 6
    sizes = [int((view.component[view.witness] == label).sum()) for label, _ in view.pieces]
    largest = int(np.argmax(sizes))
    return float(aligned.parameters[start + largest]), view.pieces[largest][1]


def usual_growth(deltas: Sequence[float]) -> float:
    """By how much some views' log distances grew usually: what lights that are off do to all of them is no view's mistake."""
    return float(np.median(deltas)) if len(deltas) >= FEWEST_OTHERS else 0.0


def _weighted_median(values: Array, weights: Array) -> float:
    order = np.argsort(values)
    total = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(total, total[-1] / 2)])
