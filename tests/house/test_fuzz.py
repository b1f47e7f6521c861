"""A fixed part of ``tools/fuzz.py``: mutated files of every format, through the command line's own entry."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from types import ModuleType

import pytest

TOOLS = Path(__file__).resolve().parents[2] / "tools"
CASES = 300
"""Cases of the fixed part: about six a format; `tools/fuzz.py` runs as many as it is told to."""


@pytest.fixture(scope="module")
def fuzz() -> ModuleType:
    sys.path.insert(0, str(TOOLS))
    try:
        return importlib.import_module("fuzz")
    finally:
        sys.path.remove(str(TOOLS))


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="children are forked")
def test_no_mutated_file_ends_in_a_traceback_a_crash_or_a_hang(fuzz: ModuleType) -> None:
    results = []
    fuzz.prepare(fuzz.SAMPLES)
    fuzz.run_cases(list(range(CASES)), fuzz.SAMPLES, results.append)
    assert len(results) == CASES
    assert [(result.case, result.format, result.wrong, result.said[-300:]) for result in results if result.wrong] == []
    assert sum(result.code != 0 for result in results) > CASES / 2, "most mutations are noticed"


@pytest.mark.slow
def test_every_sample_is_valid_before_it_is_mutated(fuzz: ModuleType, tmp_path: Path) -> None:
    """Each is read: what ends a command is that the data are few, never that the file cannot be read."""
    from lpcal.cli.main import main

    for number, sample in enumerate(fuzz.SAMPLES):
        folder = tmp_path / str(number)
        folder.mkdir()
        sample.make(folder, fuzz.random.Random(0))
        with pytest.MonkeyPatch.context() as patch:
            patch.chdir(folder)
            assert main(sample.command.split()) in {0, 4, 6}, sample.name
