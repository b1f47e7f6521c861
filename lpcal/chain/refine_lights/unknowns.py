"""What the fits of the lights solve for: the name of each block of parameters, in one place."""

from __future__ import annotations

from enum import StrEnum


class LightUnknown(StrEnum):
    """A block of parameters of `geometry_fit` or `joint_fit`; each has one item a wing, light, sphere, LED mode or kind of sphere."""

    H_CD = "H_CD"
    """(1, 4, 4) the disc in C."""
    SETTING = "setting"
    """(W, 4) azimuth, joint angle (rad), d1, d2 (m) of each wing."""
    OFFSET = "offset"
    """(M, 1) the source on the blob's axis, metres, a LED mode."""
    SOURCE = "source"
    """(F, 3) sources in C of the lights that are no wings, metres."""
    CENTRE = "centre"
    """(S, 3) the spheres' centres in C, metres."""
    BIAS = "bias"
    """(2, 1) radial bias of the outlines of chrome and of matte spheres, pixels."""
    CORE = "core"
    """(1, P) change of the camera's parameters."""
    DOME = "dome"
    """(M, 2) height and radius of the dome that the LEDs sit on, metres, a LED mode."""
    ROLL = "roll"
    """(L, 1) turn of each blob about its axis, radians."""
    INTENSITY = "intensity"
    """(L, 1) log intensities."""
    ALBEDO = "albedo"
    """(S, 1) log albedos of the spheres."""
    DELTA = "delta"
    """(B, 1) log texture of the blocks of pixels."""


def leds_of(mode: int) -> str:
    """The block of a LED mode: (L, 3 n) log power and two tilts (rad) of each of its n LEDs.

    >>> leds_of(7)
    'led7'
    """
    return f"led{mode}"
