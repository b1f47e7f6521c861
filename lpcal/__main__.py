"""``lpcal`` and ``python -m lpcal``: signals are listened for before anything is imported."""

import atexit
import os
import sys

from lpcal.cli.stops import listen, say_stopped


def run() -> int:
    """Run the command line; the exit code is that of the error (docs/errors.md)."""
    try:
        listen()
        from lpcal.cli.main import main

        return main() or leave()
    except KeyboardInterrupt as stop:
        return say_stopped(stop)


def leave() -> int:
    """End the process where all is done, and what is registered for its end too; 0 where whoever reads its streams has gone.

    For the interpreter to take a hundred modules apart takes a tenth of a second.
    """
    try:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()
    except OSError:
        return 0
    atexit._run_exitfuncs()  # noqa: SLF001 - there is no other way to ask for it
    os._exit(0)


if __name__ == "__main__":
    sys.exit(run())
