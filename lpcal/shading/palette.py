r"""Which albedos an object has: those of its well-lit pixels, for the pixels whose own samples leave theirs open.

Symbols: a = |b| albedo of a pixel, p(log a) the histogram over the pixels whose samples determine their normals and that show next to no
gloss or light from other surfaces. Where light that surfaces reflect is a large part of a pixel's samples, or shadows leave few of them, a
dark albedo and a normal turned away explain the same signals; most objects have few albedos, and then the albedo decides. A pixel is pulled
to the mean m of the palette about its own log albedo, within a Gaussian window of width h, by the palette's variance v there::

    chance (log a - m)^2 / (SIGMA^2 + v),        chance = p_h(log a) / (p_h(log a) + RARE / (2 SPAN))

Where albedos are spread evenly m is the pixel's own and nothing pulls. The window begins wide and narrows from round to round (graduated
non-convexity). Sources: Comaniciu and Meer 2002, IEEE Trans. PAMI 24 (mean shift); Barron and Malik 2015, IEEE Trans. PAMI 37 (parsimony of
reflectance).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array
from lpcal.view.agreed import RARE

SPAN = 4.0
"""Natural logarithms of the albedo to either side of the median that the histogram holds."""
NARROWEST = 0.05
"""Width of the window in the last rounds, log albedo: that of one colour; the first is eight times as wide, as far as a fold is off."""
ROUNDS = 3
"""Rounds in which the window narrows."""
OTHER = 0.08
"""Light from other surfaces and gloss, as a share of what the lamps make of matte matter, at which a pixel says nothing of the palette."""
SIGMA = NARROWEST / 2
"""Standard deviation of log albedo within one colour: a texture of some per cent is common."""
BINS = round(10 * SPAN / NARROWEST)
"""Bins of the histogram, five to the window's least width."""


@dataclass(frozen=True)
class Pull:
    """What a palette says of P pixels."""

    albedo: Array
    """(P,) where it pulls each pixel's albedo, in the units of the signals."""
    weight: Array
    """(P,) inverse variance of that albedo."""

    def on(self, n: Array) -> tuple[Array, Array]:
        """What it adds to the normal equations of b at normals n (P, 3): matrices (P, 3, 3) and right sides (P, 3)."""
        weighted = self.weight[:, None] * n
        return weighted[:, :, None] * n[:, None, :], self.albedo[:, None] * weighted


@dataclass(frozen=True)
class Palette:
    """The histogram of an object's log albedo, smoothed by a window."""

    middle: float
    """Log albedo that the histogram is about."""
    density: Array
    """(BINS,) a natural logarithm; its integral is the share of the better known pixels that show nothing but matte matter."""
    mean: Array
    """(BINS,) of log albedo within the window about each bin, from `middle`."""
    variance: Array

    @staticmethod
    def of(b: Array, tilt_rad: Array, other: Array, width: float) -> Palette:
        """The palette of fields b (P, 3), of the better half by the normals' standard deviations (P,), within a window's width.

        `other` (P,) is light from other surfaces and gloss, as a share of what the lamps make of matte matter.
        """
        level = np.log(np.maximum(lambert.length(b), 1e-12))
        middle = float(np.median(level))
        known = tilt_rad <= np.median(tilt_rad)
        weight = np.where(known, np.clip(1 - other / OTHER, 0.0, 1.0), 0.0)
        count, edges = np.histogram(np.clip(level - middle, -SPAN, SPAN), BINS, (-SPAN, SPAN), weights=weight)
        step, at = edges[1] - edges[0], (edges[1:] + edges[:-1]) / 2
        share = count / max(int(known.sum()), 1)
        density, first, second = (raster.blurred(share * one, width / step, "constant") / step for one in (np.ones(BINS), at, at**2))
        mean = first / np.maximum(density, 1e-12)
        return Palette(middle, density, mean, np.maximum(second / np.maximum(density, 1e-12) - mean**2, 0.0))

    def pull(self, b: Array) -> Pull:
        """Where it pulls pixels of fields b (P, 3), and how strongly."""
        level = np.log(np.maximum(lambert.length(b), 1e-12)) - self.middle
        at = np.clip((level + SPAN) / (2 * SPAN) * BINS - 0.5, 0, BINS - 1)
        low = np.minimum(at.astype(int), BINS - 2)
        density, mean, variance = (one[low] + (at - low) * (one[low + 1] - one[low]) for one in (self.density, self.mean, self.variance))
        chance = density / (density + RARE / (2 * SPAN))
        albedo = np.exp(self.middle + np.clip(mean, level - 1, level + 1))
        return Pull(albedo, chance / (SIGMA**2 + variance) / albedo**2)


def width(rounds: int) -> float:
    """The window's width, after a number of rounds with one."""
    return NARROWEST * 2.0 ** max(ROUNDS - rounds, 0)
