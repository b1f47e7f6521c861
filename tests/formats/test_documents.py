"""Documents: of a kind and a version, every digit kept, left alone where they would say the same."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from lpcal.errors import InputError
from lpcal.formats.documents import plain, read_document, sha256, write_document
from lpcal.records.provenance import Provenance

PROVENANCE = Provenance(inputs={"stations.csv": "0" * 64}, options={"model": "auto"}, time="2026-01-01T00:00:00+00:00")


def test_numpy_values_and_nan(tmp_path: Path) -> None:
    path = tmp_path / "camera.yaml"
    body = {
        "K": np.array([[600.5, 0.0, np.nan], [0.0, np.inf, 240.0]]),
        "count": np.int64(3),
        "used": np.bool_(True),
        "single": np.float32(0.1),
        "none": None,
        "scalar": np.array(2.5),
        "mask": np.array([True, False]),
        "file": Path("a/b.png"),
        "size": (752, 480),
        "text": np.str_("L0"),
        "names": np.array(["L0", "L1"]),
        "mean": {"nan": math.nan, 7: -0.0},
        "words": "ambiguous: yes, on, 1e3, 12:30, ° µ\n",
        "yes": "no",
    }
    write_document(path, "camera", body, PROVENANCE)
    found = read_document(path, "camera")
    assert list(found)[:3] == ["lpcal", "kind", "K"]
    assert found["K"] == [[600.5, 0.0, None], [0.0, None, 240.0]]
    assert (found["count"], found["used"], found["none"], found["scalar"], found["mask"]) == (3, True, None, 2.5, [True, False])
    assert np.float32(found["single"]) == np.float32(0.1)
    assert (found["file"], found["size"], found["text"], found["names"]) == ("a/b.png", [752, 480], "L0", ["L0", "L1"])
    assert (found["mean"], found["words"], found["yes"]) == ({"nan": None, "7": 0.0}, body["words"], "no")
    assert found["provenance"]["inputs"] == PROVENANCE.inputs
    assert json.loads(json.dumps(plain(body)))["K"] == found["K"]


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=1))
def test_no_digit_is_lost(values: list[float]) -> None:
    from lpcal.formats.documents import _Dumper

    text = yaml.dump(plain(np.array(values)), Dumper=_Dumper)
    for loader in {yaml.SafeLoader, getattr(yaml, "CSafeLoader", yaml.SafeLoader)}:
        found = yaml.load(text, Loader=loader)
        assert all(isinstance(value, float) for value in found)
        assert np.array(found).tobytes() == np.array(values).tobytes()


def test_the_same_matrix_twice_is_written_twice(tmp_path: Path) -> None:
    H = np.eye(4).tolist()
    write_document(tmp_path / "a.yaml", "handeye", {"H_PC": H, "H_OB": H}, PROVENANCE)
    text = (tmp_path / "a.yaml").read_text()
    assert "&" not in text
    assert text.count("- [1.0, 0.0, 0.0, 0.0]\n") == 2


def test_a_file_cut_anywhere_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "handeye.yaml"
    write_document(path, "handeye", {"H_PC": np.eye(4), "views": [{"image": "a b.png", "why": None}], "note": "it's"}, PROVENANCE)
    text = path.read_text()
    assert read_document(path, "handeye")["note"] == "it's"
    for cut in range(len(text.rstrip())):
        path.write_text(text[:cut])
        with pytest.raises(InputError) as caught:
            read_document(path, "handeye")
        assert str(path) in str(caught.value)
        assert caught.value.exit_code == 3


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (
            b"lpcal: 1\nkind: camera\nprovenance: {}\n",
            "of kind 'camera'\n  needed: kind: calibration\n  do: give the calibration",
        ),
        (b"lpcal: 2\nkind: calibration\nprovenance: {}\n", "version 2\n  needed: lpcal: 1\n  do: use the lpcal that wrote it"),
        (b"kind: calibration\n", "version None"),
        (b"- 1\n", "says no kind"),
        (b"", "says no kind"),
        (b"\xff\xfe\x00", "cannot be read as YAML"),
        (b"lpcal: 1\nkind: [calibration\n", ":3: cannot be read as YAML; is the file cut off?"),
        (b"lpcal: 1\nkind: calibration\n", "the file is cut off"),
    ],
)
def test_a_file_that_is_not_what_was_asked_for(tmp_path: Path, content: bytes, told: str) -> None:
    path = tmp_path / "calibration.yaml"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        read_document(path, "calibration")
    assert told in str(caught.value)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"camera\.yaml: no such file\n  needed: a camera file that lpcal wrote"):
        read_document(tmp_path / "camera.yaml", "camera")
    with pytest.raises(InputError, match=r"do: run lpcal run"):
        read_document(tmp_path / "calibration.yaml", "calibration")


def test_a_document_read_again_is_whole_and_as_it_stands_now(tmp_path: Path) -> None:
    """One that is held after it was parsed: neither what a caller does to it nor an older text comes back."""
    path = tmp_path / "camera.yaml"
    write_document(path, "camera", {"K": [[1.0, 0.0], [0.0, 1.0]]}, Provenance())
    first = read_document(path, "camera")
    first["K"][0][0] = 7.0
    del first["provenance"]
    assert read_document(path, "camera")["K"] == [[1.0, 0.0], [0.0, 1.0]]
    write_document(path, "camera", {"K": [[2.0]]}, Provenance())
    assert read_document(path, "camera")["K"] == [[2.0]]


def test_sha256_is_the_files(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"abc")
    assert sha256(tmp_path / "a") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"


def test_a_document_that_would_say_the_same_is_left_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "camera.yaml"
    later = replace(PROVENANCE, time="2026-02-02T00:00:00+00:00")
    write_document(path, "camera", {"K": np.eye(3)}, PROVENANCE)
    before = path.read_bytes()
    write_document(path, "camera", {"K": np.eye(3)}, later)
    assert path.read_bytes() == before
    write_document(path, "camera", {"K": 2 * np.eye(3)}, later)
    assert later.time.encode() in path.read_bytes()
    write_document(path, "camera", {"K": 2 * np.eye(3)}, replace(later, inputs={}))
    assert read_document(path, "camera")["provenance"]["inputs"] == {}
