r"""Checks of the lights by the object's own images: relative intensities that were not measured, and images of another light.

**Intensities.** Symbols: signals I (L, P), light vectors B (L, P, n), weights w (0 for samples in shadow), relative intensities h (L,).
The misfit of pixel p is the residual of ``h I_p`` after projection on the column space of B_p, relative to ``h I_p``. With the b
eliminated, the sum over all pixels of the squared residuals is h' M h, relative to h' D h::

    M = D - sum_p (w I B)_p (B' w B)_p^-1 (w I B)_p'        D = diag(sum_p w I^2), each pixel normalised to length 1

so the best h is the generalised eigenvector of the smallest eigenvalue. Source: the linear subspace of Lambertian images (Shashua 1997),
with known light directions.

Model errors (gloss, shadows, a tone curve) bias h as well, but differently on different sides of the object, while lamps have the same
intensity everywhere. So the estimate is cross-validated: h from one half of the object (left and right, upper and lower, facing and
slanting) is applied to the other half, and it is accepted where it explains that half clearly better than equal intensities do.

**Exchanged images** (two cables, files or lines of a list). Signal I_i of image i, light vectors B_j of light j, the surface's b. The
residual of image i, if it were of light j, is::

    m_ij = median over the pixels of |I_i - B_j b / h|, over that of I_i        h = median of B_j b / I_i

where h allows for the lamp's intensity. The assignment of images to lights minimises ``sum log m``, the maximum likelihood where each
image has its own noise level. Where two of a dozen lights are exchanged the robust solve rejects their samples, so that b is right and
no other figure shows the mistake.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.calibration import Light
from lpcal.shading import normals
from lpcal.view.constants import FEWEST_PIXELS, MANY_PIXELS, OUTLIER_RATE
from lpcal.view.pixel_list import Illumination, PixelList, vectors

CONDITION = 1e5
"""Condition number of a pixel's normal matrix above which its lights do not determine a normal."""
LIGHTS_NEEDED = 5
"""Smallest number of lights, and of samples of a pixel, for estimating intensities."""
NEEDED_GAIN = 1.2
"""A half's misfit must fall by this factor under the intensities of the other half, in the geometric mean over the halves.

Simulated equal lights give 1.003 at most, whatever the gloss and the shadows; unequal ones 1.1 or more wherever what is found is nearer
than equal ones."""
TRIMS = 4
"""Rounds in which the worse half of the pixels is left out: the bias by gloss falls two- to fourfold, and no further in more rounds."""
NEEDED_FALL = 2.0
"""Smallest factor by which the residuals of exchanged images must fall, in the geometric mean and in every half of the object: model errors
of an image (gloss, shadows, interreflection) can make another light fit as well as its own, but not twice as well."""


@dataclass(frozen=True)
class LightSpace:
    """The column spaces of the pixels' light vectors."""

    weight: Array
    """(L, P)."""
    spanned: Array
    """(L, P, n) orthonormal basis of each pixel's weighted light vectors, times the weights."""

    @staticmethod
    def of(weight: Array, B: Array) -> LightSpace:
        """From weights (L, P), each pixel with at least n independent samples, and light vectors (L, P, n)."""
        inverse = np.linalg.inv(np.einsum("lpi,lpj->pij", weight[..., None] * B, B))
        root = np.linalg.cholesky((inverse + inverse.swapaxes(1, 2)) / 2)
        return LightSpace(weight, weight[..., None] * np.einsum("lpi,pij->lpj", B, root))

    def at(self, some: Mask) -> LightSpace:
        """At some of the pixels."""
        return LightSpace(self.weight[:, some], self.spanned[:, some])

    def misfit(self, signal: Array) -> float:
        """Median over the pixels of their signals' (L, P) misfit."""
        return float(np.median(self.misfits(signal)))

    def misfits(self, signal: Array) -> Array:
        """Misfit (P,) of signals (L, P), per degree of freedom."""
        whole = np.maximum(np.sum(self.weight * signal**2, axis=0), 1e-300)
        inside = np.sum(np.einsum("lpi,lp->pi", self.spanned, signal) ** 2, axis=1)
        count = self.weight.sum(axis=0)
        spare = np.maximum(count - self.spanned.shape[2], 1)
        return np.asarray(np.sqrt(np.maximum(1 - inside / whole, 0) * count / spare))

    def factors(self, signal: Array) -> Array:
        """Relative intensities h (L,) of mean 1 that fit the signals (L, P) best."""
        unit = signal / np.sqrt(np.maximum(np.sum(self.weight * signal**2, axis=0), 1e-300))
        total = np.maximum(np.sum(self.weight * unit**2, axis=1), 1e-12)
        scale = 1 / np.sqrt(total)
        spanned = (self.spanned * unit[..., None]).reshape(len(signal), -1)
        left = np.eye(len(signal)) - scale[:, None] * (spanned @ spanned.T) * scale
        h = np.linalg.eigh(left)[1][:, 0] * scale
        return np.asarray(h / h.mean())

    def misfit_by_halves(self, signal: Array, upper: list[Mask]) -> float:
        """Cross-validated misfit of signals (L, P): each half (`upper` (P,) and the rest) with the other half's h; geometric mean."""
        found = []
        for half in upper:
            for own, other in ((half, ~half), (~half, half)):
                h = self.at(other).factors(signal[:, other])
                found.append(max(self.at(own).misfit(h[:, None] * signal[:, own]), 1e-12))
        return float(np.exp(np.mean(np.log(found))))


