r"""A LightBlob: LEDs on a dome, each its own lobe, axis and power.

Symbols: LED k at p_k with axis a_k and power P_k, exponent m, point x, r_k = |p_k - x|, d_k = (p_k - x)/r_k::

    E(x) = sum_k P_k max(-d_k . a_k, 0)^m / r_k^2 d_k       irradiance vector; its length is that of a surface facing the light

The LEDs stand in rings 11.25 degrees apart (1, 6, 12, ...) on a dome whose centre of curvature lies behind the blob's mechanical
centre. Source: the LightPanel's drawing; T. Q. Khanh et al., LED Lighting (2015), for cos^m lobes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

RING_STEP_RAD = np.radians(11.25)
APEX_HEIGHT_M = 0.001
"""How far the dome's apex stands in front of the mechanical centre."""


@dataclass(frozen=True)
class LedLight:
    """One light as really built, in C: LEDs at position_C (n, 3) with axis_C (n, 3) and power (n,)."""

    name: str
    H_CL: Array
    position_C: Array
    axis_C: Array
    power: Array
    exponent: float
    intensity: float
    source_C: Array
    """The point that the rays over the working volume come nearest to."""
    H_DL: Array | None = None
    setting: dict[str, float] | None = None
    """azimuth_deg, joint_angle_deg, d1_m, d2_m as really built."""

    def field(self, x_C: Array) -> Array:
        """Irradiance vectors (N, 3), towards the light, at points x_C (N, 3)."""
        total = np.zeros_like(x_C)
        for position, axis, power in zip(self.position_C, self.axis_C, self.power, strict=True):
            to_led = position - x_C
            r2 = np.sum(to_led**2, axis=1)
            cosine = np.maximum(-(to_led @ axis) / np.sqrt(r2), 0)
            total += (power * cosine**self.exponent / r2**1.5)[:, None] * to_led
        return total


def ring_directions(count: int) -> Array:
    """Unit vectors (count, 3) about z: one in the middle, then rings of 6, 12, 18, ... eleven and a quarter degrees apart."""
    found = [[0.0, 0.0, 1.0]]
    ring = 0
    while len(found) < count:
        ring += 1
        azimuth = np.arange(6 * ring) * 2 * np.pi / (6 * ring)
        polar = ring * RING_STEP_RAD
        found += [[np.sin(polar) * np.cos(a), np.sin(polar) * np.sin(a), np.cos(polar)] for a in azimuth]
    return np.array(found[:count])


@dataclass(frozen=True)
class Blob:
    """How the LEDs of a blob are mounted, and how far they scatter."""

    leds: int
    dome_radius_m: float
    exponent: float
    tilt_rad: float
    power: float


def build_blob(blob: Blob, intensity: float, rng: np.random.Generator) -> tuple[Array, Array, Array]:
    """Positions (n, 3), axes (n, 3) and powers (n,) in L of one blob with its own roll; 1 on its axis at 1 m for intensity 1."""
    direction = se3.rotate(se3.exp(np.array([0, 0, rng.uniform(0, np.pi / 3), 0, 0, 0])), ring_directions(blob.leds))
    position = blob.dome_radius_m * direction + [0, 0, APEX_HEIGHT_M - blob.dome_radius_m]
    tilt = blob.tilt_rad * rng.standard_normal((blob.leds, 3))
    axis = (se3.rotation(tilt) @ direction[..., None])[..., 0]
    power = 1 + blob.power * np.clip(rng.standard_normal(blob.leds), -2.5, 2.5)
    on_axis = float(np.sum(power * np.maximum(axis[:, 2], 0) ** blob.exponent))
    return position, axis, power * intensity / on_axis


def apparent_source(x_C: Array, direction_C: Array) -> Array:
    """The point (3,) nearest to all lines through x_C (N, 3) along unit vectors direction_C (N, 3), by least squares."""
    across = np.eye(3) - direction_C[:, :, None] * direction_C[:, None, :]
    return np.asarray(np.linalg.solve(across.sum(axis=0), (across @ x_C[:, :, None]).sum(axis=0))[:, 0])
