"""Which lens model, and what the board is taken as: the candidate whose projection is expected to be nearest to the truth.

Symbols: the views are split in two halves a, b; a candidate (model, board) is solved on each and on all; d the projection difference of
two cameras over the part of the imager that corners cover, rms over it and over the splits::

    variance = (d_ab / 2)^2                                    halves scatter twice as much as the whole
    bias^2   = max(0, d_full^2 - (variance_richest - variance))    d_full: from the richest candidate, all views
    expected^2 = variance + bias^2

The residual always falls with more parameters; halves always agree better with fewer, also where they agree on what is wrong: a bowed
board taken as flat bends both alike. A candidate with more parameters must be better by a margin.
Sources: cross-validation as in mrcal's documentation; the variance of the difference of a richer and a poorer estimate, Hausman 1978.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.chain.k_camera import patterns
from lpcal.chain.k_camera.problem import DISTORTIONS, CameraFit, CornerProblem, Solver
from lpcal.chain.k_camera.shape import BOARDS
from lpcal.errors import LpcalError
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.camera_difference import pixel_grid, projection_difference
from lpcal.geometry.hull import inside_hull
from lpcal.records.calibration import Camera

MARGIN = 0.95
"""More parameters must be better by this."""
SIGNIFICANT = 16.0
"""And a lens must fit better by this chi-square, four sigmas: halves of the views show what to expect to a tenth or so only, and a lens
that bends in the image's corners, where no board was, costs more than it gains."""
FEWEST_VIEWS = 8
"""Halves of fewer views than this, together, decide nothing."""


@dataclass(frozen=True)
class Candidate:
    """A lens model and a board, and the evidence for them."""

    model: str
    board: str
    score_px: float
    """Difference between halves of the views; NaN: not tried."""
    expected_px: float = float("nan")
    """Expected difference from the truth, rms."""
    fit_chi2: float = float("inf")
    """n log(sum of squares) of the n residuals of all views: differences are chi-square of the parameters more, the noise unknown."""

    @property
    def rank(self) -> int:
        """Its rank by the numbers that it fits besides the poses."""
        return 10 * DISTORTIONS.get(self.model, 99) + BOARDS.index(self.board)


def choose(problem: CornerProblem, solver: Solver, models: Sequence[str], may_warp: bool) -> tuple[Candidate, list[Candidate]]:
    """The candidate to take, and all that were tried with their scores.

    The lens is chosen first, on a board as free as it may be but for its sides; then the board, with that lens. A board that may be bent
    is never held flat: its bow has a prior about 0, and where halves of few views would switch it off by chance, its sigma says so.
    """
    simplest = Candidate(models[0], BOARDS[may_warp], float("nan"))
    if len(problem.corners_px) < FEWEST_VIEWS or (len(models) == 1 and not may_warp):
        return simplest, [simplest]
    pixels = covered_pixels(problem)
    boards = (BOARDS[1:] if set(models) <= set(DISTORTIONS) else BOARDS[1:2]) if may_warp else BOARDS[:1]
    usual = boards[min(1, len(boards) - 1)]
    trials = {(model, usual): _Trial(problem, solver, model, usual, pixels) for model in models}
    lenses = _with_expectation(list(trials.values()), pixels)
    lens = _better(lenses, SIGNIFICANT)
    if len(boards) == 1:
        return lens, lenses
    kinds = [trials.get((lens.model, board)) or _Trial(problem, solver, lens.model, board, pixels) for board in boards]
    sheets = _with_expectation(kinds, pixels)
    return _better(sheets), [*(one for one in lenses if one.model != lens.model), *sheets]


def better_of(problem: CornerProblem, first: tuple[Solver, str, str], second: tuple[Solver, str, str]) -> list[Candidate]:
    """Two candidates (solver, model, board), the better one ahead; the second, of hundreds of parameters, must earn them.

    A splined lens is held at its rim by regularisation, the same in both halves, so what the two are apart is no measure of the first's
    bias: that is what its residuals keep in common over the image.
    """
    pixels = covered_pixels(problem)
    scored = []
    for one in (first, second):
        trial = _Trial(problem, *one, pixels)
        bias_px = patterns.on_image(trial.fit).size_px if trial.fit is not None else float("inf")
        scored.append(replace(trial.candidate, expected_px=float(np.hypot(trial.candidate.score_px / 2, bias_px))))
    return scored if _better(scored, SIGNIFICANT) is scored[0] else scored[::-1]


class _Trial:
    """A candidate solved on all views and on halves of them."""

    def __init__(self, problem: CornerProblem, solver: Solver, model: str, board: str, pixels: Array) -> None:
        self.fit: CameraFit | None = None
        score = float("inf")
        try:
            self.fit = solver(problem, model, board)
            fitting = np.where(self.fit.inlier[..., None], problem.corners_px, np.nan)
            known = replace(problem, corners_px=fitting)
            if self.fit.camera.spline is None:
                known = replace(known, camera=self.fit.camera, H_CB=self.fit.H_CB)
            score = cross_validate(known, solver, model, board, pixels)
        except (LpcalError, np.linalg.LinAlgError):
            pass
        self.candidate = Candidate(model, board, score, fit_chi2=float("inf") if self.fit is None else _chi2(self.fit))


def _chi2(fit: CameraFit) -> float:
    left = fit.residual_px[fit.inlier]
    return float(left.size * np.log(np.mean(left**2)))


def _with_expectation(trials: Sequence[_Trial], pixels: Array) -> list[Candidate]:
    """The candidates with what each is expected to be off by, against the richest of those that could be solved."""
    solved = [trial for trial in trials if np.isfinite(trial.candidate.score_px)]
    if not solved:
        return [trial.candidate for trial in trials]
    richest = max(solved, key=lambda trial: trial.candidate.rank)
    found = []
    for trial in trials:
        if trial not in solved or trial.fit is None or richest.fit is None:
            found.append(replace(trial.candidate, expected_px=float("inf")))
            continue
        variance, reference = (trial.candidate.score_px / 2) ** 2, (richest.candidate.score_px / 2) ** 2
        apart2 = 0.0
        if trial is not richest:
            apart2 = float(np.mean(np.sum(difference(trial.fit.camera, richest.fit.camera, pixels) ** 2, axis=1)))
        bias2 = max(0.0, apart2 - max(reference - variance, 0.0))
        found.append(replace(trial.candidate, expected_px=float(np.sqrt(variance + bias2))))
    return found


def _better(candidates: Sequence[Candidate], significant: float = -np.inf) -> Candidate:
    """The least expected difference from the truth, but more parameters must earn themselves."""
    chosen, *others = sorted(candidates, key=lambda c: c.rank)
    for candidate in others:
        gain = chosen.fit_chi2 - candidate.fit_chi2
        if candidate.expected_px < MARGIN * chosen.expected_px and gain > significant:
            chosen = candidate
    return chosen


def cross_validate(problem: CornerProblem, solver: Solver, model: str, board: str, pixels: Array) -> float:
    """The score of one candidate over some pixels (N, 2); infinite where a half cannot be solved."""
    squares = []
    for half in splits(len(problem.corners_px)):
        try:
            first, second = solver(problem.part(half), model, board).camera, solver(problem.part(~half), model, board).camera
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
    grid = pixel_grid(problem.image_size)
    return grid[inside_hull(grid, problem.corners_px[np.isfinite(problem.corners_px).all(axis=-1)])]
