"""Relative intensities of distant lights that were not measured, from the object itself, and whether the object determines them.

They are what brings the signals into the spaces of their lights (surface.light_space), and believed where those that one half of the object
gives explain the other half clearly better than equal ones.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Light
from lpcal.surface import normals
from lpcal.surface.light_space import LightSpace, halves, spans
from lpcal.surface.sight import Sight

LIGHTS_NEEDED = 5
PIXELS_NEEDED = 300
MOST_PIXELS = 3000
"""Pixels that are looked at, spread over the object: they give intensities to a fraction of a per cent."""
SHADED, SHINING = 0.25, 0.1
"""Shares of a pixel's samples, its darkest and its brightest, that may lie in shadow and hold a highlight."""
SPARE = 2
"""Samples more than three that a pixel needs."""
NEEDED_GAIN = 1.2
"""A half's misfit must fall by this factor under the intensities of the other half, in the geometric mean over the halves.

Simulated equal lights give 1.003 at most, whatever the gloss and the shadows; unequal ones 1.1 or more wherever what is found is nearer
than
equal ones."""
TRIMS = 4
"""Rounds in which the worse half of the pixels is left out: gloss then biases two to four times less, and no less in further rounds."""
ACCEPTED = (0.2, 5.0)


def unmeasured(lights: Sequence[Light]) -> bool:
    """Whether lights are distant, of one intensity, with no statement of how well that is known."""
    same = np.ptp(np.concatenate([light.intensity for light in lights])) == 0
    return bool(same and all(light.source_C is None and not np.isfinite(light.intensity_std) for light in lights))


def intensities(seen: Sight, lights: Sequence[Light]) -> Array | None:
    """Intensities (L,) of mean 1; None where too few lights or pixels show them, or the halves of the object disagree."""
    if len(lights) < LIGHTS_NEEDED:
        return None
    shown = _shown(seen, np.stack([light.direction_C for light in lights]))
    if shown is None:
        return None
    signal, weight, B = shown
    space = LightSpace.of(weight, B)
    h = space.factors(signal)
    for _ in range(TRIMS):
        left_out = space.misfits(h[:, None] * signal)
        matte = left_out <= np.median(left_out)
        h = space.at(matte).factors(signal[:, matte])
    found = (1 / h) / np.mean(1 / h) if np.all(h > 0) else np.zeros(len(h))
    if not (ACCEPTED[0] < found.min() and found.max() < ACCEPTED[1]):
        return None
    equal, theirs = space.misfit(signal), space.misfit_by_halves(signal, halves(h[:, None] * signal, weight, B))
    return found if equal > NEEDED_GAIN * theirs else None


def _shown(seen: Sight, S: Array) -> tuple[Array, Array, Array] | None:
    """Signals, weights and light vectors (L, P, ...) of pixels that enough lights reach."""
    some = seen.at(np.unique(np.linspace(0, seen.pixels - 1, min(MOST_PIXELS, seen.pixels)).astype(int)))
    count = len(S)
    usable = normals.candidates(some, np.ones(some.signal.shape))
    rank = np.argsort(np.argsort(np.where(usable, some.signal, -np.inf), axis=0), axis=0)
    weight = usable & (rank >= min(int(SHADED * count), count - 3 - SPARE)) & (rank < count - int(SHINING * count))
    good = weight.sum(axis=0) >= 3 + SPARE
    B = np.repeat(S[:, None], some.pixels, axis=1)
    good[good] = spans(weight[:, good].astype(float), B[:, good])
    if good.sum() < PIXELS_NEEDED or np.any(weight[:, good].sum(axis=1) < PIXELS_NEEDED // 5):
        return None
    return some.signal[:, good], weight[:, good].astype(float), B[:, good]
