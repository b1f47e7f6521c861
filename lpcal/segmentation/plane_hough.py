r"""Planes in an image, found by a Hough transform over the normals that photometric stereo gives at each depth.

Symbols: at log depth u a pixel of ray r has the normal n(u) from its lights, and so lies on the plane ``n . x = n . r e^u``. Over a sweep
of u it votes for all these planes, weighted by the likelihood of its samples; pixels of one plane share one vote only. Peaks are refined by
robust least squares over the pixels that they explain (see segmentation.planes for q), and explained pixels are removed from the votes.
Sources: Hough 1962; Isack and Boykov 2012, Int. J. Computer Vision 97 (hypotheses first, then labels).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from lpcal.geometry import cauchy_fit, lambert, raster
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.cauchy_fit import Equations
from lpcal.kernels.library import kernel
from lpcal.segmentation import ambient_sample_costs, sample_costs
from lpcal.view import parallel
from lpcal.view.coarse import Coarse, LightTable, RoomPrior
from lpcal.view.pixel_list import Indices

SWEEP = (0.3, 5.0)
"""Depth range over which pixels vote, in working distances."""
SLOPE_BINS, OFFSET_BINS = 61, 90
"""Cells of the accumulator along x and y of the normal (2 degrees each) and along the log offset (5 per cent each)."""
OFFSETS = (-2.5, 2.0)
"""Range of the natural log of a plane's distance from the camera over the working distance."""
BLUR = (0.8, 0.8, 1.2)
"""Standard deviation of the accumulator's smoothing, cells: the spread that noise of the normals gives the votes."""
APART = (3, 3, 4)
"""Half-widths, cells, of the neighbourhood of a peak that is suppressed before the next peak is taken."""
PEAKS = 3
"""Peaks of the accumulator that are refined; the one that explains most pixels is kept."""
STEEPEST = 0.05
"""Cosine between normal and view direction below which a pixel does not vote: its plane is undetermined."""
EXPLAINED = 20.0
"""Largest excess of a plane's cost over that of a free normal at a pixel that the plane explains."""
SMALLEST = 0.006
"""Share of the image below which a plane is not looked for, or is dropped."""
MOST = 8
"""Largest number of planes."""
PAINT = 0.1
"""Step of log albedo that counts as an edge enclosing a part of a plane."""
CLEARLY, CLEARLY_EACH = 60.0, 0.3
"""Least gain in cost of a separate plane, in total and per pixel: high, as errors of neighbouring pixels are correlated."""
FIT_PIXELS = 600
"""Pixels, spread over a plane, to which it is fitted: more do not improve its three parameters."""
ACCEPTED = 3.0
"""Cost per light below which a pixel takes part in the fit of a plane."""
FIT_STEPS = 8
"""Largest number of steps of a fit, after which its pixels are selected again."""


@dataclass(frozen=True)
class Sweep:
    """Fits of a free normal at every pixel and depth: D depths, P pixels."""

    u: Array
    """(D,) log depths."""
    b: Array
    """(D, P, 3)."""
    cost: Array
    """(D, P)."""

    @cached_property
    def least(self) -> Array:
        """Cost (P,) at each pixel's best depth."""
        return np.asarray(self.cost.min(axis=0))

    @cached_property
    def normals(self) -> Array:
        """Normal (P, 3) at each pixel's best depth."""
        b = self.b[np.argmin(self.cost, axis=0), np.arange(self.b.shape[1])]
        return np.asarray(b / np.maximum(lambert.length(b)[..., None], 1e-12))


def sweep(image: Coarse, table: LightTable, distance_m: float, every: int = 1) -> Sweep:
    """Fits of a free normal at the table's nodes, or at one of `every` so many, from SWEEP[0] to SWEEP[1] working distances."""
    low, high = np.log(distance_m) + np.log(SWEEP)
    u = table.nodes[(table.nodes >= low) & (table.nodes <= high)][::every]
    everywhere = np.arange(len(image.rays_C))
    b, cost = np.empty((len(u), len(everywhere), 3)), np.empty((len(u), len(everywhere)))

    def ask(k: int) -> None:
        B, doubt = table.at(np.full(len(everywhere), u[k]), everywhere)
        b[k], cost[k] = _free(image, B, doubt)

    parallel.run_all(ask, range(len(u)))
    return Sweep(u, b, cost)


