"""Words of the command line that say what a board is."""

from __future__ import annotations

import re

from lpcal.errors import UsageError


def corners_of(text: str) -> tuple[int, int]:
    """Counts of inner corners along x and y, of words such as 9x6.

    Raises
    ------
    UsageError
        They are none.
    """
    match = re.fullmatch(r"(\d+)[x,](\d+)", text)
    if not match or min(int(n) for n in match.groups()) < 2:
        raise UsageError(f"--corners {text}", needed="two counts of 2 or more", todo="write for example 9x6")
    return int(match[1]), int(match[2])


def square_of(text: str) -> tuple[float, float]:
    """Sides of a square along x and y, metres, of words such as 25mm.

    Raises
    ------
    UsageError
        No length with its unit, or none above zero.
    """
    from lpcal.records.quantities import parse

    try:
        side = parse(text, "length")
    except ValueError as error:
        raise UsageError(f"--square: {error}", needed="a length with its unit", todo="write for example 25mm") from error
    if side <= 0:
        raise UsageError(f"--square {text}", needed="a length above 0", todo="write for example 25mm")
    return side, side
