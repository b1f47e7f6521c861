"""Images: whole or refused, whatever their heads promise, and their pixels as the sensor has them."""

from __future__ import annotations

import io
import struct
import zlib
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from PIL import Image

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.images import read_image, read_numbers, stacked
from lpcal.pipeline.intrinsics import search
from lpcal.pipeline.workspace import Workspace
from lpcal.records.observations import Board
from lpcal.records.rig import Rig, RigFile

GREY = np.random.default_rng(0).integers(0, 255, (60, 80)).astype(np.uint8)
PICTURES = {"grey": GREY, "sixteen": GREY.astype(np.uint16) * 257, "colour": np.stack([GREY, GREY // 2, GREY // 3], -1)}
TURN = 274
"""The tag that says how a picture is to be held."""


def encoded(pixels: np.ndarray, form: str, turn: int = 1, **how: Any) -> bytes:
    stream, exif = io.BytesIO(), Image.Exif()
    exif[TURN] = turn
    Image.fromarray(pixels).save(stream, form, exif=exif, **how)
    return stream.getvalue()


@pytest.mark.parametrize("turn", range(1, 9))
@pytest.mark.parametrize("name", PICTURES)
def test_a_tiff_that_is_to_be_turned_has_the_pixels_that_it_stores(tmp_path: Path, name: str, turn: int) -> None:
    (tmp_path / "a.tif").write_bytes(encoded(PICTURES[name], "TIFF", turn))
    full = 65535 if name == "sixteen" else 255
    np.testing.assert_allclose(read_image(tmp_path / "a.tif").pixels, PICTURES[name] / full, atol=1e-6)


@pytest.mark.parametrize("turn", [3, 6, 8])
@pytest.mark.parametrize("form", ["PNG", "JPEG"])
def test_other_images_too(tmp_path: Path, form: str, turn: int) -> None:
    for name, tag in (("turned", turn), ("plain", 1)):
        (tmp_path / f"{name}.{form.lower()}").write_bytes(encoded(GREY, form, tag))
    turned, plain = (read_image(tmp_path / f"{name}.{form.lower()}").pixels for name in ("turned", "plain"))
    np.testing.assert_array_equal(turned, plain)


def test_boards_whose_tags_differ_are_of_one_camera_where_their_stored_sizes_agree(tmp_path: Path) -> None:
    board, workspace = Board((4, 3), (0.025, 0.025)), Workspace(RigFile(Rig(lpcal=1), tmp_path / "panel.yaml"))
    paths = [tmp_path / f"v{k}.jpg" for k in range(4)]
    for k, path in enumerate(paths):
        path.write_bytes(encoded(GREY, "JPEG", (1, 3, 6, 8)[k]))
    assert search(workspace, paths, board, lambda *_: None).image_size == (80, 60)
    paths[2].write_bytes(encoded(np.ascontiguousarray(GREY.T), "JPEG", 1))
    with pytest.raises(DisagreementError, match="two sizes: 80x60"):
        search(workspace, paths, board, lambda *_: None)


@pytest.mark.parametrize("form", ["png", "jpg", "tif", "bmp", "pgm", "webp"])
@pytest.mark.parametrize("kept", [0.02, 0.5, 0.99])
def test_an_image_cut_off(tmp_path: Path, form: str, kept: float) -> None:
    whole = cv2.imencode(f".{form}", GREY)[1].tobytes()
    (tmp_path / f"a.{form}").write_bytes(whole[: int(kept * len(whole))])
    with pytest.raises(InputError, match=rf"a\.{form}: (the image is cut off|cannot be read as an image|the image is damaged)"):
        read_image(tmp_path / f"a.{form}")


@pytest.mark.parametrize("form", ["png", "tif"])
@pytest.mark.parametrize("place", [0.3, 0.6, 0.8])
def test_a_damaged_image(tmp_path: Path, form: str, place: float) -> None:
    damaged = bytearray(cv2.imencode(f".{form}", GREY)[1].tobytes())
    start = int(place * len(damaged))
    damaged[start : start + 30] = bytes(255 - byte for byte in damaged[start : start + 30])
    (tmp_path / f"a.{form}").write_bytes(damaged)
    with pytest.raises(InputError, match=r"cannot be read as an image|the image is damaged"):
        read_image(tmp_path / f"a.{form}")


def png_of(width: int, height: int) -> bytes:
    """The head of a PNG, and next to no pixels."""

    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(b"\0" * 10_000)) + chunk(b"IEND", b"")


BOMBS = {
    "png": png_of(100_000, 100_000),
    "wide.png": png_of(2_000_000_000, 1),
    "small.png": png_of(10_000, 10_000),
    "pgm": b"P5 90000 90000 255\n" + b"\0" * 100,
    "bmp": b"BM" + struct.pack("<IHHIIiiHHIIiiII", 154, 0, 0, 54, 40, 60_000, 60_000, 1, 24, 0, 100, 0, 0, 0, 0) + b"\0" * 100,
}


@pytest.mark.parametrize("name", BOMBS)
def test_an_image_that_promises_more_than_it_can_hold(tmp_path: Path, name: str) -> None:
    path = tmp_path / f"a.{name}"
    path.write_bytes(BOMBS[name])
    with pytest.raises(InputError, match="megapixels"):
        read_image(path)


def test_several_images_in_one_file(tmp_path: Path) -> None:
    first, *others = (Image.fromarray(GREY), Image.fromarray(GREY), Image.fromarray(GREY[::4, ::4]))
    first.save(tmp_path / "stack.tif", save_all=True, append_images=others[:1])
    with pytest.raises(InputError, match="2 images of 80x60 in one file"):
        read_image(tmp_path / "stack.tif")
    first.save(tmp_path / "preview.tif", save_all=True, append_images=others[1:])
    np.testing.assert_allclose(read_image(tmp_path / "preview.tif").pixels, GREY / 255, atol=1e-6)


def test_palettes_bits_and_alpha(tmp_path: Path) -> None:
    steps = (GREY // 64 * 85).astype(np.uint8)
    Image.fromarray(steps).convert("P").save(tmp_path / "palette.png")
    Image.fromarray(steps > 100).save(tmp_path / "bits.png")
    Image.fromarray(np.stack([steps, steps, steps, 255 - steps], -1)).save(tmp_path / "alpha.png")
    Image.fromarray(np.stack([steps, steps], -1)).save(tmp_path / "grey_alpha.png")
    for name in ("palette", "alpha", "grey_alpha"):
        pixels = read_image(tmp_path / f"{name}.png").pixels
        np.testing.assert_allclose(pixels if pixels.ndim == 2 else pixels[..., 0], steps / 255, atol=1e-6)
    assert set(np.unique(read_image(tmp_path / "bits.png").pixels)) == {0.0, 1.0}


@pytest.mark.parametrize("name", ["clip.AVI", "shot.CR2", "shot.heic"])
def test_what_is_no_picture_yet_is_named(tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("lpcal.formats.named_files.raw_is_read", lambda: False)  # as installed without the extra for raw files
    monkeypatch.setattr("lpcal.formats.images.raw_is_read", lambda: False)
    (tmp_path / name).write_bytes(b"RIFF")
    with pytest.raises(InputError, match="turn it into PNG or TIFF first"):
        read_image(tmp_path / name)


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, np.float32])
@pytest.mark.parametrize("channels", [(), (3,)])
def test_images_are_stacked_as_each_is_read(tmp_path: Path, dtype: type[Any], channels: tuple[int, ...]) -> None:
    rng, paths = np.random.default_rng(1), [tmp_path / f"{k}.tiff" for k in range(3)]
    for path in paths:
        numbers = rng.uniform(0, 1, (7, 9, *channels)) * (1 if dtype is np.float32 else np.iinfo(dtype).max)
        cv2.imwrite(str(path), numbers.astype(dtype))
    found = stacked(paths, read_numbers, (7, 9, *channels))
    assert found.dtype == np.float32
    assert np.array_equal(found, np.stack([read_image(path).pixels for path in paths]))
