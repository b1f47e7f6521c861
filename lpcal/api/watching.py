"""What a new image is worth while one captures: measured at once, without a solve.

An image is measured as it is stored (saturated share and brightest value of a sample of its pixels, blur) and, where it should show the
board, searched for it at no more than `WIDTH` pixels across. What was seen so far determines what is needed next.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from lpcal.detect.board import find_board, glance
from lpcal.errors import LpcalError
from lpcal.geometry.arrays import Array, Image
from lpcal.records.observations import Board, SphereView

WIDTH = 480
"""Pixels across at which the board is looked for: a glance takes some ten milliseconds, a search a tenth of a second."""
CELLS = (5, 4)
"""Cells across and down that corners are counted by: those of the stations that lpcal itself simulates."""
SATURATED = 0.002
"""Share of pixels at full scale from which an image is called saturated: a highlight's, of a chrome sphere, is a tenth of it."""
DIM, BRIGHT = 0.25, 0.995
"""The 99.9th percentile under which an image is dim (two bits are lost), and from which its brightest parts saturate."""
BLURRED = 0.5
"""Share of the median sharpness of the boards before it under which a board is called blurred."""
TILT = 0.06
"""How far, in logarithm, opposite sides of the board differ where it is tilted by some ten degrees or more."""
SMALL_SPHERE_PX = 25.0
"""Radius of an outline, pixels, under which its place is much less sure: the outline's bias grows there."""
BOARDS_WANTED, TILTED_WANTED = 12, 6
"""Boards for the intrinsics, and how many of them tilted: with fewer lpcal warns."""
PLACES = (("top left", "top", "top right"), ("left", "middle", "right"), ("bottom left", "bottom", "bottom right"))
SAMPLED = 250_000
"""Pixels of an image from which its exposure is judged, evenly spread: the share of 0.2 % that counts as saturated is then 500 of them."""
type Tone = Literal["good", "fair", "poor"]
type Exposure = tuple[tuple[str, ...], Tone]
"""What is to be said of an image's exposure, and how bad it is."""
type Stored = npt.NDArray[Any]
"""Pixels (H, W) or (H, W, 3) as stored: 8 or 16 bit, or float of full scale 1."""


@dataclass(frozen=True)
class Seen:
    """One image as it was judged."""

    name: str
    kind: Literal["board", "light", "sphere"]
    tone: Tone
    words: tuple[str, ...]
    corners_share: Array | None = None
    """(N, 2) of the board, as shares of width and height."""
    tilted: bool = False
    sharpness: float = float("nan")


@dataclass(frozen=True)
class Measured:
    """What was measured of an image that should show the board, whatever the others show."""

    words: tuple[str, ...]
    """What is to be said of its exposure."""
    tone: Tone
    why: str = ""
    """Why no board was found."""
    searched: bool = True
    """Whether the board was searched for, beyond a glance."""
    corners_share: Array | None = None
    """(N, 2) of the board, as shares of width and height."""
    sharpness: float = float("nan")


