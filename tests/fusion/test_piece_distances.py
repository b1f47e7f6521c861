"""Pieces of a view: found along their rays where several others confirm them, else left out and named."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import lpcal
from fusion_views import Scene, scene
from lpcal.fusion import detail
from lpcal.fusion.consensus import MOST_SCALE_SIGMAS
from lpcal.fusion.model import shared_covariance
from lpcal.fusion.piece_distances import labels_by_size
from lpcal.fusion.registration import large_pieces, registered
from lpcal.fusion.views import view_of
from lpcal.geometry import se3
from lpcal.geometry.arrays import Mask
from lpcal.records.model import ObjectModel
from lpcal.records.surface import Component, Surface

pytest.importorskip("skimage")

STD = 0.04
"""Relative standard deviation of a torn-off piece's distance."""


@cache
def whole() -> tuple[Scene, ObjectModel]:
    """Ten views of a stone, fused."""
    found = scene()
    return found, lpcal.fuse(found.surfaces, step_m=0.0024)


def rms_m(model: ObjectModel) -> float:
    """Of a model of the stone."""
    return float(np.sqrt(np.mean(scene().off_m(model.vertices_A) ** 2)))


def torn(surface: Surface, grown: float, where: Callable[[Mask], Mask], std: float = STD) -> Surface:
    """The surface with some of its pixels as a second piece whose distance is off by a step of its logarithm."""
    piece = surface.mask & where(surface.mask)
    breaks = surface.breaks.copy()
    breaks[0, :, :-1] |= piece[:, :-1] != piece[:, 1:]
    breaks[1, :-1] |= piece[:-1] != piece[1:]
    return replace(
        surface,
        depth=np.where(piece, surface.depth * np.exp(grown), surface.depth).astype(np.float32),
        component=np.where(piece, 2, surface.component).astype(np.uint8),
        components=(*surface.components, Component(2, int(piece.sum()), 0.35, std)),
        breaks=breaks,
    )


def right_part(share: float) -> Callable[[Mask], Mask]:
    """The rightmost columns of a mask."""

    def where(mask: Mask) -> Mask:
        columns = np.flatnonzero(mask.any(axis=0))
        return np.broadcast_to(np.arange(mask.shape[1]) > columns[0] + (1 - share) * np.ptp(columns), mask.shape)

    return where


def upper_part(share: float) -> Callable[[Mask], Mask]:
    """The topmost rows of a mask."""

    def where(mask: Mask) -> Mask:
        rows = np.flatnonzero(mask.any(axis=1))
        return np.broadcast_to((np.arange(mask.shape[0]) < rows[0] + share * np.ptp(rows))[:, None], mask.shape)

    return where


def test_pieces_that_are_large_begin_together() -> None:
    """Every view in two halves, each with an error of its own: of five views the upper half is larger, of five the lower.

    No larger half meets one of the other kind; all are placed, and those of a view stand apart by as much as they were torn apart.
    """
    rng, apart, surfaces = np.random.default_rng(5), [], []
    for k, surface in enumerate(scene().surfaces):
        apart.append(float(rng.normal(0, 0.015)))
        surfaces.append(torn(surface, apart[-1], upper_part(0.55 if k % 2 else 0.45), std=0.018))
    views = [view_of(one, one.placement) for one in surfaces]
    assert all(len(large_pieces(view)) == 2 for view in views)
    found = registered("stone", views, shared_covariance(views))
    assert found.kept == tuple(range(10))
    for k, pieces in found.pieces.items():
        by_label = {piece.label: piece for piece in pieces}
        assert all(piece.why is None for piece in pieces)
        assert by_label[2].delta - by_label[1].delta == pytest.approx(-apart[k], abs=0.004)


