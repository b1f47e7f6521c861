"""What lights do at points: the calibrated light field."""

from __future__ import annotations

from dataclasses import dataclass

from lpcal.geometry.arrays import Array, Mask
from lpcal.records.shown import Shown


@dataclass(frozen=True, repr=False)
class LightField(Shown):
    """The field of L lights at points (...): row k of the arrays is the light ``names[k]``."""

    names: tuple[str, ...]
    direction_C: Array
    """(L, ..., 3) unit vectors from the points to the lights."""
    irradiance: Array
    """(L, ..., channels) on a surface that faces the light, relative, on one scale for all lights."""
    extrapolated: Mask
    """(L, ...) whether a point lies where no sphere has shown the light."""
    warnings: tuple[str, ...] = ()
    """Lights that are extrapolated, in words."""
