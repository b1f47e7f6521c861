"""panel.yaml: an example of every section is read whole, and every mistake that a person makes is one message with its line."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lpcal.errors import InputError
from lpcal.formats import panel_yaml
from lpcal.records import quantities
from lpcal.records.rig import Section

EXAMPLE = """\
lpcal: 1
name: lightpanel-6
camera:
  images: stations/*.png            # board views for the intrinsics: a pattern, a name or a list of them
  model: auto                       # auto | opencv4 | opencv5 | opencv8 | splined
  black_level: 0.8 %                # optional (0 %), of the file's full scale (255 or 65535), so that it holds for every bit depth
  white_level: 100 %                # optional, where the sensor saturates; 6.25 % for 12 bits stored low in 16
  gamma: 1.0                        # optional, stored = linear^(1/gamma)
  flat_field: flat.png              # optional, image of an evenly lit target
  cameramodel: other.cameramodel    # optional, skips the solve
board:
  kind: chessboard                  # chessboard | charuco
  corners: [9, 6]                   # inner corners along x, along y
  square: 25 mm                     # or square: [24.9 mm, 25.1 mm] as measured along x, y
  warp: auto                        # auto | none
  marker: 18 mm
  dictionary: DICT_5X5_100
mocap:
  file: mocap.csv                   # format found from the file itself
  body: LightPanel                  # needed when the file holds several bodies
  images: [stations.csv, sweep.csv] # one name or a list
  board_poses: {file: H_CB.csv, direction: H_CB}
  poses: robot.csv
  direction: H_OP
  quaternion: xyzw
  units: m
  clock_offset: estimate
panel:
  disc_radius: 60 mm
  joint: 15 mm
  blob: 30 mm
  markers: {Marker1: [81 mm, 0 mm, 4 mm], Marker2: [-40 mm, 70 mm, 4 mm]}
  camera: {position: [0 mm, 0 mm, 0 mm], tolerance: [2 mm, 1 deg]}
  tolerance: {azimuth: 0.5 deg, joint_angle: 1 deg, length: 0.5 mm, intensity: 10 %}
lights:
  L0: {azimuth: 0 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 19}
  L1: {}
  L2:
spheres:
  chrome_0: {kind: chrome, radius: 25 mm, images: spheres/chrome_0}
  matte_0:  {kind: matte,  radius: 25 mm, images: spheres/matte_0, hint: [310 px, 200 px, 90 px]}
objects:
  bust: objects/bust
"""

MESSAGES = {
    "bare number": (
        "lpcal: 1\nboard:\n  corners: [9, 6]\n  square: 25\n",
        "panel.yaml:4, board.square: a bare number, 25\n  needed: a length with its unit, such as 25 mm",
    ),
    "bare number in a list": (
        "lpcal: 1\nboard:\n  corners: [9, 6]\n  square: [25 mm,\n    26]\n",
        "panel.yaml:5, board.square.1: a bare number, 26\n  needed: a length with its unit, such as 25 mm",
    ),
    "bare share": (
        "lpcal: 1\ncamera: {black_level: 0.8}\n",
        "panel.yaml:2, camera.black_level: a bare number, 0.8\n  needed: a percentage with its unit, such as 0.8 %",
    ),
    "bare time": (
        "lpcal: 1\nmocap: {clock_offset: 12.5}\n",
        "panel.yaml:2, mocap.clock_offset: a bare number, 12.5\n  needed: a time with its unit, such as 20 ms",
    ),
    "bare pixels": (
        "lpcal: 1\nspheres:\n  a: {kind: chrome, images: x, hint: [310, 200 px, 90 px]}\n",
        "panel.yaml:3, spheres.a.hint.0: a bare number, 310\n  needed: a number of pixels with its unit, such as 310 px",
    ),
    "another kind's unit": (
        "lpcal: 1\npanel:\n  disc_radius: 60 deg\n  joint: 15 mm\n  blob: 30 mm\n",
        "panel.yaml:3, panel.disc_radius: unknown unit 'deg' of a length\n  needed: one of: m, cm, mm, um, µm, in",
    ),
    "decimal comma": (
        'lpcal: 1\nboard:\n  corners: [9, 6]\n  square: "25,5 mm"\n',
        "panel.yaml:4, board.square: '25,5 mm' is not a length\n  needed: a number (with a decimal point) and its unit, such as 25 mm",
    ),
    "negative length": (
        "lpcal: 1\nboard:\n  corners: [9, 6]\n  square: -25 mm\n",
        "panel.yaml:4, board.square: -25 mm is not more than 0\n  needed: a length, such as 25 mm",
    ),
    "infinite length": (
        "lpcal: 1\npanel: {disc_radius: 1e999 m, joint: 15 mm, blob: 30 mm}\n",
        "panel.yaml:2, panel.disc_radius: 1e999 m is beyond all bounds\n  needed: a length, such as 25 mm",
    ),
    "share over all": (
        "lpcal: 1\ncamera: {white_level: 255 %}\n",
        "panel.yaml:2, camera.white_level: 255 % is out of range\n  needed: 0 % to 100 %",
    ),
    "black over white": (
        "lpcal: 1\ncamera: {black_level: 8 %, white_level: 6.25 %}\n",
        "panel.yaml:2, camera: black_level, 8 %, is not below white_level, 6.25 %\n  needed: black below white",
    ),
    "unknown section": (
        "lpcal: 1\ncamra: {}\n",
        "panel.yaml:2, camra: unknown key\n"
        "  needed: one of: lpcal, name, camera, board, mocap, panel, lights, spheres, objects, joint_solve\n"
        "  do: write camera",
    ),
    "misspelled key of two mistakes": (
        "lpcal: 1\nboard:\n  corners: [9, 6]\n  squares: 25 mm\n",
        "panel.yaml:4, board.squares: unknown key (the first of 2 mistakes)\n"
        "  needed: one of: kind, corners, square, warp, corner_fit, marker, dictionary, marks\n  do: write square",
    ),
    "unknown key of a light": (
        "lpcal: 1\nlights:\n  L0: {colour: red}\n",
        "panel.yaml:3, lights.L0.colour: unknown key\n  needed: one of: azimuth, joint_angle, disc_spacer, blob_spacer, leds, lobe\n"
        "  do: correct the key's spelling, or remove it",
    ),
    "missing key": (
        "lpcal: 1\nboard:\n  square: 25 mm\n",
        "panel.yaml:2, board.corners: the key is missing\n  needed: a value for it\n  do: add corners:",
    ),
    "nothing behind a key": (
        "lpcal: 1\nboard:\n  corners: [9, 6]\n  square:\n",
        "panel.yaml:4, board.square: the key is missing\n  needed: a value for it\n  do: add square:",
    ),
    "nothing behind a sphere": (
        "lpcal: 1\nspheres:\n  chrome_0:\n",
        "panel.yaml:3, spheres.chrome_0.kind: the key is missing (the first of 2 mistakes)\n  needed: a value for it\n  do: add kind:",
    ),
    "nothing behind an object": ("lpcal: 1\nobjects:\n  bust:\n", "panel.yaml:3, objects.bust: None\n  needed: a name or a text"),
    "no version": (
        "name: x\n",
        "panel.yaml, lpcal: the key is missing\n  needed: a value for it\n  do: write lpcal: 1 at the top of the file",
    ),
    "another version": ("lpcal: 2\n", "panel.yaml:1, lpcal: 2\n  needed: one of: 1\n  do: write lpcal: 1 at the top of the file"),
    "twice": (
        "lpcal: 1\nlights:\n  L0: {}\n  L1: {}\n  L0: {}\n",
        "panel.yaml:5: the key lights.L0 stands twice, first in line 3\n  needed: each key once\n  do: remove one of them",
    ),
    "half a file": (
        "lpcal: 1\nlights:\n  L0: {azimuth: 0 deg, joint_an",
        "panel.yaml:3: ends in the middle of a [list] or a {section}\n  needed: the whole file\n  do: close it, or fetch the file again",
    ),
    "half a wing": (
        "lpcal: 1\nlights:\n  L0: {azimuth: 0 deg, joint_angle: 30 deg, blob_spacer: 40 mm}\n",
        "panel.yaml:3, lights.L0: a wing without disc_spacer\n  needed: all of azimuth, joint_angle, disc_spacer, blob_spacer, or none",
    ),
    "a tab": (
        "lpcal: 1\nboard:\n\tcorners: [9, 6]\n",
        "panel.yaml:3: not YAML: found character '\\t' that cannot start any token\n  needed: key: value lines\n  do: correct that line",
    ),
    "a control character": (
        'lpcal: 1\nname: "a\x00b"\n',
        "panel.yaml: not text: a control character in line 2\n  needed: a text file\n  do: is it another kind of file?",
    ),
    "a section in itself": (
        "lpcal: 1\nlights: &a\n  L0: *a\n",
        "panel.yaml:2: a section that contains itself\n  needed: sections that end, without * and &\n  do: write it out",
    ),
    "not a list": ("lpcal: 1\nboard: {corners: 9, square: 25 mm}\n", "panel.yaml:2, board.corners: 9\n  needed: a list such as [9, 6]"),
    "three for two": (
        "lpcal: 1\nboard: {corners: [9, 6, 3], square: 25 mm}\n",
        "panel.yaml:2, board.corners: 3 values\n  needed: 2 values",
    ),
    "too small a count": ("lpcal: 1\nboard: {corners: [9, 1], square: 25 mm}\n", "panel.yaml:2, board.corners.1: 1\n  needed: at least 2"),
    "not a number": (
        "lpcal: 1\ncamera: {gamma: high}\n",
        "panel.yaml:2, camera.gamma: high\n  needed: a number between 0.1 and 10, or srgb",
    ),
    "not whole": ("lpcal: 1\nlights: {L0: {leds: 19.5}}\n", "panel.yaml:2, lights.L0.leds: 19.5\n  needed: a whole number"),
    "not one of": (
        "lpcal: 1\ncamera: {model: opencv12}\n",
        "panel.yaml:2, camera.model: opencv12\n  needed: one of: auto, opencv4, opencv5, opencv8, splined",
    ),
    "not a section": ("lpcal: 1\nboard: chessboard\n", "panel.yaml:2, board: chessboard\n  needed: a section of key: value lines"),
    "a list": ("- lpcal: 1\n", "panel.yaml:1: not a mapping of keys to values\n  needed: key: value lines"),
    "empty": ("# nothing yet\n", "panel.yaml: empty\n  needed: key: value lines"),
}


@pytest.fixture
def panel(tmp_path: Path) -> Path:
    return tmp_path / "panel.yaml"


def test_an_example_of_every_section_is_read_whole(panel: Path) -> None:
    panel.write_text(EXAMPLE)
    rig_file = panel_yaml.read_rig(panel)
    rig = rig_file.rig
    for section in (rig.camera, rig.board, rig.mocap, rig.panel):
        assert section is not None
    assert (rig.name, rig.camera.images, rig.camera.black_level, rig.camera.gamma) == ("lightpanel-6", ["stations/*.png"], 0.008, 1.0)
    assert (rig.board.corners, rig.board.square, rig.board.marker) == ((9, 6), (0.025, 0.025), 0.018)
    assert rig.mocap.images == ["stations.csv", "sweep.csv"]
    assert rig.mocap.board_poses.model_dump() == {"file": "H_CB.csv", "direction": "H_CB"}
    assert rig.mocap.clock_offset == "estimate"
    assert rig.panel.markers == {"Marker1": (0.081, 0.0, 0.004), "Marker2": (-0.04, 0.07, 0.004)}
    assert rig.panel.camera.tolerance == (0.002, math.radians(1))
    assert rig.panel.tolerance.intensity == pytest.approx(0.1)
    assert list(rig.lights) == ["L0", "L1", "L2"]
    assert [light.is_wing for light in rig.lights.values()] == [True, False, False]
    assert rig.lights["L0"].joint_angle == pytest.approx(math.pi / 6)
    assert rig.lights["L0"].leds == 19
    assert rig.spheres["matte_0"].hint == (310.0, 200.0, 90.0)
    assert rig.objects == {"bust": "objects/bust"}
    assert rig_file.where("board.square") == f"{panel}:14, board.square"
    assert rig_file.where("spheres.chrome_0.hint") == f"{panel}:40, spheres.chrome_0.hint"


def test_every_section_is_optional(panel: Path) -> None:
    panel.write_text("lpcal: 1\ncamera:\npanel:\nlights:\nspheres:\nobjects:\n")
    rig = panel_yaml.read_rig(panel).rig
    assert (rig.camera, rig.panel, rig.lights, rig.spheres, rig.objects) == (None, None, {}, {}, {})


@pytest.mark.parametrize(("text", "message"), MESSAGES.values(), ids=MESSAGES)
def test_a_mistake_is_one_message_with_its_line(panel: Path, text: str, message: str) -> None:
    panel.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        panel_yaml.read_rig(panel)
    assert str(caught.value).replace(f"{panel.parent}/", "") == message
    assert caught.value.exit_code == 3


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_a_file_of_whatever_encoding(panel: Path, encoding: str) -> None:
    panel.write_bytes("lpcal: 1\r\nname: Münze\r\n".encode(encoding))
    assert panel_yaml.read_rig(panel).rig.name == "Münze"


def test_a_file_that_is_no_text(panel: Path) -> None:
    panel.write_bytes(b"\x89PNG\r\n\x1a\n\x00")
    with pytest.raises(InputError, match=r"panel\.yaml: not text"):
        panel_yaml.read_rig(panel)


def test_a_file_that_is_not_there(panel: Path) -> None:
    with pytest.raises(InputError, match=r"panel\.yaml: no such file"):
        panel_yaml.read_rig(panel)


@pytest.mark.parametrize("cut", range(1, len(EXAMPLE), 7))
def test_a_file_cut_anywhere_is_read_or_refused(panel: Path, cut: int) -> None:
    panel.write_text(EXAMPLE[:cut])
    try:
        told = panel_yaml.read_rig(panel).where("")
    except InputError as error:
        told = str(error)
    assert told.startswith(str(panel))


def test_windows_line_ends_and_a_byte_order_mark(panel: Path) -> None:
    panel.write_bytes(b"\xef\xbb\xbflpcal: 1\r\nboard:\r\n  corners: [9, 6]\r\n  square: 25\r\n")
    with pytest.raises(InputError, match=r"panel\.yaml:4, board\.square"):
        panel_yaml.read_rig(panel)


def test_names_stay_as_written(panel: Path) -> None:
    panel.write_text("lpcal: 1\nname: 2024-01-01\nlights: {1: {}, on: {}, 0x10: {}, 1e3: {}, 12:30: {}}\nobjects: {1: 007}\n")
    rig = panel_yaml.read_rig(panel).rig
    assert rig.name == "2024-01-01"
    assert list(rig.lights) == ["1", "on", "0x10", "1e3", "12:30"]
    assert rig.objects == {"1": "007"}


def test_one_wing_may_be_written_after_another(panel: Path) -> None:
    wing = "{azimuth: 0 deg, joint_angle: 30 deg, disc_spacer: 1 mm, blob_spacer: 2 mm}"
    panel.write_text(f"lpcal: 1\nlights:\n  L0: &wing {wing}\n  L1: {{<<: *wing, azimuth: 60 deg}}\n")
    lights = panel_yaml.read_rig(panel).rig.lights
    assert lights["L1"].azimuth == pytest.approx(math.pi / 3)
    assert lights["L1"].blob_spacer == lights["L0"].blob_spacer == 0.002


def test_capture_yaml(tmp_path: Path) -> None:
    capture = tmp_path / "capture.yaml"
    assert panel_yaml.read_capture_section(capture).exposure is None
    capture.write_text("exposure: 20 ms\ngain: 2\nexposures: {L0: 500 us, short_L0: 0.5 ms}\nlights: [L0, 3]\n")
    section = panel_yaml.read_capture_section(capture)
    assert (section.exposure, section.gain, section.lights) == (0.02, 2.0, ["L0", "3"])
    assert section.exposures == {"L0": pytest.approx(5e-4), "short_L0": 5e-4}
    for text, told in {
        "exposure: 20\n": "a bare number, 20",
        "gain: 0\n": "more than 0",
        "exposures: {L0: 0 ms}\n": "not more than 0",
    }.items():
        capture.write_text(text)
        with pytest.raises(InputError, match=rf"capture\.yaml:1, (?s:.)*{told}"):
            panel_yaml.read_capture_section(capture)


def test_panel_yaml_is_found_above(panel: Path) -> None:
    panel.write_text("lpcal: 1\n")
    below = panel.parent / "objects" / "bust"
    below.mkdir(parents=True)
    assert panel_yaml.find(below) == panel_yaml.find(panel) == panel
    with pytest.raises(InputError, match="no such file or folder"):
        panel_yaml.find(panel.parent / "nothing")


KINDS = {kind: list(units) for kind, units in quantities.UNITS.items()}


@given(st.sampled_from(sorted(KINDS)), st.data(), st.floats(-1e6, 1e6), st.sampled_from(["", " ", "  ", "\t"]))
def test_a_quantity_is_read_as_written(kind: str, draw: st.DataObject, value: float, space: str) -> None:
    unit = draw.draw(st.sampled_from(KINDS[kind]))
    assert quantities.parse(f" {value!r}{space}{unit} ", kind) == pytest.approx(value * quantities.UNITS[kind][unit], rel=1e-15)


@given(st.sampled_from(sorted(KINDS)), st.floats(allow_nan=False, allow_infinity=False) | st.integers())
def test_a_bare_number_is_never_a_quantity(kind: str, value: float) -> None:
    for written in (value, repr(value)):
        with pytest.raises(ValueError, match="a bare number"):
            quantities.parse(written, kind)


@given(st.sampled_from(sorted(KINDS)), st.text(max_size=12))
def test_any_text_is_a_quantity_or_says_what_was_needed(kind: str, text: str) -> None:
    try:
        told = f"{quantities.parse(text, kind)}; a number"
    except ValueError as error:
        told = str(error)
    found, _, needed = told.rpartition("; ")
    assert found
    assert needed


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("25 mm", "length", 0.025),
        ("+.5cm", "length", 0.005),
        ("5 μm", "length", 5e-6),
        ("5 µm", "length", 5e-6),
        ("1 in", "length", 0.0254),
        ("18 mm", "length", 0.018),
        ("30°", "angle", math.radians(30)),
        ("-12.5 ms", "time", -0.0125),
        ("0.8 %", "share", 0.008),
        ("6.25%", "share", 0.0625),
        ("310 px", "pixels", 310.0),
    ],
)
def test_quantities(text: str, kind: str, value: float) -> None:
    assert quantities.parse(text, kind) == value


PAGE = (Path(__file__).resolve().parents[2] / "docs" / "reference" / "written-files.md").read_text(encoding="utf-8")


def blocks(heading: str) -> str:
    """The yaml of the page below a heading, its blocks joined."""
    (section,) = re.findall(rf"^## {re.escape(heading)}$(.*?)(?=^## |\Z)", PAGE, re.MULTILINE | re.DOTALL)
    return "".join(re.findall(r"^```yaml\n(.*?)^```$", section, re.MULTILINE | re.DOTALL))


def lacking(value: object) -> Iterator[str]:
    """Keys of the sections within a section that were not written."""
    for inner in value.values() if isinstance(value, dict) else [value]:
        if isinstance(inner, Section):
            yield from sorted(
                {f"{type(inner).__name__}.{key}" for key in type(inner).model_fields}
                - {f"{type(inner).__name__}.{key}" for key in inner.model_fields_set}
            )
            for key in inner.model_fields_set:
                yield from lacking(getattr(inner, key))


def test_the_page_of_written_files_holds_every_key(panel: Path) -> None:
    panel.write_text(blocks("panel.yaml"), encoding="utf-8")
    rig = panel_yaml.read_rig(panel).rig
    elsewhere = {key.partition(".")[0]: 0 for key in lacking(rig)}
    assert set(elsewhere) <= {"LightSection", "SphereSection"}, "each of several lights and spheres has some of the keys"
    for several in (rig.lights, rig.spheres):
        assert set().union(*(one.model_fields_set for one in several.values())) == set(type(next(iter(several.values()))).model_fields)
    capture = panel.with_name("capture.yaml")
    capture.write_text(blocks("capture.yaml"), encoding="utf-8")
    assert set(lacking(panel_yaml.read_capture_section(capture))) == {"PoseSection.H_OC", "WrittenTransform.rotation_vector"}
