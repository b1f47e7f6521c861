"""What a look at hand-eye data finds before any solve."""

from __future__ import annotations

from dataclasses import dataclass, field

from lpcal.errors import LpcalError
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Carries
from lpcal.records.shown import Shown


@dataclass(frozen=True, kw_only=True)
class CheckFigures:
    """The figures that could be had before something turned out to be wrong; None for the others."""

    mocap_samples: int | None = None
    mocap_lost: int | None = None
    mocap_rate_hz: float | None = None
    dropped: dict[str, int] | None = None
    """Samples that were left out, by the reason."""
    clock_offset_s: float | None = None
    """``t_camera = t_mocap + offset``, as the relative angles show it."""
    clock_offset_width_s: float | None = None
    """Over how many seconds offsets are as good."""
    rotation_spread_deg: Array | None = None
    """(3,) by how much the body turned, rms about three axes."""
    misplaced_m: float | None = None
    """Median distance by which the board misses its place, by the closed form."""
    views_off: tuple[str, ...] | None = None
    carries: Carries | None = None
    expected_sigma_m: float | None = None
    """The position's expected standard deviation in its worst direction."""


@dataclass(frozen=True, repr=False)
class HandEyeCheck(Shown):
    """What was found, what is wrong, and the figures.

    Parameters
    ----------
    notes : tuple of (str, str)
        A topic and what is to be said of it.
    wrong : tuple of LpcalError
        What makes a solve fail or err, each with what to do; empty where nothing is wrong.
    warnings : tuple of str
        What is worth knowing.
    figures : CheckFigures
        The figures.
    """

    notes: tuple[tuple[str, str], ...]
    wrong: tuple[LpcalError, ...] = ()
    warnings: tuple[str, ...] = ()
    figures: CheckFigures = field(default_factory=CheckFigures)
