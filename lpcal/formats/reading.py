"""What a file can cause is an error with its name: readers, and the libraries that they hand files to, run under this roof.

A reader says what is wrong as well as it can. What it did not foresee (a library's exception, an index, a count that asks for memory that
no file of this size can need) is the file's fault all the same, and is reported so.
"""

from __future__ import annotations

import functools
import importlib
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Concatenate

from lpcal.errors import InputError, LpcalError

SPARE_BYTES = 400 << 20
"""Bytes of memory that reading any file may take."""
TIMES_SIZE = 40
"""Bytes of memory that reading may take besides, for each byte of the file: a text of short numbers becomes Python's floats."""


@contextmanager
def reading(path: Path, needed: str) -> Iterator[None]:
    """Whatever goes wrong within is an error of the file, which should have been `needed`.

    Raises
    ------
    InputError
        Anything but an error of lpcal's own or a signal.
    """
    try:
        with _bounded_memory(path):
            yield
    except LpcalError:
        raise
    except MemoryError as error:
        found = "asks for more memory than a file of its size can need"
        raise InputError(found, where=str(path), needed=needed, todo="is it whole? export or copy it again") from error
    except RecursionError as error:
        raise InputError("sections within sections without end", where=str(path), needed=needed, todo="export it again") from error
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror or error}", where=str(path), needed=needed) from error
    except Exception as error:
        found = f"cannot be read: {error or type(error).__name__}"
        raise InputError(found, where=str(path), needed=needed, todo="is it whole? export or copy it again") from error


def reader[**P, T](needed: str, *libraries: str) -> Callable[[Callable[Concatenate[Path, P], T]], Callable[Concatenate[Path, P], T]]:
    """A function whose first argument is the path of the file that it reads, under the roof of `reading`.

    `libraries` are loaded before the memory is bounded: they are not what the file asks for.
    """

    def of(function: Callable[Concatenate[Path, P], T]) -> Callable[Concatenate[Path, P], T]:
        @functools.wraps(function)
        def read(path: Path, /, *given: P.args, **named: P.kwargs) -> T:
            for library in libraries:
                importlib.import_module(library)
            with reading(path, needed):
                return function(path, *given, **named)

        return read

    return of


@contextmanager
def _bounded_memory(path: Path) -> Iterator[None]:
    """Let the process grow by no more than a file of this size can need, where the system has such a bound (Linux)."""
    if threading.current_thread() is not threading.main_thread():  # the bound is the whole process's
        yield
        return
    try:
        import resource

        held = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0]) * resource.getpagesize()
        size = path.stat().st_size if path.is_file() else sum(each.stat().st_size for each in path.rglob("*"))
        before = resource.getrlimit(resource.RLIMIT_AS)
        most = held + SPARE_BYTES + TIMES_SIZE * size
        if before[0] == resource.RLIM_INFINITY or before[0] > most:
            resource.setrlimit(resource.RLIMIT_AS, (most, before[1]))
    except (ImportError, OSError, ValueError):
        yield
        return
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)
