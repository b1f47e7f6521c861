r"""How bright the lights are and how they fall off with the angle: from matte spheres, by linear least squares in logarithms.

Symbols: light k, sphere s, block b of pixels, shading averaged over the block's own normals (a block's centre is not its mean)::

    log mean(data) = log I_k + log rho_s + delta_b + log lobe(theta) + log mean(max(n . d, 0) / r^2)

``delta_b`` (sd 2 %) takes the sphere's texture away, as every light sees the same block. The lobe is a known shape (the sum of the
blob's LEDs, else a cosine power) times the exponential of a smooth function of the angle, a Gaussian process that is 0 on the axis, times
one of the direction, a light its own, for what is not round.
Sources: Lambert's law with raw ambient light subtracted; Gaussian-process regression (Rasmussen, Williams 2006).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from lpcal.chain.refine_lights.samples import Samples
from lpcal.geometry import led_cluster, lobe_map
from lpcal.geometry.arrays import Array, Index
from lpcal.records.calibration import Lobe

TEXTURE_SD, MODEL_SD = 0.02, 0.003
KNOTS_RAD = np.radians(np.arange(0, 91, 2.5))
LOBE_SD, LOBE_LENGTH_RAD = 0.10, float(np.radians(8))
UNKNOWN_LOBE_SD, EXPONENT_SD = 0.15, 20.0
MAP_SD, MAP_LENGTH_RAD, MAP_SPACING_RAD, MAP_LEAST = 0.03, float(np.radians(5)), float(np.radians(2.5)), 1e-3
FREE_AXIS_SD, KNOWN_AXIS_SD = 1.5, 1e-3
"""How a lobe's logarithm may slope, a radian, for an axis that is only taken to face the focus: 20 degrees off a lobe of half power at 30
degrees; and for one that a wing states, whose map holds what is left."""
PLACE_FLOOR_M = 1e-5
"""No source is known better."""
DARKEST = 1e-6
"""A known lobe is not darker: its logarithm is used."""
ROBUST = 3.0
ROUNDS, SETTLED = 8, 0.01
"""Rounds at most, and the relative change of every sample's weight that ends them."""


@dataclass(frozen=True)
class ShadingFit:
    """Relative intensities and lobes."""

    intensity: Array
    """(L, C), mean over all 1; 1 for a light that no matte sphere shows."""
    intensity_std: Array
    """(L,), relative; NaN for such a light."""
    lobes: tuple[Lobe, ...]
    """A light each."""
    residual: dict[str, float]
    """Rms of data over model, as a fraction, by sphere."""
    log_lobe: Array
    """(N,) of each sample: what is left of its data for the lobe, albedo and intensity taken away."""
    log_intensity: Array
    """(L,) as fitted."""
    log_albedo: dict[int, float]
    """By sphere."""
    seen_rad: Array
    """(L,) largest angle from each light's axis that the spheres saw, NaN for a light that they did not."""
    volume_std: Array | None = None
    """(L,) of the log irradiance that intensity and lobe make, rms over the places asked for; NaN for a light that no sphere shows."""


def fit_shading(
    samples: Samples,
    known: Sequence[Lobe | None],
    names: Sequence[str],
    intensity_sd: float,
    *,
    with_maps: bool = True,
    axis_known: Sequence[bool] = (),
    volume: Volume | None = None,
) -> ShadingFit:
    """Intensities, lobes and albedos from block means.

    Parameters
    ----------
    known : the lobe that each light is known by beforehand, None where nothing is; lights of one lobe share what is found of it
    names : the spheres' names
    intensity_sd : prior of the relative intensity of a light
    with_maps : whether a light may be other than round; not needed where its LEDs are found one by one after
    axis_known : of each light, whether its axis is; one that is not may slope any way; none: all are
    volume : where the irradiance is to be right, and what is known of the sources' places, which are solved for with the rest
    """
    count = len(known)
    layout = _Layout(samples, known, intensity_sd, with_maps, axis_known or [True] * count, volume)
    target = samples.log_data - samples.log_geometry - layout.known
    block = np.unique(samples.block, return_inverse=True)[1]
    sigma = np.hypot(samples.relative_sigma, MODEL_SD)
    found, covariance, residual = _solve_with_blocks(layout.parts, target, sigma, block, layout.prior)
    intensity, std = _intensities(samples, found[:count], covariance[:count, :count])
    lobes = [layout.lobe(m, found) for m in range(len(layout.shapes))]
    lobe_alone = np.where(np.arange(found.size) < layout.lobe_start, 0.0, found)
    return ShadingFit(
        intensity=intensity,
        intensity_std=std,
        lobes=tuple(layout.with_map(lobes[m], k, found) for k, m in enumerate(layout.shape_of_light)),
        residual={names[s]: float(np.sqrt(np.mean(residual[samples.sphere == s] ** 2))) for s in layout.spheres},
        log_lobe=layout.known + _modelled(layout.parts, lobe_alone, target.size) + residual,
        log_intensity=found[:count],
        log_albedo={int(s): float(found[count + k]) for k, s in enumerate(layout.spheres)},
        seen_rad=np.array([max(samples.angle_rad[samples.light == k], default=np.nan) for k in range(count)]),
        volume_std=None if volume is None else layout.volume_std(volume, covariance),
    )