def _free(image: Coarse, B: Array, doubt: Array) -> tuple[Array, Array]:
    """`sample_costs.free` of the coarse pixels, with ambient light in the signals if the image has a room prior."""
    if image.room is None:
        return sample_costs.free(image.signal, image.sigma, image.usable, B, doubt)
    found = ambient_sample_costs.free(image.signal, image.sigma, image.usable, B, doubt, image.room)
    return found.b, found.cost


def white(q: Array, rays_C: Array, pixels: Indices, table: LightTable) -> tuple[Array, Array]:
    """Signals (L, Q) of a plane q of albedo 1 along rays (Q, 3) in the table's pixels (Q,), and their doubt; 0 where a ray misses it."""
    if run := kernel("white"):
        (_, nodes, L, _), Q = table.B.shape, len(rays_C)
        m, doubt = np.empty((L, Q)), np.empty((L, Q), table.doubt.dtype)
        run(L, nodes, Q, table.B, table.doubt, table.first, table.step, *_placed(q, rays_C, pixels), m, doubt)
        return m, doubt
    u, hit = _met(q, rays_C, table)
    B, doubt = table.at(u, pixels)
    return np.where(hit, np.maximum(B @ (-q / np.linalg.norm(q)), 0.0), 0.0), doubt


def _met(q: Array, rays_C: Array, table: LightTable) -> tuple[Array, Mask]:
    """Log depths (Q,) at which rays (Q, 3) meet a plane q (3,), and the mask (Q,) of those within the table."""
    slope = rays_C @ q
    u = -np.log(np.maximum(slope, 1e-12))
    return u, (slope > 0) & table.holds(u)


def _placed(q: Array, rays_C: Array, pixels: Indices) -> tuple[npt.NDArray[np.generic], ...]:
    """A plane and pixels as arguments of the kernels."""
    return np.ascontiguousarray(q, float), np.ascontiguousarray(rays_C, float), np.ascontiguousarray(pixels, np.int64)


def explained(image: Coarse, table: LightTable, q: Array, pixels: Indices | None = None) -> tuple[Array, Array, Mask]:
    """`sample_costs.planar` of (some of) the coarse pixels."""
    some = np.arange(len(image.rays_C)) if pixels is None else pixels
    m, doubt = white(q, image.rays_C[some], some, table)
    signal, sigma, usable = image.signal[:, some], image.sigma[:, some], image.usable[:, some]
    if image.room is None:
        return sample_costs.planar(signal, sigma, usable, m, doubt)
    return ambient_sample_costs.planar(signal, sigma, usable, m, doubt, image.room)[:3]


def find(image: Coarse, table: LightTable, swept: Sweep, lit: Mask, distance_m: float) -> list[Array]:
    """Planes q (3,) found from the pixels `lit` (P,), in the order in which they are found."""
    left, votes = lit.copy(), _Votes.of(image, swept, distance_m)
    found: list[Array] = []

    def explains(q: Array) -> Mask:
        cost, _, shown = explained(image, table, q)
        return np.asarray(left & (cost < swept.least + EXPLAINED) & (shown.sum(axis=0) >= 3))

    def size(own: Mask) -> int:
        return int(raster.opened(image.image(own)).sum())

    def trial(q: Array) -> tuple[int, Array]:
        q = fitted(image, table, q, left, rounds=2)
        return size(explains(q)), q

    while len(found) < MOST and left.sum() > SMALLEST * left.size:
        trials = parallel.run_all(trial, votes.peaks(left))
        if not trials:
            break
        q = fitted(image, table, max(trials, key=lambda one: one[0])[1], left, rounds=4)
        own = explains(q)
        if size(own) < SMALLEST * left.size:
            break
        found.append(q)
        left &= ~own
    return [*found, *_before(image, table, found, lit)]


