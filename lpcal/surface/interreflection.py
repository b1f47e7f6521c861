r"""Interreflection: light that an object receives from its own parts and its surroundings, added to the light vectors.

Symbols: patch j of area A_j and normal n_j has the radiance that its pixels show, signal I_k(j) under light k; e_pj is the unit vector from
p to j at the distance r. Patches emit their observed signal, so a point p of normal n and reflectance a_p has the additional signal::

    a_p n . J_k(p),      J_k(p) = sum_j V_pj  e_pj  (e_jp . n_j) A_j / (pi r^2 + A_j)  I_k(j)

with the visibility V of p and j. As b = albedo times n in the units of the signals and ``a = s albedo`` with one factor s for the whole
capture, the signal is ``b . (B_k + s J_k)``: interreflection acts as additional light vectors, and the estimators need no change. J
contains all bounces, since I_k(j) does. The wall and the support are patches like the object's own (surface.surroundings); sides hidden
from the camera are modelled (surface.relief). s and the shares of the modelled light are estimated from shadowed samples, which contain
interreflected light alone, and from lit samples together with the smoothness of the surface (shading.field): posterior means over a grid,
with the reflectance of common matter as prior. Sources: Nayar, Ikeuchi and Kanade 1991, Int. J. Computer Vision 6; Cohen and Greenberg
1985 (form factors).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array, Mask
from lpcal.kernels.library import LANES, kernel
from lpcal.records.calibration import Light
from lpcal.shading import field
from lpcal.shading.normals import Estimate
from lpcal.surface import relief as body
from lpcal.surface.relief import Relief, interreflected_by_sides
from lpcal.surface.surroundings import Around, Patches
from lpcal.view import parallel
from lpcal.view.constants import DOUBT, LEAST_COSINE, MANY_PIXELS, NEIGHBOURS, OUTLIER_RATE, REGULARISATION, RIM_PX
from lpcal.view.pixel_list import Illumination, Indices, PixelList

STEPS = 6
"""Points between two patches at which occlusion is tested."""
BLOCK = 128
"""Patches processed in one kernel call, which makes the call's overhead negligible."""
OFF = 0.025
"""Share of the depth skipped at both ends of an occlusion ray, so that a patch does not occlude itself."""
REFLECTANCES = (0.03, *np.arange(0.05, 0.951, 0.05))
"""Grid of reflectances of the object's median pixel, from the darkest paints on."""
SHARES = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Grid of the shares of modelled light: that of the object's hidden sides, and that of surroundings out of sight."""
COMMON, COMMON_SIGMA = 0.5, 0.25
"""Prior mean and standard deviation of an object's reflectance."""
LIT_NEIGHBOURS = 4 * NEIGHBOURS
"""Lit samples that count as one independent: their own b absorbs most of the interreflection. With NEIGHBOURS itself rig_a's bunny
gets a reflectance of .18 (true: .49), and its depth is a quarter of a millimetre worse."""


@dataclass(frozen=True)
class Interreflection:
    """Interreflected light at P pixels under L lights, without the factor s of the reflectance."""

    seen: Array
    """J (L, P, 3) of the object's visible parts and visible surroundings."""
    sides: Array
    """J (L, P, 3) of the object's sides hidden from the camera, modelled as facing their lights."""
    beyond: Array | None
    """J (L, P, 3) of the planes' continuation out of the camera's sight."""
    unseen: Array
    """Cosine-weighted share (P,) of each pixel's surroundings that are sides of the object hidden from the camera."""

    def J(self, sides: float = 1.0, beyond: float = 1.0) -> Array:
        """Total J (L, P, 3), with shares of the modelled parts."""
        J = self.seen + sides * self.sides
        return J if self.beyond is None else J + beyond * self.beyond

    @property
    def parts(self) -> tuple[Array, Array, Array]:
        """J (L, P, 3) of the visible parts, of the hidden sides, and of what is out of sight."""
        return self.seen, self.sides, np.zeros_like(self.seen) if self.beyond is None else self.beyond

    def on(self, b: Array, light: Indices, pixel: Indices) -> tuple[Array, Array, Array]:
        """Signals (N,) that each of the three parts adds to samples of given light and pixel, for b (P, 3)."""
        seen, sides, further = (lambert.dot(J[light, pixel], b[pixel]) for J in self.parts)
        return seen, sides, further


