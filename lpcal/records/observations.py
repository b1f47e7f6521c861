"""What was seen, before any solve: board corners, pose streams, captures, spheres. Row k of arrays that share a letter is one item."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
import numpy.typing as npt

from lpcal.errors import InputError
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.full_images import FullImages
from lpcal.records.placement import StatedPlace
from lpcal.records.sensor import StatedSensor, ToneClaim
from lpcal.records.shown import Shown

type BoardKind = Literal["chessboard", "charuco", "circles", "aprilgrid"]
"""What a board shows."""
type SphereKind = Literal["chrome", "matte"]
"""What a sphere's surface is: a mirror shows directions, a Lambertian one intensities."""


LARGEST_SQUARE_M = 2.0
"""Metres of the side of the largest square that is believed: boards for cameras on drones have squares of half a metre."""


@dataclass(frozen=True)
class Board:
    """A flat grid of inner corners; ``points_B`` runs along x first.

    Parameters
    ----------
    corners : (int, int)
        Inner corners along x, along y.
    square_m : (float, float) or float
        Size of a square along x, along y, metres.
    warp : bool
        Whether its departure from a plane may be estimated.
    kind : {"chessboard", "charuco"}
        What is printed.
    marker_m : float
        Charuco: side of a marker, metres.
    dictionary : str
        Charuco: OpenCV's name of the markers' dictionary.
    corner_fit : {"edges", "opencv"}
        Where two blurred edges cross, or cornerSubPix, as other tools refine, for figures that compare with theirs.

    Examples
    --------
    >>> import lpcal
    >>> lpcal.Board(corners=(3, 2), square_m=(0.025, 0.025)).points_B()[-1].tolist()
    [0.05, 0.025, 0.0]
    """

    corners: tuple[int, int]
    """Inner corners along x, along y."""
    square_m: tuple[float, float]
    """Square size along x, along y."""
    warp: bool = True
    """Whether its departure from a plane may be estimated."""
    kind: BoardKind = "chessboard"
    marker_m: float = float("nan")
    """Charuco, aprilgrid: side of a marker."""
    dictionary: str = ""
    """Charuco, aprilgrid: OpenCV's name of the markers' dictionary."""
    corner_fit: str = "edges"
    """edges: where two blurred edges cross; opencv: cornerSubPix, as other tools refine, for figures that compare with theirs."""

    def __post_init__(self) -> None:
        """One number for the squares' size stands for both; metres are meant.

        Raises
        ------
        InputError
            Squares larger than any board's.
        """
        if isinstance(self.square_m, int | float):
            object.__setattr__(self, "square_m", (float(self.square_m), float(self.square_m)))
        if not all(0 < side <= LARGEST_SQUARE_M for side in self.square_m):
            found = " x ".join(f"{side:g}" for side in self.square_m)
            needed = f"metres, up to {LARGEST_SQUARE_M:g}"
            raise InputError(
                f"squares of {found} m", where="board, square", needed=needed, todo="write 0.025 for 25 mm (25 mm in panel.yaml)"
            )

    def points_B(self) -> Array:
        """Corners (ny*nx, 3) in B, of a flat board; of an AprilGrid two a tag, the tags a square apart."""
        along = [np.arange(count) * side for count, side in zip(self.corners, self.square_m, strict=True)]
        if self.kind == "aprilgrid":
            along = [
                np.arange(count) // 2 * side + np.arange(count) % 2 * self.marker_m
                for count, side in zip(self.corners, self.square_m, strict=True)
            ]
        x, y = np.meshgrid(*along)
        return np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)


@dataclass(frozen=True)
class BoardView:
    """One image in which a board was looked for."""

    image: str
    """The image's path, relative to the rig folder where it lies in it."""
    corners_px: Array | None
    """Corners (ny*nx, 2), in the order of `Board.points_B`, NaN where a corner was not seen; None: no board."""
    why: str | None = None
    """Why there is no board, in words."""
    blur_px: float = float("nan")
    """Blur of the board's edges, one sigma."""
    glare: float = float("nan")
    """Share of the board that is as bright as the image gets."""


@dataclass(frozen=True, repr=False)
class BoardViews(Shown):
    """All images of one camera in which the board was looked for."""

    image_size: tuple[int, int]
    """Width, height."""
    views: tuple[BoardView, ...]


