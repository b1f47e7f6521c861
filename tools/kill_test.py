"""Kill ``lpcal run`` at every point at which it writes, in turn, and see that the next run ends with the same bytes.

A small rig is simulated once and run once for reference. Then, for every call N of the functions through which lpcal writes (a file opened,
a folder made, a flush, a rename, an exchange, a removal), a copy of the rig is run by a process that is killed (SIGKILL: nothing unwinds)
as it comes to call N, a second run follows, and its folder is compared byte by byte with the reference; only the seconds and the memory in
summary.json, and what is made from them, may differ. ``--random`` kills at random moments besides; ``--signals`` sends SIGTERM, SIGHUP and
SIGINT at so many moments each and looks at the message and the exit code too.

::

    uv run python tools/kill_test.py [--random 30] [--signals 10] [--every 1] [--keep FOLDER]
"""

from __future__ import annotations

import argparse
import contextlib
import hashlib
import importlib
import io
import json
import os
import random
import re
import shutil
import signal
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

RIG = """lpcal: 1
name: small
camera: {images: stations/*.png, model: opencv4}
board: {kind: chessboard, corners: [9, 6], square: 25 mm}
mocap: {poses: robot.csv}
panel: {disc_radius: 60 mm, joint: 15 mm, blob: 30 mm}
lights:
  L0: {azimuth: 0 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 19}
  L1: {azimuth: 90 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 19}
  L2: {azimuth: 180 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 19}
  L3: {azimuth: 270 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 19}
objects: {relief: objects/relief}
"""
WRITERS = ("mkdir", "fsync", "rename", "replace", "unlink", "rmdir")
"""The functions of the module os through which lpcal writes, beside opening a file and the exchange of two folders."""
SEED = 1
STOPPED_CLOCK = "2000-01-01T00:00:00+00:00"


