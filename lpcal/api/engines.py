"""Where many things are worked on: processes of this machine, the workers of dask, the jobs of SLURM.

Each is a `concurrent.futures.Executor`, started by an `Engine`; `each` hands items over to it, a window of them at a time. What is to be
done is a function of a module that raises nothing by itself. So an exception that comes out of a future says that the worker is gone
(killed, out of memory, its machine down) or cannot work at all; the item is tried again, and in the end is `Lost`: its own result is
missing, and no other.

Nothing heavy is imported here: a worker sets its threads before it imports numpy.
"""

from __future__ import annotations

import contextlib
import importlib
import os
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, ProcessPoolExecutor, wait
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any

from lpcal.api.workers import DASK_PRELOADED, PRELOADED, begin_early, begin_worker, context, one_thread
from lpcal.errors import InputError, UsageError

TRIES = 3
"""How often an item is handed to a worker before it is given up: it may stand beside one that fills the memory, but not three times."""
FRUITLESS = 12
"""Workers lost in a row, nothing having been done between, after which no further one is started: no bad item takes more than `TRIES`
of them, and four bad ones in a row are rarer than workers that cannot run at all."""
WINDOW = 64
"""Items that are handed to a caller's executor at a time: enough that no worker waits, few enough to hold."""
BATCH_S = 0.5
"""Seconds of work that are handed to a worker in one call where an item takes less: what an engine adds to a call (dask some 8 ms) is
then a few per cent, and a lost worker costs no more than that beside its own item."""
ENDING = 3
"""Into how many calls a place of the window what is left is parted at the least, so that all workers end at about the same time."""
REPLY_S = 15.0
"""Seconds in which a dask scheduler must answer: dask's own time for a connection is 30, and one that stands answers in one."""
DASK_LEAN = {
    "distributed.worker.profile.enabled": False,
    "distributed.admin.tick.interval": "500ms",
    "distributed.admin.system-monitor.interval": "5s",
    "distributed.scheduler.active-memory-manager.start": False,
    "distributed.scheduler.http.routes": [],
    "distributed.worker.http.routes": [],
}
"""Settings of a dask cluster that is started here, which nobody watches: by default each of its processes profiles itself a hundred times
a second and looks at its clock fifty times, a tenth of a core together, and has pages ready for a browser."""
WORDS = "processes, dask, dask://HOST:PORT, slurm or slurm-trial"


@dataclass(frozen=True)
class Lost:
    """An item whose worker was lost each time that it was tried."""

    why: str
    """In words."""


@dataclass(frozen=True)
class Engine:
    """A way to have many items worked on.

    Parameters
    ----------
    name : str
        In words, for messages.
    start : callable
        Starts an executor; it ends with the context, at once where that ends by an exception.
    window : int
        How many items are handed over at a time.
    """

    name: str
    start: Callable[[], AbstractContextManager[Executor]]
    window: int


def each[I, R](work: Callable[[I], R], items: Sequence[I], engine: Engine) -> Iterator[tuple[int, R | Lost]]:
    """Have every item worked on; (its number, what came of it) as they are done.

    An item whose worker is lost goes to the end of the row, up to `TRIES` times.

    Parameters
    ----------
    work : callable
        A function of a module, which a worker can import; it returns and never raises.
    items : sequence
        What can be pickled.
    engine : Engine
        Where.

    Yields
    ------
    (int, R or Lost)
        The item's number, and its result.
    """
    row = _Row(deque(range(len(items))), engine.window)
    tries = [0] * len(items)
    lost_in_a_row = 0
    why: BaseException | None = None
    while row and lost_in_a_row < FRUITLESS:
        try:
            with engine.start() as executor:
                at_work: dict[Future[tuple[list[R], float]], list[int]] = {}
                broken = False
                while (row or at_work) and not broken and lost_in_a_row < FRUITLESS:
                    why = _hand_over(executor, work, items, row, at_work)
                    broken = why is not None
                    for future in wait(at_work, return_when=FIRST_COMPLETED).done:
                        numbers = at_work.pop(future)
                        said = GivenBack() if future.cancelled() else future.exception()
                        if said is None:
                            lost_in_a_row = 0
                            found, took_s = future.result()
                            row.measure(took_s / len(numbers))
                            yield from zip(numbers, found, strict=True)
                            continue
                        why = said
                        lost_in_a_row += 1
                        tries[numbers[0]] += len(numbers) == 1  # of several it is not known whose fault it was
                        if tries[numbers[0]] < TRIES:
                            row.again(numbers)
                        else:
                            yield numbers[0], Lost(in_words(said))
                for numbers in at_work.values():
                    row.again(numbers)
                lost_in_a_row += broken
        except (OSError, BrokenExecutor) as error:
            why = error
            break
    for number in [*row.fresh, *row.once_lost]:
        yield number, Lost("no worker can work" if why is None else in_words(why))


