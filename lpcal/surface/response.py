r"""Whether stored numbers are linear, by the object itself: a matte pixel under many known lights is a plane, whatever its normal.

Symbols: stored numbers s (L,) of a pixel, its lights' vectors B (L, 3) (irradiance times direction), a curve ``linear = s^g``, its misfit::

    e(g) = min_b |s^g - B b| / |s^g| * sqrt(n / (n - 3))      over the n samples that are neither its darkest nor its brightest ones

The samples are chosen by their rank, which no curve changes. The median of e over pixels, at the g that makes it least, against that at
g = 1, tells a tone curve from all that also spoils the fit (gloss, shadows, interreflection, unequal lights): none of these is undone by a
power. Source: the linear subspace of Lambertian images (Shashua 1997); Shi et al. 2010 (self-calibration of the response).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Mask

GAMMAS = np.exp(np.linspace(np.log(0.4), np.log(3.2), 43))
"""The exponents that are tried: from a curve that darkens to one that lightens more than any camera's."""
FEWEST_LIGHTS = 6
"""Lights that tell a curve from a normal: two samples more than the unknowns remain when the darkest are left out."""
FEWEST_PIXELS = 200
SHADED = 0.35
"""Share of a pixel's samples, its darkest, that may lie in shadow."""
SHINING = 0.1
"""Share of a pixel's samples, its brightest, that may hold a highlight."""
LINEAR = 0.15
"""Natural logarithm of an exponent within which a fit is taken for linear: gloss and interreflection bend it by so much."""
WORST_FIT = 0.02
"""Misfit of numbers taken as linear, under which no curve is looked for: noise and texture reach it."""
NEEDED_GAIN = 2.5
"""The misfit must fall by this factor for a curve to be believed."""


@dataclass(frozen=True)
class Curve:
    """The exponent that explains the numbers best, and how well numbers fit taken as linear and by it."""

    gamma: float
    misfit_linear: float
    misfit: float

    @property
    def believed(self) -> bool:
        """Whether the numbers are clearly not linear."""
        inside = GAMMAS[0] < self.gamma < GAMMAS[-1]  # a minimum at the end of what is tried is none
        bent = inside and abs(np.log(self.gamma)) > LINEAR and self.misfit_linear > WORST_FIT
        return bool(bent and self.misfit_linear > NEEDED_GAIN * self.misfit)


def stored_curve(stored: Array, usable: Mask, B: Array) -> Curve | None:
    """The curve of stored numbers (L, P) at pixels lit from B (L, P, 3), where `usable` (L, P); None where too little tells it."""
    count = len(stored)
    if count < FEWEST_LIGHTS:
        return None
    rank = np.argsort(np.argsort(stored, axis=0), axis=0)
    used = usable & (rank >= int(SHADED * count)) & (rank < count - int(SHINING * count)) & (stored > 0)
    enough = used.sum(axis=0) >= FEWEST_LIGHTS - 1
    if enough.sum() < FEWEST_PIXELS:
        return None
    s, weight, B = stored[:, enough], used[:, enough].astype(float), B[:, enough]
    normal = np.einsum("lp,lpi,lpj->pij", weight, B, B)
    good = np.linalg.cond(normal) < 1e6
    s, weight, B, normal = s[:, good], weight[:, good], B[:, good], normal[good]
    if s.shape[1] < FEWEST_PIXELS:
        return None
    misfits = np.array([_misfit(s**gamma, weight, B, normal) for gamma in GAMMAS])
    best = int(np.argmin(misfits))
    return Curve(float(GAMMAS[best]), float(_misfit(s, weight, B, normal)), float(misfits[best]))


def _misfit(linear: Array, weight: Array, B: Array, normal: Array) -> float:
    """Median relative misfit of the pixels."""
    b = np.linalg.solve(normal, np.einsum("lp,lpi,lp->pi", weight, B, linear)[..., None])[..., 0]
    off = np.sum(weight * (linear - np.einsum("lpi,pi->lp", B, b)) ** 2, axis=0)
    count = weight.sum(axis=0)
    return float(np.median(np.sqrt(off / np.sum(weight * linear**2, axis=0) * count / (count - 3))))
