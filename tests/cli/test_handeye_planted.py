"""What people do wrong: refused, repaired or warned of, by ``lpcal check`` and by ``lpcal handeye`` alike.

``PYTHONPATH=tests/support python tests/cli/test_handeye_planted.py`` prints the table: mistake, exit codes, the message's first line.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from handeye_rigs import FLIP, image_rig, moving_rig
from handeye_scene import Session, moving_session, static_session, stop_and_shoot
from lpcal.chain.h_pc_handeye.camera_part import turned_by_half
from lpcal.chain.h_pc_handeye.ends import with_turned
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from mocap_files import motive

MIRROR = np.diag([1.0, -1.0, 1.0, 1.0])


@functools.cache
def moving(views: int = 60, seed: int = 11) -> Session:
    return moving_session(np.random.default_rng(seed), views)


@functools.cache
def static(views: int = 24, seed: int = 2, **kwargs: Any) -> Session:
    return static_session(np.random.default_rng(seed), views, **kwargs)


def reordered(H: Array) -> Array:
    H = H.copy()
    H[:, :3, :3] = se3.rotation_from_quaternion(se3.quaternion(H[:, :3, :3])[:, [3, 0, 1, 2]])
    return H


def mirrored(H: Array) -> Array:
    H = H.copy()
    H[:, 1, 3] *= -1
    return H


def scaled(H: Array, by: float) -> Array:
    H = H.copy()
    H[:, :3, 3] *= by
    return H


def conjugate(H: Array) -> Array:
    return se3.transform(np.swapaxes(H[:, :3, :3], 1, 2), H[:, :3, 3])


def in_other_axes(H: Array, axes: list[list[int]]) -> Array:
    """The positions alone in other axes."""
    return se3.transform(H[:, :3, :3], H[:, :3, 3] @ np.array(axes).T)


def exchanged_everywhere(H: Array) -> Array:
    """Components y and z exchanged, of positions and of quaternions."""
    q = se3.quaternion(H[:, :3, :3])
    return se3.transform(se3.rotation_from_quaternion(q[:, [0, 2, 1, 3]]), H[:, [0, 2, 1], 3])


def opengl(H_CB: Array) -> Array:
    """Of a camera whose y looks up and z backwards."""
    return np.diag([1.0, -1.0, -1.0, 1.0]) @ H_CB


def turned_about_one_axis(session: Session, reach: float) -> Session:
    """The session with the panel turned about its z alone."""
    count = len(session.boards.images)
    turn = np.concatenate([np.zeros((count, 2)), np.linspace(-reach, reach, count)[:, None], np.zeros((count, 3))], axis=1)
    H_OP = session.H_OP[:1] @ se3.exp(turn)
    return replace(session, H_OP=H_OP, boards=replace(session.boards, H_CB=se3.inv(H_OP @ session.H_PC) @ session.H_OB))


def cut_in_mid_line(folder: Path) -> None:
    moving_rig(folder, moving())
    text = (folder / "mocap.csv").read_text()
    (folder / "mocap.csv").write_text(text[: len(text) // 2 - 12])


def empty_stream(folder: Path, text: str = "") -> None:
    moving_rig(folder, moving())
    (folder / "mocap.csv").write_text(text)


def motive_rig(folder: Path, body: str | None, *, lost: float = 0.0) -> Session:
    """A rig whose recording is Motive's, of two bodies, with image times."""
    session, _ = stop_and_shoot(np.random.default_rng(3), 20)
    image_rig(folder, session)
    gone = set(np.flatnonzero(np.random.default_rng(4).random(len(session.stream.t_s)) < lost).tolist())
    motive(folder / "mocap.csv", session.stream.t_s, session.stream.H_OP, bodies=("Wand", "Panel"), lost=gone)
    text = (folder / "panel.yaml").read_text()
    (folder / "panel.yaml").write_text(text.replace("mocap.csv,", f"mocap.csv, body: {body}," if body else "mocap.csv,"))
    return session


