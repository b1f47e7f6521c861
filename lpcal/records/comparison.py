"""What has changed between two calibrations of one rig."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from lpcal.geometry.arrays import Array

SEEN_SIGMAS = 3.0
"""Standard deviations of an unmoved light that a change must reach to show: the odds of `UNLIKELY`. A name wants a little more where many
lights and kinds of change are asked."""


@dataclass(frozen=True)
class LeastChange:
    """The smallest changes of one light that would have shown, at `SEEN_SIGMAS`: smaller ones are not excluded by silence.

    Lengths in metres, angles in radians, power relative; NaN where the comparison does not see that kind of change at all.
    """

    moved: float
    """A move of its source in any direction, rms over the axes; of a distant light's direction, as a unit's share."""
    turned_rad: float
    """A turn of its axis of emission."""
    power: float
    moved_L: Array
    """(3,) along its arm, sideways, along its emission."""
    azimuth_rad: float
    """A turn of its wing about the disc's axis, by the move sideways."""
    joint_rad: float
    """A turn of its joint, by the move along its emission."""


@dataclass(frozen=True)
class LightChange:
    """How one light stands against the others, after what all lights share is taken out.

    Lengths in metres, angles in radians; the standard deviation of each is that of a light that has not moved.
    """

    name: str
    """The light's name."""
    moved_C: Array
    """(3,) of its source, or of its direction where it is distant (then a unit's share)."""
    moved: float
    """Length of its own move."""
    moved_std: float
    """Standard deviation of `moved` for a part that has not moved."""
    turned_rad: float
    """Angle by which its axis of emission turned; NaN where it has none."""
    turned_std_rad: float
    """Standard deviation of that angle for a part that has not turned."""
    power: float
    """Relative change of its intensity against the others'."""
    power_std: float
    """Standard deviation of `power` for a light that has not changed."""
    says: tuple[str, ...] = ()
    """What has changed beyond chance: moved, turned, power."""
    moved_L: Array = field(default_factory=lambda: np.full(3, np.nan))
    """(3,) the same in the light's own frame: along its arm, sideways, along its emission. NaN where no spheres of both days say it, or
    the light has no frame."""
    moved_L_std: Array = field(default_factory=lambda: np.full(3, np.nan))
    """(3,) standard deviations of `moved_L`."""
    by_azimuth_rad: float = float("nan")
    """The turn of its wing about the disc's axis, and of its joint, that would move it as far sideways and along its emission."""
    by_joint_rad: float = float("nan")
    """The turn of its joint that would move it as far along its emission."""
    by_azimuth_std_rad: float = float("nan")
    """Standard deviation of `by_azimuth_rad`."""
    by_joint_std_rad: float = float("nan")
    """Standard deviation of `by_joint_rad`."""

    @property
    def least(self) -> LeastChange:
        """The smallest changes that would have shown."""
        return LeastChange(
            SEEN_SIGMAS * self.moved_std,
            SEEN_SIGMAS * self.turned_std_rad,
            SEEN_SIGMAS * self.power_std,
            SEEN_SIGMAS * self.moved_L_std,
            SEEN_SIGMAS * self.by_azimuth_std_rad,
            SEEN_SIGMAS * self.by_joint_std_rad,
        )


@dataclass(frozen=True)
class PartChange:
    """A part of the rig that is one: all lights together, the hand-eye, the camera. NaN where it is not known."""

    moved: float = float("nan")
    """Metres; pixels rms for the camera."""
    moved_std: float = float("nan")
    """Standard deviation of `moved` for a part that has not moved."""
    turned_rad: float = float("nan")
    """Angle by which it turned."""
    turned_std_rad: float = float("nan")
    """Standard deviation of that angle for a part that has not turned."""
    chance: float = float("nan")
    """Probability of so large a change where there is none."""


@dataclass(frozen=True)
class CalibrationChange:
    """Whether a rig has moved between two calibrations.

    Parameters
    ----------
    lights : tuple of LightChange
        The lights that both hold.
    together : PartChange
        What the lights have moved together against the camera; in part it is what the spheres' outlines leave open.
    scale : float
        By how much all distances differ, relative.
    handeye, camera : PartChange
        The camera in the tracked body; the camera's projection, pixels rms over the image, a turn taken out.
    exchanged : tuple of (str, str)
        Lights that stand where the other stood.
    missing : tuple of str
        Lights that only one of the two holds.
    notes : tuple of str
        What could not be compared, and why.
    highlight_px : float
        Scatter of the chrome spheres' highlights, an axis, where the spheres of both days say what has moved; else NaN.
    either : tuple of str
        Lights one of which has moved, where the data do not say which.
    distant : bool
        Whether the lights are distant: what moves is their direction, as a unit's share.

    Examples
    --------
    >>> import lpcal
    >>> rig = lpcal.assemble_calibration(lpcal.design_lights(lpcal.read_rig("lightpanel-6")))
    >>> lpcal.compare_calibrations(rig, rig).changed
    ()
    """

    lights: tuple[LightChange, ...]
    together: PartChange
    scale: float
    handeye: PartChange = PartChange()
    """By how much the hand-eye has changed."""
    camera: PartChange = PartChange()
    """By how much the camera has changed, pixels rms over the image."""
    exchanged: tuple[tuple[str, str], ...] = ()
    missing: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    highlight_px: float = float("nan")
    either: tuple[str, ...] = ()
    distant: bool = False

    @property
    def changed(self) -> tuple[str, ...]:
        """What has changed beyond chance, in words."""
        said = [f"{light.name}: {what}" for light in self.lights for what in light.says]
        said += [f"{' or '.join(self.either)}: moved"] if self.either else []
        said += [f"{one} and {other} stand where the other stood" for one, other in self.exchanged]
        said += [f"{name} is in one of the two only" for name in self.missing]
        for part, words in ((self.handeye, "the camera on the body"), (self.camera, "the camera itself"), (self.together, "all lights")):
            said += [f"{words} changed"] if np.isfinite(part.chance) and part.chance < UNLIKELY else []
        return tuple(said)


UNLIKELY = 0.0027
"""The chance of three standard deviations either way of a normal distribution, under which a change is one."""