@dataclass(frozen=True, repr=False)
class BoardPoses(Shown):
    """H_CB of some images, with what their corners say of it."""

    images: tuple[str, ...]
    """The images' names, row by row."""
    t_camera_s: Array | None
    """Times (N,) on the camera's clock; None: no clock."""
    H_CB: Array
    """(N, 4, 4)."""
    corners_px: Array | None = None
    """(N, M, 2) the corners that the poses come from, NaN where not seen; None: poses from elsewhere."""
    points_B: Array | None = None
    """(M, 3) the corners in B, warped as found."""
    covariance: Array | None = None
    """(N, 6, 6) of the left perturbations, the camera taken as exact."""
    rms_px: Array | None = None
    """(N,) residual of the corners, a coordinate."""
    corner_sigma_px: float = float("nan")
    """One standard deviation of a corner coordinate."""
    without: dict[str, str] = field(default_factory=dict)
    """Images that have no pose, and why."""

    def of(self, rows: npt.NDArray[np.intp]) -> BoardPoses:
        """Some of the views."""

        def some(array: Array | None) -> Array | None:
            return None if array is None else array[rows]

        return replace(
            self,
            images=tuple(self.images[row] for row in rows),
            t_camera_s=some(self.t_camera_s),
            H_CB=self.H_CB[rows],
            corners_px=some(self.corners_px),
            covariance=some(self.covariance),
            rms_px=some(self.rms_px),
        )


@dataclass(frozen=True, repr=False)
class PoseStream(Shown):
    """A tracked body: H_OP (N, 4, 4) at times t_s (N,), increasing; lost samples are left out.

    Parameters
    ----------
    body : str
        The body's name.
    t_s : ndarray (N,)
        Seconds on the mocap's clock, increasing.
    H_OP : ndarray (N, 4, 4)
        The body in the room, metres.
    error_m : ndarray (N,)
        The system's own mean marker error, metres; NaN where it gives none.
    markers_O : dict of str to ndarray (N, 3)
        Markers in the room, metres, NaN where not seen; by name without the body's.
    lost : int
        Samples of the file without a pose.
    rate_hz : float
        Samples a second; NaN: `read_mocap` finds it from the times.
    notes : tuple of str
        What the reader had to decide or repair, in words.
    covariance : ndarray (N, 6, 6), optional
        Of the left perturbations, where the poses come from markers; white noise of the markers alone.
    format : str
        The format that the file was recognised as; empty where the poses come from no file.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> stream = lpcal.PoseStream("cart", np.arange(3) / 100, np.tile(np.eye(4), (3, 1, 1)), np.full(3, np.nan), rate_hz=100)
    >>> print(stream)
    PoseStream of cart
      samples     3 at 100 Hz, 0 lost
      time        0.000 to 0.020 s
      moves over  [0.0 0.0 0.0] mm along x, y, z of O
      markers     none
    """

    body: str
    t_s: Array
    H_OP: Array
    error_m: Array
    """(N,) the mocap system's own mean marker error, NaN where it gives none."""
    markers_O: dict[str, Array] = field(default_factory=dict)
    """Marker positions (N, 3) in O, by name without the body's, NaN where not seen."""
    lost: int = 0
    """Samples of the file without a pose."""
    rate_hz: float = float("nan")
    notes: tuple[str, ...] = ()
    """What the reader had to decide or repair, in words."""
    covariance: Array | None = None
    """(N, 6, 6) of the left perturbations, where the poses come from markers; white noise of the markers alone."""
    format: str = ""
    """The format that the file was recognised as; empty where the poses come from no file."""


@dataclass(frozen=True)
class MarkerStream:
    """The markers of one body, x_O (N, M, 3) at times t_s (N,), increasing; NaN where one was not seen. No pose yet.

    Parameters
    ----------
    body : str
        The body's name.
    t_s : ndarray (N,)
        Seconds on the mocap's clock, increasing.
    names : tuple of str
        The markers' names (M,), without the body's.
    x_O : ndarray (N, M, 3)
        The markers in the room, metres; NaN where one was not seen.
    rate_hz : float
        Samples a second; NaN: `read_mocap` finds it from the times.
    notes : tuple of str
        What the reader had to decide or repair, in words.
    format : str
        The format that the file was recognised as; empty where the markers come from no file.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> places = np.array([[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0]])
    >>> stream = lpcal.extend.MarkerStream("cart", np.arange(4) / 100, ("a", "b", "c"), np.tile(places, (4, 1, 1)))
    >>> stream.x_O.shape
    (4, 3, 3)
    """

    body: str
    t_s: Array
    names: tuple[str, ...]
    """(M,) without the body's."""
    x_O: Array
    """(N, M, 3) metres, NaN where a marker was not seen."""
    rate_hz: float = float("nan")
    notes: tuple[str, ...] = ()
    format: str = ""
    """The format that the file was recognised as; empty where the markers come from no file."""