@dataclass(frozen=True)
class Refused:
    """What is planted, and what both commands answer."""

    plant: Callable[[Path], object]
    code: int
    words: str
    todo: str


def as_text(count: int) -> np.ndarray:
    """The order (count,) in which numbers stand as text: 0, 1, 10, 11, 2."""
    return np.argsort([str(k) for k in range(count)], kind="stable")


REFUSED = {
    "mocap inverted": Refused(
        lambda f: moving_rig(f, moving(), H_OP=se3.inv(moving().stream.H_OP)), 6, "the mocap poses are inverted", "mocap.direction: H_PO"
    ),
    "board poses inverted": Refused(
        lambda f: moving_rig(f, moving(), H_CB=se3.inv(moving().boards.H_CB)),
        6,
        "the board poses are inverted",
        "mocap.board_poses.direction: H_BC",
    ),
    "wxyz for xyzw": Refused(
        lambda f: moving_rig(f, moving(), H_OP=reordered(moving().stream.H_OP)), 6, "they are w, x, y, z", "mocap.quaternion: wxyz"
    ),
    "mirrored y (positions)": Refused(
        lambda f: moving_rig(f, moving(), H_OP=mirrored(moving().stream.H_OP)), 6, "mirrored along y", "right-handed frame"
    ),
    "mirrored y (poses)": Refused(
        lambda f: moving_rig(f, moving(), H_OP=MIRROR @ moving().stream.H_OP @ MIRROR), 6, "left-handed", "right-handed frame"
    ),
    "mocap's rotations inverted, its positions not": Refused(
        lambda f: moving_rig(f, moving(), H_OP=conjugate(moving().stream.H_OP)),
        6,
        "the rotations of the mocap poses are inverted",
        "turn over the signs of qx, qy and qz",
    ),
    "positions with y and z exchanged": Refused(
        lambda f: moving_rig(f, moving(), H_OP=in_other_axes(moving().stream.H_OP, [[1, 0, 0], [0, 0, 1], [0, 1, 0]])),
        6,
        "the rotations' x, y, z are the positions' x, z, y",
        "into the same axes",
    ),
    "positions with y up, rotations with z up": Refused(
        lambda f: moving_rig(f, moving(), H_OP=in_other_axes(moving().stream.H_OP, [[1, 0, 0], [0, 0, 1], [0, -1, 0]])),
        6,
        "the rotations' x, y, z are the positions' x, -z, y",
        "into the same axes",
    ),
    "y and z exchanged everywhere": Refused(
        lambda f: moving_rig(f, moving(), H_OP=exchanged_everywhere(moving().stream.H_OP)),
        6,
        "two axes of the poses are exchanged",
        "right-handed frame",
    ),
    "board poses wxyz for xyzw": Refused(
        lambda f: moving_rig(f, moving(), H_CB=reordered(moving().boards.H_CB)),
        6,
        "the board poses' quaternions are in another order: they are w, x, y, z",
        "name the columns of the board poses",
    ),
    "board poses' rotations inverted": Refused(
        lambda f: moving_rig(f, moving(), H_CB=conjugate(moving().boards.H_CB)),
        6,
        "the rotations of the board poses are inverted",
        "transpose the matrices",
    ),
    "board poses in mm": Refused(
        lambda f: moving_rig(f, moving(), H_CB=scaled(moving().boards.H_CB, 1000.0)),
        6,
        "the lengths of the board poses are in mm",
        "name their columns x_mm",
    ),
    "mm for m": Refused(lambda f: moving_rig(f, moving(), scale=1000.0), 6, "in mm, not in metres", "mocap.units: mm"),
    "board square 25.4 x too large": Refused(
        lambda f: image_rig(f, static(), scaled(static().H_OP, 1 / 25.4)), 6, "the board's size is stated 25.", "board.square"
    ),
    "board square 25.4 x too small": Refused(
        lambda f: image_rig(f, static(), scaled(static().H_OP, 25.4)), 6, "25 times too small", "board.square"
    ),
    "pairing shifted by one": Refused(
        lambda f: image_rig(f, static(), np.roll(static().H_OP, 1, axis=0)), 6, "the pairing is shifted by 1", "mocap.poses"
    ),
    "poses in backward order": Refused(
        lambda f: image_rig(f, static(), static().H_OP[::-1]), 6, "the poses are in backward order", "mocap.poses"
    ),
    "poses in the order of text": Refused(
        lambda f: image_rig(f, static(), static().H_OP[as_text(len(static().H_OP))]), 6, "names as text (1, 10, 11, 2)", "mocap.poses"
    ),
    "images in the order of text": Refused(
        lambda f: image_rig(f, static(), static().H_OP[np.argsort(as_text(len(static().H_OP)))]), 6, "names as text", "mocap.poses"
    ),
    "rotation about one axis only": Refused(
        lambda f: image_rig(f, turned_about_one_axis(static(), 0.6), turned_about_one_axis(static(), 0.6).H_OP),
        4,
        "turned about one axis only, about its z",
        "about the panel's x and y",
    ),
    "no rotation": Refused(
        lambda f: image_rig(f, static(turn_deg=0.05), static(turn_deg=0.05).H_OP),
        4,
        "the panel hardly turned",
        "turn the panel by 20 degrees",
    ),
    "a recording of one pose": Refused(
        lambda f: moving_rig(f, moving(), t_s=moving().stream.t_s[:1], H_OP=moving().stream.H_OP[:1]),
        4,
        "no clock offset at which",
        "a third of the views",
    ),
    "three views": Refused(lambda f: image_rig(f, static(3), static(3).H_OP), 4, "3 views", "take more"),
    "a csv cut in mid-line": Refused(cut_in_mid_line, 3, "cells", "is the file cut off? export it again"),
    "a body that is not there": Refused(lambda f: motive_rig(f, "LightPanel"), 6, "no body LightPanel", "Wand, Panel"),
    "two bodies, none named": Refused(lambda f: motive_rig(f, None), 3, "2 bodies: Wand, Panel", "mocap.body"),
    "an empty file": Refused(empty_stream, 3, "empty", "export the recording again"),
    "a stream without a pose": Refused(
        lambda f: empty_stream(f, "t,x,y,z,qx,qy,qz,qw\n0,,,,,,,\n1,,,,,,,\n"), 4, "not one pose", "rows with position and rotation"
    ),
}


