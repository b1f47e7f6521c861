"""The command line: one error boundary, the contract's exit codes, one JSON document."""

from __future__ import annotations

import argparse
import errno
import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from lpcal import __version__, errors
from lpcal.cli import main as cli
from lpcal.records.outcome import Outcome, Progress

type Run = Callable[..., tuple[int, str, str]]
type Plant = Callable[..., None]


@pytest.fixture
def plant(monkeypatch: pytest.MonkeyPatch) -> Plant:
    """Put a command of one's own in the place of ``check``: it raises or it returns."""

    def put(does: BaseException | Outcome, *, progress_steps: int = 0) -> None:
        def run(options: argparse.Namespace, progress: Progress) -> Outcome:
            for step in range(progress_steps):
                progress("images read", step + 1, progress_steps)
            if isinstance(does, BaseException):
                raise does
            return does

        module = SimpleNamespace(add_arguments=lambda parser: parser.add_argument("--deep", action="store_true"), run=run)
        monkeypatch.setitem(sys.modules, "lpcal.cli.check", module)

    return put


OUTCOME = Outcome(
    summary=["two lines", "of summary"],
    document={"H_PC": np.eye(2), "std_s": float("nan"), "n": np.int64(3)},
    warnings=["the disc is warm"],
    next_command="lpcal handeye",
)


def test_without_words_help_is_printed_and_the_code_is_2(lpcal: Run) -> None:
    code, out, err = lpcal()
    assert (code, out) == (2, "")
    assert all(f"\n    {name} " in err for name in cli.COMMANDS)


def test_help_lists_every_command_and_the_exit_codes(lpcal: Run) -> None:
    code, out, err = lpcal("--help")
    assert (code, err) == (0, "")
    assert all(f"\n    {name} " in out for name in cli.COMMANDS)
    assert "130 interrupted" in out


@pytest.mark.parametrize("words", [["--fast"], ["check", "--fast"], ["check", "extra"], ["--json"], ["check", "--json=yes"]])
def test_unknown_words_are_usage_errors(lpcal: Run, plant: Plant, words: list[str]) -> None:
    plant(OUTCOME)
    code, out, err = lpcal(*words)
    assert (code, out) == (2, "")
    assert err.startswith("usage: lpcal")
    assert "Traceback" not in err


def test_version_names_the_libraries_without_importing_them() -> None:
    program = (
        "import sys\nfrom lpcal.cli.main import main\n"
        "try:\n    main(['--version'])\nexcept SystemExit as stop:\n    assert stop.code in (0, None)\n"
        "heavy = {'numpy', 'scipy', 'cv2', 'mrcal', 'casadi', 'pycolmap'} & set(sys.modules)\n"
        "sys.exit(f'imported {heavy}' if heavy else 0)"
    )
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert (found.returncode, found.stderr) == (0, "")
    lines = found.stdout.splitlines()
    assert lines[0] == f"lpcal {__version__}"
    assert [line.split()[0] for line in lines[1:]] == [*cli.LIBRARIES, "kernels"]
    assert lines[-1] == "kernels compiled"
    assert f"numpy {np.__version__}" in lines


def test_a_summary_goes_to_stdout_warnings_to_stderr(lpcal: Run, plant: Plant) -> None:
    plant(OUTCOME, progress_steps=20)
    code, out, err = lpcal("check")
    assert (code, out) == (0, "two lines\nof summary\nnext: lpcal handeye\n")
    assert err.splitlines()[0].startswith("images read: ")
    assert err.splitlines()[-2:] == ["images read: 20 of 20", "warning: the disc is warm"]


def test_json_prints_one_document(lpcal: Run, plant: Plant) -> None:
    plant(OUTCOME, progress_steps=3)
    code, out, _ = lpcal("check", "--json")
    assert code == 0
    assert json.loads(out) == {"H_PC": [[1.0, 0.0], [0.0, 1.0]], "std_s": None, "n": 3, "warnings": ["the disc is warm"]}


def test_an_outcome_may_carry_its_own_code(lpcal: Run, plant: Plant) -> None:
    plant(Outcome(summary=["one of two captures failed"], exit_code=4))
    assert lpcal("check")[:2] == (4, "one of two captures failed\n")


CODES = [
    (errors.UsageError, 2),
    (errors.InputError, 3),
    (errors.DegenerateError, 4),
    (errors.ConvergenceError, 5),
    (errors.DisagreementError, 6),
]


@pytest.mark.parametrize(("kind", "code"), CODES)
@pytest.mark.parametrize("flag", [(), ("--json",)])
def test_an_error_is_one_message_and_its_code(lpcal: Run, plant: Plant, kind: type[errors.LpcalError], code: int, flag: Any) -> None:
    plant(kind("a bare number, 25", where="panel.yaml:12, board.square", needed="a length with its unit", todo="write 25 mm"))
    told = "lpcal: panel.yaml:12, board.square: a bare number, 25\n  needed: a length with its unit\n  do: write 25 mm\n"
    assert lpcal("check", *flag) == (code, "", told)


def test_every_error_has_its_own_code() -> None:
    def below(kind: type) -> set[type]:
        return {kind}.union(*map(below, kind.__subclasses__()))

    assert {kind.exit_code for kind in below(errors.LpcalError) - {errors.LpcalError}} == {code for _, code in CODES}


def test_a_bug_shows_its_traceback_and_asks_for_a_report(lpcal: Run, plant: Plant) -> None:
    plant(ZeroDivisionError("nothing to divide by"))
    code, out, err = lpcal("check", "--deep")
    assert (code, out) == (1, "")
    assert "Traceback" in err
    assert "nothing to divide by" in err
    assert err.endswith("please report the lines above and the command: lpcal check --deep\n")


