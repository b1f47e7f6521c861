"""The light of one light at points in space.

Symbols: source s, axis a (unit), point x, distance r = |x - s|, angle t between a and x - s::

    d = (s - x) / r                          unit vector from the point to the light
    E = intensity lobe(t) / r^2              irradiance of a surface that faces it

A distant light has d and E everywhere the same. Source: physics of a point source with an angular lobe; the source is the point that
the rays seem to come from, which for LEDs on a dome lies behind them.
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
"""Relative intensity (...) at angles (...) rad from the axis, 1 on the axis, by one parameter, the ``exponent`` of the file."""
FORMULAS: dict[str, Formula] = {"isotropic": isotropic_lobe, "cosine": cosine_lobe}
"""Lobes of one parameter, by the ``kind`` of the file. Another kind is one more function here: files, report and fields follow it."""
TABLED = ("table", "leds")
"""Kinds of lobe that a table holds."""


def table_lobe(angle_rad: Array, knots_rad: Array, value: Array) -> Array:
    """Cubic through the table (monotone between knots, even about the axis), 0 beyond its last angle."""
    from scipy.interpolate import PchipInterpolator

    found = PchipInterpolator(knots_rad, value, extrapolate=False)(np.clip(np.abs(angle_rad), knots_rad[0], None))
    return np.maximum(np.nan_to_num(np.asarray(found, dtype=float), nan=0.0), 0.0)  # rounding falls below a last knot of 0


def near_light(x_C: Array, source_C: Array, axis_C: Array) -> tuple[Array, Array, Array]:
    """d (..., 3), r (...) and angle from the axis (...) at points x_C (..., 3)."""
    to_light = source_C - x_C
    r = np.linalg.norm(to_light, axis=-1)
    d = to_light / r[..., None]
    cosine = -(d @ axis_C)
    sine = np.linalg.norm(np.cross(d, axis_C), axis=-1)
    return d, r, np.arctan2(sine, cosine)
