"""What other views show before a view's surface: a part that lies too deep, which hides nothing, is contradicted all the same."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fusion_views import scene
from lpcal.fusion.align import knots_px, placed_view
from lpcal.fusion.deformation import bending_of
from lpcal.fusion.occlusion import Fronts, before
from lpcal.fusion.pair_selection import everyone
from lpcal.fusion.views import view_of
from lpcal.geometry import se3
from lpcal.geometry.arrays import Index, Mask

DENTED = 1


def dented(deeper: float) -> tuple[Fronts, Mask, float]:
    """The stone's views, a patch of one of them off by a share of its depth; the patch in its window, and a gate."""
    surfaces = list(scene().surfaces)
    first = surfaces[DENTED]
    row, column = np.indices(first.mask.shape)
    low, high = np.argwhere(first.mask).min(axis=0), np.argwhere(first.mask).max(axis=0)
    patch = ((row - (low[0] + high[0]) / 2) ** 2 + (column - (low[1] + high[1]) / 2) ** 2) < 6.0**2
    surfaces[DENTED] = replace(first, depth=(first.depth * (1 + deeper * patch)).astype(np.float32))
    views = [view_of(one, one.placement) for one in surfaces]
    state = [placed_view(view, bending_of(view, knots_px(views))) for view in views]
    return Fronts(state, everyone(len(state))), patch[state[DENTED].view.at], 2.5 * views[0].footprint_m


def denials(fronts: Fronts, place: int, gate_m: float) -> tuple[Index, Index, Index]:
    """How many views deny each pixel that can be compared, and its row and column."""
    view = fronts.state[place].view
    row, column = np.nonzero(view.witness)
    return fronts.deny(place, row, column, view.depth[row, column].astype(float), gate_m), row, column


def test_what_lies_too_deep_is_denied_by_what_others_show_before_it() -> None:
    """A dent 35 mm deep: nearly all of its pixels, and hardly one beside it."""
    fronts, patch, gate_m = dented(0.1)
    count, row, column = denials(fronts, DENTED, gate_m)
    inside = patch[row, column]
    assert np.mean(count[inside] > 0) > 0.8
    assert np.mean(count[~inside] > 0) < 0.02


def test_right_surfaces_and_what_stands_too_near_are_not_denied() -> None:
    """What stands too near is before others: they are denied by it, and `correspondences` counts it against itself."""
    of_others = []
    for deeper in (0.0, -0.02):
        fronts, _, gate_m = dented(deeper)
        assert np.mean(denials(fronts, DENTED, gate_m)[0] > 0) < 0.02
        others = np.concatenate([denials(fronts, place, gate_m)[0] for place in range(len(fronts.state)) if place != DENTED])
        assert np.mean(others > 0) < 0.02
        of_others.append(int((others > 0).sum()))
    assert of_others[1] > of_others[0]


def test_depths_of_what_others_show_are_those_of_their_points() -> None:
    """Never nearer than the surface is, and behind it by no more than it slopes within some pixels."""
    fronts, _, gate_m = dented(0.0)
    one = fronts.state[DENTED]
    found = [before(one, points) for points in fronts.points]
    shown = np.array([map_ for k, map_ in enumerate(found) if map_ is not None and k != DENTED])
    there = np.isfinite(shown) & one.view.witness
    off = (shown - one.view.depth)[there]
    assert there.sum() > 300
    assert np.percentile(off, 2) > -gate_m
    assert np.median(off) < 2 * gate_m
    behind = replace(one, H_AC=one.H_AC @ se3.transform(np.eye(3), np.array([0.0, 0.0, 1.0])))  # past the object, looking away
    assert all(before(behind, points) is None for points in fronts.points)
