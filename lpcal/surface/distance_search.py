r"""Search over the object's distance: coarse reconstructions from several initial distances, and the probabilities of their local minima.

The near-light cost has several local minima over distance, and the reconstruction rounds find the nearest. So plain rounds (no gloss, no
interreflection, the light field from a table) run from every start of a sweep; each ends in a local minimum of the cost::

    cost = mean over pixels of  sum_k min(r_k^2, OUTLIER^2)  +  mean over edges of  min(e^2, OUTLIER^2 B)

where B is the cost of a break by the contrast of the images (surface.contrast): without it, a result of parts at several depths can beat a
connected one by chance.

An object of several bodies may be right only in parts from any one start. So the best minimum takes over parts of the others, one after
the other, by fusion moves: each changes the set of pixels for which the cost falls the most (integration.cuts). Rounds from the result
give one more minimum. Source: Lempitsky, Rother, Roth and Blake 2010, IEEE Trans. PAMI 32.

The probability of a minimum is proportional to ``exp(-INDEPENDENT (cost - least) / 2)``, in units of the least cost per light (errors of
the model are correlated between pixels), times a broad prior about the working distance, ``1 / (1 + (log ratio / WORKING)^2)``, which
decides where the light hardly determines the distance. The full solve starts at the most probable minimum.

Smaller pieces of the full solve are swept over distance with their shape kept (`of_piece`). The curvature of the cost about the final
distance gives its standard deviation (`std_of`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import reduce

import numpy as np

from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array, Mask
from lpcal.integration import cuts, pieces
from lpcal.integration.integrate import Grid, integrate, settle, steps
from lpcal.records.calibration import Light
from lpcal.records.outcome import Progress, silent
from lpcal.shading import normals
from lpcal.shading.normals import Estimate
from lpcal.surface import distance
from lpcal.surface.contrast import break_costs
from lpcal.view import coarse, parallel
from lpcal.view.coarse import LightTable
from lpcal.view.constants import FEWEST_PIXELS, MANY_PIXELS, OUTLIER2, UNLIKELY
from lpcal.view.crop import Crop
from lpcal.view.pixel_list import Illumination, Indices, PixelList, SignalMaps, light_vectors, list_pixels

STARTS = (0.5, 0.65, 0.85, 1.1, 1.4, 1.9, 2.6)
"""Initial distances, in working distances: the basins of attraction are some 30 per cent wide."""
GRADUATED = 2
"""Rounds integrated with graduated weights, until the depth is good enough for gloss, occlusion and interreflection to be based on it."""
PIXELS = 1500
"""Number of coarse pixels of an object: enough for its shape, few enough for seven starts."""
ROUNDS = 5
"""Rounds from a start: runs in one basin are then within one per cent of each other."""
APART = 0.03
"""Difference of log distances below which two results are the same minimum: runs in one basin agree within one per cent."""
INDEPENDENT = 3.1
"""Effective number of independent pixels of an object, between minima: errors of the model are correlated over regions. Fitted by
tools/fit_basin_odds.py on simulated scenes."""
NEARBY = 150.0
"""Effective number of independent pixels about one minimum: with it the errors of 48 pieces of 44 simulated scenes are 0.89 standard
deviations rms. Their likelihood is largest at 240 (tools/fit_distance_sigma.py); real matter and lights deviate more from the model."""
WORKING = 0.3
"""Log ratio to the working distance at which the prior has fallen to a half: lights are set for the distance of the object."""
PIECE_SWEEP = np.linspace(np.log(0.4), np.log(2.5), 37)
"""Natural logarithms of a piece's distance over its own at which its samples are fitted, a twentieth apart: basins are wider."""


@dataclass(frozen=True)
class DistanceMinimum:
    """A local minimum over distance, where rounds ended."""

    u: Array
    """(P,) log depth of the coarse pixels."""
    cost: float


