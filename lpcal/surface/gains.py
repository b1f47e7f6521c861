r"""Relative intensities of distant lights that nobody measured, from the object itself.

Symbols: directions S (L, 3), signals I (L,) of a matte pixel that all lights reach, unknown factors h: ``h * I = S b`` for some b. With N
(L, L-3) orthogonal to the columns of S, ``N^T (h * I_p) = 0`` for all pixels p, so h is the eigenvector of the least eigenvalue of::

    M = (N N^T) o (sum_p I_p I_p^T)            o: entry by entry

The intensities are 1 / h. Shadowed pixels are left out; those that fit badly are left out in a second pass. Under many lights hardly a
pixel is reached by all: then normals by the intensities so far and intensities by these normals, in turn. Source: the linear subspace of
Lambertian images (Shashua 1997), with the lights' directions known.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Light
from lpcal.surface import normals
from lpcal.surface.sight import Sight

LIGHTS_NEEDED = 5
PIXELS_NEEDED = 300
DIM = 0.25
"""A pixel counts where its darkest sample is no darker than this share of its median one."""
BRIGHT = 1.6
"""And its brightest no brighter than this many times it: a highlight."""
KEPT = 70.0
"""Per cent of the pixels that the second pass keeps."""
NEEDED_GAIN = 3.0
"""The misfit must fall by this factor: errors of the directions are taken up by intensities too, but less well."""
ACCEPTED = (0.2, 5.0)
TURNS, TURN_PIXELS = 25, 600
STRIDE = 1.8
"""How far beyond what a turn says the next begins: they creep."""
NEEDED_TURN_GAIN = 1.5
"""In turn, the samples' median misfit must fall by this factor."""


def unmeasured(lights: Sequence[Light]) -> bool:
    """Whether lights are distant, of one intensity, and nobody says how well that is known."""
    same = np.ptp(np.concatenate([light.intensity for light in lights])) == 0
    return bool(same and all(light.source_C is None and not np.isfinite(light.intensity_std) for light in lights))


def intensities(seen: Sight, lights: Sequence[Light]) -> Array | None:
    """Intensities (L,) of mean 1; None where too few lights or pixels tell them."""
    if len(lights) < LIGHTS_NEEDED:
        return None
    S = np.stack([light.direction_C for light in lights])
    middle = np.median(seen.signal, axis=0)
    lit = seen.usable.all(axis=0) & (seen.signal.min(axis=0) > DIM * middle) & (seen.signal.max(axis=0) < BRIGHT * middle)
    lit &= middle > np.median(middle) / 2
    if lit.sum() < PIXELS_NEEDED:
        return _in_turn(seen, S)
    signal = seen.signal[:, lit] / middle[lit]
    N = np.linalg.svd(S)[0][:, 3:]
    misfit = _misfit(N, _least(N, signal), signal)
    signal = signal[:, misfit <= np.percentile(misfit, KEPT)]
    h = _least(N, signal)
    before, after = np.median(_misfit(N, np.ones(len(h)), signal)), np.median(_misfit(N, h, signal))
    if np.any(h <= 0) or before < NEEDED_GAIN * after:
        return None
    found = (1 / h) / np.mean(1 / h)
    return found if ACCEPTED[0] < found.min() and found.max() < ACCEPTED[1] else None


def _in_turn(seen: Sight, S: Array) -> Array | None:
    """Intensities (L,) by turns, from pixels that some lights reach; None where they explain the images no better."""
    some = seen.at(np.unique(np.linspace(0, seen.pixels - 1, min(TURN_PIXELS, seen.pixels)).astype(int)))
    if some.pixels < PIXELS_NEEDED:
        return None
    B = np.repeat(S[:, None], some.pixels, axis=1)
    unit, found, spread = np.ones((len(S), some.pixels)), np.ones(len(S)), []
    for _ in range(TURNS):
        now = replace(some, signal=some.signal / found[:, None], sigma=some.sigma / found[:, None])
        usable = normals.candidates(now, unit)
        b = normals.estimate(now, B, usable, normals.variances(now)).b
        foretold = np.nan_to_num(lambert.dot(B, b))
        ratio = np.where(usable & (foretold > DIM * foretold.max(axis=0)), now.signal / np.where(foretold > 0, foretold, np.nan), np.nan)
        if np.any(np.isfinite(ratio).sum(axis=1) < PIXELS_NEEDED // 3):
            return None
        spread.append(float(np.nanmedian(np.abs(ratio - 1))))
        found = found * np.nanmedian(ratio, axis=1) ** STRIDE
        found = found / found.mean()
    return found if NEEDED_TURN_GAIN * spread[-1] < spread[0] and ACCEPTED[0] < found.min() and found.max() < ACCEPTED[1] else None


def _least(N: Array, signal: Array) -> Array:
    h = np.linalg.eigh((N @ N.T) * (signal @ signal.T))[1][:, 0]
    return np.asarray(h * np.sign(h.sum()))


def _misfit(N: Array, h: Array, signal: Array) -> Array:
    """Share (P,) of each pixel's signals that lies outside the lights' space."""
    scaled = h[:, None] * signal
    return np.asarray(np.linalg.norm(N.T @ scaled, axis=0) / np.linalg.norm(scaled, axis=0))