def by_turns(cases: Iterable[object]) -> list[object]:
    """Every case with one command, in turn handeye and check; with the other command it is among the slow."""
    both = [(case, (k + other) % 2, other) for k, case in enumerate(cases) for other in (0, 1)]
    return [
        pytest.param(("handeye", "check")[command], case, marks=[pytest.mark.slow] * other, id=f"{('handeye', 'check')[command]}-{case}")
        for case, command, other in both
    ]


@pytest.mark.parametrize(("command", "name"), by_turns(REFUSED))
def test_refused(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]], name: str, command: str) -> None:
    case = REFUSED[name]
    case.plant(tmp_path)
    code, out, err = lpcal(command, cwd=tmp_path)
    assert code == case.code, out + err
    assert case.words in out + err
    assert case.todo in out + err
    assert not (tmp_path / "calib" / "handeye.yaml").exists()
    assert not (tmp_path / "calib" / "H_OP.yaml").exists()


def one_pose_missing(folder: Path) -> Session:
    session = static()
    keep = np.arange(24) != 7
    image_rig(folder, session, session.H_OP[keep], names=[n for n, ok in zip(session.boards.images, keep, strict=True) if ok])
    return session


def flipped(folder: Path, how: str) -> Session:
    """A fifth of the recording flipped: whole dwells, or single samples here and there."""
    session, view = stop_and_shoot(np.random.default_rng(5), 25)
    rng = np.random.default_rng(6)
    wrong = np.isin(view, [3, 8, 9, 15, 22]) if how == "dwells" else rng.random(len(view)) < 0.2
    H_OP = np.where(wrong[:, None, None], session.stream.H_OP @ FLIP, session.stream.H_OP)
    session = replace(session, stream=replace(session.stream, H_OP=H_OP))
    image_rig(folder, session)
    return session


