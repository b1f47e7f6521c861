r"""Where an edge lies along many profiles at once, to a few hundredths of a pixel.

Symbols: s pixels outwards along a normal, edge at s0, t = s0 - s inwards, blur sigma::

    chrome   c0 + [c1 + c2 t + c3 t^2] step(t) blurred
    matte    c0 + c1 step(t) + c2 sqrt(1 - (1 - t / r)^2) blurred        r the radius in pixels: a limb darkens as its normals turn away

The coefficients are linear and projected out. On a grid of s0 the edge first is where the step explains most (far from the edge a smooth
profile has less misfit than the edge itself), then, about there, where the misfit is least, refined by a parabola. The blur is one for
all profiles, the one that fits most of them best. Source: variable projection (Golub, Pereyra 1973); limb of a Lambertian sphere.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.kernels.library import kernel

REACH_PX, SEARCH_PX, STEP_PX = 6.0, 2.5, 0.1
BLURS_PX = (0.4, 2.5)
INNER_SHARE, INNER_PX = {"chrome": 0.07, "matte": 0.12}, 2.5
"""Inwards a profile is looked at over this share of the radius, this far at least: a chrome rim mirrors the room in ever narrower rings."""
NEAR_PX = 1.0
"""The least misfit is looked for this far from where the step explains most."""
LARGE_RADIUS_PX, LARGEST_SCALE = 200.0, 3.0
"""Larger outlines are softer: all lengths above grow with the radius from here, up to so many times."""
COARSEST = 40
"""Places looked at on either side of the curve, at the most."""
SAME_PLACE_PX = 1e-9
"""Places nearer than this are one, in pixels: what rounding makes of sums of steps is far less."""
LEAST_CONTRAST = 4.0
BEST_SHARE = 0.8
SHARP_SHARE, SHARP_STEPS = 0.3, 5
"""An edge is sharp where its misfit rises within so many steps by this share of what those of the upper quarter rise: of 38 simulated
outlines the shift falls from .19 px to .05; with .1 it is .11, with .5 the fewer edges leave .06."""


@dataclass(frozen=True)
class Edges:
    """An edge a profile: offset outwards, whether there is one, step over noise, how fast the misfit rises beside it; the blur of all."""

    offset_px: Array
    found: Mask
    contrast: Array
    rise: Array
    blur_px: float

    @property
    def sharp(self) -> Mask:
        """Edges that are found and sharp: half of those found at least."""
        rises = self.rise[self.found]
        if not rises.size:
            return self.found
        return np.asarray(self.found & (self.rise >= min(SHARP_SHARE * np.quantile(rises, 0.75), np.median(rises))))


def match_edges(coefficients: Array, points: Array, normals: Array, kind: str, radius: float, search_px: float = 0.0) -> Edges:
    """Edges along the normals (K, 2) of a curve through points (K, 2) of an image.

    Parameters
    ----------
    coefficients : cubic spline coefficients (H, W) of the image
    kind : chrome | matte
    radius : of the outline, in pixels
    search_px : how far the curve may be off; 0: a few pixels
    """
    from scipy.optimize import minimize_scalar

    scale = edge_scale(radius)
    search = max(search_px, SEARCH_PX * scale)
    s = np.arange(-(REACH_PX * scale + search), REACH_PX * scale + search + STEP_PX / 2, STEP_PX * scale)
    profile, inside = _profiles(coefficients, points, normals, s)
    if not inside.any():
        return Edges(np.zeros(len(points)), inside, np.zeros(len(points)), np.zeros(len(points)), 0.0)
    offsets = np.linspace(-search, search, int(2 * np.ceil(min(search / (STEP_PX * scale), COARSEST))) + 1)
    step = STEP_PX * scale
    inner = float(np.clip(INNER_SHARE[kind] * radius, INNER_PX * scale, REACH_PX * scale))
    # half a step more, so that rounding never decides whether the last place counts
    window = _Window(profile, s, offsets, (round(inner / step) + 0.5) * step, REACH_PX * scale + 0.5 * step)
    smooth = window.misfits(_smooth_terms)

    def cost(blur: float) -> Array:
        misfit = window.misfits(lambda at: _edge_terms(at, blur, kind, radius, STEP_PX * scale))
        explains = offsets[np.argmin(misfit - smooth, axis=1)]
        far = np.abs(offsets - explains[:, None]) > max(NEAR_PX * scale, 1.5 * (offsets[1] - offsets[0]))
        return np.where(far, np.inf, misfit)

    def total(log_blur: float) -> float:
        least = np.sort(np.min(cost(float(np.exp(log_blur))), axis=1)[inside])
        return float(np.mean(least[: int(np.ceil(BEST_SHARE * least.size))]))

    bounds = (np.log(BLURS_PX[0] * scale), np.log(BLURS_PX[1] * scale))
    coarse = search_px > SEARCH_PX * scale
    blur = scale if coarse else float(np.exp(minimize_scalar(total, bounds=bounds, method="bounded", options={"xatol": 0.02}).x))
    misfits = cost(blur)
    offset, least = _lowest(misfits, offsets)
    contrast = window.contrast(offset, least)
    return Edges(offset, inside & (contrast > LEAST_CONTRAST) & (np.abs(offset) < 0.97 * search), contrast, _rise(misfits), blur)


def edge_scale(radius: float) -> float:
    """By how much the lengths above grow for an outline of a radius in pixels."""
    return float(np.clip(radius / LARGE_RADIUS_PX, 1.0, LARGEST_SCALE))


@dataclass(frozen=True)
class _Window:
    """Profiles (K, S) at places s (S,), looked at about each of the offsets from `inner` inwards to `outer` outwards."""

    profile: Array
    s: Array
    offsets: Array
    inner: float
    outer: float

    def misfits(self, terms: Callable[[Array], Array]) -> Array:
        """Squared misfit (K, offsets) of the profiles to terms about each offset; offsets a step apart share their terms."""
        if (run := kernel("slid")) and (slid := self._slid) is not None:
            first, away, profile = slid
            Q = np.ascontiguousarray(np.linalg.qr(terms(away))[0].T)
            found, work = np.empty((len(profile), len(self.offsets))), np.empty((len(Q), len(self.offsets)))
            run(*profile.shape, first, len(self.offsets), *Q.shape, profile, Q, work, found)
            return found
        columns, at, Q = [], np.zeros(0), np.zeros((0, 0))
        for away, part, square in self._parts:
            if len(away) != len(at) or np.abs(away - at).max() > SAME_PLACE_PX:
                at, Q = away, np.linalg.qr(terms(away))[0]
            along = part @ Q
            columns.append(square - np.einsum("kt,kt->k", along, along))
        return np.stack(columns, axis=1)

    @cached_property
    def _slid(self) -> tuple[int, Array, Array] | None:
        """The first offset's first place, places relative to it, and profiles without means; None where offsets are not steps apart."""
        near = [np.flatnonzero((self.s - one >= -self.inner) & (self.s - one <= self.outer)) for one in self.offsets]
        first = near[0]
        away = self.s[first] - self.offsets[0]
        for k, (one, offset) in enumerate(zip(near, self.offsets, strict=True)):
            if len(one) != len(first) or one[0] != first[0] + k or np.abs(self.s[one] - offset - away).max() > SAME_PLACE_PX:
                return None
        return int(first[0]), away, np.ascontiguousarray(self.profile - self.profile.mean(axis=1, keepdims=True))

    @cached_property
    def _parts(self) -> list[tuple[Array, Array, Array]]:
        """The places relative to each offset (n,), the profiles there without their means (K, n), and the sums of their squares (K,)."""
        found = []
        for offset in self.offsets:
            near = (self.s - offset >= -self.inner) & (self.s - offset <= self.outer)
            part = self.profile[:, near]
            part = part - part.mean(axis=1, keepdims=True)  # numerically kinder; the constant is one of the terms
            found.append((self.s[near] - offset, part, np.sum(part**2, axis=1)))
        return found

    def contrast(self, offset: Array, misfit: Array) -> Array:
        """Step (K,) across the edges over the noise that the misfit shows."""
        away = self.s[None] - offset[:, None]
        near = (away >= -self.inner) & (away <= self.outer)
        outer, inner = near & (away > self.outer / 3), near & (away < -self.inner / 3)
        step = np.sum(self.profile * inner, axis=1) / np.maximum(inner.sum(axis=1), 1)
        step -= np.sum(self.profile * outer, axis=1) / np.maximum(outer.sum(axis=1), 1)
        noise = np.sqrt(np.maximum(misfit, 0.0) / near.sum(axis=1))
        return np.asarray(np.abs(step) / np.maximum(noise, 1e-12))


