"""A motion-capture format that somebody else adds, in a program or by an installed package, is read like lpcal's own."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lpcal
from lpcal.errors import DegenerateError, DisagreementError, InputError, LpcalError
from lpcal.formats import mocap_added

PACKAGE = """
import numpy as np
from lpcal.formats.mocap_added import MocapFormat
from lpcal.records.observations import PoseStream


def read(path, body):
    rows = np.loadtxt(path, skiprows=1)
    H_OP = np.tile(np.eye(4), (len(rows), 1, 1))
    H_OP[:, :3, 3] = rows[:, 1:] / 1000
    return PoseStream(body or "rail", rows[:, 0], H_OP, np.full(len(rows), np.nan))


FORMAT = MocapFormat("our rail", lambda head: head.startswith(b"RAIL"), read)
"""


@pytest.fixture(autouse=True)
def _only_this_tests_formats(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mocap_added, "ADDED", {})


def stream(count: int = 20, **change: object) -> lpcal.PoseStream:
    H_OP = np.tile(np.eye(4), (count, 1, 1))
    H_OP[:, 0, 3] = 0.01 * np.arange(count)
    given = {"body": "rail", "t_s": 0.1 * np.arange(count), "H_OP": H_OP, "error_m": np.full(count, np.nan)} | change
    return lpcal.PoseStream(**given)


def markers(**change: object) -> lpcal.extend.MarkerStream:
    places = np.array([[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0], [0, 0.05, 0.08]])
    given = {"body": "rail", "t_s": 0.1 * np.arange(20), "names": ("a", "b", "c", "d"), "x_O": np.tile(places, (20, 1, 1))} | change
    return lpcal.extend.MarkerStream(**given)


@pytest.fixture
def recording(tmp_path: Path) -> Path:
    path = tmp_path / "run.dat"
    path.write_bytes(b"RAIL 1\n\x00\x01")
    return path


def test_it_is_asked_before_lpcals_own(tmp_path: Path) -> None:
    path = tmp_path / "poses.csv"
    path.write_text("t_s,x_m,y_m,z_m,qx,qy,qz,qw\n" + "\n".join(f"{0.1 * k},{k + 1},0,0,0,0,0,1" for k in range(9)))
    assert len(lpcal.read_mocap(path).t_s) == 9
    lpcal.register_mocap("ours", lambda head: head.startswith(b"t_s,x_m"), lambda path, body: stream(4))
    assert len(lpcal.read_mocap(path).t_s) == 4
    assert lpcal.read_mocap(path).format == "ours"


def test_the_last_of_a_name_counts(recording: Path) -> None:
    lpcal.register_mocap("ours", lambda head: True, lambda path, body: stream(4))
    lpcal.register_mocap("ours", lambda head: True, lambda path, body: stream(6, body=body))
    found = lpcal.read_mocap(recording, "cart")
    assert (len(found.t_s), found.body, found.rate_hz) == (6, "cart", pytest.approx(10))


def test_poses_of_the_room_in_the_body_are_turned(recording: Path) -> None:
    lpcal.register_mocap("ours", lambda head: head[:4] == b"RAIL", lambda path, body: stream())
    as_is, turned = lpcal.read_mocap(recording), lpcal.read_mocap(recording, direction="H_PO")
    np.testing.assert_allclose(turned.H_OP, np.linalg.inv(as_is.H_OP))


def test_bare_markers_are_made_a_body(recording: Path) -> None:
    lpcal.register_mocap("ours", lambda head: head[:4] == b"RAIL", lambda path, body: markers())
    found = lpcal.read_mocap(recording)
    assert found.rate_hz == pytest.approx(10)
    assert "20 at 10 Hz" in str(found)
    assert "nan" not in str(stream())


@pytest.mark.parametrize("stated", [{"units": "mm"}, {"quaternion": "wxyz"}])
def test_what_the_format_knows_itself_is_not_stated_for_it(recording: Path, stated: dict[str, str]) -> None:
    lpcal.register_mocap("ours", lambda head: head[:4] == b"RAIL", lambda path, body: stream())
    with pytest.raises(InputError, match=f"mocap.{next(iter(stated))} says nothing to the format ours"):
        lpcal.read_mocap(recording, **stated)


def fails(path: Path, body: str | None) -> lpcal.PoseStream:
    raise RuntimeError("line 7 is odd")


@pytest.mark.parametrize(
    ("read", "error", "words"),
    [
        (fails, InputError, "line 7 is odd"),
        (lambda path, body: None, InputError, "gave a NoneType"),
        (lambda path, body: stream(0), DegenerateError, "no pose"),
        (lambda path, body: stream(t_s=np.zeros(20)), InputError, "times that increase"),
        (lambda path, body: stream(t_s=np.zeros(19)), DisagreementError, "one time for each"),
        (lambda path, body: stream(error_m=np.zeros(19)), DisagreementError, "one marker error for each"),
        (lambda path, body: markers(x_O=np.zeros((20, 4))), InputError, "markers \\(N, M, 3\\)"),
        (lambda path, body: markers(names=("a",)), DisagreementError, "one for each marker"),
        (lambda path, body: markers(t_s=np.zeros(20)), InputError, "times that increase"),
        (lambda path, body: markers(x_O=np.full((20, 4, 3), np.nan)), DegenerateError, "no marker"),
        (lambda path, body: stream(H_OP=np.full((20, 4, 4), np.nan)), InputError, "not finite"),
        (lambda path, body: stream(H_OP=2 * np.tile(np.eye(4), (20, 1, 1))), InputError, "no rigid transform"),
    ],
)
def test_what_it_gives_is_checked(recording: Path, read: Callable[..., Any], error: type[LpcalError], words: str) -> None:
    lpcal.register_mocap("ours", lambda head: True, read)
    with pytest.raises(error, match=words) as found:
        lpcal.read_mocap(recording)
    assert "run.dat" in str(found.value)


def test_what_cannot_tell_its_files_is_named(recording: Path) -> None:
    lpcal.register_mocap("ours", lambda head: head.index("RAIL") >= 0, lambda path, body: stream())
    with pytest.raises(InputError, match="the format ours fails"):
        lpcal.read_mocap(recording)


@pytest.mark.parametrize("given", [("", len, len), ("ours", None, len), ("ours", len, "read")])
def test_what_is_no_format_is_refused(given: tuple[Any, ...]) -> None:
    with pytest.raises(InputError, match="is no format"):
        lpcal.register_mocap(*given)


def installed_in(folder: Path, entry: str) -> dict[str, str]:
    """An installed package with an entry point, and the environment in which it is found."""
    (folder / "our_rail.py").write_text(PACKAGE)
    info = folder / "our_rail-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: our-rail\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(f"[lpcal.mocap]\nrail = {entry}\n")
    return os.environ | {"PYTHONPATH": str(folder)}


def checked(folder: Path, environment: dict[str, str]) -> subprocess.CompletedProcess[str]:
    """``lpcal check run.dat`` of a rig with board poses found elsewhere."""
    folder.mkdir()
    (folder / "run.dat").write_text("RAIL\n" + "\n".join(f"{0.01 * k} {k} 0 0" for k in range(500)))
    (folder / "boards.csv").write_text("t_s,x,y,z,qx,qy,qz,qw\n" + "\n".join(f"{0.3 * k + 0.5},0,0,0.4,0,0,0,1" for k in range(12)))
    (folder / "panel.yaml").write_text("lpcal: 1\nmocap: {file: run.dat, board_poses: {file: boards.csv, direction: H_CB}}\n")
    command = [sys.executable, "-m", "lpcal", "check"]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def test_the_command_line_knows_an_installed_format(tmp_path: Path) -> None:
    without = checked(tmp_path / "without", dict(os.environ))
    packages = tmp_path / "packages"
    packages.mkdir()
    found = checked(tmp_path / "with", installed_in(packages, "our_rail:FORMAT"))
    assert "rail" not in without.stdout
    assert without.returncode == 3
    assert "500" in found.stdout
    assert "run.dat read as: our rail" in found.stdout
    assert "Traceback" not in found.stderr


@pytest.mark.parametrize("entry", ["our_rail:NOTHING", "our_rail:read", "no_such_module:FORMAT"])
def test_an_installed_package_that_is_broken_is_named(tmp_path: Path, entry: str) -> None:
    packages = tmp_path / "packages"
    packages.mkdir()
    found = checked(tmp_path / "rig", installed_in(packages, entry))
    assert found.returncode == 3
    assert "entry point rail of our-rail" in found.stderr
    assert "Traceback" not in found.stderr
