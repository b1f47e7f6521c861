"""Counts and residuals of a reconstructed surface, as they stand under ``counts_and_residuals`` in summary.json."""

from __future__ import annotations

from dataclasses import dataclass, field

ALWAYS = {"always": True}
"""Metadata of a field that stands in the file also where it is None, as null."""


@dataclass(frozen=True, kw_only=True)
class GlossFound:
    """Strength and roughness of the gloss, and the share of the robust cost that is left with it."""

    ks: float
    """Strength of the gloss against the diffuse part."""
    roughness: float
    """Width of the gloss, as the slope of its facets."""
    gain: float
    """Share of the robust cost that is left with it."""


@dataclass(frozen=True, kw_only=True)
class AmbientFound:
    """What became of the room's light where there is no image of it."""

    estimated: bool
    """Whether it was estimated and taken away."""
    note: str | None = None
    """What was made of it, in words."""
    share_of_signal: float | None = None
    """The room's light over all light, the median pixel."""
    relative_std: float | None = None
    """The estimate's own, of its size."""
    law: tuple[float, ...] | None = None
    """Coefficients of the room's light over the normal."""


@dataclass(frozen=True)
class Curl:
    """What the curl of a normal map says of its convention."""

    likeness: float
    """Correlation of the slopes' changes: 1 for a surface, -1 for one upside down."""
    sure: float
    """The likeness by its standard error."""
    twist_sure: float
    """The twist by its standard error."""
    median: float
    """Median size of the curl, a pixel."""


@dataclass(frozen=True, kw_only=True)
class ConventionFound:
    """Whether the green channel of a normal map was turned over, and what its curl is both ways."""

    green_turned_over: bool
    """Whether the map is read with its green channel turned over."""
    curl_as_is: Curl
    """The curl of the map as it is stored."""
    curl_turned_over: Curl
    """The curl with its green channel turned over."""


@dataclass(frozen=True, kw_only=True)
class Flatness:
    """How far a nearly flat piece deviates from a plane, mm."""

    bowl_mm: float
    plane_rms_mm: float
    plane_peak_to_valley_mm: float
    extent_mm: float


@dataclass(frozen=True, kw_only=True)
class DistanceRead:
    """What the panel's distance sensor read at a capture, and what it did to the distance of the piece that its beam meets."""

    reading_m: float
    """What the sensor read."""
    expected_m: float
    """What it would read of the piece as the light alone has it; NaN where the beam meets none."""
    hit: float
    """Odds that the reading is of that piece: it may be of the wall behind."""
    moved: float
    """By how much the piece was moved, relative."""


@dataclass(frozen=True, kw_only=True)
class SurfaceFigures:
    """Counts and residuals; None where a figure does not apply."""

    mask: str | None = None
    """How the mask was found, in words."""
    mask_doubt: float | None = None
    """Odds that the automatic mask is wrong by more than a tenth of its area."""
    mask_doubt_why: str | None = None
    """What the doubtful area may be, and where it is, in words."""
    intensities_found: dict[str, float] | None = None
    """The lights' intensities over those of the calibration, where they were not measured."""
    images_exchanged: dict[str, str] | None = None
    """Images that fit another light than their own, and which."""
    pixels: int = 0
    """Count of pixels of the surface."""
    pixels_with_three_lights: int | None = None
    """Count of pixels that three lights or more reach."""
    median_lights_used: float | None = None
    """Median over the pixels of how many lights were used."""
    gloss: GlossFound | None = field(default=None, metadata=ALWAYS)
    """Strength and roughness of the object's gloss; null where none was found."""
    reflectance: float | None = field(default=None, metadata=ALWAYS)
    """Reflectance of the object's median pixel, as interreflected light shows it."""
    residual_sigmas_rms: float | None = None
    """Rms residual of the images in their own standard deviations: 1 where the noise model holds."""
    normals_away_from_the_camera: float | None = None
    """Share of a normal map's pixels that look away from the camera."""
    ambient: AmbientFound | None = None
    """What became of the room's light where there is no image of it."""
    distance_reading: DistanceRead | None = None
    """What the panel's distance sensor read, and what it did."""
    convention: ConventionFound | None = None
    """How a normal map from elsewhere was read."""
