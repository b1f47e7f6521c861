"""The sigma of a piece's distance: what the model lacks is common to regions, of which a small piece has fewer."""

import numpy as np

from lpcal.surface import uncertainty


def test_a_mean_over_regions_is_as_unsure_as_its_regions_are_few() -> None:
    """Of regions that err each by itself: the mean over a sixteenth of them scatters four times as much."""
    rng, side = np.random.default_rng(0), 8
    errors = rng.normal(0, 0.1, (4000, side * side))
    whole, small = errors.mean(axis=1).std(), errors[:, : side * side // 16].mean(axis=1).std()
    assert abs(small / whole / uncertainty.fewer_regions(100, 1600) - 1) < 0.05


def test_no_piece_is_surer_than_the_largest() -> None:
    assert uncertainty.fewer_regions(500, 500) == 1.0
    assert uncertainty.fewer_regions(0, 500) > 20