@dataclass(frozen=True)
class Reflectance:
    """The object's reflectance, and the shares of the modelled light."""

    median: float
    """Reflectance of the object's median pixel."""
    per_unit: float
    """s: reflectance over albedo in the units of the signals."""
    sides: float
    beyond: float
    """Shares of the modelled light of the hidden sides and of what is out of sight."""

    @property
    def strengths(self) -> Array:
        """Factors (3,) of the three parts of J."""
        return self.per_unit * np.array([1.0, self.sides, self.beyond])


def interreflected(
    seen: PixelList, depth: Array, found: Estimate, n: Array, lights: Sequence[Light], around: Around | None = None
) -> Interreflection:
    """Interreflected light of a surface of depths (P,) and normals n (P, 3) with an estimate of its albedo, and of its surroundings."""
    joined = _Joined.of(seen, depth, n)
    x_C, n_C = joined.places
    own = Patches(x_C, n_C, joined.total, joined.means(found.diffuse(seen).T).T)
    relief = Relief.of(seen, depth)
    albedo = np.zeros(seen.mask.shape)
    albedo[seen.mask] = np.nan_to_num(lambert.length(found.b))
    by_unseen, unseen = interreflected_by_sides(own.x_C, own.n, relief, albedo, lights)
    at_patches = _received(own, own, relief)
    beyond = None
    if around is not None:
        at_patches = at_patches + _received(own, around.seen, relief)
        beyond = around.beyond(relief, lights)
    out_of_sight = None if beyond is None else joined.at_pixels(_received(own, beyond, relief))
    return Interreflection(joined.at_pixels(at_patches), joined.at_pixels(by_unseen), out_of_sight, joined.spread(unseen))


def from_around(seen: PixelList, depth: Array, n: Array, lights: Sequence[Light], around: Around) -> Array:
    """J (L, P, 3) from the visible surroundings of a surface of depths (P,) and normals n (P, 3), and half of that from out of sight."""
    joined = _Joined.of(seen, depth, n)
    x_C, n_C = joined.places
    own = Patches(x_C, n_C, joined.total, np.zeros((len(lights), len(x_C))))
    relief = Relief.of(seen, depth)
    found, beyond = _received(own, around.seen, relief), around.beyond(relief, lights)
    return joined.at_pixels(found if beyond is None else found + _received(own, beyond, relief) / 2)


