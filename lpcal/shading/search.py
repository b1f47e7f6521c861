r"""Another minimum of the field's energy, found by trying normals all over the hemisphere where the field leaves samples unexplained.

The field (shading.field) is the minimum next to its start. Where few lights reach, a gloss is strong or most of the light is
interreflected, there are others, and neighbours that are wrong alike hold each other there. Here each pixel whose cost is high holds some
candidates for b: the field's, the least local minima over directions and albedos, and one drawn by its odds. Pixels pass messages to their
neighbours (min-sum belief propagation), and in each sweep try their neighbours' best and small turns of their own candidates (particles).
Symbols: cost u_p(b) of a pixel's samples, palette and view, link s(b, b') of the field, candidates X_q::

    m_qp(b) = min over b' in X_q of  u_q(b') + sum of m_rq(b') over neighbours r but p  +  s(b, b')

    u_p(b) = sum_k min(rho(lit), rho(in shadow) + PRICE)  -  2 log p(log a)  -  2 log(n . v)

p is the palette's (shading.palette); n . v is the area that a piece of surface covers in the picture. The result is a proposal: whether a
region of it is right is judged by this energy and that of the depth together (surface.minima).

Sources: Besse, Rother, Fitzgibbon and Kautz 2014, Int. J. Computer Vision 110 (PatchMatch belief propagation); Felzenszwalb and
Huttenlocher 2006, Int. J. Computer Vision 70 (min-sum messages, two colours of pixels in turn).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array, Mask
from lpcal.integration.integrate import Grid
from lpcal.kernels.library import kernel
from lpcal.shading import field, gloss, palette
from lpcal.shading.palette import Palette
from lpcal.view import bands
from lpcal.view.agreed import DOUBT, GRAZING, OUTLIER2
from lpcal.view.sight import Indices, Lit, Sight

DIRECTIONS = 160
"""Normals of a hemisphere that are tried, 11 degrees apart: with 90 an eighth less is gained in 28 simulated scenes."""
PARTICLES = 4
"""Candidates that a pixel holds: with six as much is gained in 28 simulated scenes, with ten a fifteenth more in twice the time."""
SWEEPS = 6
"""Sweeps over all pixels: with twelve no more is gained."""
SAMPLES = 6
"""Brightest samples of a pixel that propose an albedo for a normal; directions are tried by twice as many lights at most."""


@dataclass(frozen=True)
class Costs:
    """What candidates for b cost pixels by their samples, a palette and the view."""

    seen: Sight
    lit: Lit
    hidden: Mask | None
    """(L, P) samples whose light the depth hides."""
    shine: gloss.Gloss | None
    palette: Palette

    @property
    def v(self) -> Array:
        """Directions (P, 3) to the viewer."""
        return np.asarray(-self.seen.rays_C / lambert.length(self.seen.rays_C)[..., None])

    @property
    def least(self) -> float:
        """Albedo that is tried at least: the lowest that the palette holds."""
        return float(np.exp(self.palette.middle - palette.SPAN))

    def at(self, some: Indices | slice) -> Costs:
        """Those of some of the pixels."""
        hidden = None if self.hidden is None else self.hidden[:, some]
        return replace(self, seen=self.seen.at(some), lit=self.lit.at(some), hidden=hidden)

    def of_lights(self, some: Indices) -> Costs:
        """Those by some of the lights."""
        seen = replace(self.seen, signal=self.seen.signal[some], sigma=self.seen.sigma[some], usable=self.seen.usable[some])
        lit = Lit(self.lit.d[some], self.lit.E[some], None if self.lit.thrown is None else self.lit.thrown[some])
        return replace(self, seen=seen, lit=lit, hidden=None if self.hidden is None else self.hidden[some])

    def of(self, b: Array) -> Array:
        """The cost (P, N) of candidates b (P, N, 3)."""
        parts = bands.each(len(b), len(self.seen.signal) * b.shape[1], lambda some: _of_candidates(self.at(some), b[some]))
        return np.concatenate(parts)

    def over_directions(self, n: Array, most: float) -> tuple[Array, Array]:
        """Least cost (P, D) of normals n (D, 3) over the albedos that palette and samples propose up to one, and those albedos (P, D)."""
        count = len(self.seen.signal)
        some = np.unique(np.linspace(0, count - 1, min(count, 2 * SAMPLES)).round().astype(int))
        few = self if len(some) == count else self.of_lights(some)
        parts = bands.each(self.seen.pixels, len(some) * len(n), lambda here: _of_directions(few.at(here), n, most))
        return np.concatenate([cost for cost, _ in parts]), np.concatenate([albedo for _, albedo in parts])

    def given(self) -> tuple[object, ...]:
        """What kernels are given of it."""
        lit, seen, shine = self.lit, self.seen, self.shine
        d, E, signal, sigma, v, table = (
            np.ascontiguousarray(one, float) for one in (lit.d, lit.E, seen.signal, seen.sigma, self.v, self.palette.costs())
        )
        J = np.zeros(0) if lit.thrown is None else np.ascontiguousarray(lit.thrown, float)
        unlit = np.zeros(0, bool) if self.hidden is None else np.ascontiguousarray(self.hidden)
        model = (field.SHARED, field.SHARED, field.DARK, DOUBT, field.PRICE, field.PRICE, DOUBT, OUTLIER2)
        lobe = (0.0, 1.0) if shine is None else (shine.ks, shine.roughness)
        c = np.array([*model, *lobe, self.palette.middle, palette.SPAN, GRAZING])
        return d, E, J.size > 0, J, signal, sigma, np.ascontiguousarray(seen.usable), unlit.size > 0, unlit, v, c, len(table), table


def _of_candidates(costs: Costs, b: Array) -> Array:
    """The cost (P, N) of candidates b (P, N, 3)."""
    if run := kernel("candidates"):
        cost = np.empty(b.shape[:2])
        run(len(costs.seen.signal), len(b), b.shape[1], *costs.given(), np.ascontiguousarray(b, float), cost)
        return cost
    return np.stack([_of_one(costs, one) for one in b.transpose(1, 0, 2)], axis=1)


def _of_one(costs: Costs, b: Array) -> Array:
    """The cost (P,) of one candidate b (P, 3) each."""
    (n, albedo), v, colours = lambert.unit(b), costs.v, costs.palette
    state = field.states(costs.seen, costs.lit, b, costs.hidden, field.shown_gloss(costs.lit, b, v, costs.shine), 1.0)
    hidden = np.zeros(state.lit.shape, bool) if costs.hidden is None else costs.hidden
    in_shadow, as_lit = _robust(state.shadow**2 / state.shadow_spread2), _robust(state.lit**2 / state.spread2)
    in_shadow = in_shadow + np.where((lambert.dot(costs.lit.direct, b) > 0) & ~hidden, field.PRICE, 0.0)
    least = np.minimum(in_shadow, as_lit + np.where(hidden, field.PRICE, 0.0))
    towards = np.maximum(lambert.dot(v, n), GRAZING)
    level = (np.log(np.maximum(albedo, 1e-12)) - colours.middle + palette.SPAN) / (2 * palette.SPAN) * palette.BINS - 0.5
    by_palette = np.interp(level, np.arange(palette.BINS), colours.costs())
    return np.asarray(np.where(costs.seen.usable, least, 0.0).sum(axis=0) - 2 * np.log(towards) + by_palette)


def _of_directions(costs: Costs, n: Array, most: float) -> tuple[Array, Array]:
    """Least cost (P, D) of normals n (D, 3) over albedos up to one, and those albedos (P, D)."""
    signal = np.where(costs.seen.usable, costs.seen.signal, 0.0)
    by = np.ascontiguousarray(np.argsort(-signal, axis=0, kind="stable")[:SAMPLES], np.int64)
    levels = np.exp(costs.palette.colours(PARTICLES))
    if run := kernel("directions"):
        cost, albedo = np.empty((2, signal.shape[1], len(n)))
        work = np.empty((len(signal), 32))  # BLOCK of kernels/search.c
        run(*signal.shape, len(n), *costs.given(), n, len(levels), levels, len(by), by, costs.least, most, work, cost, albedo)
        return cost, albedo
    found = [_over_albedos(costs, one, levels, by, most) for one in n]
    return np.stack([cost for cost, _ in found], axis=1), np.stack([albedo for _, albedo in found], axis=1)


def _over_albedos(costs: Costs, n: Array, levels: Array, by: Indices, most: float) -> tuple[Array, Array]:
    """Least cost (P,) of one normal (3,), and its albedo (P,)."""
    each = np.broadcast_to(n, (costs.seen.pixels, 3))
    shown = field.shown_gloss(costs.lit, each, costs.v, costs.shine)
    left = costs.seen.signal if shown is None else costs.seen.signal - shown
    light = np.maximum(costs.lit.direct @ n, 0.0)
    if costs.lit.thrown is not None:
        light = light + np.maximum(costs.lit.thrown @ n, 0.0)
    proposed = np.clip(np.take_along_axis(left / np.maximum(light, 1e-300), by, axis=0), costs.least, most)
    albedo = np.concatenate([np.broadcast_to(levels[:, None], (len(levels), len(each))), proposed])
    cost = np.stack([_of_one(costs, one[:, None] * each) for one in albedo])
    least = cost.argmin(axis=0)[None]
    return np.take_along_axis(cost, least, axis=0)[0], np.take_along_axis(albedo, least, axis=0)[0]


def _robust(square: Array) -> Array:
    """Geman and McClure's cost of squares of residuals in standard deviations."""
    return square / (1 + square / OUTLIER2)