@dataclass
class _Row:
    """The numbers of the items that wait, and how many of them go to a worker in one call."""

    fresh: deque[int]
    window: int
    once_lost: deque[int] = field(default_factory=deque)
    """Those whose worker was lost: each goes alone."""
    item_s: float = 0.0
    """Seconds that an item takes, the longer of the last call's and a running mean; 0: not known yet."""

    def __len__(self) -> int:
        return len(self.fresh) + len(self.once_lost)

    def measure(self, item_s: float) -> None:
        """Learn from a call how long an item takes."""
        self.item_s = max(item_s, (self.item_s + item_s) / 2)

    def again(self, numbers: list[int]) -> None:
        """Put items whose worker was lost at the end."""
        self.once_lost.extend(numbers)

    def draw(self) -> list[int]:
        """Take the items of the next call: one until it is known how long one takes."""
        if not self.fresh:
            return [self.once_lost.popleft()]
        together = BATCH_S / self.item_s if self.item_s else 1
        count = max(1, min(int(together), len(self.fresh) // (ENDING * self.window)))
        return [self.fresh.popleft() for _ in range(count)]


def _hand_over[I, R](
    executor: Executor, work: Callable[[I], R], items: Sequence[I], row: _Row, at_work: dict[Future[tuple[list[R], float]], list[int]]
) -> BaseException | None:
    """Fill the window; what the executor says where it takes nothing any more."""
    while row and len(at_work) < row.window:
        numbers = row.draw()
        try:
            at_work[executor.submit(_together, work, [items[number] for number in numbers])] = numbers
        except (BrokenExecutor, RuntimeError, OSError) as error:
            row.again(numbers)
            return error
    return None


def _together[I, R](work: Callable[[I], R], items: Sequence[I]) -> tuple[list[R], float]:
    """Work on some items one after the other, in a worker; what came of each, and the seconds that it took."""
    begun = time.perf_counter()
    return [work(item) for item in items], time.perf_counter() - begun


class GivenBack(Exception):  # noqa: N818 - a word for people, never raised
    """An item was given back by its engine, as dask does where the scheduler is gone."""

    def __str__(self) -> str:
        return "the scheduler gave it back, or is gone"


def in_words(why: BaseException) -> str:
    """What a lost worker is to people."""
    if isinstance(why, BrokenExecutor):
        return "the worker was killed, or ran out of memory"
    name = type(why).__name__
    if name == "KilledWorker":
        return "the workers that tried it were killed, or ran out of memory, or their machines went"
    lines = str(why).strip().splitlines() or [""]
    said = lines[-1] if lines[0].rstrip().endswith(":") else lines[0]
    return f"{name}: {said}" if said else name


def engine_of(word: str, jobs: int | None = None, folder: Path | None = None) -> Engine:
    """The engine that a word names.

    Parameters
    ----------
    word : str
        ``processes``; ``dask``, a cluster on this machine that is started for it; ``dask://HOST:PORT``, a scheduler that is there;
        ``slurm``; ``slurm-trial``, the same jobs on this machine without SLURM.
    jobs : int, optional
        How many are worked on at a time; by default as many as there are processors.
    folder : path, optional
        Where SLURM's jobs leave what they say; the workers must see it.

    Raises
    ------
    UsageError
        No such engine, or fewer than one job.
    InputError
        The package that it needs is not installed, the scheduler does not answer, or there is no SLURM.
    """
    count = jobs if jobs is not None else os.cpu_count() or 1
    if count < 1:
        raise UsageError(f"{count} jobs", where="--jobs", needed="1 or more")
    if word == "processes":
        return Engine("processes", lambda: processes(count), count)
    if word == "dask":
        begin_early(word)
        _package("distributed", "dask")
        return Engine("dask", lambda: _dask_here(count), 2 * count)
    if word.startswith("dask://"):
        _package("distributed", "dask")
        address = f"tcp://{word.removeprefix('dask://')}"
        _refuse_silent(address)
        return Engine(f"dask at {word.removeprefix('dask://')}", lambda: _dask_at(address), 4 * count)
    if word in {"slurm", "slurm-trial"}:
        from lpcal.api import slurm

        _package("submitit", "slurm")
        return slurm.engine(count, folder or Path(), trial=word == "slurm-trial")
    raise UsageError(word, where="--on", needed=WORDS)


def _package(name: str, extra: str) -> ModuleType:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise InputError(f"{name} is not installed", where="--on", needed=f"lpcal[{extra}]", todo=f"uv add 'lpcal[{extra}]'") from error


class Processes(Executor):
    """So many processes of this machine, each a pool of its own: one that is killed takes its own item with it and no other."""

    def __init__(self, count: int) -> None:
        self._count = count
        self._pools: list[tuple[ProcessPoolExecutor, Future[Any]]] = []

    def submit[**P, T](self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Hand a call to a process that is idle; to a new one where there are fewer than there may be; else to the next."""
        self._pools = [(pool, last) for pool, last in self._pools if not (last.done() and _is_broken(last))]
        at = next((k for k, (_, last) in enumerate(self._pools) if last.done()), None)
        if at is not None or len(self._pools) >= self._count:
            pool, _ = self._pools.pop(at or 0)
            try:
                return self._noted(pool, pool.submit(fn, *args, **kwargs))
            except BrokenExecutor:  # killed while it had nothing to do
                pool.shutdown(wait=False)
        with one_thread():
            pool = ProcessPoolExecutor(1, context(), begin_worker)
            return self._noted(pool, pool.submit(fn, *args, **kwargs))

    def _noted[T](self, pool: ProcessPoolExecutor, future: Future[T]) -> Future[T]:
        self._pools.append((pool, future))
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the processes; with `cancel_futures` without their finishing what they are at."""
        for pool, _ in self._pools if cancel_futures else []:
            for process in [*(getattr(pool, "_processes", None) or {}).values()]:
                process.terminate()
        for pool, _ in self._pools:
            pool.shutdown(wait=wait, cancel_futures=cancel_futures)
        self._pools = []


def _is_broken(future: Future[Any]) -> bool:
    return not future.cancelled() and isinstance(future.exception(), BrokenExecutor)


@contextmanager
def processes(count: int) -> Iterator[Executor]:
    """Processes of this machine, which are ended at once where an exception ends the context."""
    pool = Processes(count)
    try:
        yield pool
    except BaseException:
        pool.shutdown(cancel_futures=True)
        raise
    pool.shutdown()


@contextmanager
def _dask_here(count: int) -> Iterator[Executor]:
    """A dask cluster on this machine, reached over loopback alone."""
    distributed: Any = importlib.import_module("distributed")
    dask: Any = importlib.import_module("dask")
    with (
        one_thread(),
        dask.config.set(DASK_LEAN | {"distributed.worker.multiprocessing-method": context().get_start_method()}),
        _preloaded(distributed.utils.get_mp_context()),
        distributed.LocalCluster(
            n_workers=count, threads_per_worker=1, memory_limit=0, dashboard_address="127.0.0.1:0", scheduler_kwargs={"dashboard": False}
        ) as cluster,  # any free port: another cluster may have dask's own
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
def _dask_at(address: str) -> Iterator[Executor]:
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


def _refuse_silent(address: str) -> None:
    """Refuse an address at which no scheduler answers.

    Raises
    ------
    InputError
        It does not answer.
    """
    try:
        with _dask_at(address):
            return
    except (OSError, ValueError) as error:
        raise InputError(
            "no dask scheduler answers", where=address, needed="the address that dask scheduler prints", todo="start one: dask scheduler"
        ) from error
