r"""How far the signals of matte pixels lie from what their lights can make of any normal, and factors of the lights that bring them there.

Symbols: signals I (L, P), light vectors B (L, P, n), weights w (0 where a sample is in shadow), factors h (L,) of the lights. The misfit
of a pixel p is what is left of ``h I_p`` beside all ``B_p b``, as a share of it. With the b eliminated the squares of all pixels are
h' M h, of h' D h in all::

    M = D - sum_p (w I B)_p (B' w B)_p^-1 (w I B)_p'        D = diag(sum_p w I^2), each pixel at length 1

so the factors that suit best are the generalised eigenvector of the least eigenvalue. Source: the linear subspace of Lambertian images
(Shashua 1997), with the lights' directions known.

Whatever the model lacks (gloss, shadows, a tone curve) bends such factors too, but otherwise on one side of the object than on the other,
while lamps have one power for all. So factors are tried on the half of the object that they were not found from: halves to the left and
right, above and below, facing and slanting.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask

CONDITION = 1e5
"""Condition of a pixel's normal matrix over which its lights determine no normal."""


@dataclass(frozen=True)
class LightSpace:
    """The spaces of pixels' light vectors."""

    weight: Array
    """(L, P)."""
    spanned: Array
    """(L, P, n) an orthonormal base of each pixel's weighted light vectors, times the weights."""

    @staticmethod
    def of(weight: Array, B: Array) -> LightSpace:
        """From weights (L, P), each pixel's good for n light vectors, and light vectors (L, P, n)."""
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
        """Misfit (P,) of signals (L, P), the lost freedom counted."""
        whole = np.maximum(np.sum(self.weight * signal**2, axis=0), 1e-300)
        inside = np.sum(np.einsum("lpi,lp->pi", self.spanned, signal) ** 2, axis=1)
        count = self.weight.sum(axis=0)
        spare = np.maximum(count - self.spanned.shape[2], 1)
        return np.asarray(np.sqrt(np.maximum(1 - inside / whole, 0) * count / spare))

    def factors(self, signal: Array) -> Array:
        """Factors h (L,) of mean 1 that suit the signals (L, P) best."""
        unit = signal / np.sqrt(np.maximum(np.sum(self.weight * signal**2, axis=0), 1e-300))
        total = np.maximum(np.sum(self.weight * unit**2, axis=1), 1e-12)
        scale = 1 / np.sqrt(total)
        spanned = (self.spanned * unit[..., None]).reshape(len(signal), -1)
        left = np.eye(len(signal)) - scale[:, None] * (spanned @ spanned.T) * scale
        h = np.linalg.eigh(left)[1][:, 0] * scale
        return np.asarray(h / h.mean())

    def misfit_by_halves(self, signal: Array, upper: list[Mask]) -> float:
        """Misfit of signals (L, P) under the factors of the other half, geometric mean over the halves: `upper` (P,) each, and the rest."""
        found = []
        for half in upper:
            for own, other in ((half, ~half), (~half, half)):
                h = self.at(other).factors(signal[:, other])
                found.append(max(self.at(own).misfit(h[:, None] * signal[:, own]), 1e-12))
        return float(np.exp(np.mean(np.log(found))))


def spans(weight: Array, B: Array) -> Mask:
    """Pixels (P,) whose light vectors B (L, P, n) of weights (L, P) span their space."""
    return np.asarray(np.linalg.cond(np.einsum("lpi,lpj->pij", weight[..., None] * B, B)) < CONDITION)


def halves(signal: Array, weight: Array, B: Array) -> list[Mask]:
    """The object's pixels (P,) in halves by their normals: rightward, upward, slanting."""
    n = lambert.unit(lambert.weighted(B[..., :3], signal, weight)[0])[0]
    sides = (n[:, 0], n[:, 1], np.hypot(n[:, 0], n[:, 1]))
    return [np.nan_to_num(side) > np.nanmedian(side) for side in sides]
