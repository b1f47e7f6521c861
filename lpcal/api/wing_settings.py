"""Which settings of the wings serve a working distance."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal.errors import DegenerateError, InputError
from lpcal.geometry.wing_design import WingSetting, settings_for
from lpcal.records.rig import Tolerance

SPACERS_M = (0.0, 0.005, 0.01, 0.015, 0.02, 0.025, 0.03, 0.035, 0.04, 0.05, 0.06, 0.08, 0.1)
"""Metres: the spacers that are made for the panel."""


def wing_settings(
    distance_m: float,
    *,
    disc_radius_m: float = 0.06,
    joint_m: float = 0.015,
    blob_m: float = 0.03,
    spacers_m: Sequence[float] = SPACERS_M,
    leds: int = 19,
    object_m: float = 0.1,
    slack_m: float = 0.01,
    setting_std: tuple[float, float, float, float] | None = None,
) -> tuple[WingSetting, ...]:
    """List the settings of a wing whose light meets the disc's axis at a working distance, one a click of the joint (10 degrees).

    Parameters
    ----------
    distance_m : float
        Working distance in metres, from the plane of the joints along the disc's axis.
    disc_radius_m : float
        From the disc's axis to its rim, metres.
    joint_m : float
        Half a joint, metres.
    blob_m : float
        From the end of the spacer to the middle of the blob, metres.
    spacers_m : sequence of float
        The lengths that a spacer can have, metres.
    leds : int
        LEDs lit in a blob: 1, 7 or 19.
    object_m : float
        Side of the object, metres: the evenness of the light is judged over it.
    slack_m : float
        How far from the distance the axes may meet, metres.
    setting_std : (float, float, float, float), optional
        Standard deviations of azimuth (rad), joint angle (rad), d1 and d2 (m); by default those of a panel that states none.

    Returns
    -------
    tuple of WingSetting
        Joint angle (rad), spacers and distance (m), angle and distance of the light seen from the object, illuminance (lux), evenness (0
        to 1), by how much the light's direction turns over the object, and the direction's expected standard deviation (rad).

    Raises
    ------
    InputError
        A distance that is not over zero, or another count of LEDs.
    DegenerateError
        No click of the joint and no pair of spacers meets the distance.

    Examples
    --------
    >>> import lpcal, math
    >>> [round(math.degrees(one.joint_angle_rad)) for one in lpcal.wing_settings(0.35)]
    [20, 30, 40]
    """
    if not distance_m > 0:
        raise InputError(f"{distance_m} m", where="distance_m", needed="a length over zero")
    if leds not in (1, 7, 19):
        raise InputError(f"{leds}", where="leds", needed="1, 7 or 19")
    sigma = Tolerance()
    std = np.array(setting_std or (sigma.azimuth, sigma.joint_angle, sigma.length, sigma.length))
    lengths = (disc_radius_m, joint_m, blob_m)
    found = settings_for(distance_m, lengths, sorted(set(spacers_m)), std, leds=leds, object_m=object_m, slack_m=slack_m)
    if not found:
        raise DegenerateError(
            f"no click of the joints meets the axis within {1e3 * slack_m:g} mm of {1e3 * distance_m:g} mm",
            needed="spacers that reach it",
            todo="allow more with --slack (slack_m), or longer --spacers (spacers_m)",
        )
    return tuple(found)
