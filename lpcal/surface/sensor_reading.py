r"""Fusion of a distance sensor's reading with near light's estimate, allowing for a beam that missed the object.

Symbols: beam o + t u, a piece with depths z(pixel) that may be scaled about the camera by s; at t the beam is over a pixel p(t) and meets
the scaled piece once its own depth passes the piece's::

    s(t) = (o_z + t u_z) / z(p(t))          t_hit(s) = the first t at which s(t) >= s

With r the reading as a distance along the beam, of variance v, and near light's estimate N(log s; 0, w^2), the two together on a grid of
s::

    p(s) ~ N(log s; 0, w^2) [ h N(r; t_hit(s), v) + (1 - h) / REACH ]

with h = 1 - OUTLIER_RATE where the beam meets the piece at all, else 0: it may have met the wall, a thread, nothing. So a reading that no
distance of the object explains changes nothing, and says so; where light allows several distances, each is weighted by the sum of its p(s).
Source: the mixture of a rangefinder's hit and its random readings, Thrun, Burgard & Fox, Probabilistic Robotics (2005), chapter 6.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.records.calibration import Calibration, Camera
from lpcal.records.distance import DistanceSensor
from lpcal.records.figures import DistanceRead
from lpcal.records.surface import Alternative, Component, Surface
from lpcal.surface.distance_search import APART, INDEPENDENT, DistanceMinima, odds_of
from lpcal.view.constants import OUTLIER, OUTLIER_RATE, STATED_STD, UNLIKELY

REACH_M = 2.0
"""Range, metres, of the uniform density of readings of something else: as far as such sensors reach."""
STEP_M = 5e-4
"""Step of the search along the beam, metres: less than a pixel's width on the object."""
NODES = 1201
"""Nodes of the grid of scales."""
SLOPE = 0.5
"""Tangent of a typical angle between the surface and the beam's cross-section: it converts lateral errors of the beam to range errors."""


@dataclass(frozen=True)
class Reading:
    """The distance sensor's reading of a capture."""

    sensor: DistanceSensor
    reading_m: float


def reading_of(calibration: Calibration, reading_m: float | None) -> Reading | None:
    """The reading of the calibration's sensor; None without a sensor or a reading."""
    sensor = calibration.distance_sensor
    return None if sensor is None or reading_m is None else Reading(sensor, reading_m)


@dataclass(frozen=True)
class DepthMap:
    """Depths (H, W) in pixels of `factor` camera pixels, NaN outside the piece."""

    depth: Array
    camera: Camera
    factor: int = 1

    def depth_at(self, x_C: Array) -> Array:
        """Depth (T,) at the pixels over which points (T, 3) lie; NaN where there is no object."""
        pixel = np.rint((self.camera.project(x_C) - (self.factor - 1) / 2) / self.factor)
        height, width = self.depth.shape
        inside = np.isfinite(pixel).all(axis=1) & (pixel >= 0).all(axis=1) & (pixel[:, 0] < width) & (pixel[:, 1] < height)
        column, row = np.where(inside[:, None], pixel, 0).astype(int).T
        return np.where(inside, self.depth[row, column], np.nan)


@dataclass(frozen=True)
class FusedDistance:
    """Posterior of a piece's scale from a reading and near light."""

    log_scale: float
    """Log of the factor by which the piece is scaled."""
    std: float
    """Relative standard deviation of its distance after fusion."""
    hit: float
    """Probability that the beam hit this piece."""
    log_evidence: float
    """Log marginal likelihood of the reading for this piece, to be compared between alternatives."""
    expected_m: float
    """Distance along the beam to the piece according to near light; NaN where the beam misses it."""