@dataclass
class Watched:
    """What was seen so far."""

    board: Board | None
    lights: tuple[str, ...]
    seen: list[Seen] = field(default_factory=list)
    folders: dict[str, set[str]] = field(default_factory=dict)
    """Light images by the folder that they lie in."""
    counted: Array = field(default_factory=lambda: np.zeros((CELLS[1], CELLS[0])))
    """Corners a cell, rows from the top."""
    spheres: dict[str, Seen] = field(default_factory=dict)
    """What the last look at each sphere said, by the folder of its images."""
    awaited: tuple[str, ...] = ()
    """Folders of the spheres that the rig names."""

    def judge_board(self, name: str, pixels: Stored, *, look: bool = True) -> Seen:
        """An image that should show the board; `look`: whether there is time to search where a glance does not see it."""
        return self.note_board(name, measure_board(pixels, self.board, look=look))

    def note_board(self, name: str, found: Measured) -> Seen:
        """What was measured of an image that should show the board, judged beside those before it."""
        words, tone = found.words, found.tone
        if self.board is None:
            return self._noted(Seen(name, "board", tone, words or ("exposure is right",)))
        if found.corners_share is None:
            return self._noted(Seen(name, "board", "poor" if found.searched else "fair", (*words, found.why)))
        before = [one.sharpness for one in self.seen if np.isfinite(one.sharpness)]
        if len(before) > 2 and found.sharpness < BLURRED * float(np.median(before)):
            words, tone = (*words, "blurred: hold still, or a shorter exposure"), "fair"
        share = found.corners_share
        columns, rows = (np.clip((share[:, k] * CELLS[k]).astype(int), 0, CELLS[k] - 1) for k in (0, 1))
        np.add.at(self.counted, (rows, columns), 1)
        tilted = _tilted(share, self.board.corners)
        return self._noted(Seen(name, "board", tone, (*words, "board found"), share, tilted, found.sharpness))

    def judge_light(self, folder: str, light: str, pixels: Stored, *, chrome: bool = False) -> Seen:
        """An image of a capture; a chrome sphere's may be dark but for its highlight."""
        return self.note_light(folder, light, exposure_words(pixels), chrome=chrome)

    def note_light(self, folder: str, light: str, exposure: Exposure, *, chrome: bool = False) -> Seen:
        """What an image's exposure is, judged as that of a capture's light."""
        self.folders.setdefault(folder, set()).add(light)
        words, tone = exposure
        if chrome and tone == "fair" and words[0].startswith("dim"):
            words, tone = (), "good"
        return self._noted(Seen(f"{folder}/{light}" if folder else light, "light", tone, words or ("exposure is right",)))

    def note_beside(self, name: str, exposure: Exposure) -> Seen:
        """An ambient image or a shorter exposure of a capture: it may be dark, shows no board, and stands for no light."""
        words, tone = exposure
        if not words or words[0].startswith("dim"):
            words, tone = ("exposure is right",), "good"
        return self._noted(Seen(name, "light", tone, words))

    def judge_reading(self, folder: str, words: str, *, well: bool) -> Seen:
        """What the distance sensor read at a capture, in words, and whether that is well."""
        return self._noted(Seen(folder, "light", "good" if well else "fair", (words,)))

    def judge_sphere(self, folder: str, found: SphereView | LpcalError) -> Seen:
        """A capture of a sphere whose lights have all come, as it was found, or why it was not."""
        if isinstance(found, LpcalError):
            seen = Seen(folder, "sphere", "poor", (found.found,))
        else:
            middle, radius = found.outline_px.mean(axis=0), float(np.ptp(found.outline_px, axis=0).mean()) / 2
            words = [f"sphere found at ({middle[0]:.0f}, {middle[1]:.0f}) px, radius {radius:.0f} px"]
            lacking = [light for light in self.lights if light not in found.highlights_px] if found.kind == "chrome" else []
            words += [f"no highlight of {', '.join(lacking)}"] if lacking else []
            words += ["small: nearer to the camera, or a larger one"] if radius < SMALL_SPHERE_PX else []
            seen = Seen(folder, "sphere", "fair" if len(words) > 1 else "good", (*words, *found.notes))
        self.spheres[folder] = seen
        return self._noted(seen)

    def _noted(self, seen: Seen) -> Seen:
        self.seen.append(seen)
        return seen

    @property
    def boards(self) -> list[Seen]:
        """Images in which the board was found."""
        return [one for one in self.seen if one.corners_share is not None]

    @property
    def covered(self) -> float:
        """Share of the image's cells in which corners were found."""
        return float((self.counted > 0).mean())

    def following(self) -> str:
        """What to do next."""
        for folder, found in self.folders.items():
            lacking = [light for light in self.lights if light not in found]
            if lacking:
                return f"{folder or 'the capture'}: {len(lacking)} of {len(self.lights)} lights are lacking, next {lacking[0]}"
        for folder, sphere in self.spheres.items():
            if sphere.tone == "poor":
                return f"{folder} again: {sphere.words[0]}"
        to_come = [folder for folder in self.awaited if folder not in self.folders]
        if self.folders and to_come:
            return f"the next sphere: {to_come[0]}"
        if self.board is None:
            return "every capture has all its lights"
        tilted = sum(one.tilted for one in self.boards)
        if self.covered < 1:
            return f"the board to the {_emptiest(self.counted)} of the image ({100 * self.covered:.0f} % is covered)"
        if tilted < TILTED_WANTED:
            return f"tilt the board: {tilted} of {len(self.boards)} are tilted, {TILTED_WANTED} are wanted"
        if len(self.boards) < BOARDS_WANTED:
            return f"{BOARDS_WANTED - len(self.boards)} boards more"
        return "enough for the intrinsics"