@dataclass(frozen=True)
class Volume:
    """Places at which each light's irradiance is to be right, and how uncertain sources change that and the shading."""

    angle_rad: Array
    """(L, N) from each light's axis."""
    around_rad: Array
    """(L, N) about it."""
    by_source: Array
    """(L, N, 3) derivative of the log irradiance by the source's place."""
    samples_by_source: Array
    """(M, 3) likewise of the samples' log shading."""
    covariance: Array
    """(3 L, 3 L) of the sources' places."""


@dataclass(frozen=True)
class _Part:
    """The design of one light: its samples (n,), the unknowns that they know (c,), and the derivatives (n, c)."""

    rows: Index
    columns: Index
    design: Array


class _Layout:
    """The unknowns, their prior, and the design, a light a part.

    In order: log intensity a light, log albedo a sphere, deviations a shape of lobe, the exponent of an unknown shape, map's modes a light.
    """

    def __init__(
        self,
        samples: Samples,
        known: Sequence[Lobe | None],
        intensity_sd: float,
        with_maps: bool,
        axis_known: Sequence[bool],
        volume: Volume | None,
    ) -> None:
        self.samples, self.count, self.volume = samples, len(known), volume
        self.shapes = list({id(lobe): lobe for lobe in known}.values())
        self.unknown = [m for m, lobe in enumerate(self.shapes) if lobe is None]
        self.shape_of_light = np.array([next(m for m, lobe in enumerate(self.shapes) if lobe is own) for own in known])
        self.spheres = np.unique(samples.sphere)
        self.lobe_start = self.count + len(self.spheres)
        self.exponent_start = self.lobe_start + len(self.shapes) * (len(KNOTS_RAD) - 1)
        self.map_start = self.exponent_start + len(self.unknown)
        self.known = np.zeros(samples.light.size)
        for k, lobe in enumerate(known):
            if lobe is not None:
                own = samples.light == k
                self.known[own] = np.log(np.maximum(lobe(samples.angle_rad[own]), DARKEST))
        self.node_rad, self.modes = np.zeros(0), np.zeros((0, 0))
        if with_maps:
            self.node_rad = lobe_map.nodes(float(samples.angle_rad.max()) + MAP_SPACING_RAD, MAP_SPACING_RAD)
            slopes = np.stack(np.meshgrid(self.node_rad, self.node_rad), axis=-1).reshape(-1, 2)
            self.modes = np.hstack([lobe_map.modes(self.node_rad, MAP_SD, MAP_LENGTH_RAD, MAP_LEAST), slopes])
        self.axis_sd = np.where(axis_known, KNOWN_AXIS_SD, FREE_AXIS_SD)
        self.source_start = self.map_start + self.count * self.modes.shape[1]
        self.parts = [self._part(k) for k in range(self.count)]
        self.prior = self._prior(intensity_sd)

    def _part(self, k: int) -> _Part:
        own = np.flatnonzero(self.samples.light == k)
        columns, design = self._of_light(k, self.samples.angle_rad[own], self.samples.around_rad[own])
        more, by_more = np.arange(self.count, self.lobe_start), (self.samples.sphere[own, None] == self.spheres).astype(float)
        if self.volume is not None:
            more = np.concatenate([more, self._source(k)])
            by_more = np.hstack([by_more, self.volume.samples_by_source[own]])
        return _Part(own, np.concatenate([columns, more]), np.hstack([design, by_more]))

    def _source(self, k: int) -> Index:
        return np.arange(self.source_start + 3 * k, self.source_start + 3 * k + 3)

    def _of_light(self, k: int, angle_rad: Array, around_rad: Array) -> tuple[Index, Array]:
        """Which unknowns (c,) make a light's intensity and lobe in directions (n,), and the derivatives (n, c) of its logarithm."""
        m, size = int(self.shape_of_light[k]), self.modes.shape[1]
        lobe, exponent = self._lobe_rows(m), [self.exponent_start + self.unknown.index(m)] if m in self.unknown else []
        around = np.arange(self.map_start + k * size, self.map_start + (k + 1) * size)
        columns = np.concatenate([[k], np.arange(lobe.start, lobe.stop), exponent, around])
        design = [np.ones((angle_rad.size, 1)), _interpolation(angle_rad)[:, 1:]]
        if exponent:
            design.append(np.log(np.maximum(np.cos(angle_rad), 1e-3))[:, None])
        if size:
            index, weight = lobe_map.corners(angle_rad, around_rad, self.node_rad)
            design.append(np.einsum("nc,ncm->nm", weight, self.modes[index]))
        return columns.astype(np.intp), np.hstack(design)

    def volume_std(self, volume: Volume, covariance: Array) -> Array:
        """Standard deviation (L,) of each light's log irradiance less the mean of all, rms over the places."""
        change = np.zeros((*volume.angle_rad.shape, len(covariance)))
        for k in range(self.count):
            columns, design = self._of_light(k, volume.angle_rad[k], volume.around_rad[k])
            change[k][:, columns] = design
            change[k][:, self._source(k)] = volume.by_source[k]
        seen = np.isin(np.arange(self.count), self.samples.light)
        change -= change[seen].mean(axis=(0, 1))
        variance = np.einsum("knp,knp->kn", change @ covariance, change).mean(axis=1)
        return np.where(seen, np.sqrt(variance), np.nan)

    def _prior(self, intensity_sd: float) -> Array:
        prior = np.eye(self.source_start + (0 if self.volume is None else 3 * self.count))
        prior[: self.map_start] = 0.0
        prior[: self.count, : self.count] = np.eye(self.count) / intensity_sd**2
        for m, lobe in enumerate(self.shapes):
            sd = UNKNOWN_LOBE_SD if lobe is None else LOBE_SD
            prior[self._lobe_rows(m), self._lobe_rows(m)] = np.linalg.inv(_smooth_covariance(sd))
        for row in range(self.exponent_start, self.map_start):
            prior[row, row] = 1 / EXPONENT_SD**2
        size = self.modes.shape[1]
        for k in range(self.count if size else 0):
            last = self.map_start + (k + 1) * size
            prior[last - 2 : last, last - 2 : last] = np.eye(2) / self.axis_sd[k] ** 2
        if self.volume is not None:
            covariance = self.volume.covariance + PLACE_FLOOR_M**2 * np.eye(3 * self.count)
            prior[self.source_start :, self.source_start :] = np.linalg.inv(covariance)
        return prior

    def with_map(self, lobe: Lobe, k: int, found: Array) -> Lobe:
        """The lobe with the factor over the directions of a light."""
        if not self.node_rad.size:
            return lobe
        size = self.modes.shape[1]
        own = self.modes @ found[self.map_start + k * size : self.map_start + (k + 1) * size]
        return replace(lobe, node_rad=self.node_rad, factor=np.exp(own).reshape(len(self.node_rad), -1))

    def _lobe_rows(self, m: int) -> slice:
        width = len(KNOTS_RAD) - 1
        return slice(self.lobe_start + m * width, self.lobe_start + (m + 1) * width)

    def lobe(self, m: int, found: Array) -> Lobe:
        """The known shape times what was found; beyond the largest angle seen the factor stays what it was there."""
        known, seen_rad = self.shapes[m], float(self.samples.angle_rad.max())
        deviation = np.concatenate([[0.0], found[self._lobe_rows(m)]])
        deviation = np.interp(np.minimum(KNOTS_RAD, seen_rad), KNOTS_RAD, deviation)
        if known is not None:
            base = known(KNOTS_RAD)
        else:
            exponent = found[self.exponent_start + self.unknown.index(m)]
            base = np.maximum(np.cos(KNOTS_RAD), 0.0) ** max(float(exponent), 0.0)
        return Lobe("table", angle_rad=KNOTS_RAD, value=base * np.exp(deviation))


