"""What one sphere shows on its own: where it is, its outline and highlights, and the directions that they give."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.records.observations import SphereKind


@dataclass(frozen=True)
class SphereFinding:
    """What one sphere shows on its own."""

    name: str
    """The sphere's name."""
    kind: SphereKind
    """A mirror (chrome) or a diffuse ball (matte)."""
    centre_C: Array | None
    """(3,) the sphere's centre in C, metres."""
    radius_m: float | None
    """The sphere's radius."""
    used: bool
    """Whether the solve rests on it."""
    why: str | None
    """Why it was left out; None where it was used."""
    directions_C: dict[str, Array] = field(default_factory=dict)
    """Chrome: unit vector from the sphere's highlight towards each light."""
    residual: float = float("nan")
    """Chrome: highlight rms in px; matte: shading rms as a fraction."""
    outline_px: Array = field(default_factory=lambda: np.zeros((0, 2)))
    """(K, 2) points of the outline as it was found in the images."""
    highlights_px: dict[str, Array] = field(default_factory=dict)
    """Chrome: where (2,) each light's mirror image was found."""
    image_size: tuple[int, int] | None = None
    """Width and height of the sphere's images."""
    outline_sigma_px: float = float("nan")
    """Scatter of the outline's points."""
    highlight_sigma_px: dict[str, float] = field(default_factory=dict)
    """Standard deviation of each highlight, an axis, as stated by the detection."""
