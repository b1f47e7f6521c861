"""The field of one light at points in space.

Symbols: source s, axis a (unit), point x, distance r = |x - s|, angle t between a and x - s::

    d = (s - x) / r                          unit vector from the point to the light
    E = intensity lobe(t) / r^2              irradiance of a surface that faces it

A distant light has the same d and E everywhere. Source: physics of a point source with an angular lobe; the source is the point from which
the rays appear to diverge, which for LEDs on a dome lies behind them.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lpcal.geometry.arrays import Array


def cosine_lobe(angle_rad: Array, exponent: float) -> Array:
    """cos(angle)^exponent, 0 behind the light."""
    return np.asarray(np.maximum(np.cos(angle_rad), 0.0) ** exponent)


def isotropic_lobe(angle_rad: Array, _exponent: float) -> Array:
    """1 in all directions."""
    return np.ones_like(angle_rad)


type Formula = Callable[[Array, float], Array]
"""Relative intensity (...) at angles (...) rad from the axis, 1 on the axis, with one parameter, the ``exponent`` of the file."""
FORMULAS: dict[str, Formula] = {"isotropic": isotropic_lobe, "cosine": cosine_lobe}
"""Lobes of one parameter by the ``kind`` of the file. To add a kind, add its function here: files, report and fields follow."""
TABLED = ("table", "leds")
"""Kinds of lobe that are stored as a table."""


def table_lobe(angle_rad: Array, knots_rad: Array, value: Array) -> Array:
    """Monotone cubic interpolation of the table, even about the axis, 0 beyond its last angle."""
    at = np.clip(np.abs(angle_rad), knots_rad[0], None)
    k = np.clip(np.searchsorted(knots_rad, at, side="right") - 1, 0, len(knots_rad) - 2)
    step = np.diff(knots_rad)
    slope, chord, x = monotone_slopes(step, value), np.diff(value) / step, at - knots_rad[k]
    bend = (slope[:-1] + slope[1:] - 2 * chord) / step
    found = value[k] + x * (slope[k] + x * ((chord - slope[:-1]) / step - bend)[k] + x * x * (bend / step)[k])
    return np.where(at <= knots_rad[-1], np.maximum(found, 0.0), 0.0)  # rounding may go below a last knot of 0


def monotone_slopes(step: Array, value: Array) -> Array:
    """Slopes (N,) of a monotone cubic (PCHIP) through values (N,) at knots that are `step` (N - 1,) apart.

    At inner knots the weighted harmonic mean of the chords on both sides, 0 where they differ in sign; at the ends that of the parabola
    through three knots, limited to stay monotone. Source: Fritsch and Butland 1984, SIAM J. Scientific and Statistical Computing 5.
    """
    chord = np.diff(value) / step
    if len(chord) == 1:
        return np.repeat(chord, 2)
    before, after = 2 * step[1:] + step[:-1], step[1:] + 2 * step[:-1]
    same = np.sign(chord[:-1]) * np.sign(chord[1:]) > 0
    left, right = (np.where(same, one, 1.0) for one in (chord[:-1], chord[1:]))
    inner = np.where(same, (before + after) / (before / left + after / right), 0.0)
    return np.array([_end_slope(step, chord), *inner, _end_slope(step[::-1], chord[::-1])])


def _end_slope(step: Array, chord: Array) -> float:
    """The slope at the first knot, from the first two chords."""
    slope = float(((2 * step[0] + step[1]) * chord[0] - step[0] * chord[1]) / (step[0] + step[1]))
    if np.sign(slope) != np.sign(chord[0]):
        return 0.0
    if np.sign(chord[0]) != np.sign(chord[1]) and abs(slope) > 3 * abs(chord[0]):
        return 3 * float(chord[0])
    return slope


def near_light(x_C: Array, source_C: Array, axis_C: Array) -> tuple[Array, Array, Array]:
    """d (..., 3), r (...) and angle from the axis (...) at points x_C (..., 3)."""
    to_light = source_C - x_C
    r = np.linalg.norm(to_light, axis=-1)
    d = to_light / r[..., None]
    cosine = -(d @ axis_C)
    sine = np.linalg.norm(np.cross(d, axis_C), axis=-1)
    return d, r, np.arctan2(sine, cosine)
