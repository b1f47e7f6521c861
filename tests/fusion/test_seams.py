"""Parts of a piece that breaks and seams of unsure or sharply turning normals cut off: placed each by itself."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import lpcal
from fusion_views import scene
from lpcal.fusion.seams import LEAST_PIXELS, parted
from lpcal.geometry.arrays import Image, Labels, Mask
from lpcal.records.surface import Surface

SHAPE = 60, 50
CUT, SEAM = 30, 25
"""Row above which a break runs, and column of the seam: the part is what lies below the one and left of the other."""


def piece() -> tuple[Labels, Mask, Image, Image]:
    """One piece that fills an image: its labels, breaks, normals and their standard deviations, without a flaw."""
    normals = np.broadcast_to(np.array([0, 0, -1], np.float32), (*SHAPE, 3)).copy()
    return np.ones(SHAPE, np.uint8), np.zeros((2, *SHAPE), bool), normals, np.ones(SHAPE, np.float32)


def cut(breaks: Mask) -> None:
    """A break between two rows, from the left edge to the seam."""
    breaks[1, CUT - 1, : SEAM + 1] = True


def inside() -> Mask:
    """The pixels below the cut and left of the seam."""
    row, column = np.indices(SHAPE)
    return (row >= CUT) & (column < SEAM)


@pytest.mark.parametrize(("above", "beside"), [("break", "unsure"), ("break", "sharp"), ("seam", "unsure")])
def test_breaks_and_seams_cut_off_a_part(above: str, beside: str) -> None:
    """Where normals are unsure, or turn sharply beside a break, a piece hangs on to what may lie behind it."""
    component, breaks, normals, std_deg = piece()
    if above == "break":
        cut(breaks)
    else:
        std_deg[CUT, : SEAM + 1] = 20
    if beside == "unsure":
        std_deg[CUT - 2 :, SEAM] = 20
    else:
        normals[:, :SEAM] = [0.7, 0, -np.sqrt(0.51)]
        normals[:, SEAM:] = [-0.7, 0, -np.sqrt(0.51)]
    found, of = parted(component, breaks, normals, std_deg)
    assert of == {1: 1, 2: 1}
    assert np.mean((found == 2) == inside()) > 0.98


@pytest.mark.parametrize("what", ["break", "seam", "edge", "neither"])
def test_what_ends_within_a_piece_or_is_its_own_edge_cuts_nothing_off(what: str) -> None:
    """There is a way round a break or a seam; at an edge sure normals turn sharply, and nothing is broken."""
    component, breaks, normals, std_deg = piece()
    if what == "break":
        cut(breaks)
    elif what == "seam":
        std_deg[CUT:, SEAM] = 20
    elif what == "edge":
        normals[inside()] = [0.7, 0, -np.sqrt(0.51)]
    found, of = parted(component, breaks, normals, std_deg)
    assert of == {1: 1}
    np.testing.assert_array_equal(found, component)


def test_a_crumb_is_no_part() -> None:
    """A part with too few pixels to be looked for stays with the piece."""
    component, breaks, normals, std_deg = piece()
    breaks[1, 51, :8] = True
    std_deg[50:, 7] = 20
    assert LEAST_PIXELS > 8 * 7
    assert parted(component, breaks, normals, std_deg)[1] == {1: 1}


def test_pieces_stay_apart_and_keep_their_labels() -> None:
    """Two pieces beside each other, the second in two parts: the larger keeps the piece's label, the other counts on."""
    component, breaks, normals, std_deg = piece()
    component[:, 40:] = 2
    breaks[0, :, 39] = True
    breaks[1, 44, 40:] = True
    found, of = parted(component, breaks, normals, std_deg)
    assert of == {1: 1, 2: 2, 3: 2}
    assert {int(label) for label in found[:45, 40:].ravel()} == {2}
    assert {int(label) for label in found[45:, 40:].ravel()} == {3}
    np.testing.assert_array_equal(found[:, :40], 1)


def falsely_cut(surface: Surface, by_m: float) -> Surface:
    """The surface with a quarter of it so much farther: above by a break, at its side by a ramp of unsure normals, one piece as before."""
    rows, columns = np.flatnonzero(surface.mask.any(axis=1)), np.flatnonzero(surface.mask.any(axis=0))
    row, column = np.indices(surface.mask.shape)
    cut, seam = int(rows.mean()), int(columns.mean())
    share = np.clip((seam + 3 - column) / 6, 0, 1) * (row >= cut)
    breaks = surface.breaks.copy()
    breaks[1, cut - 1, : seam + 2] |= surface.mask[cut, : seam + 2]
    std_deg = surface.normal_std_deg.copy()
    std_deg[surface.mask & (row >= cut) & (np.abs(column - seam) <= 3)] = 20
    return replace(surface, depth=(surface.depth + by_m * share).astype(np.float32), breaks=breaks, normal_std_deg=std_deg)


def test_what_lies_behind_a_false_cut_is_placed_by_the_others() -> None:
    """A quarter of a view 20 mm too far, in one piece with the rest: the model is nearly as good (0.57 mm of 0.49; 1.53 as one piece)."""
    pytest.importorskip("skimage")
    surfaces, by_m = list(scene().surfaces), 0.02
    off_m = {}
    for name, first in (("whole", surfaces[2]), ("cut", falsely_cut(surfaces[2], by_m))):
        model = lpcal.fuse([*surfaces[:2], first, *surfaces[3:]], step_m=0.0024)
        off_m[name] = float(np.sqrt(np.mean(scene().off_m(model.vertices_A) ** 2)))
    large, part = model.views[2].pieces
    assert part.why is None
    assert part.distance_change_m is not None
    assert large.distance_change_m is not None
    assert (part.distance_change_m - large.distance_change_m) / -by_m > 0.5
    assert off_m["cut"] < 1.25 * off_m["whole"]
