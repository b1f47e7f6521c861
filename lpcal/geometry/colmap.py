"""pycolmap, imported so that the process stays as it was: its logger takes SIGTERM for itself, to print a stack and die."""

from __future__ import annotations

import signal
import threading
from types import ModuleType


def load_pycolmap() -> ModuleType:
    """The module; the handlers of signals are those from before.

    Raises
    ------
    ImportError
        It is not installed.
    """
    before = signal.getsignal(signal.SIGTERM)
    import pycolmap

    if before is not None and threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGTERM, before)
    return pycolmap