def energy(costs: Costs, grid: Grid, b: Array) -> Array:
    """The energy of a field b (P, 3), pixel by pixel (P,): a link's is shared by its ends."""
    square = field.apart(b[grid.a], b[grid.b])
    link = square / (1 + square / field.LINK2) / 2
    return costs.of(b[:, None])[:, 0] + np.bincount(grid.a, link, len(b)) + np.bincount(grid.b, link, len(b))


def propose(costs: Costs, grid: Grid, b: Array) -> Array:
    """A field (P, 3) of less energy than b (P, 3), as far as the search finds one; b where its samples are explained already."""
    now = costs.of(b[:, None])[:, 0]
    unexplained = np.zeros(costs.seen.mask.shape, bool)
    unexplained[costs.seen.mask] = now > np.maximum(field.PRICE, costs.seen.usable.sum(axis=0))
    wanted = np.flatnonzero(raster.grown(unexplained)[costs.seen.mask])
    if len(wanted) == 0:
        return b
    rng = np.random.default_rng(1)
    of = costs.at(wanted)
    x, u = np.repeat(b[:, None], PARTICLES, axis=1), np.repeat(now[:, None], PARTICLES, axis=1)
    x[wanted] = _starts(of, b[wanted], float(lambert.length(b).max()), rng)
    u[wanted] = of.of(x[wanted])
    beliefs = _Beliefs(x, u, np.zeros((*u.shape, 4)), _neighbours(grid))
    colour = (grid.rows[wanted] + grid.columns[wanted]) % 2
    parts = [(wanted[one], costs.at(wanted[one])) for one in (colour == 0, colour == 1)]
    for _ in range(SWEEPS):
        for here, own in parts:
            beliefs.resample(here, own, rng)
    return beliefs.best()


