"""The tracked body over a recording, as a report draws it: how far it went, where it was lost, where its pose jumped."""

from __future__ import annotations

from dataclasses import dataclass

from lpcal.geometry.arrays import Array


@dataclass(frozen=True)
class Lapse:
    """A stretch of the recording without a pose to trust, in seconds on the mocap's clock."""

    start_s: float
    end_s: float
    tracked: bool
    """Whether the system gave poses there, which jump from the rest or have a marker error far over the usual: flips."""


@dataclass(frozen=True)
class BodyCourse:
    """Moments of the recording and what lies between. Row n of the arrays is one moment of a trusted pose."""

    t_s: Array
    """(N,) on the mocap's clock."""
    moved_m: Array
    """(N,) from the body's median place."""
    turned_rad: Array
    """(N,) from the attitude of the pose nearest to that place."""
    lapses: tuple[Lapse, ...] = ()
