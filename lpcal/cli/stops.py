"""How a run is ended from outside: SIGINT, SIGTERM and SIGHUP each unwind it as Ctrl-C does, and end it with 128 + their number.

Imports nothing heavy: it is there before anything that could be interrupted.
"""

from __future__ import annotations

import signal
import sys
from types import FrameType

MESSAGE = "lpcal: {}; nothing half-written was kept\n"
WORDS = {"SIGINT": "interrupted", "SIGTERM": "ended by SIGTERM", "SIGHUP": "ended by SIGHUP: the terminal is gone"}
"""The signals that end a run, and how it says so."""


received: list[int] = []
"""The signals that have come; what is raised in a library's C code or in an import may come out of it as another exception."""


class Stopped(KeyboardInterrupt):
    """A signal asks the run to end."""

    def __init__(self, number: int = signal.SIGINT) -> None:
        self.number = number
        super().__init__(signal.Signals(number).name)


def listen() -> None:
    """Turn the signals into `Stopped`; one that is ignored already, as under nohup, stays ignored."""

    def stop(number: int, _: FrameType | None) -> None:
        received.append(number)
        raise Stopped(number)

    for name in WORDS:
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, stop)


def say_stopped(stop: KeyboardInterrupt) -> int:
    """The one message of a run that was ended, on stderr where that is still there; the exit code."""
    number = stop.number if isinstance(stop, Stopped) else int(signal.SIGINT)
    try:
        if sys.stderr is not None:
            sys.stderr.write(MESSAGE.format(WORDS[signal.Signals(number).name]))
            sys.stderr.flush()
    except OSError:  # the terminal is gone
        pass
    return 128 + number
