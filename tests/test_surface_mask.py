"""Pieces of a mask that are the wall itself, where what is known of the lights runs out."""

from __future__ import annotations

import numpy as np

from lpcal.surface.mask import _without_faint


def picture(*means: float) -> tuple[np.ndarray, np.ndarray]:
    mask, against = np.zeros((40, 90), bool), np.full((40, 90), -0.6, np.float32)
    for k, mean in enumerate(means):
        piece = (slice(10, 30), slice(5 + 30 * k, 25 + 30 * k))
        mask[piece], against[piece] = True, mean
    return mask, against


def test_a_piece_that_hardly_differs_from_the_wall_goes_where_another_clearly_does():
    mask, against = picture(0.85, 0.1)
    kept = _without_faint(mask, against)
    assert kept[:, :30].sum() == 400
    assert not kept[:, 30:].any()


def test_two_clear_pieces_stay_and_so_does_a_faint_one_by_itself():
    for means in ((0.85, 0.5), (0.2,), (0.2, 0.1)):
        mask, against = picture(*means)
        assert np.array_equal(_without_faint(mask, against), mask)