def repeated_and_unsorted(folder: Path) -> Session:
    session = moving()
    t, H = session.stream.t_s, session.stream.H_OP
    order = np.concatenate([np.random.default_rng(0).permutation(len(t)), np.arange(0, len(t), 9)])
    moving_rig(folder, session, t_s=t[order], H_OP=H[order])
    return session


def gaps(folder: Path) -> Session:
    session = moving(120)
    keep = (session.stream.t_s % 2.0) > 0.3
    moving_rig(folder, session, t_s=session.stream.t_s[keep], H_OP=session.stream.H_OP[keep])
    return session


REPAIRED = {
    "one image's pose missing": (one_pose_missing, "no pose of it in mocap.poses", "view_007.png"),
    "20 % flips, whole dwells": (lambda f: flipped(f, "dwells"), "view_003.png", "view_022.png"),
    "20 % flips, single samples": (lambda f: flipped(f, "samples"), None, None),
    "two bodies, one named": (lambda f: motive_rig(f, "Panel"), "Panel", None),
    "lost samples": (lambda f: motive_rig(f, "Panel", lost=0.1), None, None),
    "gaps of 0.3 s": (gaps, "the body was lost", None),
    "repeated and unsorted stamps": (repeated_and_unsorted, "sorted", "repeated times"),
}


@pytest.mark.parametrize("name", REPAIRED)
def test_repaired_and_said(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]], name: str) -> None:
    plant, first, second = REPAIRED[name]
    session = plant(tmp_path)
    for command in ("check", "handeye"):
        code, out, err = lpcal(command, cwd=tmp_path)
        assert code == 0, out + err
        for words in (first, second):
            assert words is None or words in out + err, command
    found = read_handeye(tmp_path / "calib" / "handeye.yaml")
    xi = se3.log(session.H_PC @ se3.inv(found.H_PC))
    assert xi @ np.linalg.solve(found.H_PC_covariance, xi) < 30
    assert np.linalg.norm(found.H_PC[:3, 3] - session.H_PC[:3, 3]) < 4e-3
    if "dwells" in name:
        assert [k for k, view in enumerate(found.views) if not view.used] == [3, 8, 9, 15, 22]


def both_inverted(folder: Path) -> Session:
    session = moving(120)
    far = session.H_OB.copy()
    far[:3, 3] += [1.5, 1.0, 0.8]  # a room: the board is metres from its origin
    H_OP = far @ se3.inv(session.H_OB) @ session.stream.H_OP
    moving_rig(folder, session, H_OP=se3.inv(H_OP), H_CB=se3.inv(session.boards.H_CB))
    return session


WARNED = {
    "a board 1 % off": (lambda f: image_rig(f, static(60, 3), scaled(static(60, 3).H_OP, 1.01)), "the mocap measures the board as 10"),
    "both streams inverted": (both_inverted, "both streams are inverted"),
    "board poses of OpenGL's camera": (
        lambda f: moving_rig(f, moving(), H_CB=opengl(moving().boards.H_CB)),
        "the board lies behind the camera",
    ),
    "rotations under 8 degrees": (
        lambda f: image_rig(f, static(40, turn_deg=6.0), static(40, turn_deg=6.0).H_OP),
        "turned little about a second axis",
    ),
}


