r"""The ambient (room) light of a capture without an ambient image, estimated over wall, support and object alike.

The binned image is explained as surfaces of any normal, as planes, or as places that no lamp reaches, for one ambient level after another
(see segmentation.ambient_sample_costs). The level of least total cost is the room's, and each pixel's best explanation gives its ambient
part A. The capture without A is then treated as one whose ambient image was subtracted.

Model errors are smooth over a surface and change the cost by more than noise does, so the curvature of the cost says little about the
uncertainty of the level; the disagreement between parts of the image does. It is measured by the block bootstrap (Kunsch 1989, Ann.
Statist. 17; of posteriors, Buhlmann 2014, Statist. Sci. 29). There are two priors: usual levels of rooms, and that a place which no lamp
reaches is matter under the same ambient light, which reflects about as much of it as the object does.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Light
from lpcal.segmentation import ambient_sample_costs, layers, plane_hough
from lpcal.segmentation.features import SPARED
from lpcal.view.coarse import Coarse, LightTable, RoomPrior, coarse_of, factor_of
from lpcal.view.constants import CERTAIN, COARSE_PIXELS, FEWEST_PIXELS
from lpcal.view.pixel_list import SignalMaps, second, strength

FEW_PIXELS = COARSE_PIXELS // 4
"""Pixels of the binned image on which levels are tried: half as many along a side as for the map of A."""
LEVELS = (0.005, 0.015, 0.045, 0.13, 0.4, 1.2)
"""Levels tried, in units of a lamp's irradiance at the working distance: from invisible to a lit room."""
RARE_ROUNDS = 2
"""Times that each explanation's prior is re-estimated from its share of the pixels, so that a plane fitting few pixels by chance gains
nothing."""
USUAL, USUAL_STD = 0.1, 1.3
"""Prior of the level: median of common rooms in these units, and standard deviation of its natural log."""
FAR_STD = 0.8
"""Standard deviation of the log ratio of a distant wall's albedo to the object's, each from 0.2 to 0.8; some walls are as dark as cloth."""
DRAWS = 100
"""Bootstrap samples of the image's blocks: their standard deviation is then right to a tenth."""
SHARED = 60.0
"""Pixels or samples that count as one independent: errors of the model are correlated over a surface."""
UNSURE = 0.1
"""Additional relative standard deviation of the ambient light: of a pixel's A, as measured on simulated scenes, and of the level."""


@dataclass(frozen=True)
class RoomLight:
    """The ambient light of a capture."""

    room: RoomPrior
    level_std: float
    """Standard deviation of the logarithm of the level."""
    A: Image
    """(H, W) ambient part of every pixel, in units of the signals."""


@dataclass(frozen=True)
class Explained:
    """The best explanations of P coarse pixels at one ambient level."""

    cost: Array
    """(P,)."""
    A: Array
    """(P,)."""
    far: Mask
    """(P,) mask of places that no lamp reaches."""
    matter: Mask
    """(P,) mask of surfaces of free normal."""
    size: Array
    """(P,) |b| of the fit with a free normal."""

    def as_far(self) -> float | None:
        """The level (A of |b| = 1) at which the object would reflect as much ambient light as the places that no lamp reaches.

        None where there are too few pixels of either.
        """
        if min(self.far.sum(), self.matter.sum()) < FEWEST_PIXELS:
            return None
        return float(np.median(self.A[self.far]) / max(np.median(self.size[self.matter]), 1e-20))


def found(maps: SignalMaps, rays_C: Array, lights: Sequence[Light], distance_m: float) -> RoomLight:
    """The ambient light of a capture with near lights, the object at about `distance_m`."""
    share = np.array([1 / light.intensity.mean() for light in lights])
    few = coarse_of(maps, rays_C, factor_of(maps, FEW_PIXELS))
    table = LightTable.of(few, lights, distance_m)
    unit = float(np.median(lambert.length(table.at(np.full(len(few.rays_C), np.log(distance_m)), np.arange(len(few.rays_C)))[0])))

    def explained(level: float) -> Explained:
        return _explained(few, RoomPrior(share, level * unit), table, distance_m, drawn=False)

    level, level_std = _level(explained, few.shape, unit)
    room = RoomPrior(share, unit * level)
    image = coarse_of(maps, rays_C, factor_of(maps, COARSE_PIXELS))
    A = _explained(image, room, LightTable.of(image, lights, distance_m), distance_m, drawn=True).A
    return RoomLight(room, level_std, _spread(A, image, share, maps))


