"""Where to begin when nothing says how far away the object is: the distance of a flat front at which near light explains the images best.

At each distance of a sweep every pixel has a normal and an albedo of its own; what is left over is the light's word on the distance.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.records.calibration import Light
from lpcal.surface import normals, sight

SPAN = (0.5, 40.0)
"""Of the lights' spread: where the object is looked for. Nearer, lights graze it; farther, they are all alike."""
STEPS = 27
"""Distances of the sweep, each 18 per cent beyond the last: the rounds find the rest from there."""
PIXELS = 600
"""Pixels that are asked, evenly over the object."""
BRIGHT = 0.2
"""Of the image's 99th percentile: pixels brighter than this under some light are asked where no mask is given."""


def distance_m(maps: sight.Grey, rays_C: Array, lights: Sequence[Light], mask: Mask | None) -> float:
    """The distance along the camera's axis at which the signals fit best, by pixels of the mask, else by bright ones."""
    sources_C = np.stack([light.source_C for light in lights if light.source_C is not None])
    spread = float(np.sqrt(np.mean(np.sum((sources_C - sources_C.mean(axis=0)) ** 2, axis=1))))
    sweep = max(float(sources_C[:, 2].mean()), 0.0) + spread * np.geomspace(*SPAN, STEPS)
    brightest = maps.signal.max(axis=0)
    asked = brightest > BRIGHT * np.percentile(brightest, 99) if mask is None or not mask.any() else mask
    seen = sight.look_at(maps, rays_C, asked, central=True)
    some = seen.at(np.unique(np.linspace(0, seen.pixels - 1, min(PIXELS, seen.pixels)).astype(int)))
    cost = []
    for z in sweep:
        d, E = sight.light_vectors(lights, some.points_C(np.full(some.pixels, z)))
        B = d * E[..., None]
        usable = some.usable & (E > 0)
        found = normals.estimate(some, B, normals.candidates(some, E), normals.variances(some))
        cost.append(normals.misfit(some, B, usable, found))
    return float(sweep[int(np.argmin(cost))])
