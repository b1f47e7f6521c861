"""The clues by which a coarse pixel is judged in its context: its region's odds, what lies about it, what it is made of, where it lies.

What no light reaches, and what paint or a shadow has joined to a wrong region, shows itself there. No clue needs a scale: odds, natural
logarithms, costs of the labels, shares of the picture, distances in radii of the likely object.
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.surface.likeness import likeness
from lpcal.surface.regions import SPARED, Pictures, Regions, log_depth

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