def test_poses_of_two_views_in_each_others_place_are_named(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    H_OP = static().H_OP.copy()
    H_OP[[3, 9]] = H_OP[[9, 3]]
    H_OP[5, :3, 3] += [0.05, 0, 0]  # one that is off by itself
    image_rig(tmp_path, static(), H_OP)
    code, out, err = lpcal("check", cwd=tmp_path)
    assert code == 0, out + err
    assert "view_003.png and view_009.png: each fits the pose of the other, their poses are exchanged" in out + err
    assert err.count("exchanged") + out.count("exchanged") == 1


@pytest.mark.parametrize(("command", "name"), by_turns(WARNED))
def test_solved_but_warned_of(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]], name: str, command: str) -> None:
    plant, words = WARNED[name]
    plant(tmp_path)
    code, out, err = lpcal(command, cwd=tmp_path)
    assert code == 0, out + err
    assert words in out + err


@pytest.mark.parametrize(
    "wrong",
    [
        pytest.param(slice(0, 7), id="first"),
        pytest.param(slice(17, 24), id="last", marks=pytest.mark.slow),
        pytest.param(slice(0, 24, 4), id="every fourth"),
    ],
)
def test_check_turns_boards_back_as_handeye_does(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]], wrong: Any) -> None:
    session = static()
    turned, other = turned_by_half(session.boards), np.zeros(24, dtype=bool)
    other[wrong] = True
    image_rig(tmp_path, replace(session, boards=with_turned(session.boards, turned, other)), session.H_OP)
    for command in ("check", "handeye"):
        code, out, err = lpcal(command, cwd=tmp_path)
        assert code == 0, out + err
        assert command != "check" or f"{other.sum()} boards were found by their other end" in out + err
    assert np.linalg.norm(read_handeye(tmp_path / "calib" / "handeye.yaml").H_PC[:3, 3] - session.H_PC[:3, 3]) < 4e-3


@pytest.mark.parametrize(("command", "off_ms"), by_turns([-300, 200, 400]))
def test_a_misstated_clock_is_named_by_its_key(
    tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]], command: str, off_ms: int
) -> None:
    session = moving()
    moving_rig(tmp_path, session, mocap=f"  clock_offset: {1e3 * session.offset_s + off_ms:.1f} ms\n")
    code, out, err = lpcal(command, cwd=tmp_path)
    assert code == 6, out + err
    assert "the stated clock offset" in out + err
    assert "clock_offset: estimate" in out + err


def test_what_mends_it_mends_it(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    session = moving()
    for keys, planted in (
        ("  direction: H_PO\n", {"H_OP": se3.inv(session.stream.H_OP)}),
        ("  quaternion: wxyz\n", {"order": "wxyz"}),
        ("  units: mm\n", {"scale": 1000.0}),
        ("", {"H_CB": se3.inv(session.boards.H_CB), "direction": "H_BC"}),
    ):
        moving_rig(tmp_path, session, mocap=keys, **planted)
        code, out, err = lpcal("check", cwd=tmp_path)
        assert code == 0, keys + out + err


def _table() -> None:
    """The table of the closing note."""
    import contextlib
    import io
    import os
    import sys
    import tempfile

    from lpcal.cli.main import main

    plants = {name: case.plant for name, case in REFUSED.items()} | {name: case[0] for name, case in (REPAIRED | WARNED).items()}
    for name, plant in plants.items():
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            plant(Path(folder))
            said = {}
            for command in ("check", "handeye"):
                out, err = io.StringIO(), io.StringIO()
                with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                    code = main([command])
                lines = (out.getvalue() + err.getvalue()).replace(folder + os.sep, "").splitlines()
                telling = [line for line in lines if line.startswith(("WRONG", "warning", "lpcal", "error"))] or lines[-1:]
                said[command] = (code, telling[0] if telling else "")
            words = said["check"][1] if said["check"][0] else said["handeye"][1]
            sys.stdout.write(f"| {name} | {said['check'][0]} | {said['handeye'][0]} | {words} |\n")


if __name__ == "__main__":
    _table()