def _profiles(coefficients: Array, points: Array, normals: Array, s: Array) -> tuple[Array, Mask]:
    """Profiles (K, S), and whether each lies in the image."""
    from scipy.ndimage import map_coordinates

    at = points[:, None] + s[:, None] * normals[:, None]
    height, width = coefficients.shape
    inside = np.all((at > 0) & (at < [width - 1, height - 1]), axis=(1, 2))
    return map_coordinates(coefficients, [at[..., 1], at[..., 0]], order=3, mode="mirror", prefilter=False), inside


def _lowest(cost: Array, offsets: Array) -> tuple[Array, Array]:
    """Offset (K,) of the least cost, by a parabola through it and its neighbours, and the cost there."""
    rows = np.arange(len(cost))
    k = np.clip(np.argmin(cost, axis=1), 1, len(offsets) - 2)
    below, least, above = cost[rows, k - 1], cost[rows, k], cost[rows, k + 1]
    curvature = below - 2 * least + above
    usable = np.isfinite(curvature) & (curvature > 0)
    with np.errstate(invalid="ignore"):
        shift = np.where(usable, 0.5 * (below - above) / np.where(usable, curvature, 1.0), 0.0)
    return offsets[k] + np.clip(shift, -1, 1) * (offsets[1] - offsets[0]), least


