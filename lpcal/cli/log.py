"""``--verbose`` and ``--log FILE``: what the stages log under the name ``lpcal``, on stderr and in a file."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import logging

MARK = "# lpcal's log\n"
"""The first line of a log, by which lpcal knows one that it may write on."""


def add_log_options(parser: argparse.ArgumentParser) -> None:
    """Declare the words that every command takes."""
    parser.add_argument("--json", action="store_true", help="print one JSON document instead of the summary")
    loudness = parser.add_mutually_exclusive_group()
    loudness.add_argument("--quiet", action="store_true", help="no progress on stderr; warnings and errors stay")
    loudness.add_argument("--verbose", action="store_true", help="what each stage does, and how long it takes, on stderr")
    parser.add_argument("--log", type=Path, metavar="FILE", help="write that into a file too, with times, after what stands there")


@contextmanager
def logged(options: argparse.Namespace) -> Iterator[None]:
    """Hand what is logged to where the command's words want it.

    Raises
    ------
    UsageError, InputError
        The file is no log of lpcal's, or cannot be written.
    """
    if not options.verbose and options.log is None:
        yield
        return
    import logging

    handlers: list[logging.Handler] = []
    if options.verbose:
        console = logging.StreamHandler()
        console.addFilter(lambda record: record.levelno < logging.WARNING)  # warnings are said at the end, by the command
        console.setFormatter(logging.Formatter("%(message)s"))
        handlers.append(console)
    if options.log is not None:
        handlers.append(_file(options.log))
    logger = logging.getLogger("lpcal")
    before = logger.level
    logger.setLevel(logging.DEBUG)
    for handler in handlers:
        logger.addHandler(handler)
    try:
        yield
    finally:
        for handler in handlers:
            logger.removeHandler(handler)
            handler.close()
        logger.setLevel(before)


def _file(path: Path) -> logging.Handler:
    import logging

    from lpcal.formats.outputs import marked, refuse_place

    refuse_place(path, marked("a log of lpcal's", MARK))
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or not path.stat().st_size:
        path.write_text(MARK, encoding="utf-8")
    handler = logging.FileHandler(path, encoding="utf-8")
    handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)-7s %(message)s"))
    return handler