def taken_away(maps: SignalMaps, light: RoomLight) -> SignalMaps:
    """The maps with the ambient light subtracted and its uncertainty added to the noise."""
    ambient = light.room.share[:, None, None].astype(np.float32) * light.A
    return SignalMaps(maps.signal - ambient, np.hypot(maps.sigma, np.float32(UNSURE) * ambient), maps.usable)


def _explained(seen: Coarse, room: RoomPrior, table: LightTable, distance_m: float, *, drawn: bool) -> Explained:
    """Explanations of the coarse pixels at the level of `room`.

    `drawn`: with a label map of short boundaries, from all depths of the sweep; else pixel by pixel, from every other depth.
    """
    image = replace(seen, room=room)
    everywhere = np.arange(len(image.rays_C))
    swept = plane_hough.sweep(image, table, distance_m, 1 if drawn else 2)
    least = ambient_sample_costs.lowest(image.signal, image.usable, room)
    over = image.signal - room.share[:, None] * least > CERTAIN * image.sigma
    lit = np.sum(over & image.usable, axis=0) >= 2
    best = np.argmin(swept.cost, axis=0)
    B, doubt = table.at(swept.u[best], everywhere)
    free = ambient_sample_costs.free(image.signal, image.sigma, image.usable, B, doubt, room)
    costs, ambient = [free.cost + layers.FREE_PRICE], [free.A]
    for q in plane_hough.find(image, table, swept, lit, distance_m):
        m, doubt = plane_hough.white(q, image.rays_C, everywhere, table)
        cost, _, _, A = ambient_sample_costs.planar(image.signal, image.sigma, image.usable, m, doubt, room)
        costs.append(cost)
        ambient.append(A)
    E = lambert.length(table.at(np.full(len(everywhere), np.log(distance_m)), everywhere)[0])
    bright = np.max(np.where(image.usable, image.signal / np.maximum(E, 1e-12), 0.0), axis=0)
    around = np.median(bright[lit]) * E if lit.any() else np.median(bright) * E
    cost, A = ambient_sample_costs.nothing(image.signal, image.sigma, image.usable, around, room)
    every, each = np.stack([*costs, cost]), np.stack([*ambient, A])
    for _ in range(RARE_ROUNDS):
        part = np.bincount(np.argmin(every, axis=0), minlength=len(every)) / every.shape[1]
        every = np.stack([*costs, cost]) - 2 * np.log(np.maximum(part, 1 / every.shape[1]))[:, None]
    bounded = np.minimum(every, every.min(axis=0) + SPARED).reshape(-1, *image.shape)
    labels = (layers.cheapest(bounded, *layers.boundary(strength(image.maps))) if drawn else np.argmin(bounded, axis=0)).ravel()
    size = lambert.length(free.b)
    return Explained(every.min(axis=0), each[labels, everywhere], labels == len(every) - 1, labels == 0, size)


