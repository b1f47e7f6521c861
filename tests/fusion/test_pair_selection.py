"""Which of many views are compared with which."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import lpcal
from fusion_views import scene
from lpcal.fusion import align, pair_selection
from lpcal.fusion.model import shared_covariance
from lpcal.fusion.pair_selection import Partners, among, everyone, partners_of
from lpcal.fusion.views import PlacedView, may_see, view_of
from lpcal.geometry import se3

pytest.importorskip("skimage")


@cache
def round_a_stone(count: int) -> tuple[PlacedView, ...]:
    return tuple(view_of(one, one.placement) for one in scene(count=count).surfaces)


def in_a_row(count: int) -> list[PlacedView]:
    """The same four views of a stone, of stone after stone, each 0.3 m beside the last."""
    found = []
    for k in range(count):
        one = round_a_stone(10)[k % 4]
        aside = se3.transform(np.eye(3), np.array([0.3 * (k // 4), 0.0, 0.0]))
        found.append(replace(one, placement=replace(one.placement, H_AC=aside @ one.placement.H_AC)))
    return found


def mutual(found: Partners) -> bool:
    return all(one in found[other] and one != other for one, others in enumerate(found) for other in others)


def test_few_views_are_all_compared() -> None:
    assert partners_of(round_a_stone(10)) == everyone(10)
    assert everyone(3) == ((1, 2), (0, 2), (0, 1))


def test_of_many_round_one_object_each_has_some_near_and_some_far(monkeypatch: pytest.MonkeyPatch) -> None:
    """Their number does not grow with that of the views, and those that see the other side are none."""
    monkeypatch.setattr(pair_selection, "MOST", 6)
    views = round_a_stone(30)
    found = partners_of(views)
    assert mutual(found)
    assert sum(map(len, found)) / len(found) < 12
    toward = np.array([view.placement.H_AC[:3, 2] for view in views])
    apart = [np.degrees(np.arccos(np.clip(toward[others, :] @ toward[one], -1, 1))) for one, others in enumerate(map(list, found))]
    assert all(some.min() < 35 for some in apart[:-2])  # the last two look from above and from below, alone
    assert all(75 < some.max() < 150 for some in apart)


def test_views_of_other_places_are_not_compared() -> None:
    """Of 10 stones in a row each four views have one another, however many there are in all."""
    found = partners_of(in_a_row(40))
    assert all({other // 4 for other in others} == {one // 4} for one, others in enumerate(found))
    assert mutual(found)


def test_partners_of_some_views_by_their_places_among_them() -> None:
    assert among(((1, 2), (0,), (0, 3), (2,)), [0, 2, 3]) == ((1,), (0, 2), (1,))


def test_views_apart_share_no_block_of_the_normal_equations() -> None:
    """So memory grows with the views: 40 of them on ten stones hold ten times what four on one do, but for what all share."""
    held = []
    for count in (8, 40):
        views = in_a_row(count)
        aligned = align.align(views, shared_covariance(views), partners=partners_of(views))
        held.append(sum(front.L.size + front.below.size for front in aligned.information.fronts) / count)
    assert held[1] < 1.15 * held[0]


@pytest.mark.slow
def test_a_model_by_some_partners_is_as_near_as_by_all(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 48 views of a stone, each compared with about half of the others: the truth is the stone's own distance."""
    found, rms = scene(count=48), []
    for most in (12, 60):
        monkeypatch.setattr(pair_selection, "MOST", most)
        model = lpcal.fuse(found.surfaces)
        off_m = found.off_m(model.vertices_A)
        rms.append(float(np.sqrt(np.mean(off_m**2))))
        assert 0.78 < float(np.mean(np.abs(off_m) < 2 * model.sigma_m)) < 0.97
        assert all(view.used for view in model.views)
    assert rms[0] < 1.15 * rms[1]


def test_no_view_sees_what_has_no_points() -> None:
    """A view whose pieces are all left out has none; the points of its neighbour are seen."""
    one, other = round_a_stone(10)[:2]
    H_AC = one.placement.H_AC
    row, column = np.nonzero(other.witness)
    seen = se3.apply(other.placement.H_AC, other.points_C(row, column))
    assert not may_see(one, H_AC, np.empty((0, 3)))
    assert may_see(one, H_AC, seen)