@pytest.mark.parametrize("grown", [-0.2, 0.13])
def test_a_piece_that_stands_far_off_is_placed_by_the_others(grown: float) -> None:
    """A third of a view 70 mm too near, or 45 mm too far: where it lies is known once the others are asked."""
    surfaces = list(scene().surfaces)
    surfaces[2] = torn(surfaces[2], grown, right_part(0.35))
    model = lpcal.fuse(surfaces, step_m=0.0024)
    large, small = model.views[2].pieces
    assert small.why is None
    assert large.why is None
    assert small.supporters >= 2
    off_m = float(np.median((scene().surfaces[2].depth - surfaces[2].depth)[surfaces[2].component == 2]))
    assert small.distance_change_m == pytest.approx(off_m, abs=0.004)
    assert not model.warnings
    assert rms_m(model) < 1.1 * rms_m(whole()[1])


def test_many_pieces_that_stand_off_do_not_spoil_each_other() -> None:
    """Every view in two pieces, all small ones wrong by up to a fifth: each is found, and the model is as if none were."""
    rng = np.random.default_rng(5)
    surfaces = [torn(one, float(rng.uniform(-0.2, 0.2)), right_part(float(rng.uniform(0.15, 0.45)))) for one in scene().surfaces]
    model = lpcal.fuse(surfaces, step_m=0.0024)
    assert all(view.used for view in model.views)
    assert sum(piece.why is None for view in model.views for piece in view.pieces) >= 19
    assert rms_m(model) < 1.15 * rms_m(whole()[1])


def test_a_piece_that_fits_nowhere_is_named_and_left_out() -> None:
    """Part of something else: no other view confirms it at any distance, and the model is as it was."""
    surfaces = list(scene().surfaces)
    piece = torn(surfaces[2], -0.1, right_part(0.35))
    turned = se3.rotation(np.array([0.0, 0.9, 0.5]))
    strange = np.where((piece.component == 2)[..., None], se3.rotate(turned, piece.normals), piece.normals)
    surfaces[2] = replace(piece, normals=strange.astype(np.float32))
    model = lpcal.fuse(surfaces, step_m=0.0024)
    large, small = model.views[2].pieces
    assert large.why is None
    assert small.why is not None
    assert model.views[2].used
    assert any(line.startswith("stop_02: a piece of") for line in model.warnings)
    assert rms_m(model) < 1.1 * rms_m(whole()[1])


def test_of_two_views_one_confirms_a_piece_near_its_own_distance_alone() -> None:
    """One partner is not enough to move a piece by many sigmas; within two it is."""
    for grown, std, used in ((-0.2, 0.01, False), (-0.05, 0.04, True)):
        first, second = scene().surfaces[0], scene().surfaces[7]
        views = [view_of(one, one.placement) for one in (torn(first, grown, right_part(0.5), std), second)]
        found = registered("two", views, shared_covariance(views))
        small = found.pieces[0][1]
        assert (small.why is None) == used, small
        if not used:
            assert "one other view alone confirms it" in str(small.why)


def test_what_two_others_see_through_is_not_shown() -> None:
    """A patch of a view that stands out of its own surface, unbroken: two others look through it, and it goes, it alone."""
    surfaces = list(scene().surfaces)
    first = surfaces[1]
    row, column = np.indices(first.mask.shape)
    low, high = np.argwhere(first.mask).min(axis=0), np.argwhere(first.mask).max(axis=0)
    middle = (low + high) / 2
    patch = ((row - middle[0]) ** 2 + (column - middle[1]) ** 2 < 6.0**2).astype(float)
    surfaces[1] = replace(first, depth=(first.depth * (1 - 0.1 * patch)).astype(np.float32))
    views = [view_of(one, one.placement) for one in surfaces]
    found = registered("stone", views, shared_covariance(views))
    shown, before = found.aligned.placed[found.kept.index(1)].view, views[1]
    r0, c0 = -before.image[1], -before.image[0]
    inner = patch[r0 : r0 + before.depth.shape[0], c0 : c0 + before.depth.shape[1]]
    assert np.mean(~shown.witness[(inner > 0) & before.witness]) > 0.9
    assert np.mean(~shown.witness[(inner == 0) & before.witness]) < 0.03


