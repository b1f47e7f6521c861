r"""Normals and albedo as a regularised field: each pixel's samples, with a robust smoothness prior where they are insufficient.

Symbols: b_p = albedo times normal of pixel p; its sample k is lit (v = 1) or shadowed (v = 0), with B_k the direct and J_k the
interreflected light vector (see surface.interreflection), g_k its gloss, s_k its standard deviation::

    sum_pk  rho((I_k - g_k - (v B_k + J_k) . b_p) / s_k)  +  PRICE [v = 0]   +   sum_pq  rho(|b_p - b_q| / (TURN sqrt(a_p a_q)))

rho is the Geman-McClure loss. Where three or more lights reach a pixel, its samples dominate over its neighbours. With two lights, the
third component comes from the neighbours' albedo and normal; in shadow, from interreflected light. The energy is minimised by alternating
over the states of the samples (soft at first: deterministic annealing), the weights, and b (conjugate gradients). It starts from the
per-pixel estimates, without those dark enough to be shadows and those that differ from most of their neighbours. The object's gloss lobe is
fitted in the same rounds; the steps of b include its derivative by the normal (Gauss-Newton), as a highlight moves far when the normal
turns a little.

Sources: Geman and McClure 1987 (robust weights); Blake and Zisserman 1987, Visual Reconstruction (weak membranes); Hernandez, Vogiatzis and
Cipolla 2008 (shadows, and the neighbours' part in what they hide).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array, Mask
from lpcal.integration import pieces
from lpcal.integration.integrate import Grid
from lpcal.integration.multigrid import MOST, PRECISION
from lpcal.kernels.library import kernel
from lpcal.shading import gloss
from lpcal.shading.normals import Estimate, joined
from lpcal.view import parallel
from lpcal.view.constants import DOUBT, LEAST_COSINE, OUTLIER2
from lpcal.view.pixel_list import Illumination, PixelList

TURN = 0.15
"""Scale of the differences of neighbouring b, as a share of the albedo (9 degrees): with .1 or .25 the mean error of six simulated scenes
changes by some 5 %."""
LINK2 = 4.0
"""Scale of the smoothness loss: squared difference, in units of TURN, at which the weight of a link has fallen to a quarter."""
FRIENDS = 0.5
"""Least share of similar known neighbours of a pixel's initial value: at shadow edges half-shadowed samples give normals that differ from
pixel to pixel, from which the field does not recover. Three of four would exclude all thin parts (rig_a's teapot)."""
SHARED = 0.02
"""Relative standard deviation of the model's errors, of a sample and of its pixel's brightest one."""
DARK = SHARED / 2
"""As SHARED, for shadowed samples."""
PRICE = 5.0
"""Cost of a shadowed sample that the shape does not explain, and of a lit one where the depth predicts occlusion."""
WARM = PRICE
"""Initial temperature of the samples' states: at it, PRICE has almost no influence."""
JUNK, ACROSS = 0.5, 6.0
"""Share of the local mean brightness below which an initial value counts as shadow, and the object's extent over that window's radius."""
FIRST_ROUNDS, ROUNDS, GLOSS_ROUNDS = 6, 2, 8
"""Rounds from per-pixel estimates, rounds from an earlier field, and extra rounds if gloss is fitted, which converges slowly."""
STILL = 5e-4
"""Relative change of the field in a round below which the rounds end; a few pixels at the rim may oscillate forever."""
ANY_RAD = 0.12
"""Prior standard deviation, radians, of a normal that no sample determines (seven degrees). Half a radian would be more honest for a single
pixel and would let a dark fold be steep, but then the dark gap between two bodies no longer breaks (rig_a's spot and pair)."""


@dataclass(frozen=True)
class Field:
    """The field b of all pixels, with the per-pixel estimate and the gloss."""

    b: Array
    """(P, 3)."""
    estimate: Estimate
    """Per-pixel estimate from the samples that are lit according to the field; NaN where fewer than three, or coplanar lights."""
    gloss: gloss.Gloss | None
    tilt_rad: Array | None = None
    """(P,) standard deviation of the normal per axis from each pixel's own samples, radians; at most ANY_RAD."""


@dataclass(frozen=True)
class States:
    """States of the samples (L, P): residuals and variances if lit and if shadowed, and the probability of being lit."""

    lit: Array
    spread2: Array
    shadow: Array
    shadow_spread2: Array
    chance: Array


def solve(
    seen: PixelList,
    grid: Grid,
    lit: Illumination,
    hidden: Mask | None,
    start: Estimate | Field,
    glossy: float | None = None,
    rounds: int | None = None,
) -> Field:
    """Solve for the field from per-pixel estimates, or from an earlier field at a similar depth.

    `hidden` (L, P) are samples that the depth predicts to be occluded. `glossy` is the reflectance assumed of the object's median
    pixel, the scale of the gloss; None fits no gloss. `rounds` defaults to what the kind of start needs.
    """
    v = -seen.rays_C / lambert.length(seen.rays_C)[..., None]
    before = start if isinstance(start, Field) else None
    b = _begin(seen, grid, start.b) if before is None else before.b
    shine = None if before is None else before.gloss
    rounds = rounds or (ROUNDS if before is not None else FIRST_ROUNDS + GLOSS_ROUNDS * (glossy is not None))
    some = gloss.sample(seen.pixels)
    few, few_lit, few_hidden = seen.at(some), lit.at(some), None if hidden is None else hidden[:, some]
    albedo = lambert.length(b)
    own_samples = np.zeros((seen.pixels, 3, 3))
    for k in range(rounds):
        so_far, middle, last = b, np.median(albedo), k > 1 or before is not None
        if glossy is not None and last:
            state = states(few, few_lit, b[some], few_hidden, None, 1.0)
            counted = np.where(state.chance > 0.5, 1.0, 0.0) * few.usable
            shine = gloss.fit(state.lit, counted, state.spread2, few_lit, lambert.unit(b[some])[0], v[some], glossy / middle)
        warmth = WARM if before is None and k < FIRST_ROUNDS // 3 else 1.0
        own_samples, right = _gathered(seen, lit, b, v, hidden, shine, warmth)
        b = _System.at(grid, b, own_samples).solved(right, b)
        towards, albedo = lambert.dot(b, v), lambert.length(b)
        b = b + np.maximum(LEAST_COSINE * albedo - towards, 0.0)[:, None] * v
        if last and warmth == 1.0 and np.linalg.norm(b - so_far) <= STILL * np.linalg.norm(b):
            break

    return Field(b, _by_pixels(seen, lit, b, v, hidden, shine), shine, _tilt_rad(b, own_samples))


def _tilt_rad(b: Array, own: Array) -> Array:
    """Standard deviation (P,) of the normals per axis, radians, from the samples' normal matrices (P, 3, 3) and a prior of ANY_RAD."""
    n, albedo = lambert.unit(b)
    loose = 1 / np.maximum(albedo * ANY_RAD, 1e-12) ** 2
    held = own + loose[:, None, None] * np.eye(3)
    covariance = lambert.inverse_3x3(held)
    steep = np.isnan(covariance[:, 0, 0])  # one direction dominates so much that the prior is lost to rounding
    strength, axis = np.linalg.eigh(own[steep] / loose[steep, None, None])
    covariance[steep] = (axis / (np.maximum(strength, 0.0) + 1)[:, None]) @ axis.transpose(0, 2, 1) / loose[steep, None, None]
    across = lambert.trace(covariance) - np.einsum("pi,pij,pj->p", n, covariance, n)
    return np.asarray(np.sqrt(np.maximum(across, 0.0) / 2) / np.maximum(albedo, 1e-12))


def _begin(seen: PixelList, grid: Grid, b: Array) -> Array:
    """Initial values (P, 3): per-pixel estimates without shadows, the rest filled by interpolation."""
    known = np.isfinite(b[:, 0])
    albedo = np.where(known, lambert.length(np.nan_to_num(b)), 0.0)
    reach = np.sqrt(seen.pixels) / ACROSS
    picture = np.zeros(seen.mask.shape)
    picture[seen.mask] = albedo
    square, plain = (raster.gaussian_filtered(one, reach, "constant")[seen.mask] for one in (picture**2, picture))
    known &= albedo > JUNK * square / np.maximum(plain, 1e-12)
    return pieces.fill(grid, b, known & (alike(grid, b, known) >= FRIENDS))


def apart(x: Array, y: Array) -> Array:
    """Squared differences of b between x and y (..., 3), in units of TURN times their albedo."""
    both = lambert.length(x) * lambert.length(y) * TURN**2
    return np.asarray(lambert.dot(x - y, x - y) / np.maximum(both, 1e-300))


def alike(grid: Grid, b: Array, known: Mask) -> Array:
    """Share (P,) of a pixel's known neighbours with a similar b (P, 3), within LINK2; 1 where none is known."""
    both = known[grid.a] & known[grid.b]
    near = both & (apart(b[grid.a], b[grid.b]) < LINK2)
    like, of = (np.bincount(grid.a, one, len(b)) + np.bincount(grid.b, one, len(b)) for one in (near, both))
    return np.asarray(np.where(of > 0, like / np.maximum(of, 1), 1.0))


def shown_gloss(lit: Illumination, b: Array, v: Array, shine: gloss.Gloss | None) -> Array | None:
    """Gloss (L, P) predicted by the lobe."""
    return None if shine is None else shine.ks * lit.E * gloss.lobe(lit.d, lambert.unit(b)[0], v, shine.roughness)


def states(seen: PixelList, lit: Illumination, b: Array, hidden: Mask | None, shown: Array | None, warmth: float) -> States:
    """Residuals of the samples at b (P, 3), and their probabilities of being lit at a temperature `warmth`."""
    bright = np.maximum(lambert.dot(lit.direct, b), 0.0)
    interreflected = 0.0 if lit.interreflected is None else np.maximum(lambert.dot(lit.interreflected, b), 0.0)
    top = seen.signal.max(axis=0)
    left = seen.signal - interreflected if shown is None else seen.signal - interreflected - shown
    noise2 = seen.sigma**2 + (DOUBT * interreflected) ** 2
    spread2 = noise2 + (SHARED * seen.signal) ** 2 + (SHARED * top) ** 2
    if shown is not None:
        spread2 = spread2 + (DOUBT * shown) ** 2
    dark, dark2 = seen.signal - interreflected, noise2 + (DARK * top) ** 2
    against = dark**2 / dark2 + np.where(bright > 0, PRICE, 0.0) - (left - bright) ** 2 / spread2
    if hidden is not None:
        against = np.where(hidden, dark**2 / dark2 - (left - bright) ** 2 / spread2 - PRICE, against)
    chance = 1 / (1 + np.exp(-np.clip(against / (2 * warmth), -30, 30)))
    return States(left - bright, spread2, dark, dark2, chance)


def _weights(seen: PixelList, chance: Array, residual: Array, spread2: Array) -> Array:
    """Weights (L, P) of samples in the normal equations: the probability of the state times the robust weight of its residual."""
    return np.where(seen.usable, chance / (1 + residual**2 / spread2 / OUTLIER2) ** 2 / spread2, 0.0)


def _given(
    seen: PixelList, lit: Illumination, b: Array, v: Array, hidden: Mask | None, shine: gloss.Gloss | None, warmth: float = 1.0
) -> tuple[object, ...]:
    """Arguments of the kernels: samples, light, b (P, 3), directions to the viewer, and constants."""
    ks, roughness = (0.0, 1.0) if shine is None else (shine.ks, shine.roughness)
    constants = np.array([SHARED, SHARED, DARK, DOUBT, PRICE, PRICE, DOUBT, OUTLIER2, ks, roughness, warmth])
    alike = lit.d.strides[1] == lit.E.strides[1] == 0
    light = (lit.d[:, :1], lit.E[:, :1]) if alike else (lit.d, lit.E)
    d, E, signal, sigma, at, view = (np.ascontiguousarray(one, float) for one in (*light, seen.signal, seen.sigma, b, v))
    J = np.zeros(0) if lit.interreflected is None else np.ascontiguousarray(lit.interreflected, float)
    unlit = np.zeros(0, bool) if hidden is None else np.ascontiguousarray(hidden)
    usable = np.ascontiguousarray(seen.usable)
    return *signal.shape, alike, d, E, J.size > 0, J, signal, sigma, usable, unlit.size > 0, unlit, at, view, constants


def _gathered(
    seen: PixelList, lit: Illumination, b: Array, v: Array, hidden: Mask | None, shine: gloss.Gloss | None, warmth: float
) -> tuple[Array, Array]:
    """Normal equations of each pixel's own samples, with states and weights at b (P, 3): matrices (P, 3, 3), right sides (P, 3)."""
    if run := kernel("gathered"):
        given, own, right = _given(seen, lit, b, v, hidden, shine, warmth), np.empty((seen.pixels, 3, 3)), np.empty((seen.pixels, 3))
        parallel.run_bands(seen.pixels, len(seen.signal), lambda at: run(*given, at.start, at.stop, own, right))
        return own, right

    def of(at: slice) -> tuple[Array, Array]:
        return _gathered_of(seen.at(at), lit.at(at), b[at], v[at], None if hidden is None else hidden[:, at], shine, warmth)

    parts = parallel.run_bands(seen.pixels, len(seen.signal), of)
    return np.concatenate([own for own, _ in parts]), np.concatenate([right for _, right in parts])


def _gathered_of(
    seen: PixelList, lit: Illumination, b: Array, v: Array, hidden: Mask | None, shine: gloss.Gloss | None, warmth: float
) -> tuple[Array, Array]:
    """`_gathered` of some pixels."""
    shown = shown_gloss(lit, b, v, shine)
    state = states(seen, lit, b, hidden, shown, warmth)

    as_lit = _weights(seen, state.chance, state.lit, state.spread2)
    in_shadow = _weights(seen, 1 - state.chance, state.shadow, state.shadow_spread2)
    J = np.zeros_like(lit.d) if lit.interreflected is None else lit.interreflected
    B = np.where((lambert.dot(lit.direct, b) > 0)[..., None], lit.direct + J, J)
    if shine is not None:
        n, albedo = lambert.unit(b)
        B = B + (shine.ks * lit.E / np.maximum(albedo, 1e-12))[..., None] * gloss.turned(lit.d, n, v, shine.roughness)
    signal = seen.signal if shown is None else seen.signal - shown
    own = np.einsum("kp,kpi,kpj->pij", as_lit, B, B) + np.einsum("kp,kpi,kpj->pij", in_shadow, J, J)
    right = np.einsum("kp,kpi->pi", as_lit * signal, B) + np.einsum("kp,kpi->pi", in_shadow * seen.signal, J)
    return own, right


@dataclass(frozen=True)
class _System:
    """Normal equations of the energy at b (P, 3): the pixels' own samples, and the links between neighbours."""

    grid: Grid
    block: Array
    """(P, 3, 3)."""
    link: Array
    """(edges,) weights between neighbours."""

    @classmethod
    def at(cls, grid: Grid, b: Array, own: Array) -> _System:
        """The system of the own samples' matrices (P, 3, 3), with the links' weights at b."""
        if run := kernel("links"):
            link, block, work = np.empty(len(grid.a)), np.empty((len(b), 3, 3)), np.empty(len(b))
            given = (grid.a, grid.b, np.ascontiguousarray(b, float), np.ascontiguousarray(own, float))
            run(len(link), len(b), *given, TURN**2, LINK2, work, link, block)
            return cls(grid, block, link)
        albedo = np.maximum(lambert.length(b), 1e-12)
        both = albedo[grid.a] * albedo[grid.b]
        link = 1 / (both * TURN**2) / (1 + apart(b[grid.a], b[grid.b]) / LINK2) ** 2
        total = np.bincount(grid.a, link, len(b)) + np.bincount(grid.b, link, len(b))
        block = own.copy()
        block.reshape(-1, 9)[:, ::4] += total[:, None]
        return cls(grid, block, link)

    def times(self, x: Array) -> Array:
        """Matrix times x (P, 3)."""
        a, b = self.grid.a, self.grid.b
        around = [np.bincount(a, self.link * one[b], len(x)) + np.bincount(b, self.link * one[a], len(x)) for one in x.T]
        return np.asarray(np.einsum("pij,pj->pi", self.block, x) - np.stack(around, axis=1))

    def solved(self, right: Array, begin: Array) -> Array:
        """Solution x (P, 3) by conjugate gradients from an initial value `begin`.

        Each block of the preconditioner is raised by a share of its own trace: one of the largest trace buries the other pixels where
        the albedo of some has run away to nothing.
        """
        block = self.block
        if run := kernel("coupled"):
            stretches, (across, down) = self.grid.pyramid.levels[0].stretches, self.grid.pyramid.levels[0].by_pixel(self.link)
            x, work = np.array(begin, float), np.zeros(3 * (len(right) + 2) + 18 * len(right) + 12)
            given = (np.ascontiguousarray(one, float) for one in (block, across, down, right))
            run(len(right), len(stretches), stretches, *given, x, work, PRECISION * float(np.linalg.norm(right)), MOST, lambert.SINGULAR)
            return x
        from scipy.sparse import linalg

        raised = lambert.SINGULAR * lambert.trace(block) + np.finfo(float).tiny  # a block of zeros has no trace
        inverse = np.linalg.inv(block + raised[:, None, None] * np.eye(3))
        shape = (begin.size, begin.size)
        A = linalg.LinearOperator(shape, matvec=lambda x: self.times(x.reshape(-1, 3)).ravel(), dtype=float)
        M = linalg.LinearOperator(shape, matvec=lambda x: np.einsum("pij,pj->pi", inverse, x.reshape(-1, 3)).ravel(), dtype=float)
        found, _ = linalg.cg(A, right.ravel(), x0=begin.ravel(), M=M, rtol=PRECISION, maxiter=MOST)
        return np.asarray(found.reshape(-1, 3))


def strengths_seen(
    seen: PixelList, grid: Grid, lit: Illumination, hidden: Mask | None, before: Field, parts: Sequence[Array]
) -> tuple[Array, Array]:
    """Evidence of lit samples and the field's smoothness for the strengths of N parts of the light, each of light vectors (L, P, 3).

    With b eliminated (Schur complement of the normal equations) the energy of strengths x in addition to those in `lit` is the quadratic
    ``x . curvature x - 2 slope . x``; returns curvature (N, N) and slope (N,). The evidence comes from shadow edges on smooth surfaces and
    from pixels with few lights, where missing light would turn the normals.
    """
    own, pull, C, square, slope = _evidence(seen, lit, hidden, before, parts)
    system = _System.at(grid, before.b, own)
    smooth = system.times(before.b) - np.einsum("pij,pj->pi", own, before.b)
    answers = parallel.run_all(lambda one: system.solved(one, np.zeros_like(before.b)), (*C, pull - smooth))
    taken = np.array([[np.sum(one * answer) for answer in answers] for one in C])
    curvature = square - taken[:, :-1]
    return (curvature + curvature.T) / 2, slope - taken[:, -1]


def _evidence(
    seen: PixelList, lit: Illumination, hidden: Mask | None, before: Field, parts: Sequence[Array]
) -> tuple[Array, Array, Array, Array, Array]:
    """Joint normal equations of b and the strengths: own (P, 3, 3), pull (P, 3), across (N, P, 3), summed square (N, N), slope (N,)."""
    v = -seen.rays_C / lambert.length(seen.rays_C)[..., None]
    if run := kernel("evidence"):
        (L, P), N = seen.signal.shape, len(parts)
        given = (*_given(seen, lit, before.b, v, hidden, before.gloss), *(np.ascontiguousarray(one, float) for one in parts))
        own, pull, across = np.empty((P, 3, 3)), np.empty((P, 3)), np.empty((N, P, 3))

        def summed(at: slice) -> Array:
            sums = np.empty(N * N + N)
            run(*given, at.start, at.stop, own, pull, across, sums)
            return sums

        total = np.sum(parallel.run_bands(P, L, summed), axis=0)
        return own, pull, across, total[: N * N].reshape(N, N), total[N * N :]

    def of(at: slice) -> tuple[Array, Array, Array, Array, Array]:
        some, light, b = seen.at(at), lit.at(at), before.b[at]
        shown = shown_gloss(light, b, v[at], before.gloss)
        state = states(some, light, b, None if hidden is None else hidden[:, at], shown, 1.0)
        weight = _weights(some, state.chance, state.lit, state.spread2)
        own = np.einsum("kp,kpi,kpj->pij", weight, light.B, light.B)
        pull = np.einsum("kp,kpi->pi", weight * state.lit, light.B)
        column = np.stack([lambert.dot(part[:, at], b) for part in parts])
        across = np.einsum("kp,nkp,kpi->npi", weight, column, light.B)
        return own, pull, across, np.einsum("kp,nkp,mkp->nm", weight, column, column), np.einsum("kp,nkp->n", weight * state.lit, column)

    owns, pulls, acrosses, squares, slopes = zip(*parallel.run_bands(seen.pixels, len(seen.signal), of), strict=True)
    return np.concatenate(owns), np.concatenate(pulls), np.concatenate(acrosses, axis=1), sum(squares), sum(slopes)


def _by_pixels(seen: PixelList, lit: Illumination, b: Array, v: Array, hidden: Mask | None, shine: gloss.Gloss | None) -> Estimate:
    """Per-pixel estimates from the samples that the field predicts as lit and that agree with it."""
    if run := kernel("agreeing"):
        given, (L, P) = _given(seen, lit, b, v, hidden, shine), seen.signal.shape
        shown = np.empty((0, 0) if shine is None else (L, P))
        own, inliers, covariance, chi2, cost = np.empty((P, 3)), np.empty((L, P), bool), np.empty((P, 3, 3)), np.empty(P), np.empty(P)

        def work(at: slice) -> None:
            some = np.empty((3, L, 64))  # BLOCK of kernels/states.c
            run(*given, lambert.SINGULAR, at.start, at.stop, some, own, inliers, covariance, chi2, cost, shown)

        parallel.run_bands(P, L, work)
        return Estimate(own, inliers, covariance, chi2, cost, None if shine is None else shown)

    def of(at: slice) -> Estimate:
        return _of_pixels(seen.at(at), lit.at(at), b[at], v[at], None if hidden is None else hidden[:, at], shine)

    return joined(parallel.run_bands(seen.pixels, len(seen.signal), of))


def _of_pixels(seen: PixelList, lit: Illumination, b: Array, v: Array, hidden: Mask | None, shine: gloss.Gloss | None) -> Estimate:
    """`_by_pixels` of some pixels."""
    shown = shown_gloss(lit, b, v, shine)
    state = states(seen, lit, b, hidden, shown, 1.0)
    square = state.lit**2 / state.spread2
    reached = seen.usable & (lambert.dot(lit.direct, b) > 0)
    inliers = reached & (state.chance > 0.5) & (square < OUTLIER2)
    signal = seen.signal if shown is None else seen.signal - shown
    B = lit.B
    own, covariance = lambert.weighted(B, signal, inliers / state.spread2)
    square = (signal - lambert.predicted(B, np.nan_to_num(own))) ** 2 / state.spread2
    far = lambert.dot(np.nan_to_num(own), b) < 0
    good = (inliers.sum(axis=0) >= 3) & np.isfinite(own[:, 0]) & ~far
    return Estimate(
        np.where(good[:, None], own, np.nan),
        inliers,
        covariance,
        np.sum(np.where(inliers, square, 0.0), axis=0),
        np.sum(np.where(reached, np.minimum(square, OUTLIER2), 0.0), axis=0),
        shown,
    )