def _intensities(samples: Samples, logs: Array, covariance: Array) -> tuple[Array, Array]:
    """Relative intensities (L, C), mean 1, and their standard deviations (L,); 1 and NaN for a light that no sphere shows."""
    count = len(logs)
    seen = np.isin(np.arange(count), samples.light)
    colour = np.ones((count, samples.colour.shape[1]))
    for k in np.flatnonzero(seen):
        colour[k] = np.median(samples.colour[samples.light == k], axis=0)
    colour /= colour[seen].mean(axis=0)
    intensity = np.where(seen, np.exp(logs) / np.mean(np.exp(logs[seen])), 1.0)[:, None] * colour
    centring = np.eye(count)[seen] - np.mean(np.eye(count)[seen], axis=0)
    std = np.full(count, np.nan)
    std[seen] = np.sqrt(np.diag(centring @ covariance @ centring.T))
    return intensity / intensity.mean(), std


@lru_cache
def lobe_of_leds(leds: int | None) -> Lobe | None:
    """The lobe of a LED mode, one object a mode; None of a mode that is not known."""
    if leds not in led_cluster.RINGS:
        return None
    return Lobe("table", angle_rad=KNOTS_RAD, value=led_cluster.mean_lobe(KNOTS_RAD, int(leds or 1)))