def test_the_largest_piece_leads() -> None:
    """Pieces are in the order of the pixels that can be compared."""
    first = scene().surfaces[0]
    view = view_of(torn(first, 0.0, right_part(0.6)), first.placement)
    assert labels_by_size(view) == [2, 1]


def test_normals_that_are_off_slowly_are_made_right_by_the_surface() -> None:
    """On a wavy sheet whose normals lean 3 degrees all over, in waves: the lean goes, the detail that the surface lacks stays."""
    size, step = 60, 0.001
    column, row = np.meshgrid(np.arange(size), np.arange(size))
    number = row * size + column
    across, down = (number[:, :-1], number[:, 1:]), (number[:-1], number[1:])
    edges = np.concatenate([np.column_stack([one.ravel() for one in pair]) for pair in (across, down)])
    smooth = np.stack([0.1 * np.sin(column / 9.0), 0.1 * np.cos(row / 11.0), np.ones((size, size))], axis=-1).reshape(-1, 3)
    fine = 0.02 * np.random.default_rng(1).standard_normal((size * size, 2))
    true = smooth + np.column_stack([fine, np.zeros(size * size)])
    lean = np.radians(3) * np.column_stack([np.ones(size * size), np.sin(row.ravel() / 25.0), np.zeros(size * size)])
    n, m, t = (x / np.linalg.norm(x, axis=1, keepdims=True) for x in (smooth, true + lean, true))
    found = detail.corrected(m, n, edges, step, step)
    before, after = (np.degrees(np.median(np.linalg.norm(one - t, axis=1))) for one in (m, found))
    assert before > 2.5
    assert after < 0.7
    assert np.degrees(np.median(np.linalg.norm(n - t, axis=1))) > 1.0  # the surface alone does not have the detail


@pytest.mark.parametrize(("sigmas", "used"), [(2.2, True), (3.2, False), (4.5, False)])
def test_a_view_at_a_wrong_distance_is_named_and_left_out(sigmas: float, used: bool) -> None:
    """It is named, and the model unharmed: within what its sigma allows it is put where the others have it, further off it is left out."""
    surfaces = list(scene().surfaces)
    first, off = surfaces[4], 0.06
    component = replace(first.components[0], scale_std=off / sigmas)
    surfaces[4] = replace(first, depth=first.depth * np.float32(np.exp(off)), components=(component,))
    model = lpcal.fuse(surfaces, step_m=0.0024)
    assert [view.name for view in model.views if not view.used] == ([] if used else ["stop_04"])
    assert len(model.warnings) == (not used)
    assert used or (model.warnings[0].startswith("stop_04 is left out: its distance differs by") and "sigmas" in model.warnings[0])
    named = [view.distance_sigmas for view in model.views]
    assert named[4] == pytest.approx(sigmas, abs=0.3) if used else named[4] is None
    assert max(one for k, one in enumerate(named) if k != 4 and one is not None) < MOST_SCALE_SIGMAS
    assert rms_m(model) < 1.2 * rms_m(whole()[1])


def test_a_distance_is_wrong_by_what_sets_it_apart_from_the_others() -> None:
    """All are 1.6 % too far, as lights that are off make them, and one 4.8 % too near: that one is remarked, though it moved by less."""
    surfaces = [replace(one, depth=one.depth * np.float32(np.exp(0.016))) for one in scene().surfaces]
    surfaces = [replace(one, components=(replace(one.components[0], scale_std=0.02),)) for one in surfaces]
    surfaces[4] = replace(surfaces[4], depth=surfaces[4].depth * np.float32(np.exp(-0.064)))
    model = lpcal.fuse(surfaces, step_m=0.0024)
    remarks = [line for line in model.warnings if "its distance was changed" in line or "its distance differs" in line]
    assert len(remarks) == 1
    assert remarks[0].startswith("stop_04")
    others = np.median([view.distance_change_m for k, view in enumerate(model.views) if k != 4 and view.distance_change_m is not None])
    assert others < -0.002
