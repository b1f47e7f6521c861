r"""The outline of a mask that was found in coarse pixels: judged again in pixels of half their size by a network, then found in full size.

Coarse pixels leave open what is thin, small gaps, and the outline itself. The network (view.network) sees the odds of the coarse pixels
(segmentation.background), and pictures without a scale of brightness: with the lights and without them, which way the shading leans and how
dark the lights leave a pixel. A cut draws the outline by its odds, along edges of the picture (segmentation.cut). From there to full size,
at every finer scale, pixels beside the outline go to the side that they are nearer to. Only places near what the coarse pixels take for the
object are asked.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.segmentation import cut
from lpcal.view.coarse import Coarse, LightTable, joined
from lpcal.view.network import Network
from lpcal.view.pixel_list import SignalMaps, second, strength

FITTED = Path(__file__).with_name("outline_network.npz")
"""Where the network's weights are that tools/fit_outline.py has fitted."""
SURE = 10.0
"""Log odds at most of a coarse pixel."""
MARGIN = 12
"""Pixels of the network's scale about what coarse pixels take for the object that it sees: nothing further away is the object."""
DARKEST = 0.01
"""Brightness that is taken for dark, as a share of its 99th percentile in the picture."""
FAINTEST = 1e-3
"""Shading at least, as a share of the object's, or of that of its pixel."""
LEAN = 0.8
"""Log odds added for the object: its rims are darker than what they bound, and without it more is missing than too much."""
EVIDENT, STIFFNESS = 5.0, 2.0
"""Log odds that are full evidence in the cut, and the evidence that a unit of outline must be worth where the picture shows no edge: the
network rounds corners, which edges of the picture show; from .6 to 3.5 the IoU of simulated scenes hardly changes."""
NOISY, CLEAN = -3.0, 8.0
"""Bounds of the logarithm of a signal over its noise."""
DIM, UNSURE = 1.5, 3.0
"""Logarithm of a signal over its noise under which next to no light reaches a pixel, and the log odds at most of a coarse pixel there: an
unlit part of an object and an unlit room look alike but for the image without lights."""
MIRRORED = ("leaning x",)
"""Channels that change their sign in a mirror."""


@dataclass(frozen=True)
class Apart:
    """A coarse picture of which the odds are known that its pixels are the object."""

    image: Coarse
    table: LightTable
    u: float
    """Natural logarithm of the object's distance in metres."""
    log_odds: Array
    """(rows, columns) that a coarse pixel is the object."""


def drawn(apart: Apart, maps: SignalMaps, rays_C: Array, room: Image | None) -> Mask:
    """The mask (H, W) in full size; `room` (H, W) is the image without lights, None where there is none.

    Where the network sees nothing of the object, it is what the coarse pixels say.
    """
    factor = scale_of(apart.image.factor)
    here = joined(maps, rays_C, factor)[0]
    said = np.clip((LEAN + log_odds(apart, here, room, factor)) / EVIDENT, -1, 1)
    mask = cut.total_variation(said.astype(np.float32), levels_of(here, None, factor)[0], STIFFNESS)
    return carried(mask, factor, maps, rays_C) if mask.any() else carried(apart.log_odds > 0, apart.image.factor, maps, rays_C)


