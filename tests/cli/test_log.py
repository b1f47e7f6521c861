"""``--quiet``, ``--verbose``, ``--log FILE``; and a command that is misspelt."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from lpcal.cli.main import COMMANDS

type Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def normals(tmp_path: Path) -> Path:
    np.save(tmp_path / "flat.npy", np.tile([0, 0, -1.0], (12, 12, 1)))
    (tmp_path / "points.csv").write_text("x_m,y_m,z_m\n0,0,0.3\n")
    (tmp_path / "dome.lp").write_text("2\nL0 0.5 0 0.866\nL1 -0.5 0 0.866\n")
    return tmp_path


def test_progress_is_kept_back(lpcal: Run, normals: Path) -> None:
    assert "reading: 1 of 1" in lpcal("import", "dome.lp", "-o", "c.yaml", cwd=normals)[2]
    code, out, err = lpcal("import", "dome.lp", "-o", "c.yaml", "--quiet")
    assert code == 0
    assert "2 distant lights" in out
    assert err == ""


def test_stages_say_what_they_do(lpcal: Run, normals: Path) -> None:
    _, plain_out, plain = lpcal("integrate", "flat.npy", "-o", "out", cwd=normals)
    code, out, err = lpcal("integrate", "flat.npy", "-o", "out", "--verbose")
    assert code == 0
    assert "integration: begins" in err
    assert "integration: done in" in err
    assert "integration" not in plain
    assert out.partition(" px")[0] == plain_out.partition(" px")[0]


def test_a_log_grows(lpcal: Run, normals: Path) -> None:
    for _ in range(2):
        code, _, err = lpcal("integrate", "flat.npy", "-o", "out", "--log", "logs/run.log", cwd=normals)
        assert code == 0
        assert "begins" not in err
    text = (normals / "logs/run.log").read_text()
    assert text.startswith("# lpcal's log\n")
    assert text.count("integration: begins") == 2
    assert "WARNING integration: normals give the shape" in text


@pytest.mark.parametrize("name", ["flat.npy", "dome.lp", "points.csv", "."])
def test_a_log_is_written_over_nothing_else(lpcal: Run, normals: Path, name: str) -> None:
    before = {path.name: path.read_bytes() for path in normals.iterdir()}
    code, out, err = lpcal("integrate", "flat.npy", "-o", "out", "--log", name, cwd=normals)
    assert (code, out) in {(2, ""), (3, "")}
    assert "Traceback" not in err
    assert {path.name: path.read_bytes() for path in normals.iterdir()} == before


def test_quiet_and_verbose_are_not_for_one_run(lpcal: Run) -> None:
    assert lpcal("check", "--quiet", "--verbose")[0] == 2


@pytest.mark.parametrize(
    ("word", "meant"),
    [("reconstuct", "reconstruct"), ("Refine", "refine"), ("hand-eye", "handeye"), ("intrinsic", "intrinsics"), ("runn", "run")],
)
def test_a_misspelt_command_is_guessed(lpcal: Run, word: str, meant: str) -> None:
    code, out, err = lpcal(word, "--rig", "somewhere")
    assert (code, out) == (2, "")
    assert f"no command is called {word}" in err
    assert f"lpcal {meant}" in err.rpartition("did you mean")[2]


def test_what_is_like_no_command_is_not_guessed(lpcal: Run) -> None:
    code, _, err = lpcal("zzzz")
    assert code == 2
    assert "did you mean" not in err
    assert all(name in err for name in COMMANDS)


@pytest.mark.parametrize(("word", "meant"), [("--methd", "--method"), ("--maks=none", "--mask"), ("--outptus", "--outputs")])
def test_a_misspelt_option_is_guessed(lpcal: Run, word: str, meant: str) -> None:
    code, out, err = lpcal("reconstruct", word, "somewhere")
    assert (code, out) == (2, "")
    assert f"did you mean {meant}" in err


def test_an_option_like_no_other_is_not_guessed(lpcal: Run) -> None:
    code, _, err = lpcal("check", "--zzzz")
    assert code == 2
    assert "unrecognized arguments: --zzzz" in err
    assert "did you mean" not in err


def test_help_keeps_the_names_of_files(lpcal: Run) -> None:
    """A command's help begins with the file's own name, a sentence with a capital."""
    assert "handeye.yaml: the camera" in lpcal("handeye", "--help")[1]
    assert "Has my rig moved" in lpcal("diff", "--help")[1]
