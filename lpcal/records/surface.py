"""A reconstructed surface, pixel by pixel, in C."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.records.figures import ALWAYS, SurfaceFigures
from lpcal.records.placement import Placement
from lpcal.records.sensor import SensorInUse
from lpcal.records.shown import Shown


@dataclass(frozen=True)
class Alternative:
    """Another distance of a component that the images allow, and its odds (0..1); `scale_std` is relative."""

    mean_depth_m: float
    """Mean depth of the piece along z of C."""
    scale_std: float
    """Relative standard deviation of the distance of the whole piece."""
    odds: float
    """That this is the right one, 0 to 1."""


@dataclass(frozen=True)
class Component:
    """One connected piece; `scale_std` is relative, of the distance of the whole piece."""

    label: int
    """The piece's number in the map `component`."""
    pixels: int
    """Count of pixels."""
    mean_depth_m: float
    """Mean depth of the piece along z of C."""
    scale_std: float
    """Relative standard deviation of the distance of the whole piece."""
    alternatives: tuple[Alternative, ...] = field(default=(), metadata=ALWAYS)
    """Other distances that the images allow, with their odds."""


@dataclass(frozen=True)
class SurfaceSummary:
    """What summary.json says of a surface, its maps apart."""

    metric: bool = True
    """Whether depths are metres, else pixels."""
    components: tuple[Component, ...] = ()
    figures: SurfaceFigures = field(default_factory=SurfaceFigures)
    notes: tuple[str, ...] = ()
    times_s: dict[str, float] = field(default_factory=dict)
    """Seconds of each part of the work."""
    peak_memory_mb: float | None = None


@dataclass(frozen=True, repr=False)
class Surface(Shown):
    """Maps (H, W); NaN outside the mask.

    Parameters
    ----------
    name : str
        What it is called.
    normals : ndarray (H, W, 3)
        Unit normals in C, turned towards the camera.
    depth : ndarray (H, W)
        Along z of C, metres; pixels, relative, where there is no camera.
    albedo : ndarray (H, W) or (H, W, 3)
        Relative.
    mask : ndarray (H, W) of bool
        The object's pixels.
    normal_std_deg, depth_std : ndarray (H, W)
        Standard deviations: of the normal in degrees an axis, of the depth's shape in metres.
    lights_used, component : ndarray (H, W) of uint8
        Lights that a pixel rests on; 0 outside, 1.. a connected piece each.
    rays_C : ndarray (H, W, 3)
        Rays of length 1 in z: a point is ``depth * ray``.
    layer : ndarray (H, W) of uint8
        0 outside the mask, 1 the object, 2 what carries it, 3 what stands behind it.
    components : tuple of Component
        The pieces, each with its distance and that distance's relative standard deviation.
    figures : SurfaceFigures
        Residuals and counts.
    breaks : ndarray (2, H, W) of bool
        Whether the surface breaks between a pixel and its neighbour to the right [0], below [1]; also where the mask ends.
    warnings : tuple of str
        Notes on the capture and of what was made of it, in words.
    sensor : SensorInUse, optional
        What the capture was made linear by; None: it was linear already, or there was none.
    placement : Placement, optional
        Where the camera was in the room or in the body that the object rides on; None: not known.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> surface = lpcal.integrate(np.zeros((12, 12, 3)) + [0, 0, -1.0], name="flat")
    >>> surface.mask.sum(), surface.metric, len(surface.components)
    (np.int64(144), False, 1)
    """

    name: str
    normals: Image
    """(H, W, 3) in C, turned towards the camera: n . x < 0."""
    depth: Image
    """Metres along z of C; in pixels, relative, where there is no camera."""
    albedo: Image
    """(H, W) or (H, W, 3), relative."""
    mask: Mask
    normal_std_deg: Image
    """Per axis, everything counted."""
    depth_std: Image
    """Metres, of the shape, scale apart."""
    lights_used: Labels
    """(H, W) count of lights that a normal rests on."""
    component: Labels
    """0 outside, 1.. a connected piece each."""
    rays_C: Array
    """(H, W, 3) of length 1 in z, so that a point is depth * ray; orthographic: (0, 0, 1)."""
    components: tuple[Component, ...] = ()
    figures: SurfaceFigures = field(default_factory=SurfaceFigures)
    """Residuals and counts for summary.json."""
    breaks: Mask = field(default_factory=lambda: np.zeros((2, 0, 0), dtype=bool))
    """(2, H, W) whether the surface breaks between a pixel and its neighbour to the right [0], below [1]; also where the mask ends."""
    layer: Labels = field(default_factory=lambda: np.zeros((0, 0), np.uint8))
    """(H, W): 0 outside the mask, 1 the object, 2 what carries it, 3 what stands behind it; all 1 where they cannot be distinguished."""
    warnings: tuple[str, ...] = ()
    """Notes on the capture and of what was made of it, in words."""
    sensor: SensorInUse | None = None
    """What the capture was made linear by; None: it was linear already, or there was none."""
    placement: Placement | None = None
    """Where the camera was in the room or in the body that the object rides on; None: not known."""

    @property
    def metric(self) -> bool:
        """Whether depths are metres; else, without a camera, they are pixels."""
        return any(row[:, :2].any() for row in self.rays_C)  # a camera's first row says so
