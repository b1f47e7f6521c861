r"""Refinement of a coarse mask's outline: by a network in pixels of half their size, then scale by scale to full size.

Coarse pixels do not resolve thin parts, small gaps and the outline itself. The network (view.network) takes the log odds of the coarse
pixels (segmentation.background) and brightness-invariant images: lit and ambient brightness, the mean lighting direction of the shading,
and the darkest samples. A total-variation cut turns its log odds into an outline along edges of the image (segmentation.cut). At every
finer scale, pixels beside the outline are reassigned to the side with the nearer signals. Only a margin about the coarse object is
evaluated.
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
"""File of the network's weights, fitted by tools/fit_outline.py."""
SURE = 10.0
"""Bound of the absolute log odds of a coarse pixel."""
MARGIN = 12
"""Margin, in pixels of the network's scale, about the coarse object: nothing farther away is the object."""
DARKEST = 0.01
"""Lower bound of the brightness before its log is taken, as a share of the image's 99th percentile."""
FAINTEST = 1e-3
"""Lower bound of the shading before its log is taken, as a share of the object's, or of the pixel's own."""
LEAN = 0.8
"""Bias of the log odds towards the object: its rim is darker than its interior, and without the bias the mask is too small on average."""
EVIDENT, STIFFNESS = 5.0, 2.0
"""Log odds that count as full evidence in the cut, and the boundary cost per pixel where the image has no edge: the network rounds corners,
which edges restore; from .6 to 3.5 the IoU of simulated scenes hardly changes."""
NOISY, CLEAN = -3.0, 8.0
"""Bounds of the log signal-to-noise ratio."""
DIM, UNSURE = 1.5, 3.0
"""Log signal-to-noise ratio below which almost no light reaches a pixel, and the bound of a coarse pixel's log odds there: an unlit part of
the object and an unlit room differ in the ambient image only."""
MIRRORED = ("leaning x",)
"""Channels whose sign changes in the mirror image."""


@dataclass(frozen=True)
class Apart:
    """A coarse image with the log odds that its pixels are the object."""

    image: Coarse
    table: LightTable
    u: float
    """Natural logarithm of the object's distance in metres."""
    log_odds: Array
    """(rows, columns) log odds that a coarse pixel is the object."""


def drawn(apart: Apart, maps: SignalMaps, rays_C: Array, room: Image | None) -> Mask:
    """The mask (H, W) at full size; `room` (H, W) is the ambient image, None where there is none.

    If the network finds no object pixel, the coarse mask is refined instead.
    """
    factor = scale_of(apart.image.factor)
    here = joined(maps, rays_C, factor)[0]
    said = np.clip((LEAN + log_odds(apart, here, room, factor)) / EVIDENT, -1, 1)
    mask = cut.total_variation(said.astype(np.float32), levels_of(here, None, factor)[0], STIFFNESS)
    return carried(mask, factor, maps, rays_C) if mask.any() else carried(apart.log_odds > 0, apart.image.factor, maps, rays_C)


def carried(mask: Mask, factor: int, maps: SignalMaps, rays_C: Array) -> Mask:
    """A mask of pixels of `factor` at full size (H, W), its outline refined at every scale in between."""
    while True:
        finer = max(1, factor // 2)
        here = joined(maps, rays_C, finer)[0]
        mask = cut.halfway(enlarged(mask, factor / finer, here.signal.shape[1:]), here.signal, here.sigma)
        if finer == 1:
            return mask
        factor = finer


def scale_of(coarse: int) -> int:
    """Binning factor of the network's scale, from that of the coarse pixels."""
    return max(1, coarse // 2)


def log_odds(apart: Apart, here: SignalMaps, room: Image | None, factor: int) -> Array:
    """Log odds (h, w) that pixels of `factor` are the object, from maps (L, h, w): the mean over the image and its mirror image."""
    found, window = channels(apart, here, room, factor)
    said = np.full(here.signal.shape[1:], -SURE)
    said[window] = np.mean(Network.read(FITTED).answers(found), axis=0)[0]
    near = raster.distance_to(resampled(apart.log_odds, apart.image.factor / factor, said.shape) > 0) <= MARGIN
    return np.where(near, said, -SURE)


def channels(apart: Apart, here: SignalMaps, room: Image | None, factor: int) -> tuple[dict[str, Array], tuple[slice, slice]]:
    """The channels (rows, columns) of a window by name, and the window's rows and columns in maps (L, h, w)."""
    shape, by = here.signal.shape[1:], apart.image.factor / factor
    odds = resampled(np.clip(apart.log_odds, -SURE, SURE), by, shape)
    window = _window(odds > 0)
    rows, columns = apart.image.shape
    every = np.arange(rows * columns)
    B = apart.table.at(np.full(len(every), apart.u), every)[0]
    E = np.linalg.norm(B, axis=2)
    leaning = B[..., :2] / np.maximum(E, 1e-12)[..., None]

    def finer(values: Array) -> Array:
        """Values (L, P) of coarse pixels resampled in the window."""
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
        """Values (rows, columns) minus their mean over the object."""
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
    """Bounding box of a mask with MARGIN about it; everything where it is empty."""
    if not mask.any():
        return slice(None), slice(None)
    rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    row, column = (slice(max(int(side[0]) - MARGIN, 0), int(side[-1]) + MARGIN + 1) for side in (rows, columns))
    return row, column


def levels_of(maps: SignalMaps, room: Image | None, factor: int) -> tuple[Image, Image | None]:
    """Log images (h, w) of the brightness of maps of `factor` pixels, and of the ambient image (H, W), if there is one."""
    bright = strength(maps)
    return level(bright, float(np.percentile(bright, 99))), (
        None if room is None else level(raster.block_means(room, factor), float(np.percentile(room, 99)))
    )


def level(picture: npt.NDArray[np.floating], brightest: float) -> Image:
    """The logarithm of an image (H, W), clipped below at DARKEST times `brightest`."""
    return np.asarray(np.log(np.maximum(picture, max(DARKEST * brightest, 1e-12))), np.float32)


def resampled(values: npt.NDArray[np.floating], by: float, shape: tuple[int, ...]) -> Image:
    """Values of pixels `by` times as large, interpolated linearly between their centres, at a shape."""
    import cv2

    grid = np.array([[1 / by, 0, 0.5 / by - 0.5], [0, 1 / by, 0.5 / by - 0.5]])
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    return np.asarray(cv2.warpAffine(values.astype(np.float32), grid, shape[::-1], flags=flags, borderMode=cv2.BORDER_REPLICATE))


def enlarged(mask: Mask, by: float, shape: tuple[int, ...]) -> Mask:
    """A mask of pixels `by` times as large, at a shape."""
    return np.asarray(resampled(mask.astype(np.float32), by, shape) > 0.5)
