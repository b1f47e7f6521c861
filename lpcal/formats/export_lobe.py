"""Lobes for other systems: a light's emission over the angle from its axis, and the cosine to a power that stands for it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.formats.light_tables import SHARPEST
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Light

WIDEST_RAD = np.radians(70.0)
"""Angle beyond which no lobe is fitted: objects see no light of a panel or dome from there."""
LOBE_SAMPLES = 91
"""Angles at which a lobe is compared with its cosine: one every half a degree of 45."""
ROLLS = 24
"""Rolls about the axis over which a lobe that is not round is averaged: one every 15 degrees."""
FAINT = 0.1
"""Share of the emission on the axis below which a lobe counts for nothing in the fit: objects are not lit from there."""
SMALLEST_WEIGHT = 1e-3
"""Weight of the axis itself, which has no solid angle."""
FAR_M = 0.35
"""Distance from the source at which the emission of separate LEDs is evaluated, metres: the LightPanel's working distance."""


@dataclass(frozen=True)
class CosineLobe:
    """The cosine lobe that stands for a light's own."""

    exponent: float
    power: float
    """By what the intensity is multiplied."""
    worst: float
    """Largest difference over the angles at which the light is known, as a share of the emission on the axis."""


def round_lobe(light: Light, angle_rad: Array) -> Array:
    """Emission (N,) at angles (N,) from the axis, 1 on the axis, as its mean over the roll."""
    if light.lobe.leds is None or light.lobe.value.size or light.source_C is None or light.axis_C is None:
        return light.lobe(angle_rad)
    axis = light.axis_C / np.linalg.norm(light.axis_C)
    x = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    x /= np.linalg.norm(x)
    y = np.cross(axis, x)
    roll = np.arange(ROLLS) * 2 * np.pi / ROLLS
    across = np.cos(roll)[:, None] * x + np.sin(roll)[:, None] * y
    rays = np.cos(angle_rad)[:, None, None] * axis + np.sin(angle_rad)[:, None, None] * across
    found = light.field(light.source_C + FAR_M * rays)[1].mean(axis=(1, 2))
    on_axis = light.field(light.source_C + FAR_M * axis)[1].mean()
    return np.asarray(found / on_axis)


def cosine_of(light: Light) -> CosineLobe:
    """The cosine lobe nearest to a light's over the angles at which the light is known and not faint."""
    lobe = light.lobe
    if lobe.kind == "isotropic":
        return CosineLobe(0.0, 1.0, 0.0)
    if lobe.kind == "cosine":
        return CosineLobe(lobe.exponent, 1.0, 0.0)
    from scipy.optimize import least_squares

    angle = np.linspace(0.0, WIDEST_RAD if np.isnan(lobe.seen_rad) else min(lobe.seen_rad, WIDEST_RAD), LOBE_SAMPLES)
    value = round_lobe(light, angle)
    angle, value = angle[value > FAINT], value[value > FAINT]
    weight = np.sqrt(np.sin(angle) + SMALLEST_WEIGHT)  # by solid angle

    def misses(unknowns: Array) -> Array:
        return np.asarray(weight * (unknowns[1] * np.cos(angle) ** unknowns[0] - value))

    exponent, power = least_squares(misses, [5.0, 1.0], bounds=([0.0, 0.1], [SHARPEST, 10.0])).x
    return CosineLobe(float(exponent), float(power), float(np.abs(power * np.cos(angle) ** exponent - value).max()))
