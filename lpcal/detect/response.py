r"""Whether stored numbers are linear, by the object itself: a matte pixel under many known lights is a plane, whatever its normal.

Symbols: stored numbers s (L,) of a pixel and a (L,) of the room's light there, its lights' vectors B (L, 3) (irradiance times direction), a
curve g that makes light of numbers, its misfit::

    I(g) = g(s) - g(a)          e(g) = min_b |I(g) - B b| / |I(g)| * sqrt(n / (n - 3)) / g

as a share of the stored numbers, over the n samples that are neither its darkest nor its brightest ones. The samples are chosen by their
rank, which no curve changes. The median of e over pixels, at the g that makes it least, against that at the g that is taken, separates a
tone curve from all that also spoils the fit (gloss, shadows, interreflection): none of these is undone by a power. A curve and the lights'
powers can be taken for each other: where these were not measured, each curve's misfit is that with equal powers, or that with those which
one half of the object gives the other (surface.self_calibration), whichever is less. Source: the linear subspace of Lambertian images
(Shashua 1997); Shi et al. 2010 (self-calibration of the response).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.tone_curve import Gamma, exponent
from lpcal.surface.self_calibration import LightSpace, halves, spans

GAMMAS = np.exp(np.linspace(np.log(0.4), np.log(3.2), 29))
"""The exponents that are tried: from a curve that darkens to one that lightens more than any camera's."""
SPARE = 2
"""Samples beyond the unknowns of a pixel that separate a curve from a normal."""
FEWEST_LIGHTS = 6
"""Lights of which so many remain when the darkest one is left out."""
FEWEST_PIXELS = 200
SHADED = 0.35
"""Share of a pixel's samples, its darkest, that may lie in shadow."""
SHINING = 0.1
"""Share of a pixel's samples, its brightest, that may hold a highlight."""
LINEAR = 0.15
"""Natural logarithm of an exponent within which a fit is taken for linear: gloss and interreflection bend it by so much."""
WORST_FIT = 0.008
"""Misfit of numbers as they are taken, under which no curve is looked for: noise and texture reach it."""
NEEDED_GAIN = 2.0
"""The misfit must fall by this factor for a curve to be believed: simulated linear captures give 1.5 at most, with much gloss."""
DOUBTFUL_GAIN, DOUBTFUL_GAMMA = 1.4, 1.4
"""A gain and an exponent from which a curve is reported: gloss and shadows bend linear numbers the other way."""
CLAIM_GAIN = 1.2
"""The misfit must fall by this factor under a claimed curve for the claim to be reported: linear captures come close to 1 by chance."""
EXACT = 0.002
"""Misfit that no camera's noise falls short of: curves that miss by less explain the numbers equally well."""
AGREES = 1.5
"""A curve that misses by less than this many times the best one's misfit explains the numbers as well."""


@dataclass(frozen=True)
class Curve:
    """The exponent that explains the numbers best, and how well they fit by it, as they are taken, and by a curve that is claimed."""

    gamma: float
    misfit: float
    taken: Gamma
    misfit_taken: float
    misfit_claimed: float

    @property
    def believed(self) -> bool:
        """Whether the numbers are clearly not what they are taken for."""
        inside = GAMMAS[0] < self.gamma < GAMMAS[-1]  # a minimum at the end of what is tried is none
        bent = inside and abs(np.log(self.gamma / exponent(self.taken))) > LINEAR and self.misfit_taken > WORST_FIT
        return bool(bent and self.misfit_taken > NEEDED_GAIN * self.misfit)

    @property
    def doubtful(self) -> bool:
        """Whether the numbers may be those of a photograph, if not clearly."""
        lightened = self.gamma / exponent(self.taken) > DOUBTFUL_GAMMA
        better = self.misfit if self.gamma < GAMMAS[-1] else self.misfit_claimed
        return bool(lightened and self.misfit_taken > WORST_FIT and self.misfit_taken > DOUBTFUL_GAIN * better)

    @property
    def claim_explains(self) -> bool:
        """Whether the claimed curve explains the numbers about as well as the best."""
        return self.misfit_claimed < AGREES * max(self.misfit, EXACT)

    @property
    def claim_is_better(self) -> bool:
        """Whether the claimed curve explains the numbers better than the one that is taken, and that one does not well."""
        return self.misfit_taken > max(WORST_FIT, CLAIM_GAIN * self.misfit_claimed)


@dataclass(frozen=True)
class ShownResponse:
    """What a curve is looked for in."""

    light: Callable[[Gamma], Array]
    """Light (L, P) that a curve makes of the stored numbers."""
    usable: Mask
    """(L, P), not saturated."""
    B: Array
    """(L, P, 3), or (L, P, 4) with ones where the room's light is not known."""
    free: bool = False
    """Whether the lights' powers were not measured."""


def stored_curve(shown: ShownResponse, taken: Gamma, claimed: Gamma) -> Curve | None:
    """The curve of stored numbers, which are taken to be of one and claimed to be of another; None where too little shows it."""
    light = shown.light(taken)
    count, unknowns = len(light), shown.B.shape[2]
    if count < FEWEST_LIGHTS + unknowns - 3:
        return None
    rank = np.argsort(np.argsort(light, axis=0), axis=0)
    shaded = min(int(SHADED * count), count - unknowns - SPARE)
    used = shown.usable & (rank >= shaded) & (rank < count - int(SHINING * count)) & (light > 0)
    enough = used.sum(axis=0) >= unknowns + SPARE
    if enough.sum() < FEWEST_PIXELS:
        return None
    places, weight, B = np.flatnonzero(enough), used[:, enough].astype(float), shown.B[:, enough]
    good = spans(weight, B)
    if good.sum() < FEWEST_PIXELS:
        return None
    places, weight, B = places[good], weight[:, good], B[:, good]
    space, upper = LightSpace.of(weight, B), halves(light[:, places], weight, B)

    def misfit(curve: Gamma) -> float:
        linear = shown.light(curve)[:, places]
        free = space.misfit_by_halves(linear, upper) if shown.free else np.inf
        return min(space.misfit(linear), free) / exponent(curve)

    misfits = [misfit(float(gamma)) for gamma in GAMMAS]
    best = int(np.argmin(misfits))
    return Curve(float(GAMMAS[best]), misfits[best], taken, misfit(taken), misfit(claimed))
