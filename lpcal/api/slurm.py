"""SLURM's jobs as an executor, by submitit: what is handed over within half a second becomes one array of jobs.

Account, partition and time limit are SLURM's own: sbatch takes ``SBATCH_ACCOUNT``, ``SBATCH_PARTITION``, ``SBATCH_TIMELIMIT`` from the
environment.
"""

from __future__ import annotations

import shutil
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from lpcal.api.engines import Engine
from lpcal.api.workers import one_thread
from lpcal.errors import InputError

ARRAY = 1000
"""Jobs of an array, at most: SLURM's own bound, MaxArraySize, is 1001 unless the cluster says otherwise."""
LOOK_S = 0.5
"""Seconds between two looks at the jobs: submitit asks SLURM itself no more than once in many of them."""
MINUTES = 60
"""A job's time limit where ``SBATCH_TIMELIMIT`` says none: a capture of 24 megapixels takes a quarter of it."""
FOLDER = ".lpcal-jobs"
"""Where, below the folder of the surfaces, jobs are described and say what they have to; gone once all went well."""


class Jobs(Executor):
    """A submitit executor as one of `concurrent.futures`."""

    def __init__(self, submitit_executor: Any) -> None:
        self._submitit = submitit_executor
        self._new: list[tuple[Future[Any], Callable[..., Any], tuple[Any, ...], dict[str, Any]]] = []
        self._jobs: list[tuple[Future[Any], Any]] = []
        self._lock = threading.Lock()
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._look, daemon=True)
        self._thread.start()

    def submit[**P, T](self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Have a call made by a job of the next array."""
        future: Future[T] = Future()
        with self._lock:
            self._new.append((future, fn, args, kwargs))
        return future

    def _look(self) -> None:
        while not self._ended.wait(LOOK_S):
            with self._lock:
                new, self._new = self._new, []
            try:
                self._submit(new)
            except Exception as error:  # noqa: BLE001 - whatever refuses the array, each of its futures says so
                for future, *_ in new:
                    if not future.done():
                        future.set_exception(error)
            self._jobs = [(future, job) for future, job in self._jobs if not _settled(future, job)]

    def _submit(self, new: list[tuple[Future[Any], Callable[..., Any], tuple[Any, ...], dict[str, Any]]]) -> None:
        if new:
            with one_thread(), self._submitit.batch():
                jobs = [self._submitit.submit(fn, *args, **kwargs) for _, fn, args, kwargs in new]
            self._jobs += [(future, job) for (future, *_), job in zip(new, jobs, strict=True)]

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Stop looking; with `cancel_futures` end the jobs that are not done."""
        self._ended.set()
        if wait:
            self._thread.join()
        if cancel_futures:
            for _, job in self._jobs:
                job.cancel()


def _settled(future: Future[Any], job: Any) -> bool:
    """Whether a job is done; its future then has what came of it."""
    if not job.done():
        return False
    why = job.exception()
    if why is None:
        future.set_result(job.result())
    else:
        future.set_exception(why)
    return True


def engine(count: int, folder: Path, *, trial: bool) -> Engine:
    """SLURM, or its trial on this machine; `folder` is one that the jobs see too.

    Raises
    ------
    InputError
        There is no SLURM here.
    """
    if not trial and shutil.which("sbatch") is None:
        raise InputError(
            "no sbatch here", where="--on slurm", needed="a machine that submits to SLURM", todo="try it with --on slurm-trial"
        )
    return Engine("SLURM" if not trial else "SLURM's trial", lambda: _jobs(count, folder / FOLDER, trial=trial), count if trial else ARRAY)


@contextmanager
def _jobs(count: int, folder: Path, *, trial: bool) -> Iterator[Executor]:
    import submitit

    chosen = submitit.AutoExecutor(folder=folder.resolve(), cluster="local" if trial else "slurm")
    chosen.update_parameters(timeout_min=MINUTES, name="lpcal", cpus_per_task=1, slurm_array_parallelism=count)
    executor = Jobs(chosen)
    try:
        yield executor
    except BaseException:
        executor.shutdown(cancel_futures=True)
        raise
    executor.shutdown()
    shutil.rmtree(folder, ignore_errors=True)