def spans(weight: Array, B: Array) -> Mask:
    """Mask (P,) of pixels whose light vectors B (L, P, n) with weights (L, P) have full rank."""
    return np.asarray(np.linalg.cond(np.einsum("lpi,lpj->pij", weight[..., None] * B, B)) < CONDITION)


def halves(signal: Array, weight: Array, B: Array) -> list[Mask]:
    """Halves (P,) of the object's pixels by their normals: rightward, upward, slanting."""
    n = lambert.unit(lambert.weighted(B[..., :3], signal, weight)[0])[0]
    sides = (n[:, 0], n[:, 1], np.hypot(n[:, 0], n[:, 1]))
    return [np.nan_to_num(side) > np.nanmedian(side) for side in sides]


def unmeasured(lights: Sequence[Light]) -> bool:
    """Whether the lights are distant and have equal intensities of unknown uncertainty."""
    same = np.ptp(np.concatenate([light.intensity for light in lights])) == 0
    return bool(same and all(light.source_C is None and not np.isfinite(light.intensity_std) for light in lights))


def intensities(seen: PixelList, lights: Sequence[Light]) -> Array | None:
    """Relative intensities (L,) of mean 1; None with too few lights or pixels, or where cross-validation fails."""
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
    if not np.all(h > 0):
        return None
    found = (1 / h) / np.mean(1 / h)
    equal, theirs = space.misfit(signal), space.misfit_by_halves(signal, halves(h[:, None] * signal, weight, B))
    return found if equal > NEEDED_GAIN * theirs else None


def _shown(seen: PixelList, S: Array) -> tuple[Array, Array, Array] | None:
    """Signals, weights and light vectors (L, P, ...) of pixels that enough lights reach; None of too few pixels."""
    some = seen.at(np.unique(np.linspace(0, seen.pixels - 1, min(MANY_PIXELS, seen.pixels)).astype(int)))
    count = len(S)
    usable = normals.candidates(some, np.ones(some.signal.shape))
    rank = np.argsort(np.argsort(np.where(usable, some.signal, -np.inf), axis=0), axis=0)
    weight = usable & (rank >= min(int(normals.TRIMMED * count), count - LIGHTS_NEEDED)) & (rank < count - int(OUTLIER_RATE * count))
    good = weight.sum(axis=0) >= LIGHTS_NEEDED
    B = np.repeat(S[:, None], some.pixels, axis=1)
    good[good] = spans(weight[:, good].astype(float), B[:, good])
    if np.any(weight[:, good].sum(axis=1) < FEWEST_PIXELS):
        return None
    return some.signal[:, good], weight[:, good].astype(float), B[:, good]


def exchanged(signal: Array, light: Illumination | Array, b: Array, usable: Mask) -> dict[int, int]:
    """Map from image to light, for images that clearly fit another light than their own; empty where none does.

    Parameters
    ----------
    signal : (L, P), without gloss
    light : the light, or its vectors (L, P, 3)
    b : (P, 3), NaN where it is unknown
    usable : (L, P) mask of unsaturated samples
    """
    if len(signal) <= LIGHTS_NEEDED:  # two that are exchanged leave four that agree on a surface
        return {}
    known = np.flatnonzero(np.isfinite(b[:, 0]))
    if len(known) < 2 * FEWEST_PIXELS:
        return {}
    several = (4 * FEWEST_PIXELS, MANY_PIXELS)  # all pairs of a hundred lights at thousands of pixels take a second
    few, some = (known[np.unique(np.linspace(0, len(known) - 1, min(most, len(known))).astype(int))] for most in several)
    screened = _misses(signal[:, few], vectors(light, few), b[few], usable[:, few], np.ones(len(few), bool))
    if np.array_equal(np.argmin(screened, axis=1), np.arange(len(screened))):
        return {}  # each fits its own best, where exchanged ones miss by NEEDED_FALL more
    side = b[some] / np.maximum(lambert.length(b[some])[..., None], 1e-300)
    halves = [above for axis in range(2) for above in (side[:, axis] > np.median(side[:, axis]), side[:, axis] <= np.median(side[:, axis]))]
    if any(half.sum() < FEWEST_PIXELS for half in halves):
        return {}
    B = vectors(light, some)
    miss = np.stack([_misses(signal[:, some], B, b[some], usable[:, some], half) for half in halves])
    total = miss.sum(axis=0)
    if np.array_equal(np.argmin(total, axis=1), np.arange(len(total))):
        return {}  # each fits its own best
    from scipy.optimize import linear_sum_assignment

    _, best = linear_sum_assignment(total)
    moved = np.flatnonzero(best != np.arange(len(best)))
    if not moved.size:
        return {}
    gain = np.mean(miss[:, moved, moved] - miss[:, moved, best[moved]], axis=1)
    return {int(image): int(best[image]) for image in moved} if np.all(gain > np.log(NEEDED_FALL)) else {}


def _misses(signal: Array, B: Array, b: Array, usable: Mask, half: Mask) -> Array:
    """log m_ij (L, L) over half of the pixels."""
    predicted = np.maximum(np.einsum("lpi,pi->lp", B[:, half], b[half]), 0.0)
    found = np.ones((len(signal), len(signal)))
    for k, (own, ok) in enumerate(zip(signal[:, half], usable[:, half] & (signal[:, half] > 0), strict=True)):
        if ok.sum() >= FEWEST_PIXELS:
            ratio = predicted[:, ok] / own[ok]
            h = np.maximum(np.median(ratio, axis=1), 1e-9)[:, None]
            found[k] = np.median(np.abs(own[ok] - predicted[:, ok] / h), axis=1) / np.median(own[ok])
    return np.log(np.maximum(found, 1e-9))
