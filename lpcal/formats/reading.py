"""What a file can cause is an error with its name: readers, and the libraries that they hand files to, run under this roof.

A reader says what is wrong as well as it can. What it did not foresee (a library's exception, an index, a count that asks for memory that
no file of this size can need) is the file's fault all the same, and is reported so.

A parser that can crash or hang runs in a process of its own with a bound on its time and memory (`parse_limited`): the function is named by
its module, takes one path and returns arrays and plain values; it is imported in the child, so that it starts in a fraction of a second.
"""

from __future__ import annotations

import functools
import importlib
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Concatenate

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


SECONDS = 3.0
"""Seconds of processor time that a parser has for any file."""
SECONDS_A_BYTE = 1e-7
"""Seconds that it has besides, for each byte: ten times what the slowest takes."""
BUSY = 20.0
"""How many times as long it may take by the clock, on a machine that has other things to do."""
OUT_OF_TIME = {-24, -9}
"""What a child returns that the system has ended for its time: SIGXCPU, SIGKILL."""
CHILD_SPARE_BYTES = 450 << 20
"""Bytes of memory that a parser may take for any file, its libraries counted."""
CHILD_TIMES_SIZE = 30
"""Bytes of memory that it may take besides, for each byte of the file."""
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
"""Each thread of a library asks for memory of its own, on a large machine for more than the bound."""
CHILD = """
import importlib, os, pickle, sys
module, name, path, most, seconds = sys.argv[1:]
try:
    import resource
    resource.setrlimit(resource.RLIMIT_AS, (int(most), int(most)))
    resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 2))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
except ImportError:
    pass
answer = os.fdopen(os.dup(1), "wb")
os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
try:
    found = (True, getattr(importlib.import_module(module), name)(path))
except BaseException as error:
    found = (False, f"{error}" or type(error).__name__)
answer.write(pickle.dumps(found))
answer.close()
"""


def parse_limited(function: Callable[[str], Any], path: Path, needed: str) -> Any:
    """What a function of a module makes of a file, in a child process.

    Raises
    ------
    InputError
        The parser raised, crashed, ran out of memory or of time.
    """
    size = path.stat().st_size
    seconds = SECONDS + SECONDS_A_BYTE * size
    words = [
        function.__module__,
        function.__name__,
        str(path.resolve()),
        str(CHILD_SPARE_BYTES + CHILD_TIMES_SIZE * size),
        str(int(seconds)),
    ]
    todo = "is it whole? export or copy it again"
    try:
        alone = os.environ | ONE_THREAD
        ended = subprocess.run([sys.executable, "-c", CHILD, *words], capture_output=True, timeout=BUSY * seconds, check=False, env=alone)
    except subprocess.TimeoutExpired as error:
        raise InputError("its parser does not end", where=str(path), needed=needed, todo=todo) from error
    if not ended.stdout:
        found = (
            f"its parser does not end within {seconds:.0f} s of processor time" if ended.returncode in OUT_OF_TIME else "its parser crashes"
        )
        raise InputError(found, where=str(path), needed=needed, todo=todo)
    good, found = pickle.loads(ended.stdout)
    if not good:
        raise InputError(f"cannot be read: {found}", where=str(path), needed=needed, todo=todo)
    return found