def fused(read: Reading, piece: DepthMap, light_std: float) -> FusedDistance:
    """Fuse a reading with near light's estimate of a piece's distance, of relative standard deviation `light_std`."""
    sensor, reading_m = read.sensor, read.reading_m
    r, std_m = sensor.along_m(reading_m), float(np.hypot(sensor.std_m(reading_m), SLOPE * sensor.across_std_m(reading_m)))
    half = max(2 * OUTLIER * light_std, 1e-3)
    grid = np.linspace(-half, half, NODES)
    t_hit = _hits(sensor, piece, np.exp(grid))
    light = np.exp(-0.5 * (grid / light_std) ** 2)
    light = light / light.sum()
    meets = np.isfinite(t_hit)
    near = np.where(meets, np.nan_to_num(np.exp(-0.5 * ((r - np.where(meets, t_hit, 0.0)) / std_m) ** 2)), 0.0)
    met = (1 - OUTLIER_RATE) * near / (std_m * np.sqrt(2 * np.pi))
    elsewhere = np.where(meets, OUTLIER_RATE, 1.0) / REACH_M
    evidence, hit = float(np.sum(light * (met + elsewhere))), float(np.sum(light * met))
    odds = hit / evidence
    weight = light * met / max(hit, 1e-300)
    mean = float(np.sum(weight * grid)) if odds > 0.5 else 0.0
    std = float(np.sqrt(np.sum(weight * (grid - mean) ** 2))) if odds > 0.5 else light_std
    middle = float(t_hit[NODES // 2])
    return FusedDistance(mean, std if std > 0 else light_std, odds, float(np.log(evidence)), middle)


def weighed(found: DistanceMinima | None, read: Reading | None, camera: Camera | None) -> DistanceMinima | None:
    """The minima of the distance search with the reading's evidence added to their costs, the most probable first."""
    if found is None or read is None or camera is None:
        return found
    costs = np.array([end.cost for end in found.ends])
    unit = max(float(costs.min()) / found.lights, 1.0) / INDEPENDENT
    said = []
    for end in found.ends:
        depth = np.full(found.mask.shape, np.nan)
        depth[found.mask] = np.exp(end.u)
        said.append(fused(read, DepthMap(depth, camera, found.factor), APART).log_evidence)
    less = 2 * unit * (max(said) - np.array(said))
    ends = [replace(end, cost=float(end.cost + more)) for end, more in zip(found.ends, less, strict=True)]
    odds = odds_of(ends, found.lights, found.about_m)
    return replace(found, ends=tuple(ends[k] for k in np.argsort(-odds)))


@dataclass(frozen=True)
class ReadingResult:
    """The result of a reading for a surface: the label of the piece it refers to (0: none), and the fused distance."""

    label: int
    fused: FusedDistance | None
    figures: DistanceRead
    alternatives: tuple[Alternative, ...] = ()
    """Alternative distances of that piece that remain probable."""


def of_surface(surface: Surface, camera: Camera, read: Reading) -> ReadingResult:
    """Fuse a reading with the surface found from the light, for the piece that the beam meets."""
    whole = DepthMap(np.asarray(surface.depth, float), camera)
    label = _label_met(read, whole, surface.component)
    if label == 0:
        return ReadingResult(0, None, DistanceRead(reading_m=read.reading_m, expected_m=float("nan"), hit=0.0, moved=0.0))
    own = next(one for one in surface.components if one.label == label)
    light_std = own.scale_std
    depth = np.where(surface.component == label, surface.depth, np.nan)
    found = fused(read, DepthMap(depth, camera), max(light_std, STATED_STD))
    expected_m = read.sensor.bias_m + read.sensor.scale * found.expected_m
    moved = float(np.expm1(found.log_scale))
    figures = DistanceRead(reading_m=read.reading_m, expected_m=expected_m, hit=found.hit, moved=moved)
    return ReadingResult(label, found, figures, _left(own, read, DepthMap(depth, camera), found))


def _left(own: Component, read: Reading, piece: DepthMap, found: FusedDistance) -> tuple[Alternative, ...]:
    """A piece's alternative distances with probabilities from light and reading, without those below UNLIKELY."""
    ratios = [1.0, *(other.mean_depth_m / own.mean_depth_m for other in own.alternatives)]
    odds = np.array([max(1 - sum(other.odds for other in own.alternatives), 1e-3), *(other.odds for other in own.alternatives)])
    here = np.exp(found.log_scale)
    said = [
        fused(read, replace(piece, depth=piece.depth * ratio * (here if k == 0 else 1.0)), STATED_STD) for k, ratio in enumerate(ratios)
    ]
    evidence = np.array([one.log_evidence for one in said])
    odds = odds * np.exp(evidence - evidence.max())
    odds = odds / odds.sum()
    both = zip(own.alternatives, odds[1:], strict=True)
    return tuple(replace(other, odds=float(one)) for other, one in both if one > UNLIKELY)


def with_reading(surface: Surface, said: ReadingResult) -> Surface:
    """The surface with its piece's updated standard deviation and alternatives, and the reading among its figures."""
    figures = replace(surface.figures, distance_reading=said.figures)
    if said.fused is None or said.fused.hit <= 0.5:
        return replace(surface, figures=figures)
    std = said.fused.std
    pieces = tuple(
        replace(one, scale_std=std, alternatives=tuple(replace(other, scale_std=std) for other in said.alternatives))
        if one.label == said.label
        else one
        for one in surface.components
    )
    return replace(surface, components=pieces, figures=figures)


def _label_met(read: Reading, piece: DepthMap, label: Labels) -> int:
    """Label (of labels (H, W)) of the piece that the beam meets first, or passes over nearest to the reading; 0 if there is none."""
    sensor = read.sensor
    t = np.arange(STEP_M, REACH_M, STEP_M)
    x_C = sensor.position_C + t[:, None] * sensor.direction_C
    depth = piece.depth_at(x_C)
    behind: Mask = np.isfinite(depth) & (x_C[:, 2] >= depth)
    if not behind.any():
        over = np.isfinite(depth)
        if not over.any():
            return 0
        first = int(np.flatnonzero(over)[np.argmin(np.abs(t[over] - sensor.along_m(read.reading_m)))])
    else:
        first = int(np.argmax(behind))
    pixel = np.rint(piece.camera.project(x_C[first][None])[0]).astype(int)
    return int(label[pixel[1], pixel[0]])


def _hits(sensor: DistanceSensor, piece: DepthMap, scales: Array) -> Array:
    """Distance along the beam (S,) to the piece scaled by each of the increasing scales (S,); NaN where the beam misses it."""
    t = np.arange(STEP_M, REACH_M, STEP_M)
    x_C = sensor.position_C + t[:, None] * sensor.direction_C
    ahead = x_C[:, 2] > 0.01
    t, x_C = t[ahead], x_C[ahead]
    if not len(t):
        return np.full(len(scales), np.nan)
    share = x_C[:, 2] / piece.depth_at(x_C)
    passed = np.maximum.accumulate(np.where(np.isfinite(share), share, -np.inf))
    first = np.searchsorted(passed, scales, side="left")
    found = np.where(first < len(t), t[np.minimum(first, len(t) - 1)], np.nan)
    begins = first == np.argmax(
        np.isfinite(share)
    )  # the beam comes over the object already behind it: it met its rim, or the side not seen
    behind = begins & (share[np.minimum(first, len(t) - 1)] > 1.02 * scales)
    return np.asarray(np.where(behind, np.nan, found))