@dataclass(frozen=True)
class DistanceMinima:
    """The local minima, the most probable first."""

    ends: tuple[DistanceMinimum, ...]
    mask: Mask
    """(rows, columns) of the coarse pixels."""
    factor: int
    lights: int
    about_m: float
    """The working distance."""

    def start(self, mask: Mask) -> Array:
        """Log depth (Q,) of the most probable minimum at the pixels of a full-size mask (H, W)."""
        import cv2

        whole = np.zeros(self.mask.shape)
        whole[self.mask] = self.ends[0].u
        filled = whole.ravel()[raster.nearest(self.mask)]
        shift = 0.5 / self.factor - 0.5
        grid = np.array([[1 / self.factor, 0, shift], [0, 1 / self.factor, shift]])
        flags = cv2.INTER_NEAREST | cv2.WARP_INVERSE_MAP
        large = cv2.warpAffine(filled, grid, mask.shape[::-1], flags=flags, borderMode=cv2.BORDER_REPLICATE)
        return np.asarray(large[mask])

    def others(self) -> list[tuple[float, float]]:
        """The other minima that the images allow: ratio of their distance to the most probable one's, and probability."""
        odds = odds_of(self.ends, self.lights, self.about_m)
        best = self.ends[0]
        both = zip(self.ends[1:], odds[1:], strict=True)
        return [(float(np.exp(np.median(one.u - best.u))), float(p)) for one, p in both if p > UNLIKELY]


def odds_of(ends: Sequence[DistanceMinimum], lights: int, about_m: float) -> Array:
    """Probabilities (N,) of minima, of sum 1, for the working distance `about_m`."""
    cost = np.array([one.cost for one in ends])
    away = np.array([np.median(one.u) for one in ends]) - np.log(about_m)
    unit = max(float(cost.min()) / lights, 1.0)
    log_odds = -INDEPENDENT * (cost - cost.min()) / 2 / unit - np.log1p((away / WORKING) ** 2)
    odds = np.exp(log_odds - log_odds.max())
    return np.asarray(odds / odds.sum())


def search(
    maps: SignalMaps, rays_C: Array, mask: Mask, lights: Sequence[Light], about_m: float, progress: Progress = silent, name: str = "capture"
) -> DistanceMinima | None:
    """The minima for the object in a mask (H, W); None if it is too small for coarse pixels. `name` is used in progress messages."""
    factor = max(1, int(np.sqrt(mask.sum() / PIXELS)))
    image = coarse.coarse_of(maps, rays_C, factor)
    rows, columns = image.shape
    share = mask[: rows * factor, : columns * factor].reshape(rows, factor, columns, factor).mean(axis=(1, 3))
    inside = share > 0.5
    if inside.sum() < FEWEST_PIXELS:
        return None
    seen = list_pixels(image.maps, image.image(image.rays_C), inside, central=True)
    box = Crop.about(inside)
    table = LightTable.of(image, lights, about_m, (box.rows, box.columns)).at_pixels(np.flatnonzero(box.of(inside)))
    grid = Grid.of(inside)
    done: list[float] = []

    def ended(share_of_working: float) -> _Minimum:
        end = _rounds(seen, grid, table, np.full(seen.pixels, np.log(about_m * share_of_working)))
        done.append(share_of_working)
        progress(f"{name}: distance", len(done), len(STARTS))
        return end

    progress(f"{name}: distance", 0, len(STARTS))
    ends: list[DistanceMinimum] = []
    from_starts = parallel.run_all(ended, STARTS)
    fused = _fused(from_starts)
    for end in (one.minimum for one in (from_starts if fused is None else [*from_starts, _rounds(seen, grid, table, fused)])):
        twin = next((k for k, one in enumerate(ends) if abs(np.median(one.u - end.u)) < APART), None)
        if twin is None:
            ends.append(end)
        elif end.cost < ends[twin].cost:
            ends[twin] = end
    odds = odds_of(ends, len(lights), about_m)
    return DistanceMinima(tuple(ends[k] for k in np.argsort(-odds)), inside, factor, len(lights), about_m)


@dataclass(frozen=True)
class PieceEnds:
    """Local minima over the distance of a piece of fixed shape, the most probable first."""

    shift: Array
    """(N,) log ratios of these distances to its own."""
    odds: Array
    """(N,) of sum 1."""
    std: float
    """Standard deviation of the first shift, from the energy about it: large where the light hardly determines the distance."""


