r"""The context in which a coarse pixel is judged, and which side of an outline a pixel is like.

What no light reaches, and what paint or a shadow has joined to a wrong region, shows itself in its context: its region's odds, what lies
about it, what it is made of, where it lies. No clue needs a scale: odds, natural logarithms, costs of the labels, shares of the picture,
distances in radii of the likely object. Likeness is the log likelihood ratio of a picture's value (a logarithm l of brightness) among those
about it on either side, by their mean m and variance v in a Gaussian window::

    c_side = (l - m)^2 / (v + TEXTURE^2) + log(v + TEXTURE^2)        likeness = (c_outside - c_inside) / 2

Where a side has hardly a share of the window, it is that of the nearest place which has.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.segmentation.regions import SPARED, Pictures, Regions, log_depth
from lpcal.view import bands

TEXTURE = 0.1
"""Standard deviation of the logarithm of brightness on one material, besides what its neighbourhood shows: paint, folds, shadows."""
KNOWN = 0.02
"""Share of a window that must lie on a side for its mean to stand for the side there; else that of the nearest place does."""
MOST = 10.0
"""Log likelihood ratio at most: a single pixel does not decide."""
ABOUT_PX = (1.5, 3.0, 6.0)
"""Standard deviations, in coarse pixels, of the neighbourhoods whose odds a pixel is compared with."""
LIKE_PX = (3.0, 5.0, 12.0)
"""The same of the windows in which a pixel is compared with the object and with the rest: by the image without lights, by the lights', and
widely by the image without lights."""
MISFIT = 60.0
"""Cost of matter of any normal at most, so that a few wild pixels do not decide."""
APART = 1.0
"""Natural logarithm of a ratio of depths at most between a pixel and the likely object."""


def clues_of(odds: Array, logit: Array, pictures: Pictures, found: Regions, bright: Image, room: Image | None) -> dict[str, Array] | None:
    """The clues (P,) of coarse pixels by their regions' odds and log odds (rows, columns); None where all is on one side.

    `bright` and `room` (rows, columns) are the logarithms of the lights' brightness and of the image without lights, where there is one.
    """
    inside: Mask = odds > 0.5
    if not inside.any() or inside.all():
        return None
    everywhere = np.ones(odds.shape, bool)
    close, plain, wide = LIKE_PX

    def like(picture: Image | None, by: float) -> Array:
        return np.zeros(odds.size) if picture is None else likeness([picture], inside, ~inside, by, everywhere)[0]

    about, widely, around = (raster.blurred(odds, by) for by in ABOUT_PX)
    clues = {
        "odds": logit,
        "about": about - 0.5,
        "widely about": widely,
        "all around": around,
        "lights": like(bright, plain),
        "room": like(room, close),
        "room, widely": like(room, wide),
    }
    clues |= _made_of(pictures, found) | _where(odds, inside, log_depth(pictures, found))
    return {name: np.asarray(values, float).ravel() for name, values in clues.items()}


def _made_of(pictures: Pictures, found: Regions) -> dict[str, Array]:
    """What a pixel is made of, by its label, its normal as matter of any normal, and what planes and such matter leave unexplained."""
    planes, labels = len(pictures.planes), pictures.labels
    x, y, z = np.moveaxis(pictures.of_any, -1, 0)
    frame = found.frame()
    return {
        "of any normal": labels == 0,
        "plane": (labels > 0) & (labels <= planes),
        "nothing": labels == planes + 1,
        "planes' misfit": np.clip(pictures.flat - pictures.free, -SPARED[1], SPARED[1]),
        "misfit": np.clip(pictures.free, 0, MISFIT),
        "normal x": x,
        "normal y": y,
        "normal z": z,
        "facing down": pictures.normals[..., 1],
        "bright": pictures.bright - np.median(pictures.bright),
        "blown out": pictures.blown,
        "size": np.sqrt(found.area / labels.size)[found.number],
        "frame": frame[found.number],
        "frame of the label": np.bincount(found.label, weights=frame, minlength=planes + 3)[labels],
    }


def _where(odds: Array, inside: Mask, log_depth: Array) -> dict[str, Array]:
    """Where a pixel lies beside the likely object: behind it, below it and aside in its radii, and how deep in it or outside it."""
    known = np.isfinite(log_depth) & inside
    middle = float(np.median(log_depth[known])) if known.any() else 0.0
    weight = np.where(inside, odds, 0.0)
    row, column = np.indices(odds.shape)
    radius = np.sqrt(weight.sum() / np.pi)
    below, aside = (at - np.sum(weight * at) / weight.sum() for at in (row, column))
    return {
        "behind": np.nan_to_num(np.clip(log_depth - middle, -APART, APART)),
        "below": below / radius,
        "aside": np.abs(aside) / radius,
        "outside": raster.away(inside) - raster.away(~inside),
    }


def likeness(pictures: Sequence[Image], inside: Mask, outside: Mask, by: float, asked: Mask) -> list[Array]:
    """The log likelihood ratio (N,) of the pixels `asked` (H, W), of each picture (H, W): like what lies inside, or outside.

    `by` is the standard deviation of the window in pixels. Zero where one of the sides is empty.
    """
    if not (asked.any() and inside.any() and outside.any()):
        return [np.zeros(int(asked.sum())) for _ in pictures]
    rows, columns = (np.flatnonzero(asked.any(axis=axis)) for axis in (1, 0))
    margin = int(np.ceil(2 * raster.REACH * by))
    box = tuple(slice(max(int(some[0]) - margin, 0), int(some[-1]) + margin + 1) for some in (rows, columns))
    if not (inside[box].any() and outside[box].any()):
        box = (slice(None), slice(None))
    here = asked[box]
    parts = [picture[box].astype(np.float32) for picture in pictures]
    out, within = bands.shared(lambda side: _costs(parts, side[box], by, here), (outside, inside))
    return [np.clip((a - b) / 2, -MOST, MOST) for a, b in zip(out, within, strict=True)]


def _costs(pictures: Sequence[Image], side: Mask, by: float, here: Mask) -> list[Array]:
    """Twice the negative log likelihood (N,) of the pixels `here` (H, W) among those of a side (H, W), by each picture (H, W)."""
    share = raster.blurred(side.astype(np.float32), by)
    nearest = raster.nearest(share > KNOWN)[here]
    weight = np.maximum(share.ravel()[nearest], 1e-9)
    costs = []
    for picture in pictures:
        mean, square = (raster.blurred(np.where(side, one, np.float32(0)), by).ravel()[nearest] / weight for one in (picture, picture**2))
        variance = np.maximum(square - mean**2, 0.0) + TEXTURE**2
        costs.append((picture[here] - mean) ** 2 / variance + np.log(variance))
    return costs


def level(picture: Image, dimmest: float) -> Image:
    """The logarithm of a picture (H, W), no darker than `dimmest`."""
    return np.asarray(np.log(np.maximum(picture, max(dimmest, 1e-12))), np.float32)