def main() -> int:
    """Run it all; 0 where every second run ended as the reference did."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--random", type=int, default=30, help="kills at random moments (default 30)")
    parser.add_argument("--signals", type=int, default=10, help="moments at which SIGTERM, SIGHUP and SIGINT are sent (default 10)")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only every Nth write point (default 1: all)")
    parser.add_argument("--keep", type=Path, help="work there, and leave it for a look")
    options = parser.parse_args()
    for name in ("main", "run", "simulate"):
        importlib.import_module(f"lpcal.cli.{name}")
    importlib.import_module("lpcal.pipeline.run")
    with contextlib.ExitStack() as stack:
        desk = options.keep or Path(stack.enter_context(tempfile.TemporaryDirectory()))
        return kill_everywhere(desk, options)


def kill_everywhere(desk: Path, options: argparse.Namespace) -> int:
    """All kills in a folder."""
    (desk / "template").mkdir(parents=True, exist_ok=True)
    (desk / "template" / "panel.yaml").write_text(RIG)
    rig, reference = desk / "rig", desk / "reference"
    if not rig.exists():
        lpcal(["simulate", "--rig", str(desk / "template"), "--size", "240x180", "--stations", "8", str(rig)], desk)
    shutil.rmtree(reference, ignore_errors=True)
    shutil.copytree(rig, reference)
    log = desk / "points.txt"
    begun = time.monotonic()
    assert lpcal(["run"], reference, lambda: kill_at(0, log)) == 0, (desk / "said.txt").read_text()
    duration = time.monotonic() - begun
    points, expected = log.read_text().split(), contents(reference)
    print(f"{len(points)} write points: {dict(Counter(points))}", flush=True)
    wrong: list[str] = []
    for number in range(1, len(points) + 1, options.every):
        wrong += trial(desk, expected, f"point {number} ({points[number - 1]})", lambda number=number: kill_at(number, log))
    rng = random.Random(SEED)
    for number in range(options.random):
        moment = rng.uniform(0, duration)
        wrong += trial(desk, expected, f"random kill {number} at {moment:.2f} s", lambda moment=moment: signal_at(moment, signal.SIGKILL))
    for number in range(options.signals):
        for name in ("SIGTERM", "SIGHUP", "SIGINT"):
            moment = duration * (number + 0.5) / options.signals
            wrong += trial(desk, expected, f"{name} at {moment:.2f} s", lambda m=moment, n=name: signal_at(m, getattr(signal, n)), name)
    print("\n".join([*wrong, f"{len(wrong)} of them wrong"]))
    return 1 if wrong else 0


def trial(desk: Path, expected: dict[str, str], what: str, before: Callable[[], None], sent: str | None = None) -> list[str]:
    """A run that is ended on its way, and the one after it; what was wrong."""
    copy = desk / "copy"
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(desk / "rig", copy)
    code = lpcal(["run"], copy, before)
    wrong = []
    if sent and code not in {0, 128 + getattr(signal, sent)}:
        wrong.append(f"{what}: ended with {code}")
    if sent and code and not re.search(r"lpcal: .*; nothing half-written was kept\n\Z", (desk / "said.txt").read_text()):
        wrong.append(f"{what}: said {(desk / 'said.txt').read_text()[-300:]!r}")
    again = lpcal(["run"], copy)
    found = contents(copy)
    differ = sorted(name for name in expected | found if expected.get(name) != found.get(name))
    wrong += [f"{what}: the second run ended with {again}"] if again else []
    wrong += [f"{what}: other bytes in {', '.join(differ)}"] if differ else []
    print(f"{what}: first run {code}, second {again}, {len(differ)} files differ", flush=True)
    return wrong


def lpcal(words: list[str], folder: Path, before: Callable[[], None] = lambda: None) -> int:
    """One command in a child of this process, which has the imports done; its exit code, -9 where it was killed."""
    child = os.fork()
    if child == 0:
        said = os.open(folder.parent / "said.txt", os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644)
        for stream in (1, 2):
            os.dup2(said, stream)
        os.chdir(folder)
        sys.argv[1:] = words
        stop_the_clock()
        before()
        from lpcal.__main__ import run

        try:
            code = run()
        except BaseException as error:  # noqa: BLE001 - a child never returns
            code = error.code if isinstance(error, SystemExit) else 99
        sys.stderr.flush()
        os._exit(code)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def stop_the_clock() -> None:
    """Every provenance gets the same time."""
    from lpcal.formats import documents

    class Stopped:
        now = staticmethod(lambda _: Stopped)
        isoformat = staticmethod(lambda timespec: STOPPED_CLOCK)  # noqa: ARG005

    vars(documents)["datetime"] = Stopped


def kill_at(number: int, log: Path) -> None:
    """Count the calls of what writes, in this process; be killed as the number-th begins. 0: write down the names of all."""
    from lpcal.formats import outputs

    calls = 0

    def counted(name: str, real: Callable[..., object], writes: Callable[..., bool] = lambda *_, **__: True) -> Callable[..., object]:
        def call(*given: object, **named: object) -> object:
            nonlocal calls
            if writes(*given, **named):
                calls += 1
                if not number:
                    names.append(name)
                    real_write(log, names)
                elif calls == number:
                    os.kill(os.getpid(), signal.SIGKILL)
            return real(*given, **named)

        return call

    names: list[str] = []
    real_open = io.open

    def real_write(path: Path, lines: list[str]) -> None:
        with real_open(path, "w", encoding="utf-8") as stream:
            stream.write("\n".join(lines))

    for name in WRITERS:
        setattr(os, name, counted(name, getattr(os, name)))
    opened = counted("open", io.open, lambda file, mode="r", *_, **__: isinstance(file, (str, Path)) and set(mode) & set("wax+"))
    io.open = opened  # type: ignore[assignment]
    outputs._exchange = counted("exchange", outputs._exchange)  # type: ignore[assignment]  # noqa: SLF001


def signal_at(moment: float, number: int) -> None:
    """Have a signal sent to this process after so many seconds."""
    target = os.getpid()
    if os.fork() == 0:
        time.sleep(moment)
        with contextlib.suppress(ProcessLookupError):
            os.kill(target, number)
        os._exit(0)


def contents(folder: Path) -> dict[str, str]:
    """The digest of every file of a rig folder; of summary.json without what a clock or a memory meter says, of the report nothing."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        data = path.read_bytes() if path.is_file() else b"a folder"
        if path.name == "summary.json":
            summary = json.loads(data)
            data = json.dumps({key: value for key, value in summary.items() if key not in {"times_s", "peak_memory_mb"}}).encode()
        if path.name == "report.html":
            data = b"made from the stamps of summary.json"
        found[name] = hashlib.sha256(data).hexdigest()
    return found


if __name__ == "__main__":
    sys.exit(main())
