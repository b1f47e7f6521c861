"""Photographs as cameras write them: numbered names, exposures in EXIF, raw files; and the words that stand for a panel.yaml."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from exchange_readers import reader
from lpcal.errors import DisagreementError, InputError
from lpcal.formats.capture import check_lights, read_capture
from lpcal.formats.images import read_image

LIGHTS = ["L0", "L1", "L2"]


def photograph(path: Path, level: int = 100, time: float | None = None, iso: int = 100, f_number: float = 8.0) -> None:
    """A JPEG or PNG of one grey, with what a camera says of its exposure."""
    picture = Image.new("L", (30, 20), level)
    tags = Image.Exif()
    tags[305] = "firmware 1.0"  # Pillow writes no EXIF into a PNG whose first directory is empty
    if time is not None:
        held = tags.get_ifd(0x8769)
        held[33434], held[33437], held[34855] = time, f_number, iso
    picture.save(path, exif=tags, **({"quality": 95} if path.suffix == ".jpg" else {}))


def numbered(folder: Path, numbers: tuple[Any, ...] = (9, 10, 11), **more: Any) -> Path:
    folder.mkdir()
    for k, number in enumerate(numbers):
        photograph(folder / f"IMG_{number}.jpg", 60 + 40 * k, **more)
    return folder


def test_lights_by_the_order_of_the_images(tmp_path: Path) -> None:
    folder = numbered(tmp_path / "jug")
    photograph(folder / "ambient.jpg", 5)
    (folder / "capture.yaml").write_text("lights: IMG_*.jpg\n")
    found = read_capture(folder, LIGHTS)
    assert found.lights == ("L0", "L1", "L2")
    assert [round(255 * float(image.mean())) for image in found.images] == [60, 100, 140], "9 comes before 10"
    assert found.ambient.shape[0] == 1
    assert "lights by the order of IMG_*.jpg: L0 is IMG_9.jpg, ... L2 is IMG_11.jpg" in found.notes
    assert read_capture(folder, LIGHTS, use=["L1"]).lights == ("L1",)
    check_lights(folder, LIGHTS)


def test_another_number_of_images_than_of_lights(tmp_path: Path) -> None:
    folder = numbered(tmp_path / "jug", (1, 2, 3, 4))
    (folder / "capture.yaml").write_text("lights: IMG_*.jpg\n")
    with pytest.raises(DisagreementError, match="4 images match"):
        read_capture(folder, LIGHTS)
    (folder / "capture.yaml").write_text("lights: IMG_?.jpg\n")
    (folder / "IMG_4.jpg").rename(folder / "L1.jpg")
    with pytest.raises(DisagreementError, match="an image called L1 beside"):
        check_lights(folder, LIGHTS)


def test_exposures_by_exif_where_none_is_stated(tmp_path: Path) -> None:
    folder = tmp_path / "jug"
    folder.mkdir()
    for light, time, iso in zip(LIGHTS, (1 / 60, 1 / 30, 1 / 60), (100, 100, 400), strict=True):
        photograph(folder / f"{light}.jpg", time=time, iso=iso)
    photograph(folder / "short_L1.jpg", 9, time=1 / 250)
    found = read_capture(folder, LIGHTS)
    assert found.exposure_s / found.exposure_s[0] == pytest.approx([1, 2, 4])
    assert found.short_exposure_s["L1"] / found.exposure_s[1] == pytest.approx(30 / 250)
    assert any("by the images' EXIF tags, 1/60 s ISO 100 f/8 to 1/60 s ISO 400 f/8" in note for note in found.notes)


def test_a_changed_aperture_counts_and_is_said(tmp_path: Path) -> None:
    folder = tmp_path / "jug"
    folder.mkdir()
    for light, f_number in zip(LIGHTS, (8.0, 8.0, 4.0), strict=True):
        photograph(folder / f"{light}.jpg", time=1 / 60, f_number=f_number)
    found = read_capture(folder, LIGHTS)
    assert found.exposure_s / found.exposure_s[0] == pytest.approx([1, 1, 4])
    assert any("the aperture changes: f/4 to f/8" in note for note in found.notes)


def test_what_is_stated_counts_and_exif_that_contradicts_it_is_named(tmp_path: Path) -> None:
    folder = tmp_path / "jug"
    folder.mkdir()
    for light, time in zip(LIGHTS, (1 / 60, 1 / 60, 1 / 15), strict=True):
        photograph(folder / f"{light}.jpg", time=time)
    (folder / "capture.yaml").write_text("exposure: 16 ms\n")
    found = read_capture(folder, LIGHTS)
    assert found.exposure_s == pytest.approx([0.016] * 3)
    assert any("L2.jpg (1/15 s ISO 100 f/8) say otherwise" in note for note in found.notes)
    (folder / "capture.yaml").write_text("exposures: {L0: 16 ms, L1: 16 ms, L2: 64 ms}\n")
    assert not [note for note in read_capture(folder, LIGHTS).notes if "EXIF" in note], "1/60 s is 1/64 s: rounding is no contradiction"


def test_an_image_that_says_nothing_is_named(tmp_path: Path) -> None:
    folder = tmp_path / "jug"
    folder.mkdir()
    for light, time in zip(LIGHTS, (1 / 60, None, 1 / 15), strict=True):
        photograph(folder / f"{light}.jpg", time=time)
    found = read_capture(folder, LIGHTS)
    assert found.exposure_s == pytest.approx([1, 1, 1])
    assert any("L1.jpg has none: state them" in note for note in found.notes)


def test_exif_in_png_is_read_too(tmp_path: Path) -> None:
    photograph(tmp_path / "a.png", time=1 / 125, iso=800)
    assert read_image(tmp_path / "a.png").taken.words() == "1/125 s ISO 800 f/8"
    photograph(tmp_path / "b.png", time=0.0)
    assert read_image(tmp_path / "b.png").taken is None


COLOURS = {"RGGB": (0, 1, 1, 2), "BGGR": (2, 1, 1, 0), "GRBG": (1, 0, 2, 1), "GBRG": (1, 2, 0, 1)}
BLACK, WHITE = 512, 16383


def dng(path: Path, light: np.ndarray, pattern: str = "RGGB", time: tuple[int, int] = (1, 60)) -> None:
    """A raw file of a scene (H, W, 3), linear, 1 where the sensor saturates, as a DNG of 14 bit."""
    import tifffile

    rows, columns = np.indices(light.shape[:2])
    channel = np.array(COLOURS[pattern]).reshape(2, 2)[rows % 2, columns % 2]
    mosaic = np.take_along_axis(light, channel[..., None], axis=2)[..., 0]
    stored = np.rint(np.clip(BLACK + mosaic * (WHITE - BLACK), 0, WHITE)).astype(np.uint16)
    identity = tuple(value for k in range(9) for value in ((1, 1) if k in {0, 4, 8} else (0, 1)))
    tags = [
        (50706, "B", 4, (1, 4, 0, 0), True),
        (50707, "B", 4, (1, 1, 0, 0), True),
        (50708, "s", 0, "a camera that was drawn", True),
        (33421, "H", 2, (2, 2), True),
        (33422, "B", 4, COLOURS[pattern], True),
        (50710, "B", 3, (0, 1, 2), True),
        (50711, "H", 1, 1, True),
        (50714, "H", 1, BLACK, True),
        (50717, "H", 1, WHITE, True),
        (50721, "2i", 9, identity, True),
        (50778, "H", 1, 21, True),
        (33434, "2I", 1, time, True),
        (33437, "2I", 1, (8, 1), True),
    ]
    tifffile.imwrite(path, stored, photometric="cfa", extratags=tags, metadata=None)


def ramp() -> np.ndarray:
    y, x = np.mgrid[:48, :64]
    return np.stack([0.2 + 0.5 * x / 64, 0.3 + 0.2 * y / 48, 0.05 + 0.6 * (x + y) / 112], axis=-1)


@pytest.mark.parametrize("pattern", COLOURS)
def test_a_raw_file_is_the_sensors_own_linear_numbers(tmp_path: Path, pattern: str) -> None:
    reader("rawpy")
    dng(tmp_path / "a.dng", ramp(), pattern)
    found = read_image(tmp_path / "a.dng")
    assert found.size == (64, 48)
    inside = np.s_[2:-2, 2:-2]
    assert np.abs(found.pixels - ramp())[inside].max() < 2e-4, "a ramp is filled in exactly but for the rounding"
    assert found.step == pytest.approx(1 / (WHITE - BLACK))
    assert found.claim.gamma == 1.0
    assert found.taken.words() == "1/60 s f/8"


def test_noise_below_black_keeps_its_sign(tmp_path: Path) -> None:
    reader("rawpy")
    noise = np.random.default_rng(0).normal(0, 0.002, (64, 64, 3))
    dng(tmp_path / "dark.dng", noise)
    found = read_image(tmp_path / "dark.dng").pixels
    assert found.min() < -0.001
    assert abs(found.mean()) < 1e-4


def test_a_capture_of_raw_files_beside_their_pictures(tmp_path: Path) -> None:
    reader("rawpy")
    folder = tmp_path / "jug"
    folder.mkdir()
    for k, time in enumerate(((1, 60), (1, 30), (1, 60))):
        dng(folder / f"IMG_{k}.dng", ramp() * (0.4 + 0.2 * k), time=time)
        photograph(folder / f"IMG_{k}.jpg", 90)
    (folder / "capture.yaml").write_text("lights: IMG_*.dng\n")
    found = read_capture(folder, LIGHTS)
    assert found.images.shape == (3, 48, 64, 3)
    assert found.exposure_s / found.exposure_s[0] == pytest.approx([1, 2, 1])
    inside = np.s_[2:-2, 2:-2]
    assert np.abs(found.images[1][inside] - 0.6 * ramp()[inside]).max() < 2e-4


def test_a_raw_file_that_is_none(tmp_path: Path) -> None:
    reader("rawpy")
    (tmp_path / "L0.cr2").write_bytes(b"II*\0" + bytes(200))
    with pytest.raises(InputError, match="cannot be read as a raw file"):
        read_image(tmp_path / "L0.cr2")


@pytest.mark.slow
def test_raw_jpeg_and_tiff_of_one_scene_give_one_surface(tmp_path: Path) -> None:
    """The three ways in which a camera stores a scene: normals agree within their own standard deviations."""
    reader("rawpy")
    import cv2

    import lpcal

    S = np.array([[0.5, 0, -1], [-0.25, 0.45, -1], [-0.25, -0.45, -1], [0.1, 0.1, -1.2], [0.3, -0.5, -0.9]])
    S /= np.linalg.norm(S, axis=1, keepdims=True)
    dome = lpcal.Calibration("dome", tuple(lpcal.Light(f"L{k}", s, np.ones(1)) for k, s in enumerate(S)))
    y, x = np.mgrid[-1.2:1.2:64j, -1.2:1.2:64j]
    ball = x**2 + y**2 < 0.8
    n = np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0.1))], axis=-1)
    rng = np.random.default_rng(1)
    surfaces = []
    for ending in ("dng", "tif", "jpg"):
        folder = tmp_path / ending
        folder.mkdir()
        for k, s in enumerate([*S, np.zeros(3)]):
            shade = np.where(ball, np.clip(n @ s, 0, None), 0)[..., None] * [0.6, 0.5, 0.4] + rng.normal(0, 0.001, (64, 64, 3))
            path = folder / f"{f'L{k}' if k < len(S) else 'ambient'}.{ending}"
            if ending == "dng":
                dng(path, shade)
            elif ending == "tif":
                cv2.imwrite(str(path), np.rint(65535 * np.clip(shade, 0, 1)).astype(np.uint16)[..., ::-1])
            else:
                shown = np.where(shade <= 0.0031308, 12.92 * shade, 1.055 * np.clip(shade, 0.0031308, 1) ** (1 / 2.4) - 0.055)
                quality = [cv2.IMWRITE_JPEG_QUALITY, 100, cv2.IMWRITE_JPEG_SAMPLING_FACTOR, cv2.IMWRITE_JPEG_SAMPLING_FACTOR_444]
                cv2.imwrite(str(path), np.rint(255 * np.clip(shown, 0, 1)).astype(np.uint8)[..., ::-1], quality)
        if ending == "jpg":
            (folder / "capture.yaml").write_text("gamma: srgb\n")
        surfaces.append(lpcal.reconstruct(lpcal.read_capture(folder, dome), dome, mask=ball))
    inside = cv2.erode(ball.astype(np.uint8), np.ones((7, 7), np.uint8)) > 0
    for one in surfaces:
        for other in surfaces:
            cosine = np.clip(np.sum(one.normals * other.normals, axis=-1)[inside], -1, 1)
            sigma = np.sqrt(2 * (one.normal_std_deg[inside] ** 2 + other.normal_std_deg[inside] ** 2))
            apart = np.degrees(np.arccos(cosine))
            assert np.median(apart / np.maximum(sigma, 1e-6)) < 1.5
            assert np.median(apart) < 0.6


def test_half_of_the_words_for_a_camera_is_refused(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    photograph(tmp_path / "b.png")
    for words in (["b.png", "--corners", "9x6"], ["--corners", "9x6", "--square", "25mm"]):
        code, _, err = lpcal("intrinsics", *words, cwd=tmp_path)
        assert code == 2
        assert "IMAGES, --corners and --square" in err
    code, _, err = lpcal("intrinsics", "b.png", "--corners", "9x6", "--square", "25")
    assert code == 2
    assert "a length with its unit" in err
    code, _, err = lpcal("intrinsics", "b.png", "--corners", "9x6", "--square", "25mm")
    assert code == 4, "the words suffice, the images do not"
    assert "Traceback" not in err


@pytest.mark.slow
def test_a_camera_from_images_and_two_words(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    from lpcal import read_camera
    from lpcal.formats.bundled import folder

    boards = sorted((folder("calib_data") / "demo_rig" / "stations").glob("*.png"))
    code, out, err = lpcal("intrinsics", *boards, "--corners", "9x6", "--square", "25mm", cwd=tmp_path)
    assert code == 0, err
    assert "written     calib/camera.yaml" in out
    assert read_camera(tmp_path / "calib" / "camera.yaml").image_size == read_image(boards[0]).size
    assert not (tmp_path / "panel.yaml").exists()


@pytest.mark.parametrize("ending", ["jpg", "tif"])
@pytest.mark.parametrize(("turns", "named"), [((1, 1, 1), None), ((6, 6, 6), None), ((1, 3, 1), "L1"), ((6, 6, 8), "L2")])
def test_orientations_that_differ_within_a_capture_are_named(
    tmp_path: Path, ending: str, turns: tuple[int, ...], named: str | None
) -> None:
    for light, turn in zip(LIGHTS, turns, strict=True):
        tags = Image.Exif()
        tags[274] = turn
        picture = Image.new("L", (30, 20), 100)
        picture.paste(200, (0, 0, 10, 10))
        picture.save(tmp_path / f"{light}.{ending}", exif=tags)
    found = read_capture(tmp_path, LIGHTS)
    said = [note for note in found.notes if "orientation" in note]
    assert len(said) == (named is not None)
    assert all(f"{named}.{ending}" in note for note in said)
    assert found.images[:, :8, :8].min() > 0.7, "pixels as stored"


def test_an_image_turned_by_a_program_is_called_so(tmp_path: Path) -> None:
    for light, size in zip(LIGHTS, ((30, 20), (20, 30), (30, 20)), strict=True):
        Image.new("L", size, 100).save(tmp_path / f"{light}.jpg")
    with pytest.raises(DisagreementError, match=r"20x30 grey, but L0\.jpg is 30x20") as caught:
        read_capture(tmp_path, LIGHTS)
    assert "turned after it was taken" in str(caught.value.todo)
