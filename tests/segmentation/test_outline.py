"""The outline of a mask that coarse pixels know roughly: its channels, what its network finds again, and how it is carried to full size."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lit_scene import calibration
from lpcal.segmentation import outline
from lpcal.segmentation.outline import Apart
from lpcal.view.coarse import LightTable, coarse_of, joined
from lpcal.view.pixel_list import SignalMaps
from plane_scene import CARD, WALL, WORKING_M, picture, scene

FACTOR = 4


def apart_of(maps: SignalMaps, rays_C: np.ndarray, true: np.ndarray) -> Apart:
    """Coarse pixels that know what most of them shows, and that they do not know it where it is mixed."""
    image = coarse_of(maps, rays_C, FACTOR)
    rows, columns = image.shape
    share = true[: rows * FACTOR, : columns * FACTOR].reshape(rows, FACTOR, columns, FACTOR).mean(axis=(1, 3))
    table = LightTable.of(image, calibration().lights, WORKING_M)
    return Apart(image, table, float(np.log(0.4)), np.log((share + 1e-3) / (1 - share + 1e-3)))


def iou(found: np.ndarray, true: np.ndarray) -> float:
    return float((found & true).sum() / (found | true).sum())


def seen(hole: tuple[slice, slice] | None = None) -> tuple[SignalMaps, np.ndarray, np.ndarray]:
    """Maps and rays of a card before a wall, with a hole where that is asked for, and the card."""
    parts = scene()
    if hole is not None:
        parts[-1][2][hole] = False
    return *picture(parts), parts[-1][2]


def test_channels_have_no_scale_of_brightness() -> None:
    maps, rays_C, card = seen()
    room = np.where(card, 0.05, 0.1).astype(np.float32)
    found = []
    for by in (1.0, 40.0):
        here = replace(maps, signal=(by * maps.signal).astype(np.float32), sigma=(by * maps.sigma).astype(np.float32))
        apart, factor = apart_of(here, rays_C, card), outline.scale_of(FACTOR)
        found.append(outline.channels(apart, joined(here, rays_C, factor)[0], (by * room).astype(np.float32), factor))
    assert found[0][1] == found[1][1]
    for name, value in found[0][0].items():
        np.testing.assert_allclose(found[1][0][name], value, atol=1e-3, err_msg=name)


def test_channels_are_those_of_a_window_about_the_object() -> None:
    maps, rays_C, card = seen()
    apart, factor = apart_of(maps, rays_C, card), outline.scale_of(FACTOR)
    here = joined(maps, rays_C, factor)[0]
    found, window = outline.channels(apart, here, None, factor)
    assert set(outline.MIRRORED) < set(found)
    shape = tuple(len(range(*side.indices(length))) for side, length in zip(window, here.signal.shape[1:], strict=True))
    assert {value.shape for value in found.values()} == {shape}
    assert shape < here.signal.shape[1:]
    for side, of_card in zip(window, CARD, strict=True):
        assert side.start <= of_card.start // factor - outline.MARGIN // 2
        assert side.stop >= of_card.stop // factor + outline.MARGIN // 2
    nowhere = replace(apart, log_odds=np.full_like(apart.log_odds, -9.0))
    assert outline.channels(nowhere, here, None, factor)[0]["odds"].shape == here.signal.shape[1:]


def test_what_no_light_reaches_is_known_by_the_image_without_lights_alone() -> None:
    """Coarse odds count little there."""
    row, _ = np.indices((112, 160))
    card = np.zeros(row.shape, bool)
    card[CARD] = True
    maps, rays_C = picture([(WALL * 0.45 / 0.4, np.full(card.shape, 0.7), card)])
    apart, factor = apart_of(maps, rays_C, card), outline.scale_of(FACTOR)
    found, _ = outline.channels(apart, joined(maps, rays_C, factor)[0], None, factor)
    unlit = found["over noise"] < outline.DIM
    assert unlit.any()
    assert found["odds"][unlit].min() == -outline.UNSURE
    assert found["odds"].max() > outline.UNSURE


@pytest.mark.parametrize("hole", [None, (slice(50, 60), slice(70, 84))], ids=["a card", "a card with a hole"])
def test_the_outline_is_found_to_a_pixel(hole: tuple[slice, slice] | None) -> None:
    maps, rays_C, card = seen(hole)
    apart = apart_of(maps, rays_C, card)
    coarse = outline.enlarged(apart.log_odds > 0, FACTOR, card.shape)
    found = outline.drawn(apart, maps, rays_C, None)
    assert iou(found, card) > max(0.96, iou(coarse, card))


def test_a_mask_is_carried_from_scale_to_scale() -> None:
    """Of pixels of eight to single ones, without the network."""
    maps, rays_C, card = seen()
    rough = joined(maps, rays_C, 8)[0].signal.shape[1:]
    mask = card[: rough[0] * 8, : rough[1] * 8].reshape(rough[0], 8, rough[1], 8).mean(axis=(1, 3)) > 0.5
    assert iou(outline.carried(mask, 8, maps, rays_C), card) > 0.97
    assert np.array_equal(outline.carried(card, 1, maps, rays_C), card)


def test_where_the_network_sees_nothing_the_coarse_pixels_stand(monkeypatch: pytest.MonkeyPatch) -> None:
    maps, rays_C, card = seen()
    monkeypatch.setattr(outline, "log_odds", lambda apart, here, room, factor: np.full(here.signal.shape[1:], -9.0))
    assert iou(outline.drawn(apart_of(maps, rays_C, card), maps, rays_C, None), card) > 0.97
