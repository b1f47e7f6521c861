"""Memory that commands free is kept for what they ask for next."""

from __future__ import annotations

import os
import platform
import subprocess
import sys

import pytest

PAGES = """
import resource, sys
import numpy as np
from lpcal.cli.freed_memory import keep
if sys.argv[1] == "kept":
    keep()
def fresh():
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt
for _ in range(3):
    held = [np.ones(1 << 20) for _ in range(8)]
    del held
before = fresh()
for _ in range(5):
    held = [np.ones(1 << 20) for _ in range(8)]
    del held
print(fresh() - before)
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="only glibc is asked to keep it")
def test_arrays_that_are_made_again_ask_the_system_for_no_new_pages() -> None:
    def pages(word: str, **more: str) -> int:
        env = {name: value for name, value in os.environ.items() if not name.startswith("MALLOC_")} | more
        return int(subprocess.run([sys.executable, "-c", PAGES, word], env=env, check=True, capture_output=True, text=True).stdout)

    asked_again = pages("given back")
    assert asked_again > 10_000
    assert pages("kept") < asked_again / 20
    assert pages("kept", MALLOC_TRIM_THRESHOLD_="0") > 10_000, "the user's own setting wins"