def carried(mask: Mask, factor: int, maps: SignalMaps, rays_C: Array) -> Mask:
    """A mask of pixels of `factor` in full size (H, W), its outline found again at every scale between."""
    while True:
        finer = max(1, factor // 2)
        here = joined(maps, rays_C, finer)[0]
        mask = cut.halfway(enlarged(mask, factor / finer, here.signal.shape[1:]), here.signal, here.sigma)
        if finer == 1:
            return mask
        factor = finer


def scale_of(coarse: int) -> int:
    """Pixels of a pixel that the network judges, by those of a coarse one."""
    return max(1, coarse // 2)


def log_odds(apart: Apart, here: SignalMaps, room: Image | None, factor: int) -> Array:
    """Log odds (h, w) that pixels of `factor` are the object, by maps of them (L, h, w): the mean of a picture's and its mirror image's."""
    found, window = channels(apart, here, room, factor)
    said = np.full(here.signal.shape[1:], -SURE)
    said[window] = np.mean(Network.read(FITTED).answers(found), axis=0)[0]
    near = raster.distance_to(resampled(apart.log_odds, apart.image.factor / factor, said.shape) > 0) <= MARGIN
    return np.where(near, said, -SURE)


def channels(apart: Apart, here: SignalMaps, room: Image | None, factor: int) -> tuple[dict[str, Array], tuple[slice, slice]]:
    """The channels (rows, columns) of a window, and which rows and columns of maps (L, h, w) it is."""
    shape, by = here.signal.shape[1:], apart.image.factor / factor
    odds = resampled(np.clip(apart.log_odds, -SURE, SURE), by, shape)
    window = _window(odds > 0)
    rows, columns = apart.image.shape
    every = np.arange(rows * columns)
    B = apart.table.at(np.full(len(every), apart.u), every)[0]
    E = np.linalg.norm(B, axis=2)
    leaning = B[..., :2] / np.maximum(E, 1e-12)[..., None]

    def finer(values: Array) -> Array:
        """Values (L, P) of coarse pixels in the window."""
        return np.stack([resampled(one.reshape(rows, columns), by, shape)[window] for one in values])

    signal, usable = here.signal[:, *window], here.usable[:, *window]
    shading = np.where(usable, np.maximum(signal, 0), 0) / np.maximum(finer(E), 1e-12)
    total, ordered = np.maximum(shading.sum(axis=0), 1e-12), np.sort(shading, axis=0)
    top = np.maximum(ordered[-2], 1e-12)
    x, y = (np.sum(shading * d, axis=0) / total - d.mean(axis=0) for d in (finer(leaning[..., 0]), finer(leaning[..., 1])))
    noise = np.maximum(np.median(here.sigma[:, *window], axis=0), 1e-12)
    over_noise = np.clip(np.log(np.maximum(second(signal), 1e-12) / noise), NOISY, CLEAN)
    bright, light = levels_of(here, room, factor)
    odds = odds[window]
    weight = 1 / (1 + np.exp(-odds))
    weight /= max(weight.sum(), 1e-12)

    def over_object(values: Array | Image) -> Array:
        """Values (rows, columns) over their mean on the object."""
        return np.asarray(values - np.sum(weight * values), float)

    nothing, faintest = np.zeros(odds.shape), float(np.log(FAINTEST))
    found = {
        "odds": np.where(over_noise < DIM, np.clip(odds, -UNSURE, UNSURE), odds),
        "shading": np.maximum(over_object(np.log(top)), faintest),
        "bright": over_object(bright[window]),
        "room": nothing if light is None else over_object(light[window]),
        "has room": nothing + (light is not None),
        "leaning x": x,
        "leaning y": y,
        "second darkest": np.maximum(np.log(np.maximum(ordered[1], 1e-12) / top), faintest),
        "darkest": np.maximum(np.log(np.maximum(ordered[0], 1e-12) / top), faintest),
        "mean": np.clip(np.log(total / len(shading) / top), faintest, -faintest),
        "over noise": over_noise,
        "blown out": 1 - usable.mean(axis=0),
    }
    return {name: np.asarray(value, float) for name, value in found.items()}, window


def _window(mask: Mask) -> tuple[slice, slice]:
    """Rows and columns that hold a mask, and MARGIN more; all where it is empty."""
    if not mask.any():
        return slice(None), slice(None)
    rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    row, column = (slice(max(int(side[0]) - MARGIN, 0), int(side[-1]) + MARGIN + 1) for side in (rows, columns))
    return row, column


def levels_of(maps: SignalMaps, room: Image | None, factor: int) -> tuple[Image, Image | None]:
    """Logarithms (h, w) of the brightness of maps of `factor` pixels, and of the image without lights (H, W), where there is one."""
    bright = strength(maps)
    return level(bright, float(np.percentile(bright, 99))), (
        None if room is None else level(raster.block_means(room, factor), float(np.percentile(room, 99)))
    )


def level(picture: npt.NDArray[np.floating], brightest: float) -> Image:
    """The logarithm of a picture (H, W), no darker than DARKEST of its brightest."""
    return np.asarray(np.log(np.maximum(picture, max(DARKEST * brightest, 1e-12))), np.float32)


def resampled(values: npt.NDArray[np.floating], by: float, shape: tuple[int, ...]) -> Image:
    """Values of pixels `by` times as large, linear between their middles, at a shape."""
    import cv2

    grid = np.array([[1 / by, 0, 0.5 / by - 0.5], [0, 1 / by, 0.5 / by - 0.5]])
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    return np.asarray(cv2.warpAffine(values.astype(np.float32), grid, shape[::-1], flags=flags, borderMode=cv2.BORDER_REPLICATE))


def enlarged(mask: Mask, by: float, shape: tuple[int, ...]) -> Mask:
    """A mask of pixels `by` times as large, at a shape."""
    return np.asarray(resampled(mask.astype(np.float32), by, shape) > 0.5)
