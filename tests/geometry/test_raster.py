"""Masks grown, shrunk, opened and closed, and the highest of neighbours, beside scipy's."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from lpcal.geometry import raster


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (7, 2), (40, 50)])
@pytest.mark.parametrize("share", [0.0, 0.1, 0.6, 0.9, 1.0])
@pytest.mark.parametrize("by", [1, 2, 5])
def test_masks_grow_and_shrink_as_those_of_scipy_do(shape: tuple[int, int], share: float, by: int) -> None:
    mask = np.random.default_rng(by).random(shape) < share
    before = mask.copy()
    np.testing.assert_array_equal(raster.dilated(mask, by), ndimage.binary_dilation(mask, iterations=by))
    np.testing.assert_array_equal(raster.eroded(mask, by), ndimage.binary_erosion(mask, iterations=by))
    np.testing.assert_array_equal(raster.eroded(mask, by, beyond=True), ndimage.binary_erosion(mask, iterations=by, border_value=1))
    np.testing.assert_array_equal(raster.opened(mask, by), ndimage.binary_opening(mask, iterations=by))
    np.testing.assert_array_equal(raster.closed(mask), ndimage.binary_closing(mask))
    np.testing.assert_array_equal(raster.max_filtered(mask, by, beyond=False), ndimage.maximum_filter(mask, 2 * by + 1, mode="constant"))
    np.testing.assert_array_equal(mask, before)


def test_the_highest_of_neighbours_counts_what_lies_beyond() -> None:
    values = np.random.default_rng(1).normal(size=(12, 15))
    found = raster.max_filtered(values, 1, 0.5)
    np.testing.assert_array_equal(found, ndimage.maximum_filter(values, 3, mode="constant", cval=0.5))
    assert (found[0] >= 0.5).all()
    assert found.flags.c_contiguous


def test_nothing_is_near_where_a_mask_is_empty() -> None:
    empty = np.zeros((4, 5), bool)
    assert (raster.nearest(empty) == -1).all()
    assert np.isinf(raster.distance_to(empty)).all()


def test_blocks_are_means_of_their_pixels() -> None:
    picture = np.random.default_rng(3).random((14, 17)).astype(np.float32)
    expected = picture[:12, :16].astype(float).reshape(3, 4, 4, 4).mean(axis=(1, 3))
    np.testing.assert_allclose(raster.block_means(picture, 4), expected, rtol=1e-12)
    assert raster.block_means(picture, 20).size == 0
