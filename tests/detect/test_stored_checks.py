"""Numbers that cannot be what they are taken for: one image twice, numbers over the white level, a raw mosaic, a foreign ambient image."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import lpcal
from lit_scene import Scene, calibration, draw
from lpcal.detect.ambient import ambient_notes, refuse_foreign_ambient, room_changes
from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.errors import DisagreementError
from lpcal.records.observations import RawCapture


def drawn(noise: float = 0.004) -> RawCapture:
    return draw(Scene(), calibration(), noise=noise)


def with_copy(raw: RawCapture, one: int, other: int) -> RawCapture:
    images = raw.images.copy()
    images[other] = images[one]
    return replace(raw, images=images)


@pytest.mark.parametrize(("one", "other"), [(0, 3), (4, 5)])
def test_an_image_under_two_names_is_refused_by_both(one: int, other: int) -> None:
    raw = drawn()
    to_radiance(raw, Sensor())
    with pytest.raises(DisagreementError, match=f"the same image twice.*{raw.lights[one]} and {raw.lights[other]}"):
        to_radiance(with_copy(raw, one, other), Sensor())


def test_an_ambient_image_that_is_a_lights_is_refused() -> None:
    raw = drawn()
    with pytest.raises(DisagreementError, match=f"{raw.lights[2]} and the ambient image"):
        to_radiance(replace(raw, ambient=raw.images[2:3].copy()), Sensor())


def test_computed_images_without_noise_may_be_equal_and_it_is_said() -> None:
    raw = replace(drawn(noise=0.0), step=1 / 255)
    same = to_radiance(with_copy(raw, 0, 3), Sensor())
    assert any("the same image twice" in note and "L0 and L3" in note for note in same.notes)
    assert not any("twice" in note for note in to_radiance(raw, Sensor()).notes)


def test_the_library_refuses_a_stack_with_an_image_twice() -> None:
    raw = drawn()
    stack = np.rint(255 * with_copy(raw, 0, 3).images).astype(np.uint8)
    with pytest.raises(DisagreementError, match="the same image twice"):
        lpcal.reconstruct(stack, calibration(), mask="none")


def test_numbers_over_the_stated_white_level_are_refused() -> None:
    raw = drawn()
    level = 0.3 * float(raw.images.max())
    with pytest.raises(DisagreementError, match="are over the white level, stated as"):
        to_radiance(raw, Sensor(white_level=level))
    clipped = replace(raw, images=np.minimum(raw.images, level))
    assert to_radiance(clipped, Sensor(white_level=level)).saturated.any()


def test_noise_about_the_white_level_is_no_contradiction() -> None:
    raw = drawn()
    level = 0.5 * float(raw.images.max())
    spread = np.random.default_rng(0).normal(0, 0.01 * level, raw.images.shape).astype(np.float32)
    to_radiance(replace(raw, images=np.where(raw.images >= level, level + spread, raw.images)), Sensor(white_level=level))


@pytest.mark.parametrize("place", [(0, 0), (1, 0)])
def test_a_mosaic_of_colours_is_refused(place: tuple[int, int]) -> None:
    raw = drawn()
    filters = np.full(raw.images.shape[1:], 1.0, np.float32)
    filters[place[0] :: 2, place[1] :: 2] = 0.6
    filters[1 - place[0] :: 2, 1 - place[1] :: 2] = 0.8
    with pytest.raises(DisagreementError, match=r"a mosaic of colours: of each 2x2 pixels one is \d\d % brighter"):
        to_radiance(replace(raw, images=raw.images * filters), Sensor())


def test_a_fine_pattern_on_the_object_is_no_mosaic() -> None:
    raw = drawn()
    weave = np.ones(raw.images.shape[1:], np.float32)
    weave[20:60:2, 20:60:2] = 0.5
    to_radiance(replace(raw, images=raw.images * weave), Sensor())


def in_a_room(level: float, of_ambient: float) -> RawCapture:
    """The scene in an evenly lit room, its ambient image so many times as bright as the room is."""
    raw = drawn()
    room = np.float32(level) * (1 + np.linspace(0, 1, raw.images.shape[2], dtype=np.float32))
    noise = np.random.default_rng(3).normal(0, 0.002, raw.images.shape[1:]).astype(np.float32)
    return replace(raw, images=0.7 * raw.images + room, ambient=(of_ambient * (room + np.zeros_like(noise)) + noise)[None])


def refused_or_not(raw: RawCapture) -> None:
    radiance = to_radiance(raw, Sensor())
    refuse_foreign_ambient(radiance, room_changes(radiance))


def test_places_where_a_light_saturates_say_nothing_of_the_room() -> None:
    rng, room = np.random.default_rng(4), np.full((200, 240), 0.2, np.float32)
    images = np.tile(1.05 * room, (4, 1, 1)) + rng.normal(0, 1e-3, (4, *room.shape)).astype(np.float32)
    for k in range(4):  # each light reaches a quarter of the picture
        images[k, :, 60 * k : 60 * (k + 1)] += 0.5
    raw = RawCapture("test", tuple("abcd"), images, np.ones(4), room[None], np.ones(1), step=1 / 65535)
    radiance = to_radiance(raw, Sensor())
    seen = room_changes(radiance)
    assert list(seen) == list(radiance.lights)
    assert [change for change, _ in seen.values()] == pytest.approx([0.05] * 4, abs=0.01)
    assert room_changes(replace(radiance, saturated=np.ones_like(radiance.saturated))) == {}
    one = radiance.saturated.copy()
    one[0] = True
    assert room_changes(replace(radiance, saturated=one)) == {
        light: change for light, change in seen.items() if light != radiance.lights[0]
    }


@pytest.mark.parametrize("times", [2.0, 4.0])
def test_an_ambient_image_of_another_exposure_is_refused(times: float) -> None:
    raw = in_a_room(0.08, times)
    with pytest.raises(DisagreementError, match="the places that no light reaches are darker than in the ambient image"):
        refused_or_not(raw)
    with pytest.raises(DisagreementError, match="ambient image"):
        lpcal.reconstruct(raw, calibration(), mask="none")


@pytest.mark.parametrize("times", [0.8, 1.0, 1.1])
def test_a_room_that_changes_a_little_is_not(times: float) -> None:
    refused_or_not(in_a_room(0.08, times))


def test_of_one_ambient_image_nothing_changes() -> None:
    raw = in_a_room(0.08, 4.0)
    radiance = to_radiance(raw, Sensor())
    assert not any("between its 1 images" in note for note in ambient_notes(radiance, raw, Sensor(), room_changes(radiance)))
