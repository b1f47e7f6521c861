"""The recipes, as far as this machine goes: the array of SLURM jobs is run as one job and as three, the others are read."""

from __future__ import annotations

import os
import subprocess
import sys
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
def test_the_array_of_jobs_does_every_capture_once_and_names_a_bad_one_by_its_code(tmp_path):
    captures = collection(tmp_path / "data", 4)
    (captures[3] / "L1.png").unlink()
    assert [run_array(tmp_path / "data", index, 3) for index in range(3)] == [6, 0, 0]
    stand = sorted(path.parent.name for path in (tmp_path / "surfaces").glob("*/summary.json"))
    assert stand == ["c0000", "c0001", "c0002"]
    before = [path.stat().st_mtime_ns for path in sorted((tmp_path / "surfaces").glob("*/summary.json"))]
    assert run_array(tmp_path / "data", 0, 1) == 6
    assert [path.stat().st_mtime_ns for path in sorted((tmp_path / "surfaces").glob("*/summary.json"))] == before


def test_the_compose_file_serves_this_machine_alone():
    services = yaml.safe_load((RECIPES / "compose.yaml").read_text())["services"]
    assert services["scheduler"]["ports"] == ["127.0.0.1:8786:8786"]
    assert "lpcal[dask]" in services["worker"]["command"]


def test_the_workflow_runs_a_command_that_there_is(lpcal):
    steps = yaml.safe_load((RECIPES / "dataset.github.yml").read_text())["jobs"]["surfaces"]["steps"]
    (command,) = (step["run"] for step in steps if step.get("run", "").startswith("lpcal"))
    _, told, _ = lpcal("reconstruct", "--help")
    assert all(word in told for word in command.split() if word.startswith("-"))


@pytest.mark.parametrize(("workers", "bound"), [(10, "workers"), (200, "disk")])
def test_a_queue_that_is_played_through_ends_with_all_done_or_given_up(workers, bound):
    played = play(Site(2000, 12.0, 40.0, 500.0, 0.01, 24 * 3600.0), workers)
    least_h = 2000 * 12.0 / workers / 3600
    assert played.hours > 0.9 * least_h
    assert (played.busy_share > 0.9) == (bound == "workers")
    assert (played.disk_share > 0.9) == (bound == "disk")
    assert played.given_up <= 8
