"""How many digits an uncertainty is written with: never so few that it reads as zero."""

from __future__ import annotations

import math
from collections.abc import Iterable

MOST_DECIMALS = 6
"""Decimals after which a size is written with an exponent instead: longer numbers are hard to read."""


def fine(size: float, decimals: int = 2) -> str:
    """A sigma or a difference with two significant digits at least, some decimals at least: never 0.00 for what is not zero."""
    if not math.isfinite(size) or size == 0:
        return f"{size:.{decimals}f}"
    needed = max(decimals, 1 - math.floor(math.log10(abs(size))))
    return f"{size:.{needed}f}" if needed <= MOST_DECIMALS + 1 else f"{size:.1e}"


def fine_each(sizes: Iterable[float], decimals: int = 2, between: str = ", ") -> str:
    """Some of them side by side."""
    return between.join(fine(float(size), decimals) for size in sizes)
