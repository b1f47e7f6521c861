r"""Whether stored numbers are light: the shading of a matte sphere, its shape known, tells the camera's curve.

Symbols: data y of one light and a of the room at the pixels of an outline (normal n from its circle), light = data^e::

    y^e - a^e = g . n  where it is lit        e is where the misfit, over the signal, is least; 1 for a linear camera

A gamma that nobody stated gives e = gamma, one stated and not there 1 / gamma. Source: Lambert's law. A light as near as fourteen radii
takes a third off e (a linear camera's is .75), a rough surface adds to it, so only the plainest curves are refused here; where chrome
spheres say where the lights are, `chain.refine_lights.matte` judges anew.
"""

from __future__ import annotations

import numpy as np

from lpcal.detect.sphere_outline import Outline
from lpcal.geometry.arrays import Array
from lpcal.geometry.tone_curve import not_linear
from lpcal.records.observations import Radiance

EXPONENTS = np.exp(np.linspace(np.log(0.3), np.log(3.0), 24))
LINEAR = (0.6, 1.5)
DISC, LIT, FEWEST = 0.85, 0.08, 200


def refuse_curved(radiance: Radiance, outline: Outline) -> None:
    """Refuse images of a matte sphere whose shading says that they are not linear.

    Raises
    ------
    DisagreementError
        The exponent that makes them so is named.
    """
    found = [e for k in range(len(radiance.lights)) if (e := _exponent(radiance, k, outline)) is not None]
    exponent = float(np.median(found)) if found else 1.0
    if not LINEAR[0] < exponent < LINEAR[1]:
        raise not_linear(exponent)


def _exponent(radiance: Radiance, k: int, outline: Outline) -> float | None:
    signal = radiance.signal[k] if radiance.signal.ndim == 3 else radiance.signal[k].mean(axis=2)
    rows, columns = np.indices(signal.shape)
    x, y = (columns - outline.centre_px[0]) / outline.radius_px, (rows - outline.centre_px[1]) / outline.radius_px
    peak = float(np.percentile(signal[np.hypot(x, y) < DISC], 98))
    use = (np.hypot(x, y) < DISC) & ~radiance.saturated[k] & (signal > LIT * peak)
    if use.sum() < FEWEST or peak <= 0:
        return None
    n = np.stack([x, y, np.sqrt(np.maximum(1 - x**2 - y**2, 0))], axis=-1)[use]
    room = np.maximum(radiance.ambient if radiance.ambient.ndim == 2 else radiance.ambient.mean(axis=2), 0.0)[use] / peak
    total = signal[use] / peak + room
    misfit = [_misfit(n, total**e - room**e) for e in EXPONENTS]
    return float(EXPONENTS[int(np.argmin(misfit))])


def _misfit(n: Array, light: Array) -> float:
    """Rms misfit of a plane of normals over the mean signal."""
    g = np.linalg.lstsq(n, light, rcond=None)[0]
    return float(np.sqrt(np.mean((light - n @ g) ** 2)) / np.std(light))
