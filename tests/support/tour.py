"""The README's tour: its commands, run in order in a fresh folder, and their output beside what the page says."""

from __future__ import annotations

import contextlib
import io
import os
import re
import shlex
from dataclasses import dataclass
from pathlib import Path

README = Path(__file__).resolve().parents[2] / "README.md"
BLOCK = re.compile(r"```console\n(.*?)```", re.DOTALL)
NUMBER = re.compile(r"[-+]?\d+(?: \d{3}(?!\d))*(?:\.\d+)?")
SKIPPED = "..."
VARIES = re.compile(r"\d+(\.\d+)? s\b")


@dataclass(frozen=True)
class Step:
    """One command of the page and the lines it says that follow."""

    command: str
    said: list[str]


def steps(text: str) -> list[Step]:
    """All commands of the page's console blocks, in order."""
    found: list[Step] = []
    for block in BLOCK.findall(text):
        for line in block.splitlines():
            if line.startswith("$ "):
                found.append(Step(line[2:], []))
            else:
                found[-1].said.append(line)
    return found


def run(step: Step) -> list[str]:
    """Lines that a command prints on stdout; ``cd`` moves this process."""
    from lpcal.cli.main import main

    words = shlex.split(step.command)
    if words[0] == "cd":
        os.chdir(words[1])
        return []
    assert words[0] == "lpcal", step.command
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main(words[1:])
    assert code == 0, f"{step.command}: exit {code}\n{err.getvalue()[-2000:]}"
    return out.getvalue().splitlines()


def differs(said: list[str], printed: list[str]) -> str | None:
    """The first line of the page that the output does not have, in order; numbers may be off by a third or a little."""
    place = 0
    for line in said:
        if line.strip() == SKIPPED:
            continue
        while place < len(printed) and not alike(line, printed[place]):
            place += 1
        if place == len(printed):
            return line
        place += 1
    return None


def alike(said: str, printed: str) -> bool:
    """Whether two lines say the same in words, with numbers that are nearly the same."""
    said, printed = VARIES.sub("# s", said.rstrip()), VARIES.sub("# s", printed.rstrip())
    if _words(said) != _words(printed):
        return False
    one, other = NUMBER.findall(said), NUMBER.findall(printed)
    pairs = zip(one, other, strict=False)
    return len(one) == len(other) and all(
        abs(_value(a) - _value(b)) <= max(0.35 * abs(_value(a)), 0.05, 2 * 10.0 ** -len(a.partition(".")[2])) for a, b in pairs
    )


def _words(line: str) -> str:
    return re.sub(r"[#\s]+", " ", NUMBER.sub("#", line)).strip()


def _value(text: str) -> float:
    return float(text.replace(" ", ""))
