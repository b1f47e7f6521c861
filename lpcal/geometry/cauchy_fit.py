r"""Robust least squares of a few unknowns whose normal equations are summed elsewhere: Cauchy's loss, by trust regions.

Symbols: residuals r_i(x), loss ``sum log(1 + r_i^2) / 2``, whose derivatives by r are r w with ``w = 1 / (1 + r^2)``, and
``w - 2 r^2 w^2``, of which no less than nothing counts. With J the derivative of r by x::

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
"""Least share of a residual's weight in the curvature, so that this stays positive."""
SETTLED = 1e-8
"""Relative change of the loss, or of the unknowns, under which a fit has ended."""
POOR, GOOD = 0.25, 0.75
"""Shares of the promised reduction under which the radius shrinks, and over which it grows."""
DIFFERENCE = float(np.sqrt(LEAST))
"""Step of an unknown in differences, or as a share of it where it is larger than 1."""
ROOT_STEPS = 20
"""Steps of Newton's method towards the radius: it converges from below in a few."""


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
        """From a function of the unknowns (N,) to residuals (M,), differentiated by differences."""
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
    """Unknowns (N,) of least loss near `begin`, of size about `scale` (a number, or (N,)); equations are asked for `most` times at most."""
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
            if not share >= POOR:  # nor where the loss is no number
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
    """The step (N,) of least ``pull . s + s . square s / 2`` of length `radius` at most, along the axes of the curvature."""
    raised = 0.0 if square.min() > LEAST * square.max() else LEAST * float(square.max()) + 1e-300
    for _ in range(ROOT_STEPS):
        step = -pull / (square + raised)
        length = float(np.linalg.norm(step))
        if length <= radius * (1 + 1e-9):
            break
        raised += (length / radius - 1) * length**2 / float(np.sum(step**2 / (square + raised)))
    return step
