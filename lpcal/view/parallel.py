"""Work on bands of pixels: what belongs to samples is never held for all pixels at once, and cores share the bands.

Bands are the same with any number of cores, and each writes what is its own: so are the bytes of a result.
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
"""Samples, lights times pixels, of a band: a vector a sample is then 0.8 MB, which a core's own cache holds."""

_cores: ContextVar[int | None] = ContextVar("cores", default=None)
_shares: ContextVar[bool] = ContextVar("shares", default=False)
"""Whether this is one of the threads that share work."""


@contextmanager
def cores(count: int | None) -> Iterator[None]:
    """Within this, bands are shared by so many threads; None leaves that as it is around this: one a core, where nothing is said."""
    token = _cores.set(_cores.get() if count is None else count)
    try:
        yield
    finally:
        _cores.reset(token)


def workers() -> int:
    """How many threads share work here."""
    return _cores.get() or os.cpu_count() or 1


def bands(pixels: int, lights: int) -> list[slice]:
    """Slices of all pixels, one a band: an even number of them, equal in size, and two where each holds a quarter of what it may."""
    samples = pixels * max(lights, 1)
    count = max(-(-samples // SAMPLES), min(2, 2 * samples // SAMPLES), 1)
    count = min(count + (count > 1 and count % 2), max(pixels, 1))
    ends = [pixels * k // count for k in range(count + 1)]
    return [slice(first, last) for first, last in pairwise(ends)]


def run_bands[T](pixels: int, lights: int, work: Callable[[slice], T]) -> list[T]:
    """What the work makes of each band, in their order."""
    return run_all(work, bands(pixels, lights))


def start[T](work: Callable[[], T]) -> Callable[[], T]:
    """Work begun on a thread of its own, and how to wait for what it makes; on one core it is done when that is asked for."""
    if workers() <= 1:
        return cache(work)
    pool = ThreadPoolExecutor(1, initializer=_cores.set, initargs=(1,))
    future = pool.submit(work)
    pool.shutdown(wait=False)
    return future.result


def run_all[S, T](work: Callable[[S], T], items: Iterable[S]) -> list[T]:
    """What the work makes of each item, in their order, by as many threads as there are cores.

    Work that shares its own in turn does that alone.
    """
    items = list(items)
    count = min(workers(), len(items))
    if count <= 1:
        return [work(item) for item in items]
    if _shares.get():  # they may all be taken
        with ThreadPoolExecutor(count, initializer=_cores.set, initargs=(1,)) as pool:
            return list(pool.map(work, items))
    return list(_threads(workers(), os.getpid()).map(work, items))


@cache
def _threads(count: int, process: int) -> ThreadPoolExecutor:  # noqa: ARG001 - a forked process has none of its parent's
    """Threads that are kept: beginning and ending some for each piece of work takes longer than many a piece."""

    def begin() -> None:
        _cores.set(1)
        _shares.set(True)

    return ThreadPoolExecutor(count, initializer=begin)
