"""``lpcal`` and ``python -m lpcal``: signals are listened for before anything is imported."""

import sys

from lpcal.cli.stops import listen, say_stopped


def run() -> int:
    """Run the command line; the exit code is that of the error (docs/errors.md)."""
    try:
        listen()
        from lpcal.cli.main import main

        return main()
    except KeyboardInterrupt as stop:
        return say_stopped(stop)


if __name__ == "__main__":
    sys.exit(run())