def _rise(cost: Array) -> Array:
    """How much (K,) the cost is above its least, SHARP_STEPS beside it, on the side where it is less."""
    rows, k = np.arange(len(cost)), np.argmin(cost, axis=1)
    beside = [cost[rows, np.clip(k + steps, 0, cost.shape[1] - 1)] for steps in (-SHARP_STEPS, SHARP_STEPS)]
    return np.asarray(np.minimum(*beside) - cost[rows, k])


def _smooth_terms(s: Array) -> Array:
    """Columns of a profile without an edge."""
    return np.stack([np.ones_like(s), s, s**2], axis=1)


def _edge_terms(s: Array, blur: float, kind: str, radius: float, step_px: float) -> Array:
    """Columns of the edge model at s pixels outwards of the edge, blurred."""
    fine = np.arange(s[0] - 5 * blur, s[-1] + 5 * blur + step_px / 2, step_px)
    step = np.clip(-fine / step_px + 0.5, 0.0, 1.0)
    inward = np.maximum(-fine, 0.0)
    if kind == "matte":
        terms = [step, np.sqrt(np.maximum(1 - (1 - np.minimum(inward / radius, 1.0)) ** 2, 0.0))]
    else:
        terms = [step, inward, inward**2]
    half = int(np.ceil(5 * blur / step_px))
    kernel = np.exp(-0.5 * (np.arange(-half, half + 1) * step_px / blur) ** 2)
    kernel /= kernel.sum()
    padded = [np.concatenate([np.full(half, term[0]), term, np.full(half, term[-1])]) for term in terms]
    blurred = [np.interp(s, fine, np.convolve(term, kernel, mode="valid")) for term in padded]
    return np.stack([np.ones_like(s), *blurred], axis=1)
