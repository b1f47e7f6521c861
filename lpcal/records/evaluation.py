"""How far a surface is from the truth."""

from __future__ import annotations

from dataclasses import dataclass

from lpcal.geometry.arrays import Image
from lpcal.records.shown import Shown


@dataclass(frozen=True, repr=False)
class Evaluation(Shown):
    """Differences of a surface from the truth, over the pixels that both hold."""

    name: str
    """The surface's name."""
    pixels: int
    """Pixels that are compared."""
    normal_mean_deg: float
    """Mean angle to the true normals."""
    normal_median_deg: float
    """Median angle to the true normals."""
    normal_p95_deg: float
    """95th percentile of the angles."""
    depth_rms_m: float
    """Depth error of the shape, each piece scaled to the truth's median first (shifted, of parallel rays). NaN without a true depth."""
    depth_absolute_rms_m: float
    """Nothing scaled. NaN without a true depth."""
    scale: float
    """True depth over depth of the largest piece, the median; 1 is right. NaN without a true depth."""
    mask_iou: float
    """Pixels that both masks hold, over those that either holds. NaN where the truth has no mask."""
    angle_deg: Image
    """(H, W) the angle between the normals; NaN where nothing is compared."""
    metric: bool
    """Whether depths are metres; else they are pixels."""
    normal_z_rms: float
    """Rms of the angles over what the surface's own sigmas predict; 1 is right, NaN without sigmas."""
