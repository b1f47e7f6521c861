r"""Joint alignment of all views: all overlapping pairs in one least-squares problem, with the tracked poses as prior.

Symbols: e the error of H_PC that all views share, c (6) what all depth maps share (a scale, two tilts, three bendings: lights that are off
turn normals in all views alike), for each view i its own twist xi_i and its bending b_i; x, y a pixel's ray in C; H_i the tracked pose::

    H_AC,i = exp(xi_i + by_handeye,i e) H_i,      delta_i = c . (1, x, y, x^2, x y, y^2) + bending(b_i)
    cost   = sum_pairs sum_points rho(n . (p - q) / sigma) / m  +  priors of e, c, xi_i, b_i

m counts the points that share one error: a residual's neighbours within a knot's cell are off together, and K views of one place make
K (K - 1) / 2 differences of K - 1 errors. rho is Geman and McClure's, so that what is not the same surface has no weight.
Source: S. Rusinkiewicz, A symmetric objective function for ICP (2019), for normals of both.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from lpcal.fusion.correspondences import Meeting, Placed, meet
from lpcal.fusion.deformation import COMMON, Bending, bending_of
from lpcal.fusion.factor import BlockMatrix, Factor
from lpcal.fusion.pair_selection import Partners, everyone
from lpcal.fusion.views import PlacedView, may_see
from lpcal.geometry import lambert, se3
from lpcal.geometry.arrays import Array, Index
from lpcal.records.outcome import Progress, silent

POINTS = 1300
"""Points of a view that are looked up in the others: some for each knot, and enough for all pairs."""
KNOTS = 1400
"""Knots of all views together, about: where all overlap their information matrix is dense, and its factor takes the cube of this."""
KNOTS_EACH = 16
"""Least number of a view's knots, about, however many views there are: with four across the object it can still bend."""
LEAST_STEP_PX, MOST_STEP_PX = 12, 96
"""Bounds of the distance between knots, in pixels."""
ROUNDS = 6
"""Rounds of looking up points and stepping: the step is under a hundredth of the noise after five."""
SHARED_SCALE_STD, SHARED_TILT_STD, SHARED_BEND_STD = 0.01, 0.008, 0.025
"""Standard deviations of what all depth maps share: of log depth, its change a radian, and a radian squared: a scale as near light has it,
and normals that lights as calibrated turn by 0.25 degrees over the image, an axis. Those of six rigs that were simulated and calibrated
from images are 0.0096, 0.007 and 0.025."""
ROUNDS_FOUND = 4
"""Rounds where the views stand nearly right from the start."""
START_FOUND_PX = 5.0
"""Gate of their first round, in footprints of a pixel: pieces are found within two."""
START_GATE = 3.5
"""Gate of the first round, in standard deviations of what priors allow."""
GATE = 5.0
"""Gate of later rounds, in scales of the residuals."""
LEAST_GATE_PX = 2.0
"""Least gate, in footprints of a pixel: nearer points are one surface at any rate."""
LEAST_SIGMA_PX = 0.05
"""Least standard deviation of a residual, in footprints of a pixel: aligned views differ by 0.02 to 0.03, and their bendings take up about
as much of what they differ by."""
ROBUST = 2.5
"""Scale of the loss, in standard deviations of a residual."""
SHARED = 6 + COMMON
"""Parameters that all views share: e and c."""


@dataclass(frozen=True)
class Aligned:
    """Views where they stand, and what the solve knows of it."""

    placed: tuple[Placed, ...]
    parameters: Array
    """(n,) e, c, then each view's xi and bending."""
    information: Factor
    """Factor of the parameters' information matrix (n, n)."""
    starts: Index
    """(N,) place of each view's xi among the parameters."""
    pairs: dict[tuple[int, int], PairFit]
    partners: Partners
    """Which are compared with which."""
    sigma_m: float
    """Standard deviation of a residual between two views."""
    before_m: float
    """Robust rms of the residuals with the tracked poses alone."""
    after_m: float
    H_PC_covariance: Array
    """(6, 6) prior of the error that all views share."""

    @cached_property
    def shared_covariance(self) -> Array:
        """Covariance (SHARED, SHARED) of e and c."""
        return self.information.covariance(np.arange(SHARED))

    def shift(self, view: int) -> tuple[Array, Array]:
        """Twist (6,) by which a view moved against its tracked pose, and its prior's covariance."""
        start = self.starts[view]
        return self.parameters[start : start + 6], self.placed[view].view.placement.noise_covariance


