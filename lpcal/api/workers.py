"""How worker processes of this machine begin: with one thread of linear algebra each, off a server that has imported what they need.

Nothing heavy is imported here: a worker sets its threads before it imports numpy.
"""

from __future__ import annotations

import importlib
import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
"""The variables that hold a worker to one thread of linear algebra; the user's own setting wins."""
PRELOADED = ("lpcal.pipeline.many", "PIL.PngImagePlugin", "cv2", "jinja2")
"""What a worker that reconstructs would import, a third of a second of processor time: where processes are forked off a server, the server
imports it once for all workers and for those that take a lost one's place. What few captures need is imported where it is needed."""
DASK_PRELOADED = ("distributed.nanny", "distributed.worker")
"""And what dask's own do before that."""


def context() -> Any:
    """How a process is started: forked off a server that has only imported, where the system can; never off this process."""
    if not sys.platform.startswith("linux"):  # elsewhere libraries of the system may not be forked
        return multiprocessing.get_context("spawn")
    found = multiprocessing.get_context("forkserver")
    found.set_forkserver_preload([*PRELOADED])
    return found


def begin_early(word: str) -> None:
    """Have the server that workers are forked off import what they need, while this process does what it has to before.

    Parameters
    ----------
    word : str
        The engine's, as for `engine_of`; nothing is begun for those that fork no workers off it.
    """
    forks = context()
    if word in {"dask", "processes"} and forks.get_start_method() == "forkserver":
        forks.set_forkserver_preload([*(DASK_PRELOADED if word == "dask" else ()), *PRELOADED])
        with one_thread():
            importlib.import_module("multiprocessing.forkserver").ensure_running()


@contextmanager
def one_thread() -> Iterator[None]:
    """The environment in which a process that is started now takes one thread of linear algebra."""
    lacking = [name for name in THREADS if name not in os.environ]
    os.environ |= dict.fromkeys(lacking, "1")
    try:
        yield
    finally:
        for name in lacking:
            os.environ.pop(name, None)


def begin_worker() -> None:
    """What a process does first: Ctrl-C is its parent's affair, and where that is gone it ends too."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent,), daemon=True).start()


def _end_with(parent: Any) -> None:
    parent.join()
    os.kill(os.getpid(), signal.SIGTERM)
