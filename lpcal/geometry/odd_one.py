"""Which of many points has moved against the others: blocks of a linear model, each held against what the rest predicts.

Symbols: block k has c values, ``y_k = J_k x + e_k``, x (n,) common to all blocks, e of one unknown variance; r residuals of least squares,
H the hat matrix ``J (J^T J)^-1 J^T``::

    d_k = (I - H_kk)^-1 r_k                      what block k is off from the prediction by all others
    F_k = (r_k . d_k / c) / (SSE_k / (m - n - c)),    SSE_k = SSE - r_k . d_k

F_k has the F distribution with c and m - n - c degrees of freedom where block k has not moved: its own error does not hide it. The
scatter that is expected beforehand adds to SSE_k and to the degrees of freedom. Errors that
all blocks share lie in x and cancel, whatever they are. Source: Cook and Weisberg, Residuals and Influence in Regression (1982), 2.2.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array


@dataclass(frozen=True)
class OddOnes:
    """What each of K blocks is off by, in the units of y."""

    common: Array
    """x (n,)."""
    off: Array
    """d (K, c)."""
    off_std: Array
    """(K, c) standard deviation of `off` where the block has not moved, by the scatter of all others."""
    chance: Array
    """(K,) of so large an F where the block has not moved."""
    freedom: int
    """Degrees of freedom of the scatter; 0 or fewer: the blocks are too few to tell."""


def odd_ones(J: Array, y: Array, expected: float, worth: float) -> OddOnes:
    """Hold each block y (K, c) against the others by the model J (K, c, n).

    `expected` is the scatter that is known beforehand, worth so many degrees of freedom: few lights tell their own scatter badly.
    """
    from scipy.stats import f as fisher

    count, size, unknowns = J.shape
    A, b = J.reshape(-1, unknowns), y.ravel()
    x = np.linalg.lstsq(A, b, rcond=None)[0]
    r = (b - A @ x).reshape(count, size)
    freedom = count * size - unknowns - size
    if freedom <= 0:
        nothing = np.full((count, size), np.nan)
        return OddOnes(x, r, nothing, np.ones(count), freedom)
    hat = np.einsum("kcn,nm,kdm->kcd", J, np.linalg.pinv(A.T @ A), J)
    freed = np.linalg.inv(np.eye(size) - hat)
    d = np.einsum("kcd,kd->kc", freed, r)
    explained = np.sum(r * d, axis=1)
    variance = (np.maximum(np.sum(r * r) - explained, 0) + worth * expected**2) / (freedom + worth)
    chance = fisher.sf(explained / size / variance, size, freedom + worth)
    std = np.sqrt(variance[:, None] * np.diagonal(freed, axis1=1, axis2=2))
    return OddOnes(x, d, std, np.asarray(chance), freedom)


def peeled(J: Array, y: Array, expected: float, worth: float, unlikely: float) -> OddOnes:
    """As `odd_ones`, but a block that has moved beyond chance is left out of the fit that the others are held against."""
    rows, least = list(range(len(J))), J.shape[2] // J.shape[1] + 2
    found = odd_ones(J, y, expected, worth)
    off, std, chance = found.off.copy(), found.off_std.copy(), found.chance.copy()
    while len(rows) > least and found.freedom > 0 and found.chance.min() < unlikely:
        worst = int(found.chance.argmin())
        k = rows.pop(worst)
        std[k], chance[k] = found.off_std[worst], found.chance[worst]
        found = odd_ones(J[rows], y[rows], expected, worth)
        off[rows], std[rows], chance[rows] = found.off, found.off_std, found.chance
    gone = [k for k in range(len(J)) if k not in rows]
    off[gone] = y[gone] - J[gone] @ found.common
    return OddOnes(found.common, off, std, chance, found.freedom)
