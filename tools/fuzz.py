"""Mutate a valid sample of every format that lpcal reads, give it to the command that reads it, and count how that ends.

Every case is a seed: it picks the format, the sample and the mutations, so ``--case N`` shows one again. Cases run through the command
line's own entry in a child process with a bound on its time and its memory; a child that dies is counted against the case it was at.

::

    uv run python tools/fuzz.py [--cases 20000] [--first 0] [--formats tum,lp] [--jobs 1] [--json FILE]
    uv run python tools/fuzz.py --case 1234          # one case by itself, with all that it says; its folder is kept

What counts as wrong: a traceback (exit code 1), a code that is none of the contract's, a death by a signal, more than `MOST_S` seconds,
more than `MOST_BYTES` of memory, a message longer than `MOST_CHARACTERS`.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import multiprocessing
import os
import random
import resource
import signal
import sys
import tempfile
import time
import warnings
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from fuzz_samples import SAMPLES, Sample

MOST_S = 10.0
"""Seconds of processor time after which a case counts as slow; ten times as many of wall-clock time and it hangs."""
MOST_BYTES = 1 << 30
"""Bytes of memory, beyond what the imports take, that a case may ask for."""
MOST_CHARACTERS = 600
"""Characters of an error message."""
CODES = {0, 2, 3, 4, 5, 6}
"""Exit codes that a file can cause."""
BATCH = 200
"""Cases that one child runs before a fresh one takes over."""
NUMBERS = (
    b"nan",
    b"inf",
    b"-inf",
    b"-1",
    b"0",
    b"1e308",
    b"-1e308",
    b"1e999",
    b"99999999999999999999",
    b"-0.0",
    b"1e-320",
    b"",
    b"x",
    b"9" * 5000,
)
PIECES = (
    b"[" * 3000,
    b"{" * 3000,
    b"(" * 3000,
    b"A" * 70000,
    b"\x00",
    b"\xff\xfe",
    b",,,,,,,,",
    b";",
    b"\t",
    b'"',
    b"'",
    b"\r",
    b"\n\n",
    b"&a [*a]",
    b": ",
    b"- " * 2000,
)


@dataclass(frozen=True)
class Result:
    """How a case ended."""

    case: int
    format: str
    code: int
    """The exit code; minus the signal's number for a death."""
    seconds: float
    said: str
    crash: str = ""

    @property
    def wrong(self) -> str:
        """What is wrong with it, in a word; empty where nothing is."""
        if self.code < 0:
            return "hang" if self.code == -signal.SIGALRM else "crash"
        if self.code not in CODES:
            return "memory" if "MemoryError" in self.said else "traceback"
        if self.seconds > MOST_S:
            return "slow"
        return "long message" if self.code and len(last_message(self.said)) > MOST_CHARACTERS else ""


def last_message(said: str) -> str:
    """The error message at the end of what was said on stderr."""
    return said[said.rfind("lpcal: ") :] if "lpcal: " in said else said


def mutate(data: bytes, rng: random.Random) -> bytes:
    """One to four mutations, each by bytes, by numbers or by lines."""
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        data = rng.choice(MUTATIONS)(data, rng)
    return data


def _flip(data: bytes, rng: random.Random) -> bytes:
    changed = bytearray(data)
    for _ in range(rng.choice((1, 1, 3, 20))):
        if changed:
            changed[rng.randrange(len(changed))] = rng.choice((0, 1, 0x7F, 0x80, 0xFF, rng.randrange(256)))
    return bytes(changed)


def _cut(data: bytes, rng: random.Random) -> bytes:
    return data[: rng.randrange(len(data) + 1)]


def _drop(data: bytes, rng: random.Random) -> bytes:
    start = rng.randrange(len(data) + 1)
    return data[:start] + data[start + rng.choice((1, 2, 8, 100, 1000)) :]


def _insert(data: bytes, rng: random.Random) -> bytes:
    start = rng.randrange(len(data) + 1)
    return data[:start] + rng.choice(PIECES) + data[start:]


def _again(data: bytes, rng: random.Random) -> bytes:
    start = rng.randrange(len(data) + 1)
    piece = data[start : start + rng.choice((4, 64, 1000))]
    return data[:start] + piece * rng.choice((2, 2, 50)) + data[start:]


def _number(data: bytes, rng: random.Random) -> bytes:
    import re

    numbers = list(re.finditer(rb"[-+]?\d[\d.]*(?:[eE][-+]?\d+)?", data[:200000]))
    if not numbers:
        return _flip(data, rng)
    for _ in range(rng.choice((1, 1, 3))):
        chosen = rng.choice(numbers)
        data = data[: chosen.start()] + rng.choice(NUMBERS) + data[chosen.end() :]
    return data


def _lines(data: bytes, rng: random.Random) -> bytes:
    lines = data.split(b"\n")
    at, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    match rng.randrange(4):
        case 0:
            del lines[at]
        case 1:
            lines.insert(at, lines[other])
        case 2:
            lines[at], lines[other] = lines[other], lines[at]
        case _:
            lines[at] = lines[at][: rng.randrange(len(lines[at]) + 1)]
    return b"\n".join(lines)