@dataclass(frozen=True)
class _Joined:
    """An object's pixels joined to Q patches."""

    seen: PixelList
    size: int
    """Pixels of a patch along its side."""
    of_pixel: Indices
    area: Array
    """(P,) of each pixel."""
    total: Array
    """(Q,) of each patch."""
    inside: Array
    """(P,) share of what lies about a pixel that is the object."""
    places: tuple[Array, Array]
    """Points and normals (Q, 3)."""

    @staticmethod
    def of(seen: PixelList, depth: Array, n: Array) -> _Joined:
        """By depths (P,) and normals (P, 3)."""
        size = max(1, int(np.ceil(np.sqrt(seen.pixels / MANY_PIXELS))))
        rows, columns = (index - index.min() for index in np.nonzero(seen.mask))  # relative to the object's bounding box
        _, of_pixel = np.unique(rows // size * seen.mask.shape[1] + columns // size, return_inverse=True)
        area = _areas(seen, depth, n)
        inside = np.asarray(raster.gaussian_filtered(seen.mask.astype(float), size / 2, "constant")[seen.mask])
        bare = _Joined(seen, size, of_pixel, area, np.bincount(of_pixel, area), inside, (depth, depth))
        return replace(bare, places=(bare.means(seen.points_C(depth)), lambert.unit(bare.means(n))[0]))

    def means(self, values: Array) -> Array:
        """Mean (Q, ...) of values (P, ...) over the patches, by area."""
        return np.stack([np.bincount(self.of_pixel, self.area * column) for column in values.T], axis=-1) / self.total[:, None]

    def spread(self, values: Array) -> Array:
        """Values (..., P) of the patches' values (..., Q)."""
        many, reach = values.shape[:-1], self.size / 2
        blank = np.zeros((*many, *self.seen.mask.shape), np.float32)
        blank[..., self.seen.mask] = values[..., self.of_pixel]
        smooth = raster.gaussian_filtered(blank, (*(0.0,) * len(many), reach, reach), "constant")
        return np.asarray(smooth[..., self.seen.mask] / np.maximum(self.inside, 1e-6))

    def at_pixels(self, values: Array) -> Array:
        """Light vectors (L, P, 3) of those of the patches (L, Q, 3)."""
        return np.stack(parallel.run_all(lambda of_light: self.spread(of_light.T).T, values))


@dataclass(frozen=True)
class LitEvidence:
    """Quadratic cost of the strengths x (3,) of the three parts of J, from lit samples and the smoothness of the surface."""

    x0: Array
    """(3,) strengths about which curvature and slope are given."""
    curvature: Array
    slope: Array

    def cost(self, x: Array) -> Array:
        """Minus twice the log likelihood (N,) of strengths (N, 3)."""
        unit = max(float(self.x0[0]), 1e-12)
        curvature = self.curvature * unit**2 / LIT_NEIGHBOURS + REGULARISATION * np.eye(3)
        middle = np.linalg.solve(curvature, self.slope * unit / LIT_NEIGHBOURS)
        doubt = DOUBT * max(1 + float(middle[0]), 0.0)
        off = (x - self.x0) / unit - middle
        return np.asarray(np.einsum("ni,ij,nj->n", off, np.linalg.inv(np.linalg.inv(curvature) + doubt**2 * np.eye(3)), off))


def reflectance(seen: PixelList, by: Interreflection, b: Array, dark: Mask, lit: LitEvidence | None = None) -> Reflectance:
    """Estimate the reflectance from shadowed samples, and from the evidence of the lit ones.

    `dark` (L, P) are samples that are shadowed according to the shape: their whole signal is interreflected, ``s J_k . b``. A lit sample
    alone carries almost no information, since b absorbs most of the interreflection; together with its neighbours under other lights it
    does, which is what `lit` holds. The results are posterior means: where the evidence is weak, the minimum would jump.
    """
    albedo = lambert.length(b)
    middle, bright = np.median(albedo), np.percentile(albedo, 95)
    light, pixel = np.nonzero(dark & seen.usable)
    worth, some = len(pixel) / NEIGHBOURS, slice(None, None, max(1, len(pixel) // MANY_PIXELS))
    light, pixel = light[some], pixel[some]
    signal, top = seen.signal[light, pixel], np.maximum(seen.signal[:, pixel].max(axis=0), 1e-12)
    noise2 = seen.sigma[light, pixel] ** 2 + (field.DARK * top) ** 2
    possible = [one for one in REFLECTANCES if one * bright <= middle] or [REFLECTANCES[0]]  # no pixel reflects more than it receives
    trials = np.array(list(product(possible, SHARES, SHARES)))
    strengths = trials[:, :1] / middle * np.column_stack([np.ones(len(trials)), trials[:, 1:]])
    fits = _fits(strengths, np.stack(by.on(b, light, pixel)), signal, noise2, top)
    costs = -2 * worth / max(len(pixel), 1) * fits + ((trials[:, 0] - COMMON) / COMMON_SIGMA) ** 2
    if lit is not None:
        costs += lit.cost(strengths)
    odds = np.exp(-(costs - costs.min()) / 2)
    one, sides, beyond = np.average(trials * np.stack([np.ones(len(trials)), trials[:, 0], trials[:, 0]], axis=1), axis=0, weights=odds)
    return Reflectance(float(one), float(one / middle), float(sides / max(one, 1e-9)), float(beyond / max(one, 1e-9)))


def _fits(strengths: Array, parts: Array, signal: Array, noise2: Array, top: Array) -> Array:
    """Log likelihoods (T,) of shadowed signals (N,) predicted from the parts (3, N) of interreflected light at strengths (T, 3)."""
    if run := kernel("thrown_fits"):
        found = np.empty(len(strengths))
        given = (np.ascontiguousarray(one, float) for one in (strengths, parts, signal, noise2, top))
        run(len(strengths), len(signal), *given, DOUBT, OUTLIER_RATE, found)
        return found
    fits = []
    for one in strengths:
        interreflected = one @ parts
        variance = noise2 + (DOUBT * interreflected) ** 2
        density = np.exp(-((signal - interreflected) ** 2) / (2 * variance)) / np.sqrt(2 * np.pi * variance)
        fits.append(np.log((1 - OUTLIER_RATE) * density + OUTLIER_RATE / top).sum())
    return np.array(fits)


def in_shadow(seen: PixelList, lit: Illumination, n: Array, hidden: Mask) -> Mask:
    """Mask (L, P) of samples well inside cast (`hidden`) or attached shadows, for normals n (P, 3)."""
    dark = hidden | (lambert.dot(lit.d, n) < -LEAST_COSINE)
    found = np.zeros_like(dark)
    for k, one in enumerate(dark):
        found[k] = raster.eroded(np.asarray(seen.map(one, False), bool), RIM_PX)[seen.mask]
    return found


def _areas(seen: PixelList, depth: Array, n: Array) -> Array:
    """Area (P,) of the surface that each pixel sees."""
    length = lambert.length(seen.rays_C)
    towards = np.maximum(-lambert.dot(n, seen.rays_C) / length, LEAST_COSINE)
    _, columns = np.nonzero(seen.mask)
    step = lambert.length(np.diff(seen.rays_C, axis=0))[np.diff(columns) == 1]
    pixel = float(np.median(step)) if step.size else 1e-3
    return np.asarray((depth * pixel) ** 2 / (length * towards))


def _received(at: Patches, of: Patches, relief: Relief) -> Array:
    """J (L, Q, 3) at patches `at` from the patches `of`."""
    found = np.zeros((len(of.signal), *at.x_C.shape))
    if run := kernel("received"):
        signal = np.pad(of.signal.T, ((0, 0), (0, -len(of.signal) % LANES)))
        patches = [np.ascontiguousarray(one) for one in (at.x_C, at.n, of.x_C.T, of.n.T, of.area, signal)]
        between = (*relief.front.shape, relief.front, relief.pixel_of_ray, STEPS, body.TOLERANCE, body.THICKNESS)

        def of_band(some: slice) -> None:
            run(*found.shape[:2], len(of.x_C), *patches, found, *between, LEAST_COSINE, OFF, some.start, some.stop)

        parallel.run_bands(len(at.x_C), parallel.SAMPLES // BLOCK, of_band)
        return found
    for some in parallel.bands(len(at.x_C), parallel.SAMPLES // BLOCK):
        e = of.x_C[None] - at.x_C[some, None]
        square = np.maximum(lambert.dot(e, e), 1e-18)
        e /= np.sqrt(square)[..., None]
        leaving = -np.einsum("pqi,qi->pq", e, of.n)
        face = (np.einsum("pqi,pi->pq", e, at.n[some]) > LEAST_COSINE) & (leaving > LEAST_COSINE)
        p, q = np.nonzero(face)
        off = np.minimum(OFF * at.x_C[some][p, 2] / np.sqrt(square[p, q]), 0.5)[:, None]
        way = of.x_C[q] - at.x_C[some][p]
        face[p, q] = ~relief.hidden(at.x_C[some][p] + off * way, of.x_C[q] - off * way, STEPS)
        factor = np.where(face, leaving * of.area / (np.pi * square + of.area), 0.0)
        found[:, some] = np.stack([of.signal @ (factor * e[..., axis]).T for axis in range(3)], axis=-1)
    return found
