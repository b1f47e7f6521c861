"""What stored numbers are fractions of, what their files claim of a tone curve, and what can be no light at all."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt
import pytest
import tifffile
from PIL import Image as Picture
from PIL import ImageCms, PngImagePlugin

from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.errors import InputError
from lpcal.formats.capture import read_capture
from lpcal.formats.full_scale import full_scale
from lpcal.formats.images import tone_claim
from lpcal.geometry.arrays import Array
from lpcal.geometry.tone_curve import decode, encode, worded
from lpcal.records.quantities import parse_gamma

LIGHTS = ["L0", "L1", "L2"]
SHAPE = (24, 30)
STEP = 1 / 65535


def counts(most: int, seed: int = 0) -> np.ndarray:
    """Numbers (3, H, W) up to `most`, which some reach."""
    found = np.random.default_rng(seed).integers(0, most, (3, *SHAPE))
    found[0, 3:6, 4:9] = most
    return found


@pytest.mark.parametrize(("bits", "shift"), [(10, 0), (12, 0), (14, 0), (10, 6), (12, 4), (14, 2)])
def test_fewer_bits_in_sixteen_show_their_white_level(bits: int, shift: int) -> None:
    images = ((counts(2**bits - 1) << shift) / 65535).astype(np.float32)
    found = full_scale(images, STEP)
    assert found.white_level == pytest.approx(((2**bits - 1) << shift) / 65535)
    assert found.divisor == 1
    assert (found.step or STEP) == pytest.approx((1 << shift) / 65535)


@pytest.mark.parametrize("images", [counts(65535), counts(4094), counts(3000), counts(65520) | 1])
def test_sixteen_bits_of_their_own_show_none(images: npt.NDArray[Any]) -> None:
    found = full_scale((images / 65535).astype(np.float32), STEP)
    assert (found.white_level, found.step, found.notes) == (None, None, ())


def test_twelve_bits_are_saturated_where_they_end(tmp_path: Path) -> None:
    for light, pixels in zip(LIGHTS, counts(4095), strict=True):
        cv2.imwrite(str(tmp_path / f"{light}.png"), pixels.astype(np.uint16))
    raw = read_capture(tmp_path, LIGHTS)
    assert raw.white_level == pytest.approx(4095 / 65535)
    found = to_radiance(raw, Sensor(white_level=raw.white_level))
    assert np.array_equal(found.saturated, counts(4095) == 4095)


@pytest.mark.parametrize(
    ("most", "divisor"), [(1.0, 1), (1.2, 1), (200.0, 255), (900.0, 1023), (3690.0, 4095), (4095.0, 4095), (40000.0, 65535), (1e6, 1e6)]
)
def test_floats_are_divided_by_the_full_scale_that_they_fit_in(most: float, divisor: float) -> None:
    found = full_scale(np.linspace(0, most, 3 * 20, dtype=np.float32).reshape(3, 4, 5), 1e-6)
    assert found.divisor == divisor
    assert bool(found.notes) == (divisor != 1)


def write_floats(folder: Path, values: Array, **others: Any) -> None:
    for light, pixels in zip(LIGHTS, values, strict=True):
        tifffile.imwrite(folder / f"{light}.tif", pixels.astype(np.float32))
    for name, pixels in others.items():
        tifffile.imwrite(folder / f"{name}.tif", pixels.astype(np.float32))


def with_one(value: float, base: np.ndarray) -> np.ndarray:
    found = base.astype(float).copy()
    found[2, 3] = value
    return found


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, -3000.0])
@pytest.mark.parametrize("name", ["L1", "ambient", "short_L0", "ambient_1"])
def test_what_is_no_light_is_refused_by_its_image(tmp_path: Path, value: float, name: str) -> None:
    values = counts(3600).astype(float)
    write_floats(tmp_path, values, ambient=0.01 * values[0], short_L0=0.1 * values[0])
    base = values[1] if name == "L1" else 0.01 * values[0]
    tifffile.imwrite(tmp_path / f"{name}.tif", with_one(value, base).astype(np.float32))
    with pytest.raises(InputError, match=rf"{name}\.tif: (1 pixels that are no finite|numbers down to -3000)"):
        read_capture(tmp_path, LIGHTS)


def test_the_noise_of_a_dark_frame_taken_away_is_kept_and_said(tmp_path: Path) -> None:
    values = counts(3600).astype(float)
    write_floats(tmp_path, values, ambient=with_one(-20.0, 0.01 * values[0]))
    raw = read_capture(tmp_path, LIGHTS)
    assert raw.ambient.min() == pytest.approx(-20 / 4095)
    assert any("down to -20 (ambient.tif)" in note for note in raw.notes)


def profile(curve: bytes) -> bytes:
    """An ICC profile that holds nothing but a red curve."""
    return bytes(128) + (1).to_bytes(4, "big") + b"rTRC" + (144).to_bytes(4, "big") + len(curve).to_bytes(4, "big") + curve


def power(gamma: float) -> bytes:
    return profile(b"curv\0\0\0\0" + (1).to_bytes(4, "big") + round(256 * gamma).to_bytes(2, "big"))


def parametric(*numbers: float) -> bytes:
    return profile(b"para\0\0\0\0\0\3\0\0" + b"".join(round(65536 * number).to_bytes(4, "big") for number in numbers))


def table(gamma: float, count: int = 1024) -> bytes:
    values = np.rint(65535 * np.linspace(0, 1, count) ** gamma).astype(">u2")
    return profile(b"curv\0\0\0\0" + count.to_bytes(4, "big") + values.tobytes())


SRGB = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
CHUNKS = {"sRGB": b"\0", "gAMA": (45455).to_bytes(4, "big"), "linear": (100000).to_bytes(4, "big")}


def stored(form: str, chunk: str = "", camera: str = "", **more: Any) -> bytes:
    picture, to = Picture.fromarray(np.full((16, 16, 3), 90, np.uint8)), io.BytesIO()
    if chunk:
        more["pnginfo"] = PngImagePlugin.PngInfo()
        more["pnginfo"].add({"linear": "gAMA"}.get(chunk, chunk).encode(), CHUNKS[chunk])
    if camera:
        more["exif"] = Picture.Exif()
        more["exif"][271] = camera
    picture.save(to, form, **more)
    return to.getvalue()


@pytest.mark.parametrize(
    ("data", "gamma"),
    [
        (stored("PNG", "sRGB"), "srgb"),
        (stored("PNG", "gAMA"), 2.2),
        (stored("PNG", "linear"), 1.0),
        (stored("PNG", icc_profile=SRGB), "srgb"),
        (stored("TIFF", icc_profile=SRGB), "srgb"),
        (stored("JPEG", icc_profile=SRGB), "srgb"),
        (stored("TIFF", icc_profile=power(2.19921875)), 2.2),
        (stored("PNG", icc_profile=power(1.8)), 1.8),
        (stored("TIFF", icc_profile=power(1.0)), 1.0),
        (stored("PNG", icc_profile=profile(b"curv\0\0\0\0\0\0\0\0")), 1.0),
        (stored("PNG", icc_profile=table(1.8)), 1.8),
        (stored("PNG", icc_profile=parametric(2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045)), "srgb"),
        (stored("JPEG", camera="Canon"), "srgb"),
        (stored("JPEG"), None),
        (stored("JPEG", icc_profile=b"rubbish"), None),
    ],
)
def test_what_files_claim_of_their_curve(data: bytes, gamma: str | float | None) -> None:
    assert tone_claim(data).gamma == gamma


@pytest.mark.parametrize(
    "data", [stored("PNG"), stored("TIFF"), stored("BMP"), b"", b"\x89PNG", stored("PNG", icc_profile=b"rubbish" * 30)]
)
def test_most_files_claim_nothing(data: bytes) -> None:
    assert tone_claim(data) is None


def test_images_that_claim_different_things_claim_nothing(tmp_path: Path) -> None:
    for light, chunk in zip(LIGHTS, ["sRGB", "sRGB", "gAMA"], strict=True):
        (tmp_path / f"{light}.png").write_bytes(stored("PNG", chunk))
    assert read_capture(tmp_path, LIGHTS).claim is None
    (tmp_path / "L2.png").write_bytes(stored("PNG", "sRGB"))
    assert read_capture(tmp_path, LIGHTS).claim.gamma == "srgb"


@pytest.mark.parametrize("gamma", [1.0, 0.5, 1.8, 2.2, "srgb"])
def test_curves_are_undone_by_each_other(gamma: float | str) -> None:
    linear = np.linspace(0, 1, 999)
    assert np.allclose(decode(encode(linear, gamma), gamma), linear, atol=1e-6)
    assert np.all(np.diff(decode(linear, gamma)) > 0)


def test_srgb_is_the_standards() -> None:
    assert np.allclose(decode(np.array([0.04, 0.5, 1.0]), "srgb"), [0.04 / 12.92, 0.21404114, 1.0])


@pytest.mark.parametrize(("text", "gamma"), [("2.2", 2.2), ("sRGB", "srgb"), (" srgb ", "srgb"), ("s-RGB", "srgb"), ("1", 1.0)])
def test_a_gamma_is_a_number_or_srgb(text: str, gamma: float | str) -> None:
    assert parse_gamma(text) == gamma
    assert parse_gamma(worded(gamma)) == gamma


@pytest.mark.parametrize("text", ["0", "-1", "nan", "12", "adobe", "", "2,2", "2.2 %"])
def test_no_gamma(text: str) -> None:
    with pytest.raises(ValueError, match="or srgb"):
        parse_gamma(text)
