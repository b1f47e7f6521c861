"""Outputs: whole or not there, never over anything that lpcal did not write, and repaired after a kill."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from lpcal.errors import InputError, UsageError
from lpcal.formats import outputs
from lpcal.formats.outputs import Kind, alone_in, marked, recover, refuse_place, whole, write_text

OURS = Kind("a file of the test's", lambda _: True)
"""Whatever stands there counts as an earlier output."""


def contents(folder: Path) -> list[str]:
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*"))


def fail_after(path: Path, write: Callable[[Path], object], stop: type[BaseException] = ValueError) -> None:
    with whole(path, OURS) as draft:
        write(draft)
        raise stop("stop")


def test_a_file_is_replaced_whole(tmp_path: Path) -> None:
    path = tmp_path / "calib" / "camera.yaml"
    write_text(path, "old", OURS)
    with whole(path, OURS) as draft:
        draft.write_text("new")
        assert path.read_text() == "old"
    assert path.read_text() == "new"
    assert contents(tmp_path) == ["calib", "calib/camera.yaml"]


@pytest.mark.parametrize("stop", [ValueError, KeyboardInterrupt])
def test_an_error_leaves_the_old_file_and_no_debris(tmp_path: Path, stop: type[BaseException]) -> None:
    path = tmp_path / "camera.yaml"
    write_text(path, "old", OURS)
    with pytest.raises(stop):
        fail_after(path, lambda draft: draft.write_text("half of the ne"), stop)
    assert path.read_text() == "old"
    assert contents(tmp_path) == ["camera.yaml"]


def test_an_error_leaves_nothing_where_there_was_nothing(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="stop"):
        fail_after(tmp_path / "surface", Path.mkdir)
    assert contents(tmp_path) == []


def test_a_folder_is_replaced_never_mixed(tmp_path: Path) -> None:
    path = tmp_path / "surface"
    for name in ("old.ply", "new.ply"):
        with whole(path, OURS) as draft:
            draft.mkdir()
            (draft / name).write_text(name)
    assert contents(tmp_path) == ["surface", "surface/new.ply"]


def test_an_error_leaves_the_old_folder(tmp_path: Path) -> None:
    path = tmp_path / "surface"
    (path / "sub").mkdir(parents=True)
    with pytest.raises(ValueError, match="stop"):
        fail_after(path, Path.mkdir)
    assert contents(tmp_path) == ["surface", "surface/sub"]


def test_a_block_that_writes_nothing_keeps_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "camera.yaml"
    path.write_text("old")
    with pytest.raises(InputError, match="No such file"), whole(path, OURS):
        pass
    assert contents(tmp_path) == ["camera.yaml"]
    assert path.read_text() == "old"


def test_a_linked_folder_is_replaced_behind_its_link(tmp_path: Path) -> None:
    (tmp_path / "disk").mkdir()
    (tmp_path / "disk" / "old").touch()
    (tmp_path / "surface").symlink_to(tmp_path / "disk")
    with whole(tmp_path / "surface", OURS) as draft:
        draft.mkdir()
        (draft / "new").touch()
    assert (tmp_path / "surface").is_symlink()
    assert contents(tmp_path) == ["disk", "disk/new", "surface"]


def test_something_else_in_the_way_is_kept(tmp_path: Path) -> None:
    (tmp_path / "surface").write_text("mine")
    (tmp_path / "mesh.ply").mkdir()
    with pytest.raises(InputError, match="a file is in the way"), whole(tmp_path / "surface", OURS) as draft:
        draft.mkdir()
    with pytest.raises(InputError, match="a folder is in the way"):
        write_text(tmp_path / "mesh.ply", "ply")
    with pytest.raises(InputError, match=r"cannot be looked at|cannot write here"):
        write_text(tmp_path / "surface" / "mesh.ply", "ply")
    assert contents(tmp_path) == ["mesh.ply", "surface"]
    assert (tmp_path / "surface").read_text() == "mine"


def test_the_new_file_has_the_permissions_of_any_other(tmp_path: Path) -> None:
    (tmp_path / "any").touch()
    write_text(tmp_path / "written", "x")
    with whole(tmp_path / "folder") as draft:
        draft.mkdir()
    (tmp_path / "any_folder").mkdir()
    for mine, other in (("written", "any"), ("folder", "any_folder")):
        assert os.stat(tmp_path / mine).st_mode == os.stat(tmp_path / other).st_mode  # noqa: PTH116


def test_only_an_empty_place_or_an_earlier_output_is_replaced(tmp_path: Path) -> None:
    kind = marked("a table", "# of the test")
    path = tmp_path / "table.csv"
    path.touch()
    write_text(path, "# of the test\n1\n", kind)
    write_text(path, "# of the test\n2\n", kind)
    assert path.read_text() == "# of the test\n2\n"
    path.write_text("the user's own")
    with pytest.raises(InputError, match=r"table\.csv: another file is there already\n  needed: a new or empty place, or a table"):
        write_text(path, "# of the test\n3\n", kind)
    assert path.read_text() == "the user's own"


def test_a_mark_may_stand_at_the_end(tmp_path: Path) -> None:
    path = tmp_path / "board.pdf"
    path.write_bytes(b"x" * 3 * outputs.END_BYTES + b"(lpcal board)")
    assert marked("a board", "(lpcal board").is_ours(path)
    path.write_bytes(b"(lpcal board)".join([b"x" * 2 * outputs.END_BYTES] * 2))
    assert not marked("a board", "(lpcal board").is_ours(path)


@pytest.mark.parametrize("place", [".", "..", "/", "sub/.."])
def test_where_one_stands_is_never_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: str) -> None:
    (tmp_path / "here" / "sub").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "here")
    with pytest.raises(UsageError, match="the current folder or one above it"):
        refuse_place(Path(place), OURS)


def test_an_input_a_device_and_a_link_into_nowhere_are_never_replaced(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("a")
    (tmp_path / "hard").hardlink_to(tmp_path / "a")
    (tmp_path / "soft").symlink_to(tmp_path / "a")
    (tmp_path / "nowhere").symlink_to(tmp_path / "absent")
    os.mkfifo(tmp_path / "fifo")
    for name in ("a", "hard", "soft"):
        with pytest.raises(UsageError, match="one of the inputs"):
            refuse_place(tmp_path / name, OURS, [tmp_path / "a"])
    for place in (tmp_path / "nowhere", tmp_path / "fifo", Path(os.devnull)):
        with pytest.raises(InputError, match=r"leads nowhere|a device"):
            refuse_place(place, OURS)


def test_a_full_disk_names_the_output(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    write_text(tmp_path / "camera.yaml", "old")
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(InputError, match=r"camera\.yaml: cannot write here: No space left on device"):
        write_text(tmp_path / "camera.yaml", "new", OURS)
    assert contents(tmp_path) == ["camera.yaml"]
    assert (tmp_path / "camera.yaml").read_text() == "old"


@contextmanager
def killed_at(monkeypatch: pytest.MonkeyPatch, name: str, number: int) -> Iterator[None]:
    """The process ends, without unwinding, at the number-th call of a function of the system's: played by a child of this process."""
    real, calls = getattr(os, name), 0

    def count(*given: object, **named: object) -> object:
        nonlocal calls
        calls += 1
        if calls == number:
            os._exit(9)
        return real(*given, **named)

    with monkeypatch.context() as patch:
        patch.setattr(os, name, count)
        yield


