"""Fixtures that the tests share: the recordings beside the repository, and a command line in a folder."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

for _variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")  # as lpcal itself does, before numpy is imported

REPOSITORY = Path(__file__).resolve().parent.parent

if os.environ.pop("PYTHONDONTWRITEBYTECODE", None):  # the workers and a hundred programs would each compile every package anew
    os.environ.setdefault("PYTHONPYCACHEPREFIX", str(REPOSITORY / ".pytest_cache" / "bytecode"))


def recordings() -> Path:
    """The folder of real recordings and rendered rigs: LPCAL_DATA, default ../shared/data."""
    return Path(os.environ.get("LPCAL_DATA", REPOSITORY.parent / "shared" / "data")).resolve()


@pytest.fixture(scope="session")
def data() -> Callable[[str], Path]:
    """A set of the recordings by name; the test is skipped, by the set's name, where it is absent."""

    def find(name: str) -> Path:
        path = recordings() / name
        if not path.exists():
            pytest.skip(f"the recordings {name} are not there; set LPCAL_DATA")
        return path

    return find


@pytest.fixture
def lpcal(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str, str]]:
    """Run ``lpcal WORDS`` in this process, in a folder: exit code, stdout, stderr."""
    from lpcal.cli.main import main

    def run(*words: object, cwd: Path | None = None) -> tuple[int, str, str]:
        if cwd is not None:
            monkeypatch.chdir(cwd)
        capsys.readouterr()
        try:
            code = main([str(word) for word in words])
        except SystemExit as stop:  # argparse: usage and --help
            code = stop.code if isinstance(stop.code, int) else 2
        told = capsys.readouterr()
        return code, told.out, told.err

    return run
