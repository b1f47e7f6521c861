"""``--jobs`` and ``--on``: where a command's many items are worked on."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from lpcal.errors import UsageError

if TYPE_CHECKING:
    from lpcal.api.engines import Engine


def add_on(parser: argparse.ArgumentParser) -> None:
    """Declare ``--on``."""
    parser.add_argument(
        "--on", metavar="ENGINE", help="where: processes, dask, dask://HOST:PORT, slurm or slurm-trial (default: processes)"
    )


def add_engine_words(parser: argparse.ArgumentParser, items: str) -> None:
    """Declare both, for items of this name."""
    parser.add_argument(
        "--jobs", metavar="N", help=f"{items} worked on at a time (default: one after the other; with --on, every processor)"
    )
    add_on(parser)


def add_cores(parser: argparse.ArgumentParser, shared: str) -> None:
    """Declare ``--jobs`` of a command whose cores share its work, `shared`."""
    parser.add_argument("--jobs", metavar="N", help=f"cores that share {shared} (default: all); the result is the same with any number")


def jobs_of(text: str | None) -> int | None:
    """How many at a time, or how many cores; None where it is not said.

    Raises
    ------
    UsageError
        It is no whole number from 1.
    """
    if text is None:
        return None
    if not text.isascii() or not text.isdigit() or int(text) < 1:
        raise UsageError(f"{text!r} is no number of cores", where="--jobs", needed="a whole number from 1, such as 4")
    return int(text)


def begin_early(where: str | None, jobs: int | None, items: int) -> None:
    """Begin what an engine's workers import where many items will be worked on at a time, before this process imports its own."""
    if items > 1 and (where is not None or jobs not in {None, 1}):
        from lpcal.api import workers

        workers.begin_early(where or "processes")


def engine_of_words(where: str | None, jobs: int | None, folder: Path) -> Engine | None:
    """Where many items are worked on; None: one after the other, here.

    Raises
    ------
    UsageError, InputError
        As `lpcal.api.engines.engine_of`.
    """
    if where is None and jobs in {None, 1}:
        return None
    from lpcal.api.engines import engine_of

    return engine_of(where or "processes", jobs, folder)
