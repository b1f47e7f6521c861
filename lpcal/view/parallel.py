"""Parallel work on bands of pixels, so that arrays of one entry a sample are never held for all pixels at once.

The bands do not depend on the number of threads and write to disjoint outputs, so results are the same to the last byte.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from itertools import pairwise

SAMPLES = 1 << 15
"""Samples (lights times pixels) of a band: 3-vectors of all of them then take 0.8 MB, which fits a core's own cache."""

_cores: ContextVar[int | None] = ContextVar("cores", default=None)
_shares: ContextVar[bool] = ContextVar("shares", default=False)
"""Whether the current thread belongs to the shared pool."""


@contextmanager
def cores(count: int | None) -> Iterator[None]:
    """Set the number of threads within a `with` block; None keeps the outer setting, which is one a core by default."""
    token = _cores.set(_cores.get() if count is None else count)
    try:
        yield
    finally:
        _cores.reset(token)


def workers() -> int:
    """Number of threads that share work here."""
    return _cores.get() or os.cpu_count() or 1


def bands(pixels: int, lights: int) -> list[slice]:
    """Slices of all pixels, one a band, of nearly equal size: one for fewer than SAMPLES samples, else an even number."""
    samples = pixels * max(lights, 1)
    count = max(-(-samples // SAMPLES), min(2, 2 * samples // SAMPLES), 1)
    count = min(count + (count > 1 and count % 2), max(pixels, 1))
    ends = [pixels * k // count for k in range(count + 1)]
    return [slice(first, last) for first, last in pairwise(ends)]


def run_bands[T](pixels: int, lights: int, work: Callable[[slice], T]) -> list[T]:
    """Results of `work` for each band of pixels, in order."""
    return run_all(work, bands(pixels, lights))


def start[T](work: Callable[[], T]) -> Callable[[], T]:
    """Start work on its own thread and return the function that waits for its result; on one core the work runs in that call."""
    if workers() <= 1:
        return cache(work)
    pool = ThreadPoolExecutor(1, initializer=_cores.set, initargs=(1,))
    future = pool.submit(work)
    pool.shutdown(wait=False)
    return future.result


def run_all[S, T](work: Callable[[S], T], items: Iterable[S]) -> list[T]:
    """Results of `work` for each item, in order, computed by `workers()` threads.

    Nested calls within a worker thread run on that thread alone.
    """
    items = list(items)
    count = min(workers(), len(items))
    if count <= 1:
        return [work(item) for item in items]
    if _shares.get():  # all threads of the pool may be busy
        with ThreadPoolExecutor(count, initializer=_cores.set, initargs=(1,)) as pool:
            return list(pool.map(work, items))
    return list(_threads(workers(), os.getpid()).map(work, items))


@cache
def _threads(count: int, process: int) -> ThreadPoolExecutor:  # noqa: ARG001 - a forked process inherits no threads
    """A pool that is kept: starting and ending threads for each call takes longer than many of the calls."""

    def begin() -> None:
        _cores.set(1)
        _shares.set(True)

    return ThreadPoolExecutor(count, initializer=begin)
