r"""The outline of a mask that was found in coarse pixels, found again at every finer scale, in a band about it.

The log odds that a pixel of the band is the object are linear in a few clues: the layers near it on either side (segmentation.layers), the
odds of the coarse pixel that it lies in (segmentation.background), and which side it is like (segmentation.likeness), in the lights'
brightness and in the image without lights: shadows, which the lights' images are full of at an outline, are not in that one. Where no light
reaches, the lights' images count by those odds alone. The weights are fitted by tools/fit_outline.py on simulated scenes; segmentation.cut
finds the outline by the sum.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.segmentation import cut, layers
from lpcal.segmentation.likeness import MOST, level, likeness
from lpcal.view.coarse import Coarse, LightTable, joined
from lpcal.view.sight import Grey, Indices, Sight, look_at, strength

WITH_ROOM = {"": -0.113, "layers": 0.165, "odds": 0.271, "lights": 0.154, "room": 0.324, "odds, dim": 0.721}
"""Weights of a pixel's clues in its log odds where there is an image without lights; "" is the constant. By tools/fit_outline.py."""
WITHOUT_ROOM = {"": -0.152, "layers": 0.132, "odds": 0.25, "lights": 0.159}
"""The same where there is none."""
LEAN = 0.8
"""Log odds added for the object: rims are darker than what they bound, and without it more is missing than too much. From 0 to 0.8 the mean
IoU of 160 simulated scenes rises from .956 to .958, that of rig_a's objects from .978 to .985."""
BAND = 2
"""Pixels of a scale on either side of an outline that the next finer scale judges again."""
DIM = 4
"""Coarse pixels on either side of an outline within which what no light reaches is judged again where there is an image without lights."""
SURE = 3.3
"""Log odds that are full evidence for or against a pixel in the outline."""
STIFFNESS = 0.6
"""Evidence that a unit of outline must be worth where the picture shows no edge."""
DARKEST = 0.01
"""Brightness that is taken for dark, as a share of its 99th percentile in the picture."""


@dataclass(frozen=True)
class Apart:
    """A coarse picture that has been segmented into layers, and which of it is the object."""

    mask: Mask
    """(rows, columns)."""
    labels: Labels
    """(rows, columns)."""
    found: layers.Layers
    image: Coarse
    table: LightTable
    u_free: float
    """Natural logarithm of the object's distance in metres."""
    log_odds: Array
    """(rows, columns) that a coarse pixel is the object."""

    @cached_property
    def near(self) -> tuple[Mask, Mask]:
        """(layers, rows * columns) which layers are near coarse pixels on the object's side of the outline, and on the other."""
        every = range(len(self.found.planes) + 3)
        of_object, of_rest = (
            np.stack([raster.grown(raster.opened(self.labels == k) & side, BAND) for k in every]).reshape(len(every), -1)
            for side in (self.mask, ~self.mask)
        )
        of_object[0], of_rest[0] = True, False
        return of_object, of_rest

    @cached_property
    def dim(self) -> Mask:
        """Coarse pixels (rows, columns) near the outline that no light reaches or that lie in no plane: shadows leave that open."""
        near = raster.grown(self.mask, DIM) & ~raster.shrunk(self.mask, DIM, beyond=True)
        return np.asarray(near & (self.labels > len(self.found.planes)))


@dataclass(frozen=True)
class Level:
    """What is judged at one scale."""

    inside: Mask
    """(h, w) what is the object without being judged."""
    band: Mask
    """(h, w) the N pixels that are judged."""
    clues: dict[str, Array]
    """(N,) each."""
    picture: Image
    """(h, w) logarithm of the lights' brightness."""

    def drawn(self, weights: Mapping[str, float]) -> Mask:
        """The mask (h, w) by weights of the clues."""
        log_odds = LEAN + sum(weights[name] * value for name, value in self.clues.items())
        said = np.where(self.inside, 2.0, -2.0).astype(np.float32)
        said[self.band] = np.clip(log_odds / SURE, -1, 1)
        return cut.total_variation(said, self.picture, STIFFNESS)


