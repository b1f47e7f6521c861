r"""The LightBlob as the sum of its LEDs, averaged over its roll.

Symbols: LEDs of angular lobe cos(t)^m sit on a dome, one on the axis, 6 at an angle `spacing` from it and 12 at twice that; seen from the
dome's centre of curvature the cluster emits::

    lobe(theta) = sum_i cos(angle(direction(theta), axis_i))^m, averaged over the roll, 1 at theta = 0
    m = -ln 2 / ln cos(half of the full half-power angle)

Source: datasheet figures of the LightPanel (19 LEDs, 15 deg, 11.25 deg apart); half-power angle of a cosine-power lobe.
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.kernels.library import kernel

RINGS = {1: (1,), 7: (1, 6), 19: (1, 6, 12)}
SPACING_RAD = float(np.radians(11.25))
HALF_POWER_RAD = float(np.radians(15.0))
"""Full angle between the half-power directions of one LED."""
ROLLS = 60
FEW = 300
"""Largest number of coordinates for which all LEDs are evaluated at once."""


def exponent(full_half_power_rad: float) -> float:
    """Exponent m of a cosine-power lobe from its full half-power angle."""
    return float(-np.log(2) / np.log(np.cos(full_half_power_rad / 2)))


def led_axes(leds: int, spacing_rad: float = SPACING_RAD) -> Array:
    """Axes (n, 3) of the LEDs of a cluster of 1, 7 or 19, in the blob's frame, z its axis."""
    axes = []
    for ring, count in enumerate(RINGS[leds]):
        tilt, roll = ring * spacing_rad, 2 * np.pi * np.arange(count) / count
        axes.append(np.stack([np.sin(tilt) * np.cos(roll), np.sin(tilt) * np.sin(roll), np.full(count, np.cos(tilt))], axis=1))
    return np.concatenate(axes)


def mean_lobe(angle_rad: Array, leds: int) -> Array:
    """Emission (...) at angles from the axis, averaged over the roll, 1 on the axis."""
    m, axes = exponent(HALF_POWER_RAD), led_axes(leds)
    angle = np.append(np.ravel(angle_rad), 0.0)
    roll = np.linspace(0, 2 * np.pi, ROLLS, endpoint=False)
    direction = np.stack(
        [np.outer(np.sin(angle), np.cos(roll)), np.outer(np.sin(angle), np.sin(roll)), np.outer(np.cos(angle), np.ones(ROLLS))], axis=-1
    )
    emission = np.mean(np.sum(np.maximum(direction @ axes.T, 0.0) ** m, axis=-1), axis=1)
    return np.asarray((emission[:-1] / emission[-1]).reshape(np.shape(angle_rad)))


def cluster_field(x: Array, position: Array, axis: Array, power: Array, m: float, *, single: bool = False) -> tuple[Array, Array]:
    """Unit vectors to the light (..., 3) and irradiance (...) of LEDs at points x (..., 3), all in one frame.

    The direction is that of the sum of the LEDs' irradiance vectors; the irradiance is its length. With `single` the sum is in single
    precision: a relative error of 1e-5, in a fifth of the time.
    """
    if run := kernel("cluster_single" if single else "cluster"):
        leds = (np.ascontiguousarray(one, float) for one in (position, axis, power))
        d, E = np.empty(np.shape(x)), np.empty(np.shape(x)[:-1])
        run(E.size, len(position), np.ascontiguousarray(x, float), *leds, m, d, E)
        return d, E
    if np.size(x) <= FEW:
        to_led = position - np.asarray(x)[..., None, :]
        r = np.linalg.norm(to_led, axis=-1)
        lit = np.maximum(-np.sum(to_led * axis, axis=-1) / r, 1e-6)
        total = np.sum(to_led * (power * np.exp(m * np.log(lit)) / r**3)[..., None], axis=-2)
    else:  # one LED at a time: many points times many LEDs do not fit the cache
        total = np.zeros(np.shape(x))
        for place, ahead, strength in zip(position, axis, power, strict=True):
            to_led = place - x
            r2 = np.sum(to_led * to_led, axis=-1)
            r = np.sqrt(r2)
            cosine = -(to_led @ ahead) / r
            lit = np.maximum(cosine, 1e-6)
            total += to_led * (strength * np.exp(m * np.log(lit)) / (r2 * r))[..., None]
    irradiance = np.linalg.norm(total, axis=-1)
    return total / np.maximum(irradiance, 1e-300)[..., None], irradiance


def cluster_slope(x: Array, position: Array, axis: Array, power: Array, m: float) -> Array:
    """Derivative of the LEDs' irradiance vector (..., 3) at points x (..., 3) by the log of their distance from the frame's origin.

    An LED at a, relative to the point, has the vector ``a c^m / r^3`` with ``c = -(a . axis) / r``; moving the point by h changes a by -h,
    so ``log r`` by ``-(a . h) / r^2`` and ``log c`` by ``(h . axis) / -(a . axis) + (a . h) / r^2``; h is x. In single precision.
    """
    if run := kernel("cluster_slope"):
        given = (np.ascontiguousarray(one, float) for one in (x, position, axis, power))
        slope = np.empty(np.shape(x))
        run(slope.size // 3, len(position), *given, m, slope)
        return slope
    slope = np.zeros(np.shape(x))
    for place, along, strength in zip(position, axis, power, strict=True):
        to_led = place - x
        r2 = np.sum(to_led * to_led, axis=-1)
        r, nearer = np.sqrt(r2), np.sum(to_led * x, axis=-1) / r2
        level = -(to_led @ along)
        lit = strength * np.exp(m * np.log(np.maximum(level / r, 1e-6))) / (r2 * r)
        change = lit * (3 * nearer + np.where(level / r > 1e-6, m * ((x @ along) / level + nearer), 0.0))
        slope += to_led * change[..., None] - x * lit[..., None]
    return slope
