"""Numbers in words: a value with its standard deviation, to as many digits as that deserves."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import TypeGuard

from lpcal.records.digits import fine

NOTHING = "–"
MINUS = "−"
SAID = ((" deg\\b", "°"), (", deg\\b", ", °"), ("\\bcm2\\b", "cm²"), (r"(?<=[\s(])-(?=\d)", MINUS))
"""Units as the commands say them in plain letters, and as a page sets them; degrees after a number or a bracket; minus signs."""
HELD = r"(?<=[±≤≥×]) (?=\d)|(?<=[\d)]) (?=[±×]|(?:mm|cm²|px|ms|s|%)(?!\w))|(?<=,) (?=°)|(?<=\d) (?=to \d)|(?<=\bto) (?=\d)"
"""Spaces at which a line may not break: between a number, what compares it or spreads it, and its unit."""


def number(value: float | None, digits: int = 3, unit: str = "") -> str:
    """A number to some significant digits, without an exponent where it can be read without; a dash for none."""
    if not _finite(value):
        return NOTHING
    value = float(value)
    if value == 0:
        text = "0"
    elif 1e-4 <= abs(value) < 1e6:
        text = f"{value:.{max(0, digits - 1 - math.floor(math.log10(abs(value))))}f}"
    else:
        text = f"{value:.{digits - 1}e}"
    return _signed(text) + _unit(unit)


def shown(value: float, digits: int = 3) -> str:
    """A number as a chart's marks have it: to some digits at most, without zeros at its end."""
    return _signed(f"{value:.{digits}g}")


def fixed(value: float | None, decimals: int, unit: str = "") -> str:
    """A number to some decimals; a dash for none."""
    return _signed(f"{float(value):z.{decimals}f}") + _unit(unit) if _finite(value) else NOTHING


def sigma_of(value: float | None, decimals: int, unit: str = "") -> str:
    """A standard deviation with two significant digits at least, some decimals at least; a dash for none."""
    return _signed(fine(float(value), decimals)) + _unit(unit) if _finite(value) else NOTHING


def with_sigma(value: float | None, sigma: float | None, unit: str = "") -> str:
    """``712.41 ± 0.23 px``: the standard deviation to two digits, the value to the same place."""
    if not _finite(value):
        return NOTHING
    if not _finite(sigma) or float(sigma) <= 0:
        return number(value, 5, unit)
    decimals = max(0, 1 - math.floor(math.log10(float(sigma))))
    if decimals > 7:
        return f"{number(value, 5)} ± {number(sigma, 2)}{_unit(unit)}"
    return f"{_signed(f'{float(value):.{decimals}f}')} ± {float(sigma):.{decimals}f}{_unit(unit)}"


def typeset(text: str) -> str:
    """Words as a page sets them: degrees and areas by their signs, no line broken between a number and its sigma or unit."""
    for said, sign in SAID:
        text = re.sub(rf"(?<=[\d)]){said}" if said[0] == " " else said, sign, text)
    return re.sub(HELD, "\N{NO-BREAK SPACE}", text)


def grouped(count: int) -> str:
    """``13 316``: a count in groups of three digits."""
    return f"{count:,}".replace(",", "\N{NARROW NO-BREAK SPACE}")


def plural(count: int, one: str, many: str = "") -> str:
    """``1 light``, ``6 lights``."""
    return f"{count} {one if count == 1 else many or one + 's'}"


def listed(names: Sequence[str]) -> str:
    """``L0, L1 and L2``."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def _finite(value: float | None) -> TypeGuard[float]:
    return value is not None and math.isfinite(value)


def _signed(text: str) -> str:
    return text.replace("-", MINUS)


def _unit(unit: str) -> str:
    return unit and (unit if unit == "°" else f"\N{NO-BREAK SPACE}{unit}")
