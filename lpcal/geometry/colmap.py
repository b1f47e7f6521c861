"""Import of pycolmap without side effects on the process: its logger would install a SIGTERM handler that prints a stack trace."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType


def load_pycolmap() -> ModuleType:
    """Import pycolmap and restore the previous signal handlers.

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
    """Lift the address-space limit that is set while a file is read: it bounds what the file asks for, not the library."""
    try:
        import resource
    except ImportError:  # on systems without it no limit is set either
        yield
        return
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (hard, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
