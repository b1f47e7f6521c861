"""The engines that labs have: dask on this machine and by its address, a worker and the scheduler killed, SLURM's jobs without SLURM."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from lpcal.api.engines import Lost, each, engine_of
from many_captures import collection, same_bytes

distributed = pytest.importorskip("distributed")
pytestmark = pytest.mark.slow
DASK = pytest.mark.filterwarnings("ignore")  # dask's own, of ports and of workers that go


@pytest.fixture
def captures(tmp_path: Path) -> list[Path]:
    return collection(tmp_path, 4)


@DASK
def test_dask_gives_the_bytes_of_the_loop(lpcal: Callable[..., tuple[int, str, str]], captures: list[Path], tmp_path: Path) -> None:
    words = ["reconstruct", *captures, "-c", "dome.yaml", "-o"]
    (captures[1] / "L2.png").unlink()
    assert lpcal(*words, "loop", cwd=tmp_path)[0] == 6
    code, told, _ = lpcal(*words, "dask", "--on", "dask", "--jobs", "2", cwd=tmp_path)
    assert (code, "4 captures: 3 done, 1 failed" in told) == (6, True)
    assert all(same_bytes(tmp_path / "loop" / one.name, tmp_path / "dask" / one.name) for one in captures if one != captures[1])


def test_slurms_jobs_without_slurm_give_the_bytes_of_the_loop(
    lpcal: Callable[..., tuple[int, str, str]], captures: list[Path], tmp_path: Path
) -> None:
    pytest.importorskip("submitit")
    words = ["reconstruct", *captures[:2], "-c", "dome.yaml", "-o"]
    assert lpcal(*words, "loop", cwd=tmp_path)[0] == 0
    code, told, _ = lpcal(*words, "jobs", "--on", "slurm-trial", "--jobs", "2", cwd=tmp_path)
    assert (code, "2 captures: 2 done" in told) == (0, True)
    assert all(same_bytes(tmp_path / "loop" / one.name, tmp_path / "jobs" / one.name) for one in captures[:2])
    assert not (tmp_path / "jobs/.lpcal-jobs").exists()


def started(*words: str) -> subprocess.Popen[str]:
    """A program of dask's that finds this module too."""
    repository = Path(__file__).resolve().parents[2]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(repository), str(repository / "tools")])}
    command = [sys.executable, "-m", "distributed.cli." + words[0], *words[1:]]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=environment)


