"""YAML from anybody: no text of it crashes, hangs or fills the memory, and what is wrong has its line."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from lpcal.errors import InputError
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.documents import read_document
from lpcal.formats.panel_yaml import read_capture_section, read_rig


def laughs(sign: str) -> str:
    """Twelve levels, each nine aliases of the one before: 9^11 values."""
    first = "a0: &a0 {x: 1, y: 2}\n"
    return first + "".join(sign.format(k=k, before=", ".join([f"*a{k - 1}"] * 9)) for k in range(1, 12))


HOSTILE = {
    "a billion laughs": laughs("a{k}: &a{k} [{before}]\n"),
    "a billion merges": laughs("a{k}: &a{k} {{<<: [{before}]}}\n"),
    "a section in itself": "a: &a\n  b: *a\n",
    "brackets": "a: " + "[" * 100_000,
    "braces": "a: " + "{a: " * 100_000,
    "dashes": "- " * 50_000,
    "questions": "? " * 50_000,
    "steps": "".join(" " * k + "a:\n" for k in range(300)),
    "many steps": "".join(" " * k + "-\n" for k in range(3000)),
    "a key twice": "a: {b: 1, c: 2,\n b: 3}\n",
    "a section for a key": "? {a: 1}\n: 2\n",
    "a call": "a: !!python/object/apply:os.system [ls]\n",
}
READERS: dict[str, Callable[[Path], object]] = {
    "panel.yaml": read_rig,
    "capture.yaml": read_capture_section,
    "camera.yaml": lambda path: read_document(path, "camera"),
    "camchain.yaml": read_camera_file,
    "opencv.yml": read_camera_file,
}


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE)
def test_hostile_yaml_is_refused_with_its_line(tmp_path: Path, text: str, reader: str) -> None:
    path = tmp_path / reader
    path.write_text(("%YAML:1.0\n---\n" if reader == "opencv.yml" else "lpcal: 1\n" * (text[0] != "-")) + text)
    with pytest.raises(InputError, match=rf"{reader}:\d+") as caught:
        READERS[reader](path)
    assert len(str(caught.value)) < 600


@pytest.mark.parametrize("number", ["9" * 1_000_000, "0x" + "f" * 100_000, "9" * 100_000 + ".0"])
@pytest.mark.parametrize("reader", ["camera.yaml", "camchain.yaml"])
def test_a_number_without_end(tmp_path: Path, number: str, reader: str) -> None:
    path = tmp_path / reader
    path.write_text(f"lpcal: 1\nkind: camera\nK: {number}\n")
    with pytest.raises(InputError, match=rf"{reader}:3: K: a number of \d+ characters"):
        READERS[reader](path)


def test_aliases_that_a_person_writes(tmp_path: Path) -> None:
    path = tmp_path / "panel.yaml"
    wing = "joint_angle: 30 deg, disc_spacer: 28.9 mm, blob_spacer: 40 mm"
    path.write_text(f"lpcal: 1\nlights:\n  L0: &wing {{azimuth: 0 deg, {wing}}}\n  L1: {{<<: *wing, azimuth: 90 deg}}\n")
    lights = read_rig(path).rig.lights
    assert lights["L1"].blob_spacer == lights["L0"].blob_spacer == 0.04
