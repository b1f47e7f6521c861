"""A parser that can crash or hang, run in a process of its own with a bound on its time and memory.

The function is named by its module, takes one path and returns arrays and plain values; it is imported in the child, so that it starts
in a fraction of a second.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from lpcal.errors import InputError

SECONDS = 3.0
"""Seconds of processor time that a parser has for any file."""
SECONDS_A_BYTE = 1e-7
"""Seconds that it has besides, for each byte: ten times what the slowest takes."""
BUSY = 20.0
"""How many times as long it may take by the clock, on a machine that has other things to do."""
OUT_OF_TIME = {-24, -9}
"""What a child returns that the system has ended for its time: SIGXCPU, SIGKILL."""
SPARE_BYTES = 450 << 20
"""Bytes of memory that a parser may take for any file, its libraries counted."""
TIMES_SIZE = 30
"""Bytes of memory that it may take besides, for each byte of the file."""
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
"""Each thread of a library asks for memory of its own, on a large machine for more than the bound."""
CHILD = """
import importlib, os, pickle, sys
module, name, path, most, seconds = sys.argv[1:]
try:
    import resource
    resource.setrlimit(resource.RLIMIT_AS, (int(most), int(most)))
    resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 2))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
except ImportError:
    pass
answer = os.fdopen(os.dup(1), "wb")
os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
try:
    found = (True, getattr(importlib.import_module(module), name)(path))
except BaseException as error:
    found = (False, f"{error}" or type(error).__name__)
answer.write(pickle.dumps(found))
answer.close()
"""


def parse_limited(function: Callable[[str], Any], path: Path, needed: str) -> Any:
    """What a function of a module makes of a file, in a child process.

    Raises
    ------
    InputError
        The parser raised, crashed, ran out of memory or of time.
    """
    size = path.stat().st_size
    seconds = SECONDS + SECONDS_A_BYTE * size
    words = [function.__module__, function.__name__, str(path.resolve()), str(SPARE_BYTES + TIMES_SIZE * size), str(int(seconds))]
    todo = "is it whole? export or copy it again"
    try:
        alone = os.environ | ONE_THREAD
        ended = subprocess.run([sys.executable, "-c", CHILD, *words], capture_output=True, timeout=BUSY * seconds, check=False, env=alone)
    except subprocess.TimeoutExpired as error:
        raise InputError("its parser does not end", where=str(path), needed=needed, todo=todo) from error
    if not ended.stdout:
        found = (
            f"its parser does not end within {seconds:.0f} s of processor time" if ended.returncode in OUT_OF_TIME else "its parser crashes"
        )
        raise InputError(found, where=str(path), needed=needed, todo=todo)
    good, found = pickle.loads(ended.stdout)
    if not good:
        raise InputError(f"cannot be read: {found}", where=str(path), needed=needed, todo=todo)
    return found