@dataclass(frozen=True)
class PairFit:
    """How two views agree: points that meet, points that contradict, robust rms of the residuals in metres."""

    agree: int
    contradict: int
    rms_m: float


def align(
    views: Sequence[PlacedView],
    H_PC_covariance: Array,
    progress: Progress = silent,
    start: Start | None = None,
    step_px: int | None = None,
    partners: Partners | None = None,
) -> Aligned:
    """Align views; `H_PC_covariance` (6, 6) is that of the transform that all placements share, zero where it is exact.

    `start`: where they stand nearly; `step_px`: between the knots of their bendings, by default as `knots_px` has it; `partners`: which
    are compared with which, by default all.
    """
    partners = everyone(len(views)) if partners is None else partners
    state = _start(views, step_px)
    problem = _Problem.of(state, H_PC_covariance)
    x = np.zeros(problem.size) if start is None else start.parameters(state)
    state = problem.moved(state, x)
    sigma_m, before_m = 0.0, 0.0
    gate_m = _first_gate(views, H_PC_covariance) if start is None else START_FOUND_PX * float(np.median([v.footprint_m for v in views]))
    for done in range(ROUNDS if start is None else ROUNDS_FOUND):
        meetings = all_meetings(state, gate_m, partners)
        spread_m = spread(meetings)
        before_m = before_m or spread_m
        floor_m = LEAST_SIGMA_PX * float(np.median([view.footprint_m for view in views]))
        sigma_m = max(spread_m, floor_m)
        N, g = problem.normal_equations(state, meetings, sigma_m)
        g += problem.add_prior(N, state, x)
        x = x - Factor.of(N).solve(g)
        state = problem.moved(state, x)
        gate_m = max(GATE * sigma_m, LEAST_GATE_PX * floor_m / LEAST_SIGMA_PX)
        progress("rounds of alignment", done + 1, ROUNDS if start is None else ROUNDS_FOUND)
    meetings = all_meetings(state, gate_m, partners)
    after_m = spread(meetings)
    N, _ = problem.normal_equations(state, meetings, max(after_m, floor_m))
    problem.add_prior(N, state, x)
    information = Factor.of(N)
    pairs = {key: PairFit(found.agree, found.contradict, spread({key: found})) for key, found in meetings.items()}
    return Aligned(tuple(state), x, information, problem.starts, pairs, partners, max(after_m, floor_m), before_m, after_m, H_PC_covariance)


@dataclass(frozen=True)
class Start:
    """Where views stand nearly: what all share, and for each view its twist and bending, or what its pieces grow by alone."""

    shared: Array
    """(SHARED,) e and c."""
    own: Sequence[Array | None]
    """(6 + n,) of each view; None: at its tracked pose."""
    grown: Sequence[Mapping[int, float]]
    """Steps of log distance of each view's pieces, c among them, by label; of those that are not named what `own` has, or c."""

    def parameters(self, state: Sequence[Placed]) -> Array:
        """The parameters (n,) of the whole problem."""
        parts = [self.shared]
        for one, own, grown in zip(state, self.own, self.grown, strict=True):
            part = np.zeros(6 + one.bending.size) if own is None else own.copy()
            for label, delta in grown.items():
                part[6 + one.bending.place[label]] = delta - self.shared[6]
            parts.append(part)
        return np.concatenate(parts)

    def placed(self, state: Sequence[Placed]) -> list[Placed]:
        """Views there."""
        return _Problem.of(state, np.zeros((6, 6))).moved(state, self.parameters(state))


def compared(
    views: Sequence[PlacedView], H_PC_covariance: Array, step_px: int | None = None, partners: Partners | None = None
) -> dict[tuple[int, int], PairFit]:
    """How views agree with their partners where their placements put them."""
    partners = everyone(len(views)) if partners is None else partners
    meetings = all_meetings(_start(views, step_px), _first_gate(views, H_PC_covariance), partners)
    return {key: PairFit(found.agree, found.contradict, spread({key: found})) for key, found in meetings.items()}


def all_meetings(state: Sequence[Placed], gate_m: float, partners: Partners) -> dict[tuple[int, int], Meeting]:
    """What every view's points meet in its partners."""
    found = {}
    for i, one in enumerate(state):
        points = one.points()
        for j in partners[i]:
            met = meet(points, state[j], gate_m) if may_see(state[j].view, state[j].H_AC, points[0]) else None
            if met is not None:
                found[i, j] = met
    return found