def measure_board(pixels: Stored, board: Board | None, *, look: bool = True) -> Measured:
    """Measure an image that should show the board: its exposure, and the board where it is found.

    Parameters
    ----------
    pixels : ndarray, shape (H, W) or (H, W, 3)
        As stored: 8 or 16 bit, or float of full scale 1.
    board : Board or None
        None: only the exposure is measured.
    look : bool
        Whether there is time to search where a glance does not see the board.
    """
    words, tone = exposure_words(pixels)
    if board is None:
        return Measured(words, tone)
    small = _shrunk(pixels)
    corners_px, why = glance(small, board), "no board at a glance; too many at once to search"
    if corners_px is None and look:
        view = find_board(small, board)
        corners_px, why = view.corners_px, view.why or "no board found"
    if corners_px is None:
        return Measured(words, tone, why, searched=look)
    px = np.asarray(corners_px)
    return Measured(words, tone, "", look, px / [small.shape[1], small.shape[0]], _sharpness(small, px))


def exposure_words(pixels: Stored) -> Exposure:
    """Notes on an image's exposure: by its brightest channel, on a sample of its pixels."""
    step = max(int((pixels.shape[0] * pixels.shape[1] / SAMPLED) ** 0.5), 1)
    sample = pixels[step // 2 :: step, step // 2 :: step]
    bright = (sample if sample.ndim == 2 else sample.max(axis=2)) / np.float32(_full_scale(pixels))
    share, top = float((bright >= BRIGHT).mean()), float(np.quantile(bright, 0.999))
    if share > SATURATED:
        return (f"{100 * share:.1f} % saturated: a shorter exposure",), "poor" if share > 10 * SATURATED else "fair"
    if top < DIM:
        return (f"dim: its brightest is {100 * top:.0f} % of full scale",), "fair"
    return (), "good"


def _full_scale(pixels: Stored) -> float:
    return 1.0 if pixels.dtype.kind == "f" else float(np.iinfo(pixels.dtype).max)


def _shrunk(pixels: Stored) -> Image:
    """Means of blocks and channels as fractions of full scale, no more than `WIDTH` pixels across."""
    import cv2

    step = -(-pixels.shape[1] // WIDTH)
    h, w = (size // step for size in pixels.shape[:2])
    small = cv2.resize(np.ascontiguousarray(pixels[: h * step, : w * step]), (w, h), interpolation=cv2.INTER_AREA)
    grey = small if small.ndim == 2 else small.mean(axis=2)
    return np.asarray(grey / _full_scale(pixels), np.float32)


def _sharpness(grey: Image, corners_px: Array) -> float:
    """The steepest step inside the board's bounds over its contrast, a pixel of the shrunk image."""
    low, high = np.floor(corners_px.min(axis=0)).astype(int), np.ceil(corners_px.max(axis=0)).astype(int) + 1
    inside = grey[max(low[1], 0) : high[1], max(low[0], 0) : high[0]].astype(float)
    contrast = float(np.ptp(np.quantile(inside, [0.05, 0.95])))
    steps = np.abs(np.diff(inside, axis=1)).ravel()
    return float(np.quantile(steps, 0.98)) / max(contrast, 1e-6)


def _tilted(share: Array, corners: tuple[int, int]) -> bool:
    """Whether opposite sides of the board are of clearly unlike length."""
    grid = share.reshape(corners[1], corners[0], 2)
    ends = [(grid[0, 0], grid[0, -1]), (grid[-1, 0], grid[-1, -1]), (grid[0, 0], grid[-1, 0]), (grid[0, -1], grid[-1, -1])]
    top, bottom, left, right = (float(np.linalg.norm(b - a)) for a, b in ends)
    return max(abs(np.log(top / bottom)), abs(np.log(left / right))) > TILT


def _emptiest(counted: Array) -> str:
    """Where the image is least covered, in words."""
    rows, columns = np.nonzero(counted == counted.min())
    far = np.hypot(rows / (CELLS[1] - 1) - 0.5, columns / (CELLS[0] - 1) - 0.5)
    k = int(far.argmax())
    return PLACES[round(2 * rows[k] / (CELLS[1] - 1))][round(2 * columns[k] / (CELLS[0] - 1))]


def lacking(session: Watched) -> dict[str, Sequence[str]]:
    """Lights that each capture lacks."""
    return {folder: [light for light in session.lights if light not in found] for folder, found in session.folders.items()}
