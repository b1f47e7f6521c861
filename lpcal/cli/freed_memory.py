"""Memory that is freed is kept for what is asked for next, not given back to the system and asked for again.

By default the C library of Linux maps every larger array anew, and the system clears its pages each time: a seventh of a small capture's
processor time. Elsewhere nothing is changed.
"""

from __future__ import annotations

import os
import sys

MMAP_THRESHOLD = -3, 32 << 20
"""M_MMAP_THRESHOLD, bytes from which an array is mapped by itself: 32 MB, the most that the library takes."""
TRIM_THRESHOLD = -1, 128 << 20
"""M_TRIM_THRESHOLD, bytes at the top that are kept: a small capture's whole working set."""
TOP_PAD = -2, 32 << 20
"""M_TOP_PAD, bytes that are asked for beyond what is needed: with a megabyte a third of the calls to the system would stay."""
ARENA_MAX = -8, 2
"""M_ARENA_MAX, how many heaps threads have between them: with one a thread a small capture held a quarter more."""


def keep() -> None:
    """Keep what is freed, where the C library is glibc and the user has not set it up by its own variables."""
    if not sys.platform.startswith("linux") or any(name.startswith("MALLOC_") for name in os.environ):
        return
    import ctypes

    library = ctypes.CDLL(None)
    if hasattr(library, "gnu_get_libc_version"):
        for parameter, value in (MMAP_THRESHOLD, TRIM_THRESHOLD, TOP_PAD, ARENA_MAX):
            library.mallopt(parameter, value)
