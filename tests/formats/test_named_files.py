"""Names that are not there: which near ones are proposed, on any path, and that a command says so."""

from __future__ import annotations

from pathlib import Path

import pytest

from lpcal.errors import InputError
from lpcal.formats.bundled import rig_file
from lpcal.formats.images import read_image
from lpcal.formats.mocap import read_mocap
from lpcal.formats.named_files import did_you_mean


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "stations").mkdir()
    for name in ("mocap.csv", "flat.png", "stations/station_01.png", "stations/station_02.png", ".hidden.csv"):
        (tmp_path / name).touch()
    return tmp_path


@pytest.mark.parametrize(
    ("asked", "meant"),
    [
        ("mocp.csv", "mocap.csv"),
        ("Mocap.csv", "mocap.csv"),
        ("station/station_01.png", "stations"),
        ("stations/station_1.png", "stations/station_01.png"),
        ("stations/*.pgn", None),
        ("nothing like it", None),
        (".hiden.csv", None),
    ],
)
def test_the_near_name_is_proposed(folder: Path, asked: str, meant: str | None) -> None:
    said = did_you_mean(folder / asked, "correct it")
    assert (said == "correct it") if meant is None else str(folder / meant) in said


def test_what_is_there_and_what_cannot_be_looked_into_is_no_error(folder: Path) -> None:
    assert did_you_mean(folder / "mocap.csv", "else") == "else"
    assert did_you_mean(folder / "mocap.csv" / "below", "else") == "else"
    assert did_you_mean(Path("a\0b"), "else") == "else"


def test_readers_propose_it(folder: Path) -> None:
    for read, asked, meant in ((read_image, "flatt.png", "flat.png"), (lambda path: read_mocap(path, None), "mocap.cvs", "mocap.csv")):
        with pytest.raises(InputError, match="did you mean") as stop:
            read(folder / asked)
        assert str(folder / meant) in stop.value.todo


def test_a_bundled_rig_is_proposed() -> None:
    with pytest.raises(InputError, match=r"did you mean lightpanel-12 or lightpanel-6\?|did you mean lightpanel-6 or lightpanel-12\?"):
        rig_file("lightpanel")
    with pytest.raises(InputError, match=r"did you mean dome\?"):
        rig_file("domme")