def spread(meetings: dict[tuple[int, int], Meeting]) -> float:
    """Robust standard deviation of all residuals, metres; 0 where there are none."""
    residuals = [found.residual_m for found in meetings.values() if len(found.residual_m)]
    return float(1.4826 * np.median(np.abs(np.concatenate(residuals)))) if residuals else 0.0


def knots_px(views: Sequence[PlacedView]) -> int:
    """Pixels between knots of the views' bendings."""
    area = sum(int((view.component > 0).sum()) for view in views)
    return int(np.clip(np.sqrt(area / max(KNOTS, KNOTS_EACH * len(views))), LEAST_STEP_PX, MOST_STEP_PX))


def _start(views: Sequence[PlacedView], step_px: int | None = None) -> list[Placed]:
    step_px = knots_px(views) if step_px is None else step_px
    return [placed_view(view, bending_of(view, step_px)) for view in views]


def placed_view(view: PlacedView, bending: Bending) -> Placed:
    """A view where its placement puts it."""
    return Placed(view, bending, view.placement.H_AC, np.zeros(bending.size), *sampled(view, POINTS))


def showing(one: Placed, view: PlacedView) -> Placed:
    """A placed view that shows as much as another copy of it."""
    row, column = sampled(view, POINTS)
    return replace(one, view=view, row=row, column=column)


