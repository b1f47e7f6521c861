"""The workers of dask: a cluster on this machine, or a scheduler's that is there.

Nothing heavy is imported here: a worker sets its threads before it imports numpy.
"""

from __future__ import annotations

import contextlib
import importlib
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import Any

from lpcal.api.engines import DASK_PRELOADED, PRELOADED, context, one_thread
from lpcal.errors import InputError

REPLY_S = 15.0
"""Seconds in which a dask scheduler must answer: dask's own time for a connection is 30, and one that stands answers in one."""
DASK_LEAN = {
    "distributed.worker.profile.enabled": False,
    "distributed.admin.tick.interval": "500ms",
    "distributed.admin.system-monitor.interval": "5s",
    "distributed.scheduler.active-memory-manager.start": False,
}
"""Settings of a dask cluster that is started here, which nobody watches: by default each of its processes profiles itself a hundred times
a second and looks at its clock fifty times, a tenth of a core together."""


@contextmanager
def here(count: int) -> Iterator[Executor]:
    """A dask cluster on this machine, reached over loopback alone."""
    distributed: Any = importlib.import_module("distributed")
    dask: Any = importlib.import_module("dask")
    with (
        one_thread(),
        dask.config.set(DASK_LEAN | {"distributed.worker.multiprocessing-method": context().get_start_method()}),
        _preloaded(distributed.utils.get_mp_context()),
        distributed.LocalCluster(n_workers=count, threads_per_worker=1, memory_limit=0, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
        _undone_cancelled(client) as executor,
    ):
        yield executor


@contextmanager
def _preloaded(forks: Any) -> Iterator[None]:
    """Have dask's own processes forked off a server that has imported lpcal's packages beside dask's."""
    if forks.get_start_method() == "forkserver":
        forks.set_forkserver_preload([*DASK_PRELOADED, *PRELOADED])
    yield


@contextmanager
def at(address: str) -> Iterator[Executor]:
    """The workers of a dask scheduler."""
    distributed: Any = importlib.import_module("distributed")
    with distributed.Client(address, timeout=REPLY_S) as client, _undone_cancelled(client) as executor:
        yield executor


@contextmanager
def _undone_cancelled(client: Any) -> Iterator[Executor]:
    executor = client.get_executor(pure=False)
    try:
        yield executor
    finally:
        with contextlib.suppress(Exception):  # a scheduler that is gone cancels nothing
            executor.shutdown(wait=False)


def refuse_silent(address: str) -> None:
    """Refuse an address at which no scheduler answers.

    Raises
    ------
    InputError
        It does not answer.
    """
    try:
        with at(address):
            return
    except (OSError, ValueError) as error:
        raise InputError(
            "no dask scheduler answers", where=address, needed="the address that dask scheduler prints", todo="start one: dask scheduler"
        ) from error
