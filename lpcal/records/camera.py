"""A camera, the solve that found it, and what became of each image in a solve."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from lpcal.geometry import camera as central
from lpcal.geometry import lens_models
from lpcal.geometry.arrays import Array
from lpcal.geometry.tone_curve import Gamma
from lpcal.records.evidence import CameraEvidence
from lpcal.records.sensor import FlatField
from lpcal.records.shown import Shown

COEFFICIENTS = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6")
"""OpenCV's names of the distortion's coefficients, in its order."""
SIZE_DOUBT = 0.25
"""Share of a guessed image size by which images may differ from it: a principal point lies that close to the middle of a real image."""


@dataclass(frozen=True, repr=False)
class Camera(Shown):
    """Intrinsics and radiometry of a camera.

    A splined model has no K and no distortion of its own: K is that of its stereographic core, and `spline` holds mrcal's vector.

    Parameters
    ----------
    image_size : (int, int)
        Width and height in pixels.
    model : str
        The lens model: opencv4, opencv5, opencv8 or splined.
    K : ndarray (3, 3)
        The camera matrix in pixels; pixel centres are at whole numbers.
    distortion : ndarray (4,), (5,) or (8,)
        OpenCV's coefficients.
    black_level : float
        The stored number of no light, as a fraction of full scale.
    white_level : float
        The stored number of saturation, likewise.
    gamma : float or "srgb"
        ``stored = linear^(1/gamma)``.
    flat_field : FlatField, optional
        How lens and sensor weaken light over the image.
    rms_px : float
        Residual of a corner's coordinate, rms, pixels; NaN where the camera was not solved for here.
    parameters : tuple of str
        The parameters that were solved for.
    covariance : ndarray (P, P), optional
        Their covariance, in that order.
    lensmodel : str
        Splined: mrcal's name of the model with its configuration.
    spline : ndarray, optional
        Splined: mrcal's vector, core and knots.
    size_guessed : bool
        Whether the image size was made out from the principal point: images of about that size replace it.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> camera = lpcal.Camera((640, 480), "opencv4", np.array([[600.0, 0, 320], [0, 600, 240], [0, 0, 1]]), np.zeros(4))
    >>> camera.project(np.array([0.1, 0.0, 1.0])).tolist()
    [380.0, 240.0]
    """

    image_size: tuple[int, int]
    model: str
    K: Array
    distortion: Array
    black_level: float = 0.0
    white_level: float = 1.0
    gamma: Gamma = 1.0
    flat_field: FlatField | None = None
    rms_px: float = float("nan")
    """Per coordinate."""
    parameters: tuple[str, ...] = ()
    covariance: Array | None = None
    """(P, P) of `parameters`."""
    lensmodel: str = ""
    """Splined: mrcal's name of the model with its configuration."""
    spline: Array | None = None
    """Splined: mrcal's vector, core and knots."""
    size_guessed: bool = False
    """The image size was made out from the principal point: images of about that size replace it."""

    def __post_init__(self) -> None:
        """Lists are taken as arrays, and the size as a pair of whole numbers."""
        for name in ("K", "distortion"):
            if not isinstance(getattr(self, name), np.ndarray):
                object.__setattr__(self, name, np.asarray(getattr(self, name), dtype=float))
        if not isinstance(self.image_size, tuple):
            object.__setattr__(self, "image_size", tuple(int(side) for side in self.image_size))

    def of_images(self, size: tuple[int, int]) -> Camera:
        """The camera with the images' (width, height) where its own is guessed and theirs is about that; else as it is."""
        near = all(abs(given - own) <= SIZE_DOUBT * own for given, own in zip(size, self.image_size, strict=True))
        return replace(self, image_size=size, size_guessed=False) if self.size_guessed and near else self

    def std_of(self, parameter: str) -> float:
        """The standard deviation of one of `parameters`, such as ``fx``; NaN where it was not solved for."""
        if self.covariance is None or parameter not in self.parameters:
            return float("nan")
        row = self.parameters.index(parameter)
        return float(self.covariance[row, row]) ** 0.5

    def value_of(self, parameter: str) -> float:
        """The value of one of `parameters`, such as ``fx`` or ``k1``; NaN for one that K and the distortion do not hold."""
        core = {"fx": (0, 0), "fy": (1, 1), "cx": (0, 2), "cy": (1, 2)}
        if parameter in core:
            return float(self.K[core[parameter]])
        known = parameter in COEFFICIENTS[: self.distortion.size]
        return float(self.distortion[COEFFICIENTS.index(parameter)]) if known else float("nan")

    def project(self, x_C: Array) -> Array:
        """Pixels (..., 2) of points x_C (..., 3)."""
        if self.spline is not None:
            return lens_models.project(x_C, self.lensmodel, self.spline)
        return central.project(x_C, self.K, self.distortion)

    def unproject(self, pixels: Array) -> Array:
        """Unit rays (..., 3) of pixels (..., 2)."""
        if self.spline is not None:
            return lens_models.unproject(pixels, self.lensmodel, self.spline)
        return central.unproject(pixels, self.K, self.distortion)

    def slopes(self, pixels: Array) -> Array:
        """x / z and y / z (..., 2) of the rays of pixels (..., 2)."""
        if self.spline is None:
            return central.plane_of(pixels, self.K, self.distortion)
        u_C: Array = lens_models.unproject(pixels, self.lensmodel, self.spline)
        return u_C[..., :2] / u_C[..., 2:]

    def projection_jacobian(self, x_C: Array) -> Array:
        """Derivative (..., 2, 3) of `project` by x_C (..., 3)."""
        if self.spline is not None:
            return lens_models.projection_jacobian(x_C, self.lensmodel, self.spline)
        return central.projection_jacobian(x_C, self.K, self.distortion)


@dataclass(frozen=True)
class ViewVerdict:
    """What became of one image in a solve; `why` is None where it was used."""

    image: str
    """The image's name."""
    used: bool
    """Whether the solve rests on it."""
    why: str | None
    """Why it was left out; None where it was used."""
    residual_px: float | None = None
    """Rms of its corners, a coordinate."""
    residual_m: float | None = None
    """By how much the board misses its place."""
    residual_rad: float | None = None
    """By how much the board is turned from its place."""
    corners: int = 0
    """Count of corners found in it."""
    rejected: int = 0
    """Corners that did not fit."""
    blur_px: float | None = None
    """Blur of a board's edges, one sigma."""
    glare: float | None = None
    """Share of a board that is as bright as the image gets."""
    held_out_m: float | None = None
    """What it misses a solve of the other views by."""
    reason: str | None = None
    """`why` without this view's own figures: the same for all views that were left out for it."""


@dataclass(frozen=True, repr=False)
class CameraSolution(Shown):
    """The intrinsics solve: the camera, the board's shape, and what became of each view."""

    camera: Camera
    """The intrinsics with their covariance."""
    points_B: Array
    """(M, 3) corners of the board with its warp, mean plane z = 0."""
    views: tuple[ViewVerdict, ...]
    """What became of each image."""
    solver: str
    """mrcal or opencv, or from where the camera was given."""
    corner_sigma_px: float
    """One standard deviation of a corner coordinate."""
    evidence: CameraEvidence = field(default_factory=CameraEvidence)
    """How the model was chosen and how sure the camera is; empty for a camera that was given."""
    warnings: tuple[str, ...] = ()
    """What to look at, in words."""
    cameramodel: str = ""
    """The text of the .cameramodel file, with the optimisation inputs where mrcal solved."""
    H_CB: dict[str, Array] = field(default_factory=dict)
    """The board in the images that were used, by image, as the solve has it."""
