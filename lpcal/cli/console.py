"""What a command says: a short summary or one JSON document on stdout, progress and warnings on stderr."""

from __future__ import annotations

import io
import json
import os
import shutil
import sys
import textwrap
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, TextIO

if TYPE_CHECKING:  # as in lpcal.cli.main
    from lpcal.records.outcome import Outcome, Progress


def show(outcome: Outcome, *, as_json: bool) -> None:
    """Print an outcome."""
    if as_json:
        from lpcal.formats.documents import plain

        print(json.dumps(plain(outcome.document | {"warnings": outcome.warnings}), indent=1, allow_nan=False))  # noqa: T201
    else:
        print(fitted("\n".join(outcome.summary), sys.stdout))  # noqa: T201
        if outcome.next_command:
            print(f"next: {outcome.next_command}")  # noqa: T201
    for warning in outcome.warnings:
        complain(f"warning: {warning}")


def complain(text: str) -> None:
    """One message on stderr, where that is still there."""
    with suppress(OSError):
        print(fitted(text, sys.stderr), file=sys.stderr, flush=True)  # noqa: T201


def fitted(text: str, stream: TextIO) -> str:
    """Lines broken between words at a terminal's width, elsewhere as they are.

    A line that says what to do may hold a command, which stays in one piece to be copied.
    """
    if not stream.isatty():
        return text
    width = shutil.get_terminal_size().columns
    lines = []
    for line in text.split("\n"):
        if len(line) <= width or line.startswith("  do:"):
            lines.append(line)
            continue
        indent = line[: len(line) - len(line.lstrip())]
        wrapper = textwrap.TextWrapper(width, indent, f"{indent}  ", break_long_words=False, break_on_hyphens=False)
        lines += wrapper.wrap(line.strip())
    return "\n".join(lines)


def open_streams() -> None:
    """Make stdout and stderr take every text: a stream that was closed goes nowhere, one of another encoding shows ? for what it lacks."""
    sys.stdout = sys.stdout or open(os.devnull, "w", encoding="utf-8")  # noqa: PTH123, SIM115 - as long as the process lives
    sys.stderr = sys.stderr or open(os.devnull, "w", encoding="utf-8")  # noqa: PTH123, SIM115
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


@contextmanager
def progress_bars(*, quiet: bool = False) -> Iterator[Progress]:
    """Progress on stderr: live bars on a terminal, a line each time a tenth is done elsewhere; nothing where that is wished."""
    if quiet:
        from lpcal.records.outcome import silent

        yield silent
        return
    if not sys.stderr.isatty():
        yield _lines()
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
    from rich.progress import Progress as Bars

    columns = (TextColumn("{task.description:<28}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(), TimeRemainingColumn())
    with Bars(*columns, console=Console(stderr=True), transient=True) as bars:
        tasks: dict[str, Any] = {}

        def live(what: str, done: int, total: int) -> None:
            if what not in tasks:
                tasks[what] = bars.add_task(what, total=total)
            bars.update(tasks[what], completed=done, total=total)

        yield live


def _lines() -> Progress:
    shown_tenths: dict[str, int] = {}

    def line(what: str, done: int, total: int) -> None:
        tenth = 10 if done >= total else 10 * done // max(total, 1)
        if tenth > shown_tenths.get(what, -1):
            shown_tenths[what] = tenth
            complain(f"{what}: {done} of {total}")

    return line