def _hemisphere(count: int) -> Array:
    """Unit vectors (count, 3) spread evenly over the half that faces a camera: a Fibonacci spiral."""
    k = np.arange(count) + 0.5
    height, turn = 1 - k / count, np.pi * (1 + 5**0.5) * k
    flat = np.sqrt(1 - height**2)
    return np.stack([np.cos(turn) * flat, np.sin(turn) * flat, -height], axis=1)


def _starts(of: Costs, b: Array, most: float, rng: np.random.Generator) -> Array:
    """First candidates (P, PARTICLES, 3): the field's, the least local minima over directions, and one by its odds."""
    n = _hemisphere(DIRECTIONS)
    cost, albedo = of.over_directions(n, most)
    cost = np.where(of.v @ n.T < GRAZING, np.inf, cost)
    beside = np.argsort(-(n @ n.T), axis=1, kind="stable")[:, 1:7]
    lowest = np.ones(cost.shape, bool)
    for one in beside.T:
        lowest &= cost <= cost[:, one]
    order = np.argsort(np.where(lowest, cost, np.inf), axis=1, kind="stable")[:, : PARTICLES - 2]
    drawn = np.argmax(-cost / 2 + rng.gumbel(size=cost.shape), axis=1)[:, None]
    some = np.concatenate([order, drawn], axis=1)
    found = np.take_along_axis(albedo, some, axis=1)[..., None] * n[some]
    known = np.isfinite(np.take_along_axis(np.where(lowest, cost, np.inf), order, axis=1))
    known = np.concatenate([known, np.isfinite(np.take_along_axis(cost, drawn, axis=1))], axis=1)
    return np.concatenate([b[:, None], np.where(known[..., None], found, b[:, None])], axis=1)