@dataclass(frozen=True, repr=False)
class RawCapture(Shown):
    """A capture folder as stored: numbers as fractions of full scale, not yet linear."""

    name: str
    lights: tuple[str, ...]
    images: Image
    """(L, H, W) or (L, H, W, 3)."""
    exposure_s: Array
    """(L,) exposure times gain; 1 where none is stated."""
    ambient: Image | None
    """(K, H, W[, 3]) images with no light on."""
    ambient_exposure_s: Array
    """(K,)."""
    short: dict[str, Image] = field(default_factory=dict)
    """Shorter exposures by light, (H, W[, 3])."""
    short_exposure_s: dict[str, float | None] = field(default_factory=dict)
    """Their exposure times gain; None where it is not stated."""
    mask: Mask | None = None
    """(H, W), as given by the user."""
    left_out: tuple[str, ...] = ()
    """Images of the folder that are no light's."""
    step: float = 1 / 255
    """One step of the stored numbers, as a fraction of full scale."""
    sensor: StatedSensor = field(default_factory=StatedSensor)
    """What capture.yaml says of the sensor, but for the flat field, which is fitted to `flat`."""
    flat: Image | None = None
    """(H, W[, 3]) of an evenly lit target, where capture.yaml names one."""
    claim: ToneClaim | None = None
    """What the lights' images say of their tone curve."""
    white_level: float | None = None
    """Where the sensor saturates, as the numbers themselves show it."""
    distance_m: float | None = None
    """The panel's distance from the object, as capture.yaml says it."""
    place: StatedPlace = field(default_factory=StatedPlace)
    """Where and when it was taken, as capture.yaml says it."""
    arrangement_stated: bool = False
    """Whether capture.yaml says that the images are as their names say, whatever they themselves show."""
    notes: tuple[str, ...] = ()
    """What was made of the files, in words."""
    full: FullImages | None = None
    """The images in full size, where they are too large to be held: all arrays above are then in coarse pixels."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the images in full size, pixels."""
        height, width = self.images.shape[1:3] if self.full is None else self.full.size
        return width, height


@dataclass(frozen=True)
class Radiance:
    """A capture made linear: proportional to the light that reached a pixel from one light alone."""

    name: str
    lights: tuple[str, ...]
    signal: Image
    """(L, H, W[, 3]) a unit of exposure, ambient taken away."""
    sigma: Image
    """(L, H, W[, 3]) one standard deviation of the signal's noise."""
    saturated: Mask
    """(L, H, W) whether any channel is at or over the white level: its signal is a lower bound."""
    ambient: Image
    """(H, W[, 3]) a unit of exposure; zero where there is no ambient image."""
    short: dict[str, Image] = field(default_factory=dict)
    """(H, W[, 3]) the shorter exposures, linear, ambient taken away; scaled only where their exposure is stated."""
    mask: Mask | None = None
    notes: tuple[str, ...] = ()
    dark: tuple[str, ...] = ()
    """Lights that lift nothing over its noise."""

    def of(self, lights: Sequence[str]) -> Radiance:
        """Some of the lights."""
        rows = [self.lights.index(light) for light in lights]
        short = {light: image for light, image in self.short.items() if light in lights}
        return replace(
            self, lights=tuple(lights), signal=self.signal[rows], sigma=self.sigma[rows], saturated=self.saturated[rows], short=short
        )


@dataclass(frozen=True, repr=False)
class SphereView(Shown):
    """What the images of one sphere show."""

    name: str
    kind: SphereKind
    radius_m: float
    outline_px: Array
    """(K, 2) points of its outline, at sub-pixel."""
    outline_sigma_px: float
    highlights_px: dict[str, Array] = field(default_factory=dict)
    """Chrome: centroid (2,) of each light's mirror image."""
    highlight_sigma_px: dict[str, float] = field(default_factory=dict)
    shading: Radiance | None = None
    """Matte: the linear images."""
    notes: tuple[str, ...] = ()
    """What of it could not be used, in words."""
    image_size: tuple[int, int] | None = None
    """Width and height of its images, pixels."""
