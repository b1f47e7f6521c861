"""Images in another order than their lights, or turned: named with the arrangement that they fit, and never where they are right."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import lpcal as library
from lit_scene import Scene, calibration, draw
from lpcal.detect.arrangement import Rearranged, better, refuse_rearranged
from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.errors import DisagreementError
from lpcal.records.calibration import Calibration, Light
from lpcal.records.observations import Radiance, RawCapture

TURNED = {
    "turned by 180 degrees": lambda images: images[:, ::-1, ::-1],
    "mirrored left to right": lambda images: images[:, :, ::-1],
    "mirrored top to bottom": lambda images: images[:, ::-1],
}


def changed(raw: RawCapture, change: Callable[[np.ndarray], np.ndarray]) -> RawCapture:
    """The capture with images and ambient images changed; its mask, if any, too."""
    assert raw.ambient is not None
    mask = None if raw.mask is None else change(raw.mask[None])[0]
    return replace(raw, images=change(raw.images), ambient=change(raw.ambient), mask=mask)


def in_order(raw: RawCapture, order: np.ndarray) -> RawCapture:
    """The capture whose k-th light has the image of another one."""
    return replace(raw, images=raw.images[order])


@cache
def drawn(count: int, *, ball: bool = True) -> RawCapture:
    """A ball before a wall, or the wall alone, which tells half a turn of a regular ring better than a ball in its middle."""
    return draw(Scene() if ball else Scene(centre=None), calibration(count))


def found(raw: RawCapture, lights: Calibration) -> Rearranged | None:
    radiance = to_radiance(raw, Sensor())
    return better(radiance, lights.lights, lights.camera, radiance.mask)


@pytest.mark.parametrize("count", [4, 6, 12])
@pytest.mark.parametrize("scene", [Scene(), Scene(gloss=0.4), Scene(centre=(0.03, -0.02, 0.36))])
def test_right_captures_are_left_alone(count: int, scene: Scene) -> None:
    lights = calibration(count)
    assert found(draw(scene, lights), lights) is None


@pytest.mark.parametrize("count", [6, 12])
@pytest.mark.parametrize(
    "order",
    [
        lambda k: np.roll(k, 1),
        lambda k: np.roll(k, -2),
        lambda k: np.roll(k, len(k) // 2),
        lambda k: k[::-1],
        lambda k: -k % len(k),
    ],
)
def test_another_order_round_the_ring_is_named(count: int, order: Callable[[np.ndarray], np.ndarray]) -> None:
    lights = calibration(count)
    stated = order(np.arange(count))
    said = found(in_order(drawn(count, ball=stated[0] != count // 2), stated), lights)
    assert said is not None
    ways = [one for one in (said.arrangement, *said.alike) if one.turn is None]  # a ring turned half round is the picture turned
    assert list(range(count)) in [stated[one.images].tolist() for one in ways]
    assert said.odds > 0.97


def test_an_order_by_names_as_text_is_named() -> None:
    lights = calibration(12)
    by_text = np.argsort([str(k) for k in range(12)])
    for order in (by_text, np.argsort(by_text)):
        said = found(in_order(drawn(12), order), lights)
        assert said is not None
        assert order[said.arrangement.images].tolist() == list(range(12))


@pytest.mark.parametrize("turn", list(TURNED))
@pytest.mark.parametrize("count", [6, 12])
def test_turned_pictures_are_named(count: int, turn: str) -> None:
    lights = calibration(count)
    said = found(changed(drawn(count, ball=False), TURNED[turn]), lights)
    assert said is not None
    assert turn in [one.turn for one in (said.arrangement, *said.alike)]


@pytest.mark.parametrize(("name", "by"), [("left", -1), ("right", 1)])
def test_square_pictures_may_be_turned_by_a_quarter(name: str, by: int) -> None:
    lights = calibration()
    assert lights.camera is not None
    width, height = lights.camera.image_size
    first = (width - height) // 2
    raw = changed(draw(Scene(), lights), lambda images: images[:, :, first : first + height])
    K = lights.camera.K - np.array([[0, 0, first], [0, 0, 0], [0, 0, 0]])
    lights = replace(lights, camera=replace(lights.camera, image_size=(height, height), K=K))
    assert found(raw, lights) is None
    said = found(changed(raw, lambda images: np.rot90(images, by, axes=(1, 2))), lights)
    assert said is not None
    assert said.arrangement.turn == f"turned by 90 degrees to the {name}"


def test_lamps_of_another_power_are_no_other_arrangement() -> None:
    lights, raw, rng = calibration(), drawn(6), np.random.default_rng(0)
    powers = rng.uniform(0.5, 1.0, 6)[:, None, None]
    assert raw.ambient is not None
    assert found(replace(raw, images=raw.ambient[0] + (raw.images - raw.ambient[0]) * powers), lights) is None


def ring(tilts_deg: np.ndarray) -> Calibration:
    """Distant lights round the object."""
    azimuth, tilt = 2 * np.pi * np.arange(len(tilts_deg)) / len(tilts_deg), np.radians(tilts_deg)
    S = np.stack([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)], axis=1)
    return Calibration("dome", tuple(Light(f"L{k}", s, np.ones(1)) for k, s in enumerate(S)))


def ball(lights: Calibration) -> Radiance:
    """A matte ball under them, with noise, on black."""
    y, x = np.mgrid[-1.1:1.1:120j, -1.1:1.1:160j]
    n = np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0))], axis=-1)
    S = np.stack([light.direction_C for light in lights.lights])
    signal = 0.6 * np.maximum(np.einsum("lc,hwc->lhw", S, n), 0) * (x**2 + y**2 < 0.98)
    signal = (signal + np.random.default_rng(0).normal(0, 0.002, signal.shape)).astype(np.float32)
    zero = np.zeros(signal.shape[1:], np.float32)
    names = tuple(light.name for light in lights.lights)
    return Radiance("ball", names, signal, np.full(signal.shape, 0.002, np.float32), np.zeros(signal.shape, bool), zero)


def test_distant_lights_that_differ_are_named_and_those_alike_from_all_sides_are_not() -> None:
    uneven, even = ring(np.array([20.0, 40, 25, 50, 30, 45, 35])), ring(np.full(8, 35.0))
    for lights, differ in ((uneven, True), (even, False)):
        right = ball(lights)
        assert better(right, lights.lights, None) is None
        said = better(replace(right, signal=np.roll(right.signal, 1, axis=0)), lights.lights, None)
        assert (said is not None) == differ
        if said is not None:
            assert said.arrangement.images.tolist() == [*range(1, 7), 0]


def test_it_is_refused_with_the_arrangement_in_words() -> None:
    lights = calibration()
    raw = in_order(drawn(6), np.roll(np.arange(6), 1))
    with pytest.raises(DisagreementError, match="the image L1 is of the light L0, L2 is of the light L1") as caught:
        library.reconstruct(raw, lights)
    assert caught.value.exit_code == 6
    with pytest.raises(DisagreementError, match="mirrored left to right"):
        library.reconstruct(changed(drawn(6), TURNED["mirrored left to right"]), lights)


def test_what_is_less_clear_is_a_note() -> None:
    lights = calibration(4)
    raw = drawn(4)
    radiance = to_radiance(in_order(raw, np.roll(np.arange(4), 1)), Sensor())
    some = np.zeros(raw.images.shape[1:], bool)
    said: list[str] = []
    for side in (90, 70, 50, 36, 26):  # ever fewer pixels, until they are not clear
        some[:] = False
        some[120 - side : 120 + side, 160 - side : 160 + side] = True
        try:
            said += refuse_rearranged(radiance, lights, some)
        except DisagreementError:
            continue
    assert said
    assert all("odds" in note and "fit the lights better" in note for note in said)


def test_who_states_that_the_images_are_right_is_told_and_not_refused() -> None:
    lights = calibration()
    raw = in_order(drawn(6), np.roll(np.arange(6), 1))
    with pytest.raises(DisagreementError, match="if they are right, state arrangement: stated"):
        library.reconstruct(raw, lights)
    by_caller = library.reconstruct(raw, lights, distance_m=0.35, arrangement="stated")
    by_capture = library.reconstruct(replace(raw, arrangement_stated=True), lights, distance_m=0.35)
    for surface in (by_caller, by_capture):
        assert any("fit the lights better" in note and "taken as they are" in note for note in surface.warnings)
    right = library.reconstruct(drawn(6), lights, arrangement="stated")
    assert not any("fit the lights better" in note for note in right.warnings)
    with pytest.raises(library.errors.InputError, match="'ask'"):
        library.reconstruct(raw, lights, arrangement="ask")