@pytest.mark.parametrize("number", [errno.EACCES, errno.ENOSPC, errno.EROFS, errno.ENOENT, errno.ENAMETOOLONG, errno.EIO])
def test_a_disk_that_refuses_is_no_bug(lpcal: Run, plant: Plant, number: int) -> None:
    plant(OSError(number, "No space left on device", "calib/camera.yaml"))
    code, out, err = lpcal("check")
    assert (code, out) == (3, "")
    assert err == "lpcal: calib/camera.yaml: No space left on device\n  do: correct that, or name another place\n"


def test_too_little_memory_is_no_bug(lpcal: Run, plant: Plant) -> None:
    plant(MemoryError())
    code, out, err = lpcal("check")
    assert (code, out) == (3, "")
    assert err.startswith("lpcal: not enough memory\n")


def test_an_interrupt(lpcal: Run, plant: Plant) -> None:
    plant(KeyboardInterrupt())
    assert lpcal("check") == (130, "", "lpcal: interrupted; nothing half-written was kept\n")


def test_a_reader_that_leaves_is_no_bug() -> None:
    program = (
        "import sys, types\n"
        "from lpcal.records.outcome import Outcome\n"
        "run = lambda options, progress: Outcome(summary=['x' * 80] * 9000)\n"
        "sys.modules['lpcal.cli.check'] = types.SimpleNamespace(add_arguments=lambda parser: None, run=run)\n"
        "from lpcal.cli.main import main\n"
        "sys.exit(main(['check']))\n"
    )
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        assert process.stdout.readline() == "x" * 80 + "\n"
        process.stdout.close()
        assert process.stderr.read() == ""
        assert process.wait(timeout=20) == 0


def test_python_m_lpcal() -> None:
    found = subprocess.run([sys.executable, "-m", "lpcal", "nonsense"], capture_output=True, text=True, check=False)
    assert found.returncode == 2
    assert "no command is called nonsense" in found.stderr


def test_an_interrupt_while_the_command_line_is_being_imported() -> None:
    program = (
        "import sys, types\n"
        "class Finder:\n    def find_spec(self, name, path, target=None):\n        if name == 'lpcal.cli.main': raise KeyboardInterrupt\n"
        "sys.meta_path.insert(0, Finder())\n"
        "from lpcal.__main__ import run\n"
        "sys.exit(run())\n"
    )
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert (found.returncode, found.stderr) == (130, "lpcal: interrupted; nothing half-written was kept\n")


SPEAKER = (
    "import sys, types\n"
    "from lpcal.records.outcome import Outcome\n"
    "run = lambda options, progress: Outcome(summary=['fx 518.2 \\u00b1 0.1 px, M\\u00fcnze'], warnings=['0.2 \\u00b0'])\n"
    "sys.modules['lpcal.cli.check'] = types.SimpleNamespace(add_arguments=lambda parser: None, run=run)\n"
    "sys.argv[1:] = ['check']\n"
    "from lpcal.__main__ import run\n"
    "sys.exit(run())\n"
)


@pytest.mark.parametrize("closed", [">&-", "2>&-", ">&- 2>&-", "<&-"])
def test_closed_streams_are_no_bug(closed: str) -> None:
    found = subprocess.run(["sh", "-c", f'"$0" -c "$1" {closed}', sys.executable, SPEAKER], capture_output=True, text=True, check=False)
    assert found.returncode == 0
    assert "Traceback" not in found.stderr


def test_a_terminal_of_plain_ascii_is_no_bug() -> None:
    plain = {"PYTHONIOENCODING": "ascii", "PATH": os.environ["PATH"]}
    found = subprocess.run([sys.executable, "-c", SPEAKER], capture_output=True, text=True, check=False, env=plain)
    assert (found.returncode, found.stdout) == (0, "fx 518.2 ? 0.1 px, M?nze\n")
    assert found.stderr == "warning: 0.2 ?\n"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
def test_a_full_disk_under_stdout_is_named() -> None:
    found = subprocess.run(["sh", "-c", '"$0" -c "$1" > /dev/full', sys.executable, SPEAKER], capture_output=True, text=True, check=False)
    assert found.returncode == 3
    assert "its summary cannot be written to stdout: No space left on device" in found.stderr
    assert "Traceback" not in found.stderr
    assert "Exception ignored" not in found.stderr


def test_a_signal_that_comes_out_as_another_exception_is_a_stop_all_the_same() -> None:
    program = SPEAKER.replace(
        "run = lambda options, progress: Outcome(",
        "import os, signal\n"
        "def swallowed():\n"
        "    try:\n        os.kill(os.getpid(), signal.SIGTERM)\n        import time; time.sleep(5)\n"
        "    except BaseException:\n        raise ImportError('a module that was being imported')\n"
        "run = lambda options, progress: swallowed() or Outcome(",
    )
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert (found.returncode, found.stderr) == (143, "lpcal: ended by SIGTERM; nothing half-written was kept\n")


@pytest.mark.parametrize("words", [["--version"], ["--help"], ["reconstruct", "--help"]])
def test_help_and_versions_end_quietly_where_their_reader_has_left(words: list[str]) -> None:
    """As in ``lpcal --help | head -1``: the pipe is closed before anything is written."""
    reader, writer = os.pipe()
    os.close(reader)
    try:
        done = subprocess.run([sys.executable, "-m", "lpcal", *words], stdout=writer, stderr=subprocess.PIPE, text=True, check=False)
    finally:
        os.close(writer)
    assert (done.returncode, done.stderr) == (0, "")
