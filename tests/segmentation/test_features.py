"""The channels that the mask's network sees: of a picture of exact planes, and of labels written by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lit_scene import calibration
from lpcal.segmentation import features, layers, mask, sample_costs
from lpcal.segmentation.background import FITTED
from lpcal.segmentation.features import View
from lpcal.view.coarse import LightTable, coarse_of
from lpcal.view.network import Network
from lpcal.view.pixel_list import SignalMaps
from plane_scene import WALL, WORKING_M, picture, scene

CARD = WALL * 0.45 / 0.4


def seen(scale: float = 1.0, factor: int = 4) -> tuple[View, np.ndarray, np.ndarray]:
    """A view of a card 5 cm before a wall, its labels (1 the wall, 2 the card), and the layers' costs; `scale` is a unit of brightness."""
    maps, rays = picture(scene())
    maps = SignalMaps(maps.signal * np.float32(scale), maps.sigma * np.float32(scale), maps.usable)
    image = coarse_of(maps, rays, factor)
    table = LightTable.of(image, calibration().lights, WORKING_M)
    view = mask.view_of(image, table, WORKING_M, mask.NO_HINTS, maps.signal.shape[1:], maps.signal[0] * np.float32(0.2))
    labels = np.ones(image.shape, int)
    labels[36 // factor : 72 // factor, 52 // factor : 104 // factor] = 2
    at = layers.Pixels(image.signal, image.sigma, image.usable, image.rays_C, np.arange(len(image.rays_C)))
    found = layers.Layers([WALL, CARD], [None, None], 0.0)
    B, doubt = table.at(np.full(len(image.rays_C), np.log(0.4)), at.coarse)
    free = sample_costs.free(at.signal, at.sigma, at.usable, B, doubt)[1]
    cost = layers.with_planes(found, at, table, free, np.linalg.norm(B, axis=2)).reshape(-1, *image.shape)
    return view, labels, cost


def test_the_networks_channels_are_the_clues() -> None:
    view, labels, cost = seen()
    found = features.channels(view, labels, [WALL, CARD], cost)
    assert set(Network.read(FITTED).channels) == set(found)
    assert set(features.MIRRORED) < set(found)
    assert all(value.shape == labels.shape and np.isfinite(value).all() for value in found.values())


def test_no_channel_has_a_scale_of_brightness() -> None:
    (view, labels, cost), (bright, _, _) = seen(), seen(scale=3.0)
    one, three = (features.channels(each, labels, [WALL, CARD], cost) for each in (view, bright))
    for name, value in one.items():
        np.testing.assert_allclose(three[name], value, atol=2e-3, err_msg=name)


def test_depths_are_those_of_planes_and_of_what_the_lights_say() -> None:
    view, labels, cost = seen()
    found = features.channels(view, labels, [WALL, CARD], cost)
    rays = view.image.image(view.image.rays_C)
    np.testing.assert_allclose(found["depth"][labels == 2], -np.log(rays @ CARD * WORKING_M)[labels == 2])
    np.testing.assert_allclose(found["depth of the wall"], -np.log(rays @ WALL * WORKING_M))
    assert found["before the wall"][labels == 2] == pytest.approx(np.log(0.45 / 0.4), abs=1e-6)
    assert np.abs(found["before the wall"][labels == 1]).max() < 1e-9
    inside = np.zeros(labels.shape, bool)
    inside[2:-2, 2:-2] = True
    nearest = {at: np.median(found[f"cost at {at:g}"][labels == 2]) for at in features.DEPTHS}
    assert min(nearest, key=lambda at: nearest[at]) in (0.0, 0.15), "a card at log depth .05"
    assert np.median(found["cost at the wall"][(labels == 1) & inside]) < np.median(found["cost at 1.2"][(labels == 1) & inside])


def test_regions_are_connected_and_know_their_share_of_the_frame() -> None:
    labels = np.full((20, 30), 1)
    labels[5:10, 5:10], labels[12:16, 0:4], labels[0:3, 20:30] = 0, 0, 2
    found = features._of_regions(labels, 2)
    for at, size, frame in (((7, 7), 25, 0.0), ((13, 1), 16, 4 / 100), ((0, 25), 30, 13 / 100), ((10, 15), 529, 83 / 100)):
        assert found["size"][at] ** 2 == pytest.approx(size / 600)
        assert found["frame"][at] ** 2 == pytest.approx(frame)
    assert found["frame of the label"][7, 7] ** 2 == pytest.approx(4 / 100), "that of all matter of any normal"


def test_a_box_takes_the_images_place() -> None:
    view, labels, cost = seen()
    allowed = np.zeros(labels.shape, bool)
    allowed[5:20, 8:30] = True
    found = features.channels(replace(view, allowed=allowed), labels, [WALL, CARD], cost)
    assert found["bright"].shape == (15, 22)
    assert np.median(found["bright"]) == pytest.approx(0, abs=1e-6)
    np.testing.assert_array_equal(found["plane"], np.ones((15, 22)))
    assert found["frame of the label"][0, 0] == 1
