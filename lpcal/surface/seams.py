r"""Whether a surface is broken where it seems to be: seams between pieces that only their distances ask for are closed.

What the rounds know of two parts' distances is biased for a whole region (interreflection, gloss, what a shadow hides), and an integration
that takes pixels as independent rather breaks the surface at a neck than believe that. A real break is where something stands before
something else. There the nearer side turns away, as a round body does at its occluding contour, or the light itself says that the parts
stand apart. So a seam is closed, the smaller piece put where both sides meet, if

- one shift is enough: the seam's median edge is a break, and whole there, while the depth of a step that something hides differs along it;
- the nearer side's normals do not turn away: ``-n . v > RIM`` at the median pixel of the seam; and
- by the samples of the piece (surface.basins) that distance is not UNLIKELY compared with its present one: breaks without a rim are rare.

Source: Barrow and Tenenbaum 1978, Recovering Intrinsic Scene Characteristics from Images (the normal of a smooth body at its occluding
contour is perpendicular to the line of sight).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.integration.integrate import Grid, steps, weights_of
from lpcal.integration.pieces import BREAK_WEIGHT, SLIVER_PX
from lpcal.records.calibration import Light
from lpcal.surface import basins
from lpcal.view.agreed import UNLIKELY
from lpcal.view.sight import Indices, Sight

if TYPE_CHECKING:
    from lpcal.surface.rounds import State

RIM = 0.5
"""Cosine between a normal and the direction to the camera under which a seam's nearer side turns away: 60 degrees from it, where a ball of
fifteen pixels across is a pixel from its outline."""


@dataclass(frozen=True)
class Seam:
    """Where a piece meets another."""

    edges: Indices
    """The edges between both."""
    other: int
    """The other's label."""
    jump: float
    """Median by which the piece lies further away, in log depth, than the steps of the seam say."""
    turned: float
    """Median cosine between the normals of the nearer side and the direction to the camera."""


def closed(seen: Sight, grid: Grid, lights: tuple[Light, ...], state: State, label: Labels) -> tuple[Array, Array, Labels]:
    """A state's log depths (P,), weights of the edges and labels (P,) after the seams that are not real have been closed."""
    step, sigma = steps(grid, state.normals, seen.rays_C, central=True, tilt_rad=state.field.tilt_rad)
    u, weight, label = state.u.copy(), state.weight.copy(), label.copy()
    for one in range(2, int(label.max()) + 1):
        inside = label == one
        seam = _longest(seen, grid, u, step, state.normals, label, one)
        if seam is None or seam.turned < RIM:
            continue
        met = u - seam.jump * inside
        there = weights_of(grid, met, step, sigma)
        if not np.median(weight[seam.edges]) <= BREAK_WEIGHT < np.median(there[seam.edges]):
            continue
        main = float(np.median(u[label == 1]))
        if basins.energy_of_shift(seen, lights, u, state.lit.thrown, inside, -seam.jump, main) > -np.log(UNLIKELY):
            continue
        u = met
        beside = _beside(grid, weight, seen.mask, seam.edges)
        weight[beside] = there[beside]
        label[inside] = seam.other
    return u, weight, label


def _longest(seen: Sight, grid: Grid, u: Array, step: Array, normals: Array, label: Labels, one: int) -> Seam | None:
    """The longest seam of a piece; None where it touches no other."""
    at_b = label[grid.b] == one
    between = np.flatnonzero(at_b != (label[grid.a] == one))
    if not len(between):
        return None
    at_b = at_b[between]
    piece = np.where(at_b, grid.b[between], grid.a[between])
    beside = np.where(at_b, grid.a[between], grid.b[between])
    other = int(np.bincount(label[beside]).argmax())
    some = label[beside] == other
    jump = float(np.median((u[piece] - u[beside] - np.where(at_b, 1, -1) * step[between])[some]))
    nearer = (beside if jump > 0 else piece)[some]
    v = seen.rays_C[nearer]
    turned = float(np.median(-lambert.dot(normals[nearer], v) / lambert.length(v)))
    return Seam(between[some], other, jump, turned)


def _beside(grid: Grid, weight: Array, mask: Mask, edges: Indices) -> Indices:
    """The broken edges at a seam of some edges: labels may change some pixels beside the break itself."""
    at = np.zeros(mask.shape, bool)
    at.ravel()[np.flatnonzero(mask.ravel())[np.concatenate([grid.a[edges], grid.b[edges]])]] = True
    near = raster.away(at)[mask] <= SLIVER_PX
    return np.flatnonzero((weight <= BREAK_WEIGHT) & near[grid.a] & near[grid.b])
