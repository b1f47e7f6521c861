"""The recipes, as far as this machine goes: the array of SLURM jobs is run as one job and as three, the others are read."""

from __future__ import annotations

import os
import shlex
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml

from many_captures import collection
from queue_of_captures import Site, play

RECIPES = Path(__file__).resolve().parents[2] / "examples" / "recipes"


def run_array(folder: Path, index: int, count: int) -> int:
    """One job of the array, with the program of this environment."""
    environment = os.environ | {
        "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        "CAPTURES": str(folder),
        "CALIBRATION": str(folder / "dome.yaml"),
        "SURFACES": str(folder.parent / "surfaces"),
        "SLURM_ARRAY_TASK_ID": str(index),
        "SLURM_ARRAY_TASK_COUNT": str(count),
    }
    return subprocess.run(
        ["bash", RECIPES / "captures.sbatch"], env=environment, capture_output=True, cwd=folder.parent, check=False
    ).returncode


@pytest.mark.slow
def test_the_array_of_jobs_does_every_capture_once_and_names_a_bad_one_by_its_code(tmp_path: Path) -> None:
    captures = collection(tmp_path / "data", 4)
    (captures[3] / "L1.png").unlink()
    assert [run_array(tmp_path / "data", index, 3) for index in range(3)] == [6, 0, 0]
    stand = sorted(path.parent.name for path in (tmp_path / "surfaces").glob("*/summary.json"))
    assert stand == ["c0000", "c0001", "c0002"]
    before = [path.stat().st_mtime_ns for path in sorted((tmp_path / "surfaces").glob("*/summary.json"))]
    assert run_array(tmp_path / "data", 0, 1) == 6
    assert [path.stat().st_mtime_ns for path in sorted((tmp_path / "surfaces").glob("*/summary.json"))] == before


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # dask's own, of ports
def test_the_services_of_the_compose_file_work_as_they_stand_but_for_their_containers(
    lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path
) -> None:
    """Scheduler and worker by the commands of the recipe, installing left out, names of containers made this machine's."""
    pytest.importorskip("distributed")
    captures = collection(tmp_path, 2)
    services = yaml.safe_load((RECIPES / "compose.yaml").read_text())["services"]
    address, begun = f"127.0.0.1:{free_port()}", []
    try:
        for name, more in (("scheduler", f" --host 127.0.0.1 --port {address.rpartition(':')[2]}"), ("worker", "")):
            shell, flag, words = shlex.split(services[name]["command"])
            install, _, words = words.partition("&& ")
            assert install.startswith("pip install ")
            program = f"{sys.executable} -m " + words.strip().replace("tcp://scheduler:8786", f"tcp://{address}") + more
            environment = os.environ | services[name].get("environment", {})
            begun.append(subprocess.Popen([shell, flag, f"exec {program}"], env=environment, stderr=subprocess.DEVNULL, cwd=tmp_path))
        words = ["reconstruct", *captures, "-c", "dome.yaml", "-o", "out", "--on", f"dask://{address}"]
        until = time.monotonic() + 120
        while (found := lpcal(*words, cwd=tmp_path))[0] == 3 and "no dask scheduler answers" in found[2] and time.monotonic() < until:
            time.sleep(0.5)
        assert found[0] == 0, found[2]
        assert "2 captures: 2 done" in found[1]
    finally:
        for process in begun:
            process.kill()
            process.wait()


def free_port() -> int:
    """One that nothing listens at."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("snakemake") is None, reason="snakemake is not installed: uv tool run --from snakemake snakemake")
def test_the_snakefile_makes_a_surface_a_capture_and_nothing_twice(tmp_path: Path) -> None:
    collection(tmp_path / "data", 2)
    (tmp_path / "data/captures").mkdir()
    for name in ("c0000", "c0001"):
        (tmp_path / "data" / name).replace(tmp_path / "data/captures" / name)
    words = ["snakemake", "-s", str(RECIPES / "Snakefile"), "--cores", "2", "--config"]
    words += [f"captures={tmp_path / 'data/captures'}", f"calibration={tmp_path / 'data/dome.yaml'}"]
    environment = os.environ | {"PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    for said in ("2 of 3 steps", "Nothing to be done"):
        done = subprocess.run(words, env=environment, capture_output=True, text=True, cwd=tmp_path, check=False)
        assert done.returncode == 0, done.stderr
        assert said in done.stderr
    assert sorted(path.parent.name for path in (tmp_path / "surfaces").glob("*/summary.json")) == ["c0000", "c0001"]


@pytest.mark.slow
def test_the_step_of_the_workflow_makes_the_surfaces_of_a_data_set(tmp_path: Path) -> None:
    collection(tmp_path / "captures", 2)
    (tmp_path / "captures/dome.yaml").replace(tmp_path / "calibration.yaml")
    steps = yaml.safe_load((RECIPES / "dataset.github.yml").read_text())["jobs"]["surfaces"]["steps"]
    (command,) = (step["run"] for step in steps if step.get("run", "").startswith("lpcal"))
    environment = os.environ | {"PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    assert subprocess.run(["bash", "-e", "-c", command], env=environment, capture_output=True, cwd=tmp_path, check=False).returncode == 0
    assert len(list((tmp_path / "surfaces").glob("*/summary.json"))) == 2


def test_the_compose_file_serves_this_machine_alone() -> None:
    services = yaml.safe_load((RECIPES / "compose.yaml").read_text())["services"]
    assert services["scheduler"]["ports"] == ["127.0.0.1:8786:8786"]
    assert "lpcal[dask]" in services["worker"]["command"]


def test_the_workflow_runs_a_command_that_there_is(lpcal: Callable[..., tuple[int, str, str]]) -> None:
    steps = yaml.safe_load((RECIPES / "dataset.github.yml").read_text())["jobs"]["surfaces"]["steps"]
    (command,) = (step["run"] for step in steps if step.get("run", "").startswith("lpcal"))
    _, told, _ = lpcal("reconstruct", "--help")
    assert all(word in told for word in command.split() if word.startswith("-"))


@pytest.mark.parametrize(("workers", "bound"), [(10, "workers"), (200, "disk")])
def test_a_queue_that_is_played_through_ends_with_all_done_or_given_up(workers: int, bound: str) -> None:
    played = play(Site(2000, 12.0, 40.0, 500.0, 0.01, 24 * 3600.0), workers)
    least_h = 2000 * 12.0 / workers / 3600
    assert played.hours > 0.9 * least_h
    assert (played.busy_share > 0.9) == (bound == "workers")
    assert (played.disk_share > 0.9) == (bound == "disk")
    assert played.given_up <= 8