def sampled(view: PlacedView, count: int) -> tuple[Index, Index]:
    """Pixels of a view that can be compared, on a square grid, about so many."""
    step = max(int(np.sqrt(view.witness.sum() / count)), 1)
    row, column = np.nonzero(view.witness[step // 2 :: step, step // 2 :: step])
    return row * step + step // 2, column * step + step // 2


def _first_gate(views: Sequence[PlacedView], H_PC_covariance: Array) -> float:
    """How far apart two views' surfaces may be at the start, metres."""
    variances = []
    for view in views:
        placement = view.placement
        by = placement.by_handeye
        across = placement.noise_covariance + by @ H_PC_covariance @ by.T
        at_object = se3.adjoint(se3.transform(np.eye(3), -se3.apply(placement.H_AC, np.array([[0, 0, view.distance_m]]))[0]))
        local = at_object @ across @ at_object.T
        shown = np.unique(view.component[view.witness])
        scale_std = max((std for label, std in view.pieces if label in shown), default=0.0)
        variances.append(np.trace(local[3:, 3:]) / 3 + (view.distance_m * scale_std) ** 2 + float(np.nanmedian(view.depth_std_m)) ** 2)
    least_m = LEAST_GATE_PX * float(np.median([view.footprint_m for view in views]))
    return max(START_GATE * float(np.sqrt(2 * np.median(variances))), least_m)


@dataclass(frozen=True)
class _Problem:
    starts: Index
    size: int
    H_PC_covariance: Array

    @classmethod
    def of(cls, state: Sequence[Placed], H_PC_covariance: Array) -> _Problem:
        sizes = [6 + one.bending.size for one in state]
        starts = SHARED + np.concatenate([[0], np.cumsum(sizes)])[:-1].astype(np.intp)
        size = SHARED + sum(sizes)
        return cls(starts, size, H_PC_covariance)

    @property
    def blocks(self) -> Index:
        """(N + 2,) the first parameter of what all share and of each view, and their number."""
        return np.array([0, *self.starts, self.size])

    def add_prior(self, N: BlockMatrix, state: Sequence[Placed], x: Array) -> Array:
        """Add the information of the priors, where the views' bendings stand, to that of the points; the priors' gradient (n,)."""
        common = np.repeat([SHARED_SCALE_STD, SHARED_TILT_STD, SHARED_BEND_STD], [1, 2, 3])
        shared = np.diag(np.concatenate([np.zeros(6), common**-2.0]))
        shared[:6, :6] = _information(self.H_PC_covariance)
        parts = [shared]
        for start, one in zip(self.starts, state, strict=True):
            size = one.bending.size
            part = np.zeros((6 + size, 6 + size))
            part[:6, :6] = _information(one.view.placement.noise_covariance)
            rows, columns, values = one.bending.information(x[start + 6 : start + 6 + size])
            np.add.at(part, (6 + rows, 6 + columns), values)
            parts.append(part)
        for block, part in enumerate(parts):
            N.add(N.rows(block), part)
        return np.concatenate([part @ x[N.rows(block)] for block, part in enumerate(parts)])

    def moved(self, state: Sequence[Placed], x: Array) -> list[Placed]:
        """The views by the parameters."""
        found = []
        for start, one in zip(self.starts, state, strict=True):
            placement = one.view.placement
            H_AC = se3.exp(x[start : start + 6] + placement.by_handeye @ x[:6]) @ placement.H_AC
            field = x[start + 6 : start + 6 + one.bending.size] + one.bending.common @ x[6:SHARED]
            found.append(replace(one, H_AC=H_AC, field=field))
        return found

    def normal_equations(
        self, state: Sequence[Placed], meetings: dict[tuple[int, int], Meeting], sigma_m: float
    ) -> tuple[BlockMatrix, Array]:
        """Information (n, n) and gradient (n,) of the points that meet."""
        share, seen = _share(state), _seen_by(state, meetings)
        N, g, place = BlockMatrix(self.blocks), np.zeros(self.size), np.zeros(self.size, np.intp)
        for (i, j), met in meetings.items():
            if not len(met.residual_m):
                continue
            columns, values = self._rows(state[i], state[j], i, j, met)
            w = (1 + (met.residual_m / (ROBUST * sigma_m)) ** 2) ** -2.0 / (share[i] * sigma_m**2) * 2 / seen[i][met.index]
            place[columns] = 1
            used = np.flatnonzero(place)
            place[used] = np.arange(len(used))
            flat = len(used) * np.arange(len(w))[:, None] + place[columns]
            J = np.bincount(flat.ravel(), values.ravel(), len(w) * len(used)).reshape(len(w), len(used))
            place[used] = 0
            N.add(used, J.T @ (J * w[:, None]))
            g[used] += J.T @ (w * met.residual_m)
        return N, g

    def _rows(self, first: Placed, second: Placed, i: int, j: int, met: Meeting) -> tuple[Index, Array]:
        """Columns and derivatives (N, k) of each residual."""
        n = met.n_A
        by_p, by_q = np.hstack([np.cross(met.p_A, n), n]), -np.hstack([np.cross(met.q_A, n), n])
        grow_p, grow_q = lambert.dot(n, met.p_A - first.H_AC[:3, 3]), -lambert.dot(n, met.q_A - second.H_AC[:3, 3])
        shared = by_p @ first.view.placement.by_handeye + by_q @ second.view.placement.by_handeye
        row, column = first.row[met.index], first.column[met.index]
        pixel = np.column_stack([column, row]).astype(float)
        place_p, weight_p = first.bending.basis(pixel, first.view.component[row, column])
        place_q, weight_q = second.bending.basis(met.pixel, met.component)
        count, si, sj = len(n), self.starts[i], self.starts[j]
        columns = [
            np.broadcast_to(np.arange(SHARED), (count, SHARED)),
            np.broadcast_to(si + np.arange(6), (count, 6)),
            np.broadcast_to(sj + np.arange(6), (count, 6)),
            si + 6 + place_p,
            sj + 6 + place_q,
        ]
        bent_p, bent_q = weight_p * grow_p[:, None], weight_q * grow_q[:, None]
        common = np.einsum("nk,nkc->nc", bent_p, first.bending.common[place_p])
        common += np.einsum("nk,nkc->nc", bent_q, second.bending.common[place_q])
        values = [shared, common, by_p, by_q, bent_p, bent_q]
        return np.concatenate(columns, axis=1), np.concatenate(values, axis=1)


def _share(state: Sequence[Placed]) -> Array:
    """How many points of each view share one error: those in a knot's cell, counted from both sides of a pair."""
    found = []
    for one in state:
        step = max(int(np.sqrt(one.view.witness.sum() / POINTS)), 1)
        found.append(max(2 * (one.bending.step_px / (2 * step)) ** 2, 2.0))
    return np.array(found)


def _seen_by(state: Sequence[Placed], meetings: dict[tuple[int, int], Meeting]) -> list[Array]:
    """How many views see each point of a view, its own among them.

    Of K views of one place the K (K - 1) / 2 differences hold K - 1 independent ones: each counts for 2 / K.
    """
    found = [np.ones(len(one.row)) for one in state]
    for (i, _), met in meetings.items():
        np.add.at(found[i], met.index, 1.0)
    return found


def _information(covariance: Array) -> Array:
    """Inverse of a covariance; a transform that is exact hardly moves."""
    floor = np.diag([1e-12] * 3 + [1e-14] * 3)
    return np.asarray(np.linalg.inv(covariance + floor))
