"""Which lens model, and whether the board is flat: the candidate whose projection is expected to be nearest to the truth.

Symbols: the views are split in two halves a, b; a candidate (model, warp) is solved on each and on all; d the projection difference of
two cameras over the part of the imager that corners cover, rms over it and over the splits::

    variance = (d_ab / 2)^2                                    halves scatter twice as much as the whole
    bias^2   = max(0, d_full^2 - (variance_richest - variance))    d_full: from the richest candidate, all views
    expected^2 = variance + bias^2

The residual always falls with more parameters; halves always agree better with fewer, also where they agree on what is wrong: a bowed
board taken as flat bends both alike. A candidate with more parameters must be better by MARGIN.
Sources: cross-validation as in mrcal's documentation; the variance of the difference of a richer and a poorer estimate, Hausman 1978.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.chain.k_camera.problem import DISTORTIONS, CornerProblem, Solver
from lpcal.errors import LpcalError
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.camera_difference import pixel_grid, projection_difference
from lpcal.records.calibration import Camera

MARGIN = 0.95
FEWEST_VIEWS = 8
"""Halves of fewer views than this, together, decide nothing."""


@dataclass(frozen=True)
class Candidate:
    """A lens model and a board, and what speaks for them."""

    model: str
    warp: bool
    score_px: float
    """Difference between halves of the views; NaN: not tried."""
    expected_px: float = float("nan")
    """Expected difference from the truth, rms."""

    @property
    def parameters(self) -> int:
        """How many numbers it fits beside the poses."""
        return DISTORTIONS.get(self.model, 99) + 2 * self.warp


def choose(problem: CornerProblem, solver: Solver, models: Sequence[str], may_warp: bool) -> tuple[Candidate, list[Candidate]]:
    """The candidate to take, and all that were tried with their scores.

    The lens is chosen first, on a board as free as it may be; then whether the board is bowed, with that lens.
    """
    simplest = Candidate(models[0], False, float("nan"))
    if len(problem.corners_px) < FEWEST_VIEWS or (len(models) == 1 and not may_warp):
        return simplest, [simplest]
    pixels = covered_pixels(problem)

    def tried(model: str, warp: bool) -> Candidate:
        return Candidate(model, warp, cross_validate(problem, solver, model, warp, pixels))

    lenses = _with_expectation([tried(model, may_warp) for model in models], problem, solver, pixels)
    lens = _better(lenses)
    if not may_warp:
        return lens, lenses
    flat, bowed = _with_expectation([tried(lens.model, False), lens], problem, solver, pixels)
    return _better([flat, bowed]), [flat, *(bowed if one is lens else one for one in lenses)]


def _with_expectation(candidates: Sequence[Candidate], problem: CornerProblem, solver: Solver, pixels: Array) -> list[Candidate]:
    """The candidates with what each is expected to be off by, against the richest of those that could be solved."""
    solved = [candidate for candidate in candidates if np.isfinite(candidate.score_px)]
    if not solved:
        return list(candidates)
    cameras = {candidate: solver(problem, candidate.model, candidate.warp).camera for candidate in solved}
    richest = max(solved, key=lambda candidate: candidate.parameters)
    found = []
    for candidate in candidates:
        if candidate not in cameras:
            found.append(replace(candidate, expected_px=float("inf")))
            continue
        variance, reference = (candidate.score_px / 2) ** 2, (richest.score_px / 2) ** 2
        apart2 = 0.0
        if candidate is not richest:
            apart2 = float(np.mean(np.sum(difference(cameras[candidate], cameras[richest], pixels) ** 2, axis=1)))
        bias2 = max(0.0, apart2 - max(reference - variance, 0.0))
        found.append(replace(candidate, expected_px=float(np.sqrt(variance + bias2))))
    return found


def _better(candidates: Sequence[Candidate]) -> Candidate:
    """The least expected difference from the truth, but more parameters must earn themselves."""
    chosen, *others = sorted(candidates, key=lambda c: c.parameters)
    for candidate in others:
        if candidate.expected_px < MARGIN * chosen.expected_px:
            chosen = candidate
    return chosen


def cross_validate(problem: CornerProblem, solver: Solver, model: str, warp: bool, pixels: Array) -> float:
    """The score of one candidate over some pixels (N, 2); infinite where a half cannot be solved."""
    squares = []
    for half in splits(len(problem.corners_px)):
        try:
            first, second = solver(problem.part(half), model, warp).camera, solver(problem.part(~half), model, warp).camera
        except (LpcalError, np.linalg.LinAlgError):
            return float("inf")
        squares.append(np.mean(np.sum(difference(first, second, pixels) ** 2, axis=1)))
    return float(np.sqrt(np.mean(squares)))


def difference(first: Camera, second: Camera, pixels: Array) -> Array:
    """Projection difference (N, 2) at the pixels where the first camera can be inverted."""
    rays_C = first.unproject(pixels)
    inverted = np.linalg.norm(first.project(rays_C) - pixels, axis=1) < 1e-3
    return projection_difference(pixels[inverted], rays_C[inverted], second.project)[0]


def splits(count: int) -> list[Mask]:
    """Three ways (count,) to halve the views, none of which keeps neighbours together for long."""
    k = np.arange(count)
    return [k % 2 == 0, k % 4 < 2, (k % 4) % 3 == 0]


def covered_pixels(problem: CornerProblem) -> Array:
    """Pixels (N, 2) of a grid over the imager, inside the hull of all corners."""
    from scipy.spatial import ConvexHull

    corners_px = problem.corners_px[np.isfinite(problem.corners_px).all(axis=-1)]
    sides = ConvexHull(corners_px).equations
    grid = pixel_grid(problem.image_size)
    return grid[np.all(grid @ sides[:, :2].T + sides[:, 2] <= 0, axis=1)]
