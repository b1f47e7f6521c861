"""Whether a capture's own images contradict its calibration: a light that shines otherwise than it says.

Symbols: s_l signal of light l, rho albedo, E_l its irradiance at the point x, d_l the direction to it, n the normal::

    q_l = median over pixels of  log(s_l / (rho E_l n . d_l))

The surface is fitted to all lights, so one that is off pulls it and shows about half of what it is off by; the others hardly move. What
is the object's (interreflection) lies in few pixels and does not move a median; where gloss was found nothing is said.
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array, Image
from lpcal.records.calibration import Calibration
from lpcal.records.observations import Radiance
from lpcal.records.surface import Surface

LIT = 0.3
"""Cosine of the angle to a light, and share of the median signal, under which a pixel tells of shadow and its edges too."""
FEWEST_PIXELS = 200
"""Pixels that a light must be seen by: a median of so many is known to a percent where each is off by a tenth."""
CONTRADICTS = 0.04
"""Deviation from which a light is named: a lamp that is off by a tenth shows six per cent, drawn captures of right lights none, rendered
ones with interreflection two."""
SIGMAS = 5.0
"""Stated standard deviations of the intensity that a deviation must exceed as well."""


def deviations(surface: Surface, radiance: Radiance, calibration: Calibration) -> dict[str, float]:
    """How much brighter (log) each light's image is than the surface found makes it, the median of all taken out; NaN: too few pixels."""
    inside = surface.mask
    x_C = surface.depth[inside].astype(float)[:, None] * surface.rays_C[inside] if surface.metric else surface.rays_C[inside]
    n, albedo = surface.normals[inside].astype(float), _grey(surface.albedo[inside])
    found = []
    for k, name in enumerate(radiance.lights):
        light = next(one for one in calibration.lights if one.name == name)
        d, E = light.field(x_C)
        cosine, signal = np.sum(d * n, axis=1), _grey(radiance.signal[k][inside])
        good = (cosine > LIT) & ~radiance.saturated[k][inside] & (signal > LIT * np.median(signal))
        expected = albedo * _grey(E) * cosine
        good &= np.isfinite(expected) & (expected > 0)
        found.append(float(np.median(np.log(signal[good] / expected[good]))) if good.sum() >= FEWEST_PIXELS else np.nan)
    middle = np.nanmedian(found) if np.isfinite(found).any() else np.nan
    return {name: float(value - middle) for name, value in zip(radiance.lights, found, strict=True)}


def _grey(values: Array | Image) -> Array:
    """Values (P,) or the mean (P,) of (P, C)."""
    return np.asarray(values if values.ndim == 1 else values.mean(axis=-1), dtype=float)


def contradicting(surface: Surface, radiance: Radiance, calibration: Calibration) -> tuple[str, ...]:
    """What is to be said of a light whose image contradicts its calibration."""
    figures = surface.figures
    spoken_for = (figures.gloss, figures.intensities_found, figures.images_exchanged, figures.ambient)
    if not surface.metric or any(one is not None for one in spoken_for):
        return ()
    found = deviations(surface, radiance, calibration)
    stated = {light.name: light.intensity_std for light in calibration.lights}
    worst = max((name for name in found if np.isfinite(found[name])), key=lambda name: abs(found[name]), default=None)
    if worst is None or abs(found[worst]) < max(CONTRADICTS, SIGMAS * float(np.nan_to_num(stated[worst]))):
        return ()
    percent = 100 * np.expm1(found[worst])
    how = f"{abs(percent):.0f} % {'brighter' if percent > 0 else 'darker'}"
    return (
        f"{worst} shines otherwise than its calibration says: its image is {how} than the others' make it (the lamp itself is off by "
        "more): has it aged, moved, another current, or its image another exposure?",
    )
