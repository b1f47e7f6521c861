"""``lpcal simulate --count``: the same rigs wherever they are drawn, none drawn twice, and a bad folder costs itself."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

PANEL = """lpcal: 1
name: boards
camera: {images: stations/*.png}
board: {kind: chessboard, corners: [9, 6], square: 25 mm}
"""
WORDS = ("simulate", "--rig", "panel.yaml", "--size", "160x120", "--stations", "4", "--seed", "3", "--count", "2")


@pytest.fixture
def panel(tmp_path: Path) -> Path:
    (tmp_path / "panel.yaml").write_text(PANEL)
    return tmp_path


def files_of(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_processes_draw_what_the_loop_draws_and_nothing_twice(lpcal: Callable[..., tuple[int, str, str]], panel: Path) -> None:
    code, told, wrong = lpcal(*WORDS, "loop", cwd=panel)
    assert (code, "2 rigs: 2 drawn, 0 up to date, 0 failed" in told) == (0, True), wrong
    assert sorted(path.name for path in (panel / "loop").iterdir()) == ["seed_0003", "seed_0004"]
    one, other = (files_of(panel / "loop" / name) for name in ("seed_0003", "seed_0004"))
    assert one.keys() == other.keys()
    image = min(name for name in one if name.endswith(".png"))
    assert one[image] != other[image]
    assert lpcal(*WORDS, "many", "--jobs", "2", cwd=panel)[0] == 0
    assert files_of(panel / "many") == files_of(panel / "loop")
    assert "2 rigs: 0 drawn, 2 up to date, 0 failed" in lpcal(*WORDS, "many", cwd=panel)[1]


def test_a_folder_that_is_anybodys_is_left_and_named_and_the_others_are_drawn(
    lpcal: Callable[..., tuple[int, str, str]], panel: Path
) -> None:
    (panel / "out/seed_0003").mkdir(parents=True)
    (panel / "out/seed_0003/mine.txt").write_text("mine")
    code, told, warned = lpcal(*WORDS, "out", cwd=panel)
    assert (code, "2 rigs: 1 drawn, 0 up to date, 1 failed" in told) == (3, True), told
    assert "seed_0003 was not drawn" in warned
    assert files_of(panel / "out/seed_0003") == {"mine.txt": b"mine"}


@pytest.mark.parametrize("words", [("--count", "-1"), ("--jobs", "2"), ("--on", "dask")])
def test_words_that_make_no_sense(lpcal: Callable[..., tuple[int, str, str]], panel: Path, words: tuple[str, ...]) -> None:
    assert lpcal("simulate", "--rig", "panel.yaml", *words, "out", cwd=panel)[0] == 2
    assert not (panel / "out").exists()