@pytest.mark.parametrize("exchange", [True, False])
def test_after_a_kill_anywhere_the_old_or_the_new_folder_stands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, exchange: bool) -> None:
    if not exchange:
        monkeypatch.setattr(outputs, "_exchange", lambda *_: False)
    path, states = tmp_path / "surface", set()
    for name in ("fsync", "rename", "mkdir", "rmdir", "unlink"):
        for number in range(1, 12):
            write_folder(path, "old")
            child = os.fork()
            if child == 0:
                with killed_at(monkeypatch, name, number):
                    write_folder(path, "new")
                os._exit(0)
            ended = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
            if exchange:
                assert path.is_dir(), "one of the two stands at every moment"
            recover(tmp_path)
            assert contents(tmp_path) == ["surface", "surface/a", "surface/b"], (name, number)
            assert (path / "a").read_text() == (path / "b").read_text(), "never mixed"
            states.add((path / "a").read_text())
            if ended == 0:
                break
    assert states == {"old", "new"}


def write_folder(path: Path, text: str) -> None:
    with whole(path, OURS) as draft:
        draft.mkdir()
        (draft / "a").write_text(text)
        (draft / "b").write_text(text)


def test_a_draft_of_a_living_process_is_left_alone(tmp_path: Path) -> None:
    with whole(tmp_path / "a") as draft:
        draft.write_text("a")
        write_text(tmp_path / "b", "b")
        recover(tmp_path)
        assert draft.read_text() == "a"
    assert contents(tmp_path) == ["a", "b"]