def std_of(seen: PixelList, lights: Sequence[Light], u: Array, inside: Mask) -> float:
    """Standard deviation of the log distance of a piece `inside` (P,) of log depths u (P,), from the curvature of its samples' cost.

    Few lights, lights close together or on one side, a flat shape, shadows and gloss all make the cost flat.
    """
    step = float(PIECE_SWEEP[1] - PIECE_SWEEP[0])
    nearer, here, beyond = _costs_of_shifts(seen, lights, u, None, _some(inside), (-step, 0.0, step))
    bend = (nearer - 2 * here + beyond) / step**2 / 2 / max(here / len(lights), 1.0)
    return float(1 / np.sqrt(NEARBY * max(bend, 0.0) + WORKING**-2))


def of_piece(seen: PixelList, lights: Sequence[Light], u: Array, interreflected: Array | None, inside: Mask, main: float) -> PieceEnds:
    """Local minima over the distance of a piece `inside` (P,) of log depths u (P,); the main piece is at log depth `main`.

    Pieces that are separate in the image are swept as a whole, since the rounds find only the nearest minimum. `interreflected` (L, P, 3)
    are the light vectors of interreflection. The energy is that of `odds_of`, with the main piece in place of the working distance.
    """
    some = _some(inside)
    cost = _costs_of_shifts(seen, lights, u, interreflected, some, PIECE_SWEEP)
    energy = _energy(cost, float(np.median(u[some])) + PIECE_SWEEP - main, len(lights))
    least = np.flatnonzero(np.r_[True, energy[1:] < energy[:-1]] & np.r_[energy[:-1] <= energy[1:], True])
    least = least[np.argsort(energy[least], kind="stable")]
    odds = np.exp(energy[least[0]] - energy[least])
    at = np.array([_vertex(energy, int(k)) for k in least])
    weight = np.exp(energy[least[0]] - energy) * (np.abs(PIECE_SWEEP[:, None] - at).argmin(axis=1) == 0)
    return PieceEnds(at, odds / odds.sum(), float(np.sqrt(np.average((PIECE_SWEEP - at[0]) ** 2, weights=weight))))


