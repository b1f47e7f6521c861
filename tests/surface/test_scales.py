"""Blocks of pixels: what is linear or flat is the same in them, and breaks stay where they are."""

import numpy as np
import pytest

from lpcal.integration.integrate import Grid
from lpcal.surface import scales
from lpcal.surface.scales import Blocks
from lpcal.view.constants import REGULARISATION
from lpcal.view.pixel_list import PixelList

SHAPE = (60, 80)
MIDDLE = np.array([40.0, 30.0])


@pytest.fixture
def blocks(monkeypatch: pytest.MonkeyPatch) -> scales.Blocks:
    monkeypatch.setattr(scales, "PIXELS", 500)
    row, column = np.indices(SHAPE)
    mask = (row - 29) ** 2 + (column - 37) ** 2 < 26**2
    places = np.stack(np.nonzero(mask)[::-1], axis=1)
    rays_C = np.column_stack([(places - MIDDLE) / 300, np.ones(len(places))])
    rng = np.random.default_rng(3)
    signal = rng.random((4, len(places)))
    seen = PixelList(mask, rays_C, signal, np.full(signal.shape, 0.1), rng.random(signal.shape) > 0.05, True)
    found = Blocks.of(seen, Grid.of(mask))
    assert found is not None
    return found


def test_blocks_hold_the_means_of_their_pixels(blocks: scales.Blocks) -> None:
    assert blocks.side == 2
    one = blocks.of_pixel == 100
    coarse, seen = blocks.coarse, blocks.seen
    assert np.allclose(coarse.signal[:, 100], seen.signal[:, one].mean(axis=1))
    assert np.allclose(coarse.sigma[:, 100], 0.1)
    assert np.array_equal(coarse.usable[:, 100], seen.usable[:, one].all(axis=1))
    assert np.allclose(coarse.rays_C[100], seen.rays_C[one].mean(axis=0))
    assert coarse.mask.sum() == coarse.pixels == blocks.of_pixel.max() + 1
    assert np.bincount(blocks.of_pixel).max() == 4
    assert np.allclose(blocks.means(seen.signal[0]), coarse.signal[0])


def test_what_is_linear_over_the_image_is_carried_as_it_is(blocks: scales.Blocks) -> None:
    whole = np.bincount(blocks.of_pixel) == 4
    inside = (whole[blocks.around] | (blocks.share == 0)).all(axis=1) & (blocks.share > 0).all(axis=1)
    assert inside.mean() > 0.7
    carried = blocks.between(blocks.coarse.rays_C)
    assert np.abs(carried - blocks.seen.rays_C)[inside].max() < 1e-12
    assert np.abs(carried - blocks.seen.rays_C).max() < 2 / 300  # at the rim by a block at most


def test_a_plane_is_carried_as_it_is(blocks: scales.Blocks) -> None:
    n = np.array([0.3, -0.2, -0.9])
    n /= np.linalg.norm(n)
    u = np.log(-0.35 / (blocks.coarse.rays_C @ n))
    wanted = np.log(-0.35 / (blocks.seen.rays_C @ n))
    assert np.abs(blocks.front(u, np.tile(n, (len(u), 1))) - wanted).max() < 1e-12


def test_breaks_stand_between_blocks_where_they_were(blocks: scales.Blocks) -> None:
    column = np.nonzero(blocks.coarse.mask)[1]
    grid = blocks.coarse_grid
    broken = (column[grid.a] == 17) & (column[grid.b] == 18)
    weight = blocks.edges(np.where(broken, 0.01, 0.7))
    fine = np.nonzero(blocks.seen.mask)[1]
    first, last = fine[blocks.grid.a], fine[blocks.grid.b]
    across = (first == 35) & (last == 36)
    assert across.sum() > 40
    assert np.all(weight[across] == 0.01)
    assert np.all(np.isin(weight[~across], [0.7, 1.0]))
    assert np.all(weight[blocks.of_pixel[blocks.grid.a] == blocks.of_pixel[blocks.grid.b]] == 1.0)
    assert REGULARISATION not in weight


def test_few_pixels_are_not_joined() -> None:
    mask = np.ones((40, 40), bool)
    seen = PixelList(mask, np.ones((1600, 3)), np.ones((3, 1600)), np.ones((3, 1600)), np.ones((3, 1600), bool), True)
    assert Blocks.of(seen, Grid.of(mask)) is None
