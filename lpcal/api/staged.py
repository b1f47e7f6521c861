"""What every stage does besides its work: a line in the log when it begins and ends, and its findings' warnings there too.

The logger is called ``lpcal``; it says nothing unless a program gives it a handler. The warnings stand on the result as well: a program
reads them there and never parses a log.
"""

from __future__ import annotations

import functools
import logging
import time
from collections.abc import Callable

import numpy as np

from lpcal.errors import DegenerateError

logger = logging.getLogger("lpcal")
logger.addHandler(logging.NullHandler())


def undetermined(error: Exception) -> DegenerateError:
    """What a matrix that cannot be inverted says: the data leave an unknown open which no stage has looked for."""
    return DegenerateError(
        f"the data leave something undetermined: {error}",
        needed="views, lights or motions that differ more",
        todo="run lpcal check, or look at the inputs: are there doubles among them?",
    )


def staged[**P, T](name: str) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """A function that logs, as the stage `name`, its begin, its seconds, and the warnings of its result; singular data are degenerate."""

    def of(function: Callable[P, T]) -> Callable[P, T]:
        @functools.wraps(function)
        def run(*given: P.args, **named: P.kwargs) -> T:
            logger.debug("%s: begins", name)
            begun = time.perf_counter()
            try:
                found = function(*given, **named)
            except np.linalg.LinAlgError as error:
                raise undetermined(error) from error
            logger.info("%s: done in %.2f s", name, time.perf_counter() - begun)
            for warning in getattr(found, "warnings", ()):
                logger.warning("%s: %s", name, warning)
            return found

        return run

    return of