def _some(inside: Mask) -> Indices:
    """A subset of a piece's pixels, spread over it, on which its distances are compared."""
    every = np.flatnonzero(inside)
    return every[:: max(1, len(every) // MANY_PIXELS)]


def _energy(cost: Array, away: Array, lights: int) -> Array:
    """Minus the log probability, up to a constant, of distances with a cost, `away` in log depth from the expected distance."""
    return np.asarray(INDEPENDENT * cost / 2 / max(float(cost.min()) / lights, 1.0) + np.log1p((away / WORKING) ** 2))


def _vertex(energy: Array, k: int) -> float:
    """Position of the vertex of the parabola through minimum k of the sweep and its neighbours."""
    step = float(PIECE_SWEEP[1] - PIECE_SWEEP[0])
    if not 0 < k < len(energy) - 1:
        return float(PIECE_SWEEP[k])
    bend = energy[k - 1] - 2 * energy[k] + energy[k + 1]
    return float(PIECE_SWEEP[k] + step * (energy[k - 1] - energy[k + 1]) / (2 * max(bend, 1e-12)))


def _costs_of_shifts(
    seen: PixelList, lights: Sequence[Light], u: Array, interreflected: Array | None, some: Indices, shifts: Sequence[float] | Array
) -> Array:
    """Mean cost (N,) of the samples of some pixels with their log depths, from u (P,), changed by each of `shifts` (N,)."""
    few, light = seen.at(some), None if interreflected is None else interreflected[:, some]
    return np.array([_cost_of(few, lights, u[some] + shift, light) for shift in shifts])


def _cost_of(seen: PixelList, lights: Sequence[Light], u: Array, interreflected: Array | None) -> float:
    """Mean cost of the samples of pixels at log depths u (P,)."""
    lit = Illumination(*light_vectors(lights, seen.rays_C * np.exp(u)[:, None], None), interreflected)
    found = normals.estimate(seen, lit, normals.candidates(seen, lit.E), normals.variances(seen))
    return float(_costs(found).mean())


def _costs(found: Estimate) -> Array:
    """Cost (P,) of each pixel's samples; all are outliers where there is no estimate."""
    return np.where(np.isfinite(found.b[:, 0]), found.cost, OUTLIER2 * len(found.inliers))


@dataclass(frozen=True)
class _Edges:
    """Steps of log depth between neighbouring pixels, by their normals."""

    grid: Grid
    step: Array
    """(edges,)."""
    sigma: Array
    """(edges,)."""
    break_cost: Array
    """(edges,) of a break, by the images' contrast."""

    def costs(self, u_a: Array, u_b: Array) -> Array:
        """Cost (edges,) of log depths u_a and u_b (edges,) at their ends."""
        return np.minimum(((u_b - u_a - self.step) / self.sigma) ** 2, OUTLIER2 * self.break_cost)

    def replaced(self, other: _Edges, some: Mask) -> _Edges:
        """These, with those of another minimum at the edges `some` (edges,)."""
        return replace(self, step=np.where(some, other.step, self.step), sigma=np.where(some, other.sigma, self.sigma))


@dataclass(frozen=True)
class _Minimum:
    """A result of the rounds with its cost at each pixel and edge."""

    u: Array
    """(P,) log depth."""
    of_pixels: Array
    """(P,) cost of the samples of each pixel."""
    edges: _Edges

    @property
    def minimum(self) -> DistanceMinimum:
        """The result with its total cost."""
        a, b = self.edges.grid.a, self.edges.grid.b
        return DistanceMinimum(self.u, float(self.of_pixels.mean() + self.edges.costs(self.u[a], self.u[b]).mean()))

    def fused_with(self, other: _Minimum) -> _Minimum:
        """One fusion move: the result with those parts of another that lower its cost the most."""
        grid = self.edges.grid
        here, there = ((one.u[grid.a], one.u[grid.b]) for one in (self, other))
        mixed = (there[0], here[1]), (here[0], there[1])
        only_a, only_b = (np.minimum(self.edges.costs(*u), other.edges.costs(*u)) for u in mixed)
        per_edge = len(self.u) / max(len(grid.a), 1)  # the cost is a sum of means
        of_edges = (per_edge * cost for cost in (self.edges.costs(*here), only_a, only_b, other.edges.costs(*there)))
        some = cuts.cheapest_change(grid, other.of_pixels - self.of_pixels, *of_edges)
        u, of_pixels = np.where(some, other.u, self.u), np.where(some, other.of_pixels, self.of_pixels)
        return _Minimum(u, of_pixels, self.edges.replaced(other.edges, some[grid.a] & some[grid.b]))


def _rounds(seen: PixelList, grid: Grid, table: LightTable, u: Array) -> _Minimum:
    """Plain rounds from u (P,)."""
    pixels = np.arange(seen.pixels)

    def slope_of(some: slice) -> Array:
        return table.slope(u[some], pixels[some])

    of_pixels = np.full(seen.pixels, OUTLIER2 * len(seen.signal))
    break_cost = break_costs(seen, grid)
    edges = _Edges(grid, np.zeros(len(grid.a)), np.ones(len(grid.a)), break_cost)
    for k in range(ROUNDS + 1):
        u = np.clip(u, table.nodes[1], table.nodes[-2])
        B = table.at(u, pixels)[0]
        found = normals.estimate(seen, B, normals.candidates(seen, lambert.length(B)), normals.variances(seen))
        known = np.isfinite(found.b[:, 0])
        if not known.any():
            break
        n = lambert.unit(pieces.fill(grid, lambert.unit(found.b)[0], known))[0]
        step = steps(grid, n, seen.rays_C, central=True)
        of_pixels, edges = _costs(found), _Edges(grid, step.value, step.sigma, break_cost)
        if k == ROUNDS:
            break
        own = distance.own_distance(B, slope_of, np.exp(u), seen, found)
        u, weight = integrate(grid, step, own, u, graduated=k < GRADUATED)
        weight = pieces.without_slivers(grid, weight, seen.mask)
        u = settle(grid, step, own, u, weight)
    return _Minimum(u, of_pixels, edges)


def _fused(ends: Sequence[_Minimum]) -> Array | None:
    """Log depth (P,) combined from parts of several results; None where the best one costs least everywhere."""
    best, *others = sorted(ends, key=lambda one: one.minimum.cost)
    fused = reduce(_Minimum.fused_with, others, best)
    return None if np.array_equal(fused.u, best.u) else fused.u
