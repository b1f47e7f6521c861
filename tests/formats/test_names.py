"""Names as people write them: what is there is found under the name it is known by, and what cannot be a name is refused."""

from __future__ import annotations

import math
import unicodedata
from pathlib import Path

import cv2
import numpy as np
import pytest

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.capture import read_capture
from lpcal.formats.panel_yaml import read_rig
from lpcal.pipeline.workspace import Workspace

COMPOSED, APART = (unicodedata.normalize(form, "M\u00fcnze") for form in ("NFC", "NFD"))


@pytest.fixture(autouse=True)
def without_rawpy(monkeypatch: pytest.MonkeyPatch) -> None:
    """As lpcal is installed without its extra for raw files."""
    monkeypatch.setattr("lpcal.formats.named_files.raw_is_read", lambda: False)
    monkeypatch.setattr("lpcal.formats.images.raw_is_read", lambda: False)


def image(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(cv2.imencode(path.suffix, np.full((20, 30), 99, np.uint8))[1].tobytes())
    return path


def images(folder: Path, *patterns: str) -> list[str]:
    (folder / "panel.yaml").write_text("lpcal: 1\ncamera:\n  images: []\n")
    found = Workspace(read_rig(folder / "panel.yaml")).images(patterns, "camera.images")
    return [path.relative_to(folder).as_posix() for path in found]


@pytest.mark.parametrize(
    ("there", "named", "found"),
    [
        (["b/v2.png", "b/v10.png", "b/._v2.png", "b/.DS_Store", "b/notes.txt"], "b", ["b/v2.png", "b/v10.png"]),
        (["b/v2.png", "b/._v2.png", "b/.v.png"], "b/*", ["b/v2.png"]),
        (["b/v2.png", "b/.v.png"], "b/*.png", ["b/v2.png"]),
        (["b [v2]/v.png"], "b [v2]/*.png", ["b [v2]/v.png"]),
        (["b [v2]/v [1].png"], "b [v2]/v [1].png", ["b [v2]/v [1].png"]),
        (["b [v2]/v.png"], "b [v2]", ["b [v2]/v.png"]),
        (["b/c/v.png"], "b\\c\\*.png", ["b/c/v.png"]),
        (["b/c/v.png"], "b\\c\\v.png", ["b/c/v.png"]),
        (["b/V.PNG"], "b/*", ["b/V.PNG"]),
        ([f"{APART}/v.png"], COMPOSED, [f"{APART}/v.png"]),
        ([f"{COMPOSED}/v.png"], f"{APART}/*.png", [f"{COMPOSED}/v.png"]),
        ([f"b/{APART}_1.png"], f"b/{COMPOSED}_*.png", [f"b/{APART}_1.png"]),
        ([f"b/{COMPOSED}_1.png"], f"b/{APART}_*.png", [f"b/{COMPOSED}_1.png"]),
    ],
)
def test_images_are_found_by_the_names_people_write(tmp_path: Path, there: list[str], named: str, found: list[str]) -> None:
    for name in there:
        image(tmp_path / name) if name.lower().endswith("png") else (tmp_path / name).write_bytes(b"")
    assert images(tmp_path, named) == found
    assert images(tmp_path, named, named) == found


@pytest.mark.parametrize(
    ("there", "named", "said"),
    [
        ("boards.avi", "boards.avi", ".avi is a video"),
        ("b/clip.MOV", "b", ".mov is a video"),
        ("b/1.CR2", "b/*", ".cr2 is a camera's raw file"),
        ("b/1.heic", "b/1.heic", ".heic is of a kind that is not read"),
        ("b/._1.png", "b", "no image matches b"),
        ("b/1.png", "b/1.png/2.png", "no image matches"),
        ("b/1.png", "b" * 300 + "/*.png", "no image matches|the pattern"),
        ("b/1.png", "../" + "x" * 5000, "no image matches|the pattern"),
        ("b/1.png", "[", "no image matches"),
        ("b/1.png", "**x/*.png", "no image matches|the pattern"),
        ("b/1.png", "/", "no image matches|the pattern"),
        ("b/1.png", "", "no image matches|the pattern"),
    ],
)
def test_what_is_no_image_is_said(tmp_path: Path, there: str, named: str, said: str) -> None:
    (tmp_path / there).parent.mkdir(exist_ok=True)
    (tmp_path / there).write_bytes(b"x")
    with pytest.raises(InputError, match=said) as caught:
        images(tmp_path, named)
    assert "panel.yaml:3, camera.images" in str(caught.value)
    assert len(str(caught.value)) < 600


@pytest.mark.parametrize(
    ("files", "light"),
    [
        ("IMG0.JPG", "img0"),
        (f"{APART}.png", COMPOSED),
        (f"{COMPOSED}.png", APART),
        (f"{APART.upper()}.PNG", COMPOSED),
        ("a [1].png", "a [1]"),
    ],
)
def test_a_captures_images_are_those_of_the_lights_whatever_their_spelling(tmp_path: Path, files: str, light: str) -> None:
    for name in (files, f"short_{files}", "Mask.PNG", "Ambient_0.png", f"._{files}"):
        image(tmp_path / name)
    (tmp_path / f"._{files}").write_bytes(b"\0\5\x16\7")
    (tmp_path / "capture.yaml").write_text(f"lights: ['{unicodedata.normalize('NFD', light)}']\n", encoding="utf-8")
    found = read_capture(tmp_path, [light])
    assert found.lights == (light,)
    assert (found.mask is not None, found.ambient is not None, list(found.short), found.left_out) == (True, True, [light], ())


def test_two_spellings_of_one_light_are_not_chosen_between(tmp_path: Path) -> None:
    for name in ("IMG0.png", "Img0.png"):
        image(tmp_path / name)
    with pytest.raises(DisagreementError, match="no image of img0; found are also IMG0, Img0"):
        read_capture(tmp_path, ["img0"])


@pytest.mark.parametrize(
    ("ending", "said"), [("CR2", "raw file"), ("NEF", "raw file"), ("mp4", "a video"), ("HEIC", "not read"), ("ptm", "relightable")]
)
def test_a_capture_of_what_is_no_picture_yet(tmp_path: Path, ending: str, said: str) -> None:
    (tmp_path / f"L0.{ending}").write_bytes(b"x")
    with pytest.raises(InputError, match=said):
        read_capture(tmp_path, ["L0"])


def test_a_relightable_image_in_place_of_its_photographs(tmp_path: Path) -> None:
    """Alone in the folder under a name of its own, or given as the folder itself."""
    file = tmp_path / "vase.rti"
    file.write_bytes(b"#HSH1.2\n")
    for given in (tmp_path, file):
        with pytest.raises(InputError, match="the photographs that it was made of"):
            read_capture(given, ["L0"])


@pytest.mark.parametrize("key", ["exposures: {LO: 20 ms}", "gains: {short_L7: 2}", "exposures: {ambient_1: 20 ms}"])
def test_an_exposure_of_no_image(tmp_path: Path, key: str) -> None:
    image(tmp_path / "L0.png")
    image(tmp_path / "ambient_0.png")
    (tmp_path / "capture.yaml").write_text(f"{key}\n")
    with pytest.raises(DisagreementError, match="which is no image there"):
        read_capture(tmp_path, ["L0"])


@pytest.mark.parametrize("folder", ["x" * 300, "a.png/b", "a.png", "nowhere"])
def test_a_capture_that_is_no_folder(tmp_path: Path, folder: str) -> None:
    image(tmp_path / "a.png")
    with pytest.raises(InputError, match="folder"):
        read_capture(tmp_path / folder, ["L0"])


BAD_NAMES = ["a/b", "..", ".", "../../x", "/etc/x", "a\\\\b", "C:x", "", " ", ".hidden", "x" * 250, "\u00fc" * 120, "a\\x07b", "a\\nb"]


@pytest.mark.parametrize("name", BAD_NAMES)
@pytest.mark.parametrize("section", ["objects", "spheres", "lights"])
def test_names_that_no_file_can_bear(tmp_path: Path, section: str, name: str) -> None:
    entry = {"objects": "objects/bust", "spheres": "{kind: matte, images: s}", "lights": "{}"}[section]
    (tmp_path / "panel.yaml").write_text(f'lpcal: 1\n{section}:\n  "{name}": {entry}\n', encoding="utf-8")
    with pytest.raises(InputError, match=rf"panel\.yaml:\d+, {section}: the name .* of .*\n  needed: a plain name") as caught:
        read_rig(tmp_path / "panel.yaml")
    assert len(str(caught.value)) < 600


@pytest.mark.parametrize("names", [("Bust", "bust"), (COMPOSED, APART), ("stra\u00dfe", "STRASSE")])
def test_names_that_some_systems_take_for_one(tmp_path: Path, names: tuple[str, str]) -> None:
    text = "".join(f'  "{name}": x\n' for name in names)
    (tmp_path / "panel.yaml").write_text(f"lpcal: 1\nobjects:\n{text}", encoding="utf-8")
    with pytest.raises(InputError, match=r"one on some systems|stands twice"):
        read_rig(tmp_path / "panel.yaml")


@pytest.mark.parametrize("name", ["ambient", "Mask", "short_L0", "ambient_3"])
def test_a_light_with_a_reserved_name(tmp_path: Path, name: str) -> None:
    (tmp_path / "panel.yaml").write_text(f"lpcal: 1\nlights: {{{name}: {{}}}}\n")
    with pytest.raises(InputError, match="a light called"):
        read_rig(tmp_path / "panel.yaml")


def test_plain_names_are_taken(tmp_path: Path) -> None:
    names = ["L0", "bust 2", "Münze", "a [1]", "x.y", "日本", "-1", "(3)"]
    for section in ("objects", "lights"):
        entries = "".join(f"  '{name}': {'x' if section == 'objects' else '{}'}\n" for name in names)
        (tmp_path / "panel.yaml").write_text(f"lpcal: 1\n{section}:\n{entries}", encoding="utf-8")
        assert list(getattr(read_rig(tmp_path / "panel.yaml").rig, section)) == names


@pytest.mark.parametrize(("azimuths", "refused"), [((10, 10), True), ((0, 360), True), ((-30, 330.2), True), ((0, 10), False)])
def test_two_wings_at_one_azimuth(tmp_path: Path, azimuths: tuple[float, float], refused: bool) -> None:
    wing = "joint_angle: 30 deg, disc_spacer: 28.9 mm, blob_spacer: 40 mm"
    lights = "".join(f"  L{k}: {{azimuth: {azimuth} deg, {wing}}}\n" for k, azimuth in enumerate(azimuths))
    (tmp_path / "panel.yaml").write_text(f"lpcal: 1\nlights:\n{lights}")
    if refused:
        with pytest.raises(InputError, match="the wings L0 and L1 both at an azimuth"):
            read_rig(tmp_path / "panel.yaml")
    else:
        assert read_rig(tmp_path / "panel.yaml").rig.lights["L1"].azimuth == pytest.approx(math.radians(10))


@pytest.mark.parametrize("angle", [91, -95, 1e4])
def test_a_joint_beyond_its_reach(tmp_path: Path, angle: float) -> None:
    wing = f"azimuth: 0 deg, joint_angle: {angle} deg, disc_spacer: 28.9 mm, blob_spacer: 40 mm"
    (tmp_path / "panel.yaml").write_text(f"lpcal: 1\nlights:\n  L0: {{{wing}}}\n")
    with pytest.raises(InputError, match=r"panel\.yaml:3, lights\.L0\.joint_angle: a joint at"):
        (
            read_rig(tmp_path / "panel.yaml")[
                ("IMG0.JPG", "img0"),
                (f"{APART}.png", COMPOSED),
                (f"{COMPOSED}.png", APART),
                (f"{APART.upper()}.PNG", COMPOSED),
                ("a [1].png", "a [1]"),
            ],
        )
