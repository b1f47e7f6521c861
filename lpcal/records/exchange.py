"""What goes to other systems and comes from them: a calibration, in parts or whole, a surface, a capture made linear."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Calibration
from lpcal.records.surface import Surface

type Part = Literal["camera", "hand-eye", "lights", "near lights", "surface", "metric surface", "capture"]
"""What a format needs to be written."""


@dataclass(frozen=True)
class LinearImages:
    """A capture made linear, the ambient light taken off: one image a light, as numbers that are proportional to light."""

    name: str
    lights: tuple[str, ...]
    images: Image
    """(L, H, W) or (L, H, W, 3)."""
    mask: Mask | None = None
    """(H, W)."""


@dataclass(frozen=True)
class ExchangeContent:
    """What is written in other systems' formats: `write` of an `ExchangeFormat` gets it.

    Parameters
    ----------
    calibration : Calibration
        A calibration, in parts or whole.
    surface : Surface, optional
        A surface.
    capture : LinearImages, optional
        A capture made linear, the ambient light taken off.
    body : str
        The name of the tracked body.

    Examples
    --------
    >>> import lpcal
    >>> lpcal.extend.ExchangeContent().lacks("lights")
    True
    """

    calibration: Calibration = field(default_factory=lambda: Calibration("rig", ()))
    surface: Surface | None = None
    capture: LinearImages | None = None
    body: str = "panel"
    """The name of the tracked body."""

    def lacks(self, part: Part) -> bool:
        """Whether a part is not there."""
        found = self.calibration
        return {
            "camera": found.camera is None,
            "hand-eye": found.H_PC is None,
            "lights": not found.lights,
            "near lights": not found.lights or any(light.source_C is None for light in found.lights),
            "surface": self.surface is None,
            "metric surface": self.surface is None or not self.surface.metric,
            "capture": self.capture is None,
        }[part]

    def focus_C(self) -> Array | None:
        """The point (3,) in C that directions to near lights are counted from; None where it is not known."""
        return self.calibration.focus_C