def _interpolation(angle_rad: Array) -> Array:
    """Weights (N, knots) of linear interpolation between the knots."""
    step = KNOTS_RAD[1] - KNOTS_RAD[0]
    return np.clip(1 - np.abs(angle_rad[:, None] - KNOTS_RAD) / step, 0.0, 1.0)


def _smooth_covariance(sd: float) -> Array:
    """Covariance of the smooth function at the knots but the first, given that it is 0 there."""
    gap = (KNOTS_RAD[:, None] - KNOTS_RAD) / LOBE_LENGTH_RAD
    K = sd**2 * np.exp(-0.5 * gap**2)
    return K[1:, 1:] - np.outer(K[1:, 0], K[0, 1:]) / K[0, 0] + (1e-4 * sd) ** 2 * np.eye(len(KNOTS_RAD) - 1)


def _modelled(parts: Sequence[_Part], found: Array, size: int) -> Array:
    """What the unknowns make of every sample (N,)."""
    model = np.zeros(size)
    for part in parts:
        model[part.rows] = part.design @ found[part.columns]
    return model


def _solve_with_blocks(parts: Sequence[_Part], target: Array, sigma: Array, block: Index, prior: Array) -> tuple[Array, Array, Array]:
    """Robust least squares with one more unknown a block (sd TEXTURE_SD), eliminated: estimate, covariance, residual.

    A light sees a block once at most.
    """
    from scipy.linalg import cho_factor, cho_solve

    blocks, weight = int(block.max()) + 1, 1 / sigma**2
    for _ in range(ROUNDS):
        N, g, mixed = prior.copy(), np.zeros(len(prior)), np.zeros((blocks, len(prior)))
        own = np.bincount(block, weights=weight, minlength=blocks) + 1 / TEXTURE_SD**2
        for part in parts:
            weighted = part.design * weight[part.rows, None]
            N[np.ix_(part.columns, part.columns)] += part.design.T @ weighted
            g[part.columns] += weighted.T @ target[part.rows]
            mixed[np.ix_(block[part.rows], part.columns)] += weighted
        g -= mixed.T @ (np.bincount(block, weights=weight * target, minlength=blocks) / own)
        mixed /= np.sqrt(own)[:, None]
        N -= mixed.T @ mixed
        root = cho_factor(N)
        found = cho_solve(root, g)
        left = target - _modelled(parts, found, target.size)
        residual = left - (np.bincount(block, weights=weight * left, minlength=blocks) / own)[block]
        scale = np.maximum(1.4826 * np.median(np.abs(residual / sigma)), 1.0)
        before, weight = weight, 1 / (sigma * scale) ** 2 / (1 + (residual / (ROBUST * sigma * scale)) ** 2)
        if np.max(np.abs(weight / before - 1)) < SETTLED:
            break
    return found, cho_solve(root, np.eye(len(prior))), residual
