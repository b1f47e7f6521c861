"""Capture folders: what is taken, what is left out, what is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.capture import read_capture

LIGHTS = ["L0", "L1", "L2"]


def image(path: Path, level: int = 100, shape: tuple[Any, ...] = (20, 30), dtype: type[Any] = np.uint8) -> None:
    cv2.imwrite(str(path), np.full(shape, level, dtype))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    made = tmp_path / "jug"
    made.mkdir()
    for k, light in enumerate(LIGHTS):
        image(made / f"{light}.png", 100 + k)
    return made


def test_lights_ambient_short_mask_and_exposures(folder: Path) -> None:
    for name, level in (("ambient_0", 10), ("ambient_1", 12), ("short_L1", 7), ("mask", 1), ("ref", 50)):
        image(folder / f"{name}.png", level)
    (folder / "capture.yaml").write_text("exposure: 20 ms\ngain: 2.0\nexposures: {L2: 40 ms, short_L1: 0.5 ms}\ngains: {L2: 1.0}\n")
    found = read_capture(folder, LIGHTS)
    assert found.lights == ("L0", "L1", "L2")
    assert found.images.shape == (3, 20, 30)
    assert found.images[2, 0, 0] == pytest.approx(102 / 255)
    assert found.exposure_s == pytest.approx([0.04, 0.04, 0.04])
    assert found.ambient.shape == (2, 20, 30)
    assert found.short_exposure_s["L1"] == pytest.approx(0.001)
    assert found.mask.all()
    assert found.left_out == ("ref.png",)
    assert found.name == "jug"


def test_a_short_exposure_that_is_not_stated(folder: Path) -> None:
    image(folder / "short_L0.png", 3)
    (folder / "capture.yaml").write_text("exposure: 20 ms\n")
    assert read_capture(folder, LIGHTS).short_exposure_s == {"L0": None}


def test_sixteen_bits_and_colour_in_their_order(folder: Path) -> None:
    for light in LIGHTS:
        pixels = np.zeros((20, 30, 3), np.uint16)
        pixels[..., 2] = 65535  # OpenCV writes BGR: red
        cv2.imwrite(str(folder / f"{light}.png"), pixels)
    found = read_capture(folder, LIGHTS)
    assert found.images.shape == (3, 20, 30, 3)
    assert np.allclose(found.images[..., 0], 1)
    assert found.step == pytest.approx(1 / 65535)


def test_whether_the_images_are_stated_to_be_right(folder: Path) -> None:
    assert not read_capture(folder, LIGHTS).arrangement_stated
    (folder / "capture.yaml").write_text("arrangement: stated\n")
    assert read_capture(folder, LIGHTS).arrangement_stated


def test_a_subset_by_capture_yaml_and_by_use(folder: Path) -> None:
    (folder / "L1.png").unlink()
    (folder / "capture.yaml").write_text("lights: [L0, L2]\n")
    assert read_capture(folder, LIGHTS).lights == ("L0", "L2")
    assert read_capture(folder, LIGHTS, use=["L2"]).lights == ("L2",)


@pytest.mark.parametrize(
    ("spoil", "error", "words"),
    [
        (lambda f: (f / "L1.png").rename(f / "lamp.png"), DisagreementError, "no image of L1; found are also lamp"),
        (lambda f: image(f / "L2.png", shape=(20, 31)), DisagreementError, "31x20 grey, but L0.png is 30x20 grey"),
        (lambda f: image(f / "L2.png", shape=(20, 30, 3)), DisagreementError, "RGB"),
        (lambda f: (f / "L2.png").write_bytes(b"\x89PNG nothing"), InputError, "L2.png"),
        (lambda f: image(f / "mask.png", shape=(5, 5)), DisagreementError, "the mask is 5x5"),
        (lambda f: (f / "capture.yaml").write_text("exposure: 20\n"), InputError, "bare number"),
        (lambda f: (f / "capture.yaml").write_text("exposur: 20 ms\n"), InputError, "exposur"),
        (lambda f: (f / "capture.yaml").write_text("lights: [L0, L7]\n"), DisagreementError, "L7"),
        (lambda f: (f / "capture.yaml").write_text("arrangement: ok\n"), InputError, "arrangement"),
    ],
)
def test_what_is_wrong_is_said(folder: Path, spoil: Callable[..., Any], error: type[Exception], words: str) -> None:
    spoil(folder)
    with pytest.raises(error, match=words):
        read_capture(folder, LIGHTS)


def test_no_such_folder(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such folder"):
        read_capture(tmp_path / "nothing", LIGHTS)


@pytest.mark.parametrize(
    "text", ["exposures: {L0: 20 ms}", "exposures: {ambient: 40 ms}", "exposures: {L0: 1 ms, L1: 1 ms, ambient: 1 ms}"]
)
def test_exposures_of_some_images_and_none_of_the_others_are_refused(folder: Path, text: str) -> None:
    image(folder / "ambient.png", 5)
    (folder / "capture.yaml").write_text(f"{text}\n")
    with pytest.raises(InputError, match=r"an exposure of \w+\.png is stated, none of (?s:.*)state exposure: for all"):
        read_capture(folder, LIGHTS)
    (folder / "capture.yaml").write_text(f"exposure: 20 ms\n{text}\n")
    assert len(read_capture(folder, LIGHTS).exposure_s) == 3


def test_gains_without_an_exposure_are_refused(folder: Path) -> None:
    (folder / "capture.yaml").write_text("gains: {L0: 2}\n")
    with pytest.raises(InputError, match="a gain of L0, and no exposure"):
        read_capture(folder, LIGHTS)


@pytest.mark.parametrize("text", ["lights: L0, L2", "lights: 'L0,L2'", "lights: [L0, L2]"])
def test_lights_may_be_written_as_a_list_or_in_one_line(folder: Path, text: str) -> None:
    (folder / "capture.yaml").write_text(f"{text}\n")
    assert read_capture(folder, LIGHTS).lights == ("L0", "L2")


INSIDE = np.zeros((20, 30), np.uint8)
INSIDE[5:15, 8:20] = 255


@pytest.mark.parametrize("colour", [0, 255, 90])
def test_a_mask_may_be_how_opaque_an_image_is(folder: Path, colour: int) -> None:
    cv2.imwrite(str(folder / "mask.png"), np.dstack([np.full((20, 30, 3), colour, np.uint8), INSIDE]))
    found = read_capture(folder, LIGHTS).mask
    assert found is not None
    assert np.array_equal(found, INSIDE > 0)


def test_an_opaque_mask_is_what_is_not_zero(folder: Path) -> None:
    cv2.imwrite(str(folder / "mask.png"), np.dstack([INSIDE // 100, INSIDE // 100, INSIDE // 100, np.full_like(INSIDE, 255)]))
    found = read_capture(folder, LIGHTS).mask
    assert found is not None
    assert np.array_equal(found, INSIDE > 0)


def test_what_a_jpeg_makes_of_zero_is_no_mask(folder: Path) -> None:
    cv2.imwrite(str(folder / "mask.jpg"), INSIDE, [cv2.IMWRITE_JPEG_QUALITY, 40])
    stored = cv2.imread(str(folder / "mask.jpg"), cv2.IMREAD_GRAYSCALE)
    assert ((stored > 0) & (INSIDE == 0)).sum() > 20
    found = read_capture(folder, LIGHTS).mask
    assert found is not None
    assert (found != (INSIDE > 0)).sum() == 0