@pytest.fixture
def scheduler() -> Iterator[tuple[str, subprocess.Popen[str], list[subprocess.Popen[str]]]]:
    """A dask scheduler and two workers without nannies: killed ones stay dead."""
    head = started("dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
    assert head.stderr is not None
    address = next(found[1] for line in head.stderr if (found := re.search(r"tcp://(127\.0\.0\.1:\d+)", line)))
    workers = [started("dask_worker", f"tcp://{address}", "--no-nanny", "--nthreads", "1", "--no-dashboard") for _ in range(2)]
    yield address, head, workers
    for process in (*workers, head):
        process.kill()
        process.communicate()


def slow_square(item: tuple[int, float]) -> tuple[int, int]:
    time.sleep(item[1])
    return item[0] ** 2, os.getpid()


@DASK
@pytest.mark.parametrize("engine", ["processes", "dask"])
def test_a_bad_capture_among_two_hundred_costs_itself_and_is_made_good(
    engine: str, lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path
) -> None:
    captures = collection(tmp_path, 200, 24)
    bad = captures[117] / "L2.png"
    kept = bad.read_bytes()
    bad.write_bytes(kept[: len(kept) // 2])
    words = ["reconstruct", *captures, "-c", "dome.yaml", "-o", "out", "--outputs", "normals", "--jobs", "2", "--on", engine]
    code, told, warned = lpcal(*words, cwd=tmp_path)
    assert (code, "200 captures: 199 done, 1 failed" in told) == (3, True)
    assert [line for line in warned.splitlines() if "was not reconstructed" in line and "c0117" in line]
    assert (tmp_path / "out/surfaces.csv").read_text().splitlines()[1].startswith("c0117,failed")
    standing = {one: (tmp_path / "out" / one.name / "summary.json").stat().st_mtime_ns for one in captures if one != captures[117]}
    assert not (tmp_path / "out/c0117").exists()
    bad.write_bytes(kept)
    code, told, _ = lpcal(*words, cwd=tmp_path)
    assert (code, "200 captures: 1 done, 199 up to date" in told) == (0, True)
    assert standing == {one: (tmp_path / "out" / one.name / "summary.json").stat().st_mtime_ns for one in standing}


@DASK
def test_a_dask_worker_that_is_killed_costs_a_retry(scheduler: tuple[str, subprocess.Popen[str], list[subprocess.Popen[str]]]) -> None:
    address, _, workers = scheduler
    found = {}
    for number, one in each(slow_square, [(k, 0.2) for k in range(16)], engine_of(f"dask://{address}", 2)):
        found[number] = one
        if len(found) == 4:
            os.kill(workers[0].pid, signal.SIGKILL)
    assert {number: one[0] for number, one in found.items()} == {k: k * k for k in range(16)}


@DASK
def test_where_the_dask_scheduler_is_killed_what_is_not_done_is_named(
    scheduler: tuple[str, subprocess.Popen[str], list[subprocess.Popen[str]]],
) -> None:
    address, head, _ = scheduler
    found = {}
    for number, one in each(slow_square, [(k, 0.2) for k in range(12)], engine_of(f"dask://{address}", 2)):
        found[number] = one
        if len(found) == 3:
            os.kill(head.pid, signal.SIGKILL)
    assert sorted(found) == list(range(12))
    lost = [one for one in found.values() if isinstance(one, Lost)]
    assert 0 < len(lost) <= 9
    assert all(one.why for one in lost)


def with_small_disk(address: str, folder: Path, size: str) -> subprocess.Popen[str]:
    """A worker to which another disk stands at a folder, of a size that holds no surface."""
    mount = ["unshare", "-m", "sh", "-c", f'mount -t tmpfs -o size={size} tmpfs "{folder}" && exec "$@"', "sh"]
    worker = ["-m", "distributed.cli.dask_worker", f"tcp://{address}", "--no-nanny", "--nthreads", "1", "--no-dashboard"]
    return subprocess.Popen([*mount, sys.executable, *worker], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, text=True)


@DASK
@pytest.mark.skipif(
    shutil.which("unshare") is None or subprocess.run(["unshare", "-m", "true"], capture_output=True, check=False).returncode != 0,
    reason="a disk of its own for one process needs Linux's mount namespaces",
)
def test_a_full_disk_on_one_worker_costs_the_captures_that_it_had_and_the_next_run_makes_them_good(
    lpcal: Callable[..., tuple[int, str, str]],
    scheduler: tuple[str, subprocess.Popen[str], list[subprocess.Popen[str]]],
    captures: list[Path],
    tmp_path: Path,
) -> None:
    """Of three workers one has a disk of 16 kB where the surfaces go."""
    address, _, workers = scheduler
    (tmp_path / "out").mkdir()
    workers.append(with_small_disk(address, tmp_path / "out", "16k"))
    with distributed.Client(f"tcp://{address}") as client:
        client.wait_for_workers(3, timeout=120)
    words = ["reconstruct", *captures, "-c", "dome.yaml", "-o", "out", "--on", f"dask://{address}"]
    code, told, warned = lpcal(*words, cwd=tmp_path)
    stand = sorted(path.parent.name for path in (tmp_path / "out").glob("*/summary.json"))
    lacking = [one.name for one in captures if one.name not in stand]
    assert lacking
    assert (code, f"{len(stand)} done, {len(lacking)} failed" in told if stand else True) == (3, True)
    assert warned.count("No space left on device") == len(lacking)
    assert all(f"{name} was not reconstructed" in warned for name in lacking)
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [*stand, "surfaces.csv", "surfaces.html"]
    workers[-1].kill()
    workers[-1].wait()
    code, told, warned = lpcal(*words, cwd=tmp_path)
    assert code == 0, warned
    assert f"{len(lacking)} done" in told
    assert sorted(path.parent.name for path in (tmp_path / "out").glob("*/summary.json")) == [one.name for one in captures]