def _before(image: Coarse, table: LightTable, found: list[Array], lit: Mask) -> list[Array]:
    """Planes (3,) in front of those found and nearly parallel to them: only all of their pixels together tell the two apart.

    Each region of a plane that an albedo edge encloses is tested; it becomes a plane of its own if that lowers the cost by CLEARLY.
    """
    rim = np.ones(image.shape, bool)
    rim[1:-1, 1:-1] = False
    new = []
    for q in found:
        cost, albedo, shown = explained(image, table, q)
        own = image.image(lit & (cost < ACCEPTED * len(shown)) & (albedo > 0))
        tone = np.where(own, np.log(np.maximum(image.image(albedo), 1e-12)), 0.0)
        part, _ = raster.connected_components(own & (_step(tone) < PAINT))
        size = np.bincount(part.ravel())
        for one in np.setdiff1d(np.flatnonzero(size >= SMALLEST * part.size), [0, *np.unique(part[rim])]):
            inside = (part == one).ravel()
            trial = fitted(image, table, q, inside, rounds=3)
            gain = np.sum(cost[inside] - explained(image, table, trial, np.flatnonzero(inside))[0])
            if gain > max(CLEARLY, inside.sum() * CLEARLY_EACH):
                new.append(trial)
    return new


def _step(tone: Array) -> Array:
    """Range (H, W) of a median-filtered image (H, W) within 3x3 pixels."""
    rows, columns = tone.shape
    about = np.pad(tone, 1, mode="edge")
    nine = np.stack([about[i : i + rows, j : j + columns] for i in range(3) for j in range(3)])
    middle = np.partition(nine, 4, axis=0)[4]
    return raster.max_filtered(middle, 1, -np.inf) + raster.max_filtered(-middle, 1, -np.inf)


