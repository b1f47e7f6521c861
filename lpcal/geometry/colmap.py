"""pycolmap, imported so that the process stays as it was: its logger takes SIGTERM for itself, to print a stack and die."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType


def load_pycolmap() -> ModuleType:
    """The module; the handlers of signals are those from before.

    Raises
    ------
    ImportError
        It is not installed.
    """
    before = signal.getsignal(signal.SIGTERM)
    with _room_to_load():
        import pycolmap

    if before is not None and threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGTERM, before)
    return pycolmap


@contextmanager
def _room_to_load() -> Iterator[None]:
    """Lift the bound on memory that stands while a file is read: the library is not what the file asks for."""
    try:
        import resource
    except ImportError:  # the bound too is set only where there is this
        yield
        return
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (hard, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
