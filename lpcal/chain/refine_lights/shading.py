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
MAP_SD, MAP_LENGTH_RAD, MAP_SPACING_RAD = 0.03, float(np.radians(5)), float(np.radians(2.5))
DARKEST = 1e-6
"""A known lobe is not darker: its logarithm is used."""
ROBUST = 3.0
ROUNDS = 8


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


def fit_shading(samples: Samples, known: Sequence[Lobe | None], names: Sequence[str], intensity_sd: float) -> ShadingFit:
    """Intensities, lobes and albedos from block means.

    Parameters
    ----------
    known : the lobe that each light is known by beforehand, None where nothing is; lights of one lobe share what is found of it
    names : the spheres' names
    intensity_sd : prior of the relative intensity of a light
    """
    count = len(known)
    layout = _Layout(samples, known, intensity_sd)
    target = samples.log_data - samples.log_geometry - layout.known
    block = np.unique(samples.block, return_inverse=True)[1]
    sigma = np.hypot(samples.relative_sigma, MODEL_SD)
    found, covariance, residual = _solve_with_blocks(layout.design, target, sigma, block, layout.prior)
    intensity, std = _intensities(samples, found[:count], covariance[:count, :count])
    lobes = [layout.lobe(m, found) for m in range(len(layout.shapes))]
    rows = slice(layout.lobe_start, None)
    return ShadingFit(
        intensity=intensity,
        intensity_std=std,
        lobes=tuple(layout.with_map(lobes[m], k, found) for k, m in enumerate(layout.shape_of_light)),
        residual={names[s]: float(np.sqrt(np.mean(residual[samples.sphere == s] ** 2))) for s in layout.spheres},
        log_lobe=layout.known + layout.design[:, rows] @ found[rows] + residual,
        log_intensity=found[:count],
        log_albedo={int(s): float(found[count + k]) for k, s in enumerate(layout.spheres)},
        seen_rad=np.array([max(samples.angle_rad[samples.light == k], default=np.nan) for k in range(count)]),
    )


class _Layout:
    """The unknowns in order: log intensity a light, log albedo a sphere, lobe deviations a shape, the exponent of an unknown shape."""

    def __init__(self, samples: Samples, known: Sequence[Lobe | None], intensity_sd: float) -> None:
        self.samples, count = samples, len(known)
        self.shapes = list({id(lobe): lobe for lobe in known}.values())
        self.unknown = [m for m, lobe in enumerate(self.shapes) if lobe is None]
        self.shape_of_light = np.array([next(m for m, lobe in enumerate(self.shapes) if lobe is own) for own in known])
        self.spheres = np.unique(samples.sphere)
        self.lobe_start = count + len(self.spheres)
        own = [self.shape_of_light[samples.light] == m for m in range(len(self.shapes))]
        weights, log_cosine = _interpolation(samples.angle_rad)[:, 1:], np.log(np.maximum(np.cos(samples.angle_rad), 1e-3))
        self.known = np.zeros(samples.light.size)
        for mine, lobe in zip(own, self.shapes, strict=True):
            if lobe is not None:
                self.known += np.where(mine, np.log(np.maximum(lobe(samples.angle_rad), DARKEST)), 0.0)
        self.design = np.column_stack(
            [
                np.eye(count)[samples.light],
                (samples.sphere[:, None] == self.spheres).astype(float),
                *(weights * mine[:, None] for mine in own),
                *(log_cosine * own[m] for m in self.unknown),
            ]
        )
        self.node_rad = lobe_map.nodes(float(samples.angle_rad.max()) + MAP_SPACING_RAD, MAP_SPACING_RAD)
        self.map_start, self.map_size = self.design.shape[1], len(self.node_rad) ** 2
        self.design = np.hstack([self.design, self._map_columns(count)])
        self.prior = np.zeros((self.design.shape[1],) * 2)
        map_precision = np.linalg.inv(lobe_map.smooth_covariance(self.node_rad, MAP_SD, MAP_LENGTH_RAD))
        for k in range(count):
            rows = slice(self.map_start + k * self.map_size, self.map_start + (k + 1) * self.map_size)
            self.prior[rows, rows] += map_precision
        self.prior[:count, :count] += np.eye(count) / intensity_sd**2
        for m, lobe in enumerate(self.shapes):
            sd = UNKNOWN_LOBE_SD if lobe is None else LOBE_SD
            self.prior[self._lobe_rows(m), self._lobe_rows(m)] += np.linalg.inv(_smooth_covariance(sd))
        for row in range(self.map_start - len(self.unknown), self.map_start):
            self.prior[row, row] += 1 / EXPONENT_SD**2

    def _map_columns(self, count: int) -> Array:
        index, weight = lobe_map.corners(self.samples.angle_rad, self.samples.around_rad, self.node_rad)
        columns = np.zeros((len(index), count * self.map_size))
        np.add.at(columns, (np.arange(len(index))[:, None], self.samples.light[:, None] * self.map_size + index), weight)
        return columns

    def with_map(self, lobe: Lobe, k: int, found: Array) -> Lobe:
        """The lobe with the factor over the directions of a light."""
        own = found[self.map_start + k * self.map_size : self.map_start + (k + 1) * self.map_size]
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
            exponent = found[self.map_start - len(self.unknown) + self.unknown.index(m)]
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


def _solve_with_blocks(design: Array, target: Array, sigma: Array, block: Index, prior: Array) -> tuple[Array, Array, Array]:
    """Robust least squares with one more unknown a block (sd TEXTURE_SD), eliminated: estimate, covariance, residual."""
    from scipy.sparse import csr_array

    D = csr_array(design)
    members = csr_array((np.ones(block.size), (block, np.arange(block.size))))
    weight = 1 / sigma**2
    found, residual, N = np.zeros(design.shape[1]), target, prior
    for _ in range(ROUNDS):
        WD = D.multiply(weight[:, None]).tocsr()
        own = members @ weight + 1 / TEXTURE_SD**2
        mixed = members @ WD
        N = (D.T @ WD - mixed.T @ mixed.multiply(1 / own[:, None]).tocsr()).toarray() + prior
        found = np.linalg.solve(N, WD.T @ target - mixed.T @ ((members @ (weight * target)) / own))
        left = target - D @ found
        residual = left - ((members @ (weight * left)) / own)[block]
        scale = np.maximum(1.4826 * np.median(np.abs(residual / sigma)), 1.0)
        weight = 1 / (sigma * scale) ** 2 / (1 + (residual / (ROBUST * sigma * scale)) ** 2)
    return found, np.linalg.inv(N), residual
