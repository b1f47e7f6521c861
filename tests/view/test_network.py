"""The mask network: checked by an explicit convolution, by its invariances, and for having the channels of segmentation.features."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from lpcal.segmentation import features
from lpcal.segmentation.background import FITTED, log_odds_by
from lpcal.view.network import Convolution, Network, doubled, halved


def test_a_convolution_is_the_sum_over_nine_places_and_rectified() -> None:
    rng = np.random.default_rng(0)
    x, weight, offset = (rng.normal(size=shape).astype(np.float32) for shape in ((3, 11, 8), (9, 4, 3), (4,)))
    found = Convolution(weight, offset)(x)
    for k in range(4):
        kernels = weight[:, k].T.reshape(3, 3, 3)
        total = offset[k] + sum(ndimage.correlate(channel, one, mode="constant") for channel, one in zip(x, kernels, strict=True))
        np.testing.assert_allclose(found[k], np.maximum(total, 0), atol=1e-5)


@pytest.mark.parametrize("shape", [(6, 8), (7, 5), (1, 1)])
def test_halves_are_means_of_blocks_and_doubles_are_their_pixels_again(shape: tuple[int, int]) -> None:
    x = np.random.default_rng(1).normal(size=(2, *shape)).astype(np.float32)
    half = halved(x)
    for i in range(half.shape[1]):
        for j in range(half.shape[2]):
            np.testing.assert_allclose(half[:, i, j], x[:, 2 * i : 2 * i + 2, 2 * j : 2 * j + 2].mean(axis=(1, 2)), atol=1e-6)
    wide = doubled(half, shape)
    assert wide.shape == x.shape
    row, column = np.indices(shape)
    np.testing.assert_array_equal(wide, half[:, row // 2, column // 2])


def random_channels(shape: tuple[int, int], net: Network) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(2)
    smooth = {name: ndimage.gaussian_filter(rng.normal(size=shape), 3) * 8 for name in net.channels}
    return {name: net.middle[k] + net.spread[k] * smooth[name] for k, name in enumerate(net.channels)}


@pytest.mark.parametrize("shape", [(60, 80), (33, 47)])
def test_left_and_right_are_alike(shape: tuple[int, int]) -> None:
    """In a mirror the answer is the mirror image; and normals' x counts: without its sign the answer differs."""
    net = Network.read(FITTED)
    seen = random_channels(shape, net)
    mirror = {name: (-1 if name in features.MIRRORED else 1) * value[:, ::-1] for name, value in seen.items()}
    np.testing.assert_allclose(log_odds_by(net, mirror)[:, ::-1], log_odds_by(net, seen), atol=1e-3)
    wrong = {name: value[:, ::-1] for name, value in seen.items()}
    assert np.abs(log_odds_by(net, wrong)[:, ::-1] - log_odds_by(net, seen)).max() > 0.05


def test_a_file_holds_all_of_it_and_what_is_wild_is_cut_off() -> None:
    net = Network.read(FITTED)
    with np.load(FITTED) as arrays:
        again = Network.of(arrays)
    seen = random_channels((24, 32), net)
    np.testing.assert_array_equal(log_odds_by(again, seen), log_odds_by(net, seen))
    far = {name: net.middle[k] + 1e6 * (seen[name] - net.middle[k]) for k, name in enumerate(net.channels)}
    further = {name: net.middle[k] + 1e9 * (seen[name] - net.middle[k]) for k, name in enumerate(net.channels)}
    np.testing.assert_array_equal(log_odds_by(net, far), log_odds_by(net, further))
    assert np.isfinite(log_odds_by(net, far)).all()
