"""Which wing settings suit a working distance, and what the LightBlobs give there.

Symbols: click g, spacers in d1 and d2, working distance D on the disc axis: ``D = d1 / tan g + d2 / sin g``. A blob of n LEDs of I candela
each shines with its lobe (`led_cluster`) along its axis; at the object, r away, a surface facing it gets ``I_axis lobe / r^2`` lux.
Source: the LightPanel's mechanics and datasheet (35 cd a LED at 20 mA, 15 deg, 11.25 deg apart).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry import led_cluster
from lpcal.geometry.arrays import Array
from lpcal.geometry.wing import d_object, wing_jacobian, wing_transform

CLICKS_RAD = np.radians(np.arange(10, 90, 10))
CANDELA = 35.0


@dataclass(frozen=True)
class WingSetting:
    """A setting, and what it gives over a square of the object's size at the working distance, facing the camera."""

    joint_angle_rad: float
    disc_spacer_m: float
    blob_spacer_m: float
    d_object_m: float
    light_angle_rad: float
    """Between the disc axis and the direction to the light, seen from the object."""
    light_distance_m: float
    lux: float
    """On a surface that faces the light, in the middle."""
    evenness: float
    """Least over most irradiance over the object, on a surface that faces the camera."""
    turn_rad: float
    """By how much the direction to the light turns over the object."""
    direction_std_rad: float
    """What the tolerances leave of the direction, an axis."""


def settings_for(
    distance_m: float,
    lengths_m: tuple[float, float, float],
    spacers_m: Sequence[float],
    setting_sigma: Array,
    *,
    leds: int = 19,
    object_m: float = 0.1,
    slack_m: float = 0.01,
) -> list[WingSetting]:
    """Settings that meet the disc axis within `slack_m` of the distance, the nearest of each click.

    Parameters
    ----------
    lengths_m : disc radius, joint, blob
    spacers_m : lengths that a spacer can have
    setting_sigma : (4,) of azimuth, joint angle (rad), d1, d2 (m)
    object_m : side of the object
    """
    radius, joint, blob = lengths_m
    found = []
    for g in CLICKS_RAD:
        pairs = [(a, b) for a in spacers_m for b in spacers_m]
        reach = np.array([float(d_object(np.array([0.0, g, radius + a + joint, joint + b + blob]))) for a, b in pairs])
        best = int(np.argmin(np.abs(reach - distance_m)))
        if abs(reach[best] - distance_m) <= slack_m:
            a, b = pairs[best]
            setting = np.array([0.0, float(g), radius + a + joint, joint + b + blob])
            found.append(_judged(setting, a, b, float(reach[best]), distance_m, setting_sigma, leds, object_m))
    return found


def _judged(
    setting: Array, a: float, b: float, reach: float, distance_m: float, setting_sigma: Array, leds: int, object_m: float
) -> WingSetting:
    H_DL = wing_transform(setting)
    half = object_m / 2
    square_D = np.stack(np.meshgrid([-half, 0, half], [-half, 0, half]), axis=-1).reshape(-1, 2)
    points_D = np.column_stack([square_D, np.full(9, distance_m)])
    to_light = H_DL[:3, 3] - points_D
    r = np.linalg.norm(to_light, axis=1)
    d = to_light / r[:, None]
    from_axis = np.arccos(np.clip(-d @ H_DL[:3, 2], -1, 1))
    on_axis = CANDELA * float(np.sum(np.maximum(led_cluster.led_axes(leds)[:, 2], 0) ** led_cluster.exponent(led_cluster.HALF_POWER_RAD)))
    facing = on_axis * led_cluster.mean_lobe(from_axis, leds) / r**2
    lit = facing * np.maximum(-d[:, 2], 0.0)
    middle = 4
    p = H_DL[:3, 3]
    moved = np.hstack([-np.array([[0, -p[2], p[1]], [p[2], 0, -p[0]], [-p[1], p[0], 0]]), np.eye(3)]) @ wing_jacobian(setting)
    across = np.eye(3) - np.outer(d[middle], d[middle])
    spread = across @ moved @ np.diag(setting_sigma**2) @ moved.T @ across
    return WingSetting(
        joint_angle_rad=float(setting[1]),
        disc_spacer_m=a,
        blob_spacer_m=b,
        d_object_m=reach,
        light_angle_rad=float(np.arccos(-d[middle, 2])),
        light_distance_m=float(r[middle]),
        lux=float(facing[middle]),
        evenness=float(lit.min() / lit.max()),
        turn_rad=float(np.max(np.arccos(np.clip(d @ d[middle], -1, 1)))),
        direction_std_rad=float(np.sqrt(np.trace(spread) / 2) / r[middle]),
    )