def drawn(apart: Apart, maps: Grey, rays_C: Array, room: Image | None) -> Mask:
    """The mask (H, W) in full size; `room` (H, W) is the image without lights, None where there is none."""
    weights = WITHOUT_ROOM if room is None else WITH_ROOM
    mask = apart.mask
    for before, factor in factors(apart.image.factor):
        mask = asked(apart, maps, rays_C, room, mask, before, factor).drawn(weights)
    return cut.halfway(mask, maps.signal, maps.sigma)


def factors(coarse: int) -> Iterator[tuple[int, int]]:
    """Pixels of a pixel of each scale and of the next finer one, from coarse pixels down to 1."""
    while True:
        finer = max(1, coarse // 2)
        yield coarse, finer
        if finer == 1:
            return
        coarse = finer


def asked(apart: Apart, maps: Grey, rays_C: Array, room: Image | None, mask: Mask, before: int, factor: int) -> Level:
    """What is judged at a scale of `factor` pixels, by the mask of the scale of `before` pixels."""
    (here, rays_C), coarse = joined(maps, rays_C, factor), apart.image.factor
    shape = rays_C.shape[:2]
    mask = enlarged(mask, before / factor, shape)
    by = int(np.ceil(BAND * before / factor))
    dim = np.zeros(shape, bool) if room is None else enlarged(apart.dim, coarse / factor, shape)
    inside = raster.shrunk(mask, by, beyond=True)
    band = dim | (raster.grown(mask, by) & ~inside)
    rows, columns = apart.mask.shape
    row, column = np.nonzero(band)
    parent = np.minimum(row * factor // coarse, rows - 1) * columns + np.minimum(column * factor // coarse, columns - 1)
    bright, light = levels_of(here, room, factor)
    pictures = {"lights": bright} if light is None else {"lights": bright, "room": light}
    edge = max(1, by // 2)
    sides = raster.shrunk(mask, edge, beyond=True) & ~dim, ~(raster.grown(mask, edge) | dim)
    like = dict(zip(pictures, likeness(list(pictures.values()), *sides, by, band), strict=True))
    odds, lit = apart.log_odds.ravel()[parent], ~dim[band]
    clues = {
        "": np.ones(len(row)),
        "layers": lit * _by_layers(apart, look_at(here, rays_C, band, central=True), parent),
        "odds": lit * odds,
    }
    clues |= {"lights": lit * like["lights"]}
    if room is not None:
        clues |= {"room": like["room"], "odds, dim": ~lit * odds}
    return Level(inside, band, clues, bright)


def levels_of(maps: Grey, room: Image | None, factor: int) -> tuple[Image, Image | None]:
    """Logarithms (h, w) of the brightness of maps of `factor` pixels, and of the image without lights (H, W), where there is one."""
    bright = strength(maps)
    return (
        level(bright, DARKEST * float(np.percentile(bright, 99))),
        None if room is None else level(np.asarray(raster.block_means(room, factor), np.float32), DARKEST * float(np.percentile(room, 99))),
    )


def _by_layers(apart: Apart, band: Sight, parent: Indices) -> Array:
    """The log likelihood ratio (N,) of pixels of a band, in coarse pixels `parent` (N,), by the layers near them on either side."""
    at = layers.Pixels(band.signal, band.sigma, band.usable, band.rays_C, parent)
    cost = layers.costs(apart.found, at, apart.table, np.full(len(parent), apart.u_free))
    own, rest = (np.where(near[:, parent], cost, np.inf).min(axis=0) for near in apart.near)
    return np.clip((rest - own) / 2, -MOST, MOST)


def enlarged(mask: Mask, by: float, shape: tuple[int, ...]) -> Mask:
    """A mask of pixels `by` times as large, at a shape."""
    import cv2

    grid = np.array([[1 / by, 0, 0.5 / by - 0.5], [0, 1 / by, 0.5 / by - 0.5]])
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    large = cv2.warpAffine(mask.astype(np.float32), grid, shape[::-1], flags=flags, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(large > 0.5)
