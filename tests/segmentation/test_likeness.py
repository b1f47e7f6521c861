"""Which side of an outline a pixel is like: by sums over its window, and on two textures."""

import numpy as np

from lpcal.segmentation.likeness import KNOWN, MOST, TEXTURE, level, likeness


def two_sides(rng: np.random.Generator, step: float) -> tuple[np.ndarray, np.ndarray]:
    """A picture (40, 60) whose right half is brighter by `step`, and its left half as a mask."""
    left = np.zeros((40, 60), bool)
    left[:, :30] = True
    return (np.where(left, 0.0, step) + rng.normal(0, 0.05, left.shape)).astype(np.float32), left


def test_is_the_ratio_of_two_normal_densities() -> None:
    """By sums over the window, written out for some pixels."""
    picture, left = two_sides(np.random.default_rng(0), 0.25)
    by, asked = 3.0, np.zeros(left.shape, bool)
    asked[20, [26, 29, 30, 33]] = True
    found = likeness([picture], left, ~left, by, asked)[0]
    rows, columns = np.indices(left.shape)
    for column, value in zip((26, 29, 30, 33), found, strict=True):
        weight = np.exp(-((rows - 20) ** 2 + (columns - column) ** 2) / (2 * by**2))
        cost = []
        for side in (left, ~left):
            assert weight[side].sum() / weight.sum() > KNOWN
            mean = np.average(picture[side], weights=weight[side])
            variance = np.average(picture[side] ** 2, weights=weight[side]) - mean**2 + TEXTURE**2
            cost.append((picture[20, column] - mean) ** 2 / variance + np.log(variance))
        assert abs(value - (cost[1] - cost[0]) / 2) < 0.01


def test_parts_textures_and_leaves_what_is_alike_open() -> None:
    """Bright and dark are told apart up to the bound; of one brightness nothing is said."""
    rng = np.random.default_rng(1)
    picture, left = two_sides(rng, 1.0)
    same, _ = two_sides(rng, 0.0)
    everywhere = np.ones(left.shape, bool)
    apart, alike = (one.reshape(left.shape) for one in likeness([picture, same], left, ~left, 4.0, everywhere))
    assert np.all(apart[left] > 3)
    assert np.all(apart[~left] < -3)
    assert np.abs(apart).max() <= MOST
    assert np.abs(np.mean(alike)) < 0.05
    assert np.percentile(np.abs(alike), 95) < 0.5


def test_a_wrong_outline_is_seen_through() -> None:
    """A piece of the bright side that was taken for the dark one is like the bright one still."""
    picture, left = two_sides(np.random.default_rng(2), 1.0)
    taken = left.copy()
    taken[15:22, 30:37] = True
    asked = taken & ~left
    assert np.mean(likeness([picture], taken, ~taken, 8.0, asked)[0]) < -1


def test_far_from_a_side_its_nearest_place_counts_and_one_side_alone_says_nothing() -> None:
    """No division by an empty window; zeros where there is nothing to compare with."""
    picture, left = two_sides(np.random.default_rng(3), 1.0)
    asked = np.zeros(left.shape, bool)
    asked[:, 55:] = True
    assert np.all(likeness([picture], left, ~left, 2.0, asked)[0] < -3)
    assert not likeness([picture], left & ~left, ~left, 2.0, asked)[0].any()
    assert np.all(level(np.zeros((2, 2), np.float32), 0.1) == np.float32(np.log(0.1)))
