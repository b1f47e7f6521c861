r"""Robust least squares for a few unknowns with the Cauchy loss, by a trust-region method; the caller sums the normal equations.

Symbols: residuals r_i(x), loss ``sum log(1 + r_i^2) / 2``, whose derivatives by r are r w with ``w = 1 / (1 + r^2)``, and
``w - 2 r^2 w^2``, clamped at zero. With J the derivative of r by x::

    gradient = J' (w r)        curvature = J' diag(max(w - 2 r^2 w^2, 0)) J

A step s minimises the quadratic model within a radius: ``(curvature + a) s = -gradient`` with a >= 0 found by Newton's method on the
reciprocal of its length. Sources: Triggs et al. 2000, Bundle Adjustment, 4.3 (weights of a robust loss); More 1978, The Levenberg-Marquardt
Algorithm (the radius and the root); Conn, Gould and Toint 2000, Trust-Region Methods, 6.1.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array

LEAST = float(np.finfo(float).eps)
"""Lower bound of a residual's relative weight in the curvature, which keeps it positive definite."""
SETTLED = 1e-8
"""Relative change of the loss, or of the unknowns, below which the fit has converged."""
POOR, GOOD = 0.25, 0.75
"""Ratios of actual to predicted reduction below which the radius shrinks, and above which it grows."""
DIFFERENCE = float(np.sqrt(LEAST))
"""Step of finite differences: absolute for unknowns up to 1, else relative."""
ROOT_STEPS = 20
"""Largest number of Newton steps for the trust-region multiplier: it converges in a few."""


@dataclass(frozen=True)
class Equations:
    """A loss and its quadratic model at unknowns x (N,)."""

    loss: float
    gradient: Array
    """(N,)."""
    curvature: Array
    """(N, N)."""

    @staticmethod
    def differenced(residuals: Callable[[Array], Array], x: Array) -> Equations:
        """From a function of the unknowns (N,) to residuals (M,), with derivatives by finite differences."""
        here = residuals(x)
        steps = DIFFERENCE * np.maximum(1.0, np.abs(x))
        return Equations.of(here, np.stack([(residuals(x + one) - here) / one.max() for one in np.diag(steps)]))

    @staticmethod
    def of(residual: Array, derivative: Array) -> Equations:
        """From residuals (M,) and their derivatives (N, M) by the unknowns."""
        square = residual**2
        weight = 1 / (1 + square)
        curved = np.maximum(weight - 2 * square * weight**2, LEAST)
        loss = float(np.sum(np.log1p(square))) / 2
        return Equations(loss, derivative @ (weight * residual), (derivative * curved) @ derivative.T)


def fitted(equations: Callable[[Array], Equations], begin: Array, scale: float | Array, most: int) -> Array:
    """Unknowns (N,) of least loss, from `begin`; `scale` is their typical size, a number or (N,), and `most` limits the evaluations."""
    x, now = begin, equations(begin)
    units = np.broadcast_to(scale, x.shape)
    radius = float(np.linalg.norm(x / units)) or 1.0
    asked = 1
    while asked < most and np.abs(now.gradient).max() >= SETTLED:
        square, base = np.linalg.eigh(now.curvature * np.outer(units, units))
        pull = base.T @ (now.gradient * units)
        while asked < most:
            along = _step(np.maximum(square, 0.0), pull, radius)
            promised = -float(along @ pull + np.sum(square * along**2) / 2)
            step = (base @ along) * units
            then = equations(x + step)
            asked += 1
            gain, length = now.loss - then.loss, float(np.linalg.norm(along))
            share = gain / promised if promised > 0 else 0.0
            small = float(np.linalg.norm(step)) < SETTLED * (SETTLED + float(np.linalg.norm(x)))
            ended = small or (gain < SETTLED * now.loss and share > POOR)
            if not share >= POOR:  # also if the loss is NaN
                radius = POOR * length
            elif share > GOOD and length > 0.95 * radius:
                radius *= 2
            if gain > 0 or ended:
                break
        if gain > 0:
            x, now = x + step, then
        if ended:
            break
    return x


def _step(square: Array, pull: Array, radius: float) -> Array:
    """The step (N,) that minimises ``pull . s + s . square s / 2`` within `radius`, in the eigenbasis of the curvature."""
    raised = 0.0 if square.min() > LEAST * square.max() else LEAST * float(square.max()) + 1e-300
    for _ in range(ROOT_STEPS):
        step = -pull / (square + raised)
        length = float(np.linalg.norm(step))
        if length <= radius * (1 + 1e-9):
            break
        raised += (length / radius - 1) * length**2 / float(np.sum(step**2 / (square + raised)))
    return step
