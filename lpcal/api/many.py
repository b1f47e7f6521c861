"""Many captures to surfaces, by any executor of `concurrent.futures`."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from concurrent.futures import Executor
from contextlib import nullcontext
from functools import partial
from typing import Any

from lpcal.api import files
from lpcal.api.engines import WINDOW, Engine, Lost, each, engine_of
from lpcal.api.surfaces import reconstruct
from lpcal.errors import InputError, LpcalError, UsageError
from lpcal.records.calibration import Calibration
from lpcal.records.observations import RawCapture
from lpcal.records.outcome import Progress, silent
from lpcal.records.surface import Surface


def reconstruct_many(
    captures: Iterable[RawCapture | files.PathLike],
    calibration: Calibration,
    *,
    executor: Executor | None = None,
    jobs: int = 1,
    progress: Progress = silent,
    **options: Any,
) -> Iterator[Surface | LpcalError]:
    """Reconstruct many captures; what goes wrong with one is its result and stops no other.

    Parameters
    ----------
    captures : iterable of RawCapture or path
        Captures, or their folders, which are read by the worker.
    calibration : Calibration
        The camera and the lights of all of them.
    executor : concurrent.futures.Executor, optional
        Where they are worked on: a pool of processes, dask's ``client.get_executor(pure=False)``, or any other. It is not shut down.
    jobs : int
        Without an executor: how many processes; 1: one capture after the other, in this one.
    progress : callable, optional
        Called as ``progress("captures", done, total)``.
    options : keywords
        As those of `reconstruct`, for every capture.

    Returns
    -------
    iterator of Surface or LpcalError
        In the captures' order: the surface, or why there is none; an InputError where its worker was lost three times.

    Raises
    ------
    UsageError
        Fewer than one job, or an option that `reconstruct` has not.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> S = np.array([[0.5, 0, -1], [-0.25, 0.45, -1], [-0.25, -0.45, -1]])
    >>> S /= np.linalg.norm(S, axis=1, keepdims=True)
    >>> dome = lpcal.Calibration("dome", tuple(lpcal.Light(f"L{k}", s, np.ones(1)) for k, s in enumerate(S)))
    >>> [str(found).partition(":")[0] for found in lpcal.reconstruct_many(["nothing", "nowhere"], dome)]
    ['nothing', 'nowhere']
    """
    items = list(captures)
    _refuse_options(options)
    work = partial(_attempt, calibration=calibration, options=options)
    if executor is not None:
        engine = Engine("the caller's executor", lambda: nullcontext(executor), WINDOW)
    else:
        engine = engine_of("processes", jobs)
    found = enumerate(map(work, items)) if executor is None and jobs == 1 else each(work, items, engine)
    return _in_order(found, items, progress)


def _in_order(
    found: Iterable[tuple[int, Surface | LpcalError | Lost]], items: list[RawCapture | files.PathLike], progress: Progress
) -> Iterator[Surface | LpcalError]:
    """Results in the order of the captures; those that come early are held."""
    held: dict[int, Surface | LpcalError] = {}
    following = 0
    for done, (number, one) in enumerate(found, start=1):
        held[number] = InputError(one.why, where=_name(items[number]), needed="a worker that lives") if isinstance(one, Lost) else one
        progress("captures", done, len(items))
        while following in held:
            yield held.pop(following)
            following += 1


def _name(capture: RawCapture | files.PathLike) -> str:
    return capture.name if isinstance(capture, RawCapture) else os.fspath(capture)


def _attempt(capture: RawCapture | files.PathLike, calibration: Calibration, options: dict[str, Any]) -> Surface | LpcalError:
    """One capture's surface, or why there is none."""
    try:
        raw = capture if isinstance(capture, RawCapture) else files.read_capture(capture, calibration)
        return reconstruct(raw, calibration, **options)
    except LpcalError as error:
        return error
    except MemoryError:
        return InputError("not enough memory", where=_name(capture), todo="have fewer worked on at a time")
    except OSError as error:
        return InputError(error.strerror or str(error), where=_name(capture))


def _refuse_options(options: dict[str, Any]) -> None:
    from inspect import signature

    own = [name for name in signature(reconstruct).parameters if name not in {"images", "calibration", "lights", "name", "progress"}]
    unknown = [name for name in options if name not in own]
    if unknown:
        raise UsageError(f"no option is called {', '.join(unknown)}", where="reconstruct_many", needed=f"some of {', '.join(own)}")
