"""``lpcal`` and ``python -m lpcal``: nothing is imported before Ctrl-C is caught."""

import sys

INTERRUPTED = 130


def run() -> int:
    """Run the command line; the exit code is the contract's."""
    try:
        from lpcal.cli.main import main

        return main()
    except KeyboardInterrupt:
        sys.stderr.write("lpcal: interrupted; nothing half-written was kept\n")
        return INTERRUPTED


if __name__ == "__main__":
    sys.exit(run())
