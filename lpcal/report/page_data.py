"""What each page's script is given, as JSON: the keys, their types and units, for the writers here and the scripts in templates/.

Lengths are metres, angles radians; lists of numbers stand for arrays, by rows. Maps are packed (report/packing.py) and given as base64.
"""

from __future__ import annotations

from typing import NotRequired, TypedDict

type Point = list[float]
"""Three numbers, or two in the image."""

ItemData = TypedDict(
    "ItemData",
    {
        "kind": str,
        "p": NotRequired[list[Point]],
        "from": NotRequired[Point],
        "by": NotRequired[Point],
        "axes": NotRequired[list[Point]],
        "tone": str,
        "layer": str,
        "text": NotRequired[str],
        "r": NotRequired[float],
        "fill": NotRequired[float],
        "closed": NotRequired[bool],
        "thin": NotRequired[bool],
        "dash": NotRequired[bool],
        "bold": NotRequired[bool],
        "hollow": NotRequired[bool],
    },
)
"""A line, a point, a label, an arrow (from, by) or an ellipsoid (half axes) of a drawing in space; `r` in pixels, `fill` an opacity."""


class LightValues(TypedDict):
    """A light's field over a plane: per cent of its own largest, by rows."""

    name: str
    values: list[int]


class FieldData(TypedDict):
    """The lights' fields over a plane of four corners, `size` cells along a side."""

    size: int
    corners: list[Point]
    lights: list[LightValues]


class SceneData(TypedDict):
    """A drawing in space, its middle and radius, which way is up, and the angles from which it is seen at first."""

    items: list[ItemData]
    centre: Point
    radius: float
    up: Point
    yaw: float
    pitch: float
    field: FieldData | None


class ViewData(TypedDict):
    """A camera's place in the model's frame: a matrix (4, 4); `used` is missing for a stop to come."""

    name: str
    H: list[list[float]]
    used: NotRequired[bool]


ModelData = TypedDict(
    "ModelData",
    {
        "name": str,
        "vertices": int,
        "faces": int,
        "mesh": str,
        "low": Point,
        "span": Point,
        "centre": Point,
        "radius": float,
        "least": float,
        "steps": float,
        "top": int,
        "scale": float,
        "half": tuple[float, float],
        "up": Point,
        "from": Point,
        "views": list[ViewData],
        "next": list[ViewData],
    },
)
"""A model: its mesh, packed over the bounds `low` to `low + span`; sigmas are ``least 2^((byte - 1) / steps)``, `top` the largest byte."""


class RayGrid(TypedDict):
    """Nodes over the picture: pixels of the whole image, and x / z and y / z of their rays."""

    size: int
    px: list[list[Point]]
    ray: list[list[Point]]


class DepthSigma(TypedDict):
    """The code of a depth's sigma in a byte."""

    least: float
    scale: float


class LightData(TypedDict):
    """A calibrated light; a distant one has no source, axis and lobe. `lobe` is its emission at even angles up to `lobeStop`."""

    name: str
    direction: Point
    intensity: Point
    source: Point | None
    axis: Point | None
    lobe: list[float] | None


class BendData(TypedDict):
    """The shape that distant lights would have given: packed planes over a coarse grid, and what their full scale is."""

    solved: bool
    planes: str
    width: int
    height: int
    strength: float
    turn: float
    offset: list[int]
    step: int
    bowl: float


class FullSize(TypedDict):
    """The surface at full size: its bands' rows, and the bits of a normal's coordinate."""

    width: int
    height: int
    step: int
    rows: list[int]
    bits: int


class RelightData(TypedDict):
    """A surface to be lit: packed planes, the codes' scales, the lights, the bend by distant lights, and what the full size is like."""

    name: str
    width: int
    height: int
    channels: int
    planes: str
    depth: list[float]
    perspective: bool
    origin: list[int]
    step: int
    grid: RayGrid
    sigmaScale: float
    depthSigma: DepthSigma
    scales: dict[str, float | None]
    lights: list[LightData]
    lobeStop: float
    bend: BendData | None
    full: FullSize | None


class MarkData(TypedDict):
    """A capture to be marked: its images, and what is already set of its sphere (x, y, radius in pixels), board, lights and mask."""

    folder: str
    images: list[str]
    sphere: str | None
    hint: list[float] | None
    board: bool
    marks: dict[str, list[float]]
    lights: list[str]
    named: dict[str, str]
    mask: bool


class VerdictData(TypedDict):
    """What was said of an image or a sphere: good, fair or poor, and why."""

    tone: str
    words: str


class ImageVerdictData(VerdictData):
    """The same with the image's name."""

    name: str


class WatchData(TypedDict):
    """What a watched folder has so far: counts, the image's cells that boards cover, verdicts, newest first, and what comes next."""

    folder: str
    next: str
    images: int
    boards: int
    covered: float
    cells: list[list[int]]
    spheres: dict[str, VerdictData]
    lacking: dict[str, list[str]]
    seen: list[ImageVerdictData]
    model: list[str]
    waiting: int
    """Images that are not judged yet."""
    put_off: int
    """Images that had to wait until no newer one did."""
    behind_s: float
    """The longest that images had been there of which neither they nor a newer one was judged."""
    longest_wait_s: float
    """The longest that one image waited for its own verdict."""