MUTATIONS: tuple[Callable[[bytes, random.Random], bytes], ...] = (_flip, _cut, _drop, _insert, _again, _number, _number, _lines, _lines)


def run_case(case: int, samples: list[Sample], folder: Path) -> Result:
    """One case in this process, in a folder of its own."""
    from lpcal.cli.main import main

    rng = random.Random(case)
    sample = samples[rng.randrange(len(samples))]
    target = sample.make(folder, rng)
    target.write_bytes(mutate(target.read_bytes(), rng))
    out, err = io.StringIO(), io.StringIO()
    here, begun = Path.cwd(), processor_s()
    os.chdir(folder)
    signal.setitimer(signal.ITIMER_REAL, 10 * MOST_S)
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main(sample.command.split())
    except SystemExit as stop:
        code = stop.code if isinstance(stop.code, int) else 2
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        os.chdir(here)
    return Result(case, sample.name, code, processor_s() - begun, err.getvalue()[-4000:])


def processor_s() -> float:
    """Processor time of this process and of its children that have ended."""
    return sum(os.times()[:4])


def _child(cases: list[int], samples: list[Sample], pipe: Connection) -> None:
    """Run cases one by one; each is announced, then answered."""
    devnull = os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(devnull, stream)
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    warnings.simplefilter("ignore")  # as errors they would be taken for lpcal's own
    held = 0
    for case in cases:
        pipe.send(case)
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            answer = run_case(case, samples, Path(folder))
        pipe.send(answer)
        if not held:  # the first case does the imports; what comes after may take so much more
            held = int(Path("/proc/self/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
            resource.setrlimit(resource.RLIMIT_AS, (held + MOST_BYTES, resource.RLIM_INFINITY))


def prepare(samples: list[Sample]) -> None:
    """Make every sample once, before the children that use them are forked."""
    for sample in samples:
        with tempfile.TemporaryDirectory() as folder:
            sample.make(Path(folder), random.Random(0))


def run_cases(cases: list[int], samples: list[Sample], report: Callable[[Result], None]) -> None:
    """Run cases in children, a fresh one after each batch and after each death."""
    fork = multiprocessing.get_context("fork")
    while cases:
        mine, theirs = fork.Pipe(duplex=False)
        child = fork.Process(target=_child, args=(cases[:BATCH], samples, theirs))
        child.start()
        theirs.close()
        current, begun, done = cases[0], time.perf_counter(), 0
        with contextlib.suppress(EOFError):
            while True:
                answer = mine.recv()
                if isinstance(answer, Result):
                    report(answer)
                    done += 1
                else:
                    current, begun = answer, time.perf_counter()
        child.join()
        if done < len(cases[:BATCH]):
            report(
                Result(
                    current,
                    samples[random.Random(current).randrange(len(samples))].name,
                    child.exitcode or -1,
                    time.perf_counter() - begun,
                    "",
                )
            )
            done += 1
        cases = cases[done:]


def main() -> int:
    """Run the cases; 0 where nothing was wrong."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--cases", type=int, default=20000, help="how many (default 20000)")
    parser.add_argument("--first", type=int, default=0, help="the first seed (default 0)")
    parser.add_argument("--formats", help="only these, by name, separated by commas")
    parser.add_argument("--case", type=int, help="one case, with all that it says")
    parser.add_argument("--json", type=Path, help="write what was wrong there")
    options = parser.parse_args()
    samples = [sample for sample in SAMPLES if not options.formats or sample.name in options.formats.split(",")]
    if options.case is not None:
        folder = Path(tempfile.mkdtemp())
        result = run_case(options.case, samples, folder)
        print(f"{folder}: {result.format}, code {result.code}, {result.seconds:.2f} s {result.wrong}\n{result.said}")
        return 0
    prepare(samples)
    counts: Counter[tuple[str, str]] = Counter()
    wrong: list[Result] = []
    slowest: dict[str, float] = {}

    def report(result: Result) -> None:
        counts[result.format, result.wrong or str(result.code)] += 1
        slowest[result.format] = max(slowest.get(result.format, 0), result.seconds)
        if result.wrong:
            wrong.append(result)
            print(
                f"case {result.case}: {result.format}: {result.wrong}, code {result.code}, {result.seconds:.1f} s: {result.said[-300:]!r}",
                flush=True,
            )

    run_cases(list(range(options.first, options.first + options.cases)), samples, report)
    for sample in samples:
        ends = {end: count for (name, end), count in sorted(counts.items()) if name == sample.name}
        print(f"{sample.name:<22} {sum(ends.values()):6d}  slowest {slowest.get(sample.name, 0):5.2f} s  {ends}")
    print(f"{sum(counts.values())} cases, {len(wrong)} wrong: {dict(Counter(result.wrong for result in wrong))}")
    if options.json:
        options.json.write_text(json.dumps([vars(result) | {"wrong": result.wrong} for result in wrong], indent=1))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