def test_a_draft_taken_for_a_killed_ones_before_it_is_locked_is_made_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real, made = tempfile.mkdtemp, []

    def swept(**named: str) -> str:
        made.append(real(**named))
        if len(made) < 3:
            recover(tmp_path)
        return made[-1]

    monkeypatch.setattr(tempfile, "mkdtemp", swept)
    write_text(tmp_path / "a", "a")
    assert len(made) == 3
    assert contents(tmp_path) == ["a"]


def test_the_second_of_two_waits_and_says_so(tmp_path: Path) -> None:
    program = (
        "import sys, time, pathlib\nfrom lpcal.formats.outputs import alone_in\n"
        "with alone_in(pathlib.Path(sys.argv[1]), lambda: None):\n"
        "    print('held', flush=True)\n    time.sleep(0.6)\n    print('done', flush=True)\n"
    )
    said = []
    with subprocess.Popen([sys.executable, "-c", program, str(tmp_path)], stdout=subprocess.PIPE, text=True) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == "held\n"
        with alone_in(tmp_path, lambda: said.append("waiting")):
            assert other.stdout.readline() == "done\n"
        assert said == ["waiting"]
    with alone_in(tmp_path, lambda: said.append("again")):
        assert said == ["waiting"]


@pytest.mark.parametrize(("name", "code"), [("SIGINT", 130), ("SIGTERM", 143), ("SIGHUP", 129)])
def test_a_signal_ends_the_run_with_one_message_and_the_old_file(tmp_path: Path, name: str, code: int) -> None:
    program = (
        "import signal, sys, time, types, pathlib\n"
        "for name in ('SIGINT', 'SIGTERM', 'SIGHUP'): signal.signal(getattr(signal, name), signal.SIG_DFL)\n"  # not as under nohup
        "from lpcal.formats.outputs import Kind, whole\n"
        "def run(options, progress):\n"
        "    with whole(pathlib.Path('camera.yaml'), Kind('x', lambda _: True)) as draft:\n"
        "        draft.write_text('half'); print('writing', flush=True); time.sleep(60)\n"
        "sys.modules['lpcal.cli.check'] = types.SimpleNamespace(add_arguments=lambda parser: None, run=run)\n"
        "sys.argv[1:] = ['check']\n"
        "from lpcal.__main__ import run\n"
        "sys.exit(run())\n"
    )
    (tmp_path / "camera.yaml").write_text("old")
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen([sys.executable, "-c", program], cwd=tmp_path, text=True, **pipes) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "writing\n"
        process.send_signal(getattr(signal, name))
        _, err = process.communicate(timeout=20)
    assert process.returncode == code
    assert err.count("\n") == 1
    assert err.startswith("lpcal: ")
    assert err.endswith("nothing half-written was kept\n")
    assert contents(tmp_path) == ["camera.yaml"]
    assert (tmp_path / "camera.yaml").read_text() == "old"
