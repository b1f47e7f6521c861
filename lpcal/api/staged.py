"""What every stage does beside its work: a line in the log when it begins and ends, and its findings' warnings there too.

The logger is called ``lpcal``; it says nothing unless a program gives it a handler. The warnings stand on the result as well: a program
reads them there and never parses a log.
"""

from __future__ import annotations

import functools
import logging
import time
from collections.abc import Callable

logger = logging.getLogger("lpcal")
logger.addHandler(logging.NullHandler())


def staged[**P, T](name: str) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """A function that logs, as the stage `name`, its begin, its seconds, and the warnings of its result."""

    def of(function: Callable[P, T]) -> Callable[P, T]:
        @functools.wraps(function)
        def run(*given: P.args, **named: P.kwargs) -> T:
            logger.debug("%s: begins", name)
            begun = time.perf_counter()
            found = function(*given, **named)
            logger.info("%s: done in %.2f s", name, time.perf_counter() - begun)
            for warning in getattr(found, "warnings", ()):
                logger.warning("%s: %s", name, warning)
            return found

        return run

    return of