def _neighbours(grid: Grid) -> Indices:
    """The pixels (P, 4) to the left, to the right, above and below; -1 where there is none."""
    found = np.full((len(grid.rows), 4), -1, np.int64)
    for axis, edges in enumerate((grid.horizontal, ~grid.horizontal)):
        found[grid.b[edges], 2 * axis] = grid.a[edges]
        found[grid.a[edges], 2 * axis + 1] = grid.b[edges]
    return found


@dataclass(frozen=True)
class _Beliefs:
    """Candidates of all pixels, what they cost, and what neighbours say of them; resampled in place."""

    x: Array
    """(P, PARTICLES, 3)."""
    u: Array
    """(P, PARTICLES)."""
    messages: Array
    """(P, PARTICLES, 4): those that came in."""
    beside: Indices
    """(P, 4)."""

    def best(self, some: Indices | slice = slice(None)) -> Array:
        """The candidates (Q, 3) of some pixels that are believed most."""
        least = (self.u[some] + self.messages[some].sum(axis=2)).argmin(axis=1)
        return np.asarray(np.take_along_axis(self.x[some], least[:, None, None], axis=1)[:, 0])

    def resample(self, here: Indices, costs: Costs, rng: np.random.Generator) -> None:
        """New candidates of some pixels (Q,), no two of them neighbours, with the messages about them."""
        beside = self.beside[here]
        theirs = self.best(np.maximum(beside, 0).ravel()).reshape(*beside.shape, 3)
        theirs = np.where((beside >= 0)[..., None], theirs, self.x[here, :1])
        which = rng.integers(0, PARTICLES, (len(here), PARTICLES // 2))
        wide = field.TURN / 2 * rng.random(which.shape)
        own = np.take_along_axis(self.x[here], which[..., None], axis=1)
        turned = own + (lambert.length(own) * wide)[..., None] * rng.normal(size=own.shape)
        new = np.concatenate([theirs, turned], axis=1)
        x = np.concatenate([self.x[here], new], axis=1)
        u = np.concatenate([self.u[here], costs.of(new)], axis=1)
        messages = np.stack([self._message(beside[:, side], side, x) for side in range(4)], axis=2)
        kept = _different(x, u + messages.sum(axis=2))
        self.x[here] = np.take_along_axis(x, kept[..., None], axis=1)
        self.u[here] = np.take_along_axis(u, kept, axis=1)
        self.messages[here] = np.take_along_axis(messages, kept[..., None], axis=1)

    def _message(self, there: Indices, side: int, x: Array) -> Array:
        """What the neighbours (Q,) on one side say of candidates x (Q, N, 3); 0 where there is none."""
        q = np.maximum(there, 0)
        back = side ^ 1  # the side on which they have this pixel
        known = self.u[q] + self.messages[q].sum(axis=2) - self.messages[q, :, back]
        found = _messages(x, self.x[q], known)
        return np.where(there[:, None] >= 0, found, 0.0)


def _messages(x: Array, y: Array, known: Array) -> Array:
    """What neighbours with candidates y (Q, K, 3), believed by `known` (Q, K), say of candidates x (Q, N, 3): (Q, N)."""
    if run := kernel("messages"):
        given = (np.ascontiguousarray(one, float) for one in (x, y, known))
        found = np.empty(x.shape[:2])
        run(*x.shape[:2], y.shape[1], *given, field.TURN**2, field.LINK2, found)
        return found
    square = field.apart(x[:, :, None], y[:, None])
    return np.asarray((known[:, None] + square / (1 + square / field.LINK2)).min(axis=2) - known.min(axis=1)[:, None])


def _different(x: Array, belief: Array) -> Indices:
    """The PARTICLES most believed (Q, PARTICLES) of candidates x (Q, N, 3), those that differ from each other first."""
    left, kept, each = belief.copy(), [], np.arange(len(x))
    albedo2 = lambert.dot(x, x)
    for _ in range(PARTICLES):
        one = left.argmin(axis=1)
        kept.append(one)
        off = x - x[each, one][:, None]
        left = np.where(lambert.dot(off, off) < (field.TURN / 8) ** 2 * albedo2, left + 1e6, left)  # one of them is enough
    return np.stack(kept, axis=1)