def _level(explained: Callable[[float], Explained], shape: tuple[int, int], unit: float) -> tuple[float, float]:
    """The level and the standard deviation of its log, for an image of `shape` that `explained` explains at a given level.

    LEVELS are tried first, then the midpoints (in log) to the neighbours of the best. `unit` is a lamp's irradiance.
    """
    tried = {level: explained(level) for level in LEVELS}
    cost = {level: float(one.cost.sum()) / SHARED + (np.log(level / USUAL) / USUAL_STD) ** 2 for level, one in tried.items()}
    k = min(max(LEVELS.index(min(cost, key=cost.__getitem__)), 1), len(LEVELS) - 2)
    tried |= {level: explained(level) for level in np.sqrt(np.multiply(LEVELS[k - 1 : k + 1], LEVELS[k : k + 2])).tolist()}
    levels = sorted(tried)
    x = np.log(levels)
    middle, std = _by_blocks(x, np.stack([tried[level].cost for level in levels]).reshape(-1, *shape))
    std = float(np.hypot(std, UNSURE))
    as_far = tried[levels[int(np.argmin(np.abs(x - middle)))]].as_far()
    if as_far is None or as_far <= 0:
        return float(np.exp(middle)), std
    at = np.linspace(x[0] - USUAL_STD, x[-1] + USUAL_STD, 500)
    over2 = ((at - np.log(as_far / unit)) / FAR_STD) ** 2
    far = np.where(at < np.log(as_far / unit), over2, 2 * np.log1p(over2 / 2))
    middle, std = _moments(at, ((at - middle) / std) ** 2 + far)
    return float(np.exp(middle)), std


def _by_blocks(x: Array, cost: Array) -> tuple[float, float]:
    """Mean and standard deviation of x (N,) from costs (N, rows, columns) and the prior of usual rooms, by the block bootstrap.

    For each bootstrap sample a parabola through the least cost and its neighbours gives a mean and a variance; the law of total variance
    combines them.
    """
    side = round(SHARED**0.5)
    row, column = (np.arange(length) // side for length in cost.shape[1:])
    block = (row[:, None] * (column[-1] + 1) + column).ravel()
    by_block = np.stack([np.bincount(block, one.ravel()) for one in cost]) / SHARED
    count = by_block.shape[1]
    drawn = np.random.default_rng(0).multinomial(count, np.full(count, 1 / count), DRAWS)
    said = np.array([_said(x, one) for one in drawn @ by_block.T])
    return float(said[:, 0].mean()), float(np.sqrt(said[:, 0].var() + said[:, 1].mean()))


def _said(x: Array, cost: Array) -> tuple[float, float]:
    """Mean and variance of x (N,) from costs (N,), minus twice a log likelihood, and the prior of usual rooms."""
    k = min(max(int(np.argmin(cost)), 1), len(x) - 2)
    usual = np.log(USUAL) - x[k]
    curve, slope, _ = np.polyfit(x[k - 1 : k + 2] - x[k], cost[k - 1 : k + 2], 2)
    information = max(float(curve), 0.0) + USUAL_STD**-2
    mean = x[k] + (usual * USUAL_STD**-2 - slope / 2) / information
    return float(np.clip(mean, x[0] - USUAL_STD, x[-1] + USUAL_STD)), 1 / information


def _moments(at: Array, energy: Array) -> tuple[float, float]:
    """Mean and standard deviation of positions (N,) under an energy (N,), minus twice a log density."""
    weight = np.exp((energy.min() - energy) / 2)
    middle = float(np.average(at, weights=weight))
    return middle, float(np.sqrt(np.average((at - middle) ** 2, weights=weight)))


def _spread(A: Array, image: Coarse, share: Array, maps: SignalMaps) -> Image:
    """A (P,) of coarse pixels interpolated to full size (H, W) in proportion to brightness, and at most the least sample."""
    part = np.clip(A / np.maximum(_bright(image.signal, share), 1e-12), 0, 1)
    row, column = (
        np.minimum(np.arange(side) // image.factor, most - 1) for side, most in zip(maps.signal.shape[1:], image.shape, strict=True)
    )
    by_light = maps.signal.reshape(len(share), -1).astype(float)
    whole = image.image(part)[np.ix_(row, column)].ravel() * _bright(by_light, share)
    least = ambient_sample_costs.lowest(by_light, maps.usable.reshape(by_light.shape), RoomPrior(share, 0.0))
    return np.asarray(np.minimum(np.maximum(whole, 0), least).reshape(maps.signal.shape[1:]), np.float32)


def _bright(signal: Array, share: Array) -> Array:
    """The A (P,) that would explain all of the second brightest sample."""
    return second(signal / share[:, None])