def fitted(image: Coarse, table: LightTable, q: Array, among: Mask, rounds: int) -> Array:
    """The plane q (3,) fitted to those of the pixels `among` (P,) that it explains, selected again in each round."""
    pixels = np.flatnonzero(among)
    pixels = pixels[:: max(1, len(pixels) // FIT_PIXELS)]
    for _ in range(rounds):
        cost, albedo, lit = explained(image, table, q, pixels)
        good = cost < ACCEPTED * len(lit)
        own = pixels[good]
        if len(own) < 12:
            break
        _, doubt = white(q, image.rays_C[own], own, table)
        signal = image.signal[:, own]
        weight = lit[:, good] / np.sqrt(sample_costs.variance(signal, image.sigma[:, own], doubt))
        fit = _Fit(image.rays_C[own], own, table, signal, weight, image.room, albedo[good])
        q = cauchy_fit.fitted(fit.equations, q, float(np.linalg.norm(q)), FIT_STEPS)
    return q


@dataclass(frozen=True)
class _Fit:
    """Samples to which a plane is fitted: Q pixels, L lights."""

    rays_C: Array
    pixels: Indices
    table: LightTable
    signal: Array
    weight: Array
    room: RoomPrior | None
    albedo: Array
    """(Q,) from the previous round's plane; the prior of the ambient light depends on it."""

    def equations(self, q: Array) -> Equations:
        """Loss of a plane q (3,) and its quadratic model; the albedo of each pixel is eliminated."""
        if self.room is not None:
            room = self.room
            return Equations.differenced(lambda x: self.in_room(x, room), q)
        L, Q = self.signal.shape
        if L <= sample_costs.MOST_LIGHTS and (run := kernel("plane")):
            found, table = np.empty(13), self.table
            given = (np.ascontiguousarray(one, float) for one in (self.signal, self.weight))
            placed = _placed(q, self.rays_C, self.pixels)
            run(L, table.B.shape[1], Q, table.B, table.first, table.step, *placed, *given, cauchy_fit.LEAST, found)
            return Equations(float(found[0]), found[1:4], found[4:].reshape(3, 3))
        m, turned = self._turned(q)
        m, turned, y = self.weight * m, self.weight * turned, self.weight * self.signal
        square = np.maximum(np.sum(m**2, axis=0), 1e-12)
        albedo = np.sum(m * y, axis=0) / square
        change = np.sum(turned * np.where(square > 1e-12, y - 2 * albedo * m, y), axis=1) / square
        return Equations.of((y - albedo * m).ravel(), -(change[:, None] * m + albedo * turned).reshape(3, -1))

    def in_room(self, q: Array, room: RoomPrior) -> Array:
        """Residuals (M,) with ambient light in the signals."""
        m, _ = white(q, self.rays_C, self.pixels, self.table)
        return ambient_sample_costs.residuals(self.signal, self.weight, m, self.albedo, room)

    def _turned(self, q: Array) -> tuple[Array, Array]:
        """Signals (L, Q) of a plane q (3,) of albedo 1, and their derivatives (3, L, Q) by q."""
        u, hit = _met(q, self.rays_C, self.table)
        size, B = float(np.linalg.norm(q)), self.table.at(u, self.pixels)[0]
        n = -q / size
        shading, deeper = B @ n, self.table.slope(u, self.pixels) @ n
        turned = -(np.moveaxis(B, 2, 0) - shading * n[:, None, None]) / size - deeper * (self.rays_C.T / (self.rays_C @ q))[:, None]
        lit = hit & (shading > 0)
        return np.where(lit, shading, 0.0), np.where(lit, turned, 0.0)


@dataclass(frozen=True)
class _Votes:
    """Votes of P pixels at D depths."""

    cell: Indices
    """(D, P) index of the accumulator's cell."""
    weight: Array
    """(D, P) weight of the vote, of sum 1 for each pixel."""
    distance_m: float

    @staticmethod
    def of(image: Coarse, swept: Sweep, distance_m: float) -> _Votes:
        """The votes of all pixels."""
        n = swept.b / np.maximum(lambert.length(swept.b)[..., None], 1e-12)
        towards = -lambert.dot(n, image.rays_C)
        weight = np.exp(-(swept.cost - swept.least) / max(2, len(image.signal))) * ((towards > STEEPEST) & (n[..., 2] < 0))
        weight /= np.maximum(weight.sum(axis=0), 1e-9)
        offset = swept.u[:, None] + np.log(np.maximum(towards, 1e-3)) - np.log(distance_m)
        column, row = (np.rint((n[..., axis] + 1) / 2 * (SLOPE_BINS - 1)).astype(int) for axis in (0, 1))
        share = (offset - OFFSETS[0]) / (OFFSETS[1] - OFFSETS[0])
        depth = np.clip(np.rint(share * (OFFSET_BINS - 1)), 0, OFFSET_BINS - 1).astype(int)
        return _Votes((column * SLOPE_BINS + row) * OFFSET_BINS + depth, weight, distance_m)

    def peaks(self, left: Mask) -> list[Array]:
        """Planes (3,) of the highest peaks of the accumulated votes of the pixels `left` (P,)."""
        cells = (SLOPE_BINS, SLOPE_BINS, OFFSET_BINS)
        votes = np.bincount(self.cell[:, left].ravel(), self.weight[:, left].ravel(), int(np.prod(cells)))
        total = raster.gaussian_filtered(votes.reshape(cells), BLUR)
        found = []
        for _ in range(PEAKS):
            top = np.unravel_index(int(np.argmax(total)), cells)
            if total[top] <= 0:
                break
            x, y = (2 * top[axis] / (SLOPE_BINS - 1) - 1 for axis in (0, 1))
            n_top = np.array([x, y, -np.sqrt(max(1 - x * x - y * y, 0.01))])
            distance = self.distance_m * np.exp(OFFSETS[0] + top[2] / (OFFSET_BINS - 1) * (OFFSETS[1] - OFFSETS[0]))
            found.append(-n_top / np.linalg.norm(n_top) / distance)
            total[tuple(slice(max(at - by, 0), at + by + 1) for at, by in zip(top, APART, strict=True))] = 0
        return found
