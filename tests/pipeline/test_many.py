"""Many captures: the same bytes wherever they are worked on, nothing done twice, and what goes wrong costs its own capture only."""

from __future__ import annotations

import csv
import errno
import os
import pickle
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import lpcal as library
from lpcal.api import engines
from lpcal.api.engines import Lost, Processes, each, engine_of
from lpcal.errors import DegenerateError, DisagreementError, InputError, UsageError
from lpcal.pipeline import many
from lpcal.pipeline.reconstruct import Task, Wishes
from many_captures import collection, dome, draw, same_bytes


@pytest.fixture
def captures(tmp_path: Path) -> list[Path]:
    return collection(tmp_path, 3)


def rows(folder: Path) -> list[dict[str, str]]:
    return list(csv.DictReader((folder / "surfaces.csv").read_text().splitlines()))


def changed_ns(folder: Path) -> dict[str, int]:
    return {path.name: (path / "summary.json").stat().st_mtime_ns for path in folder.iterdir() if path.is_dir()}


def test_processes_give_the_bytes_of_the_loop_and_nothing_is_done_twice(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    captures = collection(tmp_path, 2)
    words = ["reconstruct", *captures, "-c", "dome.yaml", "-o"]
    assert lpcal(*words, "loop", cwd=tmp_path)[0] == 0
    code, told, _ = lpcal(*words, "many", "--jobs", "2", cwd=tmp_path)
    assert code == 0
    assert "2 captures: 2 done" in told
    assert all(same_bytes(tmp_path / "loop" / one.name, tmp_path / "many" / one.name) for one in captures)
    before = changed_ns(tmp_path / "many")
    assert "2 captures: 2 up to date" in lpcal(*words, "many", cwd=tmp_path)[1]
    assert changed_ns(tmp_path / "many") == before

    draw(tmp_path / "other", 9)
    (tmp_path / "other/L3.png").replace(captures[1] / "L3.png")
    assert "1 done, 1 up to date" in lpcal(*words, "many", cwd=tmp_path)[1]
    (tmp_path / "many/c0000/depth.tif").unlink()
    assert "1 done, 1 up to date" in lpcal(*words, "many", cwd=tmp_path)[1]
    assert "2 captures: 2 done" in lpcal(*words, "many", "--use", "L0,L1,L2,L3", cwd=tmp_path)[1]
    assert "2 captures: 2 done" in lpcal(*words, "many", cwd=tmp_path)[1]
    calibration = (tmp_path / "dome.yaml").read_text()
    (tmp_path / "dome.yaml").write_text(calibration.replace("name: dome", "name: other"))
    assert "2 captures: 2 done" in lpcal(*words, "many", cwd=tmp_path)[1]
    assert "2 captures: 2 done" in lpcal(*words, "many", "--anew", cwd=tmp_path)[1]


def test_one_capture_that_is_up_to_date_is_not_done_again(
    lpcal: Callable[..., tuple[int, str, str]], captures: list[Path], tmp_path: Path
) -> None:
    words = ["reconstruct", captures[0], "-c", "dome.yaml", "-o", "one"]
    assert lpcal(*words, cwd=tmp_path)[0] == 0
    before = (tmp_path / "one/summary.json").stat().st_mtime_ns
    code, told, _ = lpcal(*words, cwd=tmp_path)
    assert (code, "(up to date)" in told) == (0, True)
    assert (tmp_path / "one/summary.json").stat().st_mtime_ns == before
    assert "(up to date)" not in lpcal(*words, "--anew", cwd=tmp_path)[1]


def test_the_mask_is_part_of_what_a_surface_is_made_from(
    lpcal: Callable[..., tuple[int, str, str]], captures: list[Path], tmp_path: Path
) -> None:
    mask = tmp_path / "given.png"
    mask.write_bytes((captures[0] / "mask.png").read_bytes())
    words = ["reconstruct", captures[0], "-c", "dome.yaml", "--mask", mask, "-o", "one"]
    assert lpcal(*words, cwd=tmp_path)[0] == 0
    assert "(up to date)" in lpcal(*words, cwd=tmp_path)[1]
    mask.write_bytes((captures[1] / "mask.png").read_bytes())
    assert "(up to date)" not in lpcal(*words, cwd=tmp_path)[1]


@pytest.mark.parametrize("jobs", [1, 2])
def test_bad_captures_are_named_first_and_cost_themselves(
    lpcal: Callable[..., tuple[int, str, str]], captures: list[Path], tmp_path: Path, jobs: int
) -> None:
    (captures[0] / "L2.png").unlink()
    (captures[2] / "L4.png").write_bytes(b"no image")
    code, told, warned = lpcal("reconstruct", *captures, "-c", "dome.yaml", "-o", "out", "--jobs", jobs, cwd=tmp_path)
    assert code == 6  # the first bad one's
    assert "3 captures: 1 done, 2 failed" in told
    assert "c0000 was not reconstructed" in warned
    assert "c0002 was not reconstructed" in warned
    assert [(row["name"], row["state"]) for row in rows(tmp_path / "out")] == [("c0000", "failed"), ("c0002", "failed"), ("c0001", "done")]
    assert "no image of L2" in rows(tmp_path / "out")[0]["error"]
    assert "no image of L2" in (tmp_path / "out/surfaces.html").read_text()


@pytest.mark.parametrize(
    ("fault", "words", "expected"),
    [
        (OSError(errno.ENOSPC, os.strerror(errno.ENOSPC)), "No space left on device", 3),
        (MemoryError(), "not enough memory", 3),
        (OSError(errno.EIO, os.strerror(errno.EIO)), "Input/output error", 3),
        (ZeroDivisionError("of lpcal's"), "a bug of lpcal: ZeroDivisionError: of lpcal's", 1),
    ],
)
def test_what_the_system_refuses_costs_its_own_capture_and_is_made_good(
    lpcal: Callable[..., Any], captures: list[Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, fault: Any, words: str, expected: int
) -> None:
    written = many.reconstruct_one

    def refuse(task: Task, *given: Any) -> dict[str, Any]:
        if task.name == "c0001":
            raise fault
        return written(task, *given)

    monkeypatch.setattr(many, "reconstruct_one", refuse)
    all_words = ["reconstruct", *captures, "-c", "dome.yaml", "-o", "out"]
    code, told, warned = lpcal(*all_words, cwd=tmp_path)
    assert (code, "2 done, 1 failed" in told) == (expected, True)
    assert words in warned
    assert not (tmp_path / "out/c0001").exists()
    monkeypatch.undo()
    code, told, _ = lpcal(*all_words, cwd=tmp_path)
    assert (code, "1 done, 2 up to date" in told) == (0, True)


def test_a_disk_that_fills_while_a_surface_is_written_leaves_nothing_half(
    lpcal: Callable[..., tuple[int, str, str]], captures: list[Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The second image of the second surface and all after it are refused, as on a full disk."""
    from lpcal.formats import surface_files

    count = 0
    encode = surface_files._write_image

    def full(path: Path, pixels: npt.NDArray[Any]) -> None:
        nonlocal count
        count += 1
        if count > 5:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        encode(path, pixels)

    monkeypatch.setattr(surface_files, "_write_image", full)
    code, told, warned = lpcal("reconstruct", *captures, "-c", "dome.yaml", "-o", "out", cwd=tmp_path)
    assert (code, "1 done, 2 failed" in told) == (3, True)
    assert warned.count("No space left on device") == 2
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["c0000", "surfaces.csv", "surfaces.html"]


def test_the_table_replaces_nothing_of_anybodys(lpcal: Callable[..., tuple[int, str, str]], captures: list[Path], tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out/surfaces.csv").write_text("my,own\n1,2\n")
    code, _, told = lpcal("reconstruct", *captures, "-c", "dome.yaml", "-o", "out", cwd=tmp_path)
    assert code == 3
    assert "surfaces.csv" in told
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["surfaces.csv"]


def test_where_no_table_can_be_written_what_became_of_each_capture_is_said_all_the_same(
    lpcal: Callable[..., tuple[int, str, str]], captures: list[Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise InputError("cannot write here: No space left on device", where="surfaces.html")

    monkeypatch.setattr("lpcal.pipeline.many.write_collection", full)
    (captures[1] / "L2.png").unlink()
    code, told, warned = lpcal("reconstruct", *captures, "-c", "dome.yaml", "-o", "out", cwd=tmp_path)
    assert (code, "3 captures: 2 done, 1 failed" in told) == (6, True)
    assert "c0001 was not reconstructed" in warned
    assert "No space left" in warned


@pytest.mark.parametrize(
    ("words", "error", "said"),
    [
        (("cloud", 2), UsageError, "processes, dask"),
        (("processes", 0), UsageError, "0 jobs"),
        (("dask://127.0.0.1:9", 2), InputError, "no dask scheduler answers"),
        (("slurm", 2), InputError, "no sbatch here"),
    ],
)
def test_engines_that_are_not_there(words: tuple[str, int], error: type[Exception], said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engines, "REPLY_S", 0.5)
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(error, match=said):
        engine_of(*words)


def test_a_package_that_is_not_installed_is_named_with_its_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"lpcal\[dask\]"):
        engine_of("dask", 2)


def test_a_folder_of_rigs_is_run_rig_by_rig_and_a_bad_one_is_named(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    panel = "lpcal: 1\ncamera: {cameramodel: camera.yaml}\n"
    panel += "lights: {L0: {azimuth: 0 deg, joint_angle: 30 deg, disc_spacer: 29 mm, blob_spacer: 40 mm}}\n"
    panel += "panel: {disc_radius: 60 mm, joint: 15 mm, blob: 30 mm}\n"
    camera = library.Camera((640, 480), "opencv4", np.array([[600.0, 0, 320], [0, 600, 240], [0, 0, 1]]), np.zeros(4))
    for name in ("a", "b", "c"):
        (tmp_path / "site" / name).mkdir(parents=True)
        (tmp_path / "site" / name / "panel.yaml").write_text(panel if name != "b" else "lpcal: 1\nboard: 5\n")
        library.write_camera(tmp_path / "site" / name / "camera.yaml", camera)
    code, told, warned = lpcal("run", "site", cwd=tmp_path)
    assert code == 3, warned
    assert "site/b was not run to its end" in warned
    for name in ("a", "c"):
        assert (tmp_path / "site" / name / "calib/calibration.yaml").is_file(), told
    assert lpcal("run", "site/a", "site/c", cwd=tmp_path)[0] == 0
    assert lpcal("run", "site/a/calib", cwd=tmp_path)[0] == 3


@dataclass(frozen=True)
class Item:
    """What a worker is to do: answer, die so many times, or wait."""

    number: int
    folder: Path
    deaths: int = 0
    wait_s: float = 0.0


def sturdy(item: Item) -> int:
    died = list(item.folder.glob(f"died_{item.number}_*"))
    if len(died) < item.deaths:
        (item.folder / f"died_{item.number}_{len(died)}").touch()
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(item.wait_s)
    return item.number * item.number


def test_pictures_of_the_table_are_made_by_the_workers(captures: list[Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The process that writes the table reads no surface again: at ten thousand captures it alone would take an hour for that."""
    tasks = [Task(one, tmp_path / "out" / one.name, one.name) for one in captures]
    jobs = [
        many.Job(task, tmp_path / "dome.yaml", Wishes(), pictured=pictured)
        for task, pictured in zip(tasks, (True, False, True), strict=True)
    ]
    done = [many.do(job) for job in jobs]
    assert [one.picture is not None for one in done] == [True, False, True]
    again = many.do(jobs[0])
    assert (again.state, again.picture) == ("up to date", done[0].picture)
    monkeypatch.setattr(many, "read_image", None)
    page = many.write_collection(tmp_path / "out", [*zip(tasks, done, strict=True)]).read_text()
    assert page.count("data:image/png") == 2


@pytest.mark.parametrize("deaths", [1, 2])
def test_a_worker_that_dies_costs_a_retry(tmp_path: Path, deaths: int) -> None:
    items = [Item(k, tmp_path, deaths=deaths * (k == 1)) for k in range(4)]
    assert sorted(each(sturdy, items, engine_of("processes", 2))) == [(k, k * k) for k in range(4)]


def test_an_item_that_always_kills_is_lost_and_no_other(tmp_path: Path) -> None:
    items = [Item(k, tmp_path, deaths=99 * (k == 2)) for k in range(6)]
    found = dict(each(sturdy, items, engine_of("processes", 2)))
    assert found.pop(2) == Lost("the worker was killed, or ran out of memory")
    assert found == {k: k * k for k in (0, 1, 3, 4, 5)}
    assert len(list(tmp_path.glob("died_2_*"))) == engines.TRIES


def test_quick_items_go_to_a_worker_together_and_one_that_kills_takes_no_other_with_it(tmp_path: Path) -> None:
    items = [Item(k, tmp_path, deaths={30: 99, 50: 1}.get(k, 0), wait_s=0.001) for k in range(80)]
    engine, calls = engine_of("processes", 2), []

    class Counted(Processes):
        def submit[**P, T](self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
            calls.append(args)
            return super().submit(fn, *args, **kwargs)

    @contextmanager
    def counted() -> Iterator[Counted]:
        with Counted(2) as pool:
            yield pool

    found = [*each(sturdy, items, replace(engine, start=counted))]
    assert len(found) == 80
    by_number = dict(found)
    assert by_number.pop(30) == Lost("the worker was killed, or ran out of memory")
    assert by_number == {k: k * k for k in range(80) if k != 30}
    assert len(list(tmp_path.glob("died_30_*"))) <= engines.TRIES + 1  # once with others, then alone
    assert len(calls) < 60


def test_where_no_worker_can_work_that_is_said_soon(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engines, "FRUITLESS", 3)
    items = [Item(k, tmp_path, deaths=99) for k in range(40)]
    found = dict(each(sturdy, items, engine_of("processes", 1)))
    assert len(found) == 40
    assert all(isinstance(one, Lost) for one in found.values())
    assert len(list(tmp_path.glob("died_*"))) == 3


@pytest.mark.parametrize(
    "error", [InputError("a", where="b", needed="c", todo="d"), DegenerateError("x"), DisagreementError("y", todo="z")]
)
def test_errors_come_whole_out_of_another_process(error: Any) -> None:
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), str(again), again.where, again.todo) == (type(error), str(error), error.where, error.todo)


def test_the_library_takes_an_executor_and_gives_results_in_order(captures: list[Path]) -> None:
    (captures[1] / "L2.png").unlink()
    with ThreadPoolExecutor(2) as pool:
        first, bad, last = library.reconstruct_many(captures, dome(), executor=pool)
    assert isinstance(bad, DisagreementError)
    plain = [*library.reconstruct_many([captures[0], captures[2]], dome())]
    for one, other in zip((first, last), plain, strict=True):
        assert np.array_equal(one.normals, other.normals, equal_nan=True)
    with pytest.raises(UsageError, match="no option is called masc"):
        library.reconstruct_many(captures, dome(), masc="auto")


def test_dask_arrays_are_taken(captures: list[Path]) -> None:
    array = pytest.importorskip("dask.array")
    raw = library.read_capture(captures[0], dome())
    lazy = array.from_array(raw.images, chunks=(1, 24, 24))
    found = library.reconstruct(lazy, dome(), ambient=array.from_array(raw.ambient), mask=array.from_array(raw.mask))
    plain = library.reconstruct(raw.images, dome(), ambient=raw.ambient, mask=raw.mask)
    assert np.array_equal(found.normals, plain.normals, equal_nan=True)


def children_of(parent: int) -> list[int]:
    """The workers of a process: what the server that it has started has forked off."""
    begun: dict[int, list[int]] = {}
    servers = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            inside = stat.read_text().rpartition(")")[2].split()
            words = (stat.parent / "cmdline").read_bytes()
        except OSError:
            continue
        begun.setdefault(int(inside[1]), []).append(int(stat.parent.name))
        servers += [int(stat.parent.name)] if int(inside[1]) == parent and b"multiprocessing.forkserver" in words else []
    return [worker for server in servers for worker in begun.get(server, [])]


def started(tmp_path: Path, captures: list[Path]) -> subprocess.Popen[str]:
    words = ["reconstruct", *map(str, captures), "-c", "dome.yaml", "-o", "out", "--jobs", "2", "--quiet"]
    return subprocess.Popen(
        [sys.executable, "-m", "lpcal", *words], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def wait_for(condition: Callable[[], object], seconds: float = 90.0) -> bool:
    until = time.monotonic() + seconds
    while not condition() and time.monotonic() < until:
        time.sleep(0.02)
    return bool(condition())


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="children are found by /proc")
def test_workers_killed_by_their_ids_at_ten_moments_cost_nothing_but_time(tmp_path: Path) -> None:
    """Before anything stands, and each time that two more surfaces do; a bad capture is among them."""
    captures = collection(tmp_path, 26)
    (captures[9] / "L2.png").unlink()
    with started(tmp_path, captures) as run:
        for moment in range(10):
            wait_for(lambda least=2 * moment: len(list((tmp_path / "out").glob("c*/summary.json"))) >= least)
            while not killed(children_of(run.pid)):
                assert run.poll() is None
                time.sleep(0.02)
        told, warned = run.communicate()
    assert run.returncode == 6, warned
    counted = next(line for line in told.splitlines() if line.startswith("26 captures: "))
    by_state = {state: int(count) for count, state in re.findall(r"(\d+) (done|up to date|failed|lost)", counted)}
    assert by_state.pop("failed") == 1
    assert sum(by_state.values()) == 25  # one whose worker was killed when it was written, and had not said so, is up to date
    assert "lost" not in by_state
    assert "c0009 was not reconstructed" in warned
    whole = [*(one.name for one in captures if one != captures[9]), "surfaces.csv", "surfaces.html"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == whole


def killed(workers: list[int]) -> bool:
    """Kill the youngest; False where there is none any more."""
    try:
        os.kill(max(workers), signal.SIGKILL)
    except (ValueError, ProcessLookupError):
        return False
    return True


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="children are found by /proc")
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_where_the_parent_ends_its_workers_end_and_the_next_run_resumes(
    lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, number: int
) -> None:
    captures = collection(tmp_path, 40)
    with started(tmp_path, captures) as run:
        assert wait_for(lambda: len(list((tmp_path / "out").glob("c*/summary.json"))) >= 1)
        workers = children_of(run.pid)
        run.send_signal(number)
        run.communicate()
    assert run.returncode == (-9 if number == signal.SIGKILL else 128 + number)
    assert wait_for(lambda: not any(Path(f"/proc/{worker}").exists() for worker in workers), 20)
    stand = len(list((tmp_path / "out").glob("c*/summary.json")))
    code, told, _ = lpcal("reconstruct", *captures, "-c", "dome.yaml", "-o", "out", cwd=tmp_path)
    assert code == 0
    assert f"{40 - stand} done, {stand} up to date" in told
    assert not list((tmp_path / "out").glob(".lpcal-draft-*"))
